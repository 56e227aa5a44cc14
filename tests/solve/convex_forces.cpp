// Forces of convex tools: the derivatives of their energy, and continuous as tissue slides over
// them.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "energy/instrument.h"
#include "solve/tools/tool_points.h"
#include "tests/model/small_valve.h"
#include "tests/solve/bench.h"
#include "tests/solve/convex_tools.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

// The valve with its tool points, all of them free, and an instrument term prepared at x.
struct Bench {
  explicit Bench(const Model &valve, const State &state)
      : model(points.extend(valve, tool_points(state.tools))),
        x(ToolPoints::extended(state).x.get()),
        term(model) {
    for (size_t i = 0; i < model.topology.fixed.size(); ++i) model.topology.fixed[i] = 0;
    term.bodies().set_tools(state.tools, static_cast<uint32_t>(valve.node_count()));
    term.bodies().prepare(x, x, 1e-4);
  }
  double energy(const Positions &at) {
    term.collect(at);
    return term.energy(at);
  }
  Positions gradient(const Positions &at) {
    Positions g(at.size(), Vec3::Zero());
    term.collect(at);
    CHECK(term.gradient(at, g) == term.energy(at));
    return g;
  }

  ToolPoints points;
  Model model;
  Positions x;
  InstrumentTerm term;
};

}  // namespace

TEST_CASE("a_convex_tool_has_the_gradient_and_hessian_of_its_energy") {
  const ModelPtr valve = make_model(small_valve());
  State state = initial_state(*valve);
  const double near = 0.08 * valve->valve.contact_thickness;
  // a corner, an edge and a face of rounded bodies near triangles, and a capsule along a chord
  const Place at = place_above(*valve, state.x, 40, near);
  add_tool(*valve, state, convex_at(at.point, {cone_body(at.normal, 4e-3, 2e-3, 0)}));
  const Place beside = place_above(*valve, state.x, 60, -0.5e-3 - near);
  add_tool(*valve, state,
           convex_at(beside.point, {bar_body(beside.along, -beside.normal, 0.5e-3)}));
  const Chord &chord = valve->valve.chords[3];
  const Vec3 a = state.x[chord.a], b = state.x[chord.b];
  const Vec3 across = (b - a).cross(Vec3(1, 2, 3)).normalized();
  const double off = 0.7e-3 + chord_radius(chord) + near;
  add_tool(
      *valve, state,
      convex_at(0.5 * (a + b) + off * across, {capsule_body(across.cross(b - a), 6e-3, 0.7e-3)}));
  Bench bench(*valve, state);
  bench.term.collect(bench.x);
  REQUIRE(bench.term.convex().contacts().size() >= 4);
  // the frames stretched, so that their springs act
  Random random(1);
  for (size_t i = valve->node_count(); i < bench.x.size(); ++i) bench.x[i] += random.vector(1e-5);
  const auto energy = [&](const Positions &x) { return bench.energy(x); };
  const auto gradient = [&](const Positions &x) { return bench.gradient(x); };
  // the barrier bends within a tenth of the thickness: differences over 1e-5 of that
  const double h = 1e-9;
  CHECK(farthest(differences(energy, bench.x, h), gradient(bench.x)) <=
        1e-5 * largest(gradient(bench.x)));
  HessianAssembler system;
  std::vector<Edge> pairs;
  bench.term.collect(bench.x);
  bench.term.add_pairs(pairs);
  system.set_pattern(bench.model, pairs);
  system.clear();
  CHECK(bench.term.hessian(bench.x, Curvature::exact, system));
  const Eigen::MatrixXd found = dense(system), wanted = differences(gradient, bench.x, h);
  CHECK((found - wanted).norm() <= 1e-5 * wanted.norm());
}

namespace {

// A rounded box close above a disc, which slides over it by 3 mm while it tilts from -0.01 to 0.01
// rad: edges of the mesh pass its edges, and its lower side passes through being parallel to all
// triangles. The gap is 40 to 80 um of 100 um, the range of triangles.
Positions forces_at(const Model &disc, double share) {
  State state = initial_state(disc);
  Tool tool = convex_at(Vec3(3e-3 * share - 1.5e-3, 0.4e-3, 1.26e-3),
                        {box_body(Vec3(2e-3, 1.5e-3, 1e-3), 0.2e-3)});
  tool.axis.y() = 0.25 * 0.01 * (2 * share - 1);  // a quarter of the angle
  add_tool(disc, state, tool);
  Bench bench(disc, state);
  return bench.gradient(bench.x);
}

// The largest change of the forces between neighbours of so many places.
double largest_change(const Model &disc, int places) {
  double most = 0;
  Positions before = forces_at(disc, 0);
  for (int k = 1; k <= places; ++k) {
    const Positions now = forces_at(disc, static_cast<double>(k) / places);
    most = std::max(most, farthest(now, before));
    before = now;
  }
  return most;
}

}  // namespace

TEST_CASE("the_force_of_a_convex_tool_is_continuous_as_edges_slide_over_it") {
  const Model disc = clamped_disc(8, 12e-3, [](Valve &) {});
  const double coarse = largest_change(disc, 200), fine = largest_change(disc, 2000);
  MESSAGE("largest change of a force: " << coarse << " and " << fine << " N");
  CHECK(coarse > 1e-5);
  CHECK(fine <= 0.2 * coarse);  // of 0.1
}
