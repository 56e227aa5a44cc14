// Linear iterations of the statistics: none where a factor solves the system, one or more for each
// solution by an iterative solver, those of local settles left out, those of coarser meshes and of
// margins of stability added.
#include <doctest/doctest.h>
#include <mvs/sim.h>

#include <algorithm>

#include "anatomy/family_level.h"
#include "anatomy/parametric.h"
#include "solve/hierarchy_settings.h"
#include "solve/nodes.h"
#include "solve/settings.h"
#include "solve/solver.h"
#include "solve/static/mesh_hierarchy.h"
#include "tests/solve/bench.h"
#include "tests/solve/founding_model.h"

namespace mvs::core::test {
namespace {

SolveStats settle_by(Backend backend, const Model &model, State state, const SolveOptions &how) {
  Solver solver(backend);
  return solver.settle(model, state, how, {});
}

}  // namespace

TEST_CASE("a_factor_in_double_precision_needs_no_linear_iterations_far_from_rest") {
  const ModelPtr model = founding_model(425);
  SolveOptions how;
  how.max_iterations = 3;
  const SolveStats direct = settle_by(Backend::block, *model, under_systole(*model), how);
  REQUIRE(direct.iterations == 3);
  CHECK(direct.factorisations >= 3);
  CHECK(direct.work.linear_iterations == 0);
  // one in single precision is a preconditioner: every solution iterates
  const SolveStats mixed = settle_by(Backend::fastest, *model, under_systole(*model), how);
  REQUIRE(mixed.iterations == 3);
  CHECK(mixed.work.linear_iterations >= 3);
}

TEST_CASE("the_skew_load_near_rest_is_solved_by_linear_iterations") {
  const ModelPtr model = founding_model(425);
  State state = closed(*model);
  state.load.pressure *= 1.001;
  SolveOptions how;
  how.margins = false;
  const SolveStats stats = settle_by(Backend::block, *model, state, how);
  REQUIRE(stats.converged);
  REQUIRE(stats.iterations > 0);
  // GMRES applies the factor to the right-hand side, and to one product or more
  CHECK(stats.work.linear_iterations >= 2 * stats.iterations);
}

TEST_CASE("margins_of_stability_add_their_iterations") {
  const ModelPtr model = founding_model(425);
  const State state = closed(*model);
  SolveOptions how;
  how.margins = false;
  const SolveStats without = settle_by(Backend::fastest, *model, state, how);
  REQUIRE(without.converged);
  REQUIRE(without.iterations == 0);
  CHECK(without.work.linear_iterations == 0);
  how.margins = true;
  const SolveStats with = settle_by(Backend::fastest, *model, state, how);
  REQUIRE(with.iterations == 0);
  // of two eigenvalues
  CHECK(with.work.linear_iterations >= 2);
  CHECK(with.work.linear_iterations <= 2 * settings::stability::most_iterations);
}

TEST_CASE("local_settles_count_no_linear_iterations") {
  const ModelPtr model = founding_model(425);
  State state = closed(*model);
  const double rest_force = scale_of(state.load) * mean_area(*model);
  // a chord that pulls harder disturbs few nodes
  Valve valve = model->valve;
  valve.chords[3].rest_length *= 0.99;
  const ModelPtr changed = make_model(valve, model.get());
  SolveOptions how;
  how.checks_stability = false;
  how.residual = rest_force;
  const SolveStats none = settle_by(Backend::fastest, *model, state, how);
  const SolveStats stats = settle_by(Backend::fastest, *changed, state, how);
  REQUIRE(stats.converged);
  // the local settle brings the whole valve to this residual, with more passes than the one that
  // finds a valve at rest
  REQUIRE(stats.iterations == 0);
  CHECK(stats.work.passes > none.work.passes + 1);
  CHECK(stats.work.linear_iterations == 0);
}

TEST_CASE("a_settle_over_a_hierarchy_adds_the_linear_iterations_of_coarser_meshes") {
  namespace set = settings::mesh_hierarchy;
  const ModelPtr model = founding_model(1700);
  SolveOptions how;
  how.margins = false;
  Solver solver(Backend::fastest), other(Backend::fastest);
  State state = under_systole(*model);
  const SolveStats whole = settle_with_mesh_hierarchy(solver, *model, state, how, {});
  REQUIRE(whole.converged);
  REQUIRE(whole.discarded == 0);
  // the coarser mesh as the hierarchy settles it
  const size_t vertices = sheet_vertices(*model) / set::coarsening;
  const auto made =
      coarsen_in_family(*model, std::max(vertices, set::bilinear.min_coarse_vertices));
  SolveOptions coarse;
  coarse.residual = std::max(
      how.tolerance(), set::bilinear.coarse_residual * MVS_SYSTOLE_PA * mean_area(*made->model));
  coarse.max_iterations = set::max_coarse_iterations;
  coarse.checks_stability = false;
  State below = under_systole(*made->model);
  const SolveStats coarser = settle_with_mesh_hierarchy(other, *made->model, below, coarse, {});
  CHECK(coarser.work.linear_iterations >= coarser.iterations);
  // `iterations` are those of the finest mesh, each with a solution or more
  CHECK(whole.work.linear_iterations >= coarser.work.linear_iterations + whole.iterations);
  CHECK(whole.factorisations >= coarser.factorisations + whole.iterations);
}

TEST_CASE("a_valve_asleep_takes_no_linear_iterations_and_one_awake_no_more_than_its_budget") {
  const ModelPtr model = founding_model(425);
  State state = closed(*model);
  Solver solver(Backend::fastest);
  SolveOptions how;
  how.solver = SolverKind::implicit_euler;
  how.dt = 1e-3;
  uint32_t awake = 0;
  state.load.pressure *= 1.05;
  for (int k = 0; k < 20; ++k) {
    const SolveStats stats = solver.step(*model, state, how);
    awake += stats.work.linear_iterations;
    CHECK(stats.work.linear_iterations <= settings::defaults::budget);
  }
  CHECK(awake > 0);
  State still = closed(*model);
  const SolveStats asleep = solver.step(*model, still, how);
  CHECK(asleep.work.linear_iterations == 0);
}

}  // namespace mvs::core::test
