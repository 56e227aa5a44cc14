/* The button of a haptic device: a hand follows its present state, also after a restart of the
 * device and after more changes than the queue between servo and simulation holds. */
#include "recorded_hand.h"
#include "tool_count.h"

static void a_restart_lets_go(void) {
  mvs_device *device = opened("grasp_a2.txt", MVS_HAND_MODE_GRASP);
  turn_until(device, MVS_EVENT_GRASPED, 400);
  MUST(mvs_device_stop(device));
  MUST(mvs_device_start(device)); /* the recording begins anew, its button is up */
  const mvs_device_report report = turn(device);
  CHECK(report.events == (MVS_EVENT_RELEASED | MVS_EVENT_LET_GO) && report.tool == 0);
  CHECK(tool_count(sim) == 0);
  turn_until(device, MVS_EVENT_GRASPED, 400);
  mvs_device_close(device);
}

static void the_first_press_after_a_restart_grasps(void) {
  mvs_device *device = opened("grasp_a2.txt", MVS_HAND_MODE_GRASP);
  turn_until(device, MVS_EVENT_GRASPED, 400);
  MUST(mvs_device_stop(device));
  mvs_device_report report = {.struct_size = sizeof report};
  MUST(mvs_device_sync(device, sim, &report));
  CHECK(report.events == (MVS_EVENT_RELEASED | MVS_EVENT_LET_GO));
  MUST(mvs_device_start(device));
  report = turn_until(device, MVS_EVENT_PRESSED, 400);
  CHECK(report.events == (MVS_EVENT_PRESSED | MVS_EVENT_GRASPED) && tool_count(sim) == 1);
  mvs_device_close(device);
}

/* A press that no sync has seen before the stop is none of the time after it. */
static void a_press_before_a_restart_is_forgotten(void) {
  mvs_device *device = opened("grasp_a2.txt", MVS_HAND_MODE_GRASP);
  while (state_of(device).buttons == 0) MUST(mvs_device_advance(device, 0.01));
  MUST(mvs_device_stop(device));
  MUST(mvs_device_start(device));
  const mvs_device_report report = turn(device);
  CHECK(report.events == 0 && report.tool == 0);
  mvs_device_close(device);
}

/* Writes a hand at rest over the middle of the anterior leaflet that clicks `clicks` times and ends
 * with the button as `down` says. */
static const char *recording_of_clicks(int clicks, uint32_t down) {
  static const char *const name = "device_buttons.txt";
  FILE *const file = fopen(name, "w");
  if (!file) abort();
  fprintf(file, "mvs-recording 1\nforce 3.3\nstiffness 400\ndamping 4\nbuttons 1\n");
  const char *const row = "%.3f 0 0 0 1 0 0 0 %u 0\n";
  fprintf(file, row, 0.0, 0u);
  for (int k = 0; k < clicks; ++k) {
    fprintf(file, row, 0.2 + 0.03 * k, 1u);
    fprintf(file, row, 0.215 + 0.03 * k, 0u);
  }
  fprintf(file, row, 0.2 + 0.03 * clicks, down);
  fprintf(file, row, 10.0, down);
  fclose(file);
  return name;
}

static void clicks_without_a_sync_end_in_the_present_state(uint32_t down) {
  char options[64];
  snprintf(options, sizeof options, "file=%s", recording_of_clicks(140, down));
  mvs_device *device = NULL;
  mvs_device_desc desc = {.struct_size = sizeof desc,
                          .clock = MVS_CLOCK_VIRTUAL,
                          .driver = "replay",
                          .options = options};
  mvs_device_hand hand = {.struct_size = sizeof hand, .mode = MVS_HAND_MODE_GRASP, .reach = 0.1};
  MUST(mvs_device_open(&desc, &device));
  MUST(mvs_device_set_hand(device, &hand));
  MUST(mvs_device_start(device));
  MUST(mvs_restore(sim, closed));
  turn(device);
  MUST(mvs_device_advance(device, 6));
  CHECK(state_of(device).buttons == down);
  const mvs_device_report report = turn(device);
  CHECK((report.tool != 0) == (down != 0) && tool_count(sim) == down);
  mvs_device_close(device);
}

int main(void) {
  close_the_valve();
  a_restart_lets_go();
  the_first_press_after_a_restart_grasps();
  a_press_before_a_restart_is_forgotten();
  clicks_without_a_sync_end_in_the_present_state(0);
  clicks_without_a_sync_end_in_the_present_state(1);
  return finish_devices("device_buttons");
}
