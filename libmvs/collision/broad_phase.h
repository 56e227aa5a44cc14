// Which vertices and triangles, and which edges, could meet: the broad phase.
//
// Two lists, by a tree of moving boxes. Facing pairs: a vertex and a triangle apart in the rest
// shape, within the contact thickness of each other. Guard pairs: every vertex and triangle, and
// every two edges, that are not incident and within their guard range. Each list also takes what
// could come that near while every node stays within `slack` of its way: the segment from where it
// is to where a step would take it. Together: all nodes the same share of their ways at a time, so
// that what moves alike stays apart. Each for itself: wherever on its way every node is. Edges are
// owned by one of their triangles, so that each pair of them comes up once
// (representative triangles: Curtis, Tamstorf, Manocha, I3D 2008).
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "collision/leaf_parts.h"
#include "collision/leaf_soa.h"
#include "collision/verlet_list.h"
#include "geometry/distance_batch.h"
#include "geometry/swept_bvh.h"
#include "model/model.h"

namespace mvs::core {

struct VertexTriangle {
  uint32_t vertex, triangle;
  double guard;  // m, range of the guard; unused in facing pairs
};

struct EdgeEdge {
  uint32_t first, second;  // edges, first < second
  double guard;            // m
};

class BroadPhase {
 public:
  explicit BroadPhase(const Model &model);
  BroadPhase(const BroadPhase &) = delete;
  BroadPhase &operator=(const BroadPhase &) = delete;

  // Whether what is near is kept from one list to the next, which pays in live steps; the lists are
  // the same.
  void keep_near(bool keep) { keeps_near_ = keep; }
  // Keeps it from the next list on: there will be more.
  void keep_near_at_once() { lists_ = std::max(lists_, lists_alone); }
  // Makes the lists for nodes on their way from x to `to`.
  void build(const std::vector<Vec3> &x, const std::vector<Vec3> &to, double slack,
             StepMotion pace = StepMotion::together);
  // Goes back to the first lists made where the last ones were, if they hold for x and `to`: a step
  // that is shortened as a whole after its cuts needs no lists of its own.
  bool recall(const std::vector<Vec3> &x, const std::vector<Vec3> &to);
  // Whether each node is on its way, and all at the same share of it if they go together. What is
  // true of two places is true of the straight way between them.
  bool valid_for(const std::vector<Vec3> &x) const;
  bool for_itself() const { return pace_ == StepMotion::independent; }

  bool empty() const {
    return contact_candidates_.empty() && barrier_candidates_.empty() &&
           barrier_edge_candidates_.empty();
  }
  // Sorted by vertex, then triangle; edges by first, then second.
  const std::vector<VertexTriangle> &contact_candidates() const { return contact_candidates_; }
  const std::vector<VertexTriangle> &barrier_candidates() const { return barrier_candidates_; }
  const std::vector<EdgeEdge> &barrier_edge_candidates() const { return barrier_edge_candidates_; }

 private:
  void keep_first();
  void exchange();
  double share_of(const std::vector<Vec3> &x) const;
  bool stays(uint32_t node) const;
  void find_still();
  template <typename Nodes>
  SweptAabb way_of(const Nodes &nodes) const {
    return SweptAabb::of(nodes, from_, to_, pace_);
  }
  void choose();
  void choose(const VerletTriangle &pair, const VerletBlocks &blocks);
  bool find_changed(const std::vector<Vec3> &x, const std::vector<Vec3> &to, double slack,
                    StepMotion pace);
  void search();
  void forget_changed();
  void forget();
  bool edge_changed(uint32_t edge) const;
  bool concerns(uint32_t vertex, uint32_t triangle) const;
  bool concerns(const Edge &pair) const;
  void take_triangles();
  void take_edges();
  void take(uint32_t vertex, uint32_t triangle, double middle, double near);
  void take_edge_pair(uint32_t i, uint32_t j, double distance);
  void sort_pairs(std::vector<VertexTriangle> &pairs);
  void sort_edges();
  template <typename A, typename B>
  double reach(const A &a, const B &b) const;

  const Model *model_;
  double thickness_;
  RestDistanceFilter rest_distance_filter_;
  SweptBvh tree_;
  LeafParts parts_;
  LeafSoA lanes_;
  std::vector<Vec3> from_, to_;         // of each node
  std::vector<Vec3> middle_, half_;     // of its way; from there to the end
  std::vector<VertexTriangle> sorted_;  // while pairs are sorted, with how many each vertex has
  std::vector<uint32_t> count_;
  // What is to be measured: pairs that the lanes have found, and some of them side by side.
  std::vector<Edge> found_triangles_, found_edges_;
  DistanceBatch place_, motion_;
  double slack_ = 0;
  StepMotion pace_ = StepMotion::together;
  // Nodes and triangles that go elsewhere than when the lists were last made; triangles between two
  // of which there is nothing to look for.
  std::vector<uint8_t> changed_, triangle_changed_, skip_block_;
  bool little_ = false;  // has changed: the rest of the lists stays
  // Triangles that may be prescribed to stay, and those that do: nothing is between two of them.
  std::vector<uint32_t> held_;
  std::vector<uint8_t> still_;
  bool any_still_ = false;
  std::vector<VertexTriangle> contact_candidates_, barrier_candidates_;
  std::vector<EdgeEdge> barrier_edge_candidates_;
  bool first_ = false;  // lists of a way from this place
  // Those before the present ones, where that place had other ones first.
  struct {
    std::vector<Vec3> from, to, half;
    double slack = 0;
    StepMotion pace = StepMotion::together;
    std::vector<VertexTriangle> facing, guarded;
    std::vector<EdgeEdge> edges;
    bool first = false;
  } kept_;
  bool keeps_near_ = true;
  // Lists before what is near is kept, which takes longer than to search: a step that is the only
  // one does not need it, and the first step is dear enough.
  static constexpr uint64_t lists_alone = 2;
  uint64_t lists_ = 0;
  std::optional<VerletList> near_;
};

}  // namespace mvs::core
