// Opening, starting, stopping.
#include "haptics/device.h"

#include <chrono>
#include <cmath>
#include <thread>

#include "base/error.h"
#include "haptics/device_core.h"
#include "haptics/signal_handler.h"

namespace mvs::core {
namespace {

constexpr auto patience = std::chrono::seconds(2);         // with a thread that is to end
constexpr double silence = 1e-3 * MVS_DRIVER_PATIENCE_MS;  // s, of a clock that does not tick

const char *sentence_of(uint32_t cause) {
  switch (cause) {
    case MVS_CAUSE_BUTTON:
      return "its own switch has forces off: switch them on at the device";
    case MVS_CAUSE_VELOCITY:
      return "it moves too fast: hold it still";
    case MVS_CAUSE_WATCHDOG:
      return "it does not answer in time: look at its cable and at what else this computer does";
    case MVS_CAUSE_DEADMAN:
      return "nobody holds it: take it into the hand";
    case MVS_CAUSE_NOT_FINITE:
      return "it tells places that are no numbers: restart it";
    case MVS_CAUSE_THERMAL:
      return "its motors are too warm, or it is broken: let it cool";
    case MVS_CAUSE_CALIBRATION:
      return "it is not calibrated: mvs haptics doctor says how";
    default:
      return "it is gone: close it, plug it in, open it again";
  }
}

}  // namespace

Device::Device(const mvs_device_desc &desc, DriverPlugin::Log log)
    : core_(std::make_shared<Core>()) {
  core_->plug = DriverPlugin::load(desc.driver, desc.options ? desc.options : "", std::move(log));
  core_->clock = desc.clock;
  const std::string name = desc.device ? desc.device : "";
  const auto &core = core_;
  DriverPlugin &plug = *core_->plug;
  MVS_MUST(desc.clock == MVS_CLOCK_REAL || plug.api().read, MVS_E_UNSUPPORTED, plug.name(),
           "the driver %s has a clock of its own: it cannot be turned by hand",
           plug.name().c_str());
  plug.call("open", nullptr, [core, name](const mvs_driver_api &api) {
    return api.open(core->plug->host(), name.empty() ? nullptr : name.c_str(), &core->handle);
  });
  MVS_MUST(core_->handle, MVS_E_DEVICE, plug.name(),
           "the driver %s opened a device and gives none: do not use it", plug.name().c_str());
  const auto told = std::make_shared<mvs_driver_info>();
  told->struct_size = sizeof(mvs_driver_info);
  try {
    plug.call("info", core_->handle, [core, told](const mvs_driver_api &api) {
      return api.info(core->handle, told.get());
    });
    core_->traits = read_traits(*told, plug.name().c_str());
    if (desc.rate > 0) core_->traits.info.rate = desc.rate;
    core_->traits.info.clock = desc.clock;
    limits_ = resolve_limits({}, core_->traits.info);
  } catch (...) {
    core_->close();
    throw;
  }
  core_->links = std::make_unique<ServoLinks>();
  core_->servo = std::make_unique<Servo>(core_->traits, limits_, *core_->links);
}

// A thread that hangs in the driver still uses the device, and owns what it needs.
Device::~Device() {
  try {
    stop();
  } catch (const Error &) {
  }
  if (!core_->is_running()) core_->close();
}

mvs_device_info Device::info() const {
  mvs_device_info info = core_->traits.info;
  info.realtime = core_->realtime;
  return info;
}

void Device::set_limits(const mvs_device_limits &given) {
  limits_ = resolve_limits(given, core_->traits.info);
  core_->links->limits.post(limits_);
}

ServoLinks &Device::links() {
  return *core_->links;
}

void Device::start() {
  MVS_MUST(!started_, MVS_E_STATE, core_->plug->name(), "the device is started already");
  MVS_MUST(!core_->is_running(), MVS_E_DEVICE, core_->plug->name(),
           "%s: its driver has not come back from its loop: unplug the device, and start anew",
           core_->plug->name().c_str());
  const auto &core = core_;
  DriverPlugin &plug = *core_->plug;
  if (plug.api().calibrate) {
    plug.call("calibrate", core_->handle,
              [core](const mvs_driver_api &api) { return api.calibrate(core->handle); });
  }
  plug.call("start", core_->handle,
            [core](const mvs_driver_api &api) { return api.start(core->handle); });
  core_->servo->start();
  core_->stopping = false;
  core_->lost.clear();
  core_->now_ns = 0;
  core_->due = 0;
  guard_from_crashes(plug.api(), core_->handle);
  if (core_->clock == MVS_CLOCK_REAL) start_thread();
  started_ = true;
}

void Device::start_thread() {
  core_->running = true;
  core_->last_tick_ns = static_cast<int64_t>(clock_ns());
  std::thread([core = core_] { core->serve(); }).detach();
}

void Device::stop() {
  if (!started_) return;
  started_ = false;
  core_->stopping = true;
  DriverPlugin &plug = *core_->plug;
  plug.ask("stop", core_->handle,
           [core = core_](const mvs_driver_api &api) { return api.stop(core->handle); });
  forget_from_crashes(core_->handle);
  std::unique_lock<std::mutex> lock(core_->mutex);
  const bool ended = core_->ended.wait_for(lock, patience, [&] { return !core_->running; });
  MVS_MUST(ended, MVS_E_DEVICE, plug.name(),
           "%s: its driver does not come back from its loop: unplug the device, and start anew",
           plug.name().c_str());
}

void Device::must_be_started(const char *call) const {
  MVS_MUST(started_, MVS_E_STATE, core_->plug->name(), "%s: start the device first", call);
}

void Device::arm() {
  must_be_started("arm");
  const ServoStatus now = status();
  {
    const std::lock_guard<std::mutex> lock(core_->mutex);
    MVS_MUST(core_->lost.empty(), MVS_E_DEVICE, core_->plug->name(),
             "%s is lost (%s): close it, and open it again", core_->plug->name().c_str(),
             core_->lost.c_str());
  }
  MVS_MUST(now.device_cause == MVS_CAUSE_NONE, MVS_E_DEVICE, core_->plug->name(),
           "%s cannot be armed: %s", core_->plug->name().c_str(), sentence_of(now.device_cause));
  core_->links->requests.arm();
}

void Device::cut() {
  core_->links->requests.cut(MVS_CAUSE_SOFTWARE);
}

void Device::advance(double seconds) {
  must_be_started("advance");
  MVS_MUST(core_->clock == MVS_CLOCK_VIRTUAL, MVS_E_STATE, core_->plug->name(),
           "advance: this device has a real clock; open it with MVS_CLOCK_VIRTUAL");
  MVS_MUST(seconds >= 0 && seconds <= 3600, MVS_E_ARGUMENT, "seconds",
           "seconds is %g: it has to be 0 to 3600", seconds);
  const double period = 1 / core_->traits.info.rate;
  // a tick that is due but for rounding is due
  core_->due += seconds;
  while (core_->due > (1 - 1e-6) * period) {
    core_->due -= period;
    if (!core_->lost.empty()) continue;
    core_->now_ns += static_cast<uint64_t>(std::llround(1e9 * period));
    core_->poll(core_->now_ns);
  }
}

ServoStatus Device::status() {
  const std::lock_guard<std::mutex> lock(reading_);
  core_->links->status.refresh();
  ServoStatus now = core_->links->status.get();
  if (!started_) now.phase = MVS_DEVICE_PHASE_STOPPED;
  if (!started_ || core_->clock == MVS_CLOCK_VIRTUAL) return now;
  const double quiet =
      1e-9 * static_cast<double>(static_cast<int64_t>(clock_ns()) - core_->last_tick_ns.load());
  if (quiet > silence && now.device_cause == MVS_CAUSE_NONE) {
    core_->links->requests.cut(MVS_CAUSE_WATCHDOG);
    now.phase = MVS_DEVICE_PHASE_LATCHED;
    now.cause = now.device_cause = MVS_CAUSE_WATCHDOG;
  }
  return now;
}

}  // namespace mvs::core
