/* Template of a driver: one device, at rest in the middle of its workspace, that works unchanged.
 *
 * 1. Copy the folder, replace `template` by your name here and in its CMakeLists.txt, and build.
 *    `mvs haptics list` then shows it.
 * 2. Implement the five functions of "the hardware" for your device. Convert there to m, m/s, N,
 *    rad, and right-handed axes of the device. The code below can stay.
 * 3. Fill describe() with your device's limits. They protect the hand: choose them low.
 *
 * README.md, one folder up, lists the order of calls and their threads. */
#include <mvs/driver.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- the device: the state of an open device; no globals */

struct mvs_driver_device {
  int motors; /* cleared by stop() from any thread: access atomically */
  uint64_t sequence, time_ns;
  mvs_driver_force force; /* the last written force */
  char sentence[256];     /* the last error message of this device */
};

/* The last error message of list, doctor or open, which have no device. */
static __thread char last_sentence[256] = "";

/* The only device of this driver, and whether it is open. */
static const char only_name[] = "desk";
static char taken;

/* ---- the hardware: five functions to replace */

/* Returns whether the device is connected; must not move it. */
static int hardware_present(void) {
  return 1;
}

/* A device can be open only once. With real hardware its library reports this. */
static int32_t hardware_open(mvs_driver_device *device) {
  (void)device;
  if (!__atomic_test_and_set(&taken, __ATOMIC_SEQ_CST)) return MVS_DRIVER_OK;
  snprintf(last_sentence, sizeof last_sentence,
           "%s is open already: close it there, or let that program end", only_name);
  return MVS_DRIVER_E_BUSY;
}

static void hardware_close(mvs_driver_device *device) {
  (void)device;
  __atomic_clear(&taken, __ATOMIC_SEQ_CST);
}

/* Reads the pose of the hand. Called at the device's rate: no lock, no allocation, and no wait
 * except for the device, for at most MVS_DRIVER_PATIENCE_MS; then MVS_DRIVER_E_LOST. */
static int32_t hardware_read(mvs_driver_device *device, mvs_driver_state *state) {
  (void)device;
  state->position[0] = state->position[1] = state->position[2] = 0;
  state->orientation[0] = 1; /* a unit quaternion, also for a device without orientation */
  state->flags = MVS_DRIVER_FLAG_CALIBRATED;
  return MVS_DRIVER_OK;
}

/* Passes the force to the motors unchanged: libmvs has clamped and ramped it. */
static int32_t hardware_write(mvs_driver_device *device, const double force[3]) {
  memcpy(device->force.force, force, sizeof device->force.force);
  return MVS_DRIVER_OK;
}

/* ---- description of the device */

static void describe(mvs_driver_info *info) {
  int k;
  info->freedoms_in = 3;
  info->freedoms_out = 3;
  info->buttons = 2;
  for (k = 0; k < 3; ++k) {
    info->workspace_min[k] = -0.08;
    info->workspace_max[k] = 0.08;
  }
  info->peak_force = 3.3;
  info->continuous_force = 0.88;
  info->max_stiffness = 400; /* the largest stable stiffness, not the strength of the arm */
  info->max_damping = 4;
  info->rate = 1000;
  /* info->frame stays zero: x is to the right, y up, z towards the user. A device with z up and x
   * towards the user has {0, 1, 0, 0,  0, 0, 1, 0,  1, 0, 0, 0}. */
  snprintf(info->model, sizeof info->model, "template");
}

/* ---- struct sizes: write at most the caller's struct_size, read absent fields as zero */

static void give(const void *full, size_t size, void *out) {
  uint32_t room;
  memcpy(&room, out, sizeof room); /* every struct begins with struct_size, which is kept */
  if (room <= sizeof room) return;
  memcpy((char *)out + sizeof room, (const char *)full + sizeof room,
         (room < size ? room : size) - sizeof room);
}

static void take(const void *in, void *full, size_t size) {
  uint32_t filled;
  memcpy(&filled, in, sizeof filled);
  memset(full, 0, size);
  memcpy(full, in, filled < size ? filled : size);
}

/* ---- the interface */

static int32_t list(const mvs_driver_host *host, mvs_driver_found found, void *user) {
  (void)host;
  if (hardware_present()) found(user, only_name, "template");
  return MVS_DRIVER_OK;
}

/* One finding for each known obstacle to using the device, with its remedy. */
static int32_t doctor(const mvs_driver_host *host, mvs_driver_finding finding, void *user) {
  (void)host;
  if (hardware_present())
    finding(user, 1, "device", "desk is there");
  else
    finding(user, 0, "device", "no device was found: plug it in, and look at its power supply");
  return MVS_DRIVER_OK;
}

