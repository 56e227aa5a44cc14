// The handler: zero forces, then what would have happened without it.
#include "haptics/signal_handler.h"

#include <signal.h>

#include <array>
#include <atomic>
#include <mutex>

#include "base/error.h"

namespace mvs::core {
namespace {

constexpr std::array<int, 7> fatal = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGINT};

// A signal handler may look at lock-free atomics and nothing else.
struct Started {
  std::atomic<mvs_driver_device *> device{nullptr};
  std::atomic<void (*)(mvs_driver_device *)> panic{nullptr};
};
std::array<Started, 32> started;
std::mutex registering;
std::array<struct sigaction, fatal.size()> before;
bool watching = false;

void zero_all(int signal) {
  for (Started &one : started) {
    mvs_driver_device *const device = one.device.load();
    const auto panic = one.panic.load();
    if (device && panic) panic(device);
  }
  for (size_t k = 0; k < fatal.size(); ++k) {
    if (fatal[k] == signal) sigaction(signal, &before[k], nullptr);
  }
  raise(signal);
}

}  // namespace

void guard_from_crashes(const mvs_driver_api &api, mvs_driver_device *device) {
  if (!api.panic) return;
  const std::lock_guard<std::mutex> lock(registering);
  for (Started &one : started) {
    if (one.device.load()) continue;
    one.panic = api.panic;
    one.device = device;
    return;
  }
  fail(MVS_E_MEMORY, "device", "more than %zu devices are started at a time", started.size());
}

void forget_from_crashes(mvs_driver_device *device) {
  const std::lock_guard<std::mutex> lock(registering);
  for (Started &one : started) {
    if (one.device.load() == device) one.device = nullptr;
  }
}

void watch_for_crashes(bool on) {
  const std::lock_guard<std::mutex> lock(registering);
  if (on == watching) return;
  watching = on;
  for (size_t k = 0; k < fatal.size(); ++k) {
    if (!on) {
      sigaction(fatal[k], &before[k], nullptr);
      continue;
    }
    struct sigaction action = {};
    action.sa_handler = zero_all;
    sigemptyset(&action.sa_mask);
    sigaction(fatal[k], &action, &before[k]);
  }
}

}  // namespace mvs::core
