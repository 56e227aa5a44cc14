// Places on the leaflets: from a node, a point in a triangle, or anatomical coordinates, to a node.
#pragma once

#include "surgery/surgery.h"

namespace mvs::core {

// A point of the sheet.
struct SheetPoint {
  uint32_t triangle = none;
  std::array<double, 3> weight{};
};

// Throws MVS_E_ID or MVS_E_OP where a site names what is not there; finds no place, which costs.
void check_site(const Surgery &s, const mvs_site &site);

// Where a site is on the present valve; throws MVS_E_ID or MVS_E_OP where there is none.
SheetPoint locate(const Surgery &s, const mvs_site &site);

// The node at a site. A point in a triangle gets a node of its own, unless a corner that is no part
// of the annulus is nearer than a quarter of the triangle.
uint32_t node_at(Surgery &s, const mvs_site &site);

// A site in anatomical coordinates, to be found on another valve.
mvs_site anatomical(const Model &model, const mvs_site &site);

}  // namespace mvs::core
