// Structure of arrays of the vertices, triangles and edges of a surface, by leaves of its
// hierarchy: finds the pairs of two leaves whose swept boxes come near each other, by SIMD tests of
// eight boxes at a time in single precision. It reports every pair within the margins, and few
// others.
#pragma once

#include "base/workers.h"
#include "collision/leaf_parts.h"
#include "geometry/bvh.h"
#include "geometry/swept_aabb_batch.h"
#include "model/model.h"

namespace mvs::core {

// Pairs whose swept boxes come near each other.
struct FoundPairs {
  std::vector<Edge> triangles;  // a vertex and a triangle without it
  std::vector<Edge> edges;      // two edges that share no node, the lower one first

  void clear() {
    triangles.clear();
    edges.clear();
  }
};

template <typename T>
using Eight = std::array<T, SweptAabb8::count>;

// Eight parts of one leaf. Unused entries have the id `none` and empty boxes.
struct LeafTriangles {
  SweptAabb8 box;
  Eight<uint32_t> id;
  std::array<Eight<int32_t>, 3> corner;
  std::array<Eight<float>, 3> centre;  // at rest
};
struct LeafVertices {
  SweptAabb8 box;
  Eight<uint32_t> id;
  std::array<Eight<float>, 3> rest;
};
struct LeafEdges {
  SweptAabb8 box;
  Eight<uint32_t> id;
  std::array<Eight<int32_t>, 2> end;
};

class LeafSoA {
 public:
  // All of the same model; `contact_distance`: m at rest, see find_pairs().
  LeafSoA(const Model &model, const BvhTopology &bvh, const LeafParts &parts,
          double contact_distance);

  // Sets the motion of all nodes. The boxes of a leaf follow with update().
  void set_motion(const std::vector<Vec3> &from, const std::vector<Vec3> &to, StepMotion mode);
  void update(uint32_t leaf) {
    if (updated_[leaf] != motion_count_) update_leaf(leaf);
  }
  // Updates all leaves, and returns their boxes. Nullable `workers` share the work.
  const std::vector<SweptAabbF> &update_all(Workers *workers = nullptr);
  // Returns the boxes of all leaves, without those of their parts.
  const std::vector<SweptAabbF> &update_boxes();
  const SweptAabbF &box_of(uint32_t leaf) const { return box_[leaf]; }
  // Returns a margin for boxes of this motion, see float_margin().
  float margin(double margin) const { return float_margin(margin, farthest_); }

  // Appends the pairs between two updated leaves, or within one, that come near each other; margins
  // from margin(). A vertex and a triangle: within `contact` if they may have been the contact
  // distance apart at rest, within `barrier` whatever they were. Two edges: within `barrier`.
  void find_pairs(uint32_t a, uint32_t b, float contact, float barrier, FoundPairs &found) const;
  // The largest number of pairs of each kind between two leaves.
  static constexpr size_t most_pairs = size_t{3 * SweptAabb8::count} * 3 * SweptAabb8::count;

 private:
  void add_leaf(uint32_t leaf, const BvhTopology &bvh, const LeafParts &parts);
  void add_vertices(uint32_t leaf, const LeafParts &parts);
  void add_edges(const std::vector<uint32_t> &edges);
  void update_leaf(uint32_t leaf);
  template <typename Nodes>
  SweptAabbF swept_box(const Nodes &nodes) const;
  void find_triangles(uint32_t of, uint32_t in, float contact, const float *barrier,
                      std::vector<Edge> &pairs) const;
  void find_triangles(const LeafVertices &of, uint32_t in, float contact, const float *barrier,
                      std::vector<Edge> &pairs) const;
  void find_edges(uint32_t a, uint32_t b, float margin, std::vector<Edge> &pairs) const;
  uint32_t maybe_apart_at_rest(const LeafVertices &of, uint32_t i, const LeafTriangles &in) const;

  const Model *model_;
  float rest_margin_ = 0, surely_near2_ = 0;
  std::vector<LeafTriangles> triangles_;             // of each leaf
  std::vector<LeafVertices> vertices_;               // by eight, those of a leaf together
  std::vector<LeafEdges> edges_;                     // likewise
  std::vector<uint32_t> vertex_start_, edge_start_;  // of each leaf
  std::vector<SweptAabbF> box_, rest_;               // of each leaf, in motion and at rest
  std::vector<SweptPointF> node_;
  StepMotion mode_ = StepMotion::together;
  double farthest_ = 0;  // m, the largest coordinate of the motion
  uint64_t motion_count_ = 0;
  std::vector<uint64_t> updated_;  // the motion for which a leaf was updated last
};

}  // namespace mvs::core
