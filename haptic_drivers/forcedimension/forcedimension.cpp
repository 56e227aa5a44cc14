// The function table of the driver.
#include "device.h"

namespace {

const char *const kOptions[] = {
    "library: absolute path of libdrd.so.3; else below $FDSDK, then as the system looks it up",
    "rate: Hz at which it is polled, 100 to 4000 [1000]",
    "move: yes lets a device that must be calibrated move by itself; hands off [no]",
    "sysroot: a folder with another /sys and /dev in which to look for USB devices (for tests)",
    nullptr};

const char *error(const mvs_driver_device *device) {
  return device ? device->sentence.c_str() : driver::last_sentence;
}

}  // namespace

int32_t mvs_driver_negotiate(const mvs_driver_host *host, mvs_driver_api *api) {
  mvs_driver_api ours = {};
  ours.name = "forcedimension";
  ours.about = "omega, delta, sigma, lambda of Force Dimension, and Falcon, through DHD";
  ours.options = kOptions;
  ours.list = forcedimension::list;
  ours.doctor = forcedimension::doctor;
  ours.open = forcedimension::open;
  ours.info = forcedimension::info;
  ours.calibrate = forcedimension::calibrate;
  ours.start = forcedimension::start;
  ours.read = forcedimension::read;
  ours.write = forcedimension::write;
  ours.stop = forcedimension::stop;
  ours.panic = forcedimension::panic;
  ours.close = forcedimension::close;
  ours.error = error;
  return driver::negotiate(host, api, ours);
}
