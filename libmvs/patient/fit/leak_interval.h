// How much the leak of a built valve depends on the lengths of its chordae.
#pragma once

#include <array>

#include "model/model.h"
#include "patient/leaflet_sheet.h"

namespace mvs::core {

struct LeakInterval {
  std::array<double, 3> factor = {0.9, 1, 1.1};  // on all rest lengths
  std::array<double, 3> leak = {};               // m2, regurgitant orifice at 120 mmHg
  std::array<bool, 3> at_rest = {};              // whether the closure came to rest
  std::array<uint32_t, 3> iterations = {};       // of each closure
};

// Closes the valve from its open shape with each factor; the valve keeps its lengths.
LeakInterval leak_interval(const ModelPtr &model, Findings &findings);

}  // namespace mvs::core
