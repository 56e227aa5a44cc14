// Sizes, ranges and tools of states; tools and numbers of events.
#include "formats/session/checks.h"

#include <cmath>

#include "base/error.h"
#include "base/utf8.h"
#include "history/event_limits.h"
#include "history/tool_trajectory.h"
#include "model/plausible.h"

namespace mvs::core {

void check_state(const ModelState &current) {
  const State &state = current.state;
  const size_t n = current.model->node_count();
  MVS_MUST(state.x.size() == n && state.v.size() == n, MVS_E_FORMAT, "state",
           "a state of the file has %zu positions and %zu velocities for %zu nodes", state.x.size(),
           state.v.size(), n);
  const std::vector<Vec3> &x = state.x, &v = state.v, &rest = current.model->valve.rest;
  for (size_t k = 0; k < n; ++k) {
    MVS_MUST(is_near_rest(x[k], rest[k]), MVS_E_FORMAT, "state",
             "in a state of the file node %zu is not at a number, or over %g m from its rest "
             "position",
             k, most_from_rest);
    MVS_MUST(is_speed(v[k]), MVS_E_FORMAT, "state",
             "in a state of the file the speed of node %zu is no number, or over %g m/s", k,
             most_speed);
  }
  MVS_MUST(std::abs(state.load.pressure) <= limits::pressure, MVS_E_FORMAT, "state",
           "a state of the file has a pressure of %g Pa, it has to be within %g Pa",
           state.load.pressure, limits::pressure);
  const double fraction = state.load.boundary_fraction;
  MVS_MUST(fraction >= 0 && fraction <= 1, MVS_E_FORMAT, "state",
           "a state of the file has a boundary fraction of %g, it has to be 0 to 1", fraction);
  MVS_MUST(state.rest_tolerance >= 0, MVS_E_FORMAT, "state",
           "a state of the file has a rest tolerance of %g N, it has to be 0 or more",
           state.rest_tolerance);
  for (const Tool &tool : state.tools) {
    MVS_MUST(is_valid(*current.model, tool), MVS_E_FORMAT, "state",
             "a state of the file has a tool that cannot be");
  }
}

void check_text(const std::string &text) {
  MVS_MUST(is_utf8(text), MVS_E_FORMAT, "mvs",
           "the file has a name that is not UTF-8, near \"%.63s\": names are UTF-8",
           only_utf8(text).c_str());
}

void check_event(const RecordedEvent &event) {
  const bool is_of_tool =
      event.kind >= RecordedEvent::tool_add && event.kind <= RecordedEvent::tool_remove;
  bool is_good = event.kind == RecordedEvent::tool_trajectory ? is_consistent(event)
                                                              : event.tools.size() == is_of_tool;
  for (const Tool &tool : event.tools.get()) {
    is_good = is_good && tool.kind >= ToolKind::grasp && tool.kind <= ToolKind::convex;
    if (event.kind == RecordedEvent::tool_add && tool.kind == ToolKind::convex)
      is_good = is_good && tool.shape;
  }
  MVS_MUST(is_good, MVS_E_FORMAT, "history",
           "the history of the file has an event whose tools and numbers do not agree");
  const std::string fault = fault_of(event);
  MVS_MUST(fault.empty(), MVS_E_FORMAT, "history", "an event of the history of the file: %s",
           fault.c_str());
}

}  // namespace mvs::core
