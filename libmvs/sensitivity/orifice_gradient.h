// Gradient of the regurgitant orifice area with respect to positions, by the envelope theorem: the
// orifice is a surface of least area, so to first order only the motion of its rim counts (first
// variation of area). The rim is taken as fixed in the tissue that it lies on.
//
// Its ends in narrow passages, where the gap is as wide as the contact thickness, wander with the
// gap and are not followed: this misses the growth of a slit at its ends. The measure itself moves
// in steps there (measure/DEFINITIONS.md).
#pragma once

#include "measure/orifice/orifice.h"
#include "sensitivity/tangent.h"

namespace mvs::core {

// Adds the gradient to g, m, and returns the area, m2; `orifice` is that of the positions x.
// `sheet`: nullable, a hierarchy of the triangles at any positions.
double orifice_area_gradient(const Model &model, const std::vector<Vec3> &x, const Orifice &orifice,
                             const BvhTopology *sheet, NodeField &g);

}  // namespace mvs::core
