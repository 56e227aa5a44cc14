// When the matrix of a static closure gets a new elimination order.
#include <doctest/doctest.h>

#include "solve/settings.h"
#include "solve/static/newton_system.h"

namespace mvs::core::test {
namespace {

constexpr double rows = 100, first = 1e5;
constexpr double cost = settings::newton::products_per_order * rows;

}  // namespace

TEST_CASE("an order is kept while its factorisations cost no more than the first") {
  OrderLifetime order;
  CHECK_FALSE(order.is_kept());
  for (uint32_t k = 1; k < settings::newton::patterns_per_order; ++k) {
    order.begin_pattern();
    for (int factorisation = 0; factorisation < 100; ++factorisation) order.count(first, rows);
    CHECK(order.is_kept());
  }
  order.begin_pattern();
  CHECK_FALSE(order.is_kept());
}

TEST_CASE("an order ends when the products in excess of its first factorisation exceed its cost") {
  OrderLifetime order;
  order.begin_pattern();
  order.count(first, rows);
  order.begin_pattern();
  order.count(first + 0.6 * cost, rows);
  CHECK(order.is_kept());
  order.count(first + 0.6 * cost, rows);
  CHECK_FALSE(order.is_kept());
  SUBCASE("the next one begins with an excess of zero") {
    order.begin_pattern();
    order.count(first + 0.6 * cost, rows);
    order.count(first + 0.6 * cost, rows);
    CHECK(order.is_kept());
  }
}

}  // namespace mvs::core::test
