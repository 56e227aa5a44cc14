// Preconditioned conjugate gradients (Hestenes & Stiefel, J. Res. Nat. Bur. Stand. 49, 1952; Saad,
// Iterative Methods for Sparse Linear Systems, 2003, section 9.2).
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "base/math.h"
#include "linalg/gmres.h"

namespace mvs::core {

struct PcgResult {
  uint32_t iterations = 0;
  // Relative residual in the norm of the preconditioner: 1 at x = 0.
  double error = 0;
};

// Stopping criteria.
struct PcgGoal {
  double tolerance;  // of PcgResult::error
  uint32_t most;     // iterations
  // It stops early if, at the rate so far, `most` iterations would leave a larger error than this.
  double worst = std::numeric_limits<double>::infinity();
  // After `patience` iterations `enough` replaces the tolerance.
  uint32_t patience = std::numeric_limits<uint32_t>::max();
  double enough = 0;

  double after(uint32_t iterations) const { return iterations < patience ? tolerance : enough; }
};

// Keeps its vectors from one system to the next.
class Pcg {
 public:
  // Sets x to a solution of A x = b for multiply(v, y) that sets y = A v and precondition(v, y)
  // that solves A y = v approximately. Starts from x = 0. Each iterate has less energy than the one
  // before, and x . b >= 0, for any positive definite preconditioner. If A turns out not to be
  // positive definite, x is the iterate before.
  template <typename Multiply, typename Precondition>
  PcgResult solve(const Multiply &multiply, const Precondition &precondition,
                  const std::vector<Vec3> &b, std::vector<Vec3> &x, const PcgGoal &goal) {
    return solve(multiply, precondition, b, {}, x, goal);
  }
  // The same from a guess, or from x = 0 if it is empty or does not reduce the energy; costs a
  // product and no preconditioning. The guess is not scaled, so that components that both it and
  // the preconditioner get right stay right: the momentum of parts that no force holds. At least
  // one iteration follows, however good the guess is: an error that is repeated in each step grows.
  template <typename Multiply, typename Precondition>
  PcgResult solve(const Multiply &multiply, const Precondition &precondition,
                  const std::vector<Vec3> &b, const std::vector<Vec3> &guess, std::vector<Vec3> &x,
                  const PcgGoal &goal) {
    x.assign(b.size(), Vec3::Zero());
    r_ = b;
    const double begun = guess.empty() ? 0 : begin(multiply, guess, x);
    precondition(r_, z_);
    p_ = z_;
    const double first = dot(r_, z_);
    PcgResult result;
    const double whole = begun + first;  // squared norm of b, for an exact preconditioner
    if (!(first >= 0 && whole > 0)) return result;
    const double left = std::sqrt(first / whole);
    result.error = left;
    double size = first;
    while (result.iterations < goal.most &&
           (result.iterations == 0 || result.error > goal.after(result.iterations))) {
      multiply(p_, y_);
      const double curvature = dot(p_, y_);
      if (!(curvature > 0)) break;
      ++result.iterations;
      const double far = size / curvature;
      for (size_t i = 0; i < b.size(); ++i) x[i] += far * p_[i];
      for (size_t i = 0; i < b.size(); ++i) r_[i] -= far * y_[i];
      precondition(r_, z_);
      const double next = dot(r_, z_);
      result.error = std::sqrt(std::max(next, 0.0) / whole);
      const double rate = math::pow(result.error / left, 1.0 / result.iterations);
      if (result.iterations > 1 && left * math::pow(rate, goal.most) > goal.worst) break;
      const double turn = next / size;
      for (size_t i = 0; i < b.size(); ++i) p_[i] = z_[i] + turn * p_[i];
      size = next;
    }
    return result;
  }

 private:
  // Starts at the guess and returns 2 b . x - x . A x; at x = 0, and returns 0, if that is not
  // positive.
  template <typename Multiply>
  double begin(const Multiply &multiply, const std::vector<Vec3> &guess, std::vector<Vec3> &x) {
    multiply(guess, y_);
    const double gained = 2 * dot(guess, r_) - dot(guess, y_);
    if (!(gained > 0)) return 0;
    x = guess;
    for (size_t i = 0; i < x.size(); ++i) r_[i] -= y_[i];
    return gained;
  }

  std::vector<Vec3> r_, z_, p_, y_;
};

}  // namespace mvs::core
