// Unstable equilibria of valves that a settle leaves, and comes to rest elsewhere.
#include "anatomy/parametric.h"
#include "base/error.h"
#include "geometry/intersect.h"
#include "model/law.h"
#include "solve/nodes.h"
#include "solve/settings.h"
#include "tests/solve/bench.h"

namespace mvs::core::test {
namespace {

Model valve_with(LeafletLawId law_id, const mvs_parametric_desc &desc) {
  Valve valve = make_parametric_valve(desc);
  const LeafletLaw &law = *find_leaflet_law(law_id);
  for (Leaflet &leaflet : valve.leaflets) {
    leaflet.law = law.id;
    leaflet.constants = default_constants(law.constants);
  }
  return *make_model(std::move(valve));
}

// Both valves are of random dimensions.

// Thick tissue with short chordae. Beside its stable equilibrium, 2 um away, is an unstable one to
// which Newton's method returns from 10 um on either side.
Model valve_with_two_equilibria() {
  mvs_parametric_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.vertices = 425;
  desc.annulus_ap = 0.02829367725128498;
  desc.annulus_cc = 0.03357709030057186;
  desc.saddle_height = 0.004513119013575196;
  desc.anterior_height = 0.019850617020821634;
  desc.posterior_height = 0.017585453071792406;
  desc.commissure_height = 0.007508272362434598;
  desc.thickness = 0.0013621629075435658;
  desc.papillary_depth = 0.02165193133340341;
  desc.papillary_separation = 0.020681224225610893;
  desc.indentation_depth = 0.000788992670324824;
  desc.coaptation_depth = 0.004167122646280325;
  desc.annulus_scale = 0.9923374084104147;
  desc.chord_slack = 0.9236540898867962;
  return valve_with(LeafletLawId::prot, desc);
}

// A narrow annulus and long chordae: slack tissue at the free edge, around which Newton's method
// moves in a cycle.
Model valve_that_wanders() {
  mvs_parametric_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.vertices = 425;
  desc.annulus_ap = 0.025585958414250237;
  desc.annulus_cc = 0.04024983261565189;
  desc.saddle_height = 0.007845581574911617;
  desc.anterior_height = 0.019705726069569218;
  desc.posterior_height = 0.012501111597374943;
  desc.commissure_height = 0.007340136894992974;
  desc.thickness = 0.001338720087348921;
  desc.papillary_depth = 0.027986666436488637;
  desc.papillary_separation = 0.016452769451350047;
  desc.indentation_depth = 0.0019866573632798036;
  desc.coaptation_depth = 0.004269183548430271;
  desc.annulus_scale = 0.9235180183045181;
  desc.chord_slack = 1.069281371903097;
  Valve valve = valve_with(LeafletLawId::spring, desc).valve;
  // longer than those of the shape, which are made shorter than their distance when closed
  for (Chord &chord : valve.chords) chord.rest_length /= chord.name[0] == 'A' ? 0.97 : 0.98;
  return *make_model(std::move(valve));
}

}  // namespace

TEST_CASE("a_stable_equilibrium_beside_an_unstable_one_is_found") {
  const Model model = valve_with_two_equilibria();
  const Settled settled = settle(model, MVS_SYSTOLE_PA, 1, {});
  CHECK(settled.stats.converged);
  CHECK(settled.stats.stable);
  // 84 iterations; without an end of the cycle between both it takes all 1,000
  CHECK(settled.stats.iterations < 200);
  CHECK(find_intersections(settled.state.x, model.valve.triangles).empty());
}

TEST_CASE("a_valve_that_wanders_goes_on_in_time_and_comes_to_rest") {
  const Model model = valve_that_wanders();
  State open = initial_state(model);
  open.load = {MVS_SYSTOLE_PA, 1};
  open.time = 3;
  State state = open;
  double last = 0;
  uint32_t ends = 0;
  const SolveStats stats =
      Solver(Backend::fastest).settle(model, state, {}, [&](double share, double) {
        CHECK(share >= last);
        last = share;
        ends += share == 1 ? 1 : 0;
        return true;
      });
  CHECK(stats.converged);
  CHECK(stats.stable);
  CHECK(stats.residual <= 1e-5);
  CHECK(stats.iterations > settings::newton::wander_iterations);
  CHECK(stats.iterations < settings::defaults::newton_iterations);
  CHECK(ends == 1);
  CHECK(state.time == open.time);
  CHECK(state.steps == open.steps);
  CHECK(find_intersections(state.x, model.valve.triangles).empty());
  State again = open;
  Solver(Backend::fastest).settle(model, again, {}, {});
  CHECK(same_bits(again.x.get(), state.x.get()));
  // the steps in time count: a settle never takes more iterations than it may
  for (const uint32_t most : {200u, 400u}) {
    CAPTURE(most);
    SolveOptions options;
    options.max_iterations = most;
    State stopped = open;
    const SolveStats few = Solver(Backend::fastest).settle(model, stopped, options, {});
    CHECK_FALSE(few.converged);
    CHECK(few.iterations <= most);
    CHECK(stopped.time == open.time);
  }
}

}  // namespace mvs::core::test
