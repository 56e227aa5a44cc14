// Read-outs as JSON and text, made from the library's descriptions of mvs_measures and mvs_cost.
#include "text/readouts.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

namespace cli {
namespace {

// A figure as it is shown.
struct Readout {
  mvs_field_info field;
  std::string key;   // in JSON, with its unit
  double scale = 1;  // from SI to that unit
  std::string unit;  // in text
  double text_scale = 1;
  bool is_count = false;

  template <typename Struct>
  double value(const Struct &figures) const {
    return mvs::field_value(&figures, field);
  }
};

Readout readout_of(const mvs_field_info &field) {
  Readout readout{field, field.name, 1, "%", 100, field.type == MVS_FIELD_COUNT};
  if (const ShownUnit *row = shown_unit(field.unit)) {
    readout.key += std::string("_") + row->unit;
    readout.scale = readout.text_scale = row->scale;
    readout.unit = row->unit;
  }
  return readout;
}

// All measures: counts first, then numbers, both in the order of mvs_measures.
const std::vector<Readout> &readouts() {
  static const std::vector<Readout> all = [] {
    std::vector<Readout> made;
    for (const mvs_field_info &field : mvs::fields_of(MVS_STRUCT_MEASURES))
      made.push_back(readout_of(field));
    std::stable_partition(made.begin(), made.end(), [](const Readout &r) { return r.is_count; });
    return made;
  }();
  return all;
}

// Cost of a repair: pressure drops in mmHg, and a ratio that is no percentage.
const std::vector<Readout> &cost_readouts() {
  static const std::vector<Readout> all = [] {
    std::vector<Readout> made;
    for (const mvs_field_info &field : mvs::fields_of(MVS_STRUCT_COST)) {
      Readout readout = readout_of(field);
      if (std::string_view(field.unit) == "Pa") {
        readout.key = std::string(field.name) + "_mmHg";
        readout.scale = readout.text_scale = 1 / pa_per_mmhg;
        readout.unit = "mmHg";
      } else if (*field.unit == 0) {
        readout.text_scale = 1;
        readout.unit = "";
      }
      made.push_back(readout);
    }
    return made;
  }();
  return all;
}

const char *sam_word(mvs_sam_risk risk) {
  if (risk == MVS_SAM_LOW) return "low";
  return risk == MVS_SAM_RAISED ? "raised" : "not determined";
}

bool is_orifice(const Readout &readout) {
  return readout.key == "regurgitant_orifice_area_mm2";
}

// Whether the measures are those of a valve at rest and under load: words in a table, not a row.
bool is_condition(const Readout &readout) {
  return readout.key == "at_rest" || readout.key == "under_load";
}

Json json_number(const Readout &readout, const mvs_measures &measures) {
  const double value = readout.value(measures);
  if (is_condition(readout)) return value != 0;
  if (readout.is_count) return static_cast<uint32_t>(value);
  return std::isfinite(value) ? Json(value * readout.scale) : Json();
}

bool is_in(const Readout &readout, mvs_measure_group_flags groups) {
  return readout.field.group == 0 || (readout.field.group & groups) != 0;
}

// The cells of one read-out of several valves.
std::string cells(const Readout &readout, const std::vector<const mvs_measures *> &valves) {
  std::string row = text("  %-27s", readout.field.label);
  for (const mvs_measures *measures : valves) {
    const double value = readout.value(*measures);
    if (readout.is_count) {
      row += text("%10u", static_cast<uint32_t>(value));
    } else {
      row +=
          std::isfinite(value) ? text("%10.2f", value * readout.text_scale) : text("%10s", "none");
    }
  }
  return row;
}

}  // namespace

const ShownUnit *shown_unit(const std::string &si) {
  static constexpr ShownUnit shown[] = {{"m", "mm", 1e3},  {"m2", "mm2", 1e6},
                                        {"m3", "ml", 1e6}, {"Pa", "kPa", 1e-3},
                                        {"N", "N", 1},     {"rad", "deg", 57.29577951308232}};
  for (const ShownUnit &row : shown) {
    if (si == row.si) return &row;
  }
  return nullptr;
}

// Grades by effective orifice area, 0.20, 0.30 and 0.40 cm2.
const char *leak_grade(const mvs_measures &measures) {
  if (measures.under_load == 0) return "no grade: no load";
  if (measures.at_rest == 0) return "no grade: not at rest";
  if (measures.intersections != 0) return "no grade: the leaflets cross";
  const double cm2 = measures.regurgitant_orifice_area * 1e4;
  if (cm2 == 0) return "sealed";
  if (cm2 < 0.2) return "mild";
  if (cm2 < 0.3) return "moderate";
  if (cm2 < 0.4) return "moderate to severe";
  return "severe";
}

const MeasureGroups &measure_groups() {
  static const MeasureGroups all = [] {
    MeasureGroups found;
    mvs_measure_group_flags seen = 0;
    for (const mvs_field_info &field : mvs::fields_of(MVS_STRUCT_MEASURES)) {
      if ((field.group & ~seen) == 0) continue;
      found.emplace_back(field.group_name, field.group);
      seen |= field.group;
    }
    return found;
  }();
  return all;
}

Json measures_json(const mvs_measures &measures, mvs_measure_group_flags groups) {
  Json object = Json::object();
  for (const Readout &readout : readouts()) {
    if (!is_in(readout, groups)) continue;
    if (readout.key != "intersections") object[readout.key] = json_number(readout, measures);
  }
  return object;
}

std::string measures_text(const mvs_measures &measures, mvs_measure_group_flags groups) {
  std::string table;
  for (const Readout &readout : readouts()) {
    if (is_condition(readout) || !is_in(readout, groups)) continue;
    table += cells(readout, {&measures});
    if (!readout.is_count && std::isfinite(readout.value(measures))) table += " " + readout.unit;
    if (is_orifice(readout)) {
      table += text(" (%s)", leak_grade(measures));
    }
    table += '\n';
  }
  return table;
}

std::string measures_text(const mvs_measures &before, const mvs_measures &after) {
  std::string table;
  for (const Readout &readout : readouts()) {
    if (is_condition(readout)) continue;
    table += cells(readout, {&before, &after});
    if (!readout.is_count) table += " " + readout.unit;
    if (is_orifice(readout)) {
      table += text(" (%s, then %s)", leak_grade(before), leak_grade(after));
    }
    table += '\n';
  }
  return table;
}

Json cost_json(const mvs_cost &cost) {
  Json object = Json::object();
  for (const Readout &readout : cost_readouts()) {
    const double value = readout.value(cost);
    Json &cell = object[readout.key];
    if (readout.key == "opened") {
      cell = value != 0;
    } else if (readout.key == "sam_risk") {
      cell = sam_word(cost.sam_risk);
    } else if (readout.is_count) {
      cell = static_cast<uint32_t>(value);
    } else {
      cell = number_json(value, readout.scale);
    }
  }
  return object;
}

Json figures_json(const mvs_measures &measures, const mvs_cost *cost) {
  Json figures = measures_json(measures);
  if (!cost) return figures;
  const Json costs = cost_json(*cost);
  for (const auto &[key, value] : costs.items()) {
    if (!figures.contains(key)) figures[key] = value;
  }
  return figures;
}

std::string cost_text(const mvs_cost &cost) {
  std::string table;
  for (const Readout &readout : cost_readouts()) {
    if (readout.key == "opened") continue;
    const double value = readout.value(cost);
    std::string cell = text("%.2f", value * readout.text_scale);
    if (readout.key == "sam_risk") {
      cell = sam_word(cost.sam_risk);
    } else if (readout.is_count) {
      cell = text("%u", static_cast<uint32_t>(value));
    } else if (!std::isfinite(value)) {
      cell = "not known";
    } else if (!readout.unit.empty()) {
      cell += " " + readout.unit;
    }
    table += text("  %-31s%16s\n", readout.field.label, cell.c_str());
  }
  return table;
}

Json statistics_json(const Statistics &of) {
  Json object = Json::object();
  for (const Readout &readout : readouts()) {
    const auto number = [&](const mvs_measures &m) { return json_number(readout, m); };
    Json &row = object[readout.key];
    row = {{"min", number(of.min)}, {"max", number(of.max)}};
    if (readout.is_count) continue;
    row["mean"] = number(of.mean);
    row["deviation"] = number(of.deviation);
    row["members"] = static_cast<uint32_t>(readout.value(of.count));
  }
  return object;
}

std::string measures_text(const mvs_measures &plain, const Statistics &of) {
  std::string table = text("  %-27s%10s%10s%10s%10s\n", "", "plain", "min", "max", "deviation");
  for (const Readout &readout : readouts()) {
    if (is_condition(readout)) continue;
    if (readout.is_count) {
      table += cells(readout, {&plain, &of.min, &of.max}) + '\n';
      continue;
    }
    table += cells(readout, {&plain, &of.min, &of.max, &of.deviation}) + " " + readout.unit;
    if (is_orifice(readout)) {
      const std::string least = leak_grade(of.min);
      const std::string most = leak_grade(of.max);
      table += least == most ? text(" (%s)", most.c_str())
                             : text(" (%s to %s)", least.c_str(), most.c_str());
    }
    table += '\n';
  }
  return table;
}

}  // namespace cli
