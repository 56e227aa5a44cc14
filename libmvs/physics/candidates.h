// Which vertices and triangles, and which edges, could meet: the broad phase.
//
// A uniform grid over triangle boxes gives pairs of triangles; each vertex and edge is owned by one
// of its triangles, so that every vertex-triangle and edge-edge pair comes up once (representative
// triangles: Curtis, Tamstorf, Manocha, I3D 2008). A pair is kept if it is within its range of
// touching after every node has moved by its reach.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs {

// Ranges below are those of physics/contact.h.
struct VertexTriangle {
  uint32_t vertex, triangle;
  double guard;  // m, range of the pair's guard barrier
  bool facing;   // apart in the rest shape: takes part in contact proper
};

struct EdgeEdge {
  uint32_t first, second;  // edges, first < second
  double guard;            // m
};

class Candidates {
 public:
  explicit Candidates(const Model &model);

  // Makes the list for positions x, valid while no node is farther than its reach from there.
  void build(const std::vector<Vec3> &x, const std::vector<double> &reach);
  bool valid_for(const std::vector<Vec3> &x) const;
  void forget() { built_at_.clear(); }

  // Sorted by vertex, then triangle; by first, then second edge.
  const std::vector<VertexTriangle> &vertex_triangles() const { return vertex_triangles_; }
  const std::vector<EdgeEdge> &edge_edges() const { return edge_edges_; }

  double thickness() const { return thickness_; }

 private:
  void make_boxes(const std::vector<Vec3> &x);
  void make_triangle_pairs();
  void take_pair(const std::vector<Vec3> &x, uint32_t a, uint32_t b);
  void take_vertices(const std::vector<Vec3> &x, uint32_t owner, uint32_t triangle);
  void take_edges(const std::vector<Vec3> &x, uint32_t a, uint32_t b);

  const Model *model_;
  double thickness_;
  std::vector<uint32_t> vertex_owner_, edge_owner_;
  std::vector<double> reach_;
  std::vector<Vec3> built_at_, low_, high_;
  std::vector<Edge> triangle_pairs_;
  std::vector<VertexTriangle> vertex_triangles_;
  std::vector<EdgeEdge> edge_edges_;
};

}  // namespace mvs
