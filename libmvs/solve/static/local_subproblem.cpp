// Cutting a piece out of a valve.
#include "solve/static/local_subproblem.h"

#include <algorithm>
#include <cmath>

namespace mvs::core {
namespace {

struct Box {
  Vec3 low, high;
  bool near(const Box &other, double distance) const {
    const Vec3 gap = (other.low - high).cwiseMax(low - other.high).cwiseMax(0.0);
    return gap.squaredNorm() <= distance * distance;
  }
};

Box box_of(const std::vector<Vec3> &x, const Tri &t) {
  return {x[t[0]].cwiseMin(x[t[1]]).cwiseMin(x[t[2]]), x[t[0]].cwiseMax(x[t[1]]).cwiseMax(x[t[2]])};
}

Box around(const Box &a, const Box &b) {
  return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
}

// Squared distances of the nodes from the nearest of the places. Places at branch points stand for
// the leaflet where their chordae end, too.
std::vector<double> distances2(const Model &whole, const std::vector<Vec3> &x,
                               std::vector<uint32_t> places) {
  for (size_t k = 0, given = places.size(); k < given; ++k) {
    for (const Chord &c : whole.valve.chords) {
      if (c.a == places[k]) places.push_back(c.b);
    }
  }
  std::vector<double> distance2(x.size(), HUGE_VAL);
  for (const uint32_t place : places) {
    for (size_t i = 0; i < x.size(); ++i) {
      distance2[i] = std::min(distance2[i], (x[i] - x[place]).squaredNorm());
    }
  }
  return distance2;
}

std::vector<uint8_t> free_nodes(const Model &whole, const std::vector<Vec3> &x,
                                const std::vector<uint32_t> &places, const Extent &extent) {
  const std::vector<double> distance2 = distances2(whole, x, places);
  double reach2 = extent.radius * extent.radius;
  if (extent.most < x.size()) {
    std::vector<double> sorted = distance2;
    const auto last = sorted.begin() + static_cast<std::ptrdiff_t>(extent.most);
    std::nth_element(sorted.begin(), last, sorted.end());
    reach2 = std::min(reach2, *last);
  }
  std::vector<uint8_t> free(x.size(), 0);
  for (size_t i = 0; i < x.size(); ++i) free[i] = distance2[i] <= reach2;
  // a branch point goes with what hangs on it
  for (const Chord &c : whole.valve.chords) free[c.a] |= free[c.b];
  for (size_t i = 0; i < x.size(); ++i) free[i] &= !whole.topology.fixed[i];
  return free;
}

// Triangles with a free corner, and those that these could meet.
std::vector<uint8_t> taken_triangles(const Model &whole, const std::vector<Vec3> &x,
                                     const std::vector<uint8_t> &free, double distance) {
  const auto &triangles = whole.valve.triangles.get();
  std::vector<uint8_t> taken(triangles.size(), 0);
  std::vector<Box> moving;
  Box all{};
  for (size_t t = 0; t < triangles.size(); ++t) {
    const Tri &tri = triangles[t];
    if (!free[tri[0]] && !free[tri[1]] && !free[tri[2]]) continue;
    taken[t] = 1;
    moving.push_back(box_of(x, tri));
    all = moving.size() == 1 ? moving[0] : around(all, moving.back());
  }
  for (size_t t = 0; t < triangles.size(); ++t) {
    const Box box = box_of(x, triangles[t]);
    if (taken[t] || moving.empty() || !box.near(all, distance)) continue;
    for (const Box &m : moving) {
      if (!m.near(box, distance)) continue;
      taken[t] = 1;
      break;
    }
  }
  return taken;
}

// The nodes of a piece in the order of the whole.
struct Numbering {
  std::vector<uint32_t> of;    // node of the whole -> of the piece, or none
  std::vector<uint32_t> node;  // and back
};

Numbering number(const Model &whole, const std::vector<uint8_t> &free,
                 const std::vector<uint8_t> &taken) {
  std::vector<uint8_t> in(whole.node_count(), 0);
  for (size_t t = 0; t < taken.size(); ++t) {
    for (const uint32_t i : whole.valve.triangles[t]) in[i] |= taken[t];
  }
  for (const Chord &c : whole.valve.chords) {
    if (free[c.a] || free[c.b]) in[c.a] = in[c.b] = 1;
  }
  Numbering index{std::vector<uint32_t>(in.size(), none), {}};
  for (uint32_t i = 0; i < in.size(); ++i) {
    if (!in[i]) continue;
    index.of[i] = static_cast<uint32_t>(index.node.size());
    index.node.push_back(i);
  }
  return index;
}

void copy_constants(const Valve &from, Valve &to) {
  to.leaflets = from.leaflets;
  to.curves = from.curves;
  to.contact_thickness = from.contact_thickness;
  to.contact_stiffness = from.contact_stiffness;
  to.bending_scale = from.bending_scale;
}

void add_triangles(const Model &whole, const std::vector<uint8_t> &taken, const Numbering &index,
                   Model &piece) {
  const Valve &valve = whole.valve;
  for (uint32_t t = 0; t < taken.size(); ++t) {
    if (!taken[t]) continue;
    const Tri &tri = valve.triangles[t];
    piece.valve.triangles.push_back({index.of[tri[0]], index.of[tri[1]], index.of[tri[2]]});
    piece.valve.triangle_leaflet.push_back(valve.triangle_leaflet[t]);
    piece.valve.triangle_thickness.push_back(valve.triangle_thickness[t]);
    piece.valve.triangle_fibre.push_back(valve.triangle_fibre[t]);
    piece.rest_area.push_back(whole.rest_area[t]);
  }
}

}  // namespace

LocalSubproblem cut_out(const Model &whole, const std::vector<Vec3> &x,
                        const std::vector<uint32_t> &places, const Extent &extent) {
  const std::vector<uint8_t> free = free_nodes(whole, x, places, extent);
  // what is left out stays; it is felt from one thickness on, and edges have to be seen whole
  const double distance = extent.leash + 1.5 * whole.valve.contact_thickness;
  const std::vector<uint8_t> taken = taken_triangles(whole, x, free, distance);
  const Numbering index = number(whole, free, taken);
  LocalSubproblem region{{}, index.node};
  Model &piece = region.model;
  copy_constants(whole.valve, piece.valve);
  add_triangles(whole, taken, index, piece);
  for (const uint32_t i : index.node) {
    piece.valve.rest.push_back(whole.valve.rest[i]);
    piece.valve.open.push_back(x[i]);
    piece.vertex_area.push_back(whole.vertex_area[i]);
  }
  piece.valve.loaded = piece.valve.open;
  for (Chord c : whole.valve.chords) {
    if (!free[c.a] && !free[c.b]) continue;
    c.a = index.of[c.a];
    c.b = index.of[c.b];
    piece.valve.chords.push_back(c);
  }
  piece.topology = make_topology(piece.valve);
  for (uint32_t k = 0; k < index.node.size(); ++k) {
    piece.topology.fixed[k] = !free[index.node[k]];
  }
  const auto &rest = piece.valve.rest.get();
  for (const Edge &e : piece.topology.edges) {
    piece.rest_length.push_back((rest[e[1]] - rest[e[0]]).norm());
  }
  return region;
}

}  // namespace mvs::core
