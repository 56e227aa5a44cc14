/* Tools of a device belong to it: one that an undo or a restored snapshot brings back is held by
 * the hand again or removed, and closing the device removes all. */
#include "recorded_hand.h"
#include "tool_count.h"

static void shorten_a_chord(void) {
  mvs_part chord;
  const mvs_snapshot *snapshot = present();
  MUST(mvs_snapshot_get_part(snapshot, MVS_PART_CHORD, 0, &chord));
  mvs_op_chord_length op = {
      .op = {sizeof op, MVS_OP_CHORD_LENGTH}, .chord = chord.id, .factor = 0.98};
  MUST(mvs_apply_op(sim, &op.op, NULL));
  mvs_snapshot_release(snapshot);
}

static void an_undo_after_letting_go_brings_no_grasp_back(void) {
  mvs_device *device = opened("grasp_a2.txt", MVS_HAND_MODE_GRASP);
  turn_until(device, MVS_EVENT_GRASPED, 400);
  shorten_a_chord();
  turn_until(device, MVS_EVENT_LET_GO, 500);
  CHECK(tool_count(sim) == 0);
  MUST(mvs_undo(sim));
  CHECK(tool_count(sim) == 1);
  CHECK(turn(device).tool == 0);
  CHECK(tool_count(sim) == 0);
  mvs_device_close(device);
}

static void a_grasp_that_returns_under_the_pressed_button_is_held_again(void) {
  mvs_device *device = opened("grasp_a2.txt", MVS_HAND_MODE_GRASP);
  const mvs_snapshot *before = present();
  const mvs_id tool = turn_until(device, MVS_EVENT_GRASPED, 400).tool;
  const mvs_snapshot *held = present();
  MUST(mvs_restore(sim, before));
  CHECK(turn(device).events == MVS_EVENT_LOST_TOOL);
  MUST(mvs_restore(sim, held));
  const mvs_device_report report = turn(device);
  CHECK(report.events == MVS_EVENT_GRASPED && report.tool == tool);
  CHECK(tool_count(sim) == 1);
  /* also after its release it is the hand's */
  turn_until(device, MVS_EVENT_LET_GO, 500);
  MUST(mvs_restore(sim, held));
  CHECK(turn(device).tool == 0);
  CHECK(tool_count(sim) == 0);
  mvs_snapshot_release(before);
  mvs_snapshot_release(held);
  mvs_device_close(device);
}

/* A session; builds without HDF5 have none. */
static void a_grasp_that_a_file_brings_back_is_the_hands(void) {
  mvs_device *device = opened("grasp_a2.txt", MVS_HAND_MODE_GRASP);
  const mvs_id tool = turn_until(device, MVS_EVENT_GRASPED, 400).tool;
  const char *const path = "returned_tools.h5";
  const mvs_snapshot *held = present();
  const mvs_result saved = mvs_save_file(held, path, MVS_FORMAT_H5);
  mvs_snapshot_release(held);
  if (saved == MVS_E_UNSUPPORTED) {
    mvs_device_close(device);
    return;
  }
  MUST(saved);
  MUST(mvs_load_file(sim, path, MVS_FORMAT_H5));
  CHECK(turn(device).tool == tool && tool_count(sim) == 1);
  CHECK(turn(device).tool == tool);
  turn_until(device, MVS_EVENT_LET_GO, 500);
  CHECK(tool_count(sim) == 0);
  MUST(mvs_load_file(sim, path, MVS_FORMAT_H5));
  CHECK(turn(device).tool == 0 && tool_count(sim) == 0);
  mvs_device_close(device);
  remove(path);
}

static void a_device_that_closes_leaves_the_tools_of_others_alone(void) {
  mvs_device *device = opened("push_p2.txt", MVS_HAND_MODE_BALL);
  mvs_tool_desc ball = {
      .struct_size = sizeof ball, .kind = MVS_TOOL_KIND_BALL, .position = {0, 0, 0.2}};
  mvs_id other = 0;
  MUST(mvs_add_tool(sim, &ball, &other));
  for (int k = 0; k < 5; ++k) turn(device);
  CHECK(tool_count(sim) == 2);
  mvs_device_close(device);
  mvs_tool_state state = {.struct_size = sizeof state};
  CHECK(tool_count(sim) == 1);
  MUST(mvs_get_tool(sim, other, &state));
}

static void a_device_may_outlive_its_simulator(void) {
  mvs_device *device = opened("push_p2.txt", MVS_HAND_MODE_BALL);
  mvs_sim *short_lived = NULL;
  MUST(mvs_create(NULL, &short_lived));
  MUST(mvs_restore(short_lived, closed));
  MUST(mvs_device_sync(device, short_lived, NULL));
  CHECK(tool_count(short_lived) == 1);
  mvs_destroy(short_lived);
  mvs_device_close(device);
}

int main(void) {
  close_the_valve();
  an_undo_after_letting_go_brings_no_grasp_back();
  a_grasp_that_returns_under_the_pressed_button_is_held_again();
  a_grasp_that_a_file_brings_back_is_the_hands();
  a_device_that_closes_leaves_the_tools_of_others_alone();
  a_device_may_outlive_its_simulator();
  return finish_devices("returned_tools");
}
