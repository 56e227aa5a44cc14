// The dimensions of a parametric valve: defaults filled in, ranges checked.
#pragma once

#include <mvs/valve.h>

#include <cstdint>

namespace mvs::core {

// mvs_parametric_desc without its zeros; lengths in m. Sources: README.md of this folder.
struct Dimensions {
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

// Throws MVS_E_ARGUMENT naming the field, its value and its range.
Dimensions resolve_dimensions(const mvs_parametric_desc &desc);

}  // namespace mvs::core
