// Sites on the leaflets: a node, a point in a triangle, or anatomical coordinates, resolved to a
// sheet point or node.
#pragma once

#include "surgery/surgery.h"

namespace mvs::core {

// A point of the sheet.
struct SheetPoint {
  uint32_t triangle = none;
  std::array<double, 3> weight{};
};

// Throws MVS_E_ID or MVS_E_OP if a site refers to a part that does not exist. Does not locate the
// site, which is expensive.
void check_site(const Surgery &s, const mvs_site &site);

// Returns the sheet point of a site on the present valve; throws MVS_E_ID or MVS_E_OP if there is
// no such point.
SheetPoint locate(const Surgery &s, const mvs_site &site);

// Returns the node at a site. A point in a triangle gets a new node, unless a corner off the
// annulus is nearer than a quarter of the triangle.
uint32_t node_at(Surgery &s, const mvs_site &site);

// Returns the vertex nearest to a site, by its weights in the triangle there; one off the annulus
// if the triangle has one. Makes no node.
uint32_t vertex_at(const Model &model, const mvs_site &site);

// Returns a site in anatomical coordinates, which are valid on other valves too.
mvs_site anatomical(const Model &model, const mvs_site &site);

}  // namespace mvs::core
