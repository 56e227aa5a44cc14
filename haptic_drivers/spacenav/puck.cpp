// Scaling of the deflection and integration of the pose.
#include "puck.h"

#include <algorithm>
#include <cmath>

namespace spacenav {
namespace {

// Full deflection of a SpaceNavigator at sensitivity 1.
constexpr double kFull = 350;

// spacenavd's axes are x right, y up, z away from the user, with left-handed rotations; libspnav's
// spnav_posrot_moveobj negates z of both for a right-handed frame.
constexpr double kSign[3] = {1, 1, -1};

}  // namespace

void Puck::deflect(const int32_t axes[6]) {
  for (int i = 0; i < 3; ++i) {
    speed_[i] = speeds_.move * kSign[i] * std::clamp(axes[i] / kFull, -1.0, 1.0);
    spin_[i] = speeds_.turn * kSign[i] * std::clamp(axes[i + 3] / kFull, -1.0, 1.0);
  }
}

void Puck::centre() {
  std::fill_n(position_, 3, 0.0);
  std::fill_n(orientation_, 4, 0.0);
  orientation_[0] = 1;
}

void Puck::step(double seconds) {
  for (int i = 0; i < 3; ++i) {
    position_[i] = std::clamp(position_[i] + speed_[i] * seconds, -kReach, kReach);
    const bool at_wall = position_[i] == std::copysign(kReach, speed_[i]);
    velocity_[i] = at_wall ? 0 : speed_[i];
  }
  turn(seconds);
}

// q <- exp(spin seconds / 2) q: rotation about fixed axes.
void Puck::turn(double seconds) {
  const double rate = std::sqrt(spin_[0] * spin_[0] + spin_[1] * spin_[1] + spin_[2] * spin_[2]);
  if (rate == 0) return;
  const double w = std::cos(rate * seconds / 2), s = std::sin(rate * seconds / 2) / rate;
  const double x = s * spin_[0], y = s * spin_[1], z = s * spin_[2];
  const double *q = orientation_;
  const double turned[4] = {
      w * q[0] - x * q[1] - y * q[2] - z * q[3], w * q[1] + x * q[0] + y * q[3] - z * q[2],
      w * q[2] - x * q[3] + y * q[0] + z * q[1], w * q[3] + x * q[2] - y * q[1] + z * q[0]};
  double square = 0;
  for (const double part : turned) square += part * part;
  for (int i = 0; i < 4; ++i) orientation_[i] = turned[i] / std::sqrt(square);
}

}  // namespace spacenav
