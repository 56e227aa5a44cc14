// Marks by rays, erosion, connected pieces.
#include "patient/skin/skin_pieces.h"

#include <algorithm>

#include "model/sides.h"
#include "patient/surface/manifold.h"

namespace mvs::core {
namespace {

// Share of a skin that may lie behind its own piece: folds that touch.
constexpr double most_behind_itself = 0.03;
constexpr int most_erosions_of_pieces = 8;

std::vector<uint32_t> pieces_with_marks(const std::vector<uint32_t> &across,
                                        const std::vector<uint8_t> &marks) {
  std::vector<uint32_t> joined = across;
  for (uint32_t side = 0; side < joined.size(); ++side) {
    if (joined[side] == none) continue;
    if (marks[side / 3] == 0 || marks[joined[side] / 3] == 0) joined[side] = none;
  }
  std::vector<uint32_t> piece_of = pieces_of(joined);
  for (size_t t = 0; t < piece_of.size(); ++t) {
    if (marks[t] == 0) piece_of[t] = none;
  }
  return piece_of;
}

}  // namespace

std::vector<uint8_t> parallel_marks(const std::vector<Vec3> &normal,
                                    const std::vector<TissueBehind> &behind, double median) {
  std::vector<uint8_t> marks(behind.size(), 0);
  for (uint32_t t = 0; t < behind.size(); ++t) {
    const TissueBehind &b = behind[t];
    marks[t] = b.triangle != none && b.thickness <= most_side_thickness * median &&
               normal[t].dot(normal[b.triangle]) < -parallel_cosine;
  }
  return marks;
}

std::vector<uint8_t> eroded(const std::vector<uint32_t> &joined,
                            const std::vector<uint8_t> &marks) {
  std::vector<uint8_t> out = marks;
  for (uint32_t half_edge = 0; half_edge < joined.size(); ++half_edge) {
    if (joined[half_edge] == none || marks[joined[half_edge] / 3] == 0) out[half_edge / 3] = 0;
  }
  return out;
}

void grow_back(const std::vector<uint32_t> &joined, const std::vector<uint8_t> &marks, int rounds,
               std::vector<uint32_t> &side_of) {
  for (int round = 0; round < rounds; ++round) {
    const std::vector<uint32_t> before = side_of;
    for (uint32_t half_edge = 0; half_edge < joined.size(); ++half_edge) {
      const uint32_t t = half_edge / 3;
      if (joined[half_edge] == none || marks[t] == 0 || side_of[t] != none) continue;
      side_of[t] = before[joined[half_edge] / 3];
    }
  }
}

std::vector<uint32_t> parallel_pieces(const LeafletSheet &skin, const std::vector<Vec3> &normal,
                                      const std::vector<TissueBehind> &behind, double median) {
  const std::vector<uint8_t> marks = parallel_marks(normal, behind, median);
  const std::vector<uint32_t> across = join_sides(skin.x, skin.triangles).across;
  std::vector<uint8_t> kept = marks;
  for (int erosions = 0;; ++erosions) {
    std::vector<uint32_t> piece_of = pieces_with_marks(across, kept);
    double all = 0, wrong = 0;
    for (size_t t = 0; t < piece_of.size(); ++t) {
      if (piece_of[t] == none || behind[t].thickness > one_leaflet * median) continue;
      const double area = triangle_area(skin.x, skin.triangles[t]);
      all += area;
      if (piece_of[behind[t].triangle] == piece_of[t]) wrong += area;
    }
    if (wrong <= most_behind_itself * all || erosions == most_erosions_of_pieces) {
      grow_back(across, marks, 2 * erosions, piece_of);
      return piece_of;
    }
    kept = eroded(across, kept);
  }
}

}  // namespace mvs::core
