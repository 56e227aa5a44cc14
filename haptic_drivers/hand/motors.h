// Motors of a device: the written force, delayed, held (zero-order hold) and limited to the peak.
#pragma once

#include <mvs/driver.h>

#include <array>

#include "settings.h"

namespace hand {

class Motors {
 public:
  explicit Motors(const Device &device) : device_(device) {}

  const driver::Vector &force() const { return acting_; }  // N, on the hand
  bool saturated() const { return saturated_; }

  void write(const driver::Vector &wanted) {
    double square = 0;
    for (const double f : wanted) square += f * f;
    const double size = std::sqrt(square);
    // tolerance for the rounding of a force that libmvs clamped to the peak
    saturated_ = device_.force > 0 && size > device_.force * (1 + 1e-9);
    for (int k = 0; k < 3; ++k)
      line_[0][k] = saturated_ ? wanted[k] * device_.force / size : wanted[k];
    if (device_.delay == 0) acting_ = line_[0];
  }

  // Advances the delay line by one sample.
  void sampled() {
    if (device_.delay == 0) return;
    acting_ = line_[device_.delay - 1];
    for (unsigned k = device_.delay; k > 0; --k) line_[k] = line_[k - 1];
  }

  void off() {
    line_ = {};
    acting_ = {};
    saturated_ = false;
  }

 private:
  const Device device_;
  std::array<driver::Vector, 17> line_ = {};  // delay line, newest first
  driver::Vector acting_ = {};
  bool saturated_ = false;
};

}  // namespace hand
