// Instruments: adds, moves, removes and enumerates them.
#include <mvs/tool.h>

#include <algorithm>

#include "api/sim_call.h"
#include "session/tool_bodies.h"
#include "session/tools.h"
#include "solve/tools/tool_stiffness.h"

using namespace mvs::core;

namespace {

void write_quaternion(const Quaternion &from, double to[4]) {
  std::copy(from.begin(), from.end(), to);
}

// The fields of a convex tool alone.
void write_convex(const Tool &tool, mvs_tool_state &out) {
  const FramePose pose = pose_of(tool.proxy, tool.length);
  write(pose.position, out.proxy);
  write_quaternion(quaternion_of(tool.axis), out.orientation);
  write_quaternion(quaternion_of(pose.rotation), out.proxy_orientation);
  out.body_count = static_cast<uint32_t>(tool.shape->bodies().size());
  out.vertex_count = static_cast<uint32_t>(tool.shape->vertex_count());
}

mvs_body_desc body_of(const mvs_body_desc &given) {
  return given;
}

mvs_tool_body public_body(const ToolShape &shape, uint32_t index) {
  const ToolBody &body = shape.bodies()[index];
  mvs_tool_body out = {};
  out.kind = static_cast<uint32_t>(body.kind);
  out.radius = body.radius;
  const std::vector<Vec3> &vertices = body.vertices;
  const std::vector<Tri> &faces = shape.faces(index);
  out.vertices = {vertices.data(), vertices.size(), 3, MVS_TYPE_F64, sizeof(Vec3)};
  out.triangles = {faces.data(), faces.size(), 3, MVS_TYPE_U32, sizeof(Tri)};
  return out;
}

mvs_tool_state public_tool(const mvs_snapshot &snapshot, const Tool &tool) {
  const State &state = snapshot.state;
  mvs_tool_state out = {};
  out.kind = static_cast<uint32_t>(tool.kind);
  out.id = tool.id;
  write(tool.position, out.position);
  if (tool.kind == ToolKind::rod) write(tool.axis, out.axis);
  const ToolForce answer = force_of(state, tool);
  write(answer.force, out.force);
  write(answer.torque, out.torque);
  out.radius = tool.radius;
  out.length = tool.length;
  out.stiffness = tool.stiffness;
  out.max_force = tool.max_force;
  out.node = tool.node;
  if (tool.kind == ToolKind::grasp) {
    write(state.x[tool.node], out.proxy);
    out.touching = 1;
    return out;
  }
  write(tool.proxy[0], out.proxy);
  if (tool.kind == ToolKind::rod) {
    write((tool.proxy[1] - tool.proxy[0]).normalized(), out.proxy_axis);
  }
  if (tool.kind == ToolKind::convex) write_convex(tool, out);
  out.distance = clearance(*snapshot.model, state.x, tool);
  out.touching = out.distance < tool_range(*snapshot.model) ? 1 : 0;
  return out;
}

}  // namespace

extern "C" {

mvs_result mvs_add_tool(mvs_sim *sim, const mvs_tool_desc *desc, mvs_id *tool) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    must_point(tool, "tool");
    const mvs_tool_desc read = read_struct(desc, "desc");
    std::vector<std::string> warnings;
    ToolShapePtr shape;
    if (read.kind == MVS_TOOL_KIND_CONVEX) {
      const auto bodies =
          read_list(read.bodies, read.body_count, read.body_stride, "desc.bodies", body_of);
      shape = read_bodies(bodies, "desc", read.strict_hulls == 1, warnings);
    }
    const SnapshotPtr now = s.present();
    if (read.kind != MVS_TOOL_KIND_GRASP) {  // within reach of a node, or anywhere with by_node
      must_be_near(now->model->valve, read_place(read.position, "desc.position"), "desc.position");
    }
    *tool = add_tool_now(s, read, shape);
    for (const std::string &warning : warnings) s.log(MVS_LOG_WARNING, "%s", warning.c_str());
  });
}

mvs_result mvs_move_tool(mvs_sim *sim, mvs_id tool, const double position[3],
                         const double axis[3]) {
  return at_boundary([&] {
    must_point(sim, "sim");
    must_point(position, "position");
    Tool moved = tool_of(sim->present()->state, tool, "move");
    moved.position = read_place(position, "position");
    const bool turns = axis && moved.kind == ToolKind::rod;
    if (turns) moved.axis = read_axis(axis, "axis");
    sim->hands.post(moved, turns);
  });
}

mvs_result mvs_move_tool_pose(mvs_sim *sim, mvs_id tool, const double position[3],
                              const double orientation[4]) {
  return at_boundary([&] {
    must_point(sim, "sim");
    must_point(position, "position");
    Tool moved = tool_of(sim->present()->state, tool, "move");
    moved.position = read_place(position, "position");
    const bool turns = moved.kind == ToolKind::convex || moved.kind == ToolKind::rod;
    if (orientation) {
      const bool is_null =
          std::all_of(orientation, orientation + 4, [](double q) { return q == 0; });
      MVS_MUST(
          !is_null, MVS_E_ARGUMENT, "orientation",
          "orientation is (0, 0, 0, 0): it has to be a quaternion w x y z, or a null pointer to "
          "keep the present one");
      const Vec3 turn = read_orientation(orientation, "orientation");
      if (moved.kind == ToolKind::convex) moved.axis = turn;
      if (moved.kind == ToolKind::rod) moved.axis = rotation_of(turn).col(2);
    }
    sim->hands.post(moved, orientation && turns);
  });
}

mvs_result mvs_remove_tool(mvs_sim *sim, mvs_id tool) {
  return call_at_boundary(sim, [&](mvs_sim &s) { remove_tool_now(s, tool); });
}

mvs_result mvs_get_tool(const mvs_sim *sim, mvs_id tool, mvs_tool_state *state) {
  return at_boundary([&] {
    must_point(sim, "sim");
    checked_struct_size(state, "state");
    const SnapshotPtr now = sim->present();
    write_struct(state, public_tool(*now.get(), tool_of(now->state, tool, "get")), "state");
  });
}

mvs_result mvs_snapshot_get_tool_count(const mvs_snapshot *snapshot, uint32_t *count) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    must_point(count, "count");
    *count = static_cast<uint32_t>(snapshot->state.tools.size());
  });
}

mvs_result mvs_snapshot_get_tool(const mvs_snapshot *snapshot, uint32_t index,
                                 mvs_tool_state *state) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    checked_struct_size(state, "state");
    const std::vector<Tool> &tools = snapshot->state.tools;
    MVS_MUST(index < tools.size(), MVS_E_ARGUMENT, "index",
             "index is %u, but the snapshot has %zu tools", index, tools.size());
    write_struct(state, public_tool(*snapshot, tools[index]), "state");
  });
}

mvs_result mvs_snapshot_get_tool_body(const mvs_snapshot *snapshot, uint32_t index, uint32_t body,
                                      mvs_tool_body *out) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    checked_struct_size(out, "out");
    const std::vector<Tool> &tools = snapshot->state.tools;
    must_be_index(index, tools.size(), "snapshot", "tools");
    const ToolShape *const shape = tools[index].shape.get();
    must_be_index(body, shape ? shape->bodies().size() : 0, "tool", "bodies");
    write_struct(out, public_body(*shape, body), "out");
  });
}

}  // extern "C"
