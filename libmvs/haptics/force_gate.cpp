// Gate, ramp, fade and latch.
#include "haptics/force_gate.h"

#include <algorithm>

namespace mvs::core {
namespace {

constexpr uint32_t quiet_ticks = 3;   // ticks below the gate before the ramp begins
constexpr double fade_in_factor = 4;  // fade-in time over fade-out time

}  // namespace

void ForceGate::start() {
  phase_ = DevicePhase::off;
  cause_ = Cause::nothing;
  armed_ = requests_->armed_.load(std::memory_order_relaxed);
  requests_->cut_.store(Cause::nothing, std::memory_order_relaxed);
}

double ForceGate::share(const Facts &facts, const mvs_device_limits &limits) {
  take_requests();
  if (is_armed() && facts.cause != Cause::nothing) latch(facts.cause);
  if (!is_armed()) return 0;
  pass_gate(facts, limits);
  fade(facts, limits);
  if (phase_ == DevicePhase::waiting) return 0;
  phase_ = fade_ < 1 ? DevicePhase::faded : ramp_ < 1 ? DevicePhase::ramping : DevicePhase::on;
  return ramp_ * fade_;
}

// If both arm and cut were requested since the last tick, cut wins.
void ForceGate::take_requests() {
  const uint32_t armed = requests_->armed_.load(std::memory_order_relaxed);
  if (armed != armed_) {
    armed_ = armed;
    if (!is_armed()) {
      phase_ = DevicePhase::waiting;
      cause_ = Cause::nothing;
      quiet_ = 0;
    }
  }
  const Cause cut = requests_->cut_.exchange(Cause::nothing, std::memory_order_relaxed);
  if (cut != Cause::nothing && phase_ != DevicePhase::latched) latch(cut);
}

void ForceGate::latch(Cause cause) {
  phase_ = DevicePhase::latched;
  cause_ = cause;
  ramp_ = 0;
}

void ForceGate::pass_gate(const Facts &facts, const mvs_device_limits &limits) {
  if (phase_ == DevicePhase::waiting) {
    // without a model nothing is known of the force that begins with it
    quiet_ = facts.may_feel && facts.wanted < limits.gate ? quiet_ + 1 : 0;
    if (quiet_ < quiet_ticks) return;
    phase_ = DevicePhase::ramping;
    ramp_ = 0;
    fade_ = 1;
  }
  ramp_ = std::min(1.0, ramp_ + facts.dt / limits.ramp_s);
}

void ForceGate::fade(const Facts &facts, const mvs_device_limits &limits) {
  if (facts.may_feel) {
    fade_ = std::min(1.0, fade_ + facts.dt / (fade_in_factor * limits.fade_s));
  } else {
    fade_ = std::max(0.0, fade_ - facts.dt / limits.fade_s);
  }
}

}  // namespace mvs::core
