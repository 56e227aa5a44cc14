// Preconditioned conjugate gradients.
#include <doctest/doctest.h>

#include <cmath>

#include "linalg/pcg.h"
#include "tests/about.h"
#include "tests/dense.h"
#include "tests/solve/bench.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

Positions rows_of(const Eigen::VectorXd &v) {
  Positions rows(static_cast<size_t>(v.size() / 3));
  for (size_t i = 0; i < rows.size(); ++i) rows[i] = v.segment<3>(3 * static_cast<Eigen::Index>(i));
  return rows;
}

// 1, base, base squared and so on.
Eigen::VectorXd powers_of(double base) {
  Eigen::VectorXd values(30);
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    values[i] = std::pow(base, static_cast<double>(i));
  }
  return values;
}

// A symmetric matrix with these eigenvalues.
Dense with_spectrum(Random &random, const Eigen::VectorXd &values) {
  Dense any(values.size(), values.size());
  for (Eigen::Index i = 0; i < any.size(); ++i) any(i) = random(-1, 1);
  const Dense q = orthonormal(any);
  return product(q * values.asDiagonal(), q.transpose());
}

PcgResult solve(const Dense &a, const Positions &b, Positions &x, const PcgGoal &goal) {
  Pcg pcg;
  const auto multiply = [&](const Positions &v, Positions &y) { y = rows_of(apply(a, flat(v))); };
  const auto none_there = [](const Positions &r, Positions &z) { z = r; };
  return pcg.solve(multiply, none_there, b, x, goal);
}

}  // namespace

// As many iterations as distinct eigenvalues, in exact arithmetic (Hestenes & Stiefel).
TEST_CASE("conjugate_gradients_end_after_as_many_iterations_as_eigenvalues") {
  Random random(11);
  Eigen::VectorXd values(30);
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = 1.0 + static_cast<double>(i % 3);
  const Dense a = with_spectrum(random, values);
  const Positions b = random.vectors(10, 1);
  Positions x;
  const PcgResult two = solve(a, b, x, {1e-12, 2});
  CHECK(two.iterations == 2);
  CHECK(two.error > 1e-6);
  const PcgResult three = solve(a, b, x, {1e-12, 30});
  CHECK(three.iterations == 3);
  // rounding of thirty sums
  CHECK((apply(a, flat(x)) - flat(b)).norm() <= 1e-12 * flat(b).norm());
}

TEST_CASE("conjugate_gradients_report_the_true_residual") {
  Random random(12);
  const Dense a = with_spectrum(random, powers_of(1.4));
  const Positions b = random.vectors(10, 1);
  for (const uint32_t most : {1u, 4u, 9u}) {
    Positions x;
    const PcgResult result = solve(a, b, x, {1e-12, most});
    const double left = (apply(a, flat(x)) - flat(b)).norm() / flat(b).norm();
    CHECK(result.iterations == most);
    CHECK(result.error == about(left, 1e-8));
    CHECK(flat(b).dot(flat(x)) > 0);  // downhill
  }
}

// With an exact preconditioner the error after the initial guess is known, and one iteration
// removes it.
TEST_CASE("conjugate_gradients_start_from_a_guess_that_leads_downhill") {
  Random random(16);
  const Dense a = with_spectrum(random, powers_of(1.4));
  const Dense exact = inverse(a);
  const Positions b = random.vectors(10, 1);
  const auto multiply = [&](const Positions &v, Positions &y) { y = rows_of(apply(a, flat(v))); };
  const auto precondition = [&](const Positions &r, Positions &z) {
    z = rows_of(apply(exact, flat(r)));
  };
  const double size = std::sqrt(flat(b).dot(apply(exact, flat(b))));
  Pcg pcg;
  Positions x;
  const Positions solution = rows_of(0.3 * apply(exact, flat(b)));
  for (const Positions &guess : {solution, random.vectors(10, 1), rows_of(-flat(solution))}) {
    const PcgResult result = pcg.solve(multiply, precondition, b, guess, x, {1e-3, 0});
    const Eigen::VectorXd left = flat(b) - apply(a, flat(x));
    CHECK(flat(b).dot(flat(x)) >= 0);
    // cancellation where nearly all of b is removed
    CHECK(std::abs(result.error - std::sqrt(left.dot(apply(exact, left))) / size) <= 1e-7);
  }
  CHECK(flat(x).isZero(0));  // a guess that leads uphill is discarded
  // one iteration is made although the guess meets the goal, and removes the rest of the error
  CHECK(pcg.solve(multiply, precondition, b, solution, x, {0.9, 9}).iterations == 1);
  CHECK((apply(a, flat(x)) - flat(b)).norm() <= 1e-12 * flat(b).norm());
}

TEST_CASE("conjugate_gradients_give_up_a_goal_out_of_reach") {
  Random random(14);
  const Dense a = with_spectrum(random, powers_of(2.0));
  const Positions b = random.vectors(10, 1);
  Positions x;
  const PcgResult given_up = solve(a, b, x, {1e-3, 8, 0.1});
  CHECK(given_up.iterations == 2);
  CHECK(given_up.error > 0.1);
  CHECK(solve(a, b, x, {1e-3, 8}).iterations == 8);
}

TEST_CASE("slow_conjugate_gradients_end_with_a_lower_accuracy") {
  Random random(15);
  const Dense a = with_spectrum(random, powers_of(1.1));
  const Positions b = random.vectors(10, 1);
  Positions x;
  const uint32_t all = solve(a, b, x, {1e-3, 30}).iterations;
  REQUIRE(all > 6);
  PcgGoal goal{1e-3, 30};
  goal.patience = 4;
  goal.enough = 0.9;
  const PcgResult impatient = solve(a, b, x, goal);
  CHECK(impatient.iterations == 4);
  CHECK(impatient.error <= 0.9);
  goal.enough = 0.1;
  const PcgResult later = solve(a, b, x, goal);
  CHECK(later.iterations > 4);
  CHECK(later.iterations < all);
  CHECK(later.error <= 0.1);
  goal.patience = all;  // a run that reaches its goal first is not affected
  CHECK(solve(a, b, x, goal).iterations == all);
}

TEST_CASE("conjugate_gradients_stop_where_the_matrix_is_not_positive_definite") {
  Random random(13);
  Eigen::VectorXd values = Eigen::VectorXd::Ones(30);
  values[0] = -5;
  const Positions b = random.vectors(10, 1);
  Positions x;
  const PcgResult result = solve(with_spectrum(random, values), b, x, {1e-10, 30});
  CHECK(result.iterations < 30);
  CHECK(result.error > 1e-10);
  CHECK(flat(b).dot(flat(x)) >= 0);
  const PcgResult nothing =
      solve(with_spectrum(random, values), Positions(10, Vec3::Zero()), x, {0, 9});
  CHECK(nothing.error == 0);
  CHECK(largest(x) == 0);
}
