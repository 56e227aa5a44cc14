// Driver of a simulated hand that holds a simulated device, for closed-loop tests without hardware.
#include <mvs/driver.h>

#include <time.h>

#include <atomic>

#include "body.h"
#include "common/interface.h"
#include "common/rotation.h"
#include "motors.h"
#include "wrist.h"

using driver::give;
using driver::guarded;
using driver::take;
using driver::Vector;
using hand::Fault;

struct mvs_driver_device {
  explicit mvs_driver_device(hand::Settings wanted)
      : settings(std::move(wanted)),
        body(settings.oscillator, settings.script, settings.from),
        wrist(settings.rotation),
        motors(settings.device.force, settings.device.delay),
        twisters(settings.device.torque, settings.device.delay) {}

  const hand::Settings settings;
  hand::Body body;
  hand::Wrist wrist;
  hand::Motors motors, twisters;     // of force, of torque
  std::atomic<bool> running{false};  // stop() is called from any thread
  bool on = false;                   // of the last force written
  bool seen = false, begun = false;  // a sample was read: ever, since start()
  uint64_t now_ns = 0, begin_ns = 0;
  mvs_driver_state last = {};
  const char *sentence = "";
};

namespace {

const char *const kOptions[] = {
    ("device: what it holds: ideal, touch (default), omni, desktop, premium15, premium30, omega, "
     "delta, lambda, falcon, premium6 or sigma; the last two have motors for torque"),
    "mass: of the hand, kg",
    "arm_stiffness: N/m, of the spring by which the arm leads it",
    "arm_damping: N s/m, beside that spring",
    "target: x,y,z in m, where the arm leads it",
    "amplitude: x,y,z in m, of a sine about the target",
    "frequency: Hz, of that sine",
    "inertia: of the hand, kg m2",
    "wrist_stiffness: N m/rad, of the spring by which the wrist holds its orientation",
    "wrist_damping: N m s/rad, beside that spring",
    "turned: x,y,z in rad, the rotation vector with which the hand begins",
    "turn_amplitude: x,y,z in rad, of a sine of the wrist at `frequency`",
    "file: a recording, as for the driver replay, that leads the arm instead",
    "from: x,y,z in m, where the hand begins, if not at the target",
    "push: x,y,z in N, a constant force on the hand",
    "buttons: held for ever, a sum of 1, 2, 4, ...",
    "velocity: 1: the device measures velocity; 0 (default): libmvs has to estimate it",
    "force: the device's peak force, N, and so on: in place of its own",
    "continuous_force: N",
    "stiffness: N/m, the largest that is stable",
    "damping: N s/m, likewise",
    "rate: Hz",
    "resolution: m, a step of its encoder",
    "torque: N m, the device's peak torque",
    "angular_stiffness: N m/rad, the largest that is stable",
    "angular_damping: N m s/rad, likewise",
    "turn_resolution: rad, a step of its encoder of orientation",
    "device_inertia: kg m2, turned along with the hand",
    "device_mass: kg, moved along with the hand",
    "device_damping: N s/m, likewise",
    "delay: samples, from the writing of a force to its effect",
    ("fault: nan_position, inf_velocity, jump, unplug, silent, stuck_button, bounce, uncalibrated, "
     "hot, saturated, deadman, clock_back, clock_jump, slow, button, absent or licence"),
    "fault_at: s after start",
    "fault_for: s; 0 (default): for ever",
    nullptr};

int32_t list(const mvs_driver_host *host, mvs_driver_found found, void *user) {
  return guarded([&] {
    const hand::Settings settings = hand::settings(host);
    if (settings.faults.kind != Fault::kAbsent) found(user, "hand", settings.device.model);
  });
}

int32_t doctor(const mvs_driver_host *host, mvs_driver_finding finding, void *user) {
  const int32_t code = guarded([&] {
    const hand::Settings settings = hand::settings(host);
    finding(user, 1, "options",
            (std::string("a hand that holds a ") + settings.device.model).c_str());
    if (settings.faults.kind != Fault::kNone)
      finding(user, -1, "fault", "a fault was asked for: this is a test");
  });
  if (code != MVS_DRIVER_OK) finding(user, 0, "options", driver::last_sentence);
  return MVS_DRIVER_OK;
}

int32_t open(const mvs_driver_host *host, const char *name, mvs_driver_device **device) {
  return guarded([&] {
    hand::Settings settings = hand::settings(host);
    if (name && std::strcmp(name, "hand") != 0)
      driver::refuse(MVS_DRIVER_E_ABSENT, std::string("there is no \"") + name + "\": try hand");
    if (settings.faults.kind == Fault::kAbsent)
      driver::refuse(MVS_DRIVER_E_ABSENT, "no device is connected (option fault=absent)");
    if (settings.faults.kind == Fault::kLicence)
      driver::refuse(MVS_DRIVER_E_LICENCE, "there is no licence (option fault=licence)");
    *device = new mvs_driver_device(std::move(settings));
  });
}

int32_t info(mvs_driver_device *device, mvs_driver_info *out) {
  const hand::Device &held = device->settings.device;
  mvs_driver_info info = {};
  info.freedoms_in = held.freedoms_in;
  info.freedoms_out = held.freedoms_out();
  info.buttons = 2;
  info.has_deadman = device->settings.faults.kind == Fault::kDeadman;
  for (int k = 0; k < 3; ++k) {
    info.workspace_min[k] = -held.reach;
    info.workspace_max[k] = held.reach;
  }
  info.peak_force = held.force;
  info.continuous_force = held.continuous_force;
  info.max_stiffness = held.stiffness;
  info.max_damping = held.damping;
  info.peak_torque = held.torque;
  info.max_angular_stiffness = held.angular_stiffness;
  info.max_angular_damping = held.angular_damping;
  info.rate = held.rate;
  std::snprintf(info.model, sizeof info.model, "%s (simulated)", held.model);
  give(info, out);
  return MVS_DRIVER_OK;
}

int32_t calibrate(mvs_driver_device *device) {
  if (!device->settings.faults.now(Fault::kUncalibrated, 0)) return MVS_DRIVER_OK;
  device->sentence = "put the stylus into its holder (option fault=uncalibrated)";
  return MVS_DRIVER_E_CALIBRATION;
}

int32_t start(mvs_driver_device *device) {
  device->begun = false;
  device->on = false;
  device->motors.off();
  device->twisters.off();
  device->running = true;
  return MVS_DRIVER_OK;
}

// Seconds since the first sample after start(); negative before.
double script_time(const mvs_driver_device &device) {
  return device.begun ? static_cast<double>(device.now_ns - device.begin_ns) * 1e-9 : -1;
}

// Advances the hand to `now_ns` and stores its state.
void sample(mvs_driver_device &device, uint64_t now_ns) {
  const double before = script_time(device);
  const double length = device.seen ? static_cast<double>(now_ns - device.now_ns) * 1e-9 : 0;
  const bool felt = device.running && !device.settings.faults.limp(before);
  Vector force = device.settings.push;
  for (int k = 0; k < 3; ++k) force[k] += felt ? device.motors.force()[k] : 0;
  const double begin = before < 0 ? -length : before;
  device.body.move(begin, length, force);
  if (device.settings.device.freedoms_in == 6)
    device.wrist.move(begin, length, felt ? device.twisters.force() : Vector{});
  device.motors.sampled();
  device.twisters.sampled();
  device.now_ns = now_ns;
  if (device.running && !device.begun) device.begin_ns = now_ns;
  device.begun = device.begun || device.running;
  device.seen = true;
}

// Rounds a position to the resolution of the encoder.
double encoded(double position, double resolution) {
  return resolution > 0 ? resolution * std::round(position / resolution) : position;
}

mvs_driver_state state_of(const mvs_driver_device &device) {
  const hand::Settings &settings = device.settings;
  mvs_driver_state state = {};
  state.flags = MVS_DRIVER_FLAG_CALIBRATED;
  if (settings.measures_velocity) state.flags |= MVS_DRIVER_FLAG_VELOCITY;
  if (settings.faults.kind == Fault::kDeadman) state.flags |= MVS_DRIVER_FLAG_HELD;
  const bool on = device.running && device.on && !settings.faults.limp(script_time(device));
  if (on) state.flags |= MVS_DRIVER_FLAG_FORCE_ON;
  if (on && (device.motors.saturated() || device.twisters.saturated()))
    state.flags |= MVS_DRIVER_FLAG_SATURATED;
  state.time_ns = device.now_ns;
  state.sequence = device.last.sequence + 1;
  for (int k = 0; k < 3; ++k)
    state.position[k] = encoded(device.body.position()[k], settings.device.resolution);
  for (int k = 0; k < 3 && settings.measures_velocity; ++k)
    state.velocity[k] = device.body.velocity()[k];
  const hand::Quaternion turned = device.wrist.encoded(settings.device.turn_resolution);
  std::copy(turned.begin(), turned.end(), state.orientation);
  state.buttons = settings.buttons;
  if (!settings.script.recording) return state;
  const driver::Pose pose = settings.script.recording->at(script_time(device));
  for (int k = 0; k < 4; ++k) state.orientation[k] = pose.orientation[k];
  state.buttons |= pose.buttons;
  return state;
}

// Fault returned by read() and write(); most other faults are in the state.
int32_t unplugged(mvs_driver_device *device) {
  device->sentence = "the device was unplugged (option fault=unplug)";
  return MVS_DRIVER_E_LOST;
}

int32_t read(mvs_driver_device *device, uint64_t now_ns, mvs_driver_state *state) {
  const hand::Faults &faults = device->settings.faults;
  if (!device->seen || now_ns > device->now_ns) {
    sample(*device, now_ns);
    mvs_driver_state now = state_of(*device);
    hand::spoil(faults, script_time(*device), device->last, now);
    device->last = now;
  }
  if (faults.now(Fault::kUnplug, script_time(*device))) return unplugged(device);
  if (faults.now(Fault::kSlow, script_time(*device))) {
    const timespec longer_than_patience = {0, 150000000};
    nanosleep(&longer_than_patience, nullptr);
  }
  give(device->last, state);
  return MVS_DRIVER_OK;
}

int32_t write(mvs_driver_device *device, const mvs_driver_force *force) {
  if (device->settings.faults.now(Fault::kUnplug, script_time(*device))) return unplugged(device);
  const mvs_driver_force wanted = take(force);
  device->on = wanted.on && device->running;
  Vector newtons = {}, torque = {};
  for (int k = 0; k < 3 && device->on; ++k) {
    newtons[k] = wanted.force[k];
    torque[k] = wanted.torque[k];
  }
  if (!driver::is_finite(wanted)) {
    device->on = false;
    device->motors.off();
    device->twisters.off();
    device->sentence = "the force that was written is not finite";
    return MVS_DRIVER_E_FAULT;
  }
  device->motors.write(newtons);
  if (device->settings.device.torque > 0) device->twisters.write(torque);
  return MVS_DRIVER_OK;
}

int32_t stop(mvs_driver_device *device) {
  device->running = false;
  return MVS_DRIVER_OK;
}

void panic(mvs_driver_device *device) {
  device->running = false;
}

void close(mvs_driver_device *device) {
  delete device;
}

const char *error(const mvs_driver_device *device) {
  return device ? device->sentence : driver::last_sentence;
}

constexpr mvs_driver_api kDriver = {
    sizeof(mvs_driver_api),
    MVS_DRIVER_VERSION,
    "hand",
    "a simulated hand that holds a simulated device; no device is needed",
    kOptions,
    list,
    doctor,
    open,
    info,
    calibrate,
    start,
    read,
    write,
    nullptr,  // polled
    stop,
    panic,
    close,
    error,
};

}  // namespace

int32_t mvs_driver_negotiate(const mvs_driver_host *host, mvs_driver_api *api) {
  return driver::negotiate(host, api, kDriver);
}
