// Splits of sides and triangles of the sheet, which give operations the nodes that they need.
#pragma once

#include "surgery/surgery.h"

namespace mvs::core {

// Adds a node inside a triangle, which becomes three; returns the node.
uint32_t split_triangle(Surgery &s, uint32_t triangle, const std::array<double, 3> &weight);

// Adds a node on the side from a to b, at a share of it; its triangles become two each. Returns the
// node.
uint32_t split_side(Surgery &s, uint32_t a, uint32_t b, double share);

}  // namespace mvs::core
