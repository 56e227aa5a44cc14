// A haptic device on the command line: which one, open and turning, until Ctrl-C.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <string>
#include <vector>

#include "console.h"

namespace cli {

struct DeviceOptions {
  std::string driver, device;
  std::vector<std::string> options;  // "key=value"
  double rate = 0;                   // Hz; 0: the device's own
  bool is_virtual = false;
};

// --driver and --option, of whoever asks a driver.
CLI::Option *add_driver_options(CLI::App &command, DeviceOptions &options);
// The same with --driver required, and --device, --rate, --virtual, of whoever opens a device.
void add_device_options(CLI::App &command, DeviceOptions &options);

// A path is made absolute, as the library wants it; a name stays.
std::string driver_of(const DeviceOptions &options);
// One line each.
std::string lines_of(const std::vector<std::string> &options);

// Notes Ctrl-C instead of ending; whatever else ends the process, open devices get zero force.
class Interruptions {
 public:
  Interruptions();
  ~Interruptions();
  Interruptions(const Interruptions &) = delete;
  Interruptions &operator=(const Interruptions &) = delete;

  bool came() const;

 private:
  void (*old_handler_)(int);
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
  // Lets time pass: turns a virtual clock, sleeps through a real one. Returns the ticks in it.
  std::vector<mvs_device_sample> pass(double seconds);
  // Nothing comes any more: interrupted, or forces latched off, which an unarmed device does only
  // when it is lost or over.
  bool is_over() const;
  bool is_interrupted() const { return interruptions_.came(); }
  // Ticks that were overwritten before they were fetched.
  uint64_t lost() const { return lost_; }
  // Zero force, motors off.
  void stop() { device_.stop(); }

 private:
  Interruptions interruptions_;  // first: still there when the device closes
  bool is_virtual_;
  mvs::Device device_;
  std::chrono::steady_clock::time_point begin_;
  double turned_ = 0;
  uint64_t lost_ = 0;
};

// "unplugged", and what it means.
struct Cause {
  const char *name, *sentence;
};
Cause cause_of(uint32_t cause);

// What a device is.
Json info_json(const mvs_device_info &info);
std::string info_text(const mvs_device_info &info);

}  // namespace cli
