// Convex tools at work: random pushes without crossing, a chord on a hook and on a plate.
#include <doctest/doctest.h>

#include <mvs/sim.h>

#include <Eigen/Geometry>
#include <cmath>

#include "geometry/intersect.h"
#include "solve/tools/tool_stiffness.h"
#include "tests/model/small_valve.h"
#include "tests/short_run.h"
#include "tests/solve/bench.h"
#include "tests/solve/convex_tools.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

Vec3 lowest_corner(std::span<const Vec3> points) {
  Vec3 low = points[0];
  for (const Vec3 &p : points) low = low.cwiseMin(p);
  return low;
}

Vec3 highest_corner(std::span<const Vec3> points) {
  Vec3 high = points[0];
  for (const Vec3 &p : points) high = high.cwiseMax(p);
  return high;
}

// Whether the core of a body, the hull of its vertices, has a point in common with a triangle or a
// chord (the same node twice): signs of exact arithmetic.
bool body_crosses(const ToolShape &shape, size_t body, std::span<const Vec3> v,
                  std::span<const Vec3> part) {
  if (((lowest_corner(part) - highest_corner(v)).array() > 0).any()) return false;
  if (((lowest_corner(v) - highest_corner(part)).array() > 0).any()) return false;
  const std::array<Vec3, 3> t = {part[0], part[1], part.back()};
  if (v.size() == 1) return false;
  if (v.size() == 2) return segment_crosses_triangle(v[0], v[1], t[0], t[1], t[2]);
  bool is_inside = true;
  for (const Tri &f : shape.faces(body)) {
    const std::array<Vec3, 3> face = {v[f[0]], v[f[1]], v[f[2]]};
    if (part.size() == 2 ? segment_crosses_triangle(t[0], t[1], face[0], face[1], face[2])
                         : triangles_cross(face, t))
      return true;
    is_inside = is_inside && orient3d_sign(face[0], face[1], face[2], t[0]) <= 0;
  }
  return is_inside;
}

bool tool_crosses(const Model &model, const Positions &x, const Tool &tool) {
  std::vector<Vec3> v;
  for (size_t b = 0; b < tool.shape->bodies().size(); ++b) {
    place_body(*tool.shape, b, tool.proxy, v);
    for (const Tri &t : model.valve.triangles) {
      if (body_crosses(*tool.shape, b, v, std::array{x[t[0]], x[t[1]], x[t[2]]})) return true;
    }
    for (const Chord &c : model.valve.chords) {
      if (body_crosses(*tool.shape, b, v, std::array{x[c.a], x[c.b]})) return true;
    }
  }
  return false;
}

// Whether nothing crosses on a step along straight lines from `before` to `after`: neither the
// core, by the exact test, nor the rounded surface, by its distance.
bool is_way_free(const Model &model, const State &before, const State &after) {
  constexpr int moments = 4;
  Positions x(before.x.size());
  for (int m = 1; m <= moments; ++m) {
    const double s = static_cast<double>(m) / moments;
    for (size_t i = 0; i < x.size(); ++i) x[i] = (1 - s) * before.x[i] + s * after.x[i];
    Tool tool = after.tools[0];
    for (uint32_t p = 0; p < frame_points; ++p)
      tool.proxy[p] = (1 - s) * before.tools[0].proxy[p] + s * after.tools[0].proxy[p];
    if (tool_crosses(model, x, tool) || !(clearance(model, x, tool) > 0)) return false;
  }
  return find_intersections(after.x, model.valve.triangles).empty();
}

// The clearance that a tool has where its hand is.
double clearance_of_hand(const Model &model, const Positions &x, Tool tool) {
  for (uint32_t p = 0; p < frame_points; ++p) tool.proxy[p] = tool.target(p);
  return clearance(model, x, tool);
}

