// Table of the edges of a cavity, from which a Delaunay insertion has removed the tetrahedra: it
// pairs the two new tetrahedra at each edge.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace mvs::core {

// The vertices of a cavity have numbers of their own, from 0.
class EdgeTable {
 public:
  struct Side {
    uint64_t edge;
    uint32_t tetrahedron, face;
  };

  // Begins a cavity with this many vertices.
  void clear(size_t vertices) {
    is_square_ = vertices <= largest_square;
    if (is_square_) {
      if (square_.empty()) square_.assign(largest_square * largest_square, Side{0, 0, 0});
      ++cavity_;
    } else {
      // a triangulated sphere has 3 (vertices - 2) edges
      slots_.assign(std::bit_ceil(6 * vertices + 1), Side{empty, 0, 0});
    }
  }
  // Returns the side stored at this edge, or stores this one and returns null.
  const Side *match(uint32_t a, uint32_t b, uint32_t tetrahedron, uint32_t face) {
    if (a > b) std::swap(a, b);
    return is_square_ ? match_in_square(a, b, tetrahedron, face)
                      : match_in_slots(uint64_t{a} << 32 | b, tetrahedron, face);
  }

 private:
  static constexpr uint64_t empty = UINT64_MAX;
  static constexpr size_t largest_square = 64;  // nearly all cavities have fewer vertices

  // An entry of an earlier cavity counts as empty.
  const Side *match_in_square(uint32_t a, uint32_t b, uint32_t tetrahedron, uint32_t face) {
    Side &side = square_[largest_square * a + b];
    if (side.edge == cavity_) return &side;
    side = {cavity_, tetrahedron, face};
    return nullptr;
  }
  const Side *match_in_slots(uint64_t edge, uint32_t tetrahedron, uint32_t face) {
    size_t slot = (edge * 0x9e3779b97f4a7c15u) >> 32;
    for (;; ++slot) {
      Side &side = slots_[slot & (slots_.size() - 1)];
      if (side.edge == edge) return &side;
      if (side.edge != empty) continue;
      side = {edge, tetrahedron, face};
      return nullptr;
    }
  }

  bool is_square_ = false;
  uint64_t cavity_ = 0;
  std::vector<Side> square_, slots_;
};

}  // namespace mvs::core
