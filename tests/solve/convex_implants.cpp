// Convex tools and implants: the stitches of a clip are chordae of the thickness of a suture; a
// ring has no thickness of its own and lies on the annulus that it holds (surgery/OPERATIONS.md).
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "energy/forces.h"
#include "geometry/distance.h"
#include "solve/tools/tool_stiffness.h"
#include "tests/solve/bench.h"
#include "tests/solve/convex_tools.h"
#include "tests/surgery/operated.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

mvs_parametric_desc coarse_valve() {
  mvs_parametric_desc desc = founding_valve();
  desc.vertices = 200;
  return desc;
}

const Chord &first_stitch(const Model &model) {
  const auto &chords = model.valve.chords.get();
  return *std::find_if(chords.begin(), chords.end(),
                       [](const Chord &c) { return c.kind == ChordKind::suture; });
}

// The open valve with a clip, and the middle of its first stitch, which crosses the orifice.
struct Clipped {
  Clipped() {
    const Operated clipped = apply(before, op_of<mvs_op_clip>(MVS_OP_CLIP));
    model = clipped.current.model;
    state = clipped.current.state;
    stitch = first_stitch(*model);
    const Vec3 a = state.x[stitch.a], b = state.x[stitch.b];
    middle = 0.5 * (a + b);
    along = (b - a).normalized();
    away = along.unitOrthogonal();
  }
  // A bar across the stitch, with a gap between both surfaces.
  Tool bar(double gap) const {
    const double off = 0.5e-3 + chord_radius(stitch) + gap;
    return convex_at(middle + off * away, {capsule_body(along.cross(away), 1.5e-3, 0.5e-3)});
  }

  ModelState before = shipped(coarse_valve());
  ModelPtr model;
  State state;
  Chord stitch;
  Vec3 middle, along, away;
};

State with_tool(const Model &model, State state, const Tool &tool) {
  add_tool(model, state, tool);
  return state;
}

// The core of a tool of one capsule.
std::array<Vec3, 2> core_of(const Tool &tool) {
  std::vector<Vec3> ends;
  place_body(*tool.shape, 0, tool.proxy, ends);
  return {ends[0], ends[1]};
}

double distance_to_curve(const std::array<Vec3, 2> &core, const std::vector<Vec3> &curve) {
  double least = 1;
  for (size_t k = 0; k < curve.size(); ++k) {
    const Vec3 &a = curve[k], &b = curve[(k + 1) % curve.size()];
    least = std::min(least, closest_of_segments(core[0], core[1], a, b).distance2);
  }
  return std::sqrt(least);
}

}  // namespace

TEST_CASE("a_convex_tool_lies_in_no_stitch_of_a_clip") {
  const Clipped clip;
  const Tool ball = convex_at(clip.middle, {ball_body(0.2e-3)});
  State state = clip.state;
  CHECK_THROWS_WITH(add_tool(*clip.model, state, ball),
                    doctest::Contains("or a chord: its surface"));
  // the stitch alone is in its way
  State unclipped = clip.before.state;
  CHECK(add_tool(*clip.before.model, unclipped, ball) != 0);
}

TEST_CASE("a_stitch_of_a_clip_feels_a_convex_tool_within_range") {
  const Clipped clip;
  const double range = tool_range(*clip.model);
  const State near = with_tool(*clip.model, clip.state, clip.bar(0.1 * range));
  const State apart = with_tool(*clip.model, clip.state, clip.bar(1.1 * range));
  const Forces pushed = evaluate_forces(*clip.model, near),
               free = evaluate_forces(*clip.model, apart);
  Vec3 on_stitch = Vec3::Zero();
  for (const uint32_t node : {clip.stitch.a, clip.stitch.b})
    on_stitch += pushed.total[node] - free.total[node];
  CHECK(on_stitch.dot(clip.away) < -1e-3);
  // across it alone: there is no friction
  CHECK(std::abs(on_stitch.dot(clip.along)) <= 1e-9 * on_stitch.norm());
}

// The stitches of an open valve draw the leaflets together as fast as they can.
TEST_CASE("a_convex_tool_is_not_passed_by_a_stitch_that_contracts") {
  const Clipped clip;
  State state = with_tool(*clip.model, clip.state, clip.bar(0.5e-3));
  Solver solver(Backend::fastest);
  bool touches = false;
  for (int k = 0; k < 60; ++k) {
    state.tools[0].position -= 0.2e-3 * clip.away;
    solver.step(*clip.model, state, {});
    const double room = clearance(*clip.model, state.x, state.tools[0]);
    REQUIRE(room > 0);
    touches = touches || room < tool_range(*clip.model);
  }
  CHECK(touches);
}

// From outside, where there is no tissue: the polygon of the annulus lies up to 0.1 mm inside of
// the curve, at 24 nodes around it.
TEST_CASE("a_convex_tool_does_not_pass_a_ring") {
  auto ring = op_of<mvs_op_ring>(MVS_OP_RING);
  ring.size = 30 * mm;
  const Operated ringed = apply(shipped(coarse_valve()), ring);
  const Model &model = *ringed.current.model;
  const State start = settle(model, ringed.current.state).state;
  const std::vector<Vec3> curve = model.valve.rings[0].curve;
  const std::vector<uint32_t> annulus = model.valve.annulus;
  Vec3 centre = Vec3::Zero();
  for (const uint32_t node : annulus) centre += start.x[node] / static_cast<double>(annulus.size());
  for (size_t k = 0; k < annulus.size(); k += annulus.size() / 8) {
    CAPTURE(k);
    const Vec3 at = start.x[annulus[k]];
    Vec3 outwards = at - centre;
    outwards.z() = 0;
    outwards.normalize();
    const Tool bar = convex_at(at + 3e-3 * outwards, {capsule_body(Vec3::UnitZ(), 6e-3, 0.5e-3)});
    State state = with_tool(model, start, bar);
    Solver solver(Backend::fastest);
    for (int step = 0; step < 60; ++step) {
      state.tools[0].position -= 0.1e-3 * outwards;
      solver.step(model, state, {});
      REQUIRE(distance_to_curve(core_of(state.tools[0]), curve) > 0.4e-3);
    }
    // the hand is 3 mm past the ring
    CHECK(force_of(state, state.tools[0]).force.dot(outwards) > 0.3);
  }
}
