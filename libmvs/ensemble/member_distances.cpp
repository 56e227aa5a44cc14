// Distances of pairs of members, and groups of near ones.
#include "ensemble/member_distances.h"

#include <algorithm>
#include <cmath>

#include "ensemble/shape_distances.h"
#include "measure/comparison/compare.h"

namespace mvs::core {
namespace {

using Shapes = std::vector<const std::vector<Vec3> *>;

void compare_nodes(const Model &model, const Shapes &shapes, const std::vector<uint8_t> &at_rest,
                   double tolerance, MemberDistances &found) {
  const size_t size = shapes.size();
  found.pair_rms.assign(size * size, 0);
  std::vector<double> farthest(size * size, 0);
  double squares = 0, pairs = 0;
  for (size_t a = 0; a < size; ++a) {
    for (size_t b = a + 1; b < size; ++b) {
      const Apart apart = nodes_apart(model, *shapes[a], *shapes[b]);
      found.pair_rms[a * size + b] = found.pair_rms[b * size + a] = apart.rms;
      farthest[a * size + b] = farthest[b * size + a] = apart.max;
      if (a == 0) {
        found.rows[b].node_rms = apart.rms;
        found.rows[b].node_max = apart.max;
      }
      if (!at_rest[a] || !at_rest[b]) continue;
      squares += apart.rms * apart.rms;
      ++pairs;
      found.node_max = std::max(found.node_max, apart.max);
    }
  }
  if (pairs > 0) found.node_rms = std::sqrt(squares / pairs);
  const std::vector<uint32_t> equilibrium = find_equilibria(farthest, at_rest, tolerance);
  for (size_t k = 0; k < size; ++k) {
    found.rows[k].equilibrium = equilibrium[k];
    if (at_rest[k]) found.equilibria = std::max(found.equilibria, equilibrium[k] + 1);
  }
}

void compare_surfaces(const Model &model, const Shapes &shapes, const std::vector<uint8_t> &at_rest,
                      MemberDistances &found) {
  double squares = 0, others = 0;
  for (size_t k = 1; k < shapes.size(); ++k) {
    const Comparison to_first = compare_shapes(model, *shapes[0], model, *shapes[k]);
    found.rows[k].surface_rms = to_first.surface_rms;
    found.rows[k].surface_max = to_first.surface_max;
    if (!at_rest[k] || !at_rest[0]) continue;
    squares += to_first.surface_rms * to_first.surface_rms;
    ++others;
    found.surface_max = std::max(found.surface_max, to_first.surface_max);
  }
  if (others > 0) found.surface_rms = std::sqrt(squares / others);
}

}  // namespace

MemberDistances member_distances(const Model &model, const Shapes &shapes,
                                 const std::vector<uint8_t> &at_rest, double tolerance) {
  MemberDistances found;
  found.rows.resize(shapes.size());
  compare_nodes(model, shapes, at_rest, tolerance, found);
  compare_surfaces(model, shapes, at_rest, found);
  Shapes rest;
  for (size_t k = 0; k < shapes.size(); ++k) {
    if (at_rest[k]) rest.push_back(shapes[k]);
  }
  found.node_deviation = node_deviation(model.node_count(), rest);
  return found;
}

}  // namespace mvs::core
