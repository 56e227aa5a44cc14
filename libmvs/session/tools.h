// Description, addition and removal of tools, for the call at work.
#pragma once

#include <mvs/tool.h>

#include <limits>
#include <string>

#include "session/simulator.h"

namespace mvs::core {

// Sizes and limits of a tool, as in include/mvs/tool.h.
struct ToolSizes {
  double radius, length;        // m
  double stiffness, max_force;  // N/m, N
};

// Replaces zeros by defaults; throws MVS_E_ARGUMENT for a value out of range, with the name `of` of
// the public struct.
ToolSizes read_tool_sizes(const ToolSizes &given, const std::string &of);
double read_reach(double given, double fallback, const std::string &of);

// Reads a point with coordinates within limits::coordinate, and a direction, which is normalised;
// both throw MVS_E_ARGUMENT.
Vec3 read_place(const double given[3], const char *what);
Vec3 read_axis(const double given[3], const char *what);

// Multiplies a direction below the least normal number, which has too few digits for a length of 1,
// by a power of two.
template <typename Direction>
void scale_up_denormal(Direction &direction) {
  if (direction.cwiseAbs().maxCoeff() < std::numeric_limits<double>::min()) direction *= 0x1p+200;
}

// Throws MVS_E_ARGUMENT if a tool that pushes is far from the valve: its position is in mm, or of
// another frame.
void must_be_near(const Valve &valve, const Vec3 &place, const char *what);

// `shape`: of a convex tool, in place of the bodies of `desc`.
Id add_tool_now(mvs_sim &sim, const mvs_tool_desc &desc, const ToolShapePtr &shape = {});
void remove_tool_now(mvs_sim &sim, Id id);

}  // namespace mvs::core
