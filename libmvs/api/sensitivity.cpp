// Sensitivities: reads quantities and parameters, differentiates, keeps the result for its views.
#include <mvs/sensitivity.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "api/structs.h"
#include "sensitivity/sensitivity.h"
#include "session/snapshot.h"

using namespace mvs::core;

struct mvs_sensitivity {
  Sensitivity found;
  uint32_t quantities = 0, parameters = 0;
};

namespace {

constexpr uint32_t known_flags = MVS_SENSITIVITY_MOTION | MVS_SENSITIVITY_DIRECT |
                                 MVS_SENSITIVITY_NO_TEST | MVS_SENSITIVITY_NO_MARGIN;

SensitivityOptions read_options(const mvs_sensitivity_options *options) {
  const mvs_sensitivity_options given = read_struct_or_default(options, "options");
  MVS_MUST((given.flags & ~known_flags) == 0, MVS_E_ARGUMENT, "options.flags",
           "options.flags is %u: it has bits that this version does not know", given.flags);
  SensitivityOptions read;
  read.with_motion = (given.flags & MVS_SENSITIVITY_MOTION) != 0;
  read.direct = (given.flags & MVS_SENSITIVITY_DIRECT) != 0;
  read.tests = (given.flags & MVS_SENSITIVITY_NO_TEST) == 0;
  read.with_margin = (given.flags & MVS_SENSITIVITY_NO_MARGIN) == 0;
  if (given.progress) {
    read.progress = [given](double share, double residual) {
      return given.progress(given.user, share, residual) == 0;
    };
  }
  read.slack = or_default(given.slack, read.slack, 1e-9, 1e-3, "options.slack");
  return read;
}

mvs_parameter copy_parameter(const mvs_parameter &given) {
  return given;
}

mvs_quantity copy_quantity(const mvs_quantity &given) {
  return given;
}

std::vector<Parameter> read_parameters(const mvs_parameter *list, uint32_t count, uint32_t stride) {
  std::vector<Parameter> parameters;
  for (const mvs_parameter &given : read_list(list, count, stride, "parameters", copy_parameter)) {
    must_be_zero(given.reserved, "parameters.reserved");
    parameters.push_back({static_cast<ParameterKind>(given.kind), given.index, given.component,
                          read_points(given.mode, "parameters.mode")});
  }
  return parameters;
}

std::vector<Quantity> read_quantities(const mvs_snapshot &snapshot, const mvs_quantity *list,
                                      uint32_t count, uint32_t stride) {
  std::vector<Quantity> quantities;
  for (const mvs_quantity &given : read_list(list, count, stride, "quantities", copy_quantity)) {
    must_be_zero(given.reserved, "quantities.reserved");
    const bool is_measure = given.kind == MVS_QUANTITY_MEASURE;
    Quantity quantity = {static_cast<QuantityKind>(given.kind),
                         given.index,
                         given.component,
                         nullptr,
                         Vec3(given.point[0], given.point[1], given.point[2]),
                         read_points(given.weights, "quantities.weights")};
    if (is_measure) {
      quantity.measure = find_measure(given.measure, quantities.size());
      const bool is_orifice = std::strcmp(quantity.measure->name, "regurgitant_orifice_area") == 0;
      // kept by the snapshot, for its measures and for the next call
      if (is_orifice && snapshot.state.is_at_rest()) quantity.orifice = &snapshot.orifice();
    }
    quantities.push_back(std::move(quantity));
  }
  return quantities;
}

mvs_sensitivity_summary summary_of(const mvs_sensitivity &result) {
  constexpr mvs_sensitivity_notes rough = MVS_SENSITIVITY_NOTE_SWITCH | MVS_SENSITIVITY_NOTE_CHORD |
                                          MVS_SENSITIVITY_NOTE_CONTACT | MVS_SENSITIVITY_NOTE_KINK |
                                          MVS_SENSITIVITY_NOTE_SNAP;
  const auto is_smooth = [](const std::vector<mvs_sensitivity_notes> &notes) {
    return std::none_of(notes.begin(), notes.end(),
                        [](mvs_sensitivity_notes n) { return (n & rough) != 0; });
  };
  const Sensitivity &found = result.found;
  mvs_sensitivity_summary summary = {};
  summary.quantities = result.quantities;
  summary.parameters = result.parameters;
  summary.smooth = is_smooth(found.quantity_notes) && is_smooth(found.parameter_notes) ? 1 : 0;
  summary.adjoint_solves = found.adjoint_solves;
  summary.direct_solves = found.direct_solves;
  summary.weak_chords = static_cast<uint32_t>(found.weak_chords.size());
  summary.weak_contacts = static_cast<uint32_t>(found.weak_contacts.size()) + found.kinks;
  summary.residual = found.residual;
  summary.linear_error = found.linear_error;
  summary.stiffness_margin = found.stiffness_margin;
  return summary;
}

mvs_view rows_view(const std::vector<double> &values, uint32_t columns) {
  const uint64_t rows = columns == 0 ? 0 : values.size() / columns;
  return {values.data(), rows, columns, MVS_TYPE_F64, columns * sizeof(double)};
}

mvs_view rows_view(const std::vector<uint32_t> &values) {
  return {values.data(), values.size(), 1, MVS_TYPE_U32, sizeof(uint32_t)};
}

mvs_view array_of(const mvs_sensitivity &result, mvs_sensitivity_array which) {
  const Sensitivity &found = result.found;
  switch (which) {
    case MVS_SENSITIVITY_ARRAY_VALUE:
      return rows_view(found.value, 1);
    case MVS_SENSITIVITY_ARRAY_DERIVATIVE:
      return rows_view(found.derivative, result.parameters);
    case MVS_SENSITIVITY_ARRAY_ABOVE:
      return rows_view(found.above, result.parameters);
    case MVS_SENSITIVITY_ARRAY_BELOW:
      return rows_view(found.below, result.parameters);
    case MVS_SENSITIVITY_ARRAY_QUANTITY_NOTES:
      return rows_view(found.quantity_notes);
    case MVS_SENSITIVITY_ARRAY_PARAMETER_NOTES:
      return rows_view(found.parameter_notes);
    case MVS_SENSITIVITY_ARRAY_WEAK_CHORDS:
      return rows_view(found.weak_chords);
    case MVS_SENSITIVITY_ARRAY_WEAK_CONTACTS:
      return rows_view(found.weak_contacts);
    case MVS_SENSITIVITY_ARRAY_MOTION:
      return {found.motion.data(), found.motion.size(), 3, MVS_TYPE_F64, sizeof(Vec3)};
    default:
      fail(MVS_E_ARGUMENT, "which", "which is %u: it has to be one of MVS_SENSITIVITY_ARRAY_*",
           which);
  }
}

}  // namespace

