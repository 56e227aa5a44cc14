// Adds, moves and removes instruments; computes the clearance between an instrument and the
// leaflets.
#include "model/tool.h"

#include <mvs/tool.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "geometry/aabb.h"
#include "geometry/convex_distance.h"
#include "geometry/distance.h"
#include "geometry/intersect.h"
#include "model/model.h"

namespace mvs::core {
namespace {

// Least clearance of a new tool as a share of its range: a smaller one would start with a large
// force.
constexpr double least_room = 0.01;

// Modified Rodrigues parameters are 1 long at most, up to rounding.
constexpr double most_rodrigues = 1 + 1e-9;

bool is(const Tool &tool, Id id) {
  return tool.id == id;
}

// Returns 0 for a tool axis that crosses the triangle.
double distance_of_core(const std::vector<Vec3> &x, const Tri &t, const Tool &tool) {
  const Vec3 &a = tool.proxy[0], &b = tool.proxy[1];
  const Vec3 &p = x[t[0]], &q = x[t[1]], &r = x[t[2]];
  if (tool.points() == 1) return std::sqrt(closest_on_triangle(a, p, q, r).distance2);
  if (segment_crosses_triangle(a, b, p, q, r)) return 0;
  return std::sqrt(segment_triangle_distance2(a, b, p, q, r));
}

// Unit vector from the nearest point of a triangle to the axis of a tool; considers the ends of the
// axis and the edges of the triangle.
Vec3 away_from(const std::vector<Vec3> &x, const Tri &t, const Tool &tool) {
  Vec3 away = Vec3::Zero();
  double least = std::numeric_limits<double>::infinity();
  const auto take = [&](const Vec3 &apart) {
    if (apart.squaredNorm() >= least) return;
    least = apart.squaredNorm();
    away = apart;
  };
  for (uint32_t k = 0; k < tool.points(); ++k) {
    const auto w = closest_on_triangle(tool.proxy[k], x[t[0]], x[t[1]], x[t[2]]).weight;
    take(tool.proxy[k] - (w[0] * x[t[0]] + w[1] * x[t[1]] + w[2] * x[t[2]]));
  }
  for (uint32_t k = 0; tool.points() == 2 && k < 3; ++k) {
    const Vec3 &a = x[t[k]], &b = x[t[(k + 1) % 3]];
    const SegmentPair pair = closest_of_segments(tool.proxy[0], tool.proxy[1], a, b);
    take(tool.proxy[0] + pair.s * (tool.proxy[1] - tool.proxy[0]) - a - pair.t * (b - a));
  }
  return away.normalized();
}

// The nearest tissue of a convex tool so far.
struct NearestTissue {
  double gap = std::numeric_limits<double>::infinity();  // m
  Vec3 away = Vec3::Zero();

