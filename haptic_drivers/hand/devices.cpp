// Table of devices.
#include "devices.h"

#include "common/interface.h"

namespace hand {

namespace {

constexpr Device kDevices[] = {
    // no device: the written force acts on the hand at once
    {"ideal", "ideal", 100, 100, 1e5, 1e3, 1000, 0.25, 0, 0, 0, 0, 6},
    {"touch", "Touch", 3.3, 0.88, 400, 4, 1000, 0.075, 55e-6, 0.045, 0.005, 1, 6},
    {"omni", "PHANTOM Omni", 3.3, 0.88, 700, 5, 1000, 0.10, 55e-6, 0.045, 0.005, 1, 6},
    {"desktop", "PHANTOM Desktop", 7.9, 1.75, 1000, 5, 1000, 0.10, 23e-6, 0.045, 0.005, 1, 6},
    {"premium15", "PHANTOM Premium 1.5", 8.5, 1.4, 800, 5, 1000, 0.12, 30e-6, 0.075, 0.005, 1, 6},
    {"premium30", "PHANTOM Premium 3.0", 22, 3, 1000, 5, 1000, 0.25, 20e-6, 0.159, 0.005, 1, 6},
    {"omega", "omega.3", 12, 0, 5000, 30, 4000, 0.075, 10e-6, 0.2, 0.1, 1, 3},
    {"delta", "delta.3", 20, 0, 5000, 30, 4000, 0.15, 20e-6, 0.3, 0.1, 1, 3},
    {"lambda", "lambda", 12, 0, 8000, 30, 4000, 0.12, 10e-6, 0.3, 0.1, 1, 3},
    {"falcon", "Falcon", 8, 0, 3000, 20, 1000, 0.04, 63.5e-6, 0.1, 0.1, 1, 3},
    {"premium6", "PHANTOM Premium 1.5 6DOF", 8.5, 1.4, 800, 5, 1000, 0.12, 30e-6, 0.075, 0.005, 1,
     6, 0.188, 0, 0, 5e-5, 3e-6, 1.4e-4},
    {"sigma", "sigma.7", 12, 0, 4000, 30, 4000, 0.075, 10e-6, 0.3, 0.1, 1, 6, 0.2, 0, 0, 1e-4, 3e-5,
     2.3e-4},
};

}  // namespace

const Device &device(const std::string &name) {
  std::string names;
  for (const Device &device : kDevices) {
    if (name == device.name) return device;
    names += std::string(names.empty() ? "" : ", ") + device.name;
  }
  driver::refuse(MVS_DRIVER_E_OPTION, "option device=" + name + ": give one of " + names);
}

}  // namespace hand
