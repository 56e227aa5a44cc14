// Unstable equilibria of valves that a settle leaves, and comes to rest elsewhere.
#include "anatomy/parametric.h"
#include "base/error.h"
#include "geometry/intersect.h"
#include "model/law.h"
#include "tests/solve/bench.h"

namespace mvs::core::test {
namespace {

// Stiff, thick tissue with short chordae. Beside its stable equilibrium, 2 um away, is an unstable
// one to which Newton's method returns from 10 um on either side.
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
  Valve valve = make_parametric_valve(desc);
  const LeafletLaw &law = *find_leaflet_law(LeafletLawId::prot);
  for (Leaflet &leaflet : valve.leaflets) {
    leaflet.law = law.id;
    leaflet.constants = default_constants(law.constants);
  }
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

}  // namespace mvs::core::test
