// Nested iteration over coarser meshes gives the shape of the plain closure with less work, and is
// skipped where it would not pay.
#include "solve/static/mesh_hierarchy.h"

#include <doctest/doctest.h>
#include <mvs/sim.h>

#include <random>

#include "anatomy/parametric.h"
#include "anatomy/refine.h"
#include "base/error.h"
#include "geometry/intersect.h"
#include "model/law.h"
#include "solve/hierarchy_settings.h"
#include "solve/nodes.h"
#include "solve/static/untangle.h"
#include "tests/solve/founding_model.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

double farthest(const State &a, const State &b) {
  double most = 0;
  for (size_t i = 0; i < a.x.size(); ++i) most = std::max(most, (a.x[i] - b.x[i]).norm());
  return most;
}

}  // namespace

TEST_CASE("a_large_valve_closes_to_the_shape_of_the_plain_closure_in_fewer_iterations") {
  const ModelPtr model = founding_model(1700);
  Solver solver(Backend::fastest);
  State plain = under_systole(*model), levels = plain, again = plain;
  const SolveStats direct = solver.settle(*model, plain, {}, {});
  const SolveStats stats = settle_with_mesh_hierarchy(solver, *model, levels, {}, {});
  CHECK(stats.converged);
  CHECK(stats.residual <= 1e-5);
  CHECK(stats.iterations < direct.iterations);
  CHECK(stats.factorisations > stats.iterations);  // those of the coarse mesh are counted
  CHECK(find_intersections(levels.x, model->valve.triangles).empty());
  // this valve has one closed shape; forces of 1e-5 N move its softest nodes by micrometres
  CHECK(farthest(plain, levels) < 0.01e-3);
  CHECK(levels.load.pressure == MVS_SYSTOLE_PA);
  Solver other(Backend::fastest);
  settle_with_mesh_hierarchy(other, *model, again, {}, {});
  CHECK(hash_of(*model, again) == hash_of(*model, levels));
}

TEST_CASE("a_small_valve_and_one_near_rest_are_settled_without_a_hierarchy") {
  Solver solver(Backend::fastest);
  for (const uint32_t vertices : {300u, 1700u}) {
    const ModelPtr model = founding_model(vertices);
    State plain = under_systole(*model);
    if (vertices > settings::mesh_hierarchy::bilinear.min_vertices) {
      solver.settle(*model, plain, {}, {});
      plain.load.pressure *= 1.02;
      CHECK_FALSE(far_from_rest(*model, plain));
      CHECK_FALSE(solver.begin_settle(*model, plain, {}, {})->begins_far_from_rest());
    }
    State levels = plain;
    solver.settle(*model, plain, {}, {});
    settle_with_mesh_hierarchy(solver, *model, levels, {}, {});
    CHECK(hash_of(*model, plain) == hash_of(*model, levels));
  }
}

TEST_CASE("noise_of_a_micrometre_is_not_far_from_rest") {
  // as positions that were rounded have it; coarser meshes could lead to another fold
  Solver solver(Backend::fastest);
  for (const uint32_t vertices : {620u, 1700u}) {
    const ModelPtr model = founding_model(vertices);
    State closed = under_systole(*model);
    REQUIRE(settle_with_mesh_hierarchy(solver, *model, closed, {}, {}).converged);
    State noisy = closed;
    std::mt19937 random(7);
    for (size_t i = 0; i < noisy.x.size(); ++i) {
      if (model->topology.fixed[i]) continue;
      // of the bits of the generator alone: distributions differ between libraries
      const auto next = [&] { return (static_cast<double>(random()) / 2147483648.0 - 1) * 1e-6; };
      const double x = next(), y = next(), z = next();
      noisy.x.edit()[i] += Vec3(x, y, z);
    }
    noisy.rest_tolerance = 0;
    REQUIRE(far_from_rest(*model, noisy));  // by the forces of single nodes
    CHECK_FALSE(solver.begin_settle(*model, noisy, {}, {})->begins_far_from_rest());
    const SolveStats stats = settle_with_mesh_hierarchy(solver, *model, noisy, {}, {});
    CHECK(stats.converged);
    CHECK(stats.iterations <= 6);  // springs pass their kink; a closure has 11 and more
    CHECK(farthest(closed, noisy) < 1e-6);
  }
}

