#include "patient/annulus_waves.h"

#include <utility>

#include "base/math.h"
#include "patient/fit/normal_equations.h"

namespace mvs::core {
namespace {

constexpr double two_pi = 6.283185307179586;
// Makes fewer corners than terms solvable; 1e-9 of the displacement is lost.
constexpr double ridge = 1e-9;

}  // namespace

AnnulusWaves::AnnulusWaves(ClosedCurve curve, const std::vector<Vec3> &displacement)
    : curve_(std::move(curve)) {
  const size_t n = curve_.size();
  DenseMatrix h(terms);
  std::array<std::vector<double>, 3> right;
  right.fill(std::vector<double>(terms, 0));
  for (size_t k = 0; k < n; ++k) {
    // half of both sides at the corner
    const double before =
        k == 0 ? curve_.start_of(n - 1) - curve_.length() : curve_.start_of(k - 1);
    const double weight = 0.5 * (curve_.start_of(k + 1) - before) / curve_.length();
    const std::array<double, terms> wave = waves_at(curve_.start_of(k));
    for (size_t i = 0; i < terms; ++i) {
      for (size_t j = 0; j < terms; ++j) h.at(i, j) += weight * wave[i] * wave[j];
      for (size_t axis = 0; axis < 3; ++axis) {
        right[axis][i] += weight * wave[i] * displacement[k][static_cast<Eigen::Index>(axis)];
      }
    }
  }
  for (size_t i = 0; i < terms; ++i) h.at(i, i) += ridge;
  for (size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double> found = solve_dense(h, right[axis]);
    for (size_t i = 0; i < terms; ++i) amplitude_[i][static_cast<Eigen::Index>(axis)] = found[i];
  }
}

Vec3 AnnulusWaves::operator()(const Vec3 &p) const {
  const std::array<double, terms> wave = waves_at(curve_.nearest(p));
  Vec3 sum = Vec3::Zero();
  for (size_t i = 0; i < terms; ++i) sum += wave[i] * amplitude_[i];
  return sum;
}

std::array<double, AnnulusWaves::terms> AnnulusWaves::waves_at(double place) const {
  std::array<double, terms> wave{1};
  for (size_t k = 1; k <= most_waves; ++k) {
    const double angle = two_pi * static_cast<double>(k) * place / curve_.length();
    wave[2 * k - 1] = math::cos(angle);
    wave[2 * k] = math::sin(angle);
  }
  return wave;
}

}  // namespace mvs::core
