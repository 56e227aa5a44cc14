// A local subproblem of a closed valve has the forces of the whole valve, and settles without
// crossing the rest. Nonlinear elimination moves only the neighbourhood of large forces, lowers the
// forces of the whole valve, and saves iterations.
#include "solve/static/local_subproblem.h"

#include <doctest/doctest.h>
#include <mvs/sim.h>

#include <algorithm>

#include "anatomy/parametric.h"
#include "energy/total_energy.h"
#include "geometry/intersect.h"
#include "linalg/mixed_precision.h"
#include "model/law.h"
#include "solve/solver.h"
#include "solve/static/mesh_hierarchy.h"
#include "solve/static/newton.h"
#include "tests/founding.h"
#include "tests/solve/bench.h"

namespace mvs::core::test {
namespace {

std::vector<Vec3> gradient(const Model &model, const std::vector<Vec3> &x) {
  TotalEnergy total_energy(model);
  Profile profile{};
  std::vector<Vec3> g;
  total_energy.set_pressure(MVS_SYSTOLE_PA);
  total_energy.prepare(x, x, 0, profile);
  total_energy.gradient(x, g, profile);
  return g;
}

}  // namespace

TEST_CASE("free_nodes_of_a_subproblem_have_the_forces_of_the_whole_valve") {
  const ModelPtr model = make_model(make_parametric_valve(founding_valve()));
  State state = closed(*model);
  std::vector<Vec3> x = state.x.get();
  const uint32_t place = model->valve.chords[3].b;
  const LocalSubproblem region = make_local_subproblem(*model, x, {place}, {8e-3, x.size(), 2e-3});
  REQUIRE(region.node.size() < x.size());
  // as far as max_displacement allows, so that tissue beyond the subproblem could come within
  // contact
  size_t free = 0;
  for (size_t k = 0; k < region.node.size(); ++k) {
    if (region.model.topology.fixed[k]) continue;
    x[region.node[k]] += Vec3(0, 1.2e-3, k % 2 == 0 ? 1e-3 : -1e-3);
    ++free;
  }
  CHECK(free > 20);
  std::vector<Vec3> piece_x;
  for (const uint32_t i : region.node) piece_x.push_back(x[i]);
  const std::vector<Vec3> whole = gradient(*model, x), piece = gradient(region.model, piece_x);
  double largest = 0, difference = 0;
  for (size_t k = 0; k < region.node.size(); ++k) {
    if (region.model.topology.fixed[k]) continue;
    largest = std::max(largest, whole[region.node[k]].norm());
    difference = std::max(difference, (whole[region.node[k]] - piece[k]).norm());
  }
  CHECK(largest > 0.1);
  // the same sums in another order and about another origin: rounding
  CHECK(difference < 1e-10 * largest);

  // hinges between held nodes are left out: their energy is constant
  size_t bending = 0;
  for (const auto &hinge : region.model.topology.hinges) {
    bending += std::any_of(hinge.begin(), hinge.end(),
                           [&](uint32_t i) { return region.model.topology.fixed[i] == 0; });
  }
  CHECK(BendingTerm(region.model).size() == bending);
  CHECK(bending < region.model.topology.hinges.size());
}

TEST_CASE("a_closed_valve_comes_to_rest_after_a_chord_is_cut_or_tightened_with_nothing_crossing") {
  Valve valve = make_parametric_valve(founding_valve());
  const State before = closed(*make_model(valve));
  for (const double factor : {0.75, 50.0}) {  // a chord of 50 times its length pulls nothing
    CAPTURE(factor);
    Valve changed = valve;
    changed.chords[3].rest_length *= factor;
    const ModelPtr model = make_model(changed);
    State first = before, again = before;
    Solver solver(Backend::fastest), used(Backend::fastest);
    State open = initial_state(*model);
    used.settle(*model, open, {}, {});
    CHECK(solver.settle(*model, first, {}, {}).converged);
    used.settle(*model, again, {}, {});
    CHECK(find_intersections(first.x, model->valve.triangles).empty());
    CHECK(hash_of(*model, first) == hash_of(*model, again));
  }
}

TEST_CASE("elimination_moves_the_neighbourhood_of_large_forces_only_and_lowers_the_forces") {
  const ModelPtr model = make_model(make_parametric_valve(founding_valve()));
  State state = closed(*model);
  const uint32_t place = model->valve.chords[3].b;
  state.x.edit()[place] += Vec3(0.02e-3, 0.02e-3, 0);
  const auto factor = make_mixed_precision_cholesky();
  Newton newton(*model, *factor);
  newton.begin(state, {});
  const double before = newton.residual();
  const std::vector<Vec3> start = newton.x();

  newton.eliminate(state.load, 2 * before);  // at rest within this tolerance
  CHECK(newton.x() == start);

  newton.eliminate(state.load, 1e-4);
  CHECK(newton.residual() < 0.1 * before);
  size_t moved = 0, far = 0;
  for (size_t i = 0; i < start.size(); ++i) {
    moved += newton.x()[i] != start[i];
    // three mean edge lengths of 1.6 mm about the few disturbed nodes, which are within 3 mm
    far += newton.x()[i] != start[i] && (start[i] - start[place]).norm() > 10e-3;
  }
  CHECK(moved > 0);
  CHECK(moved < start.size() / 4);
  CHECK(far == 0);
}

// Without elimination both take 12 iterations: few springs that pass the kink of their law make the
// error of each further step.
TEST_CASE("a_valve_of_1700_vertices_comes_to_rest_in_ten_iterations_on_its_own_mesh") {
  for (const LeafletLawId law : {LeafletLawId::spring, LeafletLawId::bilinear}) {
    CAPTURE(static_cast<int>(law));
    mvs_parametric_desc desc = founding_valve();
    desc.vertices = 1700;
    Valve valve = make_parametric_valve(desc);
    for (Leaflet &leaflet : valve.leaflets) {
      leaflet.law = law;
      leaflet.constants = default_constants(find_leaflet_law(law)->constants);
    }
    const ModelPtr model = make_model(std::move(valve));
    State state = initial_state(*model);
    state.load = {MVS_SYSTOLE_PA, 1};
    SolveOptions options;
    options.residual = 1e-4;
    Solver solver(Backend::fastest);
    const SolveStats stats = settle_with_mesh_hierarchy(solver, *model, state, options, {});
    CHECK(stats.converged);
    CHECK(stats.iterations <= 10);
    CHECK(find_intersections(state.x, model->valve.triangles).empty());
  }
}

}  // namespace mvs::core::test
