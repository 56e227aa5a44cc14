// Open, describe, calibrate, start and close a device.
#include "device.h"

#include <chrono>
#include <cstring>
#include <memory>
#include <thread>
#include <vector>

#include "common/interface.h"
#include "common/locale.h"
#include "words.h"

namespace phantom {
namespace {

// hdInitDevice fails with kAlreadyInitiated if a crashed program did not close the device: disables
// it and tries again, up to ten times.
unsigned init(const std::string &name, unsigned &code) {
  for (int attempt = 0; attempt < 10; ++attempt) {
    take_errors(hd());
    const bool first = name.empty() || name == kDefaultDevice;
    const unsigned handle = hd().init_device(first ? nullptr : name.c_str());
    const ErrorInfo error = take_errors(hd());
    code = error.code;
    const bool warning = (code & 0xF00) == kWarnings;
    if (handle != kInvalidHandle && (code == 0 || warning)) return handle;
    if (code == 0) code = kBadHandle;
    if (code != kAlreadyInitiated) break;
    const unsigned stale = handle != kInvalidHandle ? handle : error.device;
    if (slot_of(stale)) break;  // it is open here
    hd().disable_device(stale);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return kInvalidHandle;
}

// Reads a parameter; zeros if the device does not support it.
void numbers(unsigned parameter, double *out, int count) {
  double values[16] = {};
  take_errors(hd());
  hd().get_doubles(parameter, values);
  const bool known = take_errors(hd()).code == 0;
  for (int i = 0; i < count; ++i) out[i] = known ? values[i] : 0;
}

double number(unsigned parameter) {
  double value = 0;
  numbers(parameter, &value, 1);
  return value;
}

int integer(unsigned parameter, int otherwise) {
  int value = otherwise;
  hd().get_integers(parameter, &value);
  return take_errors(hd()).code == 0 ? value : otherwise;
}

template <size_t N>
void text(unsigned parameter, char (&out)[N]) {
  const char *const words = hd().get_string(parameter);
  const bool known = take_errors(hd()).code == 0 && words;
  std::snprintf(out, N, "%s", known ? words : "");
}

// Converts N/mm to N/m. A value above 20 N/mm is probably in N/m and is ignored.
double per_metre(double per_millimetre) {
  const double largest = 20;
  return per_millimetre > 0 && per_millimetre < largest ? per_millimetre / kMillimetre : 0;
}

// The device must be the current one.
void describe(mvs_driver_device &device) {
  mvs_driver_info &info = device.info;
  info.struct_size = sizeof info;
  text(kModel, info.model);
  text(kSerial, info.serial);
  text(kFirmware, info.firmware);
  info.freedoms_in = integer(kInputFreedoms, 6) >= 6 ? 6 : 3;
  info.freedoms_out = integer(kOutputFreedoms, 3) >= 6 ? 6 : 3;
  info.buttons = std::strstr(info.model, "Premium") ? 4 : 2;  // HDAPI does not report the number
  double box[6];
  numbers(kUsableWorkspace, box, 6);
  for (int i = 0; i < 3; ++i) {
    info.workspace_min[i] = box[i] * kMillimetre;
    info.workspace_max[i] = box[3 + i] * kMillimetre;
  }
  info.peak_force = number(kMaxForce);
  info.continuous_force = number(kContinuousForce);
  info.peak_torque = info.freedoms_out == 6 ? number(kMaxTorque) * 1e-3 : 0;
  info.max_stiffness = per_metre(number(kMaxStiffness));
  info.max_damping = per_metre(number(kMaxDamping));
  info.max_speed = number(kVelocityLimit) * kMillimetre;
  info.rate = integer(kUpdateRate, 1000);
  device.style = integer(kCalibrationStyle, 0);
}

// Tests which parameters of a tick the device supports.
void probe(mvs_driver_device &device) {
  unsigned char parked = 0;
  double values[16];
  hd().begin_frame(device.handle);
  take_errors(hd());
  hd().get_booleans(kInkwell, &parked);
  device.has_inkwell = take_errors(hd()).code == 0;
  hd().get_doubles(kMotorTemperature, values);
  device.has_temperature = take_errors(hd()).code == 0;
  hd().get_doubles(kVelocity, values);
  device.has_velocity = take_errors(hd()).code == 0;
  hd().end_frame(device.handle);
  take_errors(hd());
}

// Enables the library's protections that the device supports; forces stay off.
void protect() {
  for (const unsigned capability : {kForceClamping, kForceRamping, kSoftwareForceLimit})
    hd().enable(capability);
  take_errors(hd());
}

int32_t open_locked(const mvs_driver_host *host, const char *name, mvs_driver_device **out) {
  std::string &sentence = last_sentence();
  if (const int32_t code = load(host, sentence)) return code;
  if (shared().running > 0)
    return fail(sentence, MVS_DRIVER_E_BUSY,
                "a device of this kind is running: open all of them before the first one runs");
  Slot *const slot = [] {
    for (Slot &one : shared().slots)
      if (one.handle == kInvalidHandle) return &one;
    return static_cast<Slot *>(nullptr);
  }();
  if (!slot) return fail(sentence, MVS_DRIVER_E_BUSY, "eight devices are open: close one");
  auto device = std::make_unique<mvs_driver_device>();
  device->host = host;
  device->name = name ? name : "";
  device->slot = slot;
  const driver::DecimalPoint point;
  unsigned code = 0;
  device->handle = init(device->name, code);
  if (device->handle == kInvalidHandle) {
    const int32_t result = explain_open(code, device->name, option(host, "sysroot"), sentence);
    sentence += ". OpenHaptics says: " + phantom::describe(hd(), code);
    return result;
  }
  slot->posted = 0;
  slot->handle = device->handle;
  hd().make_current(device->handle);
  describe(*device);
  probe(*device);
  protect();
  *out = device.release();
  return MVS_DRIVER_OK;
}

// The caller holds the mutex, and no device is running.
int32_t calibrate_locked(mvs_driver_device &device) {
  const driver::DecimalPoint point;
  hd().make_current(device.handle);
  take_errors(hd());
  unsigned state = hd().check_calibration();
  if (state == kNeedsUpdate) {
    const int styles[] = {kAutomatic, kInInkwell, kEncoderReset};
    for (const int style : styles)
      if (device.style & style) {
        hd().update_calibration(style);
        break;
      }
    state = hd().check_calibration();
  }
  take_errors(hd());
  if (state == kCalibrated) return MVS_DRIVER_OK;
  return fail(
      device.sentence, MVS_DRIVER_E_CALIBRATION,
      std::string(device.info.model) + " must be calibrated: " + how_to_calibrate(device.style));
}

// Keeps devices whose callback may still be called.
void keep_for_ever(mvs_driver_device *device) {
  static std::vector<mvs_driver_device *> *const kept = new std::vector<mvs_driver_device *>;
  kept->push_back(device);
}

void stop_all(unsigned) {
  hd().stop_scheduler();
}
void disable(unsigned handle) {
  const driver::DecimalPoint point;
  hd().disable_device(handle);
  take_errors(hd());
}

// The caller holds the mutex, and the device is not running. Calls for a lost device have a
// timeout.
void release(mvs_driver_device *device) {
  if (device->loop.result == MVS_DRIVER_OK && !device->abandoned) {
    disable(device->handle);
  } else {
    if (device->abandoned && shared().running == 0 && !broken()) call_with_timeout(stop_all, 0);
    if (!broken()) call_with_timeout(disable, device->handle);
  }
  device->slot->handle = kInvalidHandle;
  if (device->abandoned && (broken() || shared().running > 0))
    keep_for_ever(device);
  else
    delete device;
}

}  // namespace

int32_t open(const mvs_driver_host *host, const char *name, mvs_driver_device **out) {
  if (!out) return fail(last_sentence(), MVS_DRIVER_E_INTERNAL, "open: there is no `device`");
  *out = nullptr;
  return guarded(last_sentence(), [&] {
    const std::lock_guard lock(shared().mutex);
    return open_locked(host, name, out);
  });
}

int32_t info(mvs_driver_device *device, mvs_driver_info *out) {
  driver::give(device->info, out);
  return MVS_DRIVER_OK;
}

int32_t calibrate(mvs_driver_device *device) {
  return guarded(device->sentence, [&] {
    const std::lock_guard lock(shared().mutex);
    if (shared().running > 0)
      return fail(device->sentence, MVS_DRIVER_E_BUSY,
                  "a device of this kind is running: stop it, then calibrate");
    return calibrate_locked(*device);
  });
}

// While another device runs, the current device of the library must not change: the loop then
// reports the calibration by its flag.
int32_t start(mvs_driver_device *device) {
  return guarded(device->sentence, [&] {
    const std::lock_guard lock(shared().mutex);
    if (shared().running == 0)
      if (const int32_t code = calibrate_locked(*device)) return code;
    device->started = true;
    device->quit = false;
    return int32_t(MVS_DRIVER_OK);
  });
}

// A call from within the servo takes effect when run() returns.
void close(mvs_driver_device *device) {
  if (!device) return;
  if (device->running) {
    device->close_after = true;
    device->quit = true;
    return;
  }
  guarded(last_sentence(), [&] {
    const std::lock_guard lock(shared().mutex);
    release(device);
    return int32_t(MVS_DRIVER_OK);
  });
}

}  // namespace phantom
