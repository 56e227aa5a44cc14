// Names and effects of faults.
#include "faults.h"

#include <limits>

namespace hand {

namespace {

struct Named {
  const char *name;
  Fault fault;
};

constexpr Named kFaults[] = {
    {"nan_position", Fault::kNanPosition},
    {"inf_velocity", Fault::kInfVelocity},
    {"jump", Fault::kJump},
    {"unplug", Fault::kUnplug},
    {"silent", Fault::kSilent},
    {"stuck_button", Fault::kStuckButton},
    {"bounce", Fault::kBounce},
    {"uncalibrated", Fault::kUncalibrated},
    {"hot", Fault::kHot},
    {"saturated", Fault::kSaturated},
    {"deadman", Fault::kDeadman},
    {"clock_back", Fault::kClockBack},
    {"clock_jump", Fault::kClockJump},
    {"slow", Fault::kSlow},
    {"button", Fault::kButton},
    {"absent", Fault::kAbsent},
    {"licence", Fault::kLicence},
};

Fault fault_of(const std::string &name) {
  std::string names;
  for (const Named &known : kFaults) {
    if (name == known.name) return known.fault;
    names += std::string(names.empty() ? "" : ", ") + known.name;
  }
  driver::refuse(MVS_DRIVER_E_OPTION, "option fault=" + name + ": give one of " + names);
}

constexpr double kJump = 0.05;              // m
constexpr uint64_t kBack = 1000000000;      // ns
constexpr uint64_t kForward = 10000000000;  // ns

}  // namespace

Faults faults(const driver::Options &options) {
  Faults out;
  const auto name = options.text("fault");
  if (!name && (options.given("fault_at") || options.given("fault_for")))
    driver::refuse(MVS_DRIVER_E_OPTION, "option fault_at, fault_for: of which fault? Give fault");
  if (!name) return out;
  out.kind = fault_of(*name);
  out.from = options.number("fault_at", 0, 0, 1e6);
  const double lasting = options.number("fault_for", 0, 0, 1e6);
  out.until = lasting > 0 ? out.from + lasting : std::numeric_limits<double>::infinity();
  return out;
}

void spoil(const Faults &faults, double time, const mvs_driver_state &before,
           mvs_driver_state &state) {
  if (!faults.now(faults.kind, time)) return;
  switch (faults.kind) {
    case Fault::kNanPosition:
      state.position[0] = std::numeric_limits<double>::quiet_NaN();
      break;
    case Fault::kInfVelocity:
      state.velocity[1] = std::numeric_limits<double>::infinity();
      state.flags |= MVS_DRIVER_FLAG_VELOCITY;
      break;
    case Fault::kJump:
      state.position[0] += kJump;
      break;
    case Fault::kSilent:
      if (before.sequence > 0) state = before;
      break;
    case Fault::kStuckButton:
      state.buttons |= 1;
      break;
    case Fault::kBounce:
      state.buttons = (state.buttons & ~1u) | (state.sequence & 1);
      break;
    case Fault::kUncalibrated:
      state.flags &= ~uint32_t(MVS_DRIVER_FLAG_CALIBRATED);
      break;
    case Fault::kHot:
      state.flags |= MVS_DRIVER_FLAG_WARM;
      state.cause = MVS_CAUSE_THERMAL;
      break;
    case Fault::kSaturated:
      state.flags |= MVS_DRIVER_FLAG_SATURATED;
      break;
    case Fault::kDeadman:
      state.flags &= ~uint32_t(MVS_DRIVER_FLAG_HELD);
      break;
    case Fault::kClockBack:
      state.time_ns -= std::min(state.time_ns, kBack);
      break;
    case Fault::kClockJump:
      state.time_ns += kForward;
      break;
    case Fault::kButton:
      state.cause = MVS_CAUSE_BUTTON;
      break;
    default:  // faults of open() and of the duration of read()
      break;
  }
}

}  // namespace hand
