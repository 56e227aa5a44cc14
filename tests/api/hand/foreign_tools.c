/* Tools of a device belong to it alone: ids begin anew with a valve, so that the tool of a host or
 * of another simulator may have the id of the hand's. */
#include "recorded_hand.h"
#include "tool_count.h"

static mvs_tool_state tool_state(mvs_sim *of, mvs_id tool) {
  mvs_tool_state state = {.struct_size = sizeof state};
  MUST(mvs_get_tool(of, tool, &state));
  return state;
}

/* A new valve with a grasp of the host, by default of the sizes of the hand's. */
static mvs_id grasp_of_a_host(mvs_sim *in) {
  const mvs_snapshot *snapshot = NULL;
  mvs_view x;
  mvs_parametric_desc small = {
      .struct_size = sizeof small, .vertices = 200, .shape = MVS_SHAPE_FOUNDING};
  mvs_tool_desc desc = {.struct_size = sizeof desc, .kind = MVS_TOOL_KIND_GRASP, .reach = 5e-3};
  mvs_id tool = 0;
  MUST(mvs_generate_valve(in, &small));
  MUST(mvs_get_snapshot(in, &snapshot));
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_NODE_POSITION, &x));
  memcpy(desc.position, (const double *)x.data + 3 * 40, sizeof desc.position);
  MUST(mvs_add_tool(in, &desc, &tool));
  mvs_snapshot_release(snapshot);
  return tool;
}

static void a_new_valve_has_no_tool_of_the_hand(void) {
  mvs_device *device = opened("grasp_a2.txt", MVS_HAND_MODE_GRASP);
  const mvs_id held = turn_until(device, MVS_EVENT_GRASPED, 400).tool;
  const mvs_id own = grasp_of_a_host(sim);
  const mvs_tool_state before = tool_state(sim, own);
  CHECK(own == held);
  const mvs_device_report report = turn(device);
  CHECK(report.events == MVS_EVENT_LOST_TOOL && report.tool == 0);
  turn_until(device, MVS_EVENT_RELEASED, 500);
  mvs_device_close(device);
  const mvs_tool_state after = tool_state(sim, own);
  CHECK(after.node == before.node && tool_count(sim) == 1);
  for (int k = 0; k < 3; ++k) CHECK(after.position[k] == before.position[k]);
}

static void a_tool_added_after_an_undo_is_not_the_hands(void) {
  mvs_device *device = opened("grasp_a2.txt", MVS_HAND_MODE_GRASP);
  const mvs_snapshot *before = present();
  const mvs_id held = turn_until(device, MVS_EVENT_GRASPED, 400).tool;
  MUST(mvs_restore(sim, before));
  mvs_snapshot_release(before);
  mvs_tool_desc desc = {
      .struct_size = sizeof desc, .kind = MVS_TOOL_KIND_BALL, .position = {0, 0, 0.1}};
  mvs_id own = 0;
  MUST(mvs_add_tool(sim, &desc, &own));
  CHECK(own == held);
  CHECK(turn(device).events == MVS_EVENT_LOST_TOOL);
  mvs_device_close(device);
  CHECK(tool_count(sim) == 1);
}

static void in_another_simulator_the_hand_begins_without_a_tool(void) {
  mvs_device *device = opened("grasp_a2.txt", MVS_HAND_MODE_GRASP);
  mvs_sim *other = NULL;
  MUST(mvs_create(NULL, &other));
  const mvs_id own = grasp_of_a_host(other);
  CHECK(turn_until(device, MVS_EVENT_GRASPED, 400).tool == own);
  mvs_device_report report = {.struct_size = sizeof report};
  MUST(mvs_device_sync(device, other, &report));
  CHECK(report.events == MVS_EVENT_LET_GO && report.tool == 0);
  CHECK(tool_count(sim) == 0);
  mvs_device_close(device);
  CHECK(tool_count(other) == 1);
  mvs_destroy(other);
}

int main(void) {
  close_the_valve();
  a_new_valve_has_no_tool_of_the_hand();
  a_tool_added_after_an_undo_is_not_the_hands();
  in_another_simulator_the_hand_begins_without_a_tool();
  return finish_devices("foreign_tools");
}
