// Directions along fibres, moves within a band, chordae.
#include "patient/fit/free_edge_shift.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/intersect.h"

namespace mvs::core {
namespace {

// m: least width of the band in which tissue moves, five triangles of the default mesh.
constexpr double least_band = 8e-3;
// The band is at least this much wider than the move, and reaches so far up the leaflet at most.
constexpr double band_per_move = 4, most_of_leaflet = 0.7;
// The largest move over the width of the band: beyond it triangles get too thin to close.
constexpr double largest_stretch = 0.35;
constexpr double shortest_chord = 0.3;  // share of its length that a chord keeps
constexpr int most_rounds_apart = 8;    // of halving moves until no triangles cross

// Unit vectors towards the free edge, by area.
std::vector<Vec3> fibre_directions(const PatientGeometry &g) {
  std::vector<Vec3> direction(g.sheet.x.size(), Vec3::Zero());
  for (const Tri &t : g.sheet.triangles) {
    const Vec3 &a = g.sheet.x[t[0]], &b = g.sheet.x[t[1]], &c = g.sheet.x[t[2]];
    const Vec3 normal = (b - a).cross(c - a);
    const double size2 = normal.squaredNorm();
    if (!(size2 > 0)) continue;
    const auto share = [&](int k) { return g.coordinates.share[t[static_cast<size_t>(k)]]; };
    const Vec3 slope =
        normal.cross(share(0) * (c - b) + share(1) * (a - c) + share(2) * (b - a)) / size2;
    for (const uint32_t i : t) direction[i] += std::sqrt(size2) * slope;
  }
  for (Vec3 &d : direction) {
    const double size = d.norm();
    if (size > 0) d /= size;
  }
  return direction;
}

// m, the move of each vertex along its fibre; `by` at the ends of their fibres.
std::vector<double> edge_moves(const PatientGeometry &g, const std::vector<double> &by) {
  const SheetCoordinates &c = g.coordinates;
  std::vector<double> move(g.sheet.x.size(), 0);
  for (size_t i = 0; i < move.size(); ++i) {
    const double wide = std::max(least_band, band_per_move * std::abs(by[i]));
    const double band = std::min(wide, most_of_leaflet * c.whole[i]);
    const double from_edge = std::max(0.0, c.whole[i] - c.height[i]);
    if (!(from_edge < band)) continue;
    const double most = largest_stretch * band;
    move[i] = std::clamp(by[i], -most, most) * (1 - from_edge / band);
  }
  for (const uint32_t i : g.rims.annulus) move[i] = 0;
  return move;
}

// Halves the moves of triangles that cross; in the last round nothing moves.
std::vector<Vec3> moved_without_crossings(const PatientGeometry &g, std::vector<double> move) {
  const std::vector<Vec3> direction = fibre_directions(g);
  std::vector<Vec3> x;
  for (int round = 0; round <= most_rounds_apart; ++round) {
    x = g.sheet.x;
    for (size_t i = 0; i < x.size(); ++i) x[i] += move[i] * direction[i];
    const std::vector<Edge> crossings = find_intersections(x, g.sheet.triangles);
    if (crossings.empty()) return x;
    for (const Edge &pair : crossings) {
      for (const uint32_t t : pair) {
        for (const uint32_t i : g.sheet.triangles[t]) move[i] *= 0.5;
      }
    }
  }
  return g.sheet.x;
}

}  // namespace

Valve with_edge_moved(const Valve &valve, const PatientGeometry &g, double by) {
  return with_edge_moved(valve, g, std::vector<double>(g.sheet.x.size(), by));
}

Valve with_edge_moved(const Valve &valve, const PatientGeometry &g, const std::vector<double> &by) {
  Valve moved = valve;
  const std::vector<Vec3> x = moved_without_crossings(g, edge_moves(g, by));
  std::vector<Vec3> rest = valve.rest.get();
  std::copy(x.begin(), x.end(), rest.begin());
  for (Chord &chord : moved.chords) {
    const double before = (valve.rest.get()[chord.b] - valve.rest.get()[chord.a]).norm();
    const double after = (rest[chord.b] - rest[chord.a]).norm();
    chord.rest_length =
        std::max(shortest_chord * chord.rest_length, chord.rest_length + after - before);
  }
  // nodes of leaflets that are not prescribed are at rest in the other shapes as well
  for (CowVector<Vec3> *shape : {&moved.open, &moved.loaded}) {
    if (shape->empty()) continue;
    std::vector<Vec3> &other = shape->edit();
    for (size_t i = 0; i < x.size(); ++i) other[i] += rest[i] - valve.rest.get()[i];
  }
  moved.rest = std::move(rest);
  return moved;
}

}  // namespace mvs::core
