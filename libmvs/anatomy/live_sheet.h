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

  // Returns the neighbours of a vertex, ascending.
  std::vector<uint32_t> neighbours(uint32_t vertex) const;
  // Returns the neighbours along feature lines: boundaries, borders of leaflets and scallops. Zero
  // inside a scallop, two on a line, another number at junctions and ends of lines.
  std::vector<uint32_t> along_lines(uint32_t vertex, std::vector<uint32_t> neighbours) const;

  // Returns the quality of the worst new triangle if `gone` is merged into `kept`; negative if that
  // is not allowed: the sheet stays manifold with the same boundaries and scallops, and no triangle
  // folds over, gets poor, has all corners prescribed, or joins annulus and free edge.
  double collapse_quality(uint32_t gone, uint32_t kept) const;
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
  Pair at_side(uint32_t a, uint32_t b) const;
  bool on_line(uint32_t a, uint32_t b) const;
  bool joined(uint32_t a, uint32_t b) const;
  Vec3 normal(const Tri &triangle) const;
  bool too_stiff(const Tri &triangle) const;
  bool link_holds(uint32_t gone, uint32_t kept) const;
  bool flip(uint32_t a, uint32_t b);
  bool flip_helps(const std::array<Tri, 2> &old, const std::array<Tri, 2> &made) const;
  void drop_from_star(uint32_t vertex, uint32_t triangle);

  const std::vector<Vec3> &x_;
  const std::vector<uint32_t> &scallop_;
  std::vector<Tri> triangles_;
  std::vector<std::vector<uint32_t>> star_;
  std::vector<uint32_t> scallop_size_;  // number of remaining triangles
  std::vector<uint8_t> rim_;            // 1: annulus, 2: free edge
};

}  // namespace mvs::core
