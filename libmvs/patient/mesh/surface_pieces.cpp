// Areas by connected triangles; rims welded; the gap between two pieces by a tree of triangles.
#include "patient/mesh/surface_pieces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "base/error.h"
#include "geometry/triangle_bvh.h"
#include "model/sides.h"
#include "patient/surface/weld.h"

namespace mvs::core {
namespace {

struct RimPoint {
  uint32_t vertex, piece;
  bool operator<(const RimPoint &other) const {
    return vertex != other.vertex ? vertex < other.vertex : piece < other.piece;
  }
  bool operator==(const RimPoint &other) const = default;
};

std::vector<RimPoint> rim_points(const LeafletSheet &sheet, const std::vector<uint32_t> &across,
                                 const SurfacePieces &pieces) {
  std::vector<RimPoint> rim;
  for (uint32_t side = 0; side < across.size(); ++side) {
    if (across[side] != none) continue;
    const uint32_t piece = pieces.of_triangle[side / 3];
    rim.push_back({side_start(sheet.triangles, side), piece});
    rim.push_back({side_end(sheet.triangles, side), piece});
  }
  std::sort(rim.begin(), rim.end());
  rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
  return rim;
}

struct PieceGap {
  double distance;  // m
  Vec3 at;
};

std::vector<Tri> triangles_of(const LeafletSheet &sheet, const SurfacePieces &pieces,
                              uint32_t piece) {
  std::vector<Tri> triangles;
  for (size_t t = 0; t < sheet.triangles.size(); ++t) {
    if (pieces.of_triangle[t] == piece) triangles.push_back(sheet.triangles[t]);
  }
  return triangles;
}

// From the vertices of one piece to the triangles of another one.
PieceGap gap_between(const LeafletSheet &sheet, const SurfacePieces &pieces, uint32_t from,
                     uint32_t to) {
  const std::vector<Tri> triangles = triangles_of(sheet, pieces, to);
  const TriangleBvh tree(triangles, sheet.x);
  const std::vector<uint8_t> marks =
      vertex_marks(triangles_of(sheet, pieces, from), sheet.x.size());
  PieceGap gap{INFINITY, Vec3::Zero()};
  for (size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] == 0) continue;
    const double distance = (tree.closest(sheet.x[i]).point - sheet.x[i]).norm();
    if (distance < gap.distance) gap = {distance, sheet.x[i]};
  }
  return gap;
}

}  // namespace

size_t SurfacePieces::count(double least) const {
  return static_cast<size_t>(
      std::count_if(area.begin(), area.end(), [&](double a) { return a >= least; }));
}

std::vector<uint8_t> SurfacePieces::marks_of_largest() const {
  std::vector<uint8_t> marks(of_triangle.size(), 0);
  for (size_t t = 0; t < marks.size(); ++t) marks[t] = of_triangle[t] == largest;
  return marks;
}

SurfacePieces measured_pieces(const LeafletSheet &sheet, const std::vector<uint32_t> &across) {
  SurfacePieces pieces;
  pieces.of_triangle = pieces_of(across);
  for (size_t t = 0; t < sheet.triangles.size(); ++t) {
    const uint32_t piece = pieces.of_triangle[t];
    if (piece == pieces.area.size()) pieces.area.push_back(0);
    pieces.area[piece] += triangle_area(sheet.x, sheet.triangles[t]);
  }
  const auto most = std::max_element(pieces.area.begin(), pieces.area.end());
  pieces.largest = static_cast<uint32_t>(most - pieces.area.begin());
  return pieces;
}

size_t join_rims(LeafletSheet &sheet, const std::vector<uint32_t> &across,
                 const SurfacePieces &pieces, double distance) {
  const std::vector<RimPoint> rim = rim_points(sheet, across, pieces);
  std::vector<Vec3> x;
  x.reserve(rim.size());
  for (const RimPoint &point : rim) x.push_back(sheet.x[point.vertex]);
  const std::vector<uint32_t> first = weld_map(x, distance);
  std::vector<uint8_t> meet(rim.size(), 0);  // clusters with points of two pieces
  for (uint32_t i = 0; i < rim.size(); ++i) {
    if (rim[i].piece != rim[first[i]].piece) meet[first[i]] = 1;
  }
  std::vector<uint32_t> to(sheet.x.size());
  std::iota(to.begin(), to.end(), 0u);
  size_t joined = 0;
  for (uint32_t i = 0; i < rim.size(); ++i) {
    const uint32_t vertex = rim[i].vertex, kept = rim[first[i]].vertex;
    if (meet[first[i]] == 0 || to[vertex] != vertex || kept == vertex) continue;
    to[vertex] = kept;
    ++joined;
  }
  if (joined == 0) return 0;
  std::vector<uint8_t> whole(sheet.triangles.size(), 1);
  for (size_t t = 0; t < sheet.triangles.size(); ++t) {
    Tri &corner = sheet.triangles[t];
    for (uint32_t &i : corner) i = to[i];
    whole[t] = corner[0] != corner[1] && corner[1] != corner[2] && corner[2] != corner[0];
  }
  keep_triangles(sheet, whole);
  return joined;
}

void refuse_pieces(const LeafletSheet &sheet, const SurfacePieces &pieces, double least,
                   const SurfaceJoin &join) {
  std::vector<uint32_t> large;
  for (uint32_t k = 0; k < pieces.area.size(); ++k) {
    if (pieces.area[k] >= least) large.push_back(k);
  }
  std::stable_sort(large.begin(), large.end(),
                   [&](uint32_t a, uint32_t b) { return pieces.area[a] > pieces.area[b]; });
  std::string list;
  for (size_t k = 0; k < std::min<size_t>(large.size(), 5); ++k) {
    list += format("%s%.0f", k > 0 ? ", " : "", pieces.area[large[k]] * 1e6);
  }
  if (large.size() > 5) list += ", ...";
  std::string where;
  if (join.opened > 0) {
    where = format(
        "; at %zu edges, the first near (%.1f, %.1f, %.1f) mm, more than two triangles "
        "meet",
        join.opened, join.opened_at.x() * 1e3, join.opened_at.y() * 1e3, join.opened_at.z() * 1e3);
  }
  const PieceGap gap = gap_between(sheet, pieces, large[1], large[0]);
  fail(MVS_E_OP, "triangles",
       "the surface has %zu pieces that are not connected, of %s mm2%s; the second is nearest to "
       "the first at (%.1f, %.1f, %.1f) mm, %.2f mm from it: if both are leaflets, join them there "
       "over an edge or more, with common points; if they are the atrial and the ventricular side "
       "of the leaflets, delete the ventricular one and give the other as atrial, or close both "
       "rims "
       "between them and give all as skin; delete what is no leaflet",
       large.size(), list.c_str(), where.c_str(), gap.at.x() * 1e3, gap.at.y() * 1e3,
       gap.at.z() * 1e3, gap.distance * 1e3);
}

}  // namespace mvs::core
