// Tool events as steps of a plan: tool_add, tool_move, tool_remove and tool_trajectory.
#pragma once

#include <initializer_list>
#include <optional>

#include "formats/text/json.h"
#include "history/history.h"

namespace mvs::core {

// With the model that it changes, a grasp has its place on the valve.
Json tool_json(const RecordedEvent &event, const Model *model);

// The tools and points of a trajectory; the caller adds the options of its time steps.
Json trajectory_json(const RecordedEvent &event);
RecordedEvent read_trajectory(const Json &json);

// Reads tool_add, tool_move and tool_remove; null for a step of another kind. Throws MVS_E_FORMAT
// with the wrong field.
std::optional<RecordedEvent> read_tool_step(const Json &json);

// Throws MVS_E_FORMAT if a step has a key other than "do" and the known ones.
void check_keys(const Json &json, std::initializer_list<std::string_view> known);

}  // namespace mvs::core