static int32_t open_device(const mvs_driver_host *host, const char *name,
                           mvs_driver_device **device) {
  mvs_driver_device *made;
  int32_t code;
  (void)host; /* options: host->option(host->host, "key") */
  *device = NULL;
  if (!hardware_present() || (name && strcmp(name, only_name) != 0)) {
    snprintf(last_sentence, sizeof last_sentence, "there is no device \"%.100s\": try \"%s\"",
             name ? name : only_name, only_name);
    return MVS_DRIVER_E_ABSENT;
  }
  made = calloc(1, sizeof *made);
  if (!made) {
    snprintf(last_sentence, sizeof last_sentence, "no memory for the device");
    return MVS_DRIVER_E_INTERNAL;
  }
  code = hardware_open(made);
  if (code == MVS_DRIVER_OK)
    *device = made;
  else
    free(made);
  return code;
}

static int32_t info_of(mvs_driver_device *device, mvs_driver_info *info) {
  mvs_driver_info full = {0};
  (void)device;
  describe(&full);
  give(&full, sizeof full, info);
  return MVS_DRIVER_OK;
}

/* Switches the motors on; they are off before. */
static int32_t start(mvs_driver_device *device) {
  memset(&device->force, 0, sizeof device->force);
  __atomic_store_n(&device->motors, 1, __ATOMIC_SEQ_CST);
  return MVS_DRIVER_OK;
}

/* `now_ns` is the clock of the caller: a real device stamps its sample with it, a simulated one
 * uses it as its only time. */
static int32_t read_state(mvs_driver_device *device, uint64_t now_ns, mvs_driver_state *state) {
  mvs_driver_state full = {0};
  const int32_t code = hardware_read(device, &full);
  if (code != MVS_DRIVER_OK) {
    snprintf(device->sentence, sizeof device->sentence, "%s does not answer", only_name);
    return code;
  }
  /* a new sample has a new number; a second read at the same time returns the same one */
  if (device->sequence == 0 || now_ns > device->time_ns) {
    ++device->sequence;
    device->time_ns = now_ns;
  }
  full.sequence = device->sequence;
  full.time_ns = device->time_ns;
  if (device->force.on && __atomic_load_n(&device->motors, __ATOMIC_SEQ_CST))
    full.flags |= MVS_DRIVER_FLAG_FORCE_ON;
  give(&full, sizeof full, state);
  return MVS_DRIVER_OK;
}

static int32_t write_force(mvs_driver_device *device, const mvs_driver_force *force) {
  static const double nothing[3] = {0, 0, 0};
  mvs_driver_force full;
  take(force, &full, sizeof full);
  device->force.on = full.on && __atomic_load_n(&device->motors, __ATOMIC_SEQ_CST);
  return hardware_write(device, device->force.on ? full.force : nothing);
}

static int32_t stop(mvs_driver_device *device) {
  __atomic_store_n(
      &device->motors, 0,
      __ATOMIC_SEQ_CST); /* and stop the hardware, if that is allowed from any thread */
  return MVS_DRIVER_OK;
}

/* Called in a handler of a fatal signal: no printf, no malloc, no lock. */
static void panic(mvs_driver_device *device) {
  __atomic_store_n(&device->motors, 0, __ATOMIC_SEQ_CST);
}

static void close_device(mvs_driver_device *device) {
  stop(device);
  hardware_close(device);
  free(device);
}

static const char *error(const mvs_driver_device *device) {
  return device ? device->sentence : last_sentence;
}

static const char *const options[] = {NULL}; /* "port: of the serial line", one a line */

int32_t mvs_driver_negotiate(const mvs_driver_host *host, mvs_driver_api *api) {
  static const mvs_driver_api ours = {
      .struct_size = sizeof ours,
      .version = MVS_DRIVER_VERSION,
      .name = "template",
      .about = "a device at rest, to copy",
      .options = options,
      .list = list,
      .doctor = doctor,
      .open = open_device,
      .info = info_of,
      .calibrate = NULL, /* nothing to calibrate */
      .start = start,
      .read = read_state, /* polled; a device with its own thread has .run instead of both */
      .write = write_force,
      .run = NULL,
      .stop = stop,
      .panic = panic,
      .close = close_device,
      .error = error,
  };
  const size_t least = offsetof(mvs_driver_api, error) + sizeof api->error;
  if (!host || !api || host->oldest > MVS_DRIVER_VERSION || host->newest < MVS_DRIVER_VERSION ||
      api->struct_size < least)
    return MVS_DRIVER_E_VERSION;
  give(&ours, sizeof ours, api);
  if (api->struct_size > sizeof ours) api->struct_size = sizeof ours;
  return MVS_DRIVER_OK;
}
