// What to tell somebody whose device does not work.
#pragma once
#include <cstdint>
#include <string>

namespace phantom {

// A MVS_DRIVER_E_* and a sentence for an error with which hdInitDevice failed. `sysroot` is where
// to look for USB devices, "" but in tests.
int32_t explain_open(unsigned code, const std::string &name, const std::string &sysroot,
                     std::string &sentence);

// What to do with the stylus, by the bits of the style.
std::string how_to_calibrate(int style);

// Why a library did not load, and what to install.
std::string explain_load(const std::string &path, bool there, const std::string &why);

inline constexpr const char *kUdevRule =
    "SUBSYSTEM==\"usb\", ATTR{idVendor}==\"2988\", TAG+=\"uaccess\" (and the same for tty and "
    "hidraw, see haptic_drivers/phantom/README.md)";

}  // namespace phantom
