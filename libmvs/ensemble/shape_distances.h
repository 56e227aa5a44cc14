// How far the shapes that a valve can close to lie apart.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

using Shape = std::vector<Vec3>;  // positions of all nodes

// Node to node over the vertices of the leaflets, as they lie.
struct Apart {
  double rms = 0, max = 0;  // m
};
Apart nodes_apart(const Model &model, const Shape &a, const Shape &b);

// Of each node, the RMS distance from its mean place over the shapes; zeros without any.
std::vector<double> node_spread(size_t nodes, const std::vector<const Shape *> &shapes);

// Numbers the shapes by equilibrium, in the order in which these come up: a shape belongs to the
// first equilibrium from whose first shape no node of it is farther than `same`. `farthest` is the
// square matrix of the largest node distance between shapes; those that do not count are `none`.
// The largest distance and not a mean: one fold is a few nodes of many.
std::vector<uint32_t> find_equilibria(const std::vector<double> &farthest,
                                      const std::vector<uint8_t> &counts, double same);

}  // namespace mvs::core
