/* Drivers with a defect that libmvs has to detect: compiled once for each LIE_*. */
#include <math.h>
#include <mvs/driver.h>
#include <pthread.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct mvs_driver_device {
  uint64_t sequence;
};
static struct mvs_driver_device the_one;

/* The calls of libmvs to the driver, for tests. */
struct asked {
  mvs_driver_force last; /* written */
  int stops, panics;
};
static struct asked asked;
static pthread_mutex_t asked_lock = PTHREAD_MUTEX_INITIALIZER;

/* A copy: the servo's thread goes on. */
MVS_DRIVER_EXPORT void mvs_liar_asked(struct asked *to);
void mvs_liar_asked(struct asked *to) {
  pthread_mutex_lock(&asked_lock);
  *to = asked;
  pthread_mutex_unlock(&asked_lock);
}

static void note(const mvs_driver_force *force, int stops, int panics) {
  pthread_mutex_lock(&asked_lock);
  if (force) asked.last = *force;
  asked.stops += stops;
  asked.panics += panics;
  pthread_mutex_unlock(&asked_lock);
}

/* The sample from which on a device fails, some of it after forces are on. */
#define AT 1000u

#ifdef LIE_CLOSES_LATE
static const mvs_driver_host *kept_host;
#endif

static int32_t open_device(const mvs_driver_host *host, const char *name,
                           mvs_driver_device **device) {
  (void)host;
#ifdef LIE_CLOSES_LATE
  kept_host = host;
  host->log(host->host, "a sentence of open()");
#endif
  (void)name;
#ifdef LIE_HANGS
  pause(); /* for ever */
#endif
#ifdef LIE_REFUSES
  return MVS_DRIVER_E_PERMISSION;
#endif
  *device = &the_one;
  the_one.sequence = 0;
  pthread_mutex_lock(&asked_lock);
  memset(&asked, 0, sizeof asked);
  pthread_mutex_unlock(&asked_lock);
#ifdef LIE_NO_HANDLE
  *device = NULL;
#endif
  return MVS_DRIVER_OK;
}

static int32_t info(mvs_driver_device *device, mvs_driver_info *to) {
  (void)device;
  const uint32_t size = to->struct_size;
  memset(to, 0, sizeof *to);
  to->struct_size = size;
  to->freedoms_in = to->freedoms_out = 3;
#ifdef LIE_NAN
  to->peak_force = NAN;
#endif
#ifdef LIE_TORQUE_NAN
  to->peak_torque = NAN;
#endif
#ifdef LIE_TORQUE_NEGATIVE
  to->freedoms_in = to->freedoms_out = 6;
  to->peak_torque = -0.1;
#endif
#ifdef LIE_TURN_NAN
  to->max_angular_stiffness = NAN;
#endif
#ifdef LIE_FRAME
  to->frame[0] = to->frame[5] = to->frame[10] = 2;
#endif
#ifdef LIE_WORKSPACE
  to->workspace_min[0] = 1;
  to->workspace_max[0] = -1;
#endif
#ifdef LIE_TEXT /* without its end */
  memset(to->model, 'x', sizeof to->model);
#endif
  return MVS_DRIVER_OK;
}

static int32_t start(mvs_driver_device *device) {
  (void)device;
  return MVS_DRIVER_OK;
}

static int32_t read_state(mvs_driver_device *device, uint64_t now_ns, mvs_driver_state *state) {
#ifdef LIE_LOOP_HANGS
  if (device->sequence > 10) pause();
#endif
#ifdef LIE_READ_FAILS
  if (device->sequence >= AT) return MVS_DRIVER_E_FAULT;
#endif
  state->flags = MVS_DRIVER_FLAG_CALIBRATED;
  state->time_ns = now_ns;
  state->sequence = ++device->sequence;
  state->orientation[0] = 1;
#ifdef LIE_NAN_POSITION
  state->position[1] = NAN;
#endif
#ifdef LIE_INF_VELOCITY
  state->flags |= MVS_DRIVER_FLAG_VELOCITY;
  state->velocity[2] = INFINITY;
#endif
#ifdef LIE_NO_QUATERNION
  state->orientation[0] = 0;
#endif
#ifdef LIE_LONG_QUATERNION
  state->orientation[1] = 1;
#endif
#ifdef LIE_MILLIMETRES
  state->position[0] = 30;
#endif
#ifdef LIE_NO_SEQUENCE
  state->sequence = 7;
#endif
#ifdef LIE_NO_TIME
  state->time_ns = 7;
#endif
#ifdef LIE_TIME_STOPS /* the position goes on */
  static uint64_t stopped_ns;
  if (device->sequence <= AT) stopped_ns = now_ns;
  state->time_ns = stopped_ns;
  state->position[2] = 1e-6 * (double)(device->sequence % 1000);
#endif
#ifdef LIE_FAR
  state->position[0] = 2;
#endif
#ifdef LIE_FAR_ONCE
  if (device->sequence == AT) state->position[0] = 5;
#endif
#ifdef LIE_CLOCK_BACK
  state->time_ns = UINT64_MAX - now_ns;
#endif
#ifdef LIE_GARBAGE
  memset(state, 0xff, sizeof *state);
#endif
  return MVS_DRIVER_OK;
}

