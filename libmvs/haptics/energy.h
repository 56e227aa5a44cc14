// Passivity observer and controller (Hannaford & Ryu, IEEE Trans. Robotics and Automation 18, 2002)
// for the link between simulation and hand. Tissue under pressure may do work on the hand; the link
// itself must not generate energy. The observer compares the work done on the hand with the work of
// the tissue model along the same path, and, when a new model replaces one, the work of the models
// with that of the simulation.
//
// A device may apply a force at once or one sample later: the observer counts the larger work.
//
// A spring K sampled at period T generates K v^2 T^2 / 2 per period. Damping takes out this energy,
// which agrees with the condition b > K T / 2 of Colgate & Schenkel (J. Robotic Systems 14, 1997),
// reduced by the damping of hand and device.
#pragma once

#include "haptics/tissue_model.h"

namespace mvs::core {

class EnergyObserver {
 public:
  // Adds the work over a displacement `step` of the hand. `sent` are the last two forces sent to
  // the motors; the tissue field has the values `before` and `now` at the ends of the step.
  void take_step(const Vec3 &step, const std::array<Vec3, 2> &sent, const Vec3 &before,
                 const Vec3 &now);
  // Adds the energy of a switch between two models of the same contact, with the hand at `hand`;
  // `share` is the rendered share of the force.
  void take_model(const TissueModel &before, const TissueModel &now, const Vec3 &hand,
                  double share);
  void forget() { energy_ = 0; }

  // Returns the damping force that dissipates the surplus energy at this velocity of the hand, with
  // at most `most` N s/m.
  Vec3 damp(const Vec3 &velocity, double dt, double most) const;
  double energy() const { return energy_; }

 private:
  double energy_ = 0;  // J, generated and not yet dissipated
};

}  // namespace mvs::core
