// One tick of the vendor's scheduler: a sample to the servo, its force to the motors. No lock,
// allocation or wait.
#include <pthread.h>

#include <chrono>
#include <cmath>

#include "common/rotation.h"
#include "device.h"

namespace phantom {
namespace {

constexpr int kQuiet = 100, kQuietWhenWarm = 1000;  // ticks without force after a warning
constexpr int kStrangeAtMost = 10;
constexpr uint64_t kSlowly = 128;  // ticks between two reads of calibration and temperature
constexpr double kWarm = 0.9;      // share of the largest motor temperature

uint64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

// After a warning, for which the library switches its forces off, they stay off for a number of
// ticks, so that the force that caused it does not return at once.
void warn(Loop &loop, unsigned code) {
  loop.saturated = code == kExceededForce || code == kExceededImpulse;
  loop.quiet = code == kWarmMotors ? kQuietWhenWarm : kQuiet;
  loop.cause = code == kWarmMotors         ? MVS_CAUSE_THERMAL
               : code == kExceededVelocity ? MVS_CAUSE_VELOCITY
                                           : MVS_CAUSE_NONE;
}

void end(Loop &loop, int32_t result, unsigned code) {
  loop.result = result;
  loop.code = code;
}

// Classifies an error: returns false if it ends the loop; an unexpected error is stored in
// `strange`.
bool judge(Loop &loop, unsigned code, unsigned &strange) {
  if ((code & 0xF00) == kWarnings) {
    warn(loop, code);
    return true;
  }
  if ((code & 0xF00) == kDeviceErrors && code != kAlreadyInitiated) {
    end(loop, MVS_DRIVER_E_LOST, code);
    return false;
  }
  if (code == kInvalidLicence) {
    end(loop, MVS_DRIVER_E_LICENCE, code);
    return false;
  }
  strange = code;
  return true;
}

// Handles the errors on the stack, which all devices share, and errors posted by other devices.
bool handle_errors(mvs_driver_device &device) {
  Loop &loop = device.loop;
  unsigned strange = 0;
  for (int i = 0; i < 16; ++i) {
    const ErrorInfo error = hd().get_error();
    if (error.code == 0) break;
    Slot *const owner = slot_of(error.device);
    if (owner && owner != device.slot)
      owner->posted = error.code;
    else if (!judge(loop, error.code, strange))
      return false;
  }
  const unsigned posted = device.slot->posted.exchange(0);
  if (posted && !judge(loop, posted, strange)) return false;
  if (strange) {
    loop.quiet = loop.quiet > 1 ? loop.quiet : 1;
    if (++loop.strange > kStrangeAtMost) {
      end(loop, MVS_DRIVER_E_INTERNAL, strange);
      return false;
    }
  } else {
    loop.strange = 0;
  }
  return true;
}

void read_slowly(mvs_driver_device &device) {
  Loop &loop = device.loop;
  loop.calibrated = hd().check_calibration() == kCalibrated;
  if (!device.has_temperature) return;
  double temperature[6] = {};
  hd().get_doubles(kMotorTemperature, temperature);
  loop.warm = false;
  for (const double one : temperature) loop.warm |= one > kWarm;
}

uint32_t flags(const mvs_driver_device &device) {
  const Loop &loop = device.loop;
  unsigned char parked = 0;
  if (device.has_inkwell) hd().get_booleans(kInkwell, &parked);
  const bool on = loop.quiet == 0 && !loop.panicked && hd().is_enabled(kForceOutput);
  return (loop.calibrated ? MVS_DRIVER_FLAG_CALIBRATED : 0) |
         (device.has_velocity ? MVS_DRIVER_FLAG_VELOCITY : 0) |
         (on ? MVS_DRIVER_FLAG_FORCE_ON : 0) | (loop.saturated ? MVS_DRIVER_FLAG_SATURATED : 0) |
         (parked ? MVS_DRIVER_FLAG_PARKED : 0) |
         (loop.warm || loop.cause == MVS_CAUSE_THERMAL ? MVS_DRIVER_FLAG_WARM : 0);
}

void read(mvs_driver_device &device, mvs_driver_state &state) {
  double position[3] = {}, velocity[3] = {}, transform[16] = {};
  int buttons = 0;
  hd().get_doubles(kPosition, position);
  if (device.has_velocity) hd().get_doubles(kVelocity, velocity);
  hd().get_integers(kButtons, &buttons);
  for (int i = 0; i < 3; ++i) {
    state.position[i] = position[i] * kMillimetre;
    state.velocity[i] = velocity[i] * kMillimetre;
  }
  state.orientation[0] = 1;
  if (device.info.freedoms_in == 6) {
    hd().get_doubles(kTransform, transform);
    // the transform is stored by columns
    const double rotation[3][3] = {{transform[0], transform[4], transform[8]},
                                   {transform[1], transform[5], transform[9]},
                                   {transform[2], transform[6], transform[10]}};
    driver::quaternion(rotation, state.orientation);
  }
  state.struct_size = sizeof state;
  state.time_ns = now_ns();
  state.sequence = ++device.loop.sequence;
  state.buttons = uint32_t(buttons);
}

void write(mvs_driver_device &device, const mvs_driver_force &force) {
  const bool on =
      force.on && device.loop.quiet == 0 && !device.loop.panicked && driver::is_finite(force);
  double newtons[3] = {}, millinewtonmetres[3] = {};
  for (int i = 0; on && i < 3; ++i) {
    newtons[i] = force.force[i];
    millinewtonmetres[i] = force.torque[i] / 1e-3;
  }
  hd().set_doubles(kForce, newtons);
  if (device.info.freedoms_out == 6) hd().set_doubles(kTorque, millinewtonmetres);
}

// Calls the servo, unless run() gave up this loop meanwhile.
bool ask(Loop &loop, const mvs_driver_state &state, mvs_driver_force &force) {
  int expected = kWithLibrary;
  if (!loop.phase.compare_exchange_strong(expected, kInServo)) return false;
  loop.servo_thread = (unsigned long)pthread_self();
  const int32_t answer = loop.servo(loop.user, &state, &force);
  loop.servo_thread = 0;
  loop.phase = kWithLibrary;
  return answer == MVS_DRIVER_OK;
}

// The part between hdBeginFrame and hdEndFrame; returns false on the last tick.
bool inside_frame(mvs_driver_device &device) {
  Loop &loop = device.loop;
  mvs_driver_state state = {};
  mvs_driver_force force = {};
  force.struct_size = sizeof force;
  if (loop.sequence % kSlowly == 0) read_slowly(device);
  read(device, state);
  bool more = handle_errors(device) && !device.quit;
  if (more) {
    state.flags = flags(device);
    state.cause = loop.cause;
    more = ask(loop, state, force);
  }
  loop.saturated = false;
  write(device, force);
  if (loop.quiet > 0 && --loop.quiet == 0) loop.cause = MVS_CAUSE_NONE;
  return more;
}

bool frame(mvs_driver_device &device) {
  hd().make_current(device.handle);
  if (!device.loop.enabled) hd().enable(kForceOutput);
  device.loop.enabled = true;
  hd().begin_frame(device.handle);
  hd().make_current(device.handle);
  bool more = inside_frame(device);
  hd().end_frame(device.handle);
  if (more) more = handle_errors(device);
  if (!more) hd().disable(kForceOutput);
  return more;
}

}  // namespace

unsigned MVS_HDAPI tick(void *user) {
  auto &device = *static_cast<mvs_driver_device *>(user);
  if (device.loop.ended) return kCallbackDone;
  const bool more = frame(device);
  device.loop.ticks.fetch_add(1);
  if (more) return kCallbackContinue;
  device.loop.ended = true;
  return kCallbackDone;
}

}  // namespace phantom
