// Extreme eigenvalues against Eigen's dense decompositions and columns under follower loads.
#include "linalg/extreme_eigenvalue.h"

#include <doctest/doctest.h>
#include <cmath>

#include <random>

#include "linalg/small_eigen.h"
#include "tests/about.h"
#include "tests/dense.h"

namespace mvs::core::test {
namespace {

class Numbers {
 public:
  explicit Numbers(uint64_t seed) : engine_(seed) {}
  double operator()() { return static_cast<double>(engine_() >> 11) * 0x1p-52 - 1; }
  Dense matrix(int n) {
    return Dense::NullaryExpr(n, n, [this] { return (*this)(); });
  }

 private:
  std::mt19937_64 engine_;
};

SmallMatrix small(const Dense &a) {
  SmallMatrix m(static_cast<size_t>(a.rows()));
  for (int r = 0; r < a.rows(); ++r) {
    for (int c = 0; c < a.cols(); ++c) m(static_cast<size_t>(r), static_cast<size_t>(c)) = a(r, c);
  }
  return m;
}

BlockVector rows_of(const Eigen::VectorXd &x) {
  BlockVector rows;
  for (int r = 0; r < x.size(); r += 3) rows.emplace_back(x.segment<3>(r));
  return rows;
}
Eigen::VectorXd flat(const BlockVector &rows) {
  Eigen::VectorXd x(3 * static_cast<int>(rows.size()));
  for (size_t r = 0; r < rows.size(); ++r) x.segment<3>(3 * static_cast<int>(r)) = rows[r];
  return x;
}

LinearMap product_with(const Dense &a) {
  return [a](const BlockVector &v, BlockVector &y) { y = rows_of(apply(a, flat(v))); };
}
LinearMap solution_with(const Dense &a) {
  return product_with(inverse(a));
}

std::complex<double> leftmost_of(const Dense &a) {
  const Eigen::VectorXcd values = eigenvalues(a);
  int k = 0;
  for (int i = 1; i < values.size(); ++i) {
    if (values[i].real() < values[k].real()) k = i;
  }
  return values[k];
}

// The leftmost eigenvalue of K v = kappa B v, its preconditioner the symmetric part of K.
Eigenpair leftmost(const Dense &k, const std::vector<double> &weight, uint32_t most = 60) {
  const Dense symmetric = 0.5 * (k + k.transpose());
  const double least = symmetric_eigenvalues(symmetric)[0];
  const Dense near = symmetric + std::max(0.0, 1 - least) * Dense::Identity(k.rows(), k.cols());
  const BlockVector start = rows_of(Eigen::VectorXd::LinSpaced(k.rows(), 1, 2));
  return leftmost_eigenvalue(product_with(k), solution_with(near), weight, {start}, {1e-8, most});
}

}  // namespace

TEST_CASE("the_smallest_eigenvalue_of_a_tridiagonal_matrix_is_that_of_dense_algebra") {
  Numbers numbers(1);
  for (int n = 1; n <= 40; n += 3) {
    std::vector<double> diagonal, beside;
    Dense a = Dense::Zero(n, n);
    for (int k = 0; k < n; ++k) {
      diagonal.push_back(a(k, k) = numbers());
      if (k + 1 < n) beside.push_back(a(k, k + 1) = a(k + 1, k) = numbers());
    }
    const SmallestEigen found = smallest_eigen(diagonal, beside);
    CHECK(found.value == about(symmetric_eigenvalues(a)[0], 1e-12));
    const Eigen::Map<const Eigen::VectorXd> v(found.vector.data(), n);
    CHECK((apply(a, v) - found.value * v).norm() < 1e-12);
    CHECK(v.norm() == about(1, 1e-14));
  }
}

TEST_CASE("the_leftmost_eigenvalue_of_a_small_matrix_is_that_of_dense_algebra") {
  Numbers numbers(2);
  for (int n = 1; n <= 30; ++n) {
    const Dense a = numbers.matrix(n);
    const LeftmostEigen found = leftmost_eigen(small(a));
    const std::complex<double> value = leftmost_of(a);
    CHECK(found.real == about(value.real(), 1e-9));
    CHECK(std::abs(found.imaginary - std::abs(value.imag())) < 1e-9 * std::abs(value));
    const Eigen::Map<const Eigen::VectorXd> re(found.vector_real.data(), n),
        im(found.vector_imaginary.data(), n);
    const double a_re = found.real, a_im = found.imaginary;
    CHECK((apply(a, re) - a_re * re + a_im * im).norm() < 1e-12 * n);
    CHECK((apply(a, im) - a_re * im - a_im * re).norm() < 1e-12 * n);
    CHECK(std::hypot(re.norm(), im.norm()) == about(1, 1e-14));
  }
}

TEST_CASE("equal_eigenvalues_and_zero_matrices_have_eigenvectors") {
  for (const int n : {2, 5}) {
    CHECK(leftmost_eigen(small(Dense::Zero(n, n))).real == 0);
    CHECK(leftmost_eigen(small(Dense::Identity(n, n))).real == about(1));
    // a Jordan block: one eigenvector only
    Dense jordan = Dense::Identity(n, n);
    for (int k = 0; k + 1 < n; ++k) jordan(k, k + 1) = 1;
    CHECK(leftmost_eigen(small(jordan)).real == about(1, 1e-6));
  }
  CHECK(std::abs(smallest_eigen({0, 0, 0}, {0, 0}).value) < 1e-12);
}

TEST_CASE("lanczos_finds_the_smallest_eigenvalue_of_a_large_matrix") {
  Numbers numbers(3);
  for (const int n : {3, 30, 150}) {
    const Dense factor = numbers.matrix(n);
    const Dense a = product(factor, factor.transpose()) + 1e-3 * Dense::Identity(n, n);
    const SymmetricEigen dense = symmetric_eigen(a);
    std::vector<BlockVector> basis;
    const Eigenpair found = smallest_eigenvalue(solution_with(a), rows_of(Eigen::VectorXd::Ones(n)),
                                                {1e-6, 100}, basis);
    CHECK(found.error <= 1e-6);
    CHECK(found.real == about(dense.values[0], 1e-9));
    const Eigen::VectorXd v = flat(found.vector);
    CHECK(std::abs(v.dot(dense.vectors.col(0))) == about(1, 1e-6));
    CHECK(basis.size() == found.iterations);
  }
}

TEST_CASE("a_part_without_start_is_left_out_by_lanczos") {
  Dense a = Dense::Identity(6, 6);
  a(5, 5) = 1e-9;
  a(0, 0) = 0.5;
  Eigen::VectorXd start = Eigen::VectorXd::Ones(6);
  start[5] = 0;
  std::vector<BlockVector> basis;
  const Eigenpair found = smallest_eigenvalue(solution_with(a), rows_of(start), {1e-9, 20}, basis);
  CHECK(found.real == about(0.5, 1e-9));
}

TEST_CASE("davidson_finds_the_leftmost_eigenvalue_of_an_unsymmetric_pencil") {
  Numbers numbers(4);
  for (const int n : {3, 30, 90}) {
    const Dense factor = numbers.matrix(n), other = numbers.matrix(n);
    const Dense k = product(factor, factor.transpose()) + (other - other.transpose());
    std::vector<double> weight;
    Eigen::VectorXd inverse(n);
    for (int r = 0; r < n / 3; ++r) {
      weight.push_back(1.5 + numbers());
      inverse.segment<3>(3 * r).setConstant(1 / weight.back());
    }
    const std::complex<double> value = leftmost_of(inverse.asDiagonal() * k);
    const Eigenpair found = leftmost(k, weight, 200);
    CHECK(found.error <= 1e-8);
    CHECK(found.real == about(value.real(), 1e-6));
    CHECK(std::abs(found.imaginary - std::abs(value.imag())) < 1e-6 * std::abs(value));
  }
}

// Ziegler's double pendulum with equal springs c and links of length l, masses 2m and m (Ziegler,
// Ing.-Arch. 20, 1952; Herrmann & Bungay, J. Appl. Mech. 31, 1964): without damping it flutters
// between P = (7/2 -+ sqrt 2) c / l, where the eigenvalues of M^-1 K are complex. Second-order work
// stays positive up to P = 2 c / l only: it warns early.
TEST_CASE("zieglers_column_flutters_above_its_critical_load") {
  const auto stiffness = [](double p) {
    Dense k(2, 2);
    k << 2 - p, p - 1, -1, 1;
    return k;
  };
  // in coordinates with a unit mass matrix: the Cholesky factor of (3 1; 1 1)
  Dense l = Dense::Zero(2, 2);
  l << std::sqrt(3.0), 0, std::sqrt(1 / 3.0), std::sqrt(2 / 3.0);
  const auto pencil = [&](double p) {
    Dense k = 9 * Dense::Identity(3, 3);
    k.topLeftCorner<2, 2>() = product(product(inverse(l), stiffness(p)), inverse(l).transpose());
    return k;
  };
  const double critical = 3.5 - std::sqrt(2.0);
  CHECK(leftmost(pencil(0.999 * critical), {1}).imaginary == 0);
  CHECK(leftmost(pencil(1.001 * critical), {1}).imaginary > 0.01);
  CHECK(leftmost(pencil(1.001 * critical), {1}).real > 0);
  const auto least = [&](double p) {
    const Dense k = stiffness(p);
    return symmetric_eigenvalues(0.5 * (k + k.transpose()))[0];
  };
  // det Ks = (2 - p) (2 + p) / 4
  CHECK(least(1.999) > 0);
  CHECK(least(2.001) < 0);
}

// With inertia and a damping D = c M a mode of M^-1 K with the eigenvalue a + i b decays exactly
// where c^2 a > b^2: lambda^2 + c lambda + a + i b = 0 has its roots on the left there.
TEST_CASE("damping_of_inertia_decides_whether_a_mode_flutters") {
  const double a = 4, b = 3;
  for (const double c : {1.49, 1.51}) {
    Dense companion(4, 4);
    const Dense k = (Dense(2, 2) << a, -b, b, a).finished();
    companion << Dense::Zero(2, 2), Dense::Identity(2, 2), -k, -c * Dense::Identity(2, 2);
    const double right = -leftmost_of(-companion).real();
    CHECK((right < 0) == (c * c * a > b * b));
  }
}

// Beck's column: a cantilever with a follower force at its tip flutters at P = 20.051 EI / L^2
// (Beck, Z. angew. Math. Phys. 3, 1952; Bolotin 1963). Hermite beam elements; a block row holds the
// deflection of a node and its slope, as a displacement at a small distance, so that both have the
// same lumped mass and the slope has nearly no inertia.
TEST_CASE("becks_column_flutters_at_its_critical_load") {
  const int elements = 40;
  const double h = 1.0 / elements, arm = 0.05 * h;
  const auto column = [&](double p) {
    Dense bend(4, 4), press(4, 4);
    bend << 12, 6 * h, -12, 6 * h, 6 * h, 4 * h * h, -6 * h, 2 * h * h, -12, -6 * h, 12, -6 * h,
        6 * h, 2 * h * h, -6 * h, 4 * h * h;
    bend /= h * h * h;
    press << 36, 3 * h, -36, 3 * h, 3 * h, 4 * h * h, -3 * h, -h * h, -36, -3 * h, 36, -3 * h,
        3 * h, -h * h, -3 * h, 4 * h * h;
    press /= 30 * h;
    Dense k = Dense::Zero(2 * elements + 2, 2 * elements + 2);
    for (int e = 0; e < elements; ++e) k.block<4, 4>(2 * e, 2 * e) += bend - p * press;
    // the force turns with the tip: it pushes sideways by P times the slope there
    k(2 * elements, 2 * elements + 1) += p;
    Dense rows = Dense::Zero(3 * elements, 3 * elements);
    for (int r = 0; r < 3 * elements; ++r) {
      for (int c = 0; c < 3 * elements; ++c) {
        const int a = r % 3, b = c % 3;
        if (a == 2 || b == 2) continue;
        const double scale = (a == 1 ? 1 / arm : 1) * (b == 1 ? 1 / arm : 1);
        rows(r, c) = scale * k(2 + 2 * (r / 3) + a, 2 + 2 * (c / 3) + b);
      }
      if (r % 3 == 2) rows(r, r) = 1e6;
    }
    return rows;
  };
  std::vector<double> weight(elements, h);
  weight.back() = h / 2;
  const Dense unloaded = column(0);
  const auto flutters = [&](double p) {
    const BlockVector start = rows_of(Eigen::VectorXd::LinSpaced(3 * elements, 0, 1));
    const Eigenpair found = leftmost_eigenvalue(product_with(column(p)), solution_with(unloaded),
                                                weight, {start}, {1e-7, 60});
    CHECK(found.error <= 1e-7);
    return found.imaginary > 0;
  };
  // 1 %: the mass is lumped
  CHECK_FALSE(flutters(0.99 * 20.051));
  CHECK(flutters(1.01 * 20.051));
}

}  // namespace mvs::core::test
