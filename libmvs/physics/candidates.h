// Which vertices and triangles, and which edges, could meet: the broad phase.
//
// Two lists by uniform grids. Facing pairs: a vertex and a triangle apart in the rest shape, within
// the contact thickness of each other. Guard pairs: every vertex and triangle, and every two edges,
// that are not incident and within their guard range. Each list also takes what could come that
// near while every node stays on its way: within `slack` of the segment from where it is to where a
// step would take it, wherever on it the others are. A sheet that moves across itself sweeps boxes
// that hardly meet their neighbours', where balls around its nodes would meet all of them. Vertices
// and edges are owned by one of their triangles, so that each guard pair comes up once
// (representative triangles: Curtis, Tamstorf, Manocha, I3D 2008).
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs {

struct VertexTriangle {
  uint32_t vertex, triangle;
  double guard;  // m, range of the guard; unused in facing pairs
};

struct EdgeEdge {
  uint32_t first, second;  // edges, first < second
  double guard;            // m
};

class Candidates {
 public:
  explicit Candidates(const Model &model);

  // Makes the lists for nodes on their way from x to `to`.
  void build(const std::vector<Vec3> &x, const std::vector<Vec3> &to, double slack);
  // Whether each node is on its way.
  bool valid_for(const std::vector<Vec3> &x) const;

  // Sorted by vertex, then triangle; edges by first, then second.
  const std::vector<VertexTriangle> &facing() const { return facing_; }
  const std::vector<VertexTriangle> &guarded() const { return guarded_; }
  const std::vector<EdgeEdge> &guarded_edges() const { return guarded_edges_; }

 private:
  void take_ways(const std::vector<Vec3> &x, const std::vector<Vec3> &to, double slack);
  std::array<Vec3, 2> box_of(const Tri &t) const;
  void make_boxes(double margin);
  bool stays(uint32_t node) const;
  void find_still();
  void find_guarded();
  void find_facing();
  void take_vertices(uint32_t owner, uint32_t triangle);
  void take_edges(uint32_t a, uint32_t b);
  bool apart_at_rest(uint32_t vertex, uint32_t triangle) const;
  double triangle_reach(uint32_t triangle) const;

  const Model *model_;
  double thickness_;
  std::vector<uint32_t> vertex_owner_, edge_owner_;
  std::vector<Vec3> rest_centre_;    // of each triangle
  std::vector<double> rest_radius_;  // from there to its farthest corner
  std::vector<uint32_t> sheet_;      // the nodes that are vertices of the sheet
  // of each node: its way, the box and the ball around it
  std::vector<Vec3> from_, to_, node_low_, node_high_, middle_;
  std::vector<double> reach_;
  double slack_ = 0;
  std::vector<uint8_t> still_;             // triangles that never move: nothing between two of them
  std::vector<Vec3> low_, high_, points_;  // boxes of the triangles, for the grid
  std::vector<Edge> pairs_;
  std::vector<VertexTriangle> facing_, guarded_;
  std::vector<EdgeEdge> guarded_edges_;
};

}  // namespace mvs