// Pushes a random tool at a point of the sheet at up to 1 m/s while it turns.
enum class Push { free, touched, crossed };
Push push_at_random(const Model &model, const State &start, uint64_t seed) {
  Random random(seed);
  State state = start;
  const auto triangle =
      static_cast<uint32_t>(random(0, static_cast<double>(model.valve.triangles.size())));
  const double side = random(0, 1) < 0.5 ? 1 : -1;
  const Place goal = place_above(model, start.x, triangle, 0);
  const Vec3 from = goal.point + side * random(3e-3, 12e-3) * goal.normal + random.vector(2e-3);
  Tool tool = random_tool(random, static_cast<int>(seed % 6), from);
  tool.axis = random.vector(0.5);
  tool.stiffness = random(50, 500);
  // where there is tissue, from farther away
  while (clearance_of_hand(model, state.x, tool) < 0.1e-3)
    tool.position += side * 2e-3 * goal.normal;
  add_tool(model, state, tool);
  const Vec3 each = random(0.2e-3, 1e-3) * (goal.point - tool.position).normalized();
  const Vec3 turn = random.vector(0.02);
  Solver solver(Backend::fastest);
  bool touches = false;
  for (int k = 0; k < 20; ++k) {
    state.tools[0].position += each;
    state.tools[0].axis += turn;
    const State before = state;
    solver.step(model, state, {});
    if (!is_way_free(model, before, state)) return Push::crossed;
    touches = touches || clearance(model, state.x, state.tools[0]) < tool_range(model);
  }
  return touches ? Push::touched : Push::free;
}

State pressed(const Model &model) {
  State start = initial_state(model);
  start.load = {2000, 0};
  return settle(model, start).state;
}

}  // namespace

// MVS_TEST_LONG: 10,000 pushes. Seeds that failed once belong into `kept`.
TEST_CASE("random_pushes_at_up_to_1_m_per_s_never_cross_tissue") {
  const ModelPtr model = make_model(small_valve());
  const State start = pressed(*model);
  const bool is_long = long_run();
  const uint64_t pushes = is_long ? 10000 : short_run() ? 20 : 200;
  // a small tetrahedron of corners of the difference took the origin for one inside of it
  const std::vector<uint64_t> kept = {88, 124, 125};
  uint64_t touched = 0;
  for (uint64_t seed = 1; seed <= pushes; ++seed) {
    CAPTURE(seed);
    const Push push = push_at_random(*model, start, seed);
    CHECK(push != Push::crossed);
    touched += push == Push::touched;
  }
  for (const uint64_t seed : kept) CHECK(push_at_random(*model, start, seed) != Push::crossed);
  MESSAGE(touched << " of " << pushes << " pushes touched tissue");
  CHECK(touched > pushes / 2);
}

namespace {

// A pull at the middle of a chord, across it: at the chord and in the direction in which a tool has
// most room.
struct ChordPull {
  ChordPull(const Model &model_in, const State &start_in, const Tool &tool, const Vec3 &inside)
      : model(model_in), start(start_in) {
    double most = 0;
    Mat3 best = Mat3::Identity();
    uint32_t best_chord = 0;
    for (uint32_t k = 0; k < 36 * model.valve.chords.size(); ++k) {
      take(k / 36, pi * (k % 36) / 18);
      const double room = clearance_of_hand(model, start.x, placed(tool, inside));
      if (room <= most) continue;
      most = room;
      best = turn;
      best_chord = k / 36;
    }
    REQUIRE(most > 0.05e-3);
    take(best_chord, 0);
    turn = best;
    along = turn.col(2);
  }
  void take(uint32_t chord_in, double angle) {
    chord = chord_in;
    middle = middle_at(start);
    const Chord &c = model.valve.chords[chord];
    turn.col(1) = (start.x[c.b] - start.x[c.a]).normalized();
    const Vec3 u = turn.col(1).unitOrthogonal(), v = turn.col(1).cross(u);
    turn.col(2) = std::cos(angle) * u + std::sin(angle) * v;
    turn.col(0) = turn.col(1).cross(turn.col(2));
  }
  Vec3 middle_at(const State &state) const {
    const Chord &c = model.valve.chords[chord];
    return 0.5 * (state.x[c.a] + state.x[c.b]);
  }
  // Tools are placed with the chord at `inside` in the frame of the hand.
  Tool placed(Tool tool, const Vec3 &inside) const {
    tool.position = middle - turn * inside;
    const Eigen::Quaterniond q(turn);
    tool.axis = rodrigues_of({q.w(), q.x(), q.y(), q.z()});
    return tool;
  }
  // Returns the displacement of the chord's middle after the hand moved by `way`.
  Vec3 pull(const Tool &tool, double way) const {
    State state = start;
    add_tool(model, state, tool);
    Solver solver(Backend::fastest);
    for (int k = 0; k < 40; ++k) {
      state.tools[0].position += way / 40 * along;
      const State before = state;
      solver.step(model, state, {});
      if (tool.kind == ToolKind::convex) REQUIRE(is_way_free(model, before, state));
    }
    return middle_at(settle(model, state).state) - middle;
  }

