// Increments of the prescribed nodes.
#include "solve/static/boundary_ramp.h"

#include <algorithm>

#include "solve/settings.h"

namespace mvs::core {

void BoundaryStep::cancel() {
  moves = false;
  std::fill(displacement.begin(), displacement.end(), Vec3::Zero());
}

void next_boundary_step(const Model &model, const std::vector<Vec3> &x, double fraction,
                        double max_distance, BoundaryStep &step) {
  step.displacement.assign(x.size(), Vec3::Zero());
  double farthest = 0;
  for (uint32_t i = 0; i < x.size(); ++i) {
    if (!model.topology.fixed[i]) continue;
    step.displacement[i] = model.target(i, fraction) - x[i];
    farthest = std::max(farthest, step.displacement[i].norm());
  }
  step.moves = farthest > 0;
  step.share = farthest > max_distance ? max_distance / farthest : 1.0;
  for (Vec3 &d : step.displacement) d *= step.share;
}

bool boundary_is_there(const Model &model, const std::vector<Vec3> &x, double fraction,
                       double tolerance) {
  for (uint32_t i = 0; i < x.size(); ++i) {
    if (!model.topology.fixed[i]) continue;
    if (!((model.target(i, fraction) - x[i]).squaredNorm() <= tolerance * tolerance)) return false;
  }
  return true;
}

bool BoundaryRamp::is_near(const std::vector<Vec3> &x) const {
  return boundary_is_there(*model_, x, fraction_, settings::boundary::near_distance);
}

bool BoundaryRamp::may_move(double residual, double rest_force) {
  const bool may = residual < settings::boundary::max_static_residual * rest_force ||
                   waited_ == settings::boundary::max_static_wait;
  waited_ = may ? 0 : waited_ + 1;
  return may;
}

void BoundaryRamp::advance(const std::vector<Vec3> &x) {
  next_boundary_step(*model_, x, fraction_, settings::boundary::max_increment, step_);
}

Vec3 BoundaryRamp::moved(uint32_t i, const Vec3 &x, const Vec3 &displacement) const {
  const bool arrives =
      model_->topology.fixed[i] && step_.share == 1.0 && displacement == step_.displacement[i];
  return arrives ? model_->target(i, fraction_) : Vec3(x + displacement);
}

}  // namespace mvs::core
