// The vertices, triangles and edges of a sheet in lanes, by the blocks of its tree: which of those
// of two blocks could come near each other on their ways. What is found is all that may be, and
// little more: boxes in single precision tell.
#pragma once

#include "collision/leaf_parts.h"
#include "geometry/swept_bvh.h"
#include "model/model.h"

namespace mvs::core {

class LeafSoA {
 public:
  // `parts` and `tree` of the same model; `apart` m at rest, see meet().
  LeafSoA(const Model &model, const SweptBvh &tree, const LeafParts &parts, double apart);

  // The ways of all nodes; what a block has is placed when it is asked for.
  void begin(const std::vector<Vec3> &from, const std::vector<Vec3> &to, StepMotion pace);
  void place(uint32_t block) {
    if (placed_[block] != round_) place_block(block);
  }
  const std::vector<SweptAabbF> &place_all();
  // The ways of all blocks, with nothing of what they have placed.
  const std::vector<SweptAabbF> &place_boxes();
  const SweptAabbF &way_of(uint32_t block) const { return way_[block]; }
  float margin(double margin) const { return float_margin(margin, farthest_); }

  // What could meet of two blocks that are placed, or of one and itself; margins from margin().
  // Vertices and triangles without them: those within `facing` that may be `apart` at rest, and
  // those within `guard` whatever they were. Edges, the lower one first, that share no node: those
  // within `guard`. Each pair comes once.
  void meet(uint32_t a, uint32_t b, float facing, float guard, std::vector<Edge> &triangles,
            std::vector<Edge> &edges) const;
  // How many pairs come of two blocks at most.
  static constexpr size_t most_pairs = size_t{3 * SweptAabb8::count} * 3 * SweptAabb8::count;

 private:
  template <typename T>
  using Lanes = std::array<T, SweptAabb8::count>;
  struct Triangles {
    SweptAabb8 way;
    Lanes<uint32_t> id;
    std::array<Lanes<int32_t>, 3> corner;
    std::array<Lanes<float>, 3> centre;  // at rest
  };
  struct Vertices {
    SweptAabb8 way;
    Lanes<uint32_t> id;
    std::array<Lanes<float>, 3> rest;
  };
  struct Edges {
    SweptAabb8 way;
    Lanes<uint32_t> id;
    std::array<Lanes<int32_t>, 2> end;
  };

  void add_block(uint32_t block, const SweptBvh &tree, const LeafParts &parts);
  void place_block(uint32_t block);
  template <typename Nodes>
  SweptAabbF narrow(const Nodes &nodes) const;
  void near_vertices(uint32_t of, uint32_t in, float facing, const float *guard,
                     std::vector<Edge> &pairs) const;
  void near_vertices(const Vertices &of, uint32_t in, float facing, const float *guard,
                     std::vector<Edge> &pairs) const;
  void near_edges(uint32_t a, uint32_t b, float margin, std::vector<Edge> &pairs) const;
  static void near_edges(const Edges &here, uint32_t of, const Edges &there, float margin,
                         std::vector<Edge> &pairs);
  static uint32_t with_corner(const Triangles &triangles, uint32_t vertex);
  static uint32_t sharing(const Edges &edges, const Edges &of, uint32_t lane);
  uint32_t maybe_apart(const Vertices &of, uint32_t lane, const Triangles &in) const;

  const Model *model_;
  float rest_margin_ = 0, surely_near2_ = 0;
  std::vector<Triangles> triangles_;                 // of each block
  std::vector<Vertices> vertices_;                   // by eight, those of a block together
  std::vector<Edges> edges_;                         //
  std::vector<uint32_t> vertex_start_, edge_start_;  // of each block
  std::vector<SweptAabbF> way_, rest_;               // of each block, on its way and at rest
  std::vector<SweptPointF> node_;
  StepMotion pace_ = StepMotion::together;
  double farthest_ = 0;
  uint64_t round_ = 0;
  std::vector<uint64_t> placed_;  // the round in which a block was
};

}  // namespace mvs::core
