// Elimination orders: minimum degree as of Eigen, nested dissection of a sheet, operations counted.
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>

#include "linalg/cholesky.h"
#include "linalg/direct_solver.h"
#include "linalg/nested_dissection.h"
#include "tests/linalg/random_matrix.h"

using namespace mvs::core;
using namespace mvs::core::test;

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
