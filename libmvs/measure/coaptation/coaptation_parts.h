// Equal parts of triangles: how many to sample coaptation, and their centres.
#pragma once

#include <algorithm>
#include <array>
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

// Calls visit(centre) for the centre of each of the parts^2 equal parts of a triangle, as
// barycentric weights.
template <typename Visit>
void for_each_part(size_t parts, Visit visit) {
  const double n = 3 * static_cast<double>(parts);
  const auto centre = [&](size_t i, size_t j, double off) {
    const double u = (3 * static_cast<double>(i) + off) / n;
    const double v = (3 * static_cast<double>(j) + off) / n;
    visit(std::array<double, 3>{1 - u - v, u, v});
  };
  for (size_t i = 0; i < parts; ++i) {
    for (size_t j = 0; i + j < parts; ++j) {
      centre(i, j, 1);
      if (i + j + 1 < parts) centre(i, j, 2);
    }
  }
}

}  // namespace mvs::core
