// An open device of Force Dimension's.
#pragma once
#include <mvs/driver.h>

#include <atomic>
#include <mutex>
#include <string>

#include "common/interface.h"
#include "common/sentence.h"
#include "dhd.h"
#include "models.h"

namespace forcedimension {

inline constexpr int kMaxDevices = 8;
inline constexpr int kGrace = 50;  // reads until forces that were enabled must be on

struct Shared {
  std::mutex mutex;  // of everything here; not needed at the device's rate
  void *library = nullptr;
  std::string path;
  Dhd dhd = {};
  bool open[kMaxDevices] = {};  // by the system's index
};
Shared &shared();
inline const Dhd &dhd() {
  return shared().dhd;
}

// Loads the library that the options name, or the first that is found; refuses, if there is none.
// The mutex is held.
void load(const mvs_driver_host *host);

// What the device's forces are off for, as MVS_CAUSE_*.
uint32_t cause_of(int force_off);

inline constexpr const char *kUdevRule =
    "SUBSYSTEM==\"usb\", ATTR{idVendor}==\"1451\", TAG+=\"uaccess\" (a Falcon: 0403, cb48)";

}  // namespace forcedimension

struct mvs_driver_device {
  int index = 0;  // of the system's list
  char id = 0;    // DHD's number
  mvs_driver_info info = {};
  bool has_wrist = false, has_gripper = false;
  double gripper_sign = 1;  // left-handed ones count the other way
  bool by_drd = false;      // who opened it
  bool may_move = false;    // by itself, to calibrate
  std::string sentence;     // of the last failure

  // Held by who calls DHD for this device: the thread that polls, stop() or panic(). Who polls and
  // finds it held goes on without.
  std::atomic<bool> busy{false};
  std::atomic<bool> stopped{true};

  // Of the thread that polls.
  bool on = false;         // what was last asked of the motors
  bool saturated = false;  // by the last force
  int grace = 0;           // reads until a device that was just switched on must say that it is
  int until_status = 0;    // reads until its status is asked for
  int status[forcedimension::kStatusCount] = {};
  double lever = 0;                  // m, of the gripper's finger; 0: not known yet
  uint64_t now_ns = 0, good_ns = 0;  // the last read, and the last one that was answered
  mvs_driver_state state = {};
};

namespace forcedimension {

int32_t list(const mvs_driver_host *host, mvs_driver_found found, void *user);
int32_t doctor(const mvs_driver_host *host, mvs_driver_finding finding, void *user);
int32_t open(const mvs_driver_host *host, const char *name, mvs_driver_device **out);
int32_t info(mvs_driver_device *device, mvs_driver_info *out);
int32_t calibrate(mvs_driver_device *device);
int32_t start(mvs_driver_device *device);
int32_t read(mvs_driver_device *device, uint64_t now_ns, mvs_driver_state *out);
int32_t write(mvs_driver_device *device, const mvs_driver_force *force);
int32_t stop(mvs_driver_device *device);
void panic(mvs_driver_device *device);
void close(mvs_driver_device *device);

}  // namespace forcedimension