extern "C" {

mvs_result mvs_sensitivity_run(const mvs_snapshot *snapshot, const mvs_quantity *quantities,
                               uint32_t quantity_count, uint32_t quantity_stride,
                               const mvs_parameter *parameters, uint32_t parameter_count,
                               uint32_t parameter_stride, const mvs_sensitivity_options *options,
                               mvs_sensitivity **sensitivity) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    must_point(sensitivity, "sensitivity");
    const SensitivityOptions how = read_options(options);
    const std::vector<Quantity> of =
        read_quantities(*snapshot, quantities, quantity_count, quantity_stride);
    const std::vector<Parameter> to =
        read_parameters(parameters, parameter_count, parameter_stride);
    auto result = std::make_unique<mvs_sensitivity>();
    result->found = differentiate(*snapshot->model, snapshot->state, of, to, how);
    result->quantities = quantity_count;
    result->parameters = parameter_count;
    *sensitivity = result.release();
  });
}

void mvs_sensitivity_release(mvs_sensitivity *sensitivity) {
  delete sensitivity;
}

mvs_result mvs_sensitivity_get_summary(const mvs_sensitivity *sensitivity,
                                       mvs_sensitivity_summary *summary) {
  return at_boundary([&] {
    must_point(sensitivity, "sensitivity");
    write_struct(summary, summary_of(*sensitivity), "summary");
  });
}

mvs_result mvs_sensitivity_get_array(const mvs_sensitivity *sensitivity,
                                     mvs_sensitivity_array which, mvs_view *view) {
  return at_boundary([&] {
    must_point(sensitivity, "sensitivity");
    must_point(view, "view");
    *view = array_of(*sensitivity, which);
  });
}

}  // extern "C"
