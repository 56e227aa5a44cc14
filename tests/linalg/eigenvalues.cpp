// Eigenvalues of small symmetric matrices, and their projection to a range, against the definition.
#include "linalg/eigenvalues.h"
#include "tests/about.h"

#include <doctest/doctest.h>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <random>

namespace mvs::core::test {
namespace {

// Entries between -1 and 1, rows and columns scaled by up to 10^decades.
template <typename Matrix>
Matrix random_symmetric(uint64_t seed, double decades) {
  std::mt19937_64 engine(seed);
  const auto number = [&] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1; };
  Matrix m;
  for (double &value : m.reshaped()) value = number();
  Eigen::Matrix<double, Matrix::RowsAtCompileTime, 1> scale;
  for (double &value : scale) value = std::pow(10.0, decades * number());
  m = (scale.asDiagonal() * (m + m.transpose()) * scale.asDiagonal()).eval();
  return 0.5 * (m + m.transpose());
}

// Backward error of a similarity of some 6 sweeps of 15 rotations, in units of the norm.
constexpr double rounding = 100 * std::numeric_limits<double>::epsilon();

template <typename Matrix>
void decomposition_holds(double decades) {
  for (uint64_t seed = 1; seed <= 300; ++seed) {
    const auto m = random_symmetric<Matrix>(seed, decades);
    const auto eigen = jacobi_eigen(m);
    const Eigen::Map<const Eigen::Matrix<double, Matrix::RowsAtCompileTime, 1>> values(
        eigen.values);
    const Matrix &v = eigen.vectors;
    REQUIRE((v * values.asDiagonal() * v.transpose() - m).norm() <= rounding * m.norm());
    REQUIRE((v.transpose() * v - Matrix::Identity()).norm() <= rounding);
    auto sorted = values.eval();
    std::sort(sorted.begin(), sorted.end());
    const auto expected = Eigen::SelfAdjointEigenSolver<Matrix>(m).eigenvalues().eval();
    REQUIRE((sorted - expected).norm() <= rounding * m.norm());
  }
}

TEST_CASE("symmetric_matrices_are_decomposed") {
  decomposition_holds<Mat3>(0);
  decomposition_holds<Mat6>(0);
  decomposition_holds<Mat3>(6);
  decomposition_holds<Mat6>(6);
}

TEST_CASE("equal_and_zero_eigenvalues_are_found") {
  const Vec3 axis = Vec3(1, 2, -2) / 3;
  const Mat3 projection = axis * axis.transpose();
  CHECK(largest_eigenvalue(projection) == about(1, rounding));
  CHECK(largest_eigenvalue(Mat3::Identity() - projection) == about(1, rounding));
  CHECK(std::abs(largest_eigenvalue(-projection)) < rounding);
  CHECK(largest_eigenvalue(Mat3::Zero()) == 0);
  CHECK(jacobi_eigen<Mat6>(Mat6::Zero()).vectors == Mat6::Identity());
}

TEST_CASE("matrices_in_the_range_keep_their_bits_and_others_are_projected") {
  for (uint64_t seed = 1; seed <= 100; ++seed) {
    const auto m = random_symmetric<Mat6>(seed, 0);
    CHECK(with_eigenvalues_in(m, -10, 10) == m);  // |eigenvalue| <= the sum of a row < 7
    const Mat6 clamped = with_eigenvalues_in(m, -0.5, 0.5);
    CHECK(clamped == clamped.transpose());
    const Eigen::SelfAdjointEigenSolver<Mat6> eigen(m);
    const Mat6 expected = eigen.eigenvectors() *
                          eigen.eigenvalues().cwiseMax(-0.5).cwiseMin(0.5).asDiagonal() *
                          eigen.eigenvectors().transpose();
    CHECK((clamped - expected).norm() <= rounding * m.norm());
  }
}

}  // namespace
}  // namespace mvs::core::test
