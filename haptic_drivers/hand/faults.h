// Faults of a simulated device, for tests of the safety functions.
#pragma once

#include <mvs/driver.h>

#include "common/options.h"

namespace hand {

enum class Fault {
  kNone,
  kNanPosition,
  kInfVelocity,
  kJump,
  kUnplug,
  kSilent,
  kStuckButton,
  kBounce,
  kUncalibrated,
  kHot,
  kSaturated,
  kDeadman,
  kClockBack,
  kClockJump,
  kSlow,
  kButton,
  kAbsent,
  kLicence
};

struct Faults {
  Fault kind = Fault::kNone;
  double from = 0, until = 0;  // s since start()

  bool now(Fault asked, double time) const { return kind == asked && time >= from && time < until; }
  // Returns whether the motors are off regardless of the written force.
  bool limp(double time) const { return now(Fault::kHot, time) || now(Fault::kButton, time); }
};

// Reads the options fault, fault_at and fault_for; throws a Refusal.
Faults faults(const driver::Options &options);

// Applies the faults to the state of a good device at `time`; `before` is the previous state.
void spoil(const Faults &faults, double time, const mvs_driver_state &before,
           mvs_driver_state &state);

}  // namespace hand
