// The servo loop body: one sample of the hand in, one force out. Called at the device's rate, on
// the driver's thread or on ours; no lock, allocation, system call or exception.
//
// Order: validate the sample; evaluate the newest tissue model and the workspace wall; multiply by
// the share of the force gate; clamp; dissipate generated energy; limit the slew rate. The reported
// force is the force sent to the motors.
#pragma once

#include "haptics/budget.h"
#include "haptics/energy.h"
#include "haptics/force_gate.h"
#include "haptics/mailbox.h"
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
  Vec3 wanted() const;
  Vec3 rendered(const Vec3 &given, uint32_t &bits) const;
  Vec3 limited(const Vec3 &given);
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
  HeatBudget heat_;
  EnergyObserver energy_;
  TissueModel tissue_;
  Vec3 field_ = Vec3::Zero();   // rendered force of tissue and wall at the last sample
  Vec3 force_ = Vec3::Zero();   // sent to the motors last
  Vec3 before_ = Vec3::Zero();  // sent before that
  Vec3 at_ = Vec3::Zero();      // position of the hand at the last tick
  double share_ = 0;
  uint32_t bits_ = 0;  // MVS_LIMITED_*
  ServoStatus status_;
  double servo_s_ = 0;
};

}  // namespace mvs::core
