// The sheet as a rail: the points of it, and of its rim, that are nearest to nodes which slide
// along.
#pragma once

#include <limits>
#include <vector>

#include "geometry/triangle_bvh.h"
#include "measure/orifice/samples.h"

namespace mvs::core::orifice {

struct Rail {
  // Keeps references to both.
  Rail(const Sheet &sheet, const TriangleBvh &sheet_tree);
  Rail(const Rail &) = delete;  // the tree of the rim refers to another member
  Rail &operator=(const Rail &) = delete;

  // The normal of the sheet at the point nearest to p, which is on this triangle. Not of length 1.
  Vec3 normal_at(uint32_t triangle, const Vec3 &p) const;

  const Mesh &mesh;
  const double grain;  // m, the finest spacing of samples
  const TriangleBvh &tree;
  const std::vector<Tri> rim_edges;
  const TriangleBvh rim_tree;
  const std::vector<Vec3> normal;  // by node
};

// Searches for numbered nodes. A node moves little from one search to the next, so that the
// triangles around it are collected once for many of them.
class RailSearch {
 public:
  RailSearch(const Rail &rail, size_t nodes)
      : rail_(rail), nearest_(nodes, none), around_(nodes), around_rim_(nodes) {}

  // The point of the sheet nearest to a place of node v.
  TriangleBvh::Hit nearest(uint32_t v, const Vec3 &p);
  // Whether a place of node v is on the rim of the sheet.
  bool is_on_rim(uint32_t v, const Vec3 &p);

 private:
  // Triangles near a place: no others matter for points near it.
  struct Around {
    Vec3 centre = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    std::vector<uint32_t> triangles;
  };
  static void collect(const TriangleBvh &tree, double distance, Around &around);

  const Rail &rail_;
  std::vector<uint32_t> nearest_;            // per node: the last triangle of the sheet found
  std::vector<Around> around_, around_rim_;  // per node: of the sheet, and of its rim
};

}  // namespace mvs::core::orifice
