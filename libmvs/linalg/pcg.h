// Conjugate gradients for a system that a factorisation nearly solves (Hestenes & Stiefel, J. Res.
// Nat. Bur. Stand. 49, 1952; preconditioned: Saad, Iterative Methods for Sparse Linear Systems,
// 2003, section 9.2).
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "base/math.h"
#include "linalg/gmres.h"

namespace mvs::core {

struct PcgResult {
  uint32_t iterations = 0;
  // What is left of the residual, in the norm that the preconditioner gives: 1 where x = 0.
  double error = 0;
};

// How far to go.
struct PcgGoal {
  double tolerance;  // of PcgResult::error
  uint32_t most;     // iterations
  // It gives up where at the rate so far the most of them would leave more than that.
  double worst = std::numeric_limits<double>::infinity();
  // After so many iterations, that is enough.
  uint32_t patience = std::numeric_limits<uint32_t>::max();
  double enough = 0;

  double after(uint32_t iterations) const { return iterations < patience ? tolerance : enough; }
};

// Its vectors are kept from one system to the next.
class Pcg {
 public:
  // Sets x to a solution of A x = b for multiply(v, y) giving y = A v and precondition(v, y) an
  // approximate solution of A y = v. From x = 0 each iterate is better than the one before, and
  // none leads uphill for b, whatever the preconditioner, as long as it is positive definite. Where
  // A turns out not to be, the iterate before stays.
  template <typename Multiply, typename Precondition>
  PcgResult solve(const Multiply &multiply, const Precondition &precondition,
                  const std::vector<Vec3> &b, std::vector<Vec3> &x, const PcgGoal &goal) {
    return solve(multiply, precondition, b, {}, x, goal);
  }
  // The same from a guess, or none where it is empty or leads uphill, for a product and no
  // preconditioning. The whole guess, for what it and the preconditioner both get right stays
  // right: the momentum of what nothing holds. One iteration follows, however good it is: what
  // turns as it turned grows.
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
    const double whole = begun + first;  // the square of the norm of b, for an exact preconditioner
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
  // Twice b . x - x . A x / 2 there; 0, and x too, if that is not positive.
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
