// An open device of Force Dimension, and the shared vendor library.
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
inline constexpr int kGrace = 50;  // reads until enabled forces must be on

struct Shared {
  std::mutex mutex;  // protects all members; not taken at the device's rate
  void *library = nullptr;
  std::string path;
  Dhd dhd = {};
  bool open[kMaxDevices] = {};  // by index of the system's list
};
Shared &shared();
inline const Dhd &dhd() {
  return shared().dhd;
}

// Loads the library named by the options, or the first found; throws a Refusal if there is no
// library. The caller holds the mutex.
void load(const mvs_driver_host *host);

// Maps the reason for which the device switched its forces off to MVS_CAUSE_*.
uint32_t cause_of(int force_off);

inline constexpr const char *kUdevRule =
    "SUBSYSTEM==\"usb\", ATTR{idVendor}==\"1451\", TAG+=\"uaccess\" (a Falcon: 0403, cb48)";

}  // namespace forcedimension

struct mvs_driver_device {
  int index = 0;  // in the system's list
  char id = 0;    // number of DHD
  mvs_driver_info info = {};
  bool has_wrist = false, has_gripper = false;
  double gripper_sign = 1;  // -1 for left-handed devices
  bool by_drd = false;      // opened by DRD, not by DHD
  bool may_move = false;    // may move by itself for calibration
  std::string sentence;     // of the last failure

  // Lock for calls of DHD: taken by the polling thread, stop() or panic(). The polling thread skips
  // its call if the lock is taken.
  std::atomic<bool> busy{false};
  std::atomic<bool> stopped{true};

  // Used by the polling thread only.
  bool on = false;         // last requested state of the motors
  bool saturated = false;  // saturated by the last force
  int grace = 0;           // reads until a switched-on device must report its forces as on
  int until_status = 0;    // reads until the next status query
  int status[forcedimension::kStatusCount] = {};
  double lever = 0;                  // m, of the gripper's finger; 0: unknown
  uint64_t now_ns = 0, good_ns = 0;  // times of the last read and the last successful read
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
