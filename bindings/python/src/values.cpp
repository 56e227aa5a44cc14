#include "values.h"

#include <pybind11/numpy.h>
#include <mvs/base.hpp>

// One field of the C struct `s` as a keyword of the dataclass.
#define FIELD(name) py::arg(#name) = s.name

namespace mvs_python {
namespace {

using namespace py::literals;

template <typename... Fields>
py::object make_value(const char *type, Fields &&...fields) {
  return py::module_::import("mvs.values").attr(type)(std::forward<Fields>(fields)...);
}

py::array_t<double> matrix(const double *values, py::ssize_t rows, py::ssize_t columns) {
  py::array_t<double> array({rows, columns});
  std::copy(values, values + rows * columns, array.mutable_data());
  return array;
}

// The described fields of a struct of results as keywords of its dataclass.
py::dict keywords(const std::vector<mvs_field_info> &fields, const void *from) {
  py::dict found;
  for (const mvs_field_info &field : fields) {
    const double value = mvs::field_value(from, field);
    found[field.name] = field.type == MVS_FIELD_COUNT
                            ? py::object(py::int_(static_cast<uint32_t>(value)))
                            : py::object(py::float_(value));
  }
  return found;
}

py::dict measure_fields(const mvs_measures &s) {
  static const auto measures = mvs::fields_of(MVS_STRUCT_MEASURES);
  return keywords(measures, &s);
}

}  // namespace

py::list field_descriptions(uint32_t which) {
  py::list rows;
  for (const mvs_field_info &field : mvs::fields_of(which)) {
    rows.append(py::make_tuple(field.name, field.unit, field.help));
  }
  return rows;
}

py::dict measure_groups() {
  py::dict groups;
  for (const mvs_field_info &field : mvs::fields_of(MVS_STRUCT_MEASURES)) {
    if (field.group != 0) groups[field.group_name] = field.group;
  }
  return groups;
}

uint32_t solver_of(const std::string &name) {
  if (name == "newton") return MVS_SOLVER_NEWTON;
  if (name == "implicit") return MVS_SOLVER_IMPLICIT;
  if (name == "explicit") return MVS_SOLVER_EXPLICIT;
  refuse(MVS_E_ARGUMENT, "solver",
         "solver: \"newton\", \"implicit\" or \"explicit\" is needed, not \"" + name + "\"");
}

py::object load_value(const mvs_load_case &s) {
  return make_value("Load", FIELD(pressure), FIELD(boundary_fraction));
}

py::object stability_value(const mvs_stability &s) {
  return make_value("Stability", "stable"_a = s.stable != 0, FIELD(stiffness_margin),
                    FIELD(growth_rate));
}

// Descriptions are read once: every step returns two of these structs.
py::object stats_value(const mvs_stats &s, const mvs_profile &p) {
  static const auto stats = mvs::fields_of(MVS_STRUCT_STATS);
  static const auto profile = mvs::fields_of(MVS_STRUCT_PROFILE);
  py::dict fields = keywords(stats, &s);
  fields["converged"] = s.converged != 0;
  fields["stable"] = s.stable != 0;
  fields["profile"] = make_value("Profile", **keywords(profile, &p));
  return make_value("Stats", **fields);
}

py::object measures_value(const mvs_measures &s) {
  py::dict fields = measure_fields(s);
  fields["at_rest"] = s.at_rest != 0;
  fields["under_load"] = s.under_load != 0;
  return make_value("Measures", **fields);
}

py::object statistics_value(const mvs_measures &s) {
  return make_value("Measures", **measure_fields(s));
}

py::object cost_value(const mvs_cost &s, py::object opened) {
  static const auto cost = mvs::fields_of(MVS_STRUCT_COST);
  py::dict fields = keywords(cost, &s);
  fields["opened"] = s.opened != 0;
  fields["sam_risk"] = py::module_::import("mvs.kinds").attr("SamRisk")(s.sam_risk);
  fields["open_valve"] = std::move(opened);
  return make_value("Cost", **fields);
}

py::object comparison_value(const mvs_comparison &s) {
  return make_value("Comparison", "same_mesh"_a = s.same_mesh != 0, FIELD(node_rms),
                    FIELD(node_max), FIELD(surface_rms), FIELD(surface_max),
                    FIELD(node_rms_registered), FIELD(node_max_registered),
                    FIELD(surface_rms_registered), FIELD(surface_max_registered),
                    "registration"_a = matrix(s.registration, 3, 4));
}

py::object coarsening_value(const mvs_coarsening &s) {
  return make_value("Coarsening", FIELD(vertices_before), FIELD(vertices), FIELD(chords_moved),
                    FIELD(chords_merged), FIELD(chord_move), FIELD(surface_max), FIELD(surface_rms),
                    FIELD(worst_quality));
}

py::object frame_value(const double frame[12]) {
  return make_value("Frame", "origin"_a = py::array_t<double>(3, frame),
                    "axes"_a = matrix(frame + 3, 3, 3));
}

py::object part_value(const mvs_part &s) {
  return make_value("Part", FIELD(id),
                    "kind"_a = py::module_::import("mvs.kinds").attr("PartKind")(s.kind),
                    FIELD(index), FIELD(name));
}

py::object replay_value(const mvs_replay &s) {
  return make_value("Replay", FIELD(operations), "same_valve"_a = s.same_valve != 0,
                    "same_result"_a = s.same_result != 0);
}

py::object chord_limits_value(double strain, double tension) {
  return make_value("ChordLimits", "strain"_a = strain, "tension"_a = tension);
}

py::object history_value(const mvs_history_entry &s, bool done) {
  return make_value("HistoryEntry",
                    "kind"_a = py::module_::import("mvs.ops").attr("name_of_kind")(s.kind),
                    FIELD(title), "group"_a = s.group ? py::object(py::int_(s.group)) : py::none(),
                    "group_name"_a = s.in_group,
                    "made"_a = s.made ? py::object(py::int_(s.made)) : py::none(), "done"_a = done);
}

py::object tool_value(const mvs_tool_state &s) {
  const auto vector = [](const double v[3]) { return py::array_t<double>(3, v); };
  return make_value(
      "Tool", FIELD(id), "kind"_a = py::module_::import("mvs.kinds").attr("ToolKind")(s.kind),
      "position"_a = vector(s.position), "axis"_a = vector(s.axis), "proxy"_a = vector(s.proxy),
      "proxy_axis"_a = vector(s.proxy_axis), "force"_a = vector(s.force),
      "torque"_a = vector(s.torque), FIELD(distance), FIELD(radius), FIELD(length),
      FIELD(stiffness), FIELD(max_force),
      "node"_a = s.node == UINT32_MAX ? py::object(py::none()) : py::int_(s.node),
      "touching"_a = s.touching != 0, "orientation"_a = py::array_t<double>(4, s.orientation),
      "proxy_orientation"_a = py::array_t<double>(4, s.proxy_orientation), FIELD(body_count),
      FIELD(vertex_count));
}

// The arrays are copies.
py::object tool_body_value(const mvs_tool_body &s) {
  const auto rows = [](const mvs_view &view) { return static_cast<py::ssize_t>(view.count); };
  py::array_t<uint32_t> triangles({rows(s.triangles), py::ssize_t{3}});
  const auto *const corners = static_cast<const uint32_t *>(s.triangles.data);
  std::copy(corners, corners + 3 * s.triangles.count, triangles.mutable_data());
  return make_value(
      "ToolBody", "kind"_a = py::module_::import("mvs.kinds").attr("BodyKind")(s.kind),
      FIELD(radius),
      "vertices"_a = matrix(static_cast<const double *>(s.vertices.data), rows(s.vertices), 3),
      "triangles"_a = triangles);
}

py::object ensemble_summary_value(const mvs_ensemble_summary &s) {
  return make_value(
      "EnsembleSummary", FIELD(members), FIELD(converged), FIELD(equilibria),
      "lowest"_a = s.lowest == UINT32_MAX ? py::object(py::none()) : py::int_(s.lowest),
      FIELD(node_rms), FIELD(node_max), FIELD(surface_rms), FIELD(surface_max));
}

py::object ensemble_member_value(const mvs_ensemble_member &s, const mvs_stats &stats,
                                 const mvs_profile &profile) {
  return make_value("EnsembleMember", "converged"_a = s.converged != 0,
                    "diverged"_a = s.diverged != 0, FIELD(increments),
                    "order"_a = py::module_::import("mvs.kinds").attr("EnsembleOrder")(s.order),
                    "equilibrium"_a = s.equilibrium == UINT32_MAX ? py::object(py::none())
                                                                  : py::int_(s.equilibrium),
                    FIELD(perturbation), FIELD(node_rms), FIELD(node_max), FIELD(surface_rms),
                    FIELD(surface_max), FIELD(ramp), "stats"_a = stats_value(stats, profile));
}

}  // namespace mvs_python
