// list() and doctor(): USB, library, devices.
#include "common/finder.h"
#include "common/library.h"
#include "common/options.h"
#include "device.h"

namespace forcedimension {
namespace {

using driver::Finder;
using driver::sentence;

bool check_library(const mvs_driver_host *host, const Finder &finder) {
  const int32_t code = driver::guarded([&] {
    const std::lock_guard lock(shared().mutex);
    load(host);
  });
  const bool good = code == MVS_DRIVER_OK;
  finder.say(good ? 1 : 0, "library libdrd.so",
             good ? shared().path + " is loaded" : driver::last_sentence);
  if (good && !dhd().has_drd())
    finder.say(-1, "library libdrd.so",
               "it has no DRD: a device that calibrates itself by moving must be calibrated with "
               "the vendor's program");
  if (!good && !driver::load({"libusb-1.0.so.0"}).handle)
    finder.say(0, "library libusb-1.0.so.0", "the SDK needs it: apt-get install libusb-1.0-0");
  return good;
}

void check_usb(const mvs_driver_host *host, const Finder &finder) {
  const std::string root = driver::Options(host).text("sysroot").value_or("");
  finder.say_usb(driver::usb_devices(root, {"1451:", "0403:cb48"}),
                 "no device of Force Dimension (1451:*) or Falcon (0403:cb48) is plugged in",
                 kUdevRule);
}

// Opens a device without moving it.
void check_device(const mvs_driver_host *host, const Finder &finder, int index) {
  const std::string name = std::to_string(index), check = "device " + name;
  mvs_driver_device *device = nullptr;
  const int32_t code = open(host, name.c_str(), &device);
  if (code != MVS_DRIVER_OK)
    return finder.say(code == MVS_DRIVER_E_BUSY ? -1 : 0, check, driver::last_sentence);
  const mvs_driver_info &info = device->info;
  finder.say(
      1, check,
      sentence("%s, serial %s, firmware %s: %.2g N, %u freedoms, %u with force", info.model,
               info.serial, info.firmware, info.peak_force, info.freedoms_in, info.freedoms_out));
  finder.say(device->status[kPower] ? 1 : 0, "power",
             device->status[kPower] ? "it has power" : "it has no power: switch it on");
  device->may_move = false;
  const bool good = calibrate(device) == MVS_DRIVER_OK;
  finder.say(good ? 1 : 0, "calibration", good ? "it is calibrated" : device->sentence);
  close(device);
}

int count() {
  const int devices = dhd().get_device_count();
  return devices < kMaxDevices ? devices : kMaxDevices;
}

}  // namespace

// Lists device numbers: DHD reports the type only of an open device.
int32_t list(const mvs_driver_host *host, mvs_driver_found found, void *user) {
  return driver::guarded([&] {
    const std::lock_guard lock(shared().mutex);
    load(host);
    for (int i = 0; i < count(); ++i) found(user, std::to_string(i).c_str(), "Force Dimension");
  });
}

int32_t doctor(const mvs_driver_host *host, mvs_driver_finding finding, void *user) {
  return driver::guarded([&] {
    const Finder finder = {finding, user};
    check_usb(host, finder);
    if (!check_library(host, finder)) return;
    if (count() <= 0) finder.say(0, "device", "DHD finds no device: check cable and power");
    for (int i = 0; i < count(); ++i) check_device(host, finder, i);
  });
}

}  // namespace forcedimension
