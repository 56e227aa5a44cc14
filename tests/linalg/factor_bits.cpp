// Bits of factors and solutions: they depend neither on zeros in the pattern nor on the parts in
// which they are computed, and the sums of a panel have their stated order.
#include <algorithm>
#include <memory>

#include "linalg/cholesky.h"
#include "linalg/direct_solver.h"
#include "linalg/panel/panel.h"
#include "tests/linalg/random_matrix.h"

using namespace mvs::core;
using namespace mvs::core::test;

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
