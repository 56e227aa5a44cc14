/* A haptic device that plays a recording holds a valve: grasps, forces, limits, and the state it
 * leaves. */
#include <math.h>
#include <stdlib.h>

#include "check.h"
#include "tests/founding.h"

#define TRAJECTORIES MVS_SOURCE_DIR "/haptic_drivers/replay/trajectories/"

static mvs_sim *sim;
static const mvs_snapshot *closed; /* the shipped valve under systole */

static const mvs_snapshot *present(void) {
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_get_snapshot(sim, &snapshot));
  return snapshot;
}

static mvs_device *opened(const char *recording, uint32_t mode) {
  char options[512];
  mvs_device *device = NULL;
  snprintf(options, sizeof options, "file=" TRAJECTORIES "%s", recording);
  mvs_device_desc desc = {.struct_size = sizeof desc,
                          .clock = MVS_CLOCK_VIRTUAL,
                          .driver = "replay",
                          .options = options};
  MUST(mvs_device_open(&desc, &device));
  /* orientation of the recordings: the device's y points up, out of the valve */
  mvs_device_view view = {.struct_size = sizeof view, .rotation = {1, 1, 0, 0}};
  mvs_device_hand hand = {.struct_size = sizeof hand, .mode = mode};
  mvs_device_limits limits = {.struct_size = sizeof limits, .ramp_s = 0.1};
  MUST(mvs_device_set_view(device, &view));
  MUST(mvs_device_set_hand(device, &hand));
  MUST(mvs_device_set_limits(device, &limits));
  MUST(mvs_device_start(device));
  MUST(mvs_device_advance(device, 0.01));
  MUST(mvs_device_arm(device));
  MUST(mvs_restore(sim, closed));
  return device;
}

/* The simulation at 100 Hz beside the servo at 1 kHz. */
static mvs_device_report turn(mvs_device *device) {
  mvs_device_report report = {.struct_size = sizeof report};
  mvs_step_options step = {.struct_size = sizeof step, .dt = 0.01};
  MUST(mvs_device_advance(device, 0.01));
  MUST(mvs_device_sync(device, sim, &report));
  MUST(mvs_step(sim, &step));
  return report;
}

static mvs_device_state state_of(mvs_device *device) {
  mvs_device_state state = {.struct_size = sizeof state};
  MUST(mvs_device_get_state(device, &state));
  return state;
}

static double length(const double v[3]) {
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* Steps until an event occurs, at most `turns` times; returns the report with the event. */
static mvs_device_report turn_until(mvs_device *device, uint32_t event, int most) {
  mvs_device_report report = {0};
  for (int k = 0; k < most && !(report.events & event); ++k) report = turn(device);
  CHECK(report.events & event);
  return report;
}

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

/* The chord with the largest tension, and that tension. */
static mvs_part tautest_chord(double *most) {
  mvs_part part = {0};
  mvs_view tension, id;
  uint32_t tautest = 0;
  const mvs_snapshot *snapshot = present();
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_CHORD_TENSION, &tension));
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_CHORD_ID, &id));
  const double *const t = tension.data;
  for (uint32_t k = 1; k < tension.count; ++k) {
    if (t[k] > t[tautest]) tautest = k;
  }
  *most = t[tautest];
  part.id = ((const uint64_t *)id.data)[tautest];
  mvs_snapshot_release(snapshot);
  return part;
}

static void a_chord_is_felt_as_it_pulls(void) {
  mvs_device *device = opened("circle.txt", MVS_HAND_MODE_FEEL);
  double tension = 0;
  const mvs_part chord = tautest_chord(&tension);
  mvs_device_hand feel = {
      .struct_size = sizeof feel, .mode = MVS_HAND_MODE_FEEL, .chord = chord.id, .gain = 0.2};
  mvs_device_limits limits = {.struct_size = sizeof limits, .gate = 10};
  MUST(mvs_device_set_hand(device, &feel));
  MUST(mvs_device_set_limits(device, &limits));
  for (int k = 0; k < 200; ++k) turn(device);
  tautest_chord(&tension);
  CHECK(tension > 0.05);
  /* the valve is at rest; the recorded circle continues, with small damping */
  CHECK(fabs(length(state_of(device).force) - 0.2 * tension) < 0.02 * tension);
  mvs_device_close(device);
}

static void a_chord_is_dragged_to_a_new_length(void) {
  mvs_device *device = opened("grasp_a2.txt", MVS_HAND_MODE_DRAG);
  double tension = 0;
  const mvs_part chord = tautest_chord(&tension);
  mvs_device_hand drag = {
      .struct_size = sizeof drag, .mode = MVS_HAND_MODE_DRAG, .chord = chord.id};
  MUST(mvs_device_set_hand(device, &drag));
  turn_until(device, MVS_EVENT_GRASPED, 400);
  const mvs_device_report report = turn_until(device, MVS_EVENT_DRAGGED, 500);
  mvs_op_chord_length op = {.op = {sizeof op, MVS_OP_CHORD_LENGTH}, .chord = chord.id};
  memcpy(op.drag_to.at, report.drag_to, sizeof report.drag_to);
  op.drag_to.given = 1;
  MUST(mvs_apply_op(sim, &op.op, NULL));
  mvs_device_close(device);
}

