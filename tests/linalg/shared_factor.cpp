// Factors and solutions by several threads have the bits of one thread; the division of the
// elimination tree is one.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "linalg/cholesky.h"
#include "linalg/subtrees.h"
#include "tests/solve/bench.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

// A square grid of nodes in an order of minimum degree, whose blocks are random and whose diagonal
// dominates its row; with a `fault` one block on it is indefinite.
BlockMatrix grid_matrix(uint32_t side, bool fault = false) {
  std::vector<Edge> pairs;
  for (uint32_t i = 0; i < side * side; ++i) {
    if (i % side + 1 < side) pairs.push_back({i, i + 1});
    if (i + side < side * side) pairs.push_back({i, i + side});
    if (i % side + 1 < side && i + side < side * side) pairs.push_back({i, i + side + 1});
  }
  const std::vector<uint32_t> order = fill_reducing_order(side * side, pairs);
  std::vector<uint32_t> row(order.size());
  for (uint32_t k = 0; k < order.size(); ++k) row[order[k]] = k;
  for (Edge &p : pairs) p = {row[p[0]], row[p[1]]};
  Random random(5);
  BlockMatrix m;
  m.set_pattern(side * side, pairs);
  for (Mat3 &block : m.value) {
    for (int i = 0; i < 9; ++i) block(i) = random(-1, 1);
  }
  for (uint32_t c = 0; c < m.size(); ++c) {
    Mat3 &d = m.value[m.start[c]];
    d = (d + d.transpose()).eval() + 20 * Mat3::Identity();
  }
  if (fault) m.value[m.start[m.size() / 2]] = -Mat3::Identity();
  return m;
}

std::vector<Vec3> solution(DirectSolver &factor, const BlockMatrix &m) {
  factor.analyse(m);
  REQUIRE(factor.factorise(m));
  std::vector<Vec3> x(m.size());
  for (uint32_t i = 0; i < x.size(); ++i) x[i] = Vec3(i, 1, -2.0 * i);
  factor.solve(x);
  return x;
}

bool same_bits(const std::vector<Vec3> &a, const std::vector<Vec3> &b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

// While it lives, new threads share even the shortest loops.
class ShareAll {
 public:
  ShareAll() { setenv("MVS_WORKERS_LEAST_US", "0", 1); }  // NOLINT(concurrency-mt-unsafe)
  ~ShareAll() { unsetenv("MVS_WORKERS_LEAST_US"); }       // NOLINT(concurrency-mt-unsafe)
  ShareAll(const ShareAll &) = delete;
  ShareAll &operator=(const ShareAll &) = delete;
};

}  // namespace

TEST_CASE("threads_change_no_bit_of_a_solution") {
  const ShareAll share_all;
  for (auto *make : {&make_block_factor, &make_float_factor}) {
    for (const uint32_t side : {1u, 2u, 9u, 40u}) {
      const BlockMatrix m = grid_matrix(side);
      const std::vector<Vec3> expected = solution(*make(), m);
      for (const uint32_t count : {2u, 3u, 8u}) {
        Workers workers(count);
        const auto factor = make();
        factor->use_workers(&workers);
        CHECK(same_bits(solution(*factor, m), expected));
        CHECK(same_bits(solution(*factor, m), expected));
      }
    }
  }
}

TEST_CASE("threads_find_that_a_matrix_is_indefinite_and_go_on_to_the_next") {
  const ShareAll share_all;
  Workers workers(3);
  const BlockMatrix bad = grid_matrix(30, true), good = grid_matrix(30);
  for (auto *make : {&make_block_factor, &make_float_factor}) {
    const auto factor = make();
    factor->use_workers(&workers);
    factor->analyse(bad);
    CHECK(!factor->factorise(bad));
    CHECK(same_bits(solution(*factor, good), solution(*make(), good)));
  }
}

TEST_CASE("subtrees_are_disjoint_and_closed_below_and_small") {
  Supernodes pattern;
  pattern.analyse(grid_matrix(40));
  const auto count = static_cast<uint32_t>(pattern.node.size());
  Subtrees trees;
  trees.divide(pattern, std::vector<double>(count, 1.0), 0.2);
  REQUIRE(trees.count() >= 5);
  const uint32_t of_top = trees.count();
  std::vector<uint32_t> group(count, none);
  const auto put = [&](uint32_t s, uint32_t g) {
    CHECK(group[s] == none);
    group[s] = g;
  };
  for (uint32_t g = 0; g < trees.count(); ++g) {
    CHECK(std::is_sorted(trees.begin(g), trees.end(g)));
    CHECK(trees.end(g) - trees.begin(g) <= 0.2 * count + 1);
    for (const uint32_t *s = trees.begin(g); s != trees.end(g); ++s) put(*s, g);
  }
  for (const uint32_t s : trees.top()) put(s, of_top);
  CHECK(std::count(group.begin(), group.end(), none) == 0);
  std::vector<uint32_t> owner;
  for (uint32_t s = 0; s < count; ++s) owner.resize(pattern.node[s].last, s);
  for (uint32_t s = 0; s < count; ++s) {
    if (group[s] == of_top) continue;
    for (size_t k = pattern.node[s].row_start; k < pattern.node[s].row_end; ++k) {
      const uint32_t ancestor = group[owner[pattern.row[k]]];
      CHECK(ancestor == (k < trees.outer_rows(s) ? group[s] : of_top));
    }
  }
}
