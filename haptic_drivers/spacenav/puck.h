// Integration of a 3D mouse: its deflection is a velocity, summed to a pose inside a box.
#pragma once

#include <cstdint>

namespace spacenav {

struct Speeds {
  double move = 0.05;  // m/s at full deflection
  double turn = 1.5;   // rad/s likewise
};

// m, half the edge of the box, about the reach of a stylus without moving the arm.
constexpr double kReach = 0.05;

class Puck {
 public:
  explicit Puck(const Speeds &speeds) : speeds_(speeds) {}

  // Sets the deflection, which holds until the next event.
  void deflect(const int32_t axes[6]);
  // Resets the pose to the middle of the box, upright.
  void centre();
  void step(double seconds);

  const double *position() const { return position_; }
  const double *orientation() const { return orientation_; }
  const double *velocity() const { return velocity_; }

 private:
  void turn(double seconds);

  Speeds speeds_;
  double speed_[3] = {}, spin_[3] = {};  // m/s and rad/s along the axes of libmvs
  double position_[3] = {}, velocity_[3] = {}, orientation_[4] = {1, 0, 0, 0};
};

}  // namespace spacenav
