// A triangle sheet under half-edge collapses and edge flips. Vertices do not move.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

class LiveSheet {
 public:
  explicit LiveSheet(const Model &model);

  const std::vector<uint32_t> &star(uint32_t vertex) const { return star_[vertex]; }
  const Tri &triangle(uint32_t t) const { return triangles_[t]; }
  const std::vector<Tri> &triangles() const { return triangles_; }
  static bool is_gone(const Tri &triangle) { return triangle[0] == none; }
  const Vec3 &at(uint32_t vertex) const { return x_[vertex]; }

  // The neighbours of a vertex, ascending, and those along feature lines: boundaries, borders of
  // leaflets and scallops. A vertex inside a scallop has no neighbour along lines, one on a line
  // has two, junctions and ends of lines have another number.
  struct Ring {
    std::vector<uint32_t> all, along_lines;
  };
  // Sets `ring`, the memory of which is used again, to that of a vertex.
  void find_ring(uint32_t vertex, Ring &ring);

  // Returns the quality of the worst new triangle if `gone`, which has these neighbours, is merged
  // into `kept`; negative if that is not allowed: the sheet stays manifold with the same boundaries
  // and scallops, and no triangle folds over, gets poor, has all corners prescribed, or joins
  // annulus and free edge.
  double collapse_quality(uint32_t gone, const Ring &ring, uint32_t kept);
  void collapse(uint32_t gone, uint32_t kept);

  // Flips sides around a vertex, and from there on, as long as the worse of two triangles improves.
  void flip_around(uint32_t vertex);

  // 1 for an equilateral triangle, 0 for a flat one.
  double quality(const Tri &triangle) const;

 private:
  struct Pair {
    uint32_t count = 0;  // number of triangles at a side
    std::array<uint32_t, 2> triangle = {none, none};
  };
  // The number of triangles at the side to a neighbour, 1 on every feature line, and the scallop of
  // the first of them.
  struct Beside {
    uint32_t triangles, scallop;
  };
  Pair at_side(uint32_t a, uint32_t b) const;
  bool joined(uint32_t a, uint32_t b) const;
  Vec3 normal(const Tri &triangle) const;
  bool too_stiff(const Tri &triangle) const;
  bool link_holds(uint32_t gone, const Ring &ring, uint32_t kept);
  bool flip(const Edge &side, const Pair &pair);
  bool flip_helps(uint32_t t, uint32_t u, const std::array<Tri, 2> &made) const;
  void put(uint32_t t, const Tri &triangle);
  void drop_from_star(uint32_t vertex, uint32_t triangle);

  const std::vector<Vec3> &x_;
  const std::vector<uint32_t> &scallop_;
  std::vector<Tri> triangles_;
  std::vector<double> quality_;  // of each triangle
  std::vector<Vec3> normal_;     // the same
  std::vector<std::vector<uint32_t>> star_;
  std::vector<uint32_t> scallop_size_;  // number of remaining triangles
  std::vector<uint8_t> rim_;            // 1: annulus, 2: free edge
  // work of find_ring(), link_holds() and flip_around()
  std::vector<Beside> beside_;
  std::vector<uint64_t> mark_of_;  // of each vertex: the mark that it got last
  uint64_t mark_ = 0;
  std::vector<Edge> sides_;
};

}  // namespace mvs::core
