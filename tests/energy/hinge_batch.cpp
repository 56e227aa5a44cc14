// Angles and gradients of several hinges at a time have the bits of one hinge at a time.
#include <doctest/doctest.h>

#include <random>

#include "energy/bending.h"
#include "energy/hinge.h"
#include "energy/hinge_batch.h"

using namespace mvs::core;

TEST_CASE("a_batch_of_hinges_has_the_bits_of_each_alone") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-1e-3, 1e-3);
  std::vector<Vec3> x(4 * HingeBatch::most);
  for (Vec3 &point : x) {
    for (double &c : point) c = coordinate(random);
  }
  const auto nodes_of = [](size_t k) {
    const auto first = static_cast<uint32_t>(4 * k);
    return std::array<uint32_t, 4>{first, first + 1, first + 2, first + 3};
  };
  for (const size_t count : {size_t{1}, size_t{3}, size_t{8}, size_t{31}, HingeBatch::most}) {
    HingeBatch batch{}, angles_alone{};
    for (size_t k = 0; k < count; ++k) {
      batch.set_nodes(k, nodes_of(k), x);
      angles_alone.set_nodes(k, nodes_of(k), x);
    }
    find_slopes(batch, count);
    find_angles(angles_alone, count);
    for (size_t k = 0; k < count; ++k) {
      const Vec3 *at = &x[4 * k];
      Slope slope;
      HingeFold(at[0], at[1], at[2], at[3]).slopes(slope);
      CHECK(batch.angle[k] == hinge_angle(at[0], at[1], at[2], at[3]));
      CHECK(angles_alone.angle[k] == batch.angle[k]);
      for (uint32_t n = 0; n < 4; ++n) CHECK(batch.slope_at(k, n) == slope.node(n));
    }
  }
}
