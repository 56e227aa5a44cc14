// GMRES and products of matrices and vectors against dense algebra.
#include "linalg/gmres.h"

#include "linalg/spmv.h"
#include "tests/linalg/random_matrix.h"

using namespace mvs::core;
using namespace mvs::core::test;

TEST_CASE("products_equal_those_of_dense_algebra") {
  Random random(11);
  BlockSpmv product;
  for (const uint32_t n : {1u, 2u, 7u, 90u}) {
    const BlockMatrix m = random_matrix(random, n, n < 2 ? 0 : 3 * n);
    const Positions x = random.vectors(n, 1);
    Positions y;
    product.multiply(m, x, y);
    const Eigen::VectorXd expected = dense(m).selfadjointView<Eigen::Lower>() * flat(x);
    // rounding of sums of some ten products
    CHECK((flat(y) - expected).norm() <= 1e-15 * dense(m).norm() * flat(x).norm());
  }
}

TEST_CASE("gmres_solves_an_unsymmetric_system") {
  Random random(5);
  const uint32_t n = 20;
  // the identity plus a small perturbation, as after preconditioning
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(3 * n, 3 * n);
  for (Eigen::Index i = 0; i < a.size(); ++i) a(i) += random(-0.1, 0.1);
  const auto apply = [&](const Positions &v) {
    const Eigen::VectorXd y = a * flat(v);
    Positions result(n);
    for (uint32_t i = 0; i < n; ++i) result[i] = y.segment<3>(3 * i);
    return result;
  };
  const Positions b = random.vectors(n, 1);
  for (const double tolerance : {1e-3, 1e-10}) {
    Positions x = b;
    const double reached = gmres(apply, x, 60, tolerance);
    CHECK(reached <= tolerance);
    // the reported residual is the residual, to rounding
    const double residual = (a * flat(x) - flat(b)).norm() / flat(b).norm();
    CHECK(std::abs(residual - reached) < 1e-6 * (1e-6 + reached));
  }
  Positions zero(n, Vec3::Zero());
  CHECK(gmres(apply, zero, 60, 1e-10) == 0);
  CHECK(largest(zero) == 0);
}

TEST_CASE("gmres_stops_at_its_limit_and_reports_the_residual") {
  Random random(6);
  Eigen::MatrixXd a(60, 60);
  for (Eigen::Index i = 0; i < a.size(); ++i) a(i) = random(-1, 1);
  const auto apply = [&](const Positions &v) {
    const Eigen::VectorXd y = a * flat(v);
    Positions result(20);
    for (uint32_t i = 0; i < 20; ++i) result[i] = y.segment<3>(3 * i);
    return result;
  };
  const Positions b = random.vectors(20, 1);
  Positions x = b;
  const double reached = gmres(apply, x, 5, 1e-10);
  CHECK(reached > 1e-10);
  CHECK(reached <= 1);
  CHECK((a * flat(x) - flat(b)).norm() == about(reached * flat(b).norm(), 1e-9));
}
