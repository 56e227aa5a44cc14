// list() and doctor(): locale, USB, library, devices.
#include <filesystem>
#include <set>

#include "common/finder.h"
#include "common/library.h"
#include "common/locale.h"
#include "common/sentence.h"
#include "device.h"
#include "words.h"

namespace phantom {
namespace {

using driver::Finder;

// Returns the device names of the vendor's configuration files; without files, the default device.
std::vector<std::string> configured() {
  namespace fs = std::filesystem;
  std::set<std::string> names;
  for (const std::string &folder : {driver::below_variable("GTDD_HOME", "/config"),
                                    driver::below_variable("HOME", "/.3dsystems/config")}) {
    std::error_code ignored;
    if (folder.empty()) continue;
    for (const auto &entry : fs::directory_iterator(folder, ignored))
      if (entry.path().extension() == ".config") names.insert(entry.path().stem().string());
  }
  if (names.empty()) names.insert(kDefaultDevice);
  return {names.begin(), names.end()};
}

// Checks the dependencies of libHD.so one by one, because dlopen reports only the first missing
// one.
void check_dependencies(const Finder &finder) {
  const struct {
    const char *name, *cure;
  } needed[] = {
      {"libncurses.so.5", "apt-get install libncurses5 (Debian 12 is the last to have it)"},
      {"libtinfo.so.5", "apt-get install libtinfo5 (Debian 12 is the last to have it)"},
      {"libPhantomIOLib42.so", "install the vendor's device driver, which brings it"}};
  for (const auto &one : needed) {
    const bool good = driver::load({one.name}).handle;
    finder.say(good ? 1 : 0, std::string("library ") + one.name,
               good ? "it is there" : std::string("libHD.so needs it: ") + one.cure);
  }
}

bool check_library(const mvs_driver_host *host, const Finder &finder) {
  std::string sentence;
  int32_t code;
  {
    const std::lock_guard lock(shared().mutex);
    code = load(host, sentence);
    if (code == MVS_DRIVER_OK) sentence = shared().path + " is loaded";
  }
  finder.say(code == MVS_DRIVER_OK ? 1 : 0, "library libHD.so", sentence);
  if (code == MVS_DRIVER_E_LIBRARY) check_dependencies(finder);
  return code == MVS_DRIVER_OK;
}

void check_usb(const mvs_driver_host *host, const Finder &finder) {
  finder.say_usb(driver::usb_devices(option(host, "sysroot"), {"2988:"}),
                 "no device of 3D Systems (2988:*) is plugged in; one on FireWire or Ethernet is "
                 "not looked for",
                 kUdevRule);
}

void check_locale(const Finder &finder) {
  const bool comma = std::string(driver::decimal_point()) != ".";
  finder.say(1, "locale",
             comma ? "numbers have a decimal comma here, with which OpenHaptics reads its own "
                     "files wrongly: this driver has it read them with a point"
                   : "numbers have a decimal point");
}

// Opens the device, and calibrates it if that needs no user.
void check_device(const mvs_driver_host *host, const Finder &finder, const std::string &name) {
  const std::string check = "device " + name;
  mvs_driver_device *device = nullptr;
  const int32_t opened = open(host, name.c_str(), &device);
  if (opened != MVS_DRIVER_OK) {
    finder.say(opened == MVS_DRIVER_E_BUSY ? -1 : 0, check, last_sentence());
    return;
  }
  const mvs_driver_info &info = device->info;
  finder.say(1, check,
             driver::sentence("%s, serial %s, firmware %s: %.2g N (%.2g N continuous) at %.0f Hz",
                              info.model, info.serial, info.firmware, info.peak_force,
                              info.continuous_force, info.rate));
  const bool good = calibrate(device) == MVS_DRIVER_OK;
  finder.say(good ? 1 : 0, "calibration", good ? "it is calibrated" : device->sentence);
  close(device);
}

}  // namespace

// HDAPI has no list of devices: opens and closes each name, which does not move the device.
int32_t list(const mvs_driver_host *host, mvs_driver_found found, void *user) {
  return guarded(last_sentence(), [&]() -> int32_t {
    {
      const std::lock_guard lock(shared().mutex);
      if (const int32_t code = load(host, last_sentence())) return code;
    }
    for (const std::string &name : configured()) {
      mvs_driver_device *device = nullptr;
      const int32_t code = open(host, name.c_str(), &device);
      if (code == MVS_DRIVER_E_BUSY) found(user, name.c_str(), "in use");
      if (code != MVS_DRIVER_OK) continue;
      found(user, name.c_str(), device->info.model);
      close(device);
    }
    return MVS_DRIVER_OK;
  });
}

int32_t doctor(const mvs_driver_host *host, mvs_driver_finding finding, void *user) {
  return guarded(last_sentence(), [&]() -> int32_t {
    const Finder finder = {finding, user};
    check_locale(finder);
    check_usb(host, finder);
    if (!check_library(host, finder)) return MVS_DRIVER_OK;
    for (const std::string &name : configured()) check_device(host, finder, name);
    return MVS_DRIVER_OK;
  });
}

}  // namespace phantom
