// Driver that plays a recorded trajectory in place of a device.
#include <mvs/driver.h>

#include <atomic>

#include "common/interface.h"
#include "settings.h"

using driver::give;
using driver::guarded;
using driver::take;
using replay::End;

struct mvs_driver_device {
  explicit mvs_driver_device(replay::Settings wanted)
      : settings(std::move(wanted)), over(settings.file + " is over: option end=stay or end=loop") {
    sample = settings.recording.at(0);
    sample.velocity = {};
  }

  const replay::Settings settings;
  const std::string over;
  const char *sentence = "";
  std::atomic<bool> playing{false}, motors{false};  // stop() is called from any thread
  bool begun = false;                               // a sample was read since start()
  bool saturated = false;
  uint64_t begin_ns = 0, now_ns = 0, sequence = 0;
  driver::Pose sample;
};

namespace {

const char *const kOptions[] = {
    "file: the recording (format: haptic_drivers/replay/README.md of the sources)",
    "end: after the last sample stay (default) there, loop, or stop: the device is at its end",
    "speed: of the hand's motion, 1 as recorded",
    "device: the name of the replayed device",
    "force: its peak force, N; 0: it has no motors",
    "continuous_force: N, its sustained force",
    "stiffness: its largest stable stiffness, N/m",
    "damping: likewise, N s/m",
    "rate: of its servo, Hz; 1000 if neither option nor file says",
    nullptr};

int32_t list(const mvs_driver_host *host, mvs_driver_found found, void *user) {
  return guarded([&] {
    if (!driver::Options(host).given("file")) return;
    const replay::Settings settings = replay::settings(host, nullptr);
    found(user, settings.file.c_str(), settings.info.model);
  });
}

// Returns whether the hand would jump when the recording repeats.
bool jumps_in_loop(const replay::Settings &settings) {
  const driver::Vector first = settings.recording.samples().front().pose.position;
  const driver::Vector last = settings.recording.samples().back().pose.position;
  double square = 0;
  for (int k = 0; k < 3; ++k) square += (last[k] - first[k]) * (last[k] - first[k]);
  return settings.end == End::kLoop && square > 1e-6;  // a millimetre
}

int32_t doctor(const mvs_driver_host *host, mvs_driver_finding finding, void *user) {
  if (!driver::Options(host).given("file")) {
    finding(user, -1, "recording", "no file was named: give the option file=RECORDING");
    return MVS_DRIVER_OK;
  }
  const int32_t code = guarded([&] {
    const replay::Settings settings = replay::settings(host, nullptr);
    const std::size_t samples = settings.recording.samples().size();
    const long ms = std::lround(1000 * settings.recording.duration());
    finding(
        user, 1, "recording",
        (settings.file + ": " + std::to_string(samples) + " samples, " + std::to_string(ms) + " ms")
            .c_str());
    if (jumps_in_loop(settings))
      finding(user, -1, "loop",
              "it does not end where it begins: the hand jumps, and libmvs may take forces off");
  });
  if (code != MVS_DRIVER_OK) finding(user, 0, "recording", driver::last_sentence);
  return MVS_DRIVER_OK;
}

int32_t open(const mvs_driver_host *host, const char *name, mvs_driver_device **device) {
  return guarded([&] { *device = new mvs_driver_device(replay::settings(host, name)); });
}

int32_t info(mvs_driver_device *device, mvs_driver_info *info) {
  give(device->settings.info, info);
  return MVS_DRIVER_OK;
}

int32_t start(mvs_driver_device *device) {
  device->begun = false;
  device->motors = false;
  device->playing = true;
  return MVS_DRIVER_OK;
}

mvs_driver_state state_of(const mvs_driver_device &device) {
  mvs_driver_state state = {};
  state.flags = MVS_DRIVER_FLAG_CALIBRATED | MVS_DRIVER_FLAG_VELOCITY;
  if (device.motors) state.flags |= MVS_DRIVER_FLAG_FORCE_ON;
  if (device.saturated) state.flags |= MVS_DRIVER_FLAG_SATURATED;
  state.time_ns = device.now_ns;
  state.sequence = device.sequence;
  for (int k = 0; k < 3; ++k) state.position[k] = device.sample.position[k];
  for (int k = 0; k < 4; ++k) state.orientation[k] = device.sample.orientation[k];
  for (int k = 0; k < 3; ++k) state.velocity[k] = device.sample.velocity[k];
  state.gripper = device.sample.gripper;
  state.buttons = device.sample.buttons;
  return state;
}

// Sets the pose at `now_ns`; returns false after the end of a recording with end=stop.
bool play(mvs_driver_device &device, uint64_t now_ns) {
  if (!device.begun) device.begin_ns = now_ns;
  device.begun = true;
  const replay::Settings &settings = device.settings;
  const double length = settings.recording.duration();
  double time = static_cast<double>(now_ns - device.begin_ns) * 1e-9 * settings.speed;
  if (settings.end == End::kStop && time > length) return false;
  if (settings.end == End::kLoop) time = std::fmod(time, length);
  device.sample = settings.recording.at(time);
  for (double &v : device.sample.velocity) v *= settings.speed;
  return true;
}

int32_t read(mvs_driver_device *device, uint64_t now_ns, mvs_driver_state *state) {
  const bool news = device->sequence == 0 || now_ns > device->now_ns;
  if (news) {
    device->now_ns = now_ns;
    ++device->sequence;
  }
  if (!device->playing)
    device->sample.velocity = {};  // stopped: the hand is at rest
  else if (news && !play(*device, now_ns)) {
    device->sentence = device->over.c_str();
    return MVS_DRIVER_E_END;
  }
  give(state_of(*device), state);
  return MVS_DRIVER_OK;
}

// Forces have no effect; the state reports them in its flags.
int32_t write(mvs_driver_device *device, const mvs_driver_force *force) {
  const mvs_driver_force wanted = take(force);
  const double *f = wanted.force;
  const double peak = device->settings.info.peak_force;
  const double square = f[0] * f[0] + f[1] * f[1] + f[2] * f[2];
  if (!std::isfinite(square)) {
    device->motors = false;
    device->sentence = "the force that was written is not finite";
    return MVS_DRIVER_E_FAULT;
  }
  device->motors = device->playing && wanted.on;
  device->saturated = wanted.on && peak > 0 && square > peak * peak * (1 + 1e-9);
  return MVS_DRIVER_OK;
}

int32_t stop(mvs_driver_device *device) {
  device->playing = false;
  device->motors = false;
  return MVS_DRIVER_OK;
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
    "replay",
    "plays a recorded trajectory; no device is needed",
    kOptions,
    list,
    doctor,
    open,
    info,
    nullptr,  // nothing to calibrate
    start,
    read,
    write,
    nullptr,  // polled
    stop,
    nullptr,  // no motors, no panic
    close,
    error,
};

}  // namespace

int32_t mvs_driver_negotiate(const mvs_driver_host *host, mvs_driver_api *api) {
  return driver::negotiate(host, api, kDriver);
}
