// Findings of a driver's doctor(), told in strings.
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

  // What is plugged in, `none` where nothing is, and the udev rule for what may not be opened.
  void say_usb(const std::vector<UsbDevice> &devices, const char *none, const char *rule) const {
    if (devices.empty()) say(-1, "USB", none);
    for (const UsbDevice &device : devices) {
      const std::string who = device.name + " (" + device.id + ") is plugged in, ";
      if (device.closed.empty())
        say(1, "USB", who + "and this user may talk to it");
      else
        say(0, "USB",
            who + "but this user may not open " + device.closed + ": add a udev rule, " + rule +
                ", then plug it in again");
    }
  }
};

}  // namespace driver
