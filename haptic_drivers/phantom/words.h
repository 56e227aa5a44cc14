// Error messages for users.
#pragma once
#include <cstdint>
#include <string>

namespace phantom {

// Returns MVS_DRIVER_E_* and writes a message for an error of hdInitDevice. `sysroot` is the root
// of the USB search, "" except in tests.
int32_t explain_open(unsigned code, const std::string &name, const std::string &sysroot,
                     std::string &sentence);

// Returns the calibration instruction for the bits of CalibrationStyle.
std::string how_to_calibrate(int style);

// Returns the reason why the library did not load, and the package to install.
std::string explain_load(const std::string &path, bool there, const std::string &why);

inline constexpr const char *kUdevRule =
    "SUBSYSTEM==\"usb\", ATTR{idVendor}==\"2988\", TAG+=\"uaccess\" (and the same for tty and "
    "hidraw, see haptic_drivers/phantom/README.md of the sources)";

}  // namespace phantom
