// Ramp of the prescribed nodes (annulus and papillary heads): moves them on straight lines to their
// targets in increments of bounded length, and lets them wait while the tissue is overstretched.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// One increment of the ramp.
struct BoundaryStep {
  std::vector<Vec3> displacement;  // m, by node; zero where free
  double share = 1;                // of the remaining way; 1: the increment ends at the target
  bool moves = false;

  void cancel();
};

// Sets the increment from x towards the targets at a boundary fraction. No node moves farther than
// `max_distance`, m; all nodes move the same share of their way.
void next_boundary_step(const Model &model, const std::vector<Vec3> &x, double fraction,
                        double max_distance, BoundaryStep &step);

// Whether every prescribed node is within `tolerance`, m, of its target; 0: bit for bit.
bool boundary_is_there(const Model &model, const std::vector<Vec3> &x, double fraction,
                       double tolerance);

// The ramp of a static closure.
class BoundaryRamp {
 public:
  BoundaryRamp(const Model &model, double fraction) : model_(&model), fraction_(fraction) {}

  bool is_there(const std::vector<Vec3> &x) const {
    return boundary_is_there(*model_, x, fraction_, 0);
  }
  // Whether the way to the target is so short that the valve counts as near rest.
  bool is_near(const std::vector<Vec3> &x) const;
  // Whether the boundary may move in this iteration. Tissue that stiffens exponentially and is held
  // by contact is overstretched when the boundary moves on; see settings::boundary.
  bool may_move(double residual, double rest_force);
  // Sets step() to the increment from x.
  void advance(const std::vector<Vec3> &x);
  const BoundaryStep &step() const { return step_; }
  // The position of node i, at x before, after `displacement`: the target itself, bit for bit, for
  // a prescribed node whose increment ended there in full.
  Vec3 moved(uint32_t i, const Vec3 &x, const Vec3 &displacement) const;

 private:
  const Model *model_;
  double fraction_;
  BoundaryStep step_;
  uint32_t waited_ = 0;  // iterations
};

}  // namespace mvs::core
