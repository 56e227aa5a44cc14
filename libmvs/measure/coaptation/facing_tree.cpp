// Volumes of the hierarchy, and the triangles of two leaves by SIMD.
#include "measure/coaptation/facing_tree.h"

#include "base/simd.h"

namespace mvs::core {
namespace {

// A share of a squared distance, far above the rounding of sums in another order.
constexpr double rounding_of_distance = 1e-9;

template <typename V>
MVS_INLINE uint32_t find_near(const FacingTree::Leaf &a, uint32_t i, const FacingTree::Leaf &b,
                              double cosine, double limit2) {
  using Value = typename V::Value;
  const Value zero = {};
  uint32_t bits = 0;
  for (uint32_t first = 0; first < FacingTree::in_leaf; first += V::width) {
    Value along = {}, square = {};
    for (size_t c = 0; c < 3; ++c) {
      Value normal, low, high;
      load<V>(normal, &b.normal[c][first]);
      load<V>(low, &b.low[c][first]);
      load<V>(high, &b.high[c][first]);
      along = along + normal * a.normal[c][i];
      const Value below = low - a.high[c][i], above = a.low[c][i] - high;
      Value off = below < above ? above : below;
      off = off > zero ? off : zero;
      square = square + off * off;
    }
    bits |= bits_of_doubles<V>((along <= zero + cosine) & (square <= zero + limit2)) << first;
  }
  return bits;
}

}  // namespace

uint32_t FacingTree::near_of_leaf(const Leaf &a, uint32_t i, const Leaf &b, double cosine,
                                  double limit2) {
  static const auto kernel = simd_kernel<&find_near<Double2>, &find_near<Double4>>();
  return kernel(a, i, b, cosine + rounding, limit2 * (1 + rounding_of_distance));
}

FacingTree::FacingTree(const Model &model, const std::vector<Vec3> &x, const Surface &surface)
    : BoxedTriangles(model.valve.triangles, x), bvh_(*sheet_topology(model)) {
  const BvhTopology &topology = bvh_.topology();
  leaves_.resize(topology.leaf_count());
  bvh_.refit([&](uint32_t leaf, Volume &volume) {
    const uint32_t first = topology.leaf_start[leaf], last = topology.leaf_start[leaf + 1];
    for (uint32_t k = 0; k < in_leaf; ++k) {
      const uint32_t t = topology.order[std::min(first + k, last - 1)];
      const Aabb &box = box_of(t);
      const Vec3 &normal = surface.normal[t];
      volume.box.add(box);
      volume.normals.add(normal);
      for (int c = 0; c < 3; ++c) {
        leaves_[leaf].normal[c][k] = normal[c];
        leaves_[leaf].low[c][k] = box.low[c];
        leaves_[leaf].high[c][k] = box.high[c];
      }
    }
  });
}

}  // namespace mvs::core
