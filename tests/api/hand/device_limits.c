/* Haptic devices: refusals, limits that can only be lowered, the trace of every tick. */
#include "recorded_hand.h"

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
  mvs_device_limits reserved = {.struct_size = sizeof reserved, .reserved = 1};
  MUST_FAIL(mvs_device_set_limits(device, &reserved), MVS_E_ARGUMENT, "limits.reserved");
  for (int k = 0; k < 5; ++k) {
    mvs_device_view unknown = {.struct_size = sizeof unknown, .rotation = {1, 1, 1, 1}};
    if (k < 4) unknown.rotation[k] = NAN;
    if (k == 4) unknown.reserved = 1;
    MUST_FAIL(mvs_device_set_view(device, &unknown), MVS_E_ARGUMENT,
              k < 4 ? "view.rotation" : "view.reserved");
  }
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
  close_the_valve();
  what_makes_no_sense_is_refused();
  limits_can_only_be_lowered();
  a_trace_has_every_tick();
  return finish_devices("device_limits");
}