TEST_CASE("a_settle_knows_whether_it_begins_far_from_rest") {
  const ModelPtr model = founding_model(500);
  Solver solver(Backend::fastest);
  State state = under_systole(*model);
  const auto begins_far = [&] {
    return solver.begin_settle(*model, state, {}, {})->begins_far_from_rest();
  };
  CHECK(begins_far());  // open under the full load
  solver.settle(*model, state, {}, {});
  CHECK_FALSE(begins_far());
  state.load.boundary_fraction = 0.5;  // the annulus is to move
  CHECK(begins_far() == far_from_rest(*model, state));
}

TEST_CASE("a_coarse_mesh_leads_away_from_nodes_in_one_place") {
  const ModelPtr model = founding_model(500);
  Solver solver(Backend::fastest);
  State state = under_systole(*model);
  std::vector<Vec3> x = state.x;
  const Tri &t = model->valve.triangles[0];
  x[t[0]] = x[t[1]];
  state.x = x;
  State plain = state;
  // the triangle is flat and the angles of its hinges are not defined
  CHECK_THROWS_AS(solver.settle(*model, plain, {}, {}), Error);
  CHECK(settle_with_mesh_hierarchy(solver, *model, state, {}, {}).converged);
}

TEST_CASE("exponential_tissue_closes_over_a_bilinear_surrogate_in_fewer_iterations") {
  Valve valve = founding_model(1300)->valve;
  const LeafletLaw &law = *find_leaflet_law(LeafletLawId::fung);
  for (Leaflet &leaflet : valve.leaflets) {
    leaflet.law = law.id;
    leaflet.constants = default_constants(law.constants);
  }
  const ModelPtr model = make_model(std::move(valve));
  Solver solver(Backend::fastest);
  State plain = under_systole(*model), levels = plain, again = plain;
  const SolveStats direct = solver.settle(*model, plain, {}, {});
  const SolveStats stats = settle_with_mesh_hierarchy(solver, *model, levels, {}, {});
  CHECK(stats.converged);
  CHECK(stats.stable);
  CHECK(stats.residual <= 1e-5);
  CHECK(stats.iterations < direct.iterations);
  CHECK(find_intersections(levels.x, model->valve.triangles).empty());
  // from rest the settle of the true law goes on: the surrogate leaves nothing behind
  State more = levels;
  CHECK(solver.settle(*model, more, {}, {}).iterations == 0);
  settle_with_mesh_hierarchy(solver, *model, again, {}, {});
  CHECK(hash_of(*model, again) == hash_of(*model, levels));
}

TEST_CASE("overstretched_exponential_tissue_is_settled_as_a_bilinear_one_first") {
  Valve valve = founding_model(425)->valve;
  const LeafletLaw &law = *find_leaflet_law(LeafletLawId::fung);
  for (Leaflet &leaflet : valve.leaflets) {
    leaflet.law = law.id;
    leaflet.constants = default_constants(law.constants);
  }
  const ModelPtr model = make_model(std::move(valve));
  Solver solver(Backend::fastest);
  State closed = under_systole(*model);
  REQUIRE(solver.settle(*model, closed, {}, {}).converged);
  const double rest_force = MVS_SYSTOLE_PA * mean_area(*model);
  // tissue between one node of the anterior leaflet and its neighbours is stretched as at a clip
  const uint32_t moved = model->topology.free_edges.front()[0];
  for (const double distance : {0.1e-3, 8e-3}) {
    State plain = closed;
    plain.x.edit()[moved] += Vec3(0, 0, -distance);
    State levels = plain;
    const double first = solver.begin_settle(*model, plain, {}, {})->largest_first_force();
    CHECK(solver.settle(*model, plain, {}, {}).converged);
    CHECK(settle_with_mesh_hierarchy(solver, *model, levels, {}, {}).converged);
    const bool is_plain = hash_of(*model, plain) == hash_of(*model, levels);
    CHECK(is_plain == (first < settings::mesh_hierarchy::overstretched * rest_force));
  }
}

