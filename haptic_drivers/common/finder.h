// Findings of a driver's doctor(), from strings.
#pragma once

#include <mvs/driver.h>

#include <string>
#include <vector>

#include "common/usb.h"

namespace driver {

struct Finder {
  mvs_driver_finding finding;
  void *user;
  void say(int32_t verdict, const std::string &check, const std::string &sentence) const {
    finding(user, verdict, check.c_str(), sentence.c_str());
  }

  // Reports each connected device, or `absent` if there is no device; adds the udev rule for a
  // device that this user may not open.
  void say_usb(const std::vector<UsbDevice> &devices, const char *absent, const char *rule) const {
    if (devices.empty()) say(-1, "USB", absent);
    for (const UsbDevice &device : devices) {
      const std::string subject = device.name + " (" + device.id + ") is plugged in, ";
      if (device.closed.empty())
        say(1, "USB", subject + "and this user may talk to it");
      else
        say(0, "USB",
            subject + "but this user may not open " + device.closed + ": add a udev rule, " + rule +
                ", then plug it in again");
    }
  }
};

}  // namespace driver
