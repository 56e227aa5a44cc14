// Handler for fatal signals: sends zero force to all started devices, then restores the previous
// handler and raises the signal again.
#include "haptics/signal_handler.h"

#include <signal.h>

#include <array>
#include <atomic>
#include <mutex>

#include "base/error.h"

namespace mvs::core {
namespace {

constexpr std::array<int, 7> fatal = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGINT};

// Lock-free atomics, because a signal handler may read nothing else.
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

void register_device(const mvs_driver_api &api, mvs_driver_device *device) {
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

void unregister_device(mvs_driver_device *device) {
  const std::lock_guard<std::mutex> lock(registering);
  for (Started &one : started) {
    if (one.device.load() == device) one.device = nullptr;
  }
}

void install_signal_handler(bool on) {
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
