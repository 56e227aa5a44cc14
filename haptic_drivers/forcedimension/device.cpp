// Open, describe, calibrate, start and close a device.
#include "device.h"

#include <memory>

#include "common/locale.h"
#include "common/options.h"
#include "common/usb.h"

namespace forcedimension {
namespace {

using driver::refuse;
using driver::sentence;

// DHD does not find, or cannot open, a USB device without permission: reports the missing udev
// rule.
void refuse_permission(const std::string &sysroot) {
  for (const auto &device : driver::usb_devices(sysroot, {"1451:", "0403:cb48"}))
    if (!device.closed.empty())
      refuse(MVS_DRIVER_E_PERMISSION,
             "this user may not open " + device.closed + " of the USB device " + device.id +
                 ": add a udev rule, " + kUdevRule + ", then plug it in again");
}

[[noreturn]] void refuse_open(int index) {
  const int error = dhd().error_get_last();
  const char *const words = dhd().error_get_last_str();
  const std::string reason = sentence(" (DHD says: %s, %d)", words ? words : "nothing", error);
  if (error == kErrorInUse || error == kErrorBusy)
    refuse(MVS_DRIVER_E_BUSY,
           sentence("device %d is open in another program: close it there", index) + reason);
  if (error == kErrorNoDriver || error == kErrorNoDevice)
    refuse(MVS_DRIVER_E_ABSENT,
           sentence("device %d is not there: check cable and power", index) + reason);
  refuse(MVS_DRIVER_E_FAULT,
         sentence("device %d does not open: switch it off and on", index) + reason);
}

// Returns the index of a named device; without a name, the first that is not open here.
int index_of(const char *name, int count) {
  const Shared &all = shared();
  for (int i = 0; i < count && i < kMaxDevices; ++i) {
    if (name && std::to_string(i) != name) continue;
    if (!all.open[i]) return i;
    if (name) refuse(MVS_DRIVER_E_BUSY, sentence("device %d is open here: close it first", i));
  }
  if (!name) refuse(MVS_DRIVER_E_BUSY, "all devices are open here: close one first");
  refuse(MVS_DRIVER_E_ABSENT,
         sentence("there is no device %.80s: they are called by their number, and there are %d",
                  name, count));
}

void describe(mvs_driver_device &device) {
  mvs_driver_info &info = device.info;
  const int type = dhd().get_system_type(device.id);
  const Model model = model_of(type);
  info.struct_size = sizeof info;
  info.freedoms_in = device.has_wrist ? 6 : 3;
  info.freedoms_out = dhd().has_active_wrist(device.id) ? 6 : 3;
  info.buttons = type == kFalcon ? 4 : 1;
  info.has_gripper = device.has_gripper;
  for (int i = 0; i < 3; ++i) {
    info.workspace_min[i] = -model.reach;
    info.workspace_max[i] = model.reach;
  }
  info.peak_force = model.force;
  info.peak_torque = info.freedoms_out == 6 ? model.torque : 0;
  info.max_stiffness = model.stiffness;
  info.max_damping = model.damping;
  // device axes: x towards the user, y to the right, z up
  info.frame[1] = info.frame[6] = info.frame[8] = 1;
  const char *const name = dhd().get_system_name(device.id);
  std::snprintf(info.model, sizeof info.model, "%s", name ? name : "Force Dimension");
  unsigned short serial = 0;
  if (dhd().get_serial_number(&serial, device.id) >= 0)
    std::snprintf(info.serial, sizeof info.serial, "%u", unsigned(serial));
  double version = 0;
  if (dhd().get_version(&version, device.id) >= 0)
    std::snprintf(info.firmware, sizeof info.firmware, "%.2f", version);
}

mvs_driver_device *open_locked(const mvs_driver_host *host, const char *name) {
  load(host);
  const driver::Options options(host);
  const double rate = options.number("rate", 1000, 100, 4000);
  const std::string move = options.text("move").value_or("no");
  if (move != "yes" && move != "no")
    refuse(MVS_DRIVER_E_OPTION, "option move=" + move + ": give yes or no");
  const std::string sysroot = options.text("sysroot").value_or("");
  const driver::DecimalPoint point;
  const int count = dhd().get_device_count();
  if (count <= 0) refuse_permission(sysroot);
  if (count <= 0)
    refuse(MVS_DRIVER_E_ABSENT, "no device of Force Dimension is there: check cable and power");
  auto device = std::make_unique<mvs_driver_device>();
  device->index = index_of(name, count);
  device->by_drd = dhd().has_drd();
  const int id =
      device->by_drd ? dhd().drd_open_id(char(device->index)) : dhd().open_id(char(device->index));
  if (id < 0) {
    const int error = dhd().error_get_last();
    if (error != kErrorInUse && error != kErrorBusy) refuse_permission(sysroot);
    refuse_open(device->index);
  }
  device->id = char(id);
  device->may_move = move == "yes";
  device->has_wrist = dhd().has_wrist(device->id);
  device->has_gripper = dhd().has_gripper(device->id);
  device->gripper_sign = dhd().is_left_handed(device->id) ? -1 : 1;
  describe(*device);
  device->info.rate = rate;
  device->sentence.reserve(256);
  device->state.orientation[0] = 1;
  dhd().get_status(device->status, device->id);
  shared().open[device->index] = true;
  return device.release();
}

bool is_calibrated(mvs_driver_device &device) {
  if (device.by_drd && dhd().drd_is_supported(device.id))
    return dhd().drd_is_initialized(device.id);
  return dhd().get_status(device.status, device.id) >= 0 && !device.status[kReset];
}

int32_t fail(mvs_driver_device &device, int32_t code, std::string sentence) {
  device.sentence = std::move(sentence);
  return code;
}

// DRD moves the arm to its stops; only with option move=yes.
int32_t calibrate_automatically(mvs_driver_device &device) {
  if (!device.may_move)
    return fail(device, MVS_DRIVER_E_CALIBRATION,
                device.info.model +
                    std::string(" must be calibrated, for which it moves by itself: take your "
                                "hand off, and give the option move=yes"));
  const bool good = dhd().drd_auto_init(device.id) >= 0;
  dhd().drd_stop(true, device.id);
  dhd().stop(device.id);
  if (good && dhd().drd_is_initialized(device.id)) return MVS_DRIVER_OK;
  return fail(device, MVS_DRIVER_E_CALIBRATION,
              device.info.model + std::string(" could not calibrate itself: take away what is in "
                                              "its way, and try again"));
}

}  // namespace

int32_t open(const mvs_driver_host *host, const char *name, mvs_driver_device **out) {
  *out = nullptr;
  return driver::guarded([&] {
    const std::lock_guard lock(shared().mutex);
    *out = open_locked(host, name);
  });
}

int32_t info(mvs_driver_device *device, mvs_driver_info *out) {
  driver::give(device->info, out);
  return MVS_DRIVER_OK;
}

int32_t calibrate(mvs_driver_device *device) {
  const driver::DecimalPoint point;
  if (is_calibrated(*device)) return MVS_DRIVER_OK;
  if (device->by_drd && dhd().drd_is_supported(device->id)) return calibrate_automatically(*device);
  return fail(*device, MVS_DRIVER_E_CALIBRATION,
              device->info.model +
                  std::string(" must be calibrated: move its end to the rest position that its "
                              "guide shows (a Falcon: pull it out, then push it in, until its "
                              "lights are blue), and try again"));
}

int32_t start(mvs_driver_device *device) {
  if (!is_calibrated(*device)) return calibrate(device);
  if (device->info.peak_force > 0) dhd().set_max_force(device->info.peak_force, device->id);
  dhd().set_force(0, 0, 0, 0, 0, 0, 0, device->id);
  if (dhd().enable_force(1, device->id) < 0)
    return fail(*device, MVS_DRIVER_E_FAULT,
                device->info.model + std::string(" does not enable its forces: switch it off and "
                                                 "on"));
  device->on = true;
  device->grace = kGrace;
  device->until_status = 0;
  device->good_ns = 0;
  device->stopped = false;
  return MVS_DRIVER_OK;
}

void close(mvs_driver_device *device) {
  if (!device) return;
  stop(device);
  const std::lock_guard lock(shared().mutex);
  if (device->by_drd)
    dhd().drd_close(device->id);
  else
    dhd().close(device->id);
  shared().open[device->index] = false;
  delete device;
}

}  // namespace forcedimension
