// Fixtures: convex tools and places on a valve for them.
#pragma once

#include <vector>

#include "model/model.h"
#include "tests/solve/bench.h"

namespace mvs::core::test {

// A convex tool of such bodies, with a spring of 200 N/m up to 2 N.
Tool convex_at(const Vec3 &position, std::vector<ToolBody> bodies);

// Bodies around the hand, of a rounding radius.
ToolBody ball_body(double radius);
// From the hand to both sides along a direction.
ToolBody capsule_body(const Vec3 &along, double length, double radius);
// An eight-sided cone with its apex at the hand, that widens along a direction.
ToolBody cone_body(const Vec3 &along, double length, double wide, double radius);
// A square bar of 4 mm x 1 mm x 1 mm along a direction, whose lower edge is at the hand.
ToolBody bar_body(const Vec3 &along, const Vec3 &up, double radius);
// Points of a Fibonacci lattice on a sphere.
ToolBody polyhedral_ball(double radius, uint32_t vertices);
// The hull of points.
ToolBody hull_body(std::vector<Vec3> points, double radius);

// A box around the hand.
ToolBody box_body(const Vec3 &half, double radius);
// A hook in the x z plane, open upwards: a shaft up from the hand, a bar to x = 3 mm, a tip of 2
// mm.
std::vector<ToolBody> hook_bodies(double radius);
// One of six kinds of tools of random size: cone, capsule, hull, bar, polyhedral ball, hook.
inline constexpr int tool_kinds = 6;
Tool random_tool(Random &random, int kind, const Vec3 &at);
// A tool of one capsule that contains bodies.
Tool bounding_capsule(const std::vector<ToolBody> &bodies);

// The middle of a triangle, lifted by a height, with its normal and the direction of an edge.
struct Place {
  Vec3 point, normal, along;
};
Place place_above(const Model &model, const std::vector<Vec3> &x, uint32_t triangle, double height);

}  // namespace mvs::core::test
