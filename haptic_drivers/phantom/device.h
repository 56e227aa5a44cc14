// An open device, and what all of them share: the library, its one scheduler, its stack of errors.
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
// What the vendor's set-up program calls the first one; older ones said "Default PHANTOM".
inline constexpr const char *kDefaultDevice = "Default Device";

// A device as another device's callback sees it. Never freed: it may have been closed meanwhile.
struct Slot {
  std::atomic<unsigned> handle{kInvalidHandle};  // kInvalidHandle: the slot is free
  std::atomic<unsigned> posted{0};  // the newest error of this device that another one came upon
};

struct Shared {
  std::mutex mutex;         // of everything here but the slots
  void *library = nullptr;  // never closed: HDAPI does not bear to be loaded twice
  std::string path;
  Hdapi hd = {};
  int running = 0;  // calls of run(): the scheduler goes while there is one
  std::shared_ptr<std::atomic<bool>> returned;  // false: a call has not come back, see broken()
  Slot slots[kMaxDevices];
};
Shared &shared();
inline const Hdapi &hd() {
  return shared().hd;
}

// The slot of a device that is open here, null if it is not.
Slot *slot_of(unsigned handle);

// Loads the library that the options name, or the first that is found. The mutex is held.
int32_t load(const mvs_driver_host *host, std::string &sentence);
// "" if it was not given.
std::string option(const mvs_driver_host *host, const char *key);

// Who may be in the loop: see run().
enum Phase : int { kWithLibrary, kInServo, kGivenUp };

// What a run holds. Its atomics are seen by the scheduler's thread and by others, the rest only by
// the scheduler's while it goes.
struct Loop {
  mvs_driver_servo servo = nullptr;
  void *user = nullptr;
  uint64_t sequence = 0;
  int quiet = 0;       // ticks for which the motors stay off, after a warning
  int strange = 0;     // ticks in a row with an error that should not come
  unsigned cause = 0;  // of the quiet
  bool enabled = false, calibrated = false, warm = false, saturated = false;
  std::atomic<uint64_t> ticks{0};
  std::atomic<int> phase{kWithLibrary};
  std::atomic<bool> ended{false};  // there are no more ticks
  std::atomic<int32_t> result{MVS_DRIVER_OK};
  std::atomic<unsigned> code{0};  // the library's error that ended it
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
  int style = 0;  // of its calibration, bits
  bool has_inkwell = false, has_temperature = false, has_velocity = false;
  std::string sentence;
  bool started = false;
  bool abandoned = false;  // a callback may still come
  std::atomic<bool> running{false}, close_after{false};
  std::atomic<bool> quit{false};  // stop(): the next tick is the last one
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

// One tick of the scheduler, for the device `user`.
unsigned MVS_HDAPI tick(void *user);

// Calls the library, which may never come back from a device that is gone: after a second it goes
// on without, and the library is broken until it does come back.
void call_patiently(void (*call)(unsigned), unsigned argument);
bool broken();

// The sentence of list, doctor and open, on this thread.
std::string &last_sentence();
int32_t fail(std::string &where, int32_t code, std::string sentence) noexcept;

// Runs `body`, lets nothing out.
template <class Body>
int32_t guarded(std::string &where, Body body) noexcept {
  try {
    return body();
  } catch (const std::exception &) {
    return fail(where, MVS_DRIVER_E_INTERNAL, {});
  }
}

}  // namespace phantom
