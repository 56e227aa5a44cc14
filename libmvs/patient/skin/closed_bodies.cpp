// Pieces by welded corners, with the length of their rims and their volume.
#include "patient/skin/closed_bodies.h"

#include <algorithm>
#include <cmath>

#include "model/sides.h"
#include "patient/surface/manifold.h"
#include "patient/surface/weld.h"

namespace mvs::core {
namespace {

// Corners that are one vertex, as a share of the median side (fit/closed_pieces.cpp).
constexpr double one_vertex_share = 1e-3;
// The rims of a skin are those of small holes: their length over the root of its area. Rims of a
// sheet of two leaflets have about five.
constexpr double most_rim = 0.5;
// The triangles with area, welded, wound alike in each piece.
LeafletSheet welded(const ClosedSurface &given) {
  LeafletSheet sheet;
  sheet.x = given.points;
  const std::vector<uint32_t> vertex =
      weld_map(given.points, one_vertex_share * median_edge(given.points, given.triangles));
  for (const Tri &t : given.triangles) {
    const Tri joined = {vertex[t[0]], vertex[t[1]], vertex[t[2]]};
    if (area_normal(sheet.x, joined).squaredNorm() > 0) sheet.triangles.push_back(joined);
  }
  return sheet;
}

struct Piece {
  double area = 0, rim = 0, volume = 0;  // m2, m, m3
  bool is_skin() const { return rim < most_rim * std::sqrt(area); }
};

std::vector<Piece> sizes_of(const LeafletSheet &sheet, const std::vector<uint32_t> &across,
                            const std::vector<uint32_t> &piece_of) {
  std::vector<Piece> pieces;
  for (uint32_t t = 0; t < piece_of.size(); ++t) {
    pieces.resize(std::max<size_t>(pieces.size(), piece_of[t] + 1));
    Piece &piece = pieces[piece_of[t]];
    const Tri &tri = sheet.triangles[t];
    piece.area += triangle_area(sheet.x, tri);
    piece.volume += sheet.x[tri[0]].dot(sheet.x[tri[1]].cross(sheet.x[tri[2]])) / 6;
    for (uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
      if (across[side] != none) continue;
      piece.rim +=
          (sheet.x[side_start(sheet.triangles, side)] - sheet.x[side_end(sheet.triangles, side)])
              .norm();
    }
  }
  return pieces;
}

}  // namespace

ClosedBodies closed_bodies(const ClosedSurface &given) {
  LeafletSheet sheet = welded(given);
  const std::vector<uint32_t> piece_of = pieces_of(join_sides(sheet.x, sheet.triangles).across);
  const bool has_two_sides = wind_alike(sheet, join_sides(sheet.x, sheet.triangles).across) != none;
  const std::vector<Piece> pieces =
      sizes_of(sheet, join_sides(sheet.x, sheet.triangles).across, piece_of);
  double area = 0;
  for (const Piece &piece : pieces) area += piece.area;
  std::vector<std::vector<Tri>> triangles(pieces.size());
  for (uint32_t t = 0; t < piece_of.size(); ++t) {
    triangles[piece_of[t]].push_back(sheet.triangles[t]);
  }
  ClosedBodies found;
  found.others.points = sheet.x;
  for (size_t k = 0; k < pieces.size(); ++k) {
    if (!has_two_sides || !pieces[k].is_skin()) {
      found.others.triangles.insert(found.others.triangles.end(), triangles[k].begin(),
                                    triangles[k].end());
    } else if (pieces[k].area > 0.05 * area) {
      LeafletSheet body;
      body.x = sheet.x;
      body.triangles = std::move(triangles[k]);
      if (pieces[k].volume < 0) {
        for (Tri &t : body.triangles) std::swap(t[1], t[2]);
      }
      drop_unused(body);
      found.bodies.push_back(std::move(body));
    }
  }
  return found;
}

}  // namespace mvs::core
