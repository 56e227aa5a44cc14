#include "values.h"

#include <pybind11/numpy.h>

// One field of the C struct `s` into the keywords of its dataclass, under the same name.
#define FIELD(name) fields[#name] = s.name

namespace mvs_python {
namespace {

py::object make(const char *type, const py::dict &fields) {
  return py::module_::import("mvs.values").attr(type)(**fields);
}

py::array_t<double> matrix(const double *values, py::ssize_t rows, py::ssize_t columns) {
  py::array_t<double> array({rows, columns});
  std::copy(values, values + rows * columns, array.mutable_data());
  return array;
}

// The fields of a struct of results as the library describes them: keywords of its dataclass.
py::dict fields_of(mvs_struct which, const void *from) {
  py::dict fields;
  mvs_field_info field{};
  field.struct_size = sizeof field;
  for (uint32_t k = 0; k < mvs_get_field_count(which); ++k) {
    must(mvs_get_field(which, k, &field));
    const char *at = static_cast<const char *>(from) + field.offset;
    if (field.type == MVS_FIELD_COUNT) {
      fields[field.name] = *reinterpret_cast<const uint32_t *>(at);
    } else {
      fields[field.name] = *reinterpret_cast<const double *>(at);
    }
  }
  return fields;
}

}  // namespace

py::list field_descriptions(uint32_t which) {
  py::list rows;
  mvs_field_info field{};
  field.struct_size = sizeof field;
  for (uint32_t k = 0; k < mvs_get_field_count(which); ++k) {
    must(mvs_get_field(which, k, &field));
    rows.append(py::make_tuple(field.name, field.unit, field.help));
  }
  return rows;
}

uint32_t solver_of(const std::string &name) {
  if (name == "newton") return MVS_SOLVER_NEWTON;
  if (name == "implicit") return MVS_SOLVER_IMPLICIT;
  if (name == "explicit") return MVS_SOLVER_EXPLICIT;
  refuse(MVS_E_ARGUMENT, "solver",
         "solver: \"newton\", \"implicit\" or \"explicit\" is needed, not \"" + name + "\"");
}

py::object load_value(const mvs_load_case &s) {
  py::dict fields;
  FIELD(pressure);
  FIELD(boundary_fraction);
  return make("Load", fields);
}

py::object stats_value(const mvs_stats &s, const mvs_profile &p) {
  py::dict fields = fields_of(MVS_STRUCT_STATS, &s);
  fields["converged"] = s.converged != 0;
  fields["profile"] = make("Profile", fields_of(MVS_STRUCT_PROFILE, &p));
  return make("Stats", fields);
}

py::object measures_value(const mvs_measures &s) {
  return make("Measures", fields_of(MVS_STRUCT_MEASURES, &s));
}

py::object comparison_value(const mvs_comparison &s) {
  py::dict fields;
  fields["same_mesh"] = s.same_mesh != 0;
  FIELD(node_rms);
  FIELD(node_max);
  FIELD(surface_rms);
  FIELD(surface_max);
  FIELD(node_rms_registered);
  FIELD(node_max_registered);
  FIELD(surface_rms_registered);
  FIELD(surface_max_registered);
  fields["registration"] = matrix(s.registration, 3, 4);
  return make("Comparison", fields);
}

py::object coarsening_value(const mvs_coarsening &s) {
  py::dict fields;
  FIELD(vertices_before);
  FIELD(vertices);
  FIELD(chords_moved);
  FIELD(chords_merged);
  FIELD(chord_move);
  FIELD(surface_max);
  FIELD(surface_rms);
  FIELD(worst_quality);
  return make("Coarsening", fields);
}

py::object frame_value(const double frame[12]) {
  py::dict fields;
  fields["origin"] = py::array_t<double>(3, frame);
  fields["axes"] = matrix(frame + 3, 3, 3);
  return make("Frame", fields);
}

py::object part_value(const mvs_part &s) {
  py::dict fields;
  FIELD(id);
  fields["kind"] = py::module_::import("mvs.values").attr("PartKind")(s.kind);
  FIELD(index);
  FIELD(name);
  return make("Part", fields);
}

py::object replay_value(const mvs_replay &s) {
  py::dict fields;
  FIELD(operations);
  fields["same_valve"] = s.same_valve != 0;
  fields["same_result"] = s.same_result != 0;
  return make("Replay", fields);
}

py::object chord_limits_value(double strain, double tension) {
  py::dict fields;
  fields["strain"] = strain;
  fields["tension"] = tension;
  return make("ChordLimits", fields);
}

py::object history_value(const mvs_history_entry &s, bool done) {
  py::dict fields;
  fields["kind"] = py::module_::import("mvs.ops").attr("name_of_kind")(s.kind);
  FIELD(title);
  fields["group"] = s.group ? py::object(py::int_(s.group)) : py::none();
  fields["group_name"] = s.in_group;
  fields["made"] = s.made ? py::object(py::int_(s.made)) : py::none();
  fields["done"] = done;
  return make("HistoryEntry", fields);
}

py::object tool_value(const mvs_tool_state &s) {
  const auto vector = [](const double v[3]) { return py::array_t<double>(3, v); };
  py::dict fields;
  FIELD(id);
  fields["kind"] = py::module_::import("mvs.values").attr("ToolKind")(s.kind);
  fields["position"] = vector(s.position);
  fields["axis"] = vector(s.axis);
  fields["proxy"] = vector(s.proxy);
  fields["proxy_axis"] = vector(s.proxy_axis);
  fields["force"] = vector(s.force);
  fields["torque"] = vector(s.torque);
  FIELD(distance);
  FIELD(radius);
  FIELD(length);
  FIELD(stiffness);
  FIELD(max_force);
  fields["node"] = s.node == UINT32_MAX ? py::object(py::none()) : py::int_(s.node);
  fields["touching"] = s.touching != 0;
  return make("Tool", fields);
}

py::object ensemble_summary_value(const mvs_ensemble_summary &s) {
  py::dict fields;
  fields["members"] = s.members;
  FIELD(converged);
  FIELD(equilibria);
  fields["lowest"] = s.lowest == UINT32_MAX ? py::object(py::none()) : py::int_(s.lowest);
  FIELD(node_rms);
  FIELD(node_max);
  FIELD(surface_rms);
  FIELD(surface_max);
  return make("EnsembleSummary", fields);
}

py::object ensemble_member_value(const mvs_ensemble_member &s, const mvs_stats &stats,
                                 const mvs_profile &profile) {
  py::dict fields;
  fields["converged"] = s.converged != 0;
  fields["diverged"] = s.diverged != 0;
  FIELD(increments);
  fields["order"] = py::module_::import("mvs.values").attr("EnsembleOrder")(s.order);
  fields["equilibrium"] =
      s.equilibrium == UINT32_MAX ? py::object(py::none()) : py::int_(s.equilibrium);
  FIELD(perturbation);
  FIELD(node_rms);
  FIELD(node_max);
  FIELD(surface_rms);
  FIELD(surface_max);
  FIELD(ramp);
  fields["stats"] = stats_value(stats, profile);
  return make("EnsembleMember", fields);
}

}  // namespace mvs_python
