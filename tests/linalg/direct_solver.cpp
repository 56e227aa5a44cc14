// Sparse factors of every kind against dense algebra, and what each refuses.
#include "linalg/direct_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "base/error.h"
#include "linalg/cholesky.h"
#include "linalg/mixed_precision.h"
#include "tests/dense.h"
#include "tests/linalg/random_matrix.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

std::vector<Backend> backends() {
  std::vector<Backend> list{Backend::block, Backend::eigen};
  if (std::string(factor_names()).find("cholmod") != std::string::npos) {
    list.push_back(Backend::cholmod);
  }
  return list;
}

// Solves to the rounding of a well-conditioned system of a few hundred rows.
struct NamedFactor {
  std::string name;
  std::unique_ptr<DirectSolver> factor;
  double rounding;
};

std::vector<NamedFactor> all_factors() {
  std::vector<NamedFactor> all;
  for (const Backend backend : backends()) {
    all.push_back({"backend " + std::to_string(static_cast<uint32_t>(backend)),
                   make_direct_solver(backend), 1e-12});
  }
  all.push_back({"float", make_float_factor(), 1e-4});
  // 1.5e-5 of the largest number of each column, times a hundred for the condition
  all.push_back({"compact", make_compact_factor(), 1.5e-3});
  // the rest of the residual, and the share by which the norms of residual and solution differ
  all.push_back({"refined", make_mixed_precision_cholesky(), 1e-6});
  return all;
}

}  // namespace

TEST_CASE("every_factor_solves_like_dense_algebra") {
  Random random(1);
  for (const NamedFactor &kind : all_factors()) {
    CAPTURE(kind.name);
    DirectSolver *factor = kind.factor.get();
    for (const uint32_t n : {1u, 2u, 7u, 40u, 90u}) {
      const BlockMatrix m = random_matrix(random, n, n < 2 ? 0 : 3 * n);
      factor->analyse(m);
      REQUIRE(factor->factorise(m));
      const Positions b = random.vectors(n, 1);
      Positions x = b;
      factor->solve(x);
      const Eigen::VectorXd expected = symmetric_solution(dense(m), flat(b));
      // rounding of a well-conditioned matrix of at most 270 rows
      CHECK((flat(x) - expected).norm() < kind.rounding * expected.norm());
    }
  }
}

TEST_CASE("a_factor_accepts_new_values_on_its_pattern") {
  Random random(2);
  for (const NamedFactor &kind : all_factors()) {
    CAPTURE(kind.name);
    DirectSolver *factor = kind.factor.get();
    BlockMatrix m = random_matrix(random, 30, 80);
    factor->analyse(m);
    REQUIRE(factor->factorise(m));
    for (uint32_t c = 0; c < m.size(); ++c) m.value[m.start[c]] *= 3;
    REQUIRE(factor->factorise(m));
    const Positions b = random.vectors(30, 1);
    Positions x = b;
    factor->solve(x);
    // the residual of a well-conditioned solve: rounding
    CHECK((apply(dense(m), flat(x)) - flat(b)).norm() < kind.rounding * flat(b).norm());
  }
}

TEST_CASE("every_factor_refuses_a_matrix_that_is_not_positive_definite") {
  Random random(3);
  for (const NamedFactor &kind : all_factors()) {
    CAPTURE(kind.name);
    DirectSolver *factor = kind.factor.get();
    const BlockMatrix good = random_matrix(random, 30, 80);
    factor->analyse(good);
    for (const uint32_t row : {0u, 11u, 29u}) {
      BlockMatrix bad = good;
      // a matrix with a negative diagonal entry is not positive definite
      bad.value[bad.start[row]](1, 1) = -1;
      CHECK_FALSE(factor->factorise(bad));
      bad.value[bad.start[row]](1, 1) = std::numeric_limits<double>::quiet_NaN();
      CHECK_FALSE(factor->factorise(bad));
    }
    // indefinite although every diagonal entry is positive
    BlockMatrix hidden = good;
    for (uint32_t k = hidden.start[0] + 1; k < hidden.start[1]; ++k) hidden.value[k] *= 1e3;
    REQUIRE(symmetric_eigenvalues(dense(hidden))[0] < 0);
    CHECK_FALSE(factor->factorise(hidden));
    CHECK(factor->factorise(good));  // and the factor can be used again afterwards
  }
}

