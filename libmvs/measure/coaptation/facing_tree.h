// Triangles near a point or near each other that may face it: a hierarchy of boxes with the normals
// of the triangles in them.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "geometry/aabb.h"
#include "geometry/bvh.h"
#include "geometry/triangle_bvh.h"
#include "measure/tissue/sheet_topology.h"
#include "measure/tissue/surface.h"
#include "model/model.h"

namespace mvs::core {

// Subtrees whose normals all exceed a cosine with the normal of the point, such as the tissue
// around it, are not visited.
class FacingTree : public BoxedTriangles {
 public:
  // Keeps references to all: they must outlive the tree.
  FacingTree(const Model &model, const std::vector<Vec3> &x, const Surface &surface);

  // Calls visit(triangle) for at least every triangle nearer to p than sqrt(limit2) whose normal
  // has at most this cosine with `normal`, near boxes first; the visitor may lower limit2.
  template <typename Visit>
  void visit_near(const Vec3 &p, const Vec3 &normal, double cosine, const double &limit2,
                  Visit &&visit) const {
    bvh_.for_nearest(
        [&](const Volume &volume) {
          const double distance2 = volume.box.distance2(p);
          if (distance2 > limit2) return HUGE_VAL;
          return least_cosine(volume.normals, normal) <= cosine + rounding ? distance2 : HUGE_VAL;
        },
        limit2, visit);
  }
  // Calls visit(a, b) once for at least every pair of triangles whose normals have at most this
  // cosine and whose boxes are no further apart than sqrt(limit2).
  template <typename Visit>
  void for_near_pairs(double cosine, double limit2, Visit &&visit) const {
    const auto apart = [&](const Volume &a, const Volume &b) {
      return a.box.distance2(b.box) > limit2 ||
             least_cosine(a.normals, b.normals) > cosine + rounding;
    };
    bvh_.for_near_leaves(
        [](const Volume &) { return false; }, apart,
        [&](uint32_t a, uint32_t b) {
          const BvhTopology &topology = bvh_.topology();
          const uint32_t first_a = topology.leaf_start[a], first_b = topology.leaf_start[b];
          const uint32_t count_b = topology.leaf_start[b + 1] - first_b;
          for (uint32_t i = first_a; i < topology.leaf_start[a + 1]; ++i) {
            const uint32_t after = a == b ? i - first_a + 1 : 0;
            uint32_t bits = near_of_leaf(leaves_[a], i - first_a, leaves_[b], cosine, limit2);
            bits &= ((1u << count_b) - 1) & ~((1u << after) - 1);
            for (; bits != 0; bits &= bits - 1) {
              const auto j = static_cast<uint32_t>(std::countr_zero(bits));
              visit(topology.order[i], topology.order[first_b + j]);
            }
          }
        });
  }

  // Normals and boxes of the triangles of a leaf by coordinate; a smaller leaf repeats its last.
  static constexpr uint32_t in_leaf = sheet_leaf;
  struct Leaf {
    std::array<std::array<double, in_leaf>, 3> normal, low, high;
  };

 private:
  // Bit j is set for at least every triangle j of a leaf that triangle i of another one may face.
  static uint32_t near_of_leaf(const Leaf &a, uint32_t i, const Leaf &b, double cosine,
                               double limit2);

  struct Volume {
    Aabb box, normals;
    void add(const Volume &other) {
      box.add(other.box);
      normals.add(other.normals);
    }
  };
  static constexpr double rounding = 1e-9;  // of a cosine, by far

  // A lower bound of the dot product of two vectors from these boxes.
  static double least_cosine(const Aabb &a, const Aabb &b) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      sum += std::min(std::min(a.low[k] * b.low[k], a.low[k] * b.high[k]),
                      std::min(a.high[k] * b.low[k], a.high[k] * b.high[k]));
    }
    return sum;
  }

  static double least_cosine(const Aabb &a, const Vec3 &normal) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += std::min(a.low[k] * normal[k], a.high[k] * normal[k]);
    return sum;
  }

  Bvh<Volume> bvh_;
  std::vector<Leaf> leaves_;
};

}  // namespace mvs::core
