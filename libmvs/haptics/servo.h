// The servo loop body: one sample of the hand in, one force and torque out. Called at the device's
// rate, on the driver's thread or on ours; no lock, allocation, system call or exception.
//
// Order: validate the sample; evaluate the newest tissue model and the workspace wall; multiply by
// the share of the force gate; clamp; dissipate generated energy; limit the slew rate. The reported
// force is the force sent to the motors. A torque is treated as the force is, with its own limits,
// on devices that render it, and is zero on others.
#pragma once

#include "haptics/force_gate.h"
#include "haptics/force_limits.h"
#include "haptics/mailbox.h"
#include "haptics/passivity.h"
#include "haptics/sample_validator.h"

namespace mvs::core {

// The channels between the servo and other threads.
struct ServoLinks {
  Mailbox<TissueModel> tissue;           // from the simulation
  Mailbox<mvs_device_limits> limits;     // from the application
  Mailbox<ServoStatus> status;           // to the application
  Queue<ButtonEvent, 256> buttons;       // to the simulation
  Trace<mvs_device_sample, 8192> trace;  // to the application
  Requests requests;
};

class Servo {
 public:
  Servo(const DeviceTraits &traits, const mvs_device_limits &limits, ServoLinks &links);

  // Resets the servo; call before the first tick, while no thread ticks.
  void start();
  // One tick. The force is zero unless the gate is open.
  void tick(const mvs_driver_state &sample, mvs_driver_force &force);
  // Replaces a tick if the device gives no sample: latches the driver's cause, forces off.
  void lose(Cause cause);
  // Stores the duration of tick() for the next row of the trace.
  void took(double seconds) { servo_s_ = seconds; }

 private:
  void take_updates();
  void spend_heat(double dt);
  Wrench wanted(double share) const;
  Wrench bounded(const Wrench &given, uint32_t &bits) const;
  Wrench rendered(const Wrench &given, uint32_t &bits) const;
  Wrench limited(const Wrench &given);
  Vec3 slewed(const Vec3 &last, const Vec3 &next, double slew, double peak);
  double gated_size(const Wrench &field) const;
  void age(double dt);
  void write_force(mvs_driver_force &force) const;
  void publish(const mvs_driver_state &sample);
  void keep_sample(const mvs_driver_state &sample);

  const DeviceTraits *traits_;
  mvs_device_limits limits_;
  ServoLinks *links_;
  SampleValidator validator_;
  Buttons buttons_;
  ForceGate gate_;
  HeatBudget heat_, torque_heat_;
  EnergyObserver energy_;
  TissueModel tissue_;
  Wrench field_;    // rendered force of tissue and wall at the last sample
  Wrench sent_;     // to the motors last
  Wrench before_;   // sent before that
  Placement last_;  // of the hand at the last tick
  double share_ = 0;
  double onset_ = 1;    // share of the force of a new grasp, on its ramp
  double working_ = 1;  // share of a force that does work on the hand
  uint32_t bits_ = 0;   // MVS_LIMITED_*
  ServoStatus status_;
  double servo_s_ = 0;
};

}  // namespace mvs::core
