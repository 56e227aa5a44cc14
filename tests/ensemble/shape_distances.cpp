// Distances between shapes against closed forms, and the grouping of shapes into equilibria.
#include "ensemble/shape_distances.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "anatomy/parametric.h"
#include "ensemble/loading_path.h"
#include "tests/about.h"

using namespace mvs::core;
using mvs::core::test::about;

TEST_CASE("a translated sheet is apart by its translation") {
  mvs_parametric_desc desc = {};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.vertices = 250;
  const ModelPtr model = make_model(make_parametric_valve(desc));
  const Shape a = model->valve.rest;
  Shape b = a;
  for (Vec3 &x : b) x += Vec3(3e-3, 0, 4e-3);
  const Apart apart = nodes_apart(*model, a, b);
  CHECK(apart.rms == about(5e-3, 1e-12));
  CHECK(apart.max == about(5e-3, 1e-12));
  // heads and branch points do not belong to the shape
  Shape c = a;
  c[model->valve.heads[0].node] += Vec3(1, 0, 0);
  CHECK(nodes_apart(*model, a, c).max == 0);
}

TEST_CASE("the deviation of a node is that of its positions") {
  const Shape a = {Vec3(0, 0, 1), Vec3(0, 0, 0)}, b = {Vec3(0, 0, 1), Vec3(0, 2, 0)};
  const Shape c = {Vec3(0, 0, 1), Vec3(0, 4, 0)};
  const std::vector<double> spread = node_deviation(2, {&a, &b, &c});
  CHECK(spread[0] == 0);
  CHECK(spread[1] == about(std::sqrt(8.0 / 3), 1e-14));
  CHECK(node_deviation(2, {}) == std::vector<double>{0, 0});
  CHECK(node_deviation(2, {&b}) == std::vector<double>{0, 0});
}

TEST_CASE(
    "equilibria are numbered in order of appearance, and a shape out of balance has no number") {
  // places on a line: 0, 5, 0.5, 5.4, 9
  const std::vector<double> at = {0, 5, 0.5, 5.4, 9};
  std::vector<double> farthest;
  for (const double a : at) {
    for (const double b : at) farthest.push_back(std::abs(a - b));
  }
  using Numbers = std::vector<uint32_t>;
  CHECK(find_equilibria(farthest, {1, 1, 1, 1, 1}, 1) == Numbers{0, 1, 0, 1, 2});
  CHECK(find_equilibria(farthest, {0, 1, 1, 1, 0}, 1) == Numbers{none, 0, 1, 0, none});
  CHECK(find_equilibria(farthest, {1, 1, 1, 1, 1}, 0) == Numbers{0, 1, 2, 3, 4});
}

TEST_CASE("the first fifteen loading paths differ") {
  std::vector<std::pair<uint32_t, LoadingOrder>> ways;
  for (uint32_t k = 0; k < 30; ++k) {
    const Path path = make_path(k, {0.5e-3, 5e-3}, 3);
    CHECK(path.plain == (k == 0));
    CHECK((path.disturbance.longest > 0) == (k > 0));
    // in time only where the pressure is applied in many steps
    CHECK((path.ramp > 0) == (path.increments == 60));
    ways.push_back({path.increments, path.order});
  }
  for (size_t k = 0; k < 15; ++k) {
    CHECK(ways[k] == ways[k + 15]);
    for (size_t j = 0; j < k; ++j) CHECK(ways[j] != ways[k]);
  }
}

// A balloon: neo-Hookean leaflets of 5 kPa bear no systolic pressure.
TEST_CASE("a member that diverged is not at rest though its start was") {
  mvs_parametric_desc desc = {};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.vertices = 200;
  Valve valve = make_parametric_valve(desc);
  for (Leaflet &leaflet : valve.leaflets.edit()) {
    leaflet.law = LeafletLawId::neo_hookean;
    leaflet.constants = {5e3};
  }
  const ModelPtr model = make_model(std::move(valve));
  State start = initial_state(*model);
  Solver solver(Backend::fastest);
  REQUIRE(solver.settle(*model, start, {}, {}).converged);
  REQUIRE(start.is_at_rest());
  const Path path = make_path(1, {0.5e-3, 5e-3}, 0);
  const Closing closing = close_along(solver, *model, start, {MVS_SYSTOLE_PA, 1}, {}, path, {});
  CHECK(closing.diverged);
  CHECK(!closing.state.is_at_rest());
}

TEST_CASE("every loading path ends under the requested load") {
  mvs_parametric_desc desc = {};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.vertices = 200;
  desc.annulus_contraction = 0.9;  // so that the boundary moves
  const ModelPtr model = make_model(make_parametric_valve(desc));
  const State start = initial_state(*model);
  Solver solver(Backend::fastest);
  const Load load{4e3, 1};
  for (uint32_t k = 0; k < 9; ++k) {
    std::vector<double> shares;
    const Progress note = [&](double share, double) {
      shares.push_back(share);
      return true;
    };
    const Path path = make_path(k, {0.5e-3, 5e-3}, 0);
    const Closing closing = close_along(solver, *model, start, load, {}, path, note);
    CHECK(closing.stats.converged);
    CHECK(std::abs(closing.state.time - path.ramp) <= 1e-12 * path.ramp);
    CHECK(closing.state.load.pressure == load.pressure);
    CHECK(closing.state.load.boundary_fraction == 1);
    CHECK(std::is_sorted(shares.begin(), shares.end()));
    // the boundary is at its target to the bit
    for (uint32_t i = 0; i < model->node_count(); ++i) {
      if (model->topology.fixed[i]) CHECK(closing.state.x[i] == model->target(i, 1));
    }
  }
}
