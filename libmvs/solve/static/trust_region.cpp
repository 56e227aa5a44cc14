// Travel: steps far from rest, in a trust region on the energy.
#include "solve/static/newton.h"

#include <algorithm>
#include <cmath>

#include "linalg/gmres.h"

namespace mvs::core {
namespace {

constexpr double many_far = 0.03;  // share of the nodes: more, and the shift grows
constexpr double largest_shift = 1e6;
constexpr int trials = 8;  // of one iteration
// What every second one of these goes of the step before it, and at least. Eighteen closings of
// real and parametric valves took 3,400 to 3,600 iterations with 0.03 to 0.25, and 3,900 with 0.5.
constexpr double shortened = 0.5, most_shortened = 0.2;
constexpr double stopped_from = 0.9;   // of its way: a node that keeps less is stopped
constexpr double many_stopped = 0.03;  // share of the nodes: more, and none is held
constexpr double most_held = 1e3;      // times its stiffness
// A shift above which only nodes that are stopped keep the rest: needles of a real mesh (Kaiser
// N64), which are always stopped, take fewer iterations without being held.
constexpr double locked = 100;

}  // namespace

// A step that lowers the energy about as foretold. Until there is one the shift grows; in between a
// part of the step is tried, which takes no factorisation. If all trials fail and go uphill
// the valve stays where it is: such a step may bend stiff triangles so that all that follow go
// uphill as well.
void Newton::travel_step() {
  assemble(residual_ < near_force_ ? Curvature::exact : Curvature::projected);
  const double kept = shift_;
  bool lower = false;
  for (int trial = 0; trial < trials; ++trial) {
    if (trial % 2 == 0) {
      factorise();
      solve(true);
    } else {
      shorten();
    }
    limit_step();
    double foretold;
    const double found = try_step(foretold);
    const double agreement = agreement_of(found, foretold);
    follow(agreement);
    lower = agreement > 0.01 || found <= 0;
    if (agreement > 0.01 || shift_ >= largest_shift) break;
    if (trial % 2 == 0) note_stopped();
    // the model itself foretells that what the others leave of the step leads up
    const bool uphill = curvature_ == Curvature::projected && foretold > 0;
    if (uphill && shift_ > locked && trial % 2 == 1 && trial + 1 < trials && hold()) shift_ = kept;
  }
  hold_.clear();
  const double before = energy_;
  if (lower) x_.swap(trial_);
  evaluate();
  // where the load at the free edge was not what the step took it for
  if (lower && energy_ >= before) shift_ = std::max(2 * shift_, 0.03);
}

// What is cut node by node is no longer a way down: it leads along the limits of what is stiff and
// nearly touches. As much of the whole step as needs little cutting is one.
void Newton::shorten() {
  double share = shortened;
  for (size_t i = 0; i < full_.size(); ++i) {
    const double length = full_[i].norm();
    if (length > 0) share = std::min(share, step_[i].norm() / length);
  }
  for (Vec3 &d : full_) d *= std::max(share, most_shortened);
}

// The nodes that others stop, unless they are many.
void Newton::note_stopped() {
  stopped_.clear();
  for (size_t r = 0; r < diagonal_.size(); ++r) {
    const uint32_t i = system_.node_of[r];
    const double whole = full_[i].norm(), left = step_[i].norm();
    if (left < stopped_from * whole) {
      stopped_.push_back({r, full_[i] / whole, std::min(whole / left, most_held)});
    }
  }
  if (static_cast<double>(stopped_.size()) > many_stopped * static_cast<double>(x_.size())) {
    stopped_.clear();
  }
}

// Gives them a stiffness of their own along their way for the rest of this iteration, so that the
// others know how far they go. The shift of all nodes, which a few of them would raise until
// nothing moves, may then stay. False if there are none.
bool Newton::hold() {
  hold_.resize(diagonal_.size(), Mat3::Zero());
  for (const Stopped &s : stopped_) {
    const double stiff = s.share * (diagonal_[s.row] + hold_[s.row]).trace() / 3;
    hold_[s.row] += stiff * s.way * s.way.transpose();
  }
  return !stopped_.empty();
}

double Newton::agreement_of(double found, double foretold) const {
  if (curvature_ == Curvature::projected) {
    return foretold < 0 ? found / foretold : (found < 0 ? 1 : -1);
  }
  // the linear part is common to both, so their difference is what the matrix got wrong
  return 1 - std::abs(found - foretold) / (std::abs(slope()) + 1e-300);
}

// Makes the shift follow how well the matrix foretold a step.
void Newton::follow(double agreement) {
  if (far_ > many_far) {
    shift_ = std::max(2 * shift_, 0.01);
  } else if (agreement > 0.6) {
    shift_ = shift_ < 1e-3 ? 0 : (agreement > 0.9 ? 0.1 : 0.3) * shift_;
  } else if (!(agreement > 0.2)) {
    shift_ = std::min(std::max(4 * shift_, 0.03), largest_shift);
  }
}

// The change of energy along the step as it is, and as the quadratic model says.
double Newton::try_step(double &foretold) {
  const PhaseTimer timer(stats_.work, MVS_PHASE_LINE_SEARCH);
  ++stats_.work.passes;
  foretold = slope() + 0.5 * curvature_along();
  for (size_t i = 0; i < x_.size(); ++i) trial_[i] = x_[i] + step_[i];
  return total_energy_.energy(trial_) - energy_;
}

double Newton::slope() const {
  return dot(g_, step_);
}

// step^T H step with the matrix before its shift.
double Newton::curvature_along() const {
  const BlockMatrix &m = system_.matrix;
  double sum = 0;
  for (uint32_t c = 0; c < m.size(); ++c) {
    const Vec3 &d = step_[system_.node_of[c]];
    Vec3 below = Vec3::Zero();
    for (uint32_t k = m.start[c] + 1; k < m.start[c + 1]; ++k) {
      below += m.value[k].transpose() * step_[system_.node_of[m.row[k]]];
    }
    sum += d.dot(diagonal_[c] * d + 2 * below);
  }
  return sum;
}

}  // namespace mvs::core
