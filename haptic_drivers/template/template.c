/* A driver to copy: one device, at rest in the middle of its workspace, that works as it is.
 *
 * 1. Copy the folder, put your name for `template` here and in its CMakeLists.txt; build; now
 *    `mvs haptics list` names it.
 * 2. Make the five functions of "the hardware" talk to your device. Convert there: to m, m/s, N,
 *    rad, and the device's own right-handed axes. Everything below may then stay.
 * 3. Fill describe() with your device's limits. They keep the hand safe: rather too small.
 *
 * README.md, one folder up, says in which order these functions are called, and by which thread. */
#include <mvs/driver.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- the device: all that belongs to one that is open; nothing of it is global */

struct mvs_driver_device {
  int motors; /* stop() clears it from any thread: hence read and set atomically */
  uint64_t sequence, time_ns;
  mvs_driver_force force; /* the last one written */
  char sentence[256];     /* what error() gives: the last failure of this device */
};

/* The last failure of list, doctor or open, which have no device. */
static __thread char last_sentence[256] = "";

/* The one device of this driver, and whether somebody has it open. */
static const char only_name[] = "desk";
static char taken;

/* ---- the hardware: five functions to replace */

/* Is it plugged in? Look only; do not move it. */
static int hardware_present(void) {
  return 1;
}

/* Nobody may have a device twice. With real hardware its own library will say so. */
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

/* Where the hand is. Called at the device's rate: no lock, no allocation, no waiting for anything
 * but the device, and for that at most MVS_DRIVER_PATIENCE_MS; then MVS_DRIVER_E_LOST. */
static int32_t hardware_read(mvs_driver_device *device, mvs_driver_state *state) {
  (void)device;
  state->position[0] = state->position[1] = state->position[2] = 0;
  state->orientation[0] = 1; /* a unit quaternion, also of a device that does not turn */
  state->flags = MVS_DRIVER_FLAG_CALIBRATED;
  return MVS_DRIVER_OK;
}

/* To the motors, as it is: libmvs has clamped and ramped it. */
static int32_t hardware_write(mvs_driver_device *device, const double force[3]) {
  memcpy(device->force.force, force, sizeof device->force.force);
  return MVS_DRIVER_OK;
}

/* ---- what the device is */

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
  info->max_stiffness = 400; /* what it renders without buzzing, not what its arm would bear */
  info->max_damping = 4;
  info->rate = 1000;
  /* info->frame stays zero: x is to the right, y up, z towards the user. A device with z up and x
   * towards the user has {0, 1, 0, 0,  0, 0, 1, 0,  1, 0, 0, 0}. */
  snprintf(info->model, sizeof info->model, "template");
}

/* ---- sizes: write no further than the caller has room, take what it did not give as zero */

static void give(const void *full, size_t size, void *out) {
  uint32_t room;
  memcpy(&room, out, sizeof room); /* every struct begins with struct_size, which stays */
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

/* Everything that ever kept somebody from using the device, each with what to do about it. */
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
  (void)host; /* host->option(host->host, "key") is where options come from */
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

/* From here on the motors follow what is written; until then they are off. */
static int32_t start(mvs_driver_device *device) {
  memset(&device->force, 0, sizeof device->force);
  __atomic_store_n(&device->motors, 1, __ATOMIC_SEQ_CST);
  return MVS_DRIVER_OK;
}

/* `now_ns` is the clock of who polls; a real device stamps its sample with it, a simulated one
 * takes its time from it, and from nowhere else. */
static int32_t read_state(mvs_driver_device *device, uint64_t now_ns, mvs_driver_state *state) {
  mvs_driver_state full = {0};
  const int32_t code = hardware_read(device, &full);
  if (code != MVS_DRIVER_OK) {
    snprintf(device->sentence, sizeof device->sentence, "%s does not answer", only_name);
    return code;
  }
  /* a new sample has a new number; who asks twice at one instant gets the same one */
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
      __ATOMIC_SEQ_CST); /* and tell the hardware, if that may be done from any thread */
  return MVS_DRIVER_OK;
}

/* In a handler of a fatal signal: no printf, no malloc, no lock. */
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
      .read = read_state, /* polled; a device with a thread of its own has .run instead of both */
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
