/* The torque of a rod and of a convex tool on devices with motors for it and on others, and its
 * limits. The devices are those of the driver hand. */
#include <math.h>

#include "tests/api/check.h"
#include "tests/founding.h"

static mvs_sim *sim;
static const mvs_snapshot *closed; /* the shipped valve under systole */

static double length(const double v[3]) {
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* The shape of the rod as a convex tool. */
static const mvs_body_desc capsule = {
    .kind = MVS_BODY_KIND_CAPSULE, .end = {0, 0, 0.02}, .radius = 1e-3};

/* A rod or convex tool that swings through the closed valve and turns. */
static mvs_device *opened_with_torque(const char *kind, uint32_t mode) {
  char options[256];
  mvs_device *device = NULL;
  snprintf(options, sizeof options,
           "device=%s\nturned=0.3,0,0\nwrist_stiffness=100\nwrist_damping=1\n"
           "amplitude=0.004,0.004,0.012\nturn_amplitude=0.3,0.1,0\nfrequency=0.5",
           kind);
  mvs_device_desc desc = {
      .struct_size = sizeof desc, .clock = MVS_CLOCK_VIRTUAL, .driver = "hand", .options = options};
  mvs_device_view view = {.struct_size = sizeof view, .origin = {0, 0, 0.005}};
  mvs_device_hand hand = {.struct_size = sizeof hand, .mode = mode};
  if (mode == MVS_HAND_MODE_ROD) {
    hand.length = 0.02;
    hand.radius = 1e-3;
  } else {
    hand.bodies = &capsule;
    hand.body_count = 1;
    hand.body_stride = sizeof capsule;
  }
  MUST(mvs_restore(sim, closed));
  MUST(mvs_device_open(&desc, &device));
  MUST(mvs_device_set_view(device, &view));
  MUST(mvs_device_set_hand(device, &hand));
  MUST(mvs_device_start(device));
  MUST(mvs_device_advance(device, 0.01));
  MUST(mvs_device_arm(device));
  return device;
}

/* The largest torque in the scene and of the motors while the tool swings through the valve. */
static void largest_torques(const char *kind, uint32_t mode, double *scene, double *motors,
                            double *stiffness) {
  mvs_device *device = opened_with_torque(kind, mode);
  mvs_device_info info = {.struct_size = sizeof info};
  MUST(mvs_device_get_info(device, &info));
  *scene = *motors = *stiffness = 0;
  for (int k = 0; k < 300; ++k) {
    mvs_device_report report = {.struct_size = sizeof report};
    mvs_device_state state = {.struct_size = sizeof state};
    mvs_step_options step = {.struct_size = sizeof step, .dt = 0.01};
    MUST(mvs_device_advance(device, 0.01));
    MUST(mvs_device_sync(device, sim, &report));
    MUST(mvs_step(sim, &step));
    MUST(mvs_device_get_state(device, &state));
    *scene = fmax(*scene, length(report.torque));
    *motors = fmax(*motors, length(state.torque));
    *stiffness = fmax(*stiffness, report.angular_stiffness);
    CHECK(length(state.torque) <= info.peak_torque);
    CHECK(report.angular_stiffness <= info.max_angular_stiffness * (1 + 1e-9));
  }
  mvs_device_close(device);
}

static void the_torque_of_a_tool_reaches_only_devices_with_motors_for_it(uint32_t mode) {
  double scene = 0, motors = 0, stiffness = 0;
  largest_torques("premium6", mode, &scene, &motors, &stiffness);
  CHECK(scene > 1e-4 && motors > 1e-4 && stiffness > 0);
  largest_torques("touch", mode, &scene, &motors, &stiffness);
  CHECK(scene > 1e-4 && motors == 0 && stiffness == 0);
}

static void limits_of_torque_can_only_be_lowered(void) {
  mvs_device *device = opened_with_torque("premium6", MVS_HAND_MODE_ROD);
  mvs_device_info info = {.struct_size = sizeof info};
  mvs_device_limits limits = {.struct_size = sizeof limits, .torque = 1, .angular_stiffness = 100};
  MUST(mvs_device_get_info(device, &info));
  /* the unknown ones follow from those of the force, at the lever of both peaks */
  const double lever = info.peak_torque / info.peak_force;
  CHECK(info.peak_torque == 0.188);
  CHECK(fabs(info.continuous_torque / lever / info.continuous_force - 1) < 1e-12);
  CHECK(fabs(info.max_angular_stiffness / (lever * lever) / info.max_stiffness - 1) < 1e-12);
  CHECK(fabs(info.max_angular_damping / (lever * lever) / info.max_damping - 1) < 1e-12);
  MUST(mvs_device_set_limits(device, &limits));
  MUST(mvs_device_get_limits(device, &limits));
  CHECK(limits.torque == info.peak_torque);
  CHECK(limits.angular_stiffness == info.max_angular_stiffness);
  CHECK(limits.torque_slew == 100 * info.peak_torque && limits.angular_speed == 20);
  limits.torque = -1;
  MUST_FAIL(mvs_device_set_limits(device, &limits), MVS_E_ARGUMENT, "limits.torque");
  limits.torque = NAN;
  MUST_FAIL(mvs_device_set_limits(device, &limits), MVS_E_ARGUMENT, "limits.torque");
  mvs_device_close(device);
}

int main(void) {
  mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  MUST(mvs_create(NULL, &sim));
  MUST(generate_founding(sim));
  MUST(mvs_set_load(sim, &systole));
  MUST(mvs_settle(sim, NULL, NULL));
  MUST(mvs_get_snapshot(sim, &closed));
  the_torque_of_a_tool_reaches_only_devices_with_motors_for_it(MVS_HAND_MODE_ROD);
  the_torque_of_a_tool_reaches_only_devices_with_motors_for_it(MVS_HAND_MODE_CONVEX);
  limits_of_torque_can_only_be_lowered();
  mvs_snapshot_release(closed);
  mvs_destroy(sim);
  return finish("device_torque");
}
