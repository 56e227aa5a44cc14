// Pairs of the sheet that are near each other, kept while the sheet moves slowly: the broad phase
// of a live step.
//
// Each node has a place where it was last looked at and a skin around it, the thicker the faster it
// was. Kept is every pair that could act (see Candidates) without leaving its skins: nothing else
// has to be looked at before a node uses its skin up. Then the neighbourhood of such nodes is
// looked at again, not the whole sheet; and a few of the others in turn, so that those which move
// together do not all come up in the same step. (Lists with a skin: Verlet, Phys. Rev. 159, 1967.)
//
// Of a triangle or edge whose nodes are w from their places and go h to either side of the middles
// of their ways, w + h + slack has to be within its skin, the thickest of its nodes'. So a node may
// be skin_ - calm_ - slack from its place, and its skin is skin_, or more by what h is above
// calm_.
//
// What is kept depends on the way of the sheet; what Candidates takes of it does not.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs {

struct NearTriangle {
  uint32_t vertex, triangle;
  double guard;  // m, range of the guard
  bool faces;    // apart in the rest shape
};

struct NearEdges {
  uint32_t first, second;  // edges, first < second
  double guard;            // m
};

class NearPairs {
 public:
  explicit NearPairs(const Model &model);

  // Makes the lists hold every pair that could act while each node is within `slack` of its way,
  // given by its middle and its half. False if too many go too far for lists to be worth it.
  bool follow(const std::vector<Vec3> &middle, const std::vector<Vec3> &half, double slack);

  // Sorted by vertex, then triangle; by first edge, then second.
  const std::vector<NearTriangle> &triangles() const { return triangles_; }
  const std::vector<NearEdges> &edges() const { return edges_; }

 private:
  struct Box {
    std::array<double, 3> low, high;
  };
  struct Branch {
    Box box, rest;  // around the places of its nodes, in the rest shape
    bool moved;     // a node of it is looked at again
    uint32_t right, after, triangle;
  };

  double wanted(const Vec3 &half) const;
  bool too_fast(const std::vector<Vec3> &half) const;
  bool find_moved(const std::vector<Vec3> &middle, const std::vector<Vec3> &half, double room);
  template <typename Nodes>
  double extra_of(const Nodes &nodes) const;
  template <typename Nodes>
  Box box_of(const Nodes &nodes) const;
  void move_boxes();
  void forget_moved();
  template <typename Skip, typename Visit>
  void within(uint32_t i, double margin, const Skip &skip, const Visit &visit) const;
  template <typename Skip, typename Visit>
  void between(uint32_t i, uint32_t j, double margin, const Skip &skip, const Visit &visit) const;
  void find_facing();
  void find_guarded();
  void take_facing(uint32_t owner, uint32_t triangle);
  void take_guarded(uint32_t owner, uint32_t triangle);
  void take_edges(uint32_t a, uint32_t b);
  void take_edge_pair(uint32_t i, uint32_t j);
  bool apart_at_rest(uint32_t vertex, uint32_t triangle) const;
  void merge();

  const Model *model_;
  double thickness_, skin_, calm_;
  std::vector<uint32_t> sheet_;  // the nodes that are vertices of it, by place
  std::vector<uint32_t> vertex_start_, owned_vertex_;  // by triangle: the vertices that come up
  std::vector<uint32_t> edge_start_, owned_edge_;      // with it, and the edges
  std::vector<Branch> tree_;
  std::vector<Box> edge_box_;
  std::vector<Vec3> place_;    // of each node when it was last looked at; empty: never
  std::vector<double> extra_;  // m, of its skin, above skin_
  std::vector<uint8_t> moved_, triangle_moved_, edge_moved_;
  uint32_t turn_ = 0;  // where in sheet_ those come up that are looked at in turn
  std::vector<NearTriangle> triangles_, new_triangles_, all_triangles_;
  std::vector<NearEdges> edges_, new_edges_, all_edges_;
};

}  // namespace mvs
