// Derivatives of measures whose gradient is not known.
#pragma once

#include <mvs/snapshot.h>

#include <array>

#include "sensitivity/parameters.h"
#include "sensitivity/tangent.h"

namespace mvs::core {

// Derivatives of measures along dx/dp, by central differences of the measures of the moved shape. A
// group of measures is taken once on each side, whatever the number of its fields that are asked
// for.
class MeasureDifferences {
 public:
  // `motion` is dx/dp. Keeps references to the model and the parameter.
  MeasureDifferences(const Model &model, const State &state, const Parameter &parameter,
                     const NodeField &motion);
  double of(const mvs_field_info &field);

 private:
  struct Side {
    double step;
    std::vector<Vec3> x;
    mvs_measures measures = {};
  };
  const Model &model_;
  const Parameter &parameter_;
  std::array<Side, 2> sides_;
  uint32_t groups_ = 0;  // those that are taken: MVS_MEASURE_GROUP_*
};

}  // namespace mvs::core