TEST_CASE("progress_increases_over_the_levels_and_can_cancel") {
  const ModelPtr model = founding_model(1300);
  Solver solver(Backend::fastest);
  State state = under_systole(*model);
  double last = 0;
  int calls = 0;
  settle_with_mesh_hierarchy(solver, *model, state, {}, [&](double share, double) {
    CHECK(share >= last);
    CHECK(share <= 1);
    last = share;
    ++calls;
    return true;
  });
  CHECK(calls > 20);
  for (const int most : {2, calls - 3}) {
    State stopped = under_systole(*model);
    int told = 0;
    CHECK_THROWS_AS(settle_with_mesh_hierarchy(solver, *model, stopped, {},
                                               [&](double, double) { return ++told < most; }),
                    Error);
    CHECK(told == most);
  }
}

TEST_CASE("a_few_crossings_of_a_finer_mesh_are_untangled") {
  const ModelPtr coarse = founding_model(250);
  State closed = under_systole(*coarse);
  REQUIRE(Solver(Backend::fastest).settle(*coarse, closed, {}, {}).converged);
  const ModelPtr fine = make_model(refine(*coarse), nullptr);
  const LevelMap map = make_level_map(*coarse, *fine);
  State start = to_fine(map, *coarse, *fine, closed);
  const auto &triangles = fine->valve.triangles;
  REQUIRE(find_intersections(start.x, triangles).empty());
  // pushes some free nodes of one leaflet through the tissue that they touch
  const double thickness = fine->valve.contact_thickness;
  uint32_t tried = 0;
  for (uint32_t i = 0; i < start.x.size() && tried < 6; i += 5) {
    std::vector<Vec3> x = start.x;
    uint32_t nearest = i;
    for (uint32_t j = 0; j < x.size(); ++j) {
      const double rest = (fine->valve.rest[i] - fine->valve.rest[j]).norm();
      const double now = (x[i] - x[j]).norm();
      if (rest < 10 * thickness || now > 1.2 * thickness) continue;
      if (nearest == i || now < (x[i] - x[nearest]).norm()) nearest = j;
    }
    if (nearest == i || fine->topology.fixed[i]) continue;
    x[i] += 1.3 * (x[nearest] - x[i]);
    const std::vector<Vec3> tangled = x;
    const Untangled done = untangle(map, closed.x, *fine, x);
    if (done.found == 0) continue;
    ++tried;
    CHECK(done.left == 0);
    CHECK(find_intersections(x, triangles).empty());
    const double most = settings::untangle::rounds * settings::untangle::increment * thickness;
    for (uint32_t j = 0; j < x.size(); ++j) {
      CHECK((x[j] - tangled[j]).norm() <= (fine->topology.fixed[j] ? 0 : 1.000001 * most));
    }
  }
  CHECK(tried == 6);
}

TEST_CASE("a_shape_that_cannot_be_untangled_stays_as_it_is") {
  const ModelPtr coarse = founding_model(250);
  const State closed = under_systole(*coarse);
  const ModelPtr fine = make_model(refine(*coarse), nullptr);
  const LevelMap map = make_level_map(*coarse, *fine);
  std::vector<Vec3> x = to_fine(map, *coarse, *fine, closed).x;
  for (size_t i = 0; i < x.size(); ++i) {
    if (!fine->topology.fixed[i])
      x[i] +=
          5e-3 * Vec3(static_cast<int>(i % 2), static_cast<int>(i % 3), static_cast<int>(i % 5));
  }
  const std::vector<Vec3> before = x;
  const Untangled done = untangle(map, closed.x, *fine, x);
  CHECK(done.found > settings::untangle::max_crossings);
  CHECK(done.left > 0);
  CHECK(x == before);
}
