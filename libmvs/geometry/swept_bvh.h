// Bounding volume hierarchy of a surface in motion: pairs of leaves that come near each other
// during a step.
#pragma once

#include <cstdint>
#include <vector>

#include "base/types.h"
#include "geometry/bvh.h"
#include "geometry/swept_aabb_batch.h"

namespace mvs::core {

// Leaves hold at most eight triangles. Nodes move from `from` to `to` along straight lines. If all
// move together (the same share of their motion at a time), neighbours that move alike keep their
// distance; if each node moves independently, the boxes of their whole motions decide.
class SweptBvh {
 public:
  SweptBvh(const std::vector<Vec3> &x, const std::vector<Tri> &triangles)
      : bvh_(x, triangles, SweptAabb8::count) {}

  const BvhTopology &topology() const { return bvh_.topology(); }

  // Sets the swept boxes of the leaves. Pairs of leaves that rest are not reported.
  void refit(const std::vector<SweptAabbF> &leaves, const std::vector<uint8_t> &rests) {
    bvh_.refit([&](uint32_t leaf, Volume &volume) {
      volume.box = leaves[leaf];
      volume.rests = rests[leaf] != 0;
    });
  }
  // Calls visit(a, b) once for each pair of leaves that are not apart by a margin of
  // float_margin(), a leaf and itself included, in an order that depends on the topology alone.
  template <typename Visit>
  void for_near_leaves(float margin, Visit &&visit) const {
    bvh_.for_near_leaves(
        [](const Volume &v) { return v.rests; },
        [&](const Volume &a, const Volume &b) { return surely_apart(a.box, b.box, margin); },
        visit);
  }

 private:
  struct Volume {
    SweptAabbF box;
    bool rests = false;
    void add(const Volume &other) {
      box.add(other.box);
      rests = rests && other.rests;
    }
  };
  Bvh<Volume> bvh_;
};

}  // namespace mvs::core
