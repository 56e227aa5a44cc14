// Splitting sides and triangles of the sheet: how operations make nodes where they need them.
#pragma once

#include "surgery/surgery.h"

namespace mvs::core {

// A node in a triangle, which becomes three.
uint32_t split_triangle(Surgery &s, uint32_t triangle, const std::array<double, 3> &weight);

// A node on the side from a to b, at a share of it; the triangles there become two each.
uint32_t split_side(Surgery &s, uint32_t a, uint32_t b, double share);

}  // namespace mvs::core
