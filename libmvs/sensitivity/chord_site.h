// The place of a chord's insertion as a parameter: it moves from its node i along an edge of the
// sheet to the node j at the other end, by s metres of unloaded tissue. With y the end of the
// chord,
//     y = x_i + s v,   v = (x_j - x_i) / L,   L the rest length of the edge,
// its tension T along the unit vector u pulls at both nodes, T u (1 - s / L) at i and T u s / L at
// j. The model has no chord that ends inside an edge: this is the derivative at s = 0.
#pragma once

#include "sensitivity/parameters.h"

namespace mvs::core {

struct ChordSite {
  uint32_t chord, node, toward, other;  // `other`: the other end of the chord
  double edge;                          // m, rest length
};

// Throws MVS_E_ARGUMENT, with the place of the parameter in its list, unless the chord has one end
// on a leaflet and an edge leads from there to the node `component`.
void check_chord_site(const Model &model, const Parameter &parameter, size_t place);
ChordSite chord_site(const Model &model, const Parameter &parameter);

// v at positions x.
Vec3 site_direction(const ChordSite &site, const std::vector<Vec3> &x);

// The derivative of dE/dx by s at free nodes.
std::vector<NodeVector> site_force(const Model &model, const std::vector<Vec3> &x,
                                   const Parameter &parameter);

// Adds the change of dE/dx that steps of sites make; `model` has the changes of the other
// parameters.
void add_site_change(const Model &model, std::span<const ParameterStep> steps,
                     const std::vector<Vec3> &x, std::vector<Vec3> &g);

}  // namespace mvs::core
