// Principal stretches from the deformation gradient of each triangle, principal stresses, and their
// percentiles.
#include "measure/tissue/strain.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/math.h"
#include "measure/tissue/triangle.h"

namespace mvs::core {
namespace {

// Eigenvalues of a symmetric matrix, larger first.
std::array<double, 2> principal(const Mat2 &m) {
  const double mean = 0.5 * (m(0, 0) + m(1, 1));
  const double radius = math::hypot(0.5 * (m(0, 0) - m(1, 1)), m(0, 1));
  return {mean + radius, mean - radius};
}

std::array<double, 2> principal_stretches(const Sides &rest, const Sides &now) {
  Mat2 from, to;
  from << rest.col(0), rest.col(2);
  to << now.col(0), now.col(2);
  const Mat2 f = to * from.inverse();
  const std::array<double, 2> squares = principal(f.transpose() * f);
  return {std::sqrt(squares[0]), std::sqrt(std::max(squares[1], 0.0))};
}

// Percentiles of the first column of `rows`, weighted by the rest area of the triangles: the
// smallest value that this share of the tissue does not exceed.
Percentiles percentiles_of(const std::vector<std::array<double, 2>> &rows, double offset,
                           const std::vector<double> &area) {
  std::vector<uint32_t> order(rows.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return rows[a][0] != rows[b][0] ? rows[a][0] < rows[b][0] : a < b;
  });
  double whole = 0;
  for (const uint32_t t : order) whole += area[t];
  Percentiles found;
  double sum = 0;
  for (const uint32_t t : order) {
    const double value = std::max(rows[t][0] - offset, 0.0);
    if (sum < 0.50 * whole) found.p50 = value;
    if (sum < 0.95 * whole) found.p95 = value;
    if (sum < 0.99 * whole) found.p99 = value;
    sum += area[t];
  }
  return found;
}

}  // namespace

Strain measure_strain(const Model &model, const std::vector<Vec3> &x) {
  const Valve &valve = model.valve;
  Strain strain;
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const Sides rest = sides_in_plane(valve.rest, valve.triangles[t]);
    const Sides now = sides_in_plane(x, valve.triangles[t]);
    strain.stretch.push_back(principal_stretches(rest, now));
    strain.stress.push_back(principal(cauchy_stress(valve, t, rest, now)));
    strain.max_strain = std::max(strain.max_strain, strain.stretch[t][0] - 1);
    strain.max_stress = std::max(strain.max_stress, strain.stress[t][0]);
    strain.leaflet_area += 0.5 * std::abs(now(0, 0) * now(1, 2));
  }
  strain.strain_percentiles = percentiles_of(strain.stretch, 1, model.rest_area);
  strain.stress_percentiles = percentiles_of(strain.stress, 0, model.rest_area);
  return strain;
}

}  // namespace mvs::core
