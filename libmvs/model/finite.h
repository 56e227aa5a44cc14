// Check that a state has finite numbers only.
#pragma once

#include "base/error.h"
#include "model/model.h"

namespace mvs::core {

// Throws MVS_E_DIVERGED if a position of a node or tool is infinite or NaN.
inline void must_be_finite(const State &state) {
  for (const Vec3 &x : state.x.get()) {
    MVS_MUST(x.allFinite(), MVS_E_DIVERGED, "nodes",
             "a node left the range of numbers: take a smaller time step or load");
  }
  for (const Tool &tool : state.tools.get()) {
    for (const Vec3 &point : tool.proxy) {
      MVS_MUST(point.allFinite(), MVS_E_DIVERGED, "tool",
               "a tool left the range of numbers: take a smaller time step or move it less");
    }
  }
}

}  // namespace mvs::core
