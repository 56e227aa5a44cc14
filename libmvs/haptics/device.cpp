// Open, start, stop and arm a device; advance its virtual clock.
#include "haptics/device.h"

#include <chrono>
#include <cmath>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "base/own_faults_only.h"
#include "haptics/device_core.h"
#include "haptics/signal_handler.h"

namespace mvs::core {
namespace {

constexpr auto stop_timeout = std::chrono::seconds(2);          // for the servo thread to end
constexpr double tick_timeout = 1e-3 * MVS_DRIVER_PATIENCE_MS;  // s, without a tick

const char *sentence_of(Cause cause) {
  switch (cause) {
    case Cause::button:
      return "its own switch has forces off: switch them on at the device";
    case Cause::velocity:
      return "it moves too fast: hold it still";
    case Cause::watchdog:
      return "it does not answer in time, or its clock stands still: look at its cable and at what "
             "else this computer does";
    case Cause::deadman:
      return "its grip is not held: take it into the hand";
    case Cause::not_finite:
      return "it reports impossible samples (mvs_device_state.sample_faults): restart it";
    case Cause::thermal:
      return "its motors are too warm, or it is broken: let it cool";
    case Cause::calibration:
      return "it is not calibrated, or reports a place out of reach: mvs_device_doctor has "
             "instructions";
    default:
      return "it is disconnected: close it, plug it in, open it again";
  }
}

}  // namespace

Device::Device(const mvs_device_desc &desc, DriverPlugin::Log log)
    : core_(std::make_shared<Core>()) {
  core_->plugin = DriverPlugin::load(desc.driver, desc.options ? desc.options : "", std::move(log));
  core_->clock = static_cast<DeviceClock>(desc.clock);
  const std::string name = desc.device ? desc.device : "";
  const auto &core = core_;
  DriverPlugin &plugin = *core_->plugin;
  MVS_MUST(core_->clock == DeviceClock::real || plugin.api().read, MVS_E_UNSUPPORTED, plugin.name(),
           "the driver %s has a clock of its own: open it with MVS_CLOCK_REAL",
           plugin.name().c_str());
  const auto info = std::make_shared<mvs_driver_info>();
  info->struct_size = sizeof(mvs_driver_info);
  try {
    core_->prepare_close();
    plugin.call("open", nullptr, [core, name](const mvs_driver_api &api) {
      return api.open(core->plugin->host(), name.empty() ? nullptr : name.c_str(), &core->handle);
    });
    MVS_MUST(core_->handle, MVS_E_DEVICE, plugin.name(),
             "the driver %s reports success of open and returns no device: do not use it",
             plugin.name().c_str());
    plugin.call("info", core_->handle, [core, info](const mvs_driver_api &api) {
      return api.info(core->handle, info.get());
    });
    core_->traits = read_traits(*info, plugin.name().c_str());
    if (desc.rate > 0) core_->traits.info.rate = desc.rate;
    core_->traits.info.clock = desc.clock;
    limits_ = resolve_limits({}, core_->traits.info);
    core_->links = std::make_unique<ServoLinks>();
    core_->servo = std::make_unique<Servo>(core_->traits, limits_, *core_->links);
  } catch (...) {
    if (core_->handle) core_->close();
    core_->close_call = {};
    if (core_->plugin) core_->plugin->silence();
    throw;
  }
}

// If the servo thread hangs in the driver it still uses the device: close() is then skipped, and
// the thread keeps its share of the core.
Device::~Device() {
  if (started_.exchange(false)) end_servo();
  if (!core_->is_running()) core_->close();
  core_->plugin->silence();
  core_->stop_call = core_->close_call = {};
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
  MVS_MUST(!started_, MVS_E_STATE, core_->plugin->name(), "the device is started already");
  MVS_MUST(!core_->is_running(), MVS_E_DEVICE, core_->plugin->name(),
           "%s: its driver has not come back from its loop: unplug the device, and start anew",
           core_->plugin->name().c_str());
  const auto &core = core_;
  DriverPlugin &plugin = *core_->plugin;
  if (plugin.api().calibrate) {
    plugin.call("calibrate", core_->handle,
                [core](const mvs_driver_api &api) { return api.calibrate(core->handle); });
  }
  core_->stop_call = plugin.prepare(
      core_->handle, [core](const mvs_driver_api &api) { return api.stop(core->handle); });
  plugin.call("start", core_->handle,
              [core](const mvs_driver_api &api) { return api.start(core->handle); });
  ButtonEvent old;  // the buttons of the time before are not those of now
  while (core_->links->buttons.pop(old)) {
  }
  core_->servo->start();
  core_->stopping = core_->panicked = false;
  *core_->lost = 0;
  core_->due = 0;
  try {
    register_device(plugin.api(), core_->handle);
    if (core_->clock == DeviceClock::real) start_thread();
  } catch (...) {
    core_->running = false;
    end_servo();
    throw;
  }
  started_ = true;
}

void Device::start_thread() {
  core_->running = true;
  core_->last_tick_ns = static_cast<int64_t>(clock_ns());
  try {
    const OwnFaultsOnly blocked;
    servo_thread_ = std::thread([core = core_] { core->serve(); });
  } catch (const std::system_error &error) {
    fail(MVS_E_MEMORY, core_->plugin->name(),
         "%s: the system starts no thread for its servo (%s): end other programs, and start anew",
         core_->plugin->name().c_str(), error.code().message().c_str());
  }
}

void Device::stop() {
  if (!started_) return;
  started_ = false;
  MVS_MUST(end_servo(), MVS_E_DEVICE, core_->plugin->name(),
           "%s: its driver does not come back from its loop: unplug the device, and start anew",
           core_->plugin->name().c_str());
}

// Joins the servo thread. Returns false if it does not end: it is then abandoned.
bool Device::end_servo() noexcept {
  core_->stopping = true;
  if (core_->clock == DeviceClock::virtual_time && !core_->is_lost()) core_->write_zero();
  core_->plugin->run(std::exchange(core_->stop_call, {}));
  unregister_device(core_->handle);
  if (!servo_thread_.joinable()) return true;
  std::unique_lock<std::mutex> lock(core_->mutex);
  if (core_->ended.wait_for(lock, stop_timeout, [&] { return !core_->running; })) {
    lock.unlock();
    servo_thread_.join();
    return true;
  }
  core_->plugin->keep_library();
  servo_thread_.detach();
  return false;
}

void Device::must_be_started(const char *call) const {
  MVS_MUST(started_, MVS_E_STATE, core_->plugin->name(), "%s: start the device first", call);
}

void Device::arm() {
  must_be_started("arm");
  const ServoStatus now = status();
  {
    const std::lock_guard<std::mutex> lock(core_->mutex);
    MVS_MUST(!core_->is_lost(), MVS_E_DEVICE, core_->plugin->name(),
             "%s is lost (%s): stop it and start it again, or close it and open it again",
             core_->plugin->name().c_str(), core_->lost);
  }
  MVS_MUST(!core_->panicked, MVS_E_DEVICE, core_->plugin->name(),
           "%s did not answer for %g s and was switched off: stop it, and start it again",
           core_->plugin->name().c_str(), tick_timeout);
  MVS_MUST(now.device_cause == Cause::nothing, MVS_E_DEVICE, core_->plugin->name(),
           "%s cannot be armed: %s", core_->plugin->name().c_str(), sentence_of(now.device_cause));
  core_->links->requests.arm();
}

void Device::cut() {
  core_->links->requests.cut(Cause::software);
}

void Device::advance(double seconds) {
  must_be_started("advance");
  MVS_MUST(core_->clock == DeviceClock::virtual_time, MVS_E_STATE, core_->plugin->name(),
           "advance: this device has a real clock; open it with MVS_CLOCK_VIRTUAL");
  MVS_MUST(seconds >= 0 && seconds <= 3600, MVS_E_ARGUMENT, "seconds",
           "seconds is %g: it has to be 0 to 3600", seconds);
  const double period = 1 / core_->traits.info.rate;
  // tolerance for rounding of the accumulated time
  core_->due += seconds;
  while (core_->due > (1 - 1e-6) * period) {
    core_->due -= period;
    if (core_->is_lost()) continue;
    core_->now_ns += static_cast<uint64_t>(std::llround(1e9 * period));
    core_->poll(core_->now_ns);
  }
}

ServoStatus Device::status() {
  const std::lock_guard<std::mutex> lock(reading_);
  core_->links->status.refresh();
  ServoStatus now = core_->links->status.get();
  if (!started_) now.phase = DevicePhase::stopped;
  if (!started_ || core_->clock == DeviceClock::virtual_time) return now;
  const double quiet =
      1e-9 * static_cast<double>(static_cast<int64_t>(clock_ns()) - core_->last_tick_ns.load());
  if (quiet > tick_timeout && now.device_cause == Cause::nothing) {
    core_->links->requests.cut(Cause::watchdog);
    // its thread does not come back to write a zero; drivers stay off after panic() until a start
    const auto panic = core_->plugin->api().panic;
    if (panic && !core_->panicked.exchange(true)) panic(core_->handle);
    now.phase = DevicePhase::latched;
    now.cause = now.device_cause = Cause::watchdog;
  }
  return now;
}

}  // namespace mvs::core
