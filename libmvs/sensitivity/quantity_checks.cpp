// Checks of the quantities that a caller names: kinds, ranges, and measures with a derivative.
#include <cstring>
#include <string>

#include "base/error.h"
#include "base/struct_fields.h"
#include "sensitivity/quantities.h"

namespace mvs::core {
namespace {

// A percentile is a value of single triangles in turn, and a count a whole number.
bool has_derivative(const mvs_field_info &field) {
  return field.type == MVS_FIELD_NUMBER && std::strstr(field.name, "_p50") == nullptr &&
         std::strstr(field.name, "_p95") == nullptr && std::strstr(field.name, "_p99") == nullptr;
}

}  // namespace

const mvs_field_info *find_measure(const char *name, size_t place) {
  MVS_MUST(name != nullptr, MVS_E_ARGUMENT, "quantities",
           "quantities[%zu].measure is a null pointer: give the name of a field of mvs_measures",
           place);
  std::string names;
  for (const mvs_field_info &field : struct_fields(MVS_STRUCT_MEASURES)) {
    if (!has_derivative(field)) continue;
    if (std::strcmp(field.name, name) == 0) return &field;
    names += names.empty() ? "" : ", ";
    names += field.name;
  }
  for (const mvs_field_info &field : struct_fields(MVS_STRUCT_MEASURES)) {
    MVS_MUST(std::strcmp(field.name, name) != 0, MVS_E_ARGUMENT, "quantities",
             "quantities[%zu]: %s is a count or a percentile and has no derivative", place, name);
  }
  fail(MVS_E_ARGUMENT, "quantities", "quantities[%zu]: no measure is named \"%s\"; there are %s",
       place, name, names.c_str());
}

void check_quantity(const Model &model, const Quantity &q, size_t place) {
  const Valve &valve = model.valve;
  MVS_MUST(q.kind >= QuantityKind::node_position && q.kind <= QuantityKind::measure, MVS_E_ARGUMENT,
           "quantities", "quantities[%zu].kind is %u: it has to be one of MVS_QUANTITY_*", place,
           static_cast<uint32_t>(q.kind));
  const bool of_node =
      q.kind == QuantityKind::node_position || q.kind == QuantityKind::node_distance;
  const bool of_chord =
      q.kind >= QuantityKind::chord_length && q.kind <= QuantityKind::chord_tension;
  size_t count = 1, components = 1;
  if (of_node) count = model.node_count();
  if (of_chord) count = valve.chords.size();
  if (q.kind == QuantityKind::head_force) count = valve.heads.size();
  if (q.kind == QuantityKind::node_position) components = 3;
  if (q.kind == QuantityKind::head_force) components = 4;
  MVS_MUST(q.index < count, MVS_E_ARGUMENT, "quantities",
           "quantities[%zu].index is %u: it has to be below %zu", place, q.index, count);
  MVS_MUST(q.component < components, MVS_E_ARGUMENT, "quantities",
           "quantities[%zu].component is %u: it has to be below %zu", place, q.component,
           components);
  MVS_MUST(q.point.allFinite(), MVS_E_ARGUMENT, "quantities", "quantities[%zu].point is not finite",
           place);
  if (q.kind != QuantityKind::linear) return;
  MVS_MUST(q.weights.size() == model.node_count(), MVS_E_ARGUMENT, "quantities",
           "quantities[%zu].weights has %zu rows, but the valve has %zu nodes", place,
           q.weights.size(), model.node_count());
  for (const Vec3 &w : q.weights) {
    MVS_MUST(w.allFinite(), MVS_E_ARGUMENT, "quantities", "quantities[%zu].weights are not finite",
             place);
  }
}

}  // namespace mvs::core