static int32_t write_force(mvs_driver_device *device, const mvs_driver_force *force) {
  note(force, 0, 0);
#ifdef LIE_WRITE_FAILS
  if (device->sequence >= AT) return MVS_DRIVER_E_FAULT;
#endif
  (void)device;
  return MVS_DRIVER_OK;
}

static int32_t run(mvs_driver_device *device, mvs_driver_servo servo, void *user) {
#ifdef LIE_LOOP_FAILS
  mvs_driver_force force = {0};
  mvs_driver_state state = {0};
  state.struct_size = sizeof state;
  force.struct_size = sizeof force;
  for (uint64_t k = 0; k < AT / 4; ++k) {
    if (read_state(device, 1000000 * k, &state) < 0) break;
    if (servo(user, &state, &force) == MVS_DRIVER_STOP) return MVS_DRIVER_OK;
    usleep(1000);
  }
  return MVS_DRIVER_E_LOST;
#endif
  (void)device;
  (void)servo;
  (void)user;
  return MVS_DRIVER_OK; /* at once, without having been asked to stop */
}

static int32_t stop(mvs_driver_device *device) {
  (void)device;
  note(NULL, 1, 0);
  return MVS_DRIVER_OK;
}

#ifdef LIE_LOOP_HANGS
static void panic(mvs_driver_device *device) {
  (void)device;
  note(NULL, 0, 1);
}
#endif

#ifdef LIE_PANICS /* no defect: reports on file 9 that panic was called */
static void panic(mvs_driver_device *device) {
  if (write(9, device == &the_one ? "zero" : "what", 4) != 4) _exit(1);
}
#endif

static void close_device(mvs_driver_device *device) {
  (void)device;
#ifdef LIE_LOOP_HANGS
  abort(); /* its loop still uses the device */
#endif
#ifdef LIE_CLOSES_LATE /* a second after libmvs has given up */
  sleep(11);
  kept_host->log(kept_host->host, "a late sentence of close()");
#endif
}

static const char *error(const mvs_driver_device *device) {
  (void)device;
#ifdef LIE_REFUSES
  return NULL;
#else
  return "a sentence";
#endif
}

#ifdef LIE_NO_SYMBOL
int32_t mvs_driver_negotiat(const mvs_driver_host *host, mvs_driver_api *api);
int32_t mvs_driver_negotiat(const mvs_driver_host *host, mvs_driver_api *api)
#else
int32_t mvs_driver_negotiate(const mvs_driver_host *host, mvs_driver_api *api)
#endif
{
  (void)host;
  mvs_driver_api ours = {0};
  ours.struct_size = sizeof ours;
  ours.version = MVS_DRIVER_VERSION;
  ours.name = "liar";
  ours.open = open_device;
  ours.info = info;
  ours.start = start;
  ours.read = read_state;
  ours.write = write_force;
  ours.stop = stop;
  ours.close = close_device;
  ours.error = error;
#if defined LIE_PANICS || defined LIE_LOOP_HANGS
  ours.panic = panic;
#endif
#ifdef LIE_OLD
  return MVS_DRIVER_E_VERSION;
#endif
#ifdef LIE_VERSION
  ours.version = 99;
#endif
#ifdef LIE_SIZE
  ours.struct_size = 8;
#endif
#ifdef LIE_NO_CLOSE
  ours.close = NULL;
#endif
#ifdef LIE_NO_WRITE
  ours.write = NULL;
#endif
#if defined LIE_LEAVES || defined LIE_LOOP_FAILS
  ours.run = run;
#else
  (void)run;
#endif
  memcpy(api, &ours, sizeof ours);
#ifdef LIE_OVERRUNS
  memset((char *)api + sizeof ours, 0, 16);
#endif
  return MVS_DRIVER_OK;
}
