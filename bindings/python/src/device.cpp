#include "device.h"

#include <vector>

namespace mvs_python {

Device::Device(mvs_device_desc desc) {
  desc.struct_size = sizeof desc;
  release_and([&] { return mvs_device_open(&desc, &device_); });
}

void Device::refuse_closed() {
  refuse(MVS_E_STATE, "", "the device is closed; open it again");
}

void Device::close() {
  const py::gil_scoped_release released;
  const std::lock_guard<std::mutex> turn(turn_);
  const std::unique_lock<std::shared_mutex> alone(open_);
  mvs_device_close(std::exchange(device_, nullptr));
}

// Lock order: the simulator first, then the device.
mvs_device_report Device::sync(Simulator &sim) {
  auto report = sized<mvs_device_report>();
  bool closed = false;
  sim.call([&](mvs_sim *in_turn) {
    const std::lock_guard<std::mutex> turn(turn_);
    closed = device_ == nullptr;
    return closed ? MVS_OK : mvs_device_sync(device_, in_turn, &report);
  });
  if (closed) refuse_closed();
  return report;
}

template <typename Look>
void Device::look(Look &&work) {
  bool closed = false;
  release_and([&] {
    const std::shared_lock<std::shared_mutex> looking(open_);
    closed = device_ == nullptr;
    return closed ? MVS_OK : work();
  });
  if (closed) refuse_closed();
}

mvs_device_state Device::state() {
  auto state = sized<mvs_device_state>();
  look([&] { return mvs_device_get_state(device_, &state); });
  return state;
}

void Device::cut() {
  look([&] { return mvs_device_cut(device_); });
}

py::array_t<mvs_device_sample> Device::trace() {
  std::vector<mvs_device_sample> samples(8192);
  uint64_t count = 0;
  call([&](mvs_device *device) {
    uint64_t lost = 0;
    const mvs_result result = mvs_device_take_samples(
        device, samples.data(), sizeof(mvs_device_sample), samples.size(), &count, &lost);
    lost_ += lost;
    return result;
  });
  return py::array_t<mvs_device_sample>(static_cast<py::ssize_t>(count), samples.data());
}

uint64_t Device::lost() {
  uint64_t lost = 0;
  call([&](mvs_device *) {
    lost = lost_;
    return MVS_OK;
  });
  return lost;
}

}  // namespace mvs_python
