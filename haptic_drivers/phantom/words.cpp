// Error messages with the action to take.
#include "words.h"

#include <mvs/driver.h>

#include "common/sentence.h"
#include "common/usb.h"
#include "hdapi.h"

namespace phantom {
namespace {

using driver::sentence;

// A device that does not answer is not connected, connected without permission, or connected: the
// USB bus shows which.
int32_t explain_no_answer(const std::string &subject, const std::string &sysroot,
                          std::string &out) {
  const auto devices = driver::usb_devices(sysroot, {"2988:"});
  for (const auto &device : devices) {
    if (device.closed.empty()) continue;
    out = sentence(
        "%s is plugged in (USB %s), but this user may not open %s: add a udev rule, %s, then plug "
        "it in again",
        subject.c_str(), device.id.c_str(), device.closed.c_str(), kUdevRule);
    return MVS_DRIVER_E_PERMISSION;
  }
  out = sentence("%s does not answer: %s", subject.c_str(),
                 devices.empty() ? "no device of 3D Systems is on the USB bus; check power and "
                                   "cable (one on FireWire or Ethernet is not looked for here)"
                                 : "it is on the USB bus; run the vendor's Touch_Setup, and close "
                                   "other programs that use it");
  return MVS_DRIVER_E_ABSENT;
}

}  // namespace

int32_t explain_open(unsigned code, const std::string &name, const std::string &sysroot,
                     std::string &out) {
  const std::string subject = name.empty() ? "the default device" : "the device \"" + name + "\"";
  switch (code) {
    case kAlreadyInitiated:
      out = subject +
            " is in use, here or in another program, or was left so by one that crashed: "
            "close that one, or unplug the device for a moment";
      return MVS_DRIVER_E_BUSY;
    case kInvalidLicence:
      out = "OpenHaptics finds no licence for " + subject +
            ": install the one of your edition (Developer or Academic) as its guide says";
      return MVS_DRIVER_E_LICENCE;
    case kDeviceFault:
      out = subject +
            " says that it is broken: switch it off and on; if that does not help, run the "
            "vendor's Touch_Diagnostic";
      return MVS_DRIVER_E_FAULT;
    case kCommConfigError:
    case kBadHandle:
      out = subject +
            " is not configured: run the vendor's Touch_Setup as this user (it writes "
            "~/.3dsystems/config), or give the name that it has there";
      return MVS_DRIVER_E_ABSENT;
    default:
      return explain_no_answer(subject, sysroot, out);
  }
}

std::string how_to_calibrate(int style) {
  if (style & kInInkwell)
    return "put the stylus into the inkwell and leave it there for a second, then try again";
  if (style & kEncoderReset)
    return "hold the arm in its reset position, all links at right angles as the device's guide "
           "shows, and try again";
  if (style & kAutomatic) return "move the stylus once through its whole range, then try again";
  return "calibrate it with the vendor's Touch_Diagnostic, then try again";
}

std::string explain_load(const std::string &path, bool there, const std::string &why) {
  if (!there)
    return sentence(
        "no OpenHaptics here (%s): install the vendor's OpenHaptics and device driver, "
        "or give the option library=/path/to/libHD.so",
        why.empty() ? "no libHD.so" : why.c_str());
  const bool ncurses = why.find("libncurses.so.5") != std::string::npos ||
                       why.find("libtinfo.so.5") != std::string::npos;
  const bool io = why.find("libPhantomIOLib42") != std::string::npos;
  return sentence("%s is there but does not load (%s): %s", path.c_str(), why.c_str(),
                  ncurses ? "apt-get install libncurses5 libtinfo5 (Debian 12 is the last to have "
                            "them)"
                  : io    ? "install the vendor's device driver, which brings it"
                          : "install what it names");
}

}  // namespace phantom
