// mvs_stats reports the terms that were never computed, for each term present and absent.
#include <doctest/doctest.h>

#include <mvs/sim.h>

#include <functional>

#include "anatomy/parametric.h"
#include "energy/follower_pressure.h"
#include "model/law.h"
#include "tests/solve/bench.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr uint32_t terms = MVS_SKIPPED_SPRINGS | MVS_SKIPPED_MEMBRANE | MVS_SKIPPED_BENDING |
                           MVS_SKIPPED_CHORDAE | MVS_SKIPPED_PRESSURE;

ModelPtr valve(const std::function<void(Valve &)> &change = {}) {
  mvs_parametric_desc desc = {};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.vertices = 200;
  Valve made = make_parametric_valve(desc);
  if (change) change(made);
  return make_model(std::move(made));
}

void to_membrane(Valve &valve) {
  for (size_t k = 0; k < valve.leaflets.size(); ++k) {
    valve.leaflets[k].law = LeafletLawId::bilinear;
    valve.leaflets[k].constants =
        default_constants(find_leaflet_law(LeafletLawId::bilinear)->constants);
  }
}

// The same flags from settling by any solver and from a step.
void check_skipped(const Model &model, const Load &load, uint32_t expected) {
  State state = initial_state(model);
  state.load = load;
  SolveOptions options;
  options.max_iterations = 40;
  for (const SolverKind solver :
       {SolverKind::newton, SolverKind::implicit_euler, SolverKind::explicit_euler}) {
    CAPTURE(solver);
    options.solver = solver;
    CHECK((settle(model, state, options).stats.skipped & terms) == expected);
    if (solver == SolverKind::newton) continue;
    State stepped = state;
    CHECK((Solver(Backend::fastest).step(model, stepped, options).skipped & terms) == expected);
  }
}

}  // namespace

TEST_CASE("a_term_that_the_scene_lacks_is_reported_as_skipped") {
  const Load load = {100, 0};
  check_skipped(*valve(), load, MVS_SKIPPED_MEMBRANE);
  check_skipped(*valve(to_membrane), load, MVS_SKIPPED_SPRINGS);
  check_skipped(*valve([](Valve &v) { v.bending_scale = 0; }), load,
                MVS_SKIPPED_MEMBRANE | MVS_SKIPPED_BENDING);
  check_skipped(clamped_disc(5, 12e-3, [](Valve &) {}), load,
                MVS_SKIPPED_MEMBRANE | MVS_SKIPPED_CHORDAE);
  check_skipped(*valve(), {0, 0}, MVS_SKIPPED_MEMBRANE | MVS_SKIPPED_PRESSURE);
}

TEST_CASE("contact_is_reported_as_skipped_unless_a_pair_came_near_in_the_call") {
  const ModelPtr model = valve();
  State state = initial_state(*model);
  state.load = {MVS_SYSTOLE_PA, 1};
  Solver solver(Backend::fastest);
  CHECK((solver.step(*model, state, {}).skipped & MVS_SKIPPED_CONTACT) != 0);
  CHECK((solver.settle(*model, state, {}, {}).skipped & MVS_SKIPPED_CONTACT) == 0);
  // awake or asleep: near pairs remain in the search
  CHECK((solver.step(*model, state, {}).skipped & MVS_SKIPPED_CONTACT) == 0);
  // each call reports for itself
  state = initial_state(*model);
  CHECK((solver.step(*model, state, {}).skipped & MVS_SKIPPED_CONTACT) != 0);
}

// Without pressure the term contributes nothing, the limit of a vanishing pressure.
TEST_CASE("zero_pressure_has_zero_force_energy_and_stiffness") {
  const ModelPtr model = valve();
  const Positions x = model->valve.rest;
  FollowerPressureTerm term(*model);
  HessianAssembler system;
  std::vector<Edge> pairs;
  term.add_pairs(pairs);
  system.set_pattern(*model, pairs);
  for (const double pressure : {0.0, 1.0, 0.0}) {
    CAPTURE(pressure);
    term.set_pressure(pressure);
    term.freeze(x);
    Positions g(x.size(), Vec3::Zero()), y = g;
    system.clear();
    const double energy = term.gradient(x, g);
    term.hessian(x, system);
    term.add_skew(x, x, y);
    const bool unloaded = pressure == 0;
    CHECK(energy == term.energy(x));
    CHECK((energy == 0) == unloaded);
    CHECK((largest(g) == 0) == unloaded);
    CHECK((largest(y) == 0) == unloaded);
    CHECK((dense(system).norm() == 0) == unloaded);
  }
}
