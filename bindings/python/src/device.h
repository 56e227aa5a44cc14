// mvs.Device: one haptic device of the C library, safe to use from any Python thread.
#pragma once

#include <mvs/device.h>
#include <pybind11/numpy.h>

#include <mutex>
#include <shared_mutex>

#include "simulator.h"

namespace mvs_python {

// Calls release the interpreter and run one at a time; `state` and `cut` are allowed at any time.
class Device {
 public:
  explicit Device(mvs_device_desc desc);
  ~Device() { close(); }
  Device(const Device &) = delete;
  Device &operator=(const Device &) = delete;

  void close();
  // Runs work(mvs_device *) when no other call is at work.
  template <typename Call>
  void call(Call &&work) {
    bool closed = false;
    release_and([&] {
      const std::lock_guard<std::mutex> turn(turn_);
      closed = device_ == nullptr;
      return closed ? MVS_OK : work(device_);
    });
    if (closed) refuse_closed();
  }
  mvs_device_report sync(Simulator &sim);
  mvs_device_state state();
  void cut();
  py::array_t<mvs_device_sample> trace();
  uint64_t lost();

 private:
  [[noreturn]] static void refuse_closed();
  template <typename Look>
  void look(Look &&work);

  mvs_device *device_ = nullptr;
  uint64_t lost_ = 0;  // ticks overwritten before trace() read them
  std::mutex turn_;
  std::shared_mutex open_;  // shared by `look`, exclusive for closing
};

void bind_device(py::module_ &module);

}  // namespace mvs_python
