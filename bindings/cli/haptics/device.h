// Options that select a haptic device, and a session with an open device that ends on Ctrl-C.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <string>
#include <vector>

#include "text/console.h"
#include "valve/host.h"

namespace cli {

struct DeviceOptions {
  std::string driver, device;
  std::vector<std::string> options;  // "key=value"
  double rate = 0;                   // Hz; 0: the device's default
  bool is_virtual = false;
};

// --driver and --option
CLI::Option *add_driver_options(CLI::App &command, DeviceOptions &options);
// The same with --driver required, and --device, --rate, --virtual
void add_device_options(CLI::App &command, DeviceOptions &options);

// The name of the driver, or the absolute path that the library needs.
std::string driver_of(const DeviceOptions &options);
// Calls work(). Where the library does not find a driver, its sentence gets the command that lists
// them.
template <typename Work>
auto with_list_named(const Work &work) {
  try {
    return work();
  } catch (const mvs::Error &failure) {
    if (failure.code() != MVS_E_IO) throw;
    fail(failure.code(), failure.part(), std::string(failure.what()) + " (mvs haptics list)",
         failure.line());
  }
}
// The options of the driver, one per line.
std::string lines_of(const std::vector<std::string> &options);

// Records Ctrl-C; any other fatal signal sets the forces of open devices to zero.
class Interruptions {
 public:
  Interruptions();
  ~Interruptions();
  Interruptions(const Interruptions &) = delete;
  Interruptions &operator=(const Interruptions &) = delete;

 private:
  InterruptFlag flag_;  // first: the library's handler chains to its handler
};

// An open device, and the ticks of its servo.
class Session {
 public:
  explicit Session(const DeviceOptions &options);

  mvs::Device &device() { return device_; }
  void start();
  bool is_virtual() const { return is_virtual_; }
  // s, since start().
  double elapsed() const;
  // Advances a virtual clock or sleeps. Returns the ticks during that time.
  std::vector<mvs_device_sample> pass(double seconds);
  // No more ticks follow: Ctrl-C, or forces latched off, which happens to an unarmed device only
  // when it is lost or its recording ends.
  bool is_over() const;
  bool is_interrupted() const { return InterruptFlag::is_set(); }
  // Ticks that were overwritten before they were fetched.
  uint64_t lost() const { return lost_; }
  // Zero force, motors off.
  void stop() { device_.stop(); }

 private:
  Interruptions interruptions_;  // first: outlives the device
  bool is_virtual_;
  mvs::Device device_;
  std::chrono::steady_clock::time_point begin_;
  double advanced_s_ = 0;  // of a virtual clock
  uint64_t lost_ = 0;
};

// "unplugged", and its meaning.
struct Cause {
  const char *name, *sentence;
};
Cause cause_of(uint32_t cause);

// Properties of a device.
Json info_json(const mvs_device_info &info);
std::string info_text(const mvs_device_info &info);

}  // namespace cli
