// The gradient of the coaptation area with respect to positions against central differences.
#include "sensitivity/coaptation_gradient.h"

#include <doctest/doctest.h>

#include "measure/coaptation/coaptation.h"
#include "tests/sensitivity/random_valves.h"

namespace mvs::core::test {

TEST_CASE("coaptation_gradient_is_that_of_differences") {
  Random random(11);
  RandomValve closed = closed_valve(random);
  std::vector<Vec3> x = closed.state.x;
  NodeField g(x.size(), Vec3::Zero());
  const double area = coaptation_area_gradient(*closed.model, x, g);
  CHECK(area == about(measure_coaptation(*closed.model, x).area, 1e-12));
  REQUIRE(area > 1e-5);
  const NodeField direction = random.vectors(x.size(), 1);
  double slope = 0;
  for (size_t i = 0; i < x.size(); ++i) slope += g[i].dot(direction[i]);
  const double h = 1e-9;
  const auto at = [&](double by) {
    std::vector<Vec3> moved = x;
    for (size_t i = 0; i < x.size(); ++i) moved[i] += by * direction[i];
    return measure_coaptation(*closed.model, moved).area;
  };
  // kinks of single samples within 1e-9 m, and the rounding of 1e-16 / 1e-9
  CHECK((at(h) - at(-h)) / (2 * h) == about(slope, 1e-5));
}

}  // namespace mvs::core::test
