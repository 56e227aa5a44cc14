// Recorded trajectory: samples, and the interpolated pose at any time.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "common/options.h"

namespace driver {

// Pose of the hand; its velocity is the slope between two samples.
struct Pose {
  Vector position = {};                              // m
  std::array<double, 4> orientation = {1, 0, 0, 0};  // w x y z
  uint32_t buttons = 0;
  double gripper = 0;    // rad
  Vector velocity = {};  // m/s
};

// The recorded device as stated in the file; a negative number is unknown.
struct Source {
  std::string device;
  double force = -1, continuous_force = -1, stiffness = -1, damping = -1, rate = -1;
  std::array<double, 6> workspace = {};  // m, smallest and largest corner; all zero: unknown
  unsigned buttons = 0;
};

class Recording {
 public:
  struct Sample {
    double time;  // s
    Pose pose;    // without velocity
  };

  // Takes at least two samples with increasing times, and shifts their times to start at 0.
  Recording(Source source, std::vector<Sample> samples)
      : source_(std::move(source)), samples_(std::move(samples)) {
    const double begin = samples_.front().time;
    for (Sample &sample : samples_) sample.time -= begin;
  }

  const Source &source() const { return source_; }
  const std::vector<Sample> &samples() const { return samples_; }
  double duration() const { return samples_.back().time - samples_.front().time; }

  // Returns the pose at `time` after the first sample; before it and after the last one the hand is
  // at rest.
  Pose at(double time) const {
    time += samples_.front().time;
    if (!(time >= samples_.front().time)) return samples_.front().pose;
    if (time >= samples_.back().time) return samples_.back().pose;
    const auto next = std::upper_bound(samples_.begin(), samples_.end(), time,
                                       [](double t, const Sample &s) { return t < s.time; });
    return between(*(next - 1), *next, time);
  }

  // Returns the time of the first sample after `time`; 1e300 after the last one.
  double next_after(double time) const {
    const auto next = std::upper_bound(samples_.begin(), samples_.end(), time,
                                       [](double t, const Sample &s) { return t < s.time; });
    return next == samples_.end() ? 1e300 : next->time;
  }

 private:
  static Pose between(const Sample &a, const Sample &b, double time) {
    const double interval = b.time - a.time;
    const double u = (time - a.time) / interval;
    Pose pose = a.pose;  // buttons change at samples only
    for (int k = 0; k < 3; ++k) {
      const double step = b.pose.position[k] - a.pose.position[k];
      pose.position[k] = a.pose.position[k] + u * step;
      pose.velocity[k] = step / interval;
    }
    pose.gripper = a.pose.gripper + u * (b.pose.gripper - a.pose.gripper);
    pose.orientation = turn(a.pose.orientation, b.pose.orientation, u);
    return pose;
  }

  // Spherical linear interpolation along the shorter arc (Shoemake 1985).
  static std::array<double, 4> turn(const std::array<double, 4> &a, std::array<double, 4> b,
                                    double u) {
    double cosine = 0;
    for (int k = 0; k < 4; ++k) cosine += a[k] * b[k];
    const double sign = cosine < 0 ? -1 : 1;
    const double angle = std::acos(std::min(1.0, std::abs(cosine)));
    // below this angle sin(u angle) / sin(angle) is u to the last bit
    const bool straight = angle < 1e-8;
    const double of_a = straight ? 1 - u : std::sin((1 - u) * angle) / std::sin(angle);
    const double of_b = sign * (straight ? u : std::sin(u * angle) / std::sin(angle));
    double norm = 0;
    for (int k = 0; k < 4; ++k) {
      b[k] = of_a * a[k] + of_b * b[k];
      norm += b[k] * b[k];
    }
    for (double &q : b) q /= std::sqrt(norm);
    return b;
  }

  Source source_;
  std::vector<Sample> samples_;
};

}  // namespace driver
