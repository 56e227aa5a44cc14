// Converts structs of the C interface to the dataclasses of mvs.values.
#pragma once

#include <mvs/experimental.h>
#include <mvs/mvs.h>

#include "errors.h"

namespace mvs_python {

// MVS_SOLVER_* from "newton", "implicit" or "explicit".
uint32_t solver_of(const std::string &name);

py::object load_value(const mvs_load_case &load);
py::object cost_value(const mvs_cost &cost, py::object opened);
py::object stability_value(const mvs_stability &stability);
py::object stats_value(const mvs_stats &stats, const mvs_profile &profile);
py::object measures_value(const mvs_measures &measures);
// Statistics over several valves: at_rest and under_load are numbers of them.
py::object statistics_value(const mvs_measures &statistics);
py::object comparison_value(const mvs_comparison &comparison);
py::object coarsening_value(const mvs_coarsening &coarsening);
py::object frame_value(const double frame[12]);
py::object part_value(const mvs_part &part);
py::object replay_value(const mvs_replay &replay);
py::object chord_limits_value(double strain, double tension);
py::object history_value(const mvs_history_entry &entry, bool done);
py::object tool_value(const mvs_tool_state &tool);
py::object tool_body_value(const mvs_tool_body &body);
py::object ensemble_summary_value(const mvs_ensemble_summary &summary);
py::object ensemble_member_value(const mvs_ensemble_member &member, const mvs_stats &stats,
                                 const mvs_profile &profile);

// (name, unit, help) of every field of a struct of results, MVS_STRUCT_*.
py::list field_descriptions(uint32_t which);

// {word: MVS_MEASURE_GROUP_*} of the groups of measures.
py::dict measure_groups();

}  // namespace mvs_python
