// Rotation vectors and quaternions, and one interval of the oscillator about each axis.
#include "wrist.h"

#include <algorithm>
#include <cmath>

namespace hand {

namespace {

using driver::Vector;

Quaternion of_vector(const Vector &r) {
  const double angle = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
  if (angle == 0) return {1, 0, 0, 0};
  const double share = std::sin(0.5 * angle) / angle;
  return {std::cos(0.5 * angle), share * r[0], share * r[1], share * r[2]};
}

Vector vector_of(const Quaternion &q) {
  const double sine = std::sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (sine == 0) return {};
  const double sign = q[0] < 0 ? -1 : 1;
  const double share = sign * 2 * std::atan2(sine, sign * q[0]) / sine;
  return {share * q[1], share * q[2], share * q[3]};
}

Quaternion product(const Quaternion &a, const Quaternion &b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

Quaternion unit(Quaternion q) {
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double &value : q) value /= length;
  return q;
}

bool is_zero(const Vector &v) {
  return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

}  // namespace

Wrist::Wrist(const Rotation &rotation)
    : rotation_(rotation), orientation_(of_vector(rotation.from)) {}

Quaternion Wrist::encoded(double resolution) const {
  if (resolution <= 0) return orientation_;
  Vector vector = vector_of(orientation_);
  for (double &value : vector) value = resolution * std::round(value / resolution);
  return of_vector(vector);
}

void Wrist::move(double begin, double length, const Vector &torque) {
  const Vector before = vector_of(orientation_);
  // without spin, torque and planned rotation the orientation stays bit for bit
  if (is_zero(before) && is_zero(spin_) && is_zero(torque) && is_zero(rotation_.amplitude)) return;
  if (length != length_) step_ = step(rotation_.oscillator, length);
  length_ = length;
  const double phase = rotation_.oscillator.swing * std::max(begin, 0.0);
  Vector turned = {};
  for (int k = 0; k < 3; ++k) {
    const double end = rotation_.amplitude[k] * std::sin(phase);
    const double speed =
        begin < 0 ? 0 : rotation_.amplitude[k] * rotation_.oscillator.swing * std::cos(phase);
    const double now[5] = {before[k], spin_[k], torque[k], end, speed};
    double x = 0, v = 0;
    for (int j = 0; j < 5; ++j) {
      x += step_.x[j] * now[j];
      v += step_.v[j] * now[j];
    }
    turned[k] = x - before[k];
    spin_[k] = v;
  }
  orientation_ = unit(product(of_vector(turned), orientation_));
}

}  // namespace hand
