// Verlet list (Verlet, Phys. Rev. 159, 1967) of the pairs of a surface that are near each other,
// kept from step to step: the broad phase of live steps.
//
// The surface is divided into blocks of at most eight triangles. For two near blocks the list holds
// every vertex-triangle and edge-edge pair that could act before the blocks have used up a skin
// between them, with its gap: how much farther apart it was than the distance at which it acts. A
// skin is used up by the relative motion of the blocks (BlockMotion) since their entries were made,
// and in the step ahead. So a leaflet that moves as a whole keeps its entries, and most pairs are
// decided without a distance. The entries of two blocks are made anew when their skin is used up;
// in addition a few of the others in turn, so that not all expire in the same step.
//
// The entries depend on earlier steps; the candidates that BroadPhase takes from them do not.
#pragma once

#include <vector>

#include "collision/block_motion.h"
#include "collision/block_pairs.h"
#include "collision/leaf_parts.h"
#include "collision/leaf_soa.h"
#include "collision/rest_distance_filter.h"
#include "geometry/distance_batch.h"
#include "geometry/swept_bvh.h"
#include "model/model.h"

namespace mvs::core {

// `gap`: m, distance when the entry was made, less the longest one at which the pair acts.
struct VerletTriangle {
  uint32_t vertex, triangle;
  double gap;
  bool is_contact;  // apart in the rest shape
};

struct VerletEdges {
  uint32_t first, second;  // edges, first < second
  double gap;
};

class VerletList {
 public:
  // All of the same model; they must outlive the list.
  VerletList(const Model &model, const LeafParts &parts, LeafSoA &leaves,
             const RestDistanceFilter &rest_distance_filter, SweptBvh &bvh);

  // Makes the list hold every pair that could act during this motion. Returns false if the surface
  // deforms so much that a list does not pay (BlockMotion::is_wild).
  bool update(const NodeMotion &motion);

  const std::vector<VerletBlocks> &blocks() const { return pairs_.blocks(); }
  const std::vector<VerletTriangle> &triangles() const { return triangles_; }
  const std::vector<VerletEdges> &edges() const { return edges_; }

 private:
  bool find_expired(const NodeMotion &motion);
  void renew_expired();
  void renew(VerletBlocks &blocks);
  void add_triangles(double skin);
  void add_triangle(const Edge &pair, double distance, double skin);
  void add_edges(double skin);
  void add_edge_pair(const Edge &pair, double distance, double skin);

  const Model *model_;
  LeafSoA *leaves_;
  const RestDistanceFilter *rest_distance_filter_;
  SweptBvh *bvh_;
  double thickness_, longest_barrier_;
  BlockMotion motion_;
  BlockPairs pairs_;
  std::vector<uint8_t> expired_;  // of each pair of blocks
  std::vector<VerletTriangle> triangles_, old_triangles_;
  std::vector<VerletEdges> edges_, old_edges_;
  FoundPairs found_;
  DistanceBatch batch_;
};

}  // namespace mvs::core
