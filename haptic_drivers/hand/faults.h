// What goes wrong with a simulated device, to test that libmvs keeps the hand safe.
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
  // The motors are off whatever is written.
  bool limp(double time) const { return now(Fault::kHot, time) || now(Fault::kButton, time); }
};

// From the options fault, fault_at and fault_for; throws a Refusal.
Faults faults(const driver::Options &options);

// Spoils what a good device would have said at `time`; `before` is what it said last.
void spoil(const Faults &faults, double time, const mvs_driver_state &before,
           mvs_driver_state &state);

}  // namespace hand
