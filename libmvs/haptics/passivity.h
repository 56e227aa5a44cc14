// Passivity observer and controller (Hannaford & Ryu, IEEE Trans. Robotics and Automation 18, 2002)
// for the link between simulation and hand. Tissue under pressure may do work on the hand; the link
// itself must not generate energy. The observer compares the work done on the hand with the work of
// the tissue model along the same path, and, when a new model replaces one, the work of the models
// with that of the simulation. Work of torques along rotations counts with that of forces: a stiff
// rod moves energy from one to the other.
//
// A device may apply a force at once or one sample later: the observer counts the larger work.
//
// A spring K sampled at period T generates K v^2 T^2 / 2 per period. Damping takes out this energy,
// which agrees with the condition b > K T / 2 of Colgate & Schenkel (J. Robotic Systems 14, 1997),
// reduced by the damping of hand and device; for rotations likewise.
//
// A late simulation with a stiff tool generates more than the damping of a device can take out: the
// force is then that of a model of tissue which has moved since. So a surplus also takes away the
// work that the force does on the hand: a force along the motion is reduced, one against it is not.
// A still hand feels the whole force, and the energy on the hand is bounded.
#pragma once

#include "haptics/tissue_model.h"

namespace mvs::core {

// A displacement, m, and a rotation vector, rad, of the hand; or its velocity, m/s and rad/s.
struct Twist {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};

// Largest damping of a device, N s/m and N m s/rad.
struct Damping {
  double linear = 0, angular = 0;
};

class EnergyObserver {
 public:
  // Adds the work over a displacement `step` of the hand. `sent` are the last two wrenches sent to
  // the motors; the tissue field has the values `before` and `now` at the ends of the step.
  void take_step(const Twist &step, const std::array<Wrench, 2> &sent, const Wrench &before,
                 const Wrench &now);
  // Adds the energy of a switch between two models of the same contact, with the hand at `hand`;
  // `share` is the rendered share of the force.
  void take_model(const TissueModel &before, const TissueModel &now, const Placement &hand,
                  double share);
  void forget() { energy_ = 0; }

  // Returns the damping that dissipates the surplus energy at this velocity of the hand, at most
  // `most`. Force and torque are in the ratio of these limits.
  Wrench damp(const Twist &velocity, double dt, const Damping &most) const;
  // Returns the share of a wrench that is rendered at this velocity of the hand: 1 for one that
  // does no work on it, or while the surplus is at most `most`, J; 0 for one along a fast motion
  // while it is twice that or more.
  double working_share(const Wrench &wrench, const Twist &velocity, double most) const;
  double energy() const { return energy_; }

 private:
  double energy_ = 0;  // J, generated and not yet dissipated
};

}  // namespace mvs::core
