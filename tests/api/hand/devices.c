/* A haptic device that plays a recording holds a valve: grasps, forces, tools, and the state it
 * leaves. device_chords.c tests chordae in the hand, device_limits.c refusals and limits. */
#include "recorded_hand.h"

/* Plays the grasp to its end; returns the hash of the valve at that time. */
static hash128 play_the_grasp(double *most) {
  mvs_device *device = opened("grasp_a2.txt", MVS_HAND_MODE_GRASP);
  uint32_t events = 0, node = UINT32_MAX;
  double before = 0;
  *most = 0;
  for (int k = 0; k < 800; ++k) {
    const mvs_device_report report = turn(device);
    const mvs_device_state state = state_of(device);
    events |= report.events;
    if (report.events & MVS_EVENT_GRASPED) node = report.node;
    if (report.events & MVS_EVENT_LET_GO) CHECK(report.tool == 0 && report.node == UINT32_MAX);
    *most = fmax(*most, length(state.force));
    /* 10 ms of the slew limit, 100 times 3.3 N a second */
    CHECK(fabs(length(state.force) - before) <= 3.3);
    before = length(state.force);
    CHECK(report.stiffness <= 400);
  }
  CHECK(events == (MVS_EVENT_PRESSED | MVS_EVENT_RELEASED | MVS_EVENT_GRASPED | MVS_EVENT_LET_GO));
  CHECK(node != UINT32_MAX);
  CHECK(length(state_of(device).force) < 1e-9);
  mvs_device_close(device);
  return sim_hash(sim);
}

static void a_grasp_pulls_and_lets_go_and_is_the_same_each_time(void) {
  double first = 0, second = 0;
  const hash128 one = play_the_grasp(&first), two = play_the_grasp(&second);
  CHECK(same_hash(one, two));
  CHECK(first == second);
  /* 200 N/m of the hand and the tissue in series, over 10 mm: below 2 N */
  CHECK(first > 0.5 && first < 2);
}

static void the_force_is_that_of_the_tool_in_the_valve(void) {
  mvs_device *device = opened("grasp_a2.txt", MVS_HAND_MODE_GRASP);
  turn_until(device, MVS_EVENT_GRASPED, 400);
  for (int k = 0; k < 180; ++k) turn(device);
  const mvs_device_report report = turn(device);
  mvs_tool_state tool = {.struct_size = sizeof tool};
  MUST(mvs_get_tool(sim, report.tool, &tool));
  CHECK(tool.kind == MVS_TOOL_KIND_GRASP && tool.node == report.node);
  const mvs_device_state state = state_of(device);
  /* scene y is the device's -z, scene z its y; the hand moves little in the last 10 ms */
  const double turned[3] = {report.force[0], report.force[2], -report.force[1]};
  for (int k = 0; k < 3; ++k) CHECK(fabs(turned[k] - state.force[k]) < 0.05 * length(report.force));
  CHECK(length(report.force) > 0.2);
  mvs_device_close(device);
}

static void an_undo_while_something_is_held_lets_it_go(void) {
  mvs_device *device = opened("grasp_a2.txt", MVS_HAND_MODE_GRASP);
  const mvs_snapshot *before = present();
  turn_until(device, MVS_EVENT_GRASPED, 400);
  for (int k = 0; k < 150; ++k) turn(device);
  CHECK(length(state_of(device).force) > 0.1);
  MUST(mvs_restore(sim, before));
  mvs_device_report report = turn(device);
  CHECK(report.events == MVS_EVENT_LOST_TOOL);
  CHECK(report.tool == 0);
  for (int k = 0; k < 20; ++k) turn(device);
  CHECK(length(state_of(device).force) < 1e-9);
  CHECK(state_of(device).phase == MVS_DEVICE_PHASE_ON);
  mvs_snapshot_release(before);
  mvs_device_close(device);
}

static void another_valve_under_the_hand_is_another_hand(void) {
  mvs_parametric_desc small = {
      .struct_size = sizeof small, .vertices = 200, .shape = MVS_SHAPE_FOUNDING};
  mvs_device *device = opened("grasp_a2.txt", MVS_HAND_MODE_GRASP);
  turn_until(device, MVS_EVENT_GRASPED, 400);
  MUST(mvs_generate_valve(sim, &small));
  CHECK(turn(device).events == MVS_EVENT_LOST_TOOL);
  mvs_device_close(device);
}