  const Model &model;
  const State &start;
  uint32_t chord = 0;
  Vec3 middle, along;
  Mat3 turn;
};

Tool small_ball(double radius) {
  Tool tool;
  tool.kind = ToolKind::ball;
  tool.node = none;
  tool.radius = radius;
  tool.stiffness = 200;
  tool.max_force = 2;
  return tool;
}

// How far a tool, its chord at `inside`, and a ball there take a chord along that is pulled 5 mm; a
// capsule around the tool has to be refused for lack of room.
struct Carried {
  double by_tool, by_ball;  // m; along the pull, in any direction
};
Carried carry(const std::vector<ToolBody> &bodies, double ball_radius, const Vec3 &inside) {
  const ModelPtr model = make_model(small_valve());
  const State start = pressed(*model);
  const Tool tool = convex_at(Vec3::Zero(), bodies);
  const ChordPull work(*model, start, tool, inside);
  const Vec3 carried = work.pull(work.placed(tool, inside), 5e-3);
  const Vec3 missed = work.pull(work.placed(small_ball(ball_radius), inside), 5e-3);
  MESSAGE("chord moved by " << 1e3 * carried.dot(work.along) << " mm with the tool, "
                            << 1e3 * missed.norm() << " mm with the ball");
  State state = start;
  CHECK_THROWS_WITH(add_tool(*model, state, work.placed(bounding_capsule(bodies), inside)),
                    doctest::Contains("would lie in"));
  return {carried.dot(work.along), missed.norm()};
}

}  // namespace

// The capsule around all of the hook lies where the chord is: it cannot be there at all.
TEST_CASE("a_hook_takes_a_chord_along_that_a_ball_in_it_misses") {
  const Carried chord = carry(hook_bodies(0.4e-3), 0.4e-3, Vec3(1.5e-3, 0, 1.2e-3));
  // 0.98 or 1 mm, as the path of the settles has it: the chord slides along the hook
  CHECK(chord.by_tool > 0.5e-3);
  CHECK(chord.by_ball < 1e-6);
}

// A spatula, 5 mm across the chord, 3 mm along it, 0.6 mm thick, 0.2 mm before the chord. The
// capsule around it is 3 mm thick: there is no room for it.
TEST_CASE("a_thin_plate_takes_a_chord_along_that_a_ball_in_it_misses") {
  const std::vector<ToolBody> plate = {box_body(Vec3(2.5e-3, 1.5e-3, 0.2e-3), 0.1e-3)};
  const Carried chord = carry(plate, 0.3e-3, Vec3(0, 0, 1e-3));
  CHECK(chord.by_tool > 0.5e-3);
  // the ball touches a leaflet on its way
  CHECK(chord.by_ball < 0.05e-3);
}
