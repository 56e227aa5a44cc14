// The servo: a sample of the hand in, a force out. Called at the device's rate, on its thread or on
// one of ours; no lock, no allocation, no system call, no exception.
//
// In this order: distrust the sample; evaluate the newest tissue and the workspace's wall; share of
// the guard; clamp; take out energy that the loop has made; limit the slew. What is told is what
// was really asked of the motors.
#pragma once

#include "haptics/budget.h"
#include "haptics/energy.h"
#include "haptics/force_gate.h"
#include "haptics/mailbox.h"
#include "haptics/sample_validator.h"

namespace mvs::core {

// What other threads share with the servo.
struct ServoLinks {
  Mailbox<TissueModel> tissue;           // from the simulation
  Mailbox<mvs_device_limits> limits;     // from the application
  Mailbox<ServoStatus> status;           // to whoever looks
  Queue<ButtonEvent, 256> buttons;       // to the simulation
  Trace<mvs_device_sample, 8192> trace;  // to the application
  Requests requests;
};

class Servo {
 public:
  Servo(const DeviceTraits &traits, const mvs_device_limits &limits, ServoLinks &links);

  // Before the first tick, while no thread ticks.
  void start();
  // One tick; the force is zero wherever it may not be anything else.
  void tick(const mvs_driver_state &sample, mvs_driver_force &force);
  // Instead of a tick, when there is no sample: the driver's reason, forces off.
  void lose(uint32_t cause);
  // How long tick() took, for the trace; of the tick before.
  void took(double seconds) { servo_s_ = seconds; }

 private:
  void take_news();
  Vec3 wanted() const;
  Vec3 rendered(const Vec3 &given, uint32_t &bits) const;
  Vec3 limited(const Vec3 &given);
  void age(double dt);
  void tell(mvs_driver_force &force) const;
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
  Vec3 field_ = Vec3::Zero();   // what tissue and wall give at the last sample, as it is rendered
  Vec3 force_ = Vec3::Zero();   // what the motors were told last
  Vec3 before_ = Vec3::Zero();  // and before that
  Vec3 at_ = Vec3::Zero();      // where the hand was at the last tick
  double share_ = 0;
  uint32_t bits_ = 0;  // MVS_LIMITED_*
  ServoStatus status_;
  double servo_s_ = 0;
};

}  // namespace mvs::core
