// Least squares at the corners of the curve.
#include "patient/annulus/curve_waves.h"

#include <array>
#include <numbers>
#include <utility>

#include "base/math.h"
#include "patient/fit/normal_equations.h"

namespace mvs::core {
namespace {

// Makes fewer corners than terms solvable; 1e-9 of the values is lost.
constexpr double ridge = 1e-9;

}  // namespace

CurveWaves::CurveWaves(ClosedCurve curve, const std::vector<Vec3> &values, size_t waves)
    : curve_(std::move(curve)), amplitude_(2 * waves + 1) {
  const size_t n = curve_.size(), count = amplitude_.size();
  DenseMatrix h(count);
  std::array<std::vector<double>, 3> right;
  right.fill(std::vector<double>(count, 0));
  for (size_t k = 0; k < n; ++k) {
    // half of both sides at the corner
    const double before = k == 0 ? curve_.start_of(n - 1) - length() : curve_.start_of(k - 1);
    const double weight = 0.5 * (curve_.start_of(k + 1) - before) / length();
    const std::vector<double> term = terms_at(curve_.start_of(k));
    for (size_t i = 0; i < count; ++i) {
      for (size_t j = 0; j < count; ++j) h.at(i, j) += weight * term[i] * term[j];
      for (size_t axis = 0; axis < 3; ++axis) {
        right[axis][i] += weight * term[i] * values[k][static_cast<Eigen::Index>(axis)];
      }
    }
  }
  for (size_t i = 0; i < count; ++i) h.at(i, i) += ridge;
  for (size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double> found = solve_dense(h, right[axis]);
    for (size_t i = 0; i < count; ++i) amplitude_[i][static_cast<Eigen::Index>(axis)] = found[i];
  }
}

Vec3 CurveWaves::at(double place) const {
  const std::vector<double> term = terms_at(place);
  Vec3 sum = Vec3::Zero();
  for (size_t i = 0; i < term.size(); ++i) sum += term[i] * amplitude_[i];
  return sum;
}

std::vector<double> CurveWaves::terms_at(double place) const {
  std::vector<double> term(amplitude_.size(), 1);
  for (size_t k = 1; 2 * k < term.size(); ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) * place / curve_.length();
    term[2 * k - 1] = math::cos(angle);
    term[2 * k] = math::sin(angle);
  }
  return term;
}

}  // namespace mvs::core
