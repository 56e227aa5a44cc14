// Motors of a device: the written force or torque, delayed by some samples, held (zero-order hold)
// and limited to the peak; 0: unlimited.
#pragma once

#include <mvs/driver.h>

#include <array>

#include "settings.h"

namespace hand {

class Motors {
 public:
  Motors(double peak, unsigned delay) : peak_(peak), delay_(delay) {}

  const driver::Vector &force() const { return acting_; }  // on the hand
  bool saturated() const { return saturated_; }

  void write(const driver::Vector &wanted) {
    double square = 0;
    for (const double f : wanted) square += f * f;
    const double size = std::sqrt(square);
    // tolerance for the rounding of a force that libmvs clamped to the peak
    saturated_ = peak_ > 0 && size > peak_ * (1 + 1e-9);
    for (int k = 0; k < 3; ++k) line_[0][k] = saturated_ ? wanted[k] * peak_ / size : wanted[k];
    if (delay_ == 0) acting_ = line_[0];
  }

  // Advances the delay line by one sample.
  void sampled() {
    if (delay_ == 0) return;
    acting_ = line_[delay_ - 1];
    for (unsigned k = delay_; k > 0; --k) line_[k] = line_[k - 1];
  }

  void off() {
    line_ = {};
    acting_ = {};
    saturated_ = false;
  }

 private:
  const double peak_;
  const unsigned delay_;
  std::array<driver::Vector, 17> line_ = {};  // delay line, newest first
  driver::Vector acting_ = {};
  bool saturated_ = false;
};

}  // namespace hand
