// Energy that the sampled loop makes, and its damping: a passivity observer and controller
// (Hannaford & Ryu, IEEE Trans. Robotics and Automation 18, 2002) on what lies between the
// simulation and the hand. Tissue under pressure may well work on the hand; what must not is the
// link. So the observer compares the work that the hand was given with the work that the model
// gives on the same way, and with that of the simulation when a new model replaces one.
//
// Whether a device acts on a force at once or a sample later nobody knows: what is worse is
// counted.
//
// A spring K, held for a period T, makes K v^2 T^2 / 2 a period, in and out: damping takes out just
// what Colgate & Schenkel ask for (J. Robotic Systems 14, 1997), b > K T / 2, and only what the
// hand and the device do not.
#pragma once

#include "haptics/tissue_model.h"

namespace mvs::core {

class EnergyObserver {
 public:
  // The hand went `step` under the force told last, or the one before it; the field gave `before`
  // and `now` at its ends.
  void take_step(const Vec3 &step, const std::array<Vec3, 2> &told, const Vec3 &before,
                 const Vec3 &now);
  // Another model of the same contact, with the hand at `hand`; `share` of the force is rendered.
  void take_model(const TissueModel &before, const TissueModel &now, const Vec3 &hand,
                  double share);
  void forget() { energy_ = 0; }

  // The force that takes out what there is too much of, from a hand at this velocity, within `most`
  // N s/m.
  Vec3 damp(const Vec3 &velocity, double dt, double most) const;
  double energy() const { return energy_; }

 private:
  double energy_ = 0;  // J, made and not yet taken out
};

}  // namespace mvs::core
