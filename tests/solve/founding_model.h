// The founding valve as a model of the core, and its state under systolic pressure.
#pragma once

#include "anatomy/parametric.h"
#include "model/model.h"
#include "solve/nodes.h"
#include "tests/founding.h"

namespace mvs::core::test {

inline ModelPtr founding_model(uint32_t vertices) {
  mvs_parametric_desc desc = founding_valve();
  desc.vertices = vertices;
  return make_model(make_parametric_valve(desc));
}

// Open, as nothing has moved yet.
inline State under_systole(const Model &model) {
  State state = initial_state(model);
  state.load = {MVS_SYSTOLE_PA, 1};
  return state;
}

}  // namespace mvs::core::test
