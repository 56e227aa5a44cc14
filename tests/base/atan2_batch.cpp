// math::atan2 for batches against std::atan2.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/atan2_batch.h"

using namespace mvs::core;

TEST_CASE("arc_tangents_match_the_standard_library_to_two_roundings") {
  std::vector<double> y, x;
  for (const double size : {1e-200, 1e-9, 1.0, 1e30}) {
    for (int k = -1000; k <= 1000; ++k) {
      for (const double most : {std::numbers::pi, 1e-3, 1e-12}) {
        y.push_back(size * std::sin(most * k / 1000));
        x.push_back(size * std::cos(most * k / 1000));
      }
    }
  }
  std::vector<double> angle(y.size());
  atan2_batch(y.data(), x.data(), angle.data(), y.size());
  for (size_t k = 0; k < y.size(); ++k) {
    const double expected = std::atan2(y[k], x[k]);
    // two roundings of the result
    CHECK(std::abs(angle[k] - expected) <= 4e-16 * std::abs(expected));
  }
}

TEST_CASE("arc_tangents_are_exact_on_the_axes") {
  const std::vector<double> y = {0, 0, 1, -1, 0}, x = {1, -1, 0, 0, 0};
  std::vector<double> angle(5);
  atan2_batch(y.data(), x.data(), angle.data(), 5);
  constexpr double pi = std::numbers::pi;
  CHECK(angle == std::vector<double>{0, pi, pi / 2, -pi / 2, 0});
}

TEST_CASE("an_arc_tangent_has_the_same_bits_alone_and_in_a_batch") {
  std::vector<double> y, x;
  for (int k = 0; k < 101; ++k) {
    y.push_back(std::sin(0.37 * k) * (1 + k % 7));
    x.push_back(std::cos(0.37 * k) * (1 + k % 7));
  }
  std::vector<double> angle(y.size());
  atan2_batch(y.data(), x.data(), angle.data(), y.size());
  for (size_t k = 0; k < y.size(); ++k) {
    double alone = 0;
    atan2_batch(&y[k], &x[k], &alone, 1);
    CHECK(alone == angle[k]);
  }
}
