// Plan of a resection: the cut line on the flattened leaflet.
#pragma once

#include <mvs/op.h>

#include "surgery/cutting/cut.h"

namespace mvs::core {

struct ResectPlan {
  Flat flat;
  std::vector<Vec2> line;  // from beyond the free edge to beyond the free edge
  uint32_t scallop = none;
  Vec3 annulus = Vec3::Zero();  // at rest, above the middle of the piece
  double depth = 0;             // m
  Vec2 out = Vec2::Zero();      // unit: out of the leaflet, across the ends of the line
  double bulge = 0;             // m, of the free edge between them, along `out`

  Outline outline() const;  // the line, closed beyond the free edge
};

// Plans a triangle or quadrangle of a scallop, or the outline of the caller; throws if it cannot be
// cut.
ResectPlan plan_resection(const Surgery &s, const mvs_op_resect &op);

}  // namespace mvs::core
