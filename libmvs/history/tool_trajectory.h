// Tool trajectories: runs of time steps with the position of each moving tool before every step, in
// the compact form that the history keeps. A run stores one row of points per position and the
// number of steps that follow it; one step of one tool costs about 30 bytes (`bench_hand`).
#pragma once

#include "history/history.h"

namespace mvs::core {

// The number of points of a tool in a row: its position, and the axis of a rod or the
// orientation of a convex tool.
size_t points_of_tool(const Tool &tool);
size_t points_per_row(const RecordedEvent &trajectory);

// Returns the trajectory of one row: the tools move to `hands` (events tool_move), and `step`
// follows.
RecordedEvent trajectory_event(const std::vector<RecordedEvent> &hands, const RecordedEvent &step);

// Moves as many steps as fit from the front of `more` to the end of `run`. The count of `more` is 0
// afterwards if all of them fit. If an allocation fails, both are unchanged.
void append_steps(RecordedEvent &run, RecordedEvent &more);

// Returns `trajectory`, which follows `last`, with columns for the tools of `last` added, so that
// tools that move in turn share one run.
RecordedEvent with_tools_of(const RecordedEvent &last, RecordedEvent trajectory);

// Returns whether rows, tools and counts of a trajectory agree and its points are finite.
bool is_consistent(const RecordedEvent &trajectory);

// Moves the tools of a state to a row of a trajectory; throws MVS_E_ID if the state lacks a tool.
void apply_row(State &state, const RecordedEvent &trajectory, size_t row);

}  // namespace mvs::core
