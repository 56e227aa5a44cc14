// Distances between the shapes of an ensemble, and their grouping into equilibria.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

using Shape = std::vector<Vec3>;  // positions of all nodes

// Distances of equal nodes over the vertices of the leaflets, without registration.
struct Apart {
  double rms = 0, max = 0;  // m
};
Apart nodes_apart(const Model &model, const Shape &a, const Shape &b);

// Returns for each node the RMS distance from its mean position over the shapes; zeros without
// shapes.
std::vector<double> node_deviation(size_t nodes, const std::vector<const Shape *> &shapes);

// Numbers the shapes by equilibrium, in order of appearance: a shape belongs to the first
// equilibrium from whose first shape no node is farther than `same`, m. `farthest` is the square
// matrix of the largest node distance between shapes; shapes that do not count get `none`. The
// largest distance decides, not a mean, because one fold is a few nodes of many.
std::vector<uint32_t> find_equilibria(const std::vector<double> &farthest,
                                      const std::vector<uint8_t> &counts, double same);

}  // namespace mvs::core
