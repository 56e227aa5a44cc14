// Sparse factors, elimination orders and GMRES against dense algebra.
#include "linalg/direct_solver.h"
#include "linalg/cholesky.h"
#include "linalg/nested_dissection.h"
#include "linalg/spmv.h"

#include <Eigen/Dense>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "linalg/gmres.h"
#include "linalg/mixed_precision.h"
#include "linalg/panel.h"
#include "tests/solve/bench.h"

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

std::vector<Edge> random_pairs(Random &random, uint32_t n, size_t count) {
  std::vector<Edge> pairs;
  while (pairs.size() < count) {
    const auto i = static_cast<uint32_t>(random(0, n)), j = static_cast<uint32_t>(random(0, n));
    if (i != j) pairs.push_back({i, j});
  }
  return pairs;
}

// Random blocks; the diagonal dominates its row, so that the matrix is positive definite.
BlockMatrix random_matrix(Random &random, uint32_t n, size_t pairs) {
  BlockMatrix m;
  m.set_pattern(n, random_pairs(random, n, pairs));
  std::vector<double> weight(n, 1.0);
  for (uint32_t c = 0; c < n; ++c) {
    for (uint32_t k = m.start[c] + 1; k < m.start[c + 1]; ++k) {
      for (int i = 0; i < 9; ++i) m.value[k](i) = random(-1, 1);
      weight[c] += 3;
      weight[m.row[k]] += 3;
    }
  }
  for (uint32_t c = 0; c < n; ++c) {
    Mat3 &d = m.value[m.start[c]];
    for (int i = 0; i < 9; ++i) d(i) = random(-0.2, 0.2);
    d = (d + d.transpose()).eval() + weight[c] * Mat3::Identity();
  }
  return m;
}

Eigen::MatrixXd dense(const BlockMatrix &m) {
  const Eigen::Index n = 3 * m.size();
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(n, n);
  for (uint32_t c = 0; c < m.size(); ++c) {
    for (uint32_t k = m.start[c]; k < m.start[c + 1]; ++k) {
      full.block<3, 3>(3 * m.row[k], 3 * c) = m.value[k];
      full.block<3, 3>(3 * c, 3 * m.row[k]) = m.value[k].transpose();
    }
  }
  return full;
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
      const Eigen::VectorXd expected = dense(m).ldlt().solve(flat(b));
      // rounding of a well-conditioned matrix of at most 270 rows
      CHECK((flat(x) - expected).norm() < kind.rounding * expected.norm());
    }
  }
}

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
    CHECK((dense(m) * flat(x) - flat(b)).norm() < kind.rounding * flat(b).norm());
  }
}

// A pattern may therefore be kept while contact pairs appear and disappear.
TEST_CASE("zeros_in_the_pattern_change_no_bit_of_the_block_factor") {
  Random random(7);
  for (const uint32_t n : {5u, 40u, 200u}) {
    const BlockMatrix m = random_matrix(random, n, 3 * n);
    std::vector<Edge> pairs = random_pairs(random, n, 4 * n);
    for (uint32_t c = 0; c < n; ++c) {
      for (uint32_t k = m.start[c]; k < m.start[c + 1]; ++k) pairs.push_back({c, m.row[k]});
    }
    BlockMatrix wider;
    wider.set_pattern(n, pairs);
    REQUIRE(wider.row.size() > m.row.size());
    for (uint32_t c = 0; c < n; ++c) {
      for (uint32_t k = m.start[c]; k < m.start[c + 1]; ++k) {
        wider.value[wider.find(m.row[k], c)] = m.value[k];
      }
    }
    const Positions b = random.vectors(n, 1);
    Positions x = b, y = b;
    const std::unique_ptr<DirectSolver> factor = make_direct_solver(Backend::block);
    factor->analyse(m);
    REQUIRE(factor->factorise(m));
    factor->solve(x);
    factor->analyse(wider);
    REQUIRE(factor->factorise(wider));
    factor->solve(y);
    CHECK((flat(x) - flat(y)).cwiseAbs().maxCoeff() == 0);
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
    REQUIRE(dense(hidden).selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() < 0);
    CHECK_FALSE(factor->factorise(hidden));
    CHECK(factor->factorise(good));  // and the factor can be used again afterwards
  }
}

TEST_CASE("a_factor_computed_in_parts_has_the_same_bits") {
  Random random(9);
  const BlockMatrix m = random_matrix(random, 150, 600);
  const Positions b = random.vectors(150, 1);
  for (const auto make : {make_block_factor, make_float_factor, make_compact_factor}) {
    const std::unique_ptr<DirectSolver> whole = make(), parts = make();
    whole->analyse(m);
    parts->analyse(m);
    REQUIRE(whole->factorise(m));
    for (uint32_t part = 0; part < 5; ++part) REQUIRE(parts->factorise_part(m, part, 5));
    Positions x = b, y = b;
    whole->solve(x);
    parts->solve(y);
    CHECK(x == y);
  }
}

