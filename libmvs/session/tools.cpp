// Tools of the public interface: validation, addition, removal.
#include "session/tools.h"

#include <cmath>

#include "base/option_checks.h"
#include "history/event_limits.h"
#include "model/checks/extent.h"
#include "session/nearest.h"
#include "session/recorded_event.h"
#include "session/tool_bodies.h"

namespace mvs::core {
namespace {

uint32_t node_in_reach(const mvs_snapshot &now, const Vec3 &place, double reach) {
  const NearNode nearest = nearest_node(now.value.current, place);
  MVS_MUST(nearest.distance <= reach, MVS_E_ARGUMENT, "desc.position",
           "no free vertex of a leaflet lies within %g mm of the hand: bring it nearer, or give a "
           "larger reach",
           1e3 * reach);
  return nearest.node;
}

void check_numbers(const mvs_tool_desc &desc) {
  const auto kind = static_cast<ToolKind>(desc.kind);
  MVS_MUST(kind >= ToolKind::grasp && kind <= ToolKind::convex, MVS_E_ARGUMENT, "desc.kind",
           "desc.kind is %u: it has to be one of MVS_TOOL_KIND_*", desc.kind);
  MVS_MUST(desc.by_node <= 1, MVS_E_ARGUMENT, "desc.by_node",
           "desc.by_node is %u: it has to be 0 or 1", desc.by_node);
  MVS_MUST(desc.strict_hulls <= 1, MVS_E_ARGUMENT, "desc.strict_hulls",
           "desc.strict_hulls is %u: it has to be 0 or 1", desc.strict_hulls);
  MVS_MUST(kind == ToolKind::convex || desc.body_count == 0, MVS_E_ARGUMENT, "desc.body_count",
           "desc.body_count is %u, but only MVS_TOOL_KIND_CONVEX has bodies", desc.body_count);
  must_be_zero(desc.reserved, "desc.reserved");
}

// Fills in shape and orientation of a convex tool.
void read_convex(const mvs_tool_desc &desc, const ToolShapePtr &shape, Tool &tool) {
  MVS_MUST(shape, MVS_E_ARGUMENT, "desc.body_count", "a convex tool has at least one body");
  tool.shape = shape;
  tool.length = tool.shape->arm();
  tool.axis = read_orientation(desc.orientation, "desc.orientation");
}

Tool read_tool(const mvs_snapshot &now, const mvs_tool_desc &desc, const ToolShapePtr &shape) {
  check_numbers(desc);
  Tool tool;
  tool.kind = static_cast<ToolKind>(desc.kind);
  tool.position = read_place(desc.position, "desc.position");
  const ToolSizes sizes =
      read_tool_sizes({desc.radius, desc.length, desc.stiffness, desc.max_force}, "desc");
  const double reach = read_reach(desc.reach, 2e-3, "desc");
  tool.stiffness = sizes.stiffness;
  tool.max_force = sizes.max_force;
  if (tool.kind == ToolKind::grasp) {
    tool.node = desc.by_node ? desc.node : node_in_reach(now, tool.position, reach);
    return tool;
  }
  if (tool.kind == ToolKind::convex) {
    read_convex(desc, shape, tool);
    return tool;
  }
  tool.radius = sizes.radius;
  if (tool.kind == ToolKind::ball) return tool;
  tool.length = sizes.length;
  const bool is_given = desc.axis[0] != 0 || desc.axis[1] != 0 || desc.axis[2] != 0;
  tool.axis = is_given ? read_axis(desc.axis, "desc.axis") : Vec3::UnitZ();
  return tool;
}

void apply_at_once(mvs_sim &sim, const RecordedEvent &event) {
  const SnapshotPtr before = sim.present();
  State state = before->state;
  apply_event(*before->model, state, event);
  sim.replace(make_snapshot(after_event(before->value, std::move(state), event)));
  sim.make_ready();
}

}  // namespace

Vec3 read_place(const double given[3], const char *what) {
  Vec3 place(given[0], given[1], given[2]);
  MVS_MUST((place.cwiseAbs().array() <= limits::coordinate).all(), MVS_E_ARGUMENT, what,
           "%s is (%g, %g, %g) m: each has to be a number within %g", what, place.x(), place.y(),
           place.z(), limits::coordinate);
  return place;
}

Vec3 read_axis(const double given[3], const char *what) {
  Vec3 axis(given[0], given[1], given[2]);
  scale_up_denormal(axis);
  const double length = axis.stableNorm();
  MVS_MUST(std::isfinite(length) && length > 0, MVS_E_ARGUMENT, what,
           "%s is (%g, %g, %g): it has to be a direction", what, axis.x(), axis.y(), axis.z());
  return axis / length;
}

ToolSizes read_tool_sizes(const ToolSizes &given, const std::string &of) {
  must_be_in(given.radius, limits::tool_radius, (of + ".radius").c_str());
  must_be_in(given.length, limits::rod_length, (of + ".length").c_str());
  must_be_in(given.stiffness, limits::tool_stiffness, (of + ".stiffness").c_str());
  must_be_in(given.max_force, limits::tool_max_force, (of + ".max_force").c_str());
  return {value_or(given.radius, 2e-3), value_or(given.length, 40e-3),
          value_or(given.stiffness, 200), value_or(given.max_force, 5)};
}

double read_reach(double given, double fallback, const std::string &of) {
  must_be_in(given, 1e-6, 1, (of + ".reach").c_str());
  return value_or(given, fallback);
}

void must_be_near(const Valve &valve, const Vec3 &place, const char *what) {
  const Extent extent = extent_of(valve);
  MVS_MUST(!is_far(extent, place), MVS_E_ARGUMENT, what,
           "%s lies %.3g m from the middle of a valve of %.3g m: positions are in m, in the frame "
           "of the valve",
           what, (place - extent.centre).norm(), extent.size);
}

Id add_tool_now(mvs_sim &sim, const mvs_tool_desc &desc, const ToolShapePtr &shape) {
  const SnapshotPtr before = sim.present();
  Tool added = read_tool(*before.get(), desc, shape);
  added.id = first_tool_id + before->state.tools_made;
  apply_at_once(sim, event_of(RecordedEvent::tool_add, added));
  return added.id;
}

void remove_tool_now(mvs_sim &sim, Id id) {
  Tool removed;
  removed.id = id;
  apply_at_once(sim, event_of(RecordedEvent::tool_remove, removed));
}

}  // namespace mvs::core
