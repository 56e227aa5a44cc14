// Parts of a skin whose triangles face parallel tissue, and which of them belong to one side.
#pragma once

#include "patient/skin/skin_sides.h"

namespace mvs::core {

// Thickness over the median up to which a ray passes one leaflet: two that touch and are one body
// are twice as thick.
inline constexpr double one_leaflet = 1.25;

// The same beyond which the ray runs along the leaflet, or the tissue is one of the thick parts,
// which sides_of() adds at the end.
inline constexpr double most_side_thickness = 3;

// 1 for triangles that face a parallel one, at most `most_side_thickness` times as far behind as
// the median.
std::vector<uint8_t> parallel_marks(const std::vector<Vec3> &normal,
                                    const std::vector<TissueBehind> &behind, double median);

// Takes the marks of triangles beside others without a mark. `joined`: the side of the other
// triangle for each side, or `none`.
std::vector<uint8_t> eroded(const std::vector<uint32_t> &joined, const std::vector<uint8_t> &marks);

// Gives triangles with a mark the side of a neighbour, ring by ring.
void grow_back(const std::vector<uint32_t> &joined, const std::vector<uint8_t> &marks, int rounds,
               std::vector<uint32_t> &side_of);

// The connected pieces of triangles with a mark, numbered; `none` for the others. Narrow bridges
// between sides, as noise makes them at a rim, are cut: the marks are eroded until hardly any piece
// lies behind itself at about the median thickness, and the pieces grow back.
std::vector<uint32_t> parallel_pieces(const LeafletSheet &skin, const std::vector<Vec3> &normal,
                                      const std::vector<TissueBehind> &behind, double median);

}  // namespace mvs::core
