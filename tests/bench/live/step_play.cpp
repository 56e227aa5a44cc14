#include "tests/bench/live/step_play.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace bench {
namespace {

using Point = std::array<double, 3>;
using Done = Phase::Done;

constexpr double pulled = 10e-3;  // m that the hand pulls A2 into the atrium
constexpr double above = 10e-3;   // m above P2 the ball begins,
constexpr double pushed = 14e-3;  // and moves down that far

void nothing(mvs::Simulator &) {}

Done beat(mvs::Simulator &sim, int step, double) {
  if (step % 20 != 0) return Done::nothing;
  sim.set_load(MVS_SYSTOLE_PA * (0.8 + 0.3 * std::sin(2e-3 * M_PI * step)));
  return Done::changed;
}

mvs_id chord_of(const mvs::Simulator &sim, const std::string &name) {
  return sim.snapshot().find(MVS_PART_CHORD, name).id;
}

void shorten(mvs::Simulator &sim) {
  mvs_op_chord_length op = {};
  op.chord = chord_of(sim, "P2/1");
  op.factor = 0.85;
  sim.apply(op);
}

void sew_ring(mvs::Simulator &sim) {
  mvs_op_ring op = {};
  op.size = 0.034;
  sim.apply(op);
}

// The chord with the largest tension: a slack one would leave the valve asleep.
void cut_chord(mvs::Simulator &sim) {
  const mvs::Snapshot valve = sim.snapshot();
  const auto tension = valve.view<double>(MVS_ARRAY_CHORD_TENSION);
  const auto tautest = std::max_element(tension.begin(), tension.end()) - tension.begin();
  mvs_op_chord_remove op = {};
  op.chord = *valve.view<mvs_id>(MVS_ARRAY_CHORD_ID).row(static_cast<size_t>(tautest));
  sim.apply(op);
}

void undo_all(mvs::Simulator &sim) {
  while (!sim.snapshot().history().done.empty()) sim.undo();
}

Point upwards(const mvs::Snapshot &valve) {
  const auto frame = valve.frame();
  return {frame[9], frame[10], frame[11]};
}

Point along(const Point &from, double way, const Point &axis) {
  return {from[0] + way * axis[0], from[1] + way * axis[1], from[2] + way * axis[2]};
}

// The free vertices of a scallop.
std::vector<uint32_t> vertices_of(const mvs::Snapshot &valve, const std::string &scallop) {
  const uint32_t wanted = valve.find(MVS_PART_SCALLOP, scallop).index;
  const auto scallops = valve.view<uint32_t>(MVS_ARRAY_TRIANGLE_SCALLOP);
  const auto triangles = valve.view<uint32_t>(MVS_ARRAY_TRIANGLE_NODES);
  const auto kinds = valve.view<uint8_t>(MVS_ARRAY_NODE_KIND);
  std::vector<uint32_t> found;
  for (size_t t = 0; t < triangles.rows(); ++t) {
    if (*scallops.row(t) != wanted) continue;
    for (const uint32_t *n = triangles.row(t); n != triangles.row(t) + 3; ++n) {
      if (*kinds.row(*n) == MVS_NODE_KIND_LEAFLET) found.push_back(*n);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

Point place_of(const mvs::Snapshot &valve, uint32_t node) {
  const double *x = valve.view<double>(MVS_ARRAY_NODE_POSITION).row(node);
  return {x[0], x[1], x[2]};
}

// The vertex of these nearest to their centroid.
uint32_t middle_one(const mvs::Snapshot &valve, const std::vector<uint32_t> &nodes) {
  Point middle = {};
  for (const uint32_t n : nodes) {
    const Point x = place_of(valve, n);
    for (size_t k = 0; k < 3; ++k) middle[k] += x[k] / static_cast<double>(nodes.size());
  }
  const auto distance = [&](uint32_t n) {
    const Point x = place_of(valve, n);
    return std::hypot(x[0] - middle[0], x[1] - middle[1], x[2] - middle[2]);
  };
  return *std::min_element(nodes.begin(), nodes.end(),
                           [&](uint32_t a, uint32_t b) { return distance(a) < distance(b); });
}

std::vector<uint32_t> on_free_edge(const mvs::Snapshot &valve, const std::vector<uint32_t> &nodes) {
  const auto edge = valve.view<uint32_t>(MVS_ARRAY_FREE_EDGE_NODES);
  std::vector<uint32_t> found;
  for (const uint32_t n : nodes) {
    if (std::find(edge.begin(), edge.end(), n) != edge.end()) found.push_back(n);
  }
  return found;
}

// A hand: its tool, where it grasped, and the direction of the atrium then.
struct Hand {
  mvs_id tool = 0;
  Point start = {}, up = {};

  void add(mvs::Simulator &sim, mvs_tool_desc desc) {
    std::copy(start.begin(), start.end(), desc.position);
    mvs::must(mvs_add_tool(sim.get(), &desc, &tool));
  }
  void move(mvs::Simulator &sim, double way) const {
    const Point to = along(start, way, up);
    mvs::must(mvs_move_tool(sim.get(), tool, to.data(), nullptr));
  }
  void remove(mvs::Simulator &sim) const { mvs::must(mvs_remove_tool(sim.get(), tool)); }
};

void grasp(mvs::Simulator &sim, Hand &hand) {
  const mvs::Snapshot valve = sim.snapshot();
  mvs_tool_desc desc = mvs::sized<mvs_tool_desc>();
  desc.kind = MVS_TOOL_KIND_GRASP;
  desc.by_node = 1;
  desc.node = middle_one(valve, on_free_edge(valve, vertices_of(valve, "A2")));
  hand.start = place_of(valve, desc.node);
  hand.up = upwards(valve);
  hand.add(sim, desc);
}

// Moves there in the first half, then holds still.
Done pull(mvs::Simulator &sim, const Hand &hand, double share) {
  if (share > 0.5) return Done::nothing;
  hand.move(sim, pulled * 2 * share);
  return Done::hand_moved;
}

// Points of a Fibonacci lattice on the sphere of the default ball.
std::vector<Point> sphere() {
  constexpr int count = 200;
  constexpr double radius = 2e-3;
  std::vector<Point> points;
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2.0 * k + 1) / count, angle = M_PI * (3 - std::sqrt(5.0)) * k;
    const double r = radius * std::sqrt(1 - z * z);
    points.push_back({r * std::cos(angle), r * std::sin(angle), radius * z});
  }
  return points;
}

void lay_ball(mvs::Simulator &sim, Hand &hand, Pusher pusher) {
  const mvs::Snapshot valve = sim.snapshot();
  mvs_tool_desc desc = mvs::sized<mvs_tool_desc>();
  desc.kind = MVS_TOOL_KIND_BALL;
  const std::vector<Point> points = sphere();
  mvs_body_desc hull = {};
  if (pusher == Pusher::convex) {
    desc.kind = MVS_TOOL_KIND_CONVEX;
    hull.kind = MVS_BODY_KIND_HULL;
    hull.vertices = {points.data(), points.size(), 3, MVS_TYPE_F64, 0};
    desc.bodies = &hull;
    desc.body_count = 1;
    desc.body_stride = sizeof hull;
  }
  const uint32_t node = middle_one(valve, vertices_of(valve, "P2"));
  hand.up = upwards(valve);
  hand.start = along(place_of(valve, node), above, hand.up);
  hand.add(sim, desc);
}

// Moves down, stays a while, and moves up.
Done push(mvs::Simulator &sim, const Hand &hand, double share) {
  if (share > 0.4 && share < 0.6) return Done::nothing;
  hand.move(sim, -pushed * std::min(1.0, 2.5 * std::min(share, 1 - share)));
  return Done::hand_moved;
}

}  // namespace

std::vector<Phase> play(Pusher pusher) {
  const auto hand = std::make_shared<Hand>();
  const auto let_go = [hand](mvs::Simulator &sim) { hand->remove(sim); };
  return {{"load on", [](mvs::Simulator &sim) { sim.set_load(MVS_SYSTOLE_PA); }},
          {"beat", nothing, beat},
          {"grasp A2", [hand](mvs::Simulator &sim) { grasp(sim, *hand); },
           [hand](mvs::Simulator &sim, int, double share) { return pull(sim, *hand, share); }},
          {"let go", let_go},
          {push_phase, [hand, pusher](mvs::Simulator &sim) { lay_ball(sim, *hand, pusher); },
           [hand](mvs::Simulator &sim, int, double share) { return push(sim, *hand, share); }},
          {"ball gone", let_go},
          {"chord", shorten},
          {"ring", sew_ring},
          {"beat again", nothing, beat},
          {"cut", cut_chord},
          {"undo", undo_all},
          {"alone", nothing},
          {"load off", [](mvs::Simulator &sim) { sim.set_load(0, 0); }}};
}

}  // namespace bench
