// The function table of the driver.
#include "common/interface.h"
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
  mvs_driver_api ours = {};
  ours.name = "phantom";
  ours.about = "Phantom, Omni and Touch of 3D Systems (SensAble), through OpenHaptics";
  ours.options = kOptions;
  ours.list = phantom::list;
  ours.doctor = phantom::doctor;
  ours.open = phantom::open;
  ours.info = phantom::info;
  ours.calibrate = phantom::calibrate;
  ours.start = phantom::start;
  ours.run = phantom::run;
  ours.stop = phantom::stop;
  ours.panic = phantom::panic;
  ours.close = phantom::close;
  ours.error = error;
  return driver::negotiate(host, api, ours);
}
