// Haptic devices for C++17. Part of mvs/mvs.hpp.
#ifndef MVS_DEVICE_HPP
#define MVS_DEVICE_HPP

#include <mvs/device.h>
#include <mvs/base.hpp>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace mvs {

// An installed driver.
struct Driver {
  std::string name, path;
};

// A connected device: its name for mvs_device_desc, and its model.
struct FoundDevice {
  std::string name, model;
};

// One check of a driver's doctor; `verdict` is 1 passed, 0 a fault, -1 a warning, 2 a note.
struct DriverFinding {
  std::int32_t verdict;
  std::string check, sentence;
};

// Returns the drivers in the folder beside the library.
inline std::vector<Driver> drivers() {
  std::uint32_t count = 0;
  must(mvs_get_driver_count(&count));
  std::vector<Driver> found;
  for (std::uint32_t k = 0; k < count; ++k) {
    const char *name = nullptr, *path = nullptr;
    must(mvs_get_driver(k, &name, &path));
    found.push_back({name, path});
  }
  return found;
}

// Returns the devices that a driver finds; `options` are "key=value" lines.
inline std::vector<FoundDevice> devices_of(const std::string &driver,
                                           const std::string &options = "") {
  std::vector<FoundDevice> found;
  must(mvs_device_list(
      driver.c_str(), options.c_str(),
      [](void *to, const char *name, const char *model) {
        static_cast<std::vector<FoundDevice> *>(to)->push_back({name, model});
      },
      &found));
  return found;
}

// Returns all checks of a driver's doctor; "": of every installed driver.
inline std::vector<DriverFinding> findings_of(const std::string &driver = "",
                                              const std::string &options = "") {
  std::vector<DriverFinding> found;
  must(mvs_device_doctor(
      driver.empty() ? nullptr : driver.c_str(), options.empty() ? nullptr : options.c_str(),
      [](void *to, std::int32_t verdict, const char *check, const char *sentence) {
        static_cast<std::vector<DriverFinding> *>(to)->push_back({verdict, check, sentence});
      },
      &found));
  return found;
}

// An open device, owned; its destructor stops it.
class Device {
 public:
  explicit Device(mvs_device_desc desc) {
    desc.struct_size = sizeof desc;
    must(mvs_device_open(&desc, &device_));
  }
  Device(Device &&other) noexcept : device_(std::exchange(other.device_, nullptr)) {}
  Device &operator=(Device &&other) noexcept {
    std::swap(device_, other.device_);
    return *this;
  }
  Device(const Device &) = delete;
  Device &operator=(const Device &) = delete;
  ~Device() { mvs_device_close(device_); }

  mvs_device *get() const { return device_; }

  mvs_device_info info() const { return filled<mvs_device_info>(mvs_device_get_info, device_); }

  void set_limits(mvs_device_limits limits) {
    limits.struct_size = sizeof limits;
    must(mvs_device_set_limits(device_, &limits));
  }
  mvs_device_limits limits() const {
    return filled<mvs_device_limits>(mvs_device_get_limits, device_);
  }

  void set_view(mvs_device_view view) {
    view.struct_size = sizeof view;
    must(mvs_device_set_view(device_, &view));
  }
  mvs_device_view view() const { return filled<mvs_device_view>(mvs_device_get_view, device_); }

  // Sets the stride of the bodies as well.
  void set_hand(mvs_device_hand hand) {
    hand.struct_size = sizeof hand;
    hand.body_stride = sizeof(mvs_body_desc);
    must(mvs_device_set_hand(device_, &hand));
  }
  mvs_device_hand hand() const { return filled<mvs_device_hand>(mvs_device_get_hand, device_); }

  void start() { must(mvs_device_start(device_)); }
  void stop() { must(mvs_device_stop(device_)); }
  void arm() { must(mvs_device_arm(device_)); }
  // From any thread.
  void cut() { must(mvs_device_cut(device_)); }
  void advance(double seconds) { must(mvs_device_advance(device_, seconds)); }

  // To be called before each step of the simulator, mvs::Simulator::get().
  mvs_device_report sync(mvs_sim *sim) {
    return filled<mvs_device_report>(mvs_device_sync, device_, sim);
  }

  // From any thread.
  mvs_device_state state() const { return filled<mvs_device_state>(mvs_device_get_state, device_); }

  // Takes the ticks since the last call; adds the number of ticks lost by overflow to `lost`.
  std::vector<mvs_device_sample> take_samples(std::uint64_t &lost) {
    std::vector<mvs_device_sample> samples(8192);
    std::uint64_t count = 0, missed = 0;
    must(mvs_device_take_samples(device_, samples.data(), sizeof samples[0], samples.size(), &count,
                                 &missed));
    lost += missed;
    samples.resize(count);
    return samples;
  }

 private:
  mvs_device *device_ = nullptr;
};

}  // namespace mvs

#endif
