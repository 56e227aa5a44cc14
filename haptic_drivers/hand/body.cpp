// Exact integration over intervals with uniform or sinusoidal motion of the arm.
#include "body.h"

namespace hand {

Body::Body(const Oscillator &oscillator, const Script &script, const driver::Vector &from)
    : oscillator_(oscillator), script_(script), position_(from) {}

Body::ArmEnd Body::arm_end(double time) const {
  ArmEnd out;
  if (script_.recording) {
    const driver::Pose pose = script_.recording->at(time);
    out.offset = pose.position;
    out.speed = time < 0 ? driver::Vector{} : pose.velocity;
    return out;
  }
  out.middle = script_.target;
  if (time < 0) return out;
  const double phase = oscillator_.swing * time;
  for (int k = 0; k < 3; ++k) {
    out.offset[k] = script_.amplitude[k] * std::sin(phase);
    out.speed[k] = script_.amplitude[k] * oscillator_.swing * std::cos(phase);
  }
  return out;
}

// One interval in which the end of the arm moves uniformly or as a sine.
void Body::advance(double begin, double length, const driver::Vector &force) {
  // on a steady clock the same step is reused
  if (length != length_) step_ = step(oscillator_, length);
  length_ = length;
  const ArmEnd arm = arm_end(begin);
  for (int k = 0; k < 3; ++k) {
    const double u = force[k] + oscillator_.stiffness * arm.middle[k];
    const double before[5] = {position_[k], velocity_[k], u, arm.offset[k], arm.speed[k]};
    double x = 0, v = 0;
    for (int j = 0; j < 5; ++j) {
      x += step_.x[j] * before[j];
      v += step_.v[j] * before[j];
    }
    position_[k] = x;
    velocity_[k] = v;
  }
}

void Body::move(double begin, double length, const driver::Vector &force) {
  const bool corners = script_.recording && begin >= 0;
  while (length > 0) {
    // the velocity of a recording changes at each sample
    const double next = corners ? script_.recording->next_after(begin) : begin + length;
    const double part = corners ? std::min(length, next - begin) : length;
    advance(begin, part, force);
    length -= part;
    begin = next;
  }
}

}  // namespace hand
