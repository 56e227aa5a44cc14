// The vendor library, loaded once per process.
#include <dirent.h>

#include <vector>

#include "common/library.h"
#include "common/locale.h"
#include "common/options.h"
#include "device.h"

namespace forcedimension {
namespace {

#if defined(__aarch64__)
constexpr const char *kSdkFolder = "/lib/release/lin-aarch64-gcc";
#else
constexpr const char *kSdkFolder = "/lib/release/lin-x86_64-gcc";
#endif

// Returns the library with DRD in a folder; the last by name if there are several.
std::string newest_in(const std::string &folder) {
  std::string best;
  DIR *const files = folder.empty() ? nullptr : opendir(folder.c_str());
  if (!files) return best;
  while (const dirent *const entry = readdir(files)) {
    const std::string name = entry->d_name;
    if (name.compare(0, 9, "libdrd.so") == 0 && name > best) best = name;
  }
  closedir(files);
  return best.empty() ? best : folder + "/" + best;
}

std::vector<std::string> candidates(const std::string &chosen) {
  if (!chosen.empty()) return {chosen};
  return {newest_in(driver::below_variable("FDSDK", kSdkFolder)),
          newest_in(driver::below_variable("HOME", "/.local/lib")),
          newest_in("/usr/local/lib"),
          "libdrd.so.3",
          "libdrd.so",
          newest_in("/usr/lib"),
          "libdhd.so.3",
          "libdhd.so"};
}

std::string explain(const driver::Library &one) {
  if (!one.there)
    return "no SDK of Force Dimension here (" + (one.why.empty() ? "no libdrd.so" : one.why) +
           "): install it, and set FDSDK to its folder or give the option "
           "library=/path/to/libdrd.so.3";
  const bool usb = one.why.find("libusb") != std::string::npos;
  return one.path + " is there but does not load (" + one.why +
         "): " + (usb ? "apt-get install libusb-1.0-0" : "install what it names");
}

}  // namespace

Shared &shared() {
  // never destroyed: a device may be stopped during program exit
  static Shared *const all = new Shared;
  return *all;
}

void load(const mvs_driver_host *host) {
  const std::string chosen = driver::Options(host).text("library").value_or("");
  if (!chosen.empty() && chosen.front() != '/')
    driver::refuse(MVS_DRIVER_E_OPTION,
                   "library=" + chosen + " is not an absolute path: give the path from the root");
  Shared &all = shared();
  if (all.library && chosen.empty()) return;
  const driver::DecimalPoint point;
  const driver::Library one = driver::load(candidates(chosen));
  if (!one.handle) driver::refuse(MVS_DRIVER_E_LIBRARY, explain(one));
  if (one.handle == all.library) return;
  if (all.library)
    driver::refuse(MVS_DRIVER_E_OPTION, "library=" + chosen + ": " + all.path +
                                            " is loaded already: start the program again");
  Dhd dhd = {};
  const std::string missing = bind(one.handle, dhd);
  if (!missing.empty())
    driver::refuse(MVS_DRIVER_E_LIBRARY,
                   one.path + " is not SDK 3 of Force Dimension: it lacks " + missing);
  all.dhd = dhd;
  all.library = one.handle;
  all.path = one.path;
}

uint32_t cause_of(int force_off) {
  switch (force_off) {
    case kOffByButton:
      return MVS_CAUSE_BUTTON;
    case kOffByVelocity:
      return MVS_CAUSE_VELOCITY;
    case kOffByWatchdog:
      return MVS_CAUSE_WATCHDOG;
    case kOffBySoftware:
      return MVS_CAUSE_SOFTWARE;
    case kOffByUsb:
      return MVS_CAUSE_UNPLUGGED;
    case kOffByDeadMan:
      return MVS_CAUSE_DEADMAN;
    default:
      return MVS_CAUSE_NONE;
  }
}

}  // namespace forcedimension
