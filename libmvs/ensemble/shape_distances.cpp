// Node distances, deviations and equilibria of shapes.
#include "ensemble/shape_distances.h"

#include <algorithm>
#include <cmath>

namespace mvs::core {

Apart nodes_apart(const Model &model, const Shape &a, const Shape &b) {
  const Rows &rows = model.topology.node_triangles;
  double squares = 0, largest = 0;
  size_t count = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    if (rows.start[i + 1] == rows.start[i]) continue;
    const double square = (a[i] - b[i]).squaredNorm();
    squares += square;
    largest = std::max(largest, square);
    ++count;
  }
  if (count == 0) return {};
  return {std::sqrt(squares / static_cast<double>(count)), std::sqrt(largest)};
}

std::vector<double> node_deviation(size_t nodes, const std::vector<const Shape *> &shapes) {
  std::vector<double> deviation(nodes, 0);
  if (shapes.empty()) return deviation;
  const auto count = static_cast<double>(shapes.size());
  for (size_t i = 0; i < nodes; ++i) {
    // relative to the first shape, so that a node that never differs has a deviation of 0 exactly
    const Vec3 &origin = (*shapes[0])[i];
    Vec3 mean = Vec3::Zero();
    for (const Shape *shape : shapes) mean += ((*shape)[i] - origin) / count;
    double squares = 0;
    for (const Shape *shape : shapes) squares += ((*shape)[i] - origin - mean).squaredNorm();
    deviation[i] = std::sqrt(squares / count);
  }
  return deviation;
}

std::vector<uint32_t> find_equilibria(const std::vector<double> &farthest,
                                      const std::vector<uint8_t> &counts, double same) {
  const size_t size = counts.size();
  std::vector<uint32_t> number(size, none);
  std::vector<size_t> first;  // shape of each equilibrium
  for (size_t k = 0; k < size; ++k) {
    if (!counts[k]) continue;
    const auto found = std::find_if(first.begin(), first.end(),
                                    [&](size_t f) { return farthest[f * size + k] <= same; });
    number[k] = static_cast<uint32_t>(found - first.begin());
    if (found == first.end()) first.push_back(k);
  }
  return number;
}

}  // namespace mvs::core
