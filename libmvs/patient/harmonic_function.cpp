// Finite elements with cotangent weights; conjugate gradients with the diagonal as preconditioner
// (Saad 2003, algorithm 9.1).
#include "patient/harmonic_function.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>

#include "model/sides.h"

namespace mvs::core {
namespace {

// A symmetric weighted graph over the edges of the sheet.
struct EdgeWeights {
  std::vector<Edge> edge;
  std::vector<double> weight;
};

// Cotangent weights (Pinkall & Polthier 1993), at least 0.05 (1 / sqrt(3) for equilateral
// triangles), so that the maximum principle holds: no vertex inside is an extremum.
EdgeWeights cotangent_weights(const LeafletSheet &sheet) {
  constexpr double least = 0.05;
  EdgeWeights weights;
  const std::vector<Side> sides = sorted_sides(sheet.triangles);
  for_each_edge(sides, [&](size_t first, size_t last) {
    double sum = 0;
    for (size_t s = first; s < last; ++s) {
      const Tri &t = sheet.triangles[sides[s].triangle];
      const Vec3 &a = sheet.x[sides[s].edge[0]], &b = sheet.x[sides[s].edge[1]];
      const Vec3 &c = sheet.x[opposite_corner(t, sides[s].edge)];
      const double area = (a - c).cross(b - c).norm();
      if (area > 0) sum += 0.5 * (a - c).dot(b - c) / area;
    }
    weights.edge.push_back(sides[first].edge);
    weights.weight.push_back(std::clamp(sum, least, 1 / least));
  });
  return weights;
}

// Laplacian of `u`, zero where `held`.
void apply(const EdgeWeights &weights, const std::vector<uint8_t> &held,
           const std::vector<double> &u, std::vector<double> &out) {
  std::fill(out.begin(), out.end(), 0);
  for (size_t e = 0; e < weights.edge.size(); ++e) {
    const auto [i, j] = weights.edge[e];
    const double flow = weights.weight[e] * (u[i] - u[j]);
    out[i] += flow;
    out[j] -= flow;
  }
  for (size_t i = 0; i < out.size(); ++i) {
    if (held[i]) out[i] = 0;
  }
}

double dot(const std::vector<double> &a, const std::vector<double> &b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

void make_harmonic(const LeafletSheet &sheet, const std::vector<uint8_t> &held,
                   std::vector<double> &u) {
  const EdgeWeights weights = cotangent_weights(sheet);
  const size_t n = u.size();
  std::vector<double> diagonal(n, 0), residual(n), direction(n), image(n), scaled(n);
  for (size_t e = 0; e < weights.edge.size(); ++e) {
    for (const uint32_t i : weights.edge[e]) diagonal[i] += weights.weight[e];
  }
  apply(weights, held, u, residual);
  for (double &r : residual) r = -r;
  const auto precondition = [&] {
    for (size_t i = 0; i < n; ++i) scaled[i] = diagonal[i] > 0 ? residual[i] / diagonal[i] : 0;
  };
  precondition();
  direction = scaled;
  double product = dot(residual, scaled);
  // 1e-13 of the first residual: a rotated sheet gets the same lengths to 1 nm
  const double enough = 1e-26 * product;
  for (size_t k = 0; k < 10 * n && product > enough; ++k) {
    apply(weights, held, direction, image);
    const double step = product / dot(direction, image);
    for (size_t i = 0; i < n; ++i) {
      u[i] += step * direction[i];
      residual[i] -= step * image[i];
    }
    precondition();
    const double next = dot(residual, scaled);
    for (size_t i = 0; i < n; ++i) direction[i] = scaled[i] + next / product * direction[i];
    product = next;
  }
}

}  // namespace mvs::core
