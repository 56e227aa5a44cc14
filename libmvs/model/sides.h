// Sides of triangles sorted by edge, and small queries on triangle meshes.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "base/types.h"

namespace mvs::core {

// Side k of a triangle joins its corners k and k + 1.
struct Side {
  Edge edge;  // smaller node first
  uint32_t triangle, k;
};

// Returns the sides of all triangles, sorted by edge, then triangle.
std::vector<Side> sorted_sides(const std::vector<Tri> &triangles);

inline uint32_t side_from(const std::vector<Tri> &triangles, const Side &side) {
  return triangles[side.triangle][side.k];
}
inline uint32_t side_to(const std::vector<Tri> &triangles, const Side &side) {
  return triangles[side.triangle][(side.k + 1) % 3];
}

// Returns the corner of a triangle that is not on the given edge of it.
inline uint32_t opposite_corner(const Tri &triangle, const Edge &edge) {
  for (const uint32_t corner : triangle) {
    if (corner != edge[0] && corner != edge[1]) return corner;
  }
  return none;
}

// Returns the vertices that share a triangle with `vertex`, ascending; `star` lists the triangles
// around it.
std::vector<uint32_t> neighbours_in(const std::vector<Tri> &triangles,
                                    std::span<const uint32_t> star, uint32_t vertex);

// Returns an array of `count` with 1 at the given indices and 0 elsewhere.
inline std::vector<uint8_t> marks_of(const std::vector<uint32_t> &indices, size_t count) {
  std::vector<uint8_t> marks(count, 0);
  for (const uint32_t k : indices) marks[k] = 1;
  return marks;
}

// Marks the vertices of triangles among `node_count` nodes.
inline std::vector<uint8_t> vertex_marks(const std::vector<Tri> &triangles, size_t node_count) {
  std::vector<uint8_t> marks(node_count, 0);
  for (const Tri &triangle : triangles) {
    for (const uint32_t node : triangle) marks[node] = 1;
  }
  return marks;
}

// Normal of a triangle with corners in `x`, twice its area long, m2.
inline Vec3 area_normal(const std::vector<Vec3> &x, const Tri &t) {
  return (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
}

// The sum of these over the triangles around each vertex.
inline std::vector<Vec3> area_normals(const std::vector<Vec3> &x,
                                      const std::vector<Tri> &triangles) {
  std::vector<Vec3> normals(x.size(), Vec3::Zero());
  for (const Tri &t : triangles) {
    const Vec3 n = area_normal(x, t);
    for (const uint32_t i : t) normals[i] += n;
  }
  return normals;
}

// Area of a triangle with corners in `x`, m2.
inline double triangle_area(const std::vector<Vec3> &x, const Tri &t) {
  return 0.5 * area_normal(x, t).norm();
}

// Area of a surface, m2.
inline double surface_area(const std::vector<Vec3> &x, const std::vector<Tri> &triangles) {
  double area = 0;
  for (const Tri &t : triangles) area += triangle_area(x, t);
  return area;
}

// Calls visit(first, last) for the range of sides of each edge.
template <typename Visit>
void for_each_edge(const std::vector<Side> &sides, Visit visit) {
  for (size_t first = 0; first < sides.size();) {
    size_t last = first + 1;
    while (last < sides.size() && sides[last].edge == sides[first].edge) ++last;
    visit(first, last);
    first = last;
  }
}

}  // namespace mvs::core
