// Crossing triangles by the exact test of the core; the rest of the suite includes only
// include/mvs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace stability {

using Pair = std::array<uint32_t, 2>;

// Pairs of triangles that cross, sorted; x holds three numbers a node, corners three a triangle.
std::vector<Pair> crossings(const double *x, size_t nodes, const uint32_t *corners,
                            size_t triangles);

}  // namespace stability
