// Sizes, ranges and tools of states; tools and numbers of events.
#include "formats/session/checks.h"

#include <mvs/tool.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/utf8.h"
#include "history/event_limits.h"
#include "history/tool_trajectory.h"
#include "model/plausible.h"
#include "model/text.h"

namespace mvs::core {
namespace {

constexpr uint64_t most_steps = uint64_t{1} << 53;  // 30,000 years at 10 kHz
constexpr uint64_t most_made = 1'000'000'000'000;   // tools; as in OBJ files

bool is_name(const std::string &name) {
  return !name.empty() && name.size() <= name_limit;
}

// The next tool gets the id after those of all tools that were ever added.
void check_tools(const ModelState &current) {
  const State &state = current.state;
  const std::vector<Tool> &tools = state.tools;
  MVS_MUST(tools.size() <= MVS_MAX_TOOLS && state.tools_made <= most_made, MVS_E_FORMAT, "state",
           "a state of the file has %zu tools of %llu ever added, which cannot be", tools.size(),
           static_cast<unsigned long long>(state.tools_made));
  std::set<Id> ids;
  for (const Tool &tool : tools) {
    MVS_MUST(is_valid(*current.model, tool), MVS_E_FORMAT, "state",
             "a state of the file has a tool that cannot be");
    const std::string fault = fault_of(tool);
    MVS_MUST(fault.empty(), MVS_E_FORMAT, "state", "a tool of a state of the file: %s",
             fault.c_str());
    MVS_MUST(tool.id >= first_tool_id && tool.id - first_tool_id < state.tools_made &&
                 ids.insert(tool.id).second,
             MVS_E_FORMAT, "state",
             "a state of the file has tool %llu, which is not one of the %llu that were added, or "
             "has it twice",
             static_cast<unsigned long long>(tool.id),
             static_cast<unsigned long long>(state.tools_made));
  }
}

void check_groups(const HistoryEntries &entries, uint64_t next_group) {
  MVS_MUST(next_group > 0, MVS_E_FORMAT, "history", "the next group of the file is 0");
  for (const auto *item : entries.items()) {
    const HistoryEntry &entry = **item;
    if (entry.group == 0) continue;
    MVS_MUST(entry.group < next_group && is_name(entry.group_name), MVS_E_FORMAT, "history",
             "the history of the file has group %llu with a name of %zu bytes: groups have numbers "
             "below the next one, %llu, and names of 1 to %zu bytes",
             static_cast<unsigned long long>(entry.group), entry.group_name.size(),
             static_cast<unsigned long long>(next_group), name_limit);
  }
}

bool is_session_array(std::string_view path) {
  if (path == "mvs/snapshot") return true;
  static constexpr std::string_view pools[] = {"parts", "numbers", "indices", "texts"};
  return std::any_of(std::begin(pools), std::end(pools), [&](std::string_view pool) {
    const std::string group = format("mvs/%s/", std::string(pool).c_str());
    return path == group + "values" || path == group + "ends";
  });
}

}  // namespace

void check_arrays(const H5Tree &tree) {
  for (const auto &member : tree.arrays) {
    const std::string &path = member.first;
    MVS_MUST(is_session_array(path), MVS_E_FORMAT, path,
             "the file has an array %s, which is not one of a session", path.c_str());
  }
}

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
  MVS_MUST(state.time >= 0 && state.steps <= most_steps, MVS_E_FORMAT, "state",
           "a state of the file has a time of %g s and %llu time steps: they have to be 0 to %llu",
           state.time, static_cast<unsigned long long>(state.steps),
           static_cast<unsigned long long>(most_steps));
  check_tools(current);
}

void check_history(const History &history) {
  check_groups(history.past, history.next_group);
  check_groups(history.future, history.next_group);
  if (!history.checkpoints) return;
  std::set<std::string> names;
  for (const Checkpoint &checkpoint : *history.checkpoints) {
    MVS_MUST(is_name(checkpoint.name), MVS_E_FORMAT, "history",
             "the file has a checkpoint whose name has %zu bytes, it has to have 1 to %zu",
             checkpoint.name.size(), name_limit);
    MVS_MUST(names.insert(checkpoint.name).second, MVS_E_FORMAT, "history",
             "the file has two checkpoints named \"%s\"", checkpoint.name.c_str());
    check_groups(checkpoint.past, history.next_group);
    check_groups(checkpoint.future, history.next_group);
  }
}

void check_text(const std::string &text) {
  MVS_MUST(is_utf8(text), MVS_E_FORMAT, "mvs",
           "the file has a name that is not UTF-8, near \"%.63s\": names are UTF-8",
           only_utf8(text).c_str());
  MVS_MUST(is_plain_text(text), MVS_E_FORMAT, "mvs",
           "the file has a name or title with a control character in it");
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
