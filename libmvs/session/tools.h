// Tools come and go, for calls at work on a simulator.
#pragma once

#include <mvs/tool.h>

#include "session/simulator.h"

namespace mvs::core {

// What a tool is made of, as tool.h says.
struct ToolSizes {
  double radius, length;        // m
  double stiffness, max_force;  // N/m, N
};

// With the defaults for what is zero; throws MVS_E_ARGUMENT for what is out of range, in the name
// of a struct of the interface.
ToolSizes read_tool_sizes(const ToolSizes &given, const std::string &of);
double read_reach(double given, double fallback, const std::string &of);

// A place within 10 m of the origin, and a unit direction; throw MVS_E_ARGUMENT.
Vec3 read_place(const double given[3], const char *what);
Vec3 read_axis(const double given[3], const char *what);

Id add_tool_now(mvs_sim &sim, const mvs_tool_desc &desc);
void remove_tool_now(mvs_sim &sim, Id id);

}  // namespace mvs::core
