// Checks of recorded events.
#include "history/event_limits.h"

#include <cmath>

#include "base/error.h"

namespace mvs::core {
namespace {

// "" for 0, the default, and for a value in its range.
std::string fault_of_option(const char *what, double value, const limits::Range &range) {
  if (value == 0 || (value >= range.least && value <= range.most)) return "";
  return format("%s is %g: it has to be 0 (the default) or %g to %g", what, value, range.least,
                range.most);
}

std::string fault_of_size(const char *what, double value, const limits::Range &range) {
  if (value >= range.least && value <= range.most) return "";
  return format("%s is %g: it has to be %g to %g", what, value, range.least, range.most);
}

std::string fault_of_load(const RecordedEvent &event) {
  if (!(std::abs(event.pressure) <= limits::pressure))
    return format("the pressure is %g Pa: it has to be within %g Pa", event.pressure,
                  limits::pressure);
  if (!(event.boundary_fraction >= 0 && event.boundary_fraction <= 1))
    return format("the boundary fraction is %g: it has to be 0 (open) to 1 (loaded)",
                  event.boundary_fraction);
  return "";
}

std::string fault_of_solver(const RecordedEvent &event) {
  const bool is_step = event.kind != RecordedEvent::settle;
  if (is_step && event.solver == SolverKind::newton)
    return "the solver of a step is newton: it has to be implicit or explicit";
  if (event.budget != 0 &&
      (event.budget < limits::least_budget || event.budget > limits::most_budget))
    return format("the budget is %u: it has to be 0 (the default) or %u to %u", event.budget,
                  limits::least_budget, limits::most_budget);
  for (std::string fault : {fault_of_option("the residual", event.residual, limits::residual),
                            fault_of_option("dt", event.dt, limits::dt),
                            fault_of_option("the damping", event.damping, limits::damping)}) {
    if (!fault.empty()) return fault;
  }
  return "";
}

std::string fault_of_place(const Vec3 &place) {
  if ((place.cwiseAbs().array() <= limits::coordinate).all()) return "";
  return format("the position is (%g, %g, %g) m: each has to be a number within %g", place.x(),
                place.y(), place.z(), limits::coordinate);
}

}  // namespace

std::string fault_of(const Tool &tool) {
  constexpr double least = 1e-12;  // of a device's own tool
  std::string fault = fault_of_place(tool.position);
  if (fault.empty())
    fault = fault_of_size("the stiffness", tool.stiffness, {least, limits::tool_stiffness.most});
  if (fault.empty())
    fault =
        fault_of_size("the largest force", tool.max_force, {least, limits::tool_max_force.most});
  if (fault.empty() && (tool.kind == ToolKind::ball || tool.kind == ToolKind::rod))
    fault = fault_of_size("the radius", tool.radius, limits::tool_radius);
  if (fault.empty() && tool.kind == ToolKind::rod)
    fault = fault_of_size("the length", tool.length, limits::rod_length);
  return fault;
}

std::string fault_of(const RecordedEvent &event) {
  switch (event.kind) {
    case RecordedEvent::load:
      return fault_of_load(event);
    case RecordedEvent::settle:
    case RecordedEvent::step:
    case RecordedEvent::tool_trajectory:
      return fault_of_solver(event);
    case RecordedEvent::tool_add:
      return event.tools.empty() ? "" : fault_of(event.tools.get()[0]);
    case RecordedEvent::tool_move:
      return event.tools.empty() ? "" : fault_of_place(event.tools.get()[0].position);
    case RecordedEvent::tool_remove:
      break;
  }
  return "";
}

}  // namespace mvs::core
