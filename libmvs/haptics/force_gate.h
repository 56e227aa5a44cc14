// Force gate: the share of the force that is rendered. Forces begin below a threshold and rise
// along a ramp, fade while the simulation is stale, and stay zero after a latched fault.
#pragma once

#include <atomic>

#include "haptics/servo_types.h"

namespace mvs::core {

// The inputs of the gate for one tick.
struct Facts {
  Cause cause = Cause::nothing;  // a reason to latch
  bool may_feel = false;         // tissue model is fresh and the device is not parked
  double wanted = 0;  // N, norm of the unlimited force, or of the torque at the device's lever
  double dt = 0;      // s
};

// Requests of the application, from any thread.
class Requests {
 public:
  void arm() { armed_.fetch_add(1, std::memory_order_relaxed); }
  void cut(Cause cause) { cut_.store(cause, std::memory_order_relaxed); }

 private:
  friend class ForceGate;
  std::atomic<uint32_t> armed_{0};
  std::atomic<Cause> cut_{Cause::nothing};
};

class ForceGate {
 public:
  explicit ForceGate(Requests &requests) : requests_(&requests) {}

  // Advances by one tick and returns the share of the force to render, 0 to 1.
  double share(const Facts &facts, const mvs_device_limits &limits);
  void start();

  DevicePhase phase() const { return phase_; }
  Cause cause() const { return cause_; }
  bool is_armed() const { return phase_ >= DevicePhase::waiting && phase_ != DevicePhase::latched; }

 private:
  void take_requests();
  void latch(Cause cause);
  void pass_gate(const Facts &facts, const mvs_device_limits &limits);
  void fade(const Facts &facts, const mvs_device_limits &limits);

  Requests *requests_;
  DevicePhase phase_ = DevicePhase::stopped;
  Cause cause_ = Cause::nothing;
  uint32_t armed_ = 0, quiet_ = 0;  // requests taken; ticks below the gate
  double ramp_ = 0, fade_ = 1;
};

}  // namespace mvs::core
