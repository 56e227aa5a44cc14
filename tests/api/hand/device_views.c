/* A view that changes while a hand feels tissue: the limit of stiffness holds, and the force begins
 * with a ramp. */
#include "recorded_hand.h"

/* A hand that has been in contact for `turns`. */
static mvs_device *in_contact(const char *recording, uint32_t mode, int turns) {
  mvs_device *device = opened(recording, mode);
  if (mode == MVS_HAND_MODE_GRASP) turn_until(device, MVS_EVENT_GRASPED, 400);
  for (int k = 0; k < turns; ++k) turn(device);
  return device;
}

static void set_force_scale(mvs_device *device, double scale) {
  mvs_device_view view = {.struct_size = sizeof view};
  MUST(mvs_device_get_view(device, &view));
  view.force_scale = scale;
  MUST(mvs_device_set_view(device, &view));
}

/* The spring of 200 N/m may be felt with the 400 N/m of the device. */
static void a_larger_scale_keeps_the_limit_of_stiffness(double scale) {
  mvs_device *device = in_contact("grasp_a2.txt", MVS_HAND_MODE_GRASP, 70);
  set_force_scale(device, scale);
  for (int k = 0; k < 20; ++k) turn(device);
  const mvs_device_report report = turn(device);
  const double felt = length(state_of(device).force), simulated = length(report.force);
  CHECK(simulated > 0.2 && felt < 3); /* below the limits of the force */
  CHECK(fabs(felt / simulated - 2) < 0.2);
  CHECK(report.stiffness > 10 && report.stiffness < 399);
  mvs_device_close(device);
}

/* Also where the spring cannot be softened further. */
static void a_grasp_through_a_large_scale_keeps_the_limit_of_stiffness(void) {
  mvs_device *device = opened("grasp_a2.txt", MVS_HAND_MODE_GRASP);
  set_force_scale(device, 1000);
  turn_until(device, MVS_EVENT_GRASPED, 400);
  for (int k = 0; k < 70; ++k) turn(device);
  const mvs_device_report report = turn(device);
  const double felt = length(state_of(device).force), simulated = length(report.force);
  CHECK(felt > 0.2 && fabs(felt / simulated - 400) < 40);
  mvs_device_close(device);
}

/* Moves the hand of the scene by 4 mm farther against the force. */
static void move_view(mvs_device *device, const double force[3]) {
  mvs_device_view view = {.struct_size = sizeof view};
  MUST(mvs_device_get_view(device, &view));
  for (int k = 0; k < 3; ++k) view.origin[k] -= 4e-3 * force[k] / length(force);
  MUST(mvs_device_set_view(device, &view));
}

static void a_jump_begins_a_ramp(const char *recording, uint32_t mode, int turns) {
  mvs_device *device = in_contact(recording, mode, turns);
  const mvs_device_report before = turn(device);
  const double felt = length(state_of(device).force);
  CHECK(felt > 0.2);
  move_view(device, before.force);
  turn(device);
  turn(device);
  CHECK(length(state_of(device).force) < 0.5 * felt);
  for (int k = 0; k < 10; ++k) turn(device);
  CHECK(length(state_of(device).force) > 1.1 * felt);
  mvs_device_close(device);
}

/* As of a camera that turns. */
static void small_steps_of_a_view_keep_the_force(void) {
  mvs_device *device = in_contact("grasp_a2.txt", MVS_HAND_MODE_GRASP, 160);
  const double felt = length(state_of(device).force);
  for (int k = 0; k < 10; ++k) {
    set_force_scale(device, 1 + 0.02 * k);
    turn(device);
    CHECK(length(state_of(device).force) > 0.9 * felt);
  }
  mvs_device_close(device);
}

int main(void) {
  close_the_valve();
  a_larger_scale_keeps_the_limit_of_stiffness(4);
  a_larger_scale_keeps_the_limit_of_stiffness(8);
  a_grasp_through_a_large_scale_keeps_the_limit_of_stiffness();
  a_jump_begins_a_ramp("grasp_a2.txt", MVS_HAND_MODE_GRASP, 160);
  a_jump_begins_a_ramp("push_p2.txt", MVS_HAND_MODE_BALL, 250);
  small_steps_of_a_view_keep_the_force();
  return finish_devices("device_views");
}
