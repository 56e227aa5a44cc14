// Pairs of the sheet that are near each other, kept while the sheet moves: the broad phase of a
// live step.
//
// The sheet is looked at by blocks of at most eight triangles. For two blocks that could meet soon,
// every pair between them is kept that could act (see Candidates) before the blocks have used up
// the skin between them, and how much farther apart it was than where it acts. What uses a skin up
// is what the blocks move against each other since they were last looked at, and will on the way
// ahead: the way of either is told by how far the whole of it goes, and how far any of its nodes
// goes beside that. So a leaflet that travels keeps its pairs, and most pairs can be told to act,
// or not, without a distance. When a skin is used up, that pair of blocks is looked at again; and a
// few of the others in turn, so that not all of them come up in the same step. (Lists with a skin:
// Verlet, Phys. Rev. 159, 1967.)
//
// What is kept depends on the way of the sheet; what Candidates takes of it does not.
#pragma once

#include <vector>

#include "collision/leaf_parts.h"
#include "collision/leaf_soa.h"
#include "collision/rest_distance_filter.h"
#include "geometry/distance_batch.h"
#include "geometry/swept_bvh.h"
#include "model/model.h"

namespace mvs::core {

// `over`: m, how much farther apart it was than the longest distance at which it acts.
struct VerletTriangle {
  uint32_t vertex, triangle;
  double guard;  // m, range of the guard
  double over;
  bool faces;  // apart in the rest shape
};

struct VerletEdges {
  uint32_t first, second;  // edges, first < second
  double guard;            // m
  double over;
};

// The pairs between two blocks, from the first to before the last. No distance between two things
// of theirs has changed by more than `used` since they were looked at, and none falls by more than
// `reach` below that in the middle of the way, slack included.
struct VerletBlocks {
  uint32_t a = 0, b = 0;
  double used = 0, reach = 0;
  uint32_t first_triangle = 0, last_triangle = 0, first_edge = 0, last_edge = 0;
  double skin = -1;             // m, for both; negative: never looked at
  Vec3 between = Vec3::Zero();  // how far a had gone then, less how far b had,
  double beside = 0;            // and how far nodes had gone beside that
};

// Where every node goes, and how far off its way it may be.
struct NodeWays {
  const std::vector<Vec3> &from, &to, &middle, &half;  // half: from the middle to the end
  double slack;
  StepMotion pace;
};

class VerletList {
 public:
  // All of the same model, and there as long as this.
  VerletList(const Model &model, const LeafParts &parts, LeafSoA &lanes,
             const RestDistanceFilter &rest_distance_filter, SweptBvh &tree);

  // Makes the lists hold every pair that could act on these ways. False if the sheet moves too
  // wildly for lists to be worth it.
  bool follow(const NodeWays &ways);

  const std::vector<VerletBlocks> &blocks() const { return blocks_; }
  const std::vector<VerletTriangle> &triangles() const { return triangles_; }
  const std::vector<VerletEdges> &edges() const { return edges_; }

 private:
  // How a block moves: what its nodes have in common, and how far any of them is off that.
  struct Motion {
    Vec3 common = Vec3::Zero();
    double beside = 0;
  };

  void place_nodes();
  bool move(const NodeWays &ways);
  Motion motion_of(uint32_t block, const std::vector<Vec3> &nodes) const;
  bool is_wild();
  bool holds(const NodeWays &ways) const;
  void find_blocks(const NodeWays &ways);
  void keep_blocks();
  bool find_used(const NodeWays &ways);
  void look_again();
  void look(VerletBlocks &blocks);
  void take_triangles(const VerletBlocks &blocks);
  void take(const VerletBlocks &blocks, uint32_t vertex, uint32_t triangle, double distance);
  void take_edges(const VerletBlocks &blocks);
  void take_edge_pair(const VerletBlocks &blocks, uint32_t i, uint32_t j, double distance);

  const Model *model_;
  const LeafParts *parts_;
  LeafSoA *lanes_;
  const RestDistanceFilter *rest_distance_filter_;
  SweptBvh *tree_;
  double thickness_, guard_, skin_;
  std::vector<uint32_t> node_start_, node_;  // of the triangles of each block
  std::vector<Vec3> middle_, step_;  // of each node in this round; how far that is from the last
  std::vector<Motion> gone_, half_;  // of each block, since the first round and on the way ahead
  std::vector<double> longest_half_;
  bool wild_ = false;
  uint32_t calm_ = 0;  // rounds since
  uint64_t round_ = 0;
  // The ways for which blocks_ are all that come within a margin of each other.
  std::vector<Vec3> from_, to_;
  StepMotion pace_ = StepMotion::together;
  double margin_ = 0;
  std::vector<uint8_t> still_;  // no block, for the tree
  std::vector<Edge> found_;     // pairs of blocks, the lower one first
  std::vector<uint32_t> row_start_, old_row_start_, where_;
  std::vector<VerletBlocks> blocks_, old_blocks_;
  std::vector<uint8_t> worn_;
  std::vector<VerletTriangle> triangles_, old_triangles_;
  std::vector<VerletEdges> edges_, old_edges_;
  std::vector<Edge> found_triangles_, found_edges_;  // of the blocks at hand
  DistanceBatch rows_;
};

}  // namespace mvs::core
