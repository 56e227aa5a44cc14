// Inputs and outputs of the servo: device traits, hand pose, button event, status.
#pragma once

#include <mvs/device.h>

#include <Eigen/Geometry>

#include "haptics/tissue_model.h"

namespace mvs::core {

// The numbers are those of the C interface and of drivers. A cause is the reason of a latch.
enum class Cause : uint32_t {
  nothing = MVS_CAUSE_NONE,
  button = MVS_CAUSE_BUTTON,
  velocity = MVS_CAUSE_VELOCITY,
  watchdog = MVS_CAUSE_WATCHDOG,
  software = MVS_CAUSE_SOFTWARE,
  unplugged = MVS_CAUSE_UNPLUGGED,
  deadman = MVS_CAUSE_DEADMAN,
  not_finite = MVS_CAUSE_NOT_FINITE,
  thermal = MVS_CAUSE_THERMAL,
  calibration = MVS_CAUSE_CALIBRATION
};

enum class DevicePhase : uint32_t {
  stopped = MVS_DEVICE_PHASE_STOPPED,
  off = MVS_DEVICE_PHASE_OFF,
  waiting = MVS_DEVICE_PHASE_WAITING,
  ramping = MVS_DEVICE_PHASE_RAMPING,
  on = MVS_DEVICE_PHASE_ON,
  faded = MVS_DEVICE_PHASE_FADED,
  latched = MVS_DEVICE_PHASE_LATCHED
};

enum class DeviceClock : uint32_t { real = MVS_CLOCK_REAL, virtual_time = MVS_CLOCK_VIRTUAL };

// A device as its driver describes it, checked and completed; m, N, s, in the frame of the device.
struct DeviceTraits {
  mvs_device_info info = {};
  bool has_deadman = false;
  // from the driver's coordinates to the frame of the device: p' = turn p + shift
  Mat3 turn = Mat3::Identity();
  Eigen::Quaterniond turn_quaternion = Eigen::Quaterniond::Identity();
  Vec3 shift = Vec3::Zero();
  bool has_workspace = false;
  // It measures orientation and has motors for torque; every limit of torque is 0 without.
  bool renders_torque = false;
};

// 1/s, times the largest force or torque: the default of the rate at which it changes.
inline constexpr double default_slew = 100;

// Checks a driver's description; throws MVS_E_DEVICE for numbers out of range.
DeviceTraits read_traits(const mvs_driver_info &given, const char *driver);

// Returns the limits with defaults filled in; throws MVS_E_ARGUMENT.
mvs_device_limits resolve_limits(const mvs_device_limits &given, const mvs_device_info &info);

// The pose of the hand, in the frame of the device.
struct HandPose {
  Vec3 position = Vec3::Zero(), velocity = Vec3::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Vec3 spin = Vec3::Zero();  // rad/s, estimated; of devices that render torque
  double gripper = 0;

  Placement placement() const { return {position, orientation}; }
};

// A change of the buttons.
struct ButtonEvent {
  uint32_t buttons = 0;
  uint64_t number = 0;  // of the change, since the start
  Vec3 position = Vec3::Zero();
};

// The status of the servo after a tick.
struct ServoStatus {
  DevicePhase phase = DevicePhase::stopped;
  Cause cause = Cause::nothing, device_cause = Cause::nothing;
  uint32_t flags = 0, limited = 0, buttons = 0;
  uint64_t button_changes = 0;  // since the start, with those whose event found the queue full
  bool has_pose = false;        // a valid sample was read since the start: `pose` is its
  HandPose pose;
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  double time = 0, rate = 0, worst_period = 0, model_age = 0, energy = 0, heat = 0;
  uint64_t ticks = 0, late = 0;
  uint64_t bad_samples = 0;
  uint32_t sample_faults = 0;  // MVS_SAMPLE_FAULT_* since the start
};

}  // namespace mvs::core