static void a_ball_pushes_and_is_taken_away_with_its_mode(void) {
  mvs_device *device = opened("push_p2.txt", MVS_HAND_MODE_BALL);
  double most = 0;
  mvs_id tool = 0;
  for (int k = 0; k < 400; ++k) {
    const mvs_device_report report = turn(device);
    most = fmax(most, length(report.force));
    if (report.tool != 0) tool = report.tool;
  }
  CHECK(tool != 0);
  CHECK(most > 0.05);
  mvs_device_hand look = {.struct_size = sizeof look, .mode = MVS_HAND_MODE_LOOK};
  mvs_tool_state state = {.struct_size = sizeof state};
  MUST(mvs_device_set_hand(device, &look));
  CHECK(turn(device).events & MVS_EVENT_LET_GO);
  CHECK(mvs_get_tool(sim, tool, &state) == MVS_E_ID);
  mvs_device_close(device);
}

/* The same path with a convex tool, which turns with the stylus. */
static void a_convex_tool_pushes_in_the_hand(void) {
  mvs_device *device = opened("push_p2.txt", MVS_HAND_MODE_LOOK);
  const mvs_body_desc body = {
      .kind = MVS_BODY_KIND_BOX, .size = {3e-3, 3e-3, 1e-3}, .radius = 1e-3};
  mvs_device_hand hand = {.struct_size = sizeof hand, .mode = MVS_HAND_MODE_CONVEX};
  MUST_FAIL(mvs_device_set_hand(device, &hand), MVS_E_ARGUMENT, "1 to 16 bodies");
  hand.bodies = &body;
  hand.body_count = 1;
  hand.body_stride = sizeof body;
  MUST(mvs_device_set_hand(device, &hand));
  mvs_tool_state state = {.struct_size = sizeof state};
  double most = 0;
  for (int k = 0; k < 400; ++k) {
    const mvs_device_report report = turn(device);
    most = fmax(most, length(report.force));
    if (report.tool != 0) MUST(mvs_get_tool(sim, report.tool, &state));
  }
  CHECK(state.kind == MVS_TOOL_KIND_CONVEX && state.vertex_count == 8);
  CHECK(most > 0.05);
  MUST(mvs_device_get_hand(device, &hand));
  CHECK(hand.bodies == NULL && hand.body_count == 1);
  mvs_device_close(device);
}

/* A tool at the centre of the workspace could lie on the other side of a leaflet. */
static void a_tool_waits_for_the_first_sample(void) {
  mvs_device *device = opened("push_p2.txt", MVS_HAND_MODE_BALL);
  mvs_device_report report = {.struct_size = sizeof report};
  mvs_tool_state tool = {.struct_size = sizeof tool};
  MUST(mvs_device_stop(device));
  MUST(mvs_device_start(device));
  MUST(mvs_device_sync(device, sim, &report));
  CHECK(report.tool == 0 && report.events == 0);
  CHECK(report.near_node == UINT32_MAX && report.near_chord == 0);
  CHECK(isinf(report.near_node_distance) && isinf(report.near_chord_distance));
  MUST(mvs_device_advance(device, 0.001));
  MUST(mvs_device_sync(device, sim, &report));
  CHECK(report.tool != 0 && report.near_node != UINT32_MAX);
  CHECK(length(report.position) > 0);
  MUST(mvs_get_tool(sim, report.tool, &tool));
  for (int k = 0; k < 3; ++k) CHECK(tool.position[k] == report.position[k]);
  mvs_device_close(device);
}

static void a_stopped_device_lets_go(void) {
  mvs_device *device = opened("grasp_a2.txt", MVS_HAND_MODE_GRASP);
  turn_until(device, MVS_EVENT_GRASPED, 400);
  MUST(mvs_device_stop(device));
  mvs_device_report report = {.struct_size = sizeof report};
  MUST(mvs_device_sync(device, sim, &report));
  CHECK(report.events & MVS_EVENT_LET_GO);
  CHECK(state_of(device).phase == MVS_DEVICE_PHASE_STOPPED);
  mvs_device_close(device);
}

int main(void) {
  close_the_valve();
  a_grasp_pulls_and_lets_go_and_is_the_same_each_time();
  the_force_is_that_of_the_tool_in_the_valve();
  an_undo_while_something_is_held_lets_it_go();
  another_valve_under_the_hand_is_another_hand();
  a_ball_pushes_and_is_taken_away_with_its_mode();
  a_convex_tool_pushes_in_the_hand();
  a_tool_waits_for_the_first_sample();
  a_stopped_device_lets_go();
  return finish_devices("devices");
}
