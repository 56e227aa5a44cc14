// Central differences over a fixed displacement of the fastest node, by groups of measures.
#include "sensitivity/measure_differences.h"

#include "base/struct_fields.h"
#include "measure/fields.h"
#include "sensitivity/linear_response.h"
#include "sensitivity/settings.h"

namespace mvs::core {

MeasureDifferences::MeasureDifferences(const Model &model, const State &state,
                                       const Parameter &parameter, const NodeField &motion)
    : model_(model), parameter_(parameter) {
  const double fastest = fastest_of(motion);
  const double step = fastest > 0 ? settings::sensitivity::measure_step / fastest : 0;
  for (size_t k = 0; k < 2; ++k) {
    Side &side = sides_[k];
    side.step = k == 0 ? step : -step;
    side.x = state.x;
    for (size_t i = 0; i < side.x.size(); ++i) side.x[i] += side.step * motion[i];
  }
}

double MeasureDifferences::of(const mvs_field_info &field) {
  if (sides_[0].step == 0) return 0;
  if ((groups_ & field.group) == 0) {
    groups_ |= field.group;
    for (Side &side : sides_) {
      const ParameterStep step{&parameter_, side.step};
      measure_group(changed_model(model_, {&step, 1}), side.x, field.group, side.measures);
    }
  }
  const double above = read_field(&sides_[0].measures, field);
  return (above - read_field(&sides_[1].measures, field)) / (2 * sides_[0].step);
}

}  // namespace mvs::core
