// Test whether two parts of a surface keep apart during a linear motion. Unlike that of swept boxes
// its answer is the same in every frame of reference, up to rounding.
//
// Nodes that move together: the difference of a point of one part and a point of the other is, at
// any time, in the hull of the differences of their corners at the start and at the end. Nodes that
// move independently: each part stays in the hull of its corners at both ends. If these hulls keep
// more than a margin off the origin, or off each other, the parts never come as near as that.
//
// A gap between swept boxes (geometry/swept_aabb_batch.h) is a plane between the same hulls, normal
// to an axis. So parts that do not keep apart here have boxes near each other in every frame, and a
// search by boxes finds them all.
#pragma once

#include "collision/node_motion.h"

namespace mvs::core {

// Whether a vertex and a triangle, or two edges, keep more than `margin` (above 0 m) apart, where
// every node stays on its segment: a slack around it belongs to the margin, once for each part.
bool keep_apart(const NodeMotion &motion, uint32_t vertex, const Tri &triangle, double margin);
bool keep_apart(const NodeMotion &motion, const Edge &e, const Edge &f, double margin);

}  // namespace mvs::core
