// One tick, top to bottom.
#include "haptics/servo.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mvs::core {
namespace {

constexpr double rate_filter = 0.1;  // s, over which the rate is told
constexpr double late_periods = 2;   // between two samples, above which the second is late

bool is_finite(const Tissue &t) {
  return t.origin.allFinite() && t.force.allFinite() && t.stiffness.allFinite() &&
         t.normal.allFinite() && std::isfinite(t.gap) && std::isfinite(t.most);
}

}  // namespace

Servo::Servo(const DeviceTraits &traits, const mvs_device_limits &limits, ServoLinks &links)
    : traits_(&traits), limits_(limits), links_(&links), watch_(traits), guard_(links.requests) {}

void Servo::start() {
  watch_.start();
  buttons_.start();
  guard_.start();
  energy_.forget();
  field_ = force_ = before_ = Vec3::Zero();
  tissue_ = {};
  links_->tissue.refresh();  // what was posted before is of another time
  picture_ = {};
  picture_.rate = traits_->info.rate;
  picture_.model_age = std::numeric_limits<double>::infinity();
  picture_.phase = guard_.phase();
  links_->picture.post(picture_);
}

void Servo::tick(const mvs_driver_state &sample, mvs_driver_force &force) {
  bits_ = 0;
  watch_.take(sample, limits_);
  const double dt = watch_.dt();
  const Vec3 &hand = watch_.pose().position;
  if (dt > 0) {
    // the force since the last sample against the field at both ends of the way
    uint32_t unused = 0;
    energy_.take_step(hand - at_, {force_, before_}, field_, rendered(wanted(), unused));
    heat_.spend(force_, dt, limits_);
  }
  at_ = hand;
  age(dt);
  take_news();
  const bool may_feel = picture_.model_age <= limits_.stale_s && !watch_.is_parked();
  const Vec3 field = wanted();
  share_ = guard_.share({watch_.cause(), may_feel, field.norm(), watch_.passed()}, limits_);
  before_ = force_;
  force_ = limited(field);
  tell(force);
  publish(sample);
}

void Servo::lose(uint32_t cause) {
  links_->requests.cut(cause);
  share_ = guard_.share({}, limits_);
  force_ = Vec3::Zero();
  picture_.phase = guard_.phase();
  picture_.cause = guard_.cause();
  picture_.device_cause = cause;
  picture_.force = force_;
  links_->picture.post(picture_);
}

// A new model of the same contact goes on where the one before was; another one begins anew.
void Servo::take_news() {
  if (links_->limits.refresh()) limits_ = links_->limits.get();
  if (!links_->tissue.refresh()) return;
  const Tissue &news = links_->tissue.get();
  if (!is_finite(news)) {
    bits_ |= MVS_LIMITED_NUMBER;
    tissue_ = {};
    return links_->requests.cut(MVS_CAUSE_NOT_FINITE);
  }
  const bool goes_on = news.contact == tissue_.contact && news.kind != Tissue::free;
  if (goes_on && tissue_.kind != Tissue::free) {
    energy_.take_model(tissue_, news, watch_.pose().position, share_);
  } else {
    energy_.forget();
  }
  tissue_ = news;
  picture_.model_age = 0;
}

Vec3 Servo::wanted() const {
  const Vec3 &hand = watch_.pose().position;
  return force_at(tissue_, hand) + workspace_wall(*traits_, hand);
}

// What the motors may be asked for, of the field.
Vec3 Servo::rendered(const Vec3 &given, uint32_t &bits) const {
  const bool is_warm = (watch_.flags() & MVS_DRIVER_WARM) != 0;
  const Vec3 force = clamped(share_ * given, limits_.force, MVS_LIMITED_FORCE, bits);
  return clamped(force, heat_.most(limits_, is_warm), MVS_LIMITED_CONTINUOUS, bits);
}

Vec3 Servo::limited(const Vec3 &given) {
  field_ = rendered(given, bits_);
  if (share_ == 0) return Vec3::Zero();
  const double dt = watch_.dt();
  Vec3 force = field_;
  if (dt > 0) {
    const Vec3 damping = energy_.damp(watch_.pose().velocity, dt, traits_->info.max_damping);
    if (!damping.isZero(0)) bits_ |= MVS_LIMITED_ENERGY;
    force = clamped(force + damping, limits_.force, MVS_LIMITED_FORCE, bits_);
  }
  return force_ + clamped(force - force_, limits_.slew * dt, MVS_LIMITED_SLEW, bits_);
}

void Servo::tell(mvs_driver_force &force) const {
  const Vec3 told = traits_->turn.transpose() * force_;
  std::copy(told.data(), told.data() + 3, force.force);
  std::fill(force.torque, force.torque + 3, 0.0);
  force.gripper = 0;
  force.on = guard_.is_armed() ? 1 : 0;
}

void Servo::age(double dt) {
  picture_.time += watch_.passed();
  picture_.model_age += watch_.passed();
  ++picture_.ticks;
  if (dt <= 0) return;
  picture_.worst_period = std::max(picture_.worst_period, dt);
  if (dt * traits_->info.rate > late_periods) ++picture_.late;
  picture_.rate += dt / (rate_filter + dt) * (1 / dt - picture_.rate);
}

void Servo::publish(const mvs_driver_state &sample) {
  picture_.phase = guard_.phase();
  picture_.cause = guard_.cause();
  picture_.device_cause = watch_.cause();
  picture_.flags = watch_.flags();
  picture_.limited = bits_;
  picture_.pose = watch_.pose();
  picture_.force = force_;
  picture_.energy = energy_.energy();
  picture_.heat = heat_.heat();
  if (buttons_.take(sample.buttons, watch_.dt())) {
    links_->buttons.push({buttons_.down(), picture_.pose.position});
  }
  picture_.buttons = buttons_.down();
  links_->picture.post(picture_);
  keep_sample(sample);
}

void Servo::keep_sample(const mvs_driver_state &sample) {
  mvs_device_sample row = {};
  row.time = picture_.time;
  std::copy_n(picture_.pose.position.data(), 3, row.position);
  const Eigen::Quaterniond &q = picture_.pose.orientation;
  for (int k = 0; k < 4; ++k) row.orientation[k] = k == 0 ? q.w() : q.vec()[k - 1];
  std::copy_n(force_.data(), 3, row.force);
  row.servo_s = servo_s_;
  row.gripper = picture_.pose.gripper;
  row.buttons = sample.buttons;
  row.limited = bits_;
  links_->trace.push(row);
}

}  // namespace mvs::core
