// The driver's one symbol: the table of its functions.
#include <algorithm>
#include <cstring>

#include "device.h"

namespace {

const char *const kOptions[] = {
    "library: absolute path of libHD.so; else it is looked up as the system does",
    "rate: Hz of the device's servo, 500 or 1000, more with some; else what OpenHaptics does",
    "sysroot: a folder with another /sys and /dev in which to look for USB devices (for tests)",
    nullptr};

const char *error(const mvs_driver_device *device) {
  return device ? device->sentence.c_str() : phantom::last_sentence().c_str();
}

}  // namespace

int32_t mvs_driver_negotiate(const mvs_driver_host *host, mvs_driver_api *api) {
  if (!host || !api || host->oldest > MVS_DRIVER_VERSION || host->newest < MVS_DRIVER_VERSION)
    return MVS_DRIVER_E_VERSION;
  mvs_driver_api mine = {};
  mine.struct_size = uint32_t(std::min<size_t>(api->struct_size, sizeof mine));
  mine.version = MVS_DRIVER_VERSION;
  mine.name = "phantom";
  mine.about = "Phantom, Omni and Touch of 3D Systems (SensAble), through OpenHaptics";
  mine.options = kOptions;
  mine.list = phantom::list;
  mine.doctor = phantom::doctor;
  mine.open = phantom::open;
  mine.info = phantom::info;
  mine.calibrate = phantom::calibrate;
  mine.start = phantom::start;
  mine.run = phantom::run;
  mine.stop = phantom::stop;
  mine.panic = phantom::panic;
  mine.close = phantom::close;
  mine.error = error;
  std::memcpy(api, &mine, mine.struct_size);
  return MVS_DRIVER_OK;
}
