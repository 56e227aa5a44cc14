// Triangles that meet across their sides: a surface of which each edge joins two triangles at most.
#pragma once

#include <vector>

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// Corners of side 3 t + k of triangle t: k and k + 1.
inline uint32_t side_start(const std::vector<Tri> &triangles, uint32_t side) {
  return triangles[side / 3][side % 3];
}
inline uint32_t side_end(const std::vector<Tri> &triangles, uint32_t side) {
  return triangles[side / 3][(side % 3 + 1) % 3];
}

// `across`: for each side that of the other triangle, or `none` at a boundary.
struct SurfaceJoin {
  std::vector<uint32_t> across;
  size_t opened = 0;              // edges with more than two triangles
  Vec3 opened_at = Vec3::Zero();  // the middle of the first of them
};

// Joins the triangles at each edge; where more than two meet, the pair that continues straightest,
// then the next pair. Triangles may be wound in any way; if they are wound alike but for some,
// pairs keep to that, so that two bodies that touch at an edge come apart.
SurfaceJoin join_sides(const std::vector<Vec3> &x, const std::vector<Tri> &triangles);

// The piece of each triangle, connected across sides; pieces are numbered from 0 in the order of
// their first triangles.
std::vector<uint32_t> pieces_of(const std::vector<uint32_t> &across);

// Gives each fan of triangles around a vertex, connected across sides, a vertex of its own: the
// first fan keeps the vertex, others get copies at the end. Returns the number of copies.
size_t separate_fans(LeafletSheet &sheet, const std::vector<uint32_t> &across);

// Gives each pair of triangles at an edge that more than two share a vertex of its own in the
// middle of the edge, so that every edge has two triangles at most; for edges that are left after
// separate_fans(), as both their vertices belong to one fan each. Returns the number of new
// vertices.
size_t split_shared_edges(LeafletSheet &sheet);

// Turns triangles so that all of a piece are wound alike, the way of the larger part of its area.
// Returns the number of turned triangles, or `none` if a piece has one side only (Moebius band).
// `across` is out of date if triangles were turned.
uint32_t wind_alike(LeafletSheet &sheet, const std::vector<uint32_t> &across);

// Flips the longest sides of triangles that are flatter than 1/1000 (height over longest side), and
// drops them where that side is on the boundary. Needs triangles wound alike. Returns the number of
// flat triangles that went.
size_t remove_flat(LeafletSheet &sheet);

}  // namespace mvs::core
