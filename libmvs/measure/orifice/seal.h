// A quick proof that a valve is sealed, before the minimum cut is computed.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core::orifice {

// Returns true only if the leaflets close the valve: no ball of the contact thickness d passes from
// the atrium to the ventricle. False means "not proven".
//
// The proof is a zip along the coaptation: two curves p and q on the sheet, from a common point to
// a common point, whose points of the same time are never more than d apart. The segments between
// them form a disc, and each of its points is within d / 2 of the sheet. If the two curves together
// go around the valve once, then this disc and the sheet above it separate atrium and ventricle,
// and the centre of a ball of diameter d cannot cross them. The search covers valves whose sheet is
// a cylinder, with the annulus at one end and one free edge at the other.
bool is_zipped(const Model &model, const std::vector<Vec3> &x);

}  // namespace mvs::core::orifice