TEST_CASE("a_solution_for_a_few_rows_has_the_bits_of_the_whole_one") {
  Random random(11);
  for (const uint32_t n : {1u, 40u, 200u}) {
    const BlockMatrix m = random_matrix(random, n, n < 2 ? 0 : 2 * n);
    const std::unique_ptr<RowSolver> factor = make_row_solver();
    factor->analyse(m);
    REQUIRE(factor->factorise(m));
    for (const uint32_t count : {0u, 1u, n / 10, n}) {
      std::vector<uint32_t> rows;
      for (uint32_t k = 0; k < count; ++k) rows.push_back(k * n / std::max(count, 1u));
      factor->choose_rows(rows);
      Positions whole(n, Vec3::Zero()), some = random.vectors(count, 1), other = some;
      for (uint32_t k = 0; k < count; ++k) whole[rows[k]] = some[k];
      factor->solve(whole);
      factor->solve_rows(some);
      factor->solve_rows(other);  // the first one left nothing behind
      for (uint32_t k = 0; k < count; ++k) CHECK(some[k] == whole[rows[k]]);
      CHECK(some == other);
    }
  }
}

// panel.h states the order of the sums, on which the bits of a solution rest.
TEST_CASE("a_backward_solution_sums_from_the_last_row_on") {
  Random random(12);
  for (size_t width = 3; width <= 36; width += 3) {
    const size_t height = (width + 20 + panel_rows - 1) / panel_rows * panel_rows;
    std::vector<double> panel(width * height), x(height + panel_slack);
    for (double &number : panel) number = random(-1, 1);
    for (size_t i = 0; i < height; ++i) x[i] = random(-1, 1);
    std::vector<double> expected = x;
    for (size_t j = width; j-- > 0;) {
      const double *column = panel.data() + j * height;
      double sum = expected[j];
      for (size_t i = height; i-- > j + 1;) sum -= column[i] * expected[i];
      expected[j] = sum * column[j];  // the diagonal is an inverse
    }
    solve_backward(panel.data(), width, height, x.data());
    CHECK(x == expected);
  }
}

TEST_CASE("an_elimination_order_is_that_of_the_graph") {
  Random random(13);
  for (const uint32_t n : {1u, 2u, 30u, 300u}) {
    std::vector<Edge> pairs = n < 2 ? std::vector<Edge>{} : random_pairs(random, n, 3 * n);
    const std::vector<Edge> repeated(pairs.begin(),
                                     pairs.begin() + static_cast<long>(pairs.size() / 2));
    pairs.insert(pairs.end(), repeated.begin(), repeated.end());
    Eigen::SparseMatrix<double> graph(n, n);
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(pairs.size() + n);
    for (const Edge &p : pairs) entries.emplace_back(p[0], p[1], 1.0);
    for (uint32_t i = 0; i < n; ++i) entries.emplace_back(i, i, 1.0);
    graph.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> expected;
    Eigen::AMDOrdering<int>()(graph, expected);
    const std::vector<uint32_t> order = fill_reducing_order(n, pairs);
    for (uint32_t k = 0; k < n; ++k)
      CHECK(order[k] == static_cast<uint32_t>(expected.indices()[k]));
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

// A sheet of 40 by 20 nodes, its edges listed twice: its separator has 20 nodes, the last of the
// order, and no edge joins the two sides.
TEST_CASE("nested_dissection_separates_a_sheet_across_its_shorter_side") {
  constexpr uint32_t wide = 40, high = 20;
  std::vector<Edge> pairs;
  std::vector<Vec3> place;
  for (uint32_t i = 0; i < wide * high; ++i) {
    place.emplace_back(i % wide, i / wide, 0);
    if (i % wide > 0) pairs.insert(pairs.end(), {{i - 1, i}, {i, i - 1}});
    if (i >= wide) pairs.push_back({i, i - wide});
  }
  const std::vector<uint32_t> order = nested_dissection_order(pairs, place);
  std::vector<uint32_t> rank(order.size(), none);
  for (uint32_t k = 0; k < order.size(); ++k) rank[order[k]] = k;
  CHECK(std::find(rank.begin(), rank.end(), none) == rank.end());
  const uint32_t separated = wide * high - high;
  const auto on_the_left = [&](uint32_t k) { return order[k] % wide < wide / 2; };
  uint32_t of_first = 0;
  while (of_first < separated && on_the_left(of_first) == on_the_left(0)) ++of_first;
  CHECK(of_first >= separated / 2 - high);
  for (const Edge &p : pairs) {
    if (std::max(rank[p[0]], rank[p[1]]) >= separated) continue;
    CHECK((rank[p[0]] < of_first) == (rank[p[1]] < of_first));
  }
}

// A path that is eliminated from its ends leaves two numbers in each column but the last; a star
// whose centre is eliminated first leaves all.
TEST_CASE("the_operations_of_an_elimination_are_counted") {
  CHECK(elimination_work({0, 1, 2, 3}, {{0, 1}, {1, 2}, {3, 2}, {1, 0}}) == 4 + 4 + 4 + 1);
  CHECK(elimination_work({0, 1, 2, 3}, {{0, 1}, {0, 2}, {0, 3}}) == 16 + 9 + 4 + 1);
  CHECK(elimination_work({3, 2, 1, 0}, {{0, 1}, {0, 2}, {0, 3}}) == 4 + 4 + 4 + 1);
}

TEST_CASE("a_fill_reducing_order_is_a_permutation") {
  Random random(4);
  for (const uint32_t n : {1u, 5u, 64u, 300u}) {
    std::vector<uint32_t> order =
        fill_reducing_order(n, random_pairs(random, n, n < 2 ? 0 : 4 * n));
    std::sort(order.begin(), order.end());
    REQUIRE(order.size() == n);
    for (uint32_t k = 0; k < n; ++k) CHECK(order[k] == k);
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
    CHECK(residual == doctest::Approx(reached).epsilon(1e-6).scale(1e-6));
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
