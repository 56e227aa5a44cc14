// Tissue that touches itself at rest, as two leaflets of a segmentation do where they stick
// together.
#pragma once

#include <cstddef>

#include "model/model.h"

namespace mvs::core {

// Vertices nearer than the contact thickness at rest to tissue that is not joined to them nearby.
struct TouchingTissue {
  size_t vertices = 0;
  uint32_t vertex = none, triangle = none;  // the nearest pair
  double distance = 0;                      // m, of that pair
};

// A triangle is joined to a vertex nearby if a way along the tissue leads from one to the other
// within joined_reach contact thicknesses of the vertex. Tissue with a common vertex, the sides of
// a fold and those of a cleft near its tip are; sides of a slit, leaflets and layers are not.
inline constexpr double joined_reach = 3;
TouchingTissue find_touching_tissue(const Model &model);

}  // namespace mvs::core
