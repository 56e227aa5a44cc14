// Structs of the C interface as the dataclasses of mvs.values.
#pragma once

#include <mvs/mvs.h>

#include "errors.h"

namespace mvs_python {

py::object load_value(const mvs_load_case &load);
py::object stats_value(const mvs_stats &stats);
py::object measures_value(const mvs_measures &measures);
py::object comparison_value(const mvs_comparison &comparison);
py::object frame_value(const double frame[12]);
py::object part_value(const mvs_part &part);
py::object replay_value(const mvs_replay &replay);
py::object chord_limits_value(double strain, double tension);
py::object history_value(const mvs_history_entry &entry, bool done);

}  // namespace mvs_python
