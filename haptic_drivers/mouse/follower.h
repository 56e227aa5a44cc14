// Critically damped second-order low-pass filter of the pointer: x'' = (target - x) / T^2 - 2 x' /
// T, integrated exactly over each time step, so that the path does not depend on the servo's rate.
//
// A window reports its pointer 60 to 125 times per second, and the servo runs at 1 kHz: without a
// filter the hand would stand still for 8 to 16 samples and then jump. The filter makes position
// and velocity continuous. Its gain is 1 / (1 + (2 pi f T)^2): with T = 20 ms, -3 dB at 5.1 Hz,
// about the bandwidth that Draper (IEEE Trans. Syst. Man Cybern. 24(6), 1994) measured for arm
// motion in target acquisition with a mouse (5.6 Hz), and 1/58 at 60 Hz, so that the velocity of an
// even motion at 60 Hz keeps within 6 %. The hand lags by 2 T = 40 ms.
#pragma once

#include <algorithm>
#include <cmath>

namespace mouse {

constexpr double kTime = 0.02;  // s, default of T

// m/s, largest speed of the hand. A pointer can cross the window within one event; libmvs switches
// forces off above 1 m/s, and a real hand in a valve is slower than this.
constexpr double kFastest = 0.5;

class Follower {
 public:
  explicit Follower(double time) : time_(time) {}

  // Puts the hand at rest at a place.
  void place(const double at[3]) {
    std::copy_n(at, 3, position_);
    std::fill_n(velocity_, 3, 0.0);
  }

  // Moves the hand for this time towards a target that stands still meanwhile: with the distance d
  // and velocity v at the begin, d(t) = (d + (v + d / T) t) exp(-t / T).
  void step(const double target[3], double seconds) {
    const double decay = std::exp(-seconds / time_);
    double next[3], square = 0;
    for (int k = 0; k < 3; ++k) {
      const double d = position_[k] - target[k], slope = velocity_[k] + d / time_;
      next[k] = target[k] + (d + slope * seconds) * decay;
      velocity_[k] = (velocity_[k] - slope * seconds / time_) * decay;
      square += (next[k] - position_[k]) * (next[k] - position_[k]);
    }
    limit(next, std::sqrt(square), seconds);
  }

  const double *position() const { return position_; }
  const double *velocity() const { return velocity_; }

 private:
  // Takes the step, or its part that the largest speed allows.
  void limit(const double next[3], double length, double seconds) {
    const double most = kFastest * seconds;
    const double speed = std::hypot(velocity_[0], velocity_[1], velocity_[2]);
    const double share = length > most ? most / length : 1;
    const double slower = speed > kFastest ? kFastest / speed : 1;
    for (int k = 0; k < 3; ++k) {
      position_[k] += share * (next[k] - position_[k]);
      velocity_[k] *= slower;
    }
  }

  double time_;
  double position_[3] = {}, velocity_[3] = {};
};

}  // namespace mouse
