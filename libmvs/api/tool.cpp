// Instruments: adds, moves, removes and enumerates them.
#include <mvs/tool.h>

#include "api/sim_call.h"
#include "session/tools.h"
#include "solve/tools/tool_stiffness.h"

using namespace mvs::core;

namespace {

mvs_tool_state public_tool(const mvs_snapshot &snapshot, const Tool &tool) {
  const State &state = snapshot.state;
  mvs_tool_state out = {};
  out.kind = static_cast<uint32_t>(tool.kind);
  out.id = tool.id;
  write(tool.position, out.position);
  write(tool.axis, out.axis);
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
  out.distance = clearance(*snapshot.model, state.x, tool);
  out.touching = out.distance < tool_range(*snapshot.model) ? 1 : 0;
  return out;
}

}  // namespace

extern "C" {

mvs_result mvs_add_tool(mvs_sim *sim, const mvs_tool_desc *desc, mvs_id *tool) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    must_point(tool, "tool");
    *tool = add_tool_now(s, read_struct(desc, "desc"));
  });
}

mvs_result mvs_move_tool(mvs_sim *sim, mvs_id tool, const double position[3],
                         const double axis[3]) {
  return at_boundary([&] {
    must_point(sim, "sim");
    must_point(position, "position");
    Tool moved = tool_of(sim->present()->state, tool, "move");
    moved.position = read_place(position, "position");
    if (axis && moved.kind == ToolKind::rod) moved.axis = read_axis(axis, "axis");
    sim->hands.post(moved, axis != nullptr);
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

}  // extern "C"
