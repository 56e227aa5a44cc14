// One tick of the servo, in the order of servo.h.
#include "haptics/servo.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mvs::core {
namespace {

constexpr double rate_filter = 0.1;  // s, time constant of the reported rate
constexpr double late_periods = 2;   // between two samples; a longer interval counts as late

bool is_finite(const TissueModel &t) {
  return t.origin.allFinite() && t.force.allFinite() && t.stiffness.allFinite() &&
         t.normal.allFinite() && std::isfinite(t.gap) && std::isfinite(t.most);
}

}  // namespace

Servo::Servo(const DeviceTraits &traits, const mvs_device_limits &limits, ServoLinks &links)
    : traits_(&traits),
      limits_(limits),
      links_(&links),
      validator_(traits),
      gate_(links.requests) {}

void Servo::start() {
  validator_.start();
  buttons_.start();
  gate_.start();
  energy_.forget();
  field_ = force_ = before_ = Vec3::Zero();
  tissue_ = {};
  links_->tissue.refresh();  // discards a model posted before the start
  status_ = {};
  status_.rate = traits_->info.rate;
  status_.model_age = std::numeric_limits<double>::infinity();
  status_.phase = gate_.phase();
  links_->status.post(status_);
}

void Servo::tick(const mvs_driver_state &sample, mvs_driver_force &force) {
  bits_ = 0;
  validator_.take(sample, limits_);
  const double dt = validator_.dt();
  const Vec3 &hand = validator_.pose().position;
  if (dt > 0) {
    // work of the sent forces against the field at both ends of the step
    uint32_t unused = 0;
    energy_.take_step(hand - at_, {force_, before_}, field_, rendered(wanted(), unused));
    heat_.spend(force_, dt, limits_);
  }
  at_ = hand;
  age(dt);
  take_updates();
  const bool may_feel = status_.model_age <= limits_.stale_s && !validator_.is_parked();
  const Vec3 field = wanted();
  share_ = gate_.share({validator_.cause(), may_feel, field.norm(), validator_.passed()}, limits_);
  before_ = force_;
  force_ = limited(field);
  write_force(force);
  publish(sample);
}

void Servo::lose(Cause cause) {
  links_->requests.cut(cause);
  share_ = gate_.share({}, limits_);
  force_ = Vec3::Zero();
  status_.phase = gate_.phase();
  status_.cause = gate_.cause();
  status_.device_cause = cause;
  status_.force = force_;
  links_->status.post(status_);
}

// A new model of the same contact keeps the energy account; a model of another contact resets it.
void Servo::take_updates() {
  if (links_->limits.refresh()) limits_ = links_->limits.get();
  if (!links_->tissue.refresh()) return;
  const TissueModel &next = links_->tissue.get();
  if (!is_finite(next)) {
    bits_ |= MVS_LIMITED_NUMBER;
    tissue_ = {};
    return links_->requests.cut(Cause::not_finite);
  }
  const bool same_contact = next.contact == tissue_.contact && next.kind != TissueModel::free;
  if (same_contact && tissue_.kind != TissueModel::free) {
    energy_.take_model(tissue_, next, validator_.pose().position, share_);
  } else {
    energy_.forget();
  }
  tissue_ = next;
  status_.model_age = 0;
}

Vec3 Servo::wanted() const {
  const Vec3 &hand = validator_.pose().position;
  return force_at(tissue_, hand) + workspace_wall(*traits_, hand);
}

// Returns the gated field, clamped to the peak force and to the heat budget.
Vec3 Servo::rendered(const Vec3 &given, uint32_t &bits) const {
  const bool is_warm = (validator_.flags() & MVS_DRIVER_FLAG_WARM) != 0;
  const Vec3 force = clamped(share_ * given, limits_.force, MVS_LIMITED_FORCE, bits);
  return clamped(force, heat_.most(limits_, is_warm), MVS_LIMITED_CONTINUOUS, bits);
}

Vec3 Servo::limited(const Vec3 &given) {
  field_ = rendered(given, bits_);
  if (share_ == 0) return Vec3::Zero();
  const double dt = validator_.dt();
  Vec3 force = field_;
  if (dt > 0) {
    const Vec3 damping = energy_.damp(validator_.pose().velocity, dt, traits_->info.max_damping);
    if (!damping.isZero(0)) bits_ |= MVS_LIMITED_ENERGY;
    force = clamped(force + damping, limits_.force, MVS_LIMITED_FORCE, bits_);
  }
  return force_ + clamped(force - force_, limits_.slew * dt, MVS_LIMITED_SLEW, bits_);
}

void Servo::write_force(mvs_driver_force &force) const {
  const Vec3 sent = traits_->turn.transpose() * force_;
  std::copy(sent.data(), sent.data() + 3, force.force);
  std::fill(force.torque, force.torque + 3, 0.0);
  force.gripper = 0;
  force.on = gate_.is_armed() ? 1 : 0;
}

void Servo::age(double dt) {
  status_.time += validator_.passed();
  status_.model_age += validator_.passed();
  ++status_.ticks;
  if (dt <= 0) return;
  status_.worst_period = std::max(status_.worst_period, dt);
  if (dt * traits_->info.rate > late_periods) ++status_.late;
  status_.rate += dt / (rate_filter + dt) * (1 / dt - status_.rate);
}

void Servo::publish(const mvs_driver_state &sample) {
  status_.phase = gate_.phase();
  status_.cause = gate_.cause();
  status_.device_cause = validator_.cause();
  status_.sample_faults |= validator_.faults();
  if (validator_.faults() != 0) ++status_.bad_samples;
  status_.flags = validator_.flags();
  status_.limited = bits_;
  status_.pose = validator_.pose();
  status_.force = force_;
  status_.energy = energy_.energy();
  status_.heat = heat_.heat();
  if (buttons_.take(sample.buttons, validator_.dt())) {
    links_->buttons.push({buttons_.down(), status_.pose.position});
  }
  status_.buttons = buttons_.down();
  links_->status.post(status_);
  keep_sample(sample);
}

void Servo::keep_sample(const mvs_driver_state &sample) {
  mvs_device_sample row = {};
  row.time = status_.time;
  std::copy_n(status_.pose.position.data(), 3, row.position);
  const Eigen::Quaterniond &q = status_.pose.orientation;
  for (int k = 0; k < 4; ++k) row.orientation[k] = k == 0 ? q.w() : q.vec()[k - 1];
  std::copy_n(force_.data(), 3, row.force);
  row.servo_s = servo_s_;
  row.gripper = status_.pose.gripper;
  row.buttons = sample.buttons;
  row.limited = bits_;
  links_->trace.push(row);
}

}  // namespace mvs::core