// Conjugate gradients need a symmetric, positive definite preconditioner.
TEST_CASE("a_factor_in_16_bits_remains_symmetric_and_positive") {
  Random random(10);
  for (const uint32_t n : {1u, 5u, 60u, 300u}) {
    const BlockMatrix m = random_matrix(random, n, n < 2 ? 0 : 4 * n);
    const std::unique_ptr<DirectSolver> factor = make_compact_factor();
    factor->analyse(m);
    REQUIRE(factor->factorise(m));
    const Positions a = random.vectors(n, 1), b = random.vectors(n, 1);
    Positions x = a, y = b;
    factor->solve(x);
    factor->solve(y);
    // rounding of floats in sums of up to 900 numbers
    CHECK(std::abs(flat(x).dot(flat(b)) - flat(a).dot(flat(y))) <
          1e-4 * flat(x).norm() * flat(b).norm());
    CHECK(flat(x).dot(flat(a)) > 0);
  }
}

// Double precision completes a solution where single precision fails: two nodes coupled a thousand
// million times as firmly as each is to its place.
TEST_CASE("systems_beyond_single_precision_are_solved_in_double") {
  BlockMatrix m;
  m.set_pattern(2, {{0, 1}});
  m.value = {Mat3::Identity() * (1e9 + 1), Mat3::Identity() * -1e9, Mat3::Identity() * (1e9 + 1)};
  const Positions b = {Vec3(1, 2, 3), Vec3(0, 0, 0)};
  const auto error = [&](const std::unique_ptr<DirectSolver> &factor) {
    factor->analyse(m);
    if (!factor->factorise(m)) return 1.0;
    Positions x = b;
    factor->solve(x);
    return (x[0] - 0.5 * b[0]).norm() / b[0].norm();
  };
  CHECK(error(make_block_factor()) < 1e-6);  // 1e9 times rounding
  CHECK(error(make_float_factor()) > 0.1);
  CHECK(error(make_mixed_precision_cholesky()) < 1e-6);
}

// A chain of which each node moves a tenth as much as the one before. Subnormal numbers take some
// processors a hundred times as long.
TEST_CASE("single_precision_produces_no_subnormal_numbers_and_restores_the_rounding_mode") {
  constexpr uint32_t n = 60;
  std::vector<Edge> pairs;
  for (uint32_t k = 1; k < n; ++k) pairs.push_back({k - 1, k});
  BlockMatrix m;
  m.set_pattern(n, pairs);
  for (uint32_t c = 0; c < n; ++c) {
    for (uint32_t k = m.start[c]; k < m.start[c + 1]; ++k) {
      m.value[k] = Mat3::Identity() * (k == m.start[c] ? 10.1 : -1.0);
    }
  }
  const std::unique_ptr<DirectSolver> factor = make_float_factor();
  factor->analyse(m);
  REQUIRE(factor->factorise(m));
  Positions x(n, Vec3::Zero());
  x[0] = Vec3(1, 1, 1);
  factor->solve(x);
  CHECK(std::abs(x[30][0] / x[29][0] - 0.1) < 1e-3);
  for (const Vec3 &xi : x) CHECK(std::fpclassify(static_cast<float>(xi[0])) != FP_SUBNORMAL);
  volatile float tiny = std::numeric_limits<float>::min();
  CHECK(tiny / 2 > 0);
}

TEST_CASE("an_unknown_backend_is_refused") {
  CHECK_THROWS_AS(make_direct_solver(static_cast<Backend>(99)), Error);
}
