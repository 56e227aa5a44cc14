// Transport along the fibres of a sheet: the curves along the gradient of a function that is linear
// on each triangle.
#pragma once

#include <cstdint>
#include <vector>

#include "model/compressed_rows.h"
#include "patient/leaflet_sheet.h"

namespace mvs::core {

// The way of each vertex along its fibre to a held vertex, m, and the foot there.
struct FibreTransport {
  std::vector<double> length, foot;
};

// Carries a length and a foot along the fibres of u, from where `held`: values there stay. `sign`
// +1: the fibre of a vertex goes on to larger u; -1: to smaller. `stars` are the triangles around
// each vertex, `loop` the length after which feet repeat.
FibreTransport carry_along_fibres(const LeafletSheet &sheet, const std::vector<double> &u,
                                  const Rows &stars, double sign, const std::vector<uint8_t> &held,
                                  const std::vector<double> &foot, double loop);

}  // namespace mvs::core
