// Into how many parts the side of a triangle is divided to sample coaptation.
#pragma once

#include <algorithm>
#include <cmath>

#include "model/model.h"

namespace mvs::core {

// Parts of at most half the contact thickness at rest, and at most twelve: a property of the model,
// so that no motion changes the samples.
inline size_t coaptation_parts(const Model &model, uint32_t triangle) {
  const Tri &c = model.valve.triangles[triangle];
  const std::vector<Vec3> &rest = model.valve.rest;
  double longest = 0;
  for (size_t k = 0; k < 3; ++k) {
    longest = std::max(longest, (rest[c[(k + 1) % 3]] - rest[c[k]]).norm());
  }
  const double parts = std::ceil(1.5 * longest / model.valve.contact_thickness);
  return static_cast<size_t>(std::clamp(parts, 1.0, 12.0));
}

}  // namespace mvs::core
