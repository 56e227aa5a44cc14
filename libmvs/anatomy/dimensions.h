// The dimensions of a parametric valve with defaults filled in and ranges checked.
#pragma once

#include <mvs/valve.h>

#include <cstdint>

#include "model/kinds.h"

namespace mvs::core {

inline constexpr double mm = 1e-3;  // m

enum class ParametricShape : uint32_t {
  healthy = MVS_SHAPE_HEALTHY,
  founding = MVS_SHAPE_FOUNDING
};

// mvs_parametric_desc with defaults in place of zeros; lengths in m. The values below are those of
// the founding shape. Sources: PARAMETRIC.md of this folder.
struct Dimensions {
  ParametricShape shape = ParametricShape::founding;
  LeafletLawId law = LeafletLawId::spring;
  uint32_t vertices = 425;
  uint32_t chords = 80;
  bool branching = false;
  double annulus_ap = 28e-3;
  double annulus_cc = 35e-3;
  double saddle_height = 5.5e-3;
  double anterior_height = 23e-3;
  double posterior_height = 13e-3;
  double commissure_height = 8e-3;
  double thickness = 1e-3;
  double papillary_depth = 23.5e-3;
  double papillary_separation = 20e-3;
  double annulus_contraction = 1;
  double annulus_scale = 1;
  double chord_slack = 1;
  double indentation_depth = 2.5e-3;
  double coaptation_depth = 5e-3;
};

// Throws MVS_E_ARGUMENT with the name, value and range of an invalid field.
Dimensions resolve_dimensions(const mvs_parametric_desc &desc);

}  // namespace mvs::core