  // `box` is that of the body.
  void take(std::span<const Vec3> body, const Aabb &box, std::span<const Vec3> part,
            double radius) {
    const double cutoff = std::max(0.0, gap + radius);
    const Aabb of_part = aabb_of(part);
    if (((of_part.low - box.high).array() > cutoff).any()) return;
    if (((box.low - of_part.high).array() > cutoff).any()) return;
    const ConvexDistance found = convex_distance(body, part, cutoff);
    if (found.is_beyond || found.distance - radius >= gap) return;
    gap = found.distance - radius;
    away = found.apart.normalized();
  }
};

Room room_of_convex(const Model &model, const std::vector<Vec3> &x, const Tool &tool) {
  NearestTissue nearest;
  std::vector<Vec3> body;
  for (size_t b = 0; b < tool.shape->bodies().size(); ++b) {
    place_body(*tool.shape, b, tool.proxy, body);
    const double radius = tool.shape->bodies()[b].radius;
    const Aabb box = aabb_of(body);
    for (const Tri &t : model.valve.triangles) {
      const std::array<Vec3, 3> part = {x[t[0]], x[t[1]], x[t[2]]};
      nearest.take(body, box, part, radius);
    }
    for (const Chord &chord : model.valve.chords) {
      const std::array<Vec3, 2> part = {x[chord.a], x[chord.b]};
      nearest.take(body, box, part, radius + chord_radius(chord));
    }
  }
  return {nearest.gap, nearest.away};
}

void check_node(const Model &model, uint32_t node) {
  MVS_MUST(node < model.node_count(), MVS_E_ARGUMENT, "desc.node",
           "desc.node is %u, but the valve has %zu nodes", node, model.node_count());
  MVS_MUST(!model.topology.fixed[node], MVS_E_ARGUMENT, "desc.node",
           "node %u is prescribed (annulus or papillary head): only free nodes can be held", node);
}

}  // namespace

double tool_range(const Model &model) {
  return 0.5 * model.valve.contact_thickness;
}

double chord_radius(const Chord &chord) {
  constexpr double per_pi = 0.318309886183790672;  // 1 / pi
  return std::sqrt(per_pi * chord.area);
}

void place_body(const ToolShape &shape, size_t body, std::span<const Vec3> frame,
                std::vector<Vec3> &vertices) {
  const std::vector<FrameWeights> &weights = shape.weights(body);
  vertices.resize(weights.size());
  for (size_t k = 0; k < weights.size(); ++k) {
    const FrameWeights &w = weights[k];
    vertices[k] = w[0] * frame[0] + w[1] * frame[1] + w[2] * frame[2] + w[3] * frame[3];
  }
}

double clearance(const Model &model, const std::vector<Vec3> &x, const Tool &tool) {
  return room_of(model, x, tool).distance;
}

Room room_of(const Model &model, const std::vector<Vec3> &x, const Tool &tool) {
  if (tool.kind == ToolKind::convex) return room_of_convex(model, x, tool);
  double least = std::numeric_limits<double>::infinity();
  const Tri *nearest = nullptr;
  for (const Tri &t : model.valve.triangles) {
    const double distance = distance_of_core(x, t, tool);
    if (distance >= least) continue;
    least = distance;
    nearest = &t;
  }
  const Vec3 away = nearest ? away_from(x, *nearest, tool) : Vec3::Zero();
  return {least - tool.radius, away};
}

Id add_tool(const Model &model, State &state, Tool tool) {
  MVS_MUST(state.tools.size() < MVS_MAX_TOOLS, MVS_E_STATE, "tool",
           "there are %u tools, which is the limit: remove one first", MVS_MAX_TOOLS);
  tool.id = first_tool_id + state.tools_made;
  const uint32_t places = tool.kind == ToolKind::convex ? frame_points : 2;
  for (uint32_t k = 0; k < places; ++k) tool.proxy[k] = tool.target(k);
  if (tool.kind == ToolKind::grasp) {
    check_node(model, tool.node);
  } else {
    const double room = clearance(model, state.x, tool);
    const double needed = least_room * tool_range(model);
    const bool meets_chordae = tool.kind == ToolKind::convex;
    MVS_MUST(
        room > needed, MVS_E_STATE, "tool",
        "the tool would lie in leaflet tissue%s: its surface would be %.3g mm off the middle of "
        "a leaflet%s and not %.3g; add it farther away and move it there",
        meets_chordae ? " or a chord" : "", 1e3 * room,
        meets_chordae ? " or the surface of a chord" : "", 1e3 * needed);
  }
  state.tools.push_back(tool);
  ++state.tools_made;
  return tool.id;
}

bool is_valid(const Model &model, const Tool &tool) {
  const bool holds = tool.kind == ToolKind::grasp && tool.node < model.node_count() &&
                     !model.topology.fixed[tool.node];
  const bool pushes =
      (tool.kind == ToolKind::ball || tool.kind == ToolKind::rod) && tool.node == none;
  const bool has_shape = tool.kind == ToolKind::convex && tool.node == none && tool.shape &&
                         tool.length == tool.shape->arm() && tool.axis.norm() <= most_rodrigues;
  return (holds || has_shape || (pushes && !tool.shape)) && tool.stiffness > 0 &&
         tool.max_force > 0;
}

const Tool &tool_of(const State &state, Id id, const char *call) {
  const std::vector<Tool> &tools = state.tools;
  const auto found = std::find_if(tools.begin(), tools.end(), [&](auto &t) { return is(t, id); });
  const auto number = static_cast<unsigned long long>(id);
  MVS_MUST(id >= first_tool_id, MVS_E_ID, "tool", "%s: id %llu is not that of a tool", call,
           number);
  MVS_MUST(found != tools.end(), MVS_E_ID, "tool",
           "%s: tool %llu does not exist: it was removed, or this state is older than it", call,
           number);
  return *found;
}

void move_tool(State &state, Id id, const Vec3 &position, const Vec3 &axis) {
  tool_of(state, id, "move");
  for (Tool &tool : state.tools) {
    if (!is(tool, id)) continue;
    tool.position = position;
    if (tool.kind != ToolKind::rod || !axis.isZero(0)) tool.axis = axis;
  }
}

void remove_tool(State &state, Id id) {
  tool_of(state, id, "remove");
  std::erase_if(state.tools.edit(), [&](const Tool &tool) { return is(tool, id); });
}

void renumber_grasps(State &state, const std::vector<uint32_t> &number) {
  if (state.tools.empty()) return;
  for (Tool &tool : state.tools) {
    if (tool.node != none) tool.node = number[tool.node];
  }
}

void drop_lost_tools(const Model &model, State &state) {
  if (state.tools.empty()) return;
  std::erase_if(state.tools.edit(), [&](const Tool &tool) {
    if (tool.kind == ToolKind::grasp) return tool.node == none || model.topology.fixed[tool.node];
    return clearance(model, state.x, tool) <= 0;
  });
}

}  // namespace mvs::core
