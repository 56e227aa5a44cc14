// An open device of 3D Systems, and the state shared by all devices: library, scheduler, error
// slots.
#pragma once
#include <mvs/driver.h>

#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <string>

#include "hdapi.h"

namespace phantom {

inline constexpr int kMaxDevices = 8;
inline constexpr double kMillimetre = 1e-3;  // m
// The vendor's name of the first device; older versions use "Default PHANTOM".
inline constexpr const char *kDefaultDevice = "Default Device";

// The part of a device that callbacks of other devices use. Never freed, because the device may be
// closed meanwhile.
struct Slot {
  std::atomic<unsigned> handle{kInvalidHandle};  // kInvalidHandle: the slot is free
  std::atomic<unsigned> posted{
      0};  // the newest error of this device, found by another device's callback
};

struct Shared {
  std::mutex mutex;         // protects all members except the slots
  void *library = nullptr;  // never closed: HDAPI cannot be loaded twice
  std::string path;
  Hdapi hd = {};
  int running = 0;  // active calls of run(); the scheduler runs while there is one
  std::shared_ptr<std::atomic<bool>> returned;  // false: a call did not return, see broken()
  Slot slots[kMaxDevices];
};
Shared &shared();
inline const Hdapi &hd() {
  return shared().hd;
}

// Returns the slot of a device open in this process, or null.
Slot *slot_of(unsigned handle);

// Loads the library named by the options, or the first found. The caller holds the mutex.
int32_t load(const mvs_driver_host *host, std::string &sentence);
// Returns an option, "" if it is not given.
std::string option(const mvs_driver_host *host, const char *key);

// State of the handover between the scheduler's thread and run().
enum Phase : int { kWithLibrary, kInServo, kGivenUp };

// State of one run(). The atomics are shared between threads; the other members belong to the
// scheduler's thread while it runs.
struct Loop {
  mvs_driver_servo servo = nullptr;
  void *user = nullptr;
  uint64_t sequence = 0;
  int quiet = 0;       // ticks for which the motors stay off, after a warning
  int strange = 0;     // consecutive ticks with an unexpected error
  unsigned cause = 0;  // cause of the quiet ticks
  bool enabled = false, calibrated = false, warm = false, saturated = false;
  std::atomic<uint64_t> ticks{0};
  std::atomic<int> phase{kWithLibrary};
  std::atomic<bool> ended{false};  // the last tick is done
  std::atomic<int32_t> result{MVS_DRIVER_OK};
  std::atomic<unsigned> code{0};  // the library's error that ended the run
  std::atomic<unsigned long> servo_thread{0};
  std::atomic<bool> panicked{false};  // panic(): zero from now on
};

}  // namespace phantom

struct mvs_driver_device {
  const mvs_driver_host *host = nullptr;
  std::string name;
  unsigned handle = phantom::kInvalidHandle;
  phantom::Slot *slot = nullptr;
  mvs_driver_info info = {};
  int style = 0;  // bits of CalibrationStyle
  bool has_inkwell = false, has_temperature = false, has_velocity = false;
  std::string sentence;
  bool started = false;
  bool abandoned = false;  // a callback may still come
  std::atomic<bool> running{false}, close_after{false};
  std::atomic<bool> quit{false};  // set by stop(): the next tick is the last one
  phantom::Loop loop;
};

namespace phantom {

// The functions of the driver, in device.cpp, loop.cpp and doctor.cpp.
int32_t open(const mvs_driver_host *host, const char *name, mvs_driver_device **out);
int32_t info(mvs_driver_device *device, mvs_driver_info *out);
int32_t calibrate(mvs_driver_device *device);
int32_t start(mvs_driver_device *device);
void close(mvs_driver_device *device);
int32_t run(mvs_driver_device *device, mvs_driver_servo servo, void *user);
int32_t stop(mvs_driver_device *device);
void panic(mvs_driver_device *device);
int32_t list(const mvs_driver_host *host, mvs_driver_found found, void *user);
int32_t doctor(const mvs_driver_host *host, mvs_driver_finding finding, void *user);

// One tick of the scheduler for the device `user`.
unsigned MVS_HDAPI tick(void *user);

// Calls the library on another thread with a timeout of 1 s, because a call for a disconnected
// device may hang. After a timeout broken() is true until the call returns.
void call_with_timeout(void (*call)(unsigned), unsigned argument);
bool broken();

// The error message of list, doctor and open on this thread.
std::string &last_sentence();
int32_t fail(std::string &where, int32_t code, std::string sentence) noexcept;

// Runs `body`; turns exceptions into an error code.
template <class Body>
int32_t guarded(std::string &where, Body body) noexcept {
  try {
    return body();
  } catch (const std::exception &) {
    return fail(where, MVS_DRIVER_E_INTERNAL, {});
  }
}

}  // namespace phantom
