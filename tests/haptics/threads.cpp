// On a real clock: the servo's thread, one that hands over models, one that reads, one that cuts.
// This test serves the thread sanitizer (cmake --preset tsan).
#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "tests/haptics/loop.h"

using namespace mvs::core;
using std::chrono::milliseconds;

namespace {

void hand_over(Device &device) {
  device.links().tissue.post(spring(100));
  mvs_device_limits limits = {};
  limits.ramp_s = 0.1;
  device.set_limits(limits);
  mvs_device_sample sample;
  uint64_t lost = 0;
  while (device.links().trace.pop(sample, lost)) {
  }
  ButtonEvent event;
  while (device.links().buttons.pop(event)) {
  }
}

}  // namespace

TEST_CASE("a servo, a simulation, a window and an emergency stop share a device") {
  mvs_device_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.driver = MVS_DRIVERS_DIR "/hand.so";
  desc.options = "device=touch\namplitude=0.005,0,0\nfrequency=2";
  Device device(desc, {});
  device.start();
  while (device.status().ticks < 20) std::this_thread::sleep_for(milliseconds(1));
  device.arm();
  std::atomic<bool> over{false};
  std::thread looks([&] {
    while (!over) {
      (void)device.status();
      (void)device.info();
    }
  });
  std::thread cuts([&] {
    std::this_thread::sleep_for(milliseconds(300));
    device.cut();
  });
  for (int k = 0; k < 50; ++k) {
    hand_over(device);
    std::this_thread::sleep_for(milliseconds(10));
  }
  over = true;
  looks.join();
  cuts.join();
  const ServoStatus now = device.status();
  CHECK_EQ(now.phase, DevicePhase::latched);
  CHECK(now.force.isZero(0));
  CHECK_GT(now.ticks, 100);
  device.stop();
  device.start();
  device.stop();
}