static void what_makes_no_sense_is_refused(void) {
  mvs_device *device = NULL;
  mvs_device_desc desc = {.struct_size = sizeof desc};
  CHECK(mvs_device_open(&desc, &device) == MVS_E_ARGUMENT);
  desc.driver = "nowhere";
  CHECK(mvs_device_open(&desc, &device) == MVS_E_IO);
  desc.driver = "replay";
  CHECK(mvs_device_open(&desc, &device) == MVS_E_ARGUMENT); /* sentence of the driver: no file */
  CHECK(strstr(mvs_last_error()->message, "file") != NULL);
  desc.clock = 7;
  CHECK(mvs_device_open(&desc, &device) == MVS_E_ARGUMENT);
  CHECK(mvs_device_open(NULL, &device) == MVS_E_ARGUMENT);
  CHECK(device == NULL);
  device = opened("circle.txt", MVS_HAND_MODE_LOOK);
  mvs_device_limits limits = {.struct_size = sizeof limits, .force = -1};
  mvs_device_view view = {.struct_size = sizeof view, .scale = 1e9};
  mvs_device_hand hand = {.struct_size = sizeof hand, .mode = 77};
  CHECK(mvs_device_set_limits(device, &limits) == MVS_E_ARGUMENT);
  CHECK(mvs_device_set_view(device, &view) == MVS_E_ARGUMENT);
  CHECK(mvs_device_set_hand(device, &hand) == MVS_E_ARGUMENT);
  CHECK(mvs_device_start(device) == MVS_E_STATE);
  CHECK(mvs_device_advance(device, NAN) == MVS_E_ARGUMENT);
  MUST(mvs_device_stop(device));
  CHECK(mvs_device_advance(device, 1) == MVS_E_STATE);
  CHECK(mvs_device_arm(device) == MVS_E_STATE);
  CHECK(mvs_device_arm(NULL) == MVS_E_ARGUMENT);
  mvs_device_close(device);
  mvs_device_close(NULL);
}

static void limits_can_only_be_lowered(void) {
  mvs_device *device = opened("circle.txt", MVS_HAND_MODE_LOOK);
  mvs_device_info info = {.struct_size = sizeof info};
  mvs_device_limits limits = {.struct_size = sizeof limits, .force = 100, .stiffness = 1e5};
  MUST(mvs_device_get_info(device, &info));
  MUST(mvs_device_set_limits(device, &limits));
  MUST(mvs_device_get_limits(device, &limits));
  CHECK(limits.force == info.peak_force && limits.stiffness == info.max_stiffness);
  CHECK(limits.continuous_force == info.continuous_force);
  limits.force = 0.5;
  MUST(mvs_device_set_limits(device, &limits));
  MUST(mvs_device_get_limits(device, &limits));
  CHECK(limits.force == 0.5 && limits.continuous_force == 0.5);
  mvs_device_close(device);
}

static void a_trace_has_every_tick(void) {
  mvs_device *device = opened("circle.txt", MVS_HAND_MODE_LOOK);
  mvs_device_sample rows[64];
  uint64_t count = 0, lost = 0;
  MUST(mvs_device_take_samples(device, rows, sizeof rows[0], 64, &count, &lost));
  CHECK(count == 10 && lost == 0);
  MUST(mvs_device_advance(device, 0.05));
  MUST(mvs_device_take_samples(device, rows, sizeof rows[0], 64, &count, &lost));
  CHECK(count == 50 && lost == 0);
  for (uint32_t k = 1; k < count; ++k) CHECK(fabs(rows[k].time - rows[k - 1].time - 1e-3) < 1e-9);
  MUST(mvs_device_advance(device, 10));
  MUST(mvs_device_take_samples(device, rows, sizeof rows[0], 64, &count, &lost));
  CHECK(count == 64 && lost == 10000 - 8191);
  /* an older program has smaller samples, a newer one larger samples */
  struct {
    double time, position[3];
  } small[2];
  struct {
    mvs_device_sample known;
    double later;
  } large[2];
  memset(large, 1, sizeof large);
  MUST(mvs_device_take_samples(device, (mvs_device_sample *)small, sizeof small[0], 2, &count,
                               &lost));
  CHECK(count == 2 && fabs(small[1].time - small[0].time - 1e-3) < 1e-9);
  MUST(mvs_device_take_samples(device, (mvs_device_sample *)large, sizeof large[0], 2, &count,
                               &lost));
  CHECK(count == 2 && fabs(large[0].known.time - small[1].time - 1e-3) < 1e-9);
  CHECK(large[0].later == 0 && large[1].later == 0);
  MUST_FAIL(mvs_device_take_samples(device, rows, 0, 64, &count, &lost), MVS_E_ARGUMENT, "stride");
  mvs_device_close(device);
}

int main(void) {
  mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  MUST(mvs_create(NULL, &sim));
  MUST(generate_founding(sim));
  MUST(mvs_set_load(sim, &systole));
  MUST(mvs_settle(sim, NULL, NULL));
  closed = present();
  a_grasp_pulls_and_lets_go_and_is_the_same_each_time();
  the_force_is_that_of_the_tool_in_the_valve();
  an_undo_while_something_is_held_lets_it_go();
  another_valve_under_the_hand_is_another_hand();
  a_ball_pushes_and_is_taken_away_with_its_mode();
  a_convex_tool_pushes_in_the_hand();
  a_tool_waits_for_the_first_sample();
  a_stopped_device_lets_go();
  a_chord_is_felt_as_it_pulls();
  a_chord_is_dragged_to_a_new_length();
  what_makes_no_sense_is_refused();
  limits_can_only_be_lowered();
  a_trace_has_every_tick();
  mvs_snapshot_release(closed);
  mvs_destroy(sim);
  return finish("devices");
}
