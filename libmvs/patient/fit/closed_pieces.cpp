// Welded points, joined sides, triangles turned alike within each piece.
#include "patient/fit/closed_pieces.h"

#include <algorithm>

#include "model/sides.h"
#include "patient/surface/manifold.h"
#include "patient/surface/weld.h"

namespace mvs::core {
namespace {

// Corners that are equal but for rounding, as share of the median side: numbers in single precision
// at 0.5 m from the origin are 60 nm apart.
constexpr double weld_share = 1e-3;

}  // namespace

ClosedPieces closed_pieces(const std::vector<Vec3> &points, const std::vector<Tri> &triangles) {
  ClosedPieces found;
  found.vertex = weld_map(points, weld_share * median_edge(points, triangles));
  const std::vector<uint32_t> &first = found.vertex;
  LeafletSheet sheet;
  sheet.x = points;
  std::vector<uint32_t> origin;  // of each triangle of the sheet
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    const Tri &corners = triangles[t];
    const Tri welded = {first[corners[0]], first[corners[1]], first[corners[2]]};
    if (!(area_normal(points, welded).squaredNorm() > 0)) continue;
    sheet.triangles.push_back(welded);
    origin.push_back(t);
  }
  const std::vector<Tri> as_given = sheet.triangles;
  const std::vector<uint32_t> across = join_sides(sheet.x, sheet.triangles).across;
  const std::vector<uint32_t> piece = pieces_of(across);
  found.of_triangle.assign(triangles.size(), none);
  found.turned.assign(triangles.size(), 0);
  const bool has_two_sides = wind_alike(sheet, across) != none;
  for (size_t k = 0; k < origin.size(); ++k) {
    found.of_triangle[origin[k]] = piece[k];
    found.turned[origin[k]] = has_two_sides && sheet.triangles[k] != as_given[k] ? 1 : 0;
    found.count = std::max(found.count, piece[k] + 1);
  }
  for (uint32_t &p : found.of_triangle) {
    if (p == none) p = found.count++;
  }
  return found;
}

}  // namespace mvs::core
