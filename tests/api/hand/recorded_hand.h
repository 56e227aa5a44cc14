/* Fixture: a haptic device that plays a recording beside the shipped valve under systole. */
#ifndef TESTS_RECORDED_HAND_H
#define TESTS_RECORDED_HAND_H

#include <math.h>
#include <stdlib.h>

#include "tests/api/check.h"
#include "tests/founding.h"

#define TRAJECTORIES MVS_SOURCE_DIR "/haptic_drivers/replay/trajectories/"

static mvs_sim *sim;
static const mvs_snapshot *closed; /* the shipped valve under systole */

static inline const mvs_snapshot *present(void) {
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_get_snapshot(sim, &snapshot));
  return snapshot;
}

static inline mvs_device *opened(const char *recording, uint32_t mode) {
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
static inline mvs_device_report turn(mvs_device *device) {
  mvs_device_report report = {.struct_size = sizeof report};
  mvs_step_options step = {.struct_size = sizeof step, .dt = 0.01};
  MUST(mvs_device_advance(device, 0.01));
  MUST(mvs_device_sync(device, sim, &report));
  MUST(mvs_step(sim, &step));
  return report;
}

static inline mvs_device_state state_of(mvs_device *device) {
  mvs_device_state state = {.struct_size = sizeof state};
  MUST(mvs_device_get_state(device, &state));
  return state;
}

static inline double length(const double v[3]) {
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* Steps until an event occurs, at most `turns` times; returns the report with the event. */
static inline mvs_device_report turn_until(mvs_device *device, uint32_t event, int most) {
  mvs_device_report report = {0};
  for (int k = 0; k < most && !(report.events & event); ++k) report = turn(device);
  CHECK(report.events & event);
  return report;
}

static inline void close_the_valve(void) {
  mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  MUST(mvs_create(NULL, &sim));
  MUST(generate_founding(sim));
  MUST(mvs_set_load(sim, &systole));
  MUST(mvs_settle(sim, NULL, NULL));
  closed = present();
}

static inline int finish_devices(const char *name) {
  mvs_snapshot_release(closed);
  mvs_destroy(sim);
  return finish(name);
}

#endif
