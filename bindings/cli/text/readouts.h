// The read-outs of mvs_measures with names and units, as JSON and as tables.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "text/console.h"

namespace cli {

// The groups of measures: their words and their bits, in the order of mvs_measures.
using MeasureGroups = std::vector<std::pair<std::string, mvs_measure_group_flags>>;
const MeasureGroups &measure_groups();
inline constexpr mvs_measure_group_flags all_measure_groups = ~mvs_measure_group_flags{0};

// The unit in which people read values of an SI unit, and the factor from SI.
struct ShownUnit {
  const char *si, *unit;
  double scale;
};
// The row of an SI unit ("m2": mm2, 1e6); null for numbers without a unit.
const ShownUnit *shown_unit(const std::string &si);

// Every read-out, named with its unit: {"regurgitant_orifice_area_mm2": 0.0, ...}. A read-out
// without a value, such as a coaptation length without coaptation, is null. Only those of the given
// groups, and those without a group.
Json measures_json(const mvs_measures &measures,
                   mvs_measure_group_flags groups = all_measure_groups);

// The same as a table, with the grade of the leak.
std::string measures_text(const mvs_measures &measures,
                          mvs_measure_group_flags groups = all_measure_groups);

// Two valves side by side.
std::string measures_text(const mvs_measures &before, const mvs_measures &after);

// Cost of a repair, in mm, mm2, mmHg and N: {"open_area_mm2": 606.7, ...}; null where it is not
// known.
Json cost_json(const mvs_cost &cost);
std::string cost_text(const mvs_cost &cost);

// Measures and, unless it is null, cost of one repair, each key once.
Json figures_json(const mvs_measures &measures, const mvs_cost *cost);

// Statistics of the members of an ensemble (mvs_ensemble_measure).
struct Statistics {
  mvs_measures mean, min, max, deviation, count;
};

// For every read-out {"mean": ..., "min": ..., "max": ..., "deviation": ..., "members": ...};
// counts have the range only.
Json statistics_json(const Statistics &statistics);

// The read-outs of one closure with their range and deviation beside them.
std::string measures_text(const mvs_measures &plain, const Statistics &statistics);

// The grade of the leak: "sealed", "mild", ...; the reason for no grade if the valve is not at rest
// or bears no pressure, or if leaflets cross.
const char *leak_grade(const mvs_measures &measures);

}  // namespace cli
