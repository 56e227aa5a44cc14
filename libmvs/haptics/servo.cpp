// One tick of the servo, in the order of servo.h.
#include "haptics/servo.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mvs::core {
namespace {

constexpr double rate_filter = 0.1;  // s, time constant of the reported rate
constexpr double onset_s = 0.05;     // s, of the ramp of a new grasp
// m: times the largest force it is the energy up to which a surplus is left to the damping.
constexpr double surplus_way = 1e-3;
constexpr double working_s = 0.03;  // s, in which a force that was withheld returns
constexpr double late_periods = 2;  // between two samples; a longer interval counts as late

bool is_finite(const TissueModel &t) {
  return t.origin.allFinite() && t.force.allFinite() && t.stiffness.allFinite() &&
         t.normal.allFinite() && std::isfinite(t.gap) && std::isfinite(t.most);
}

bool has_finite_torque(const TissueModel &t) {
  return t.orientation.coeffs().allFinite() && t.torque.allFinite() && t.coupling.allFinite() &&
         t.turning.allFinite() && t.arm.allFinite() && std::isfinite(t.lever) &&
         std::isfinite(t.most_torque);
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
  field_ = sent_ = before_ = {};
  onset_ = working_ = 1;
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
  const Placement hand = validator_.pose().placement();
  if (dt > 0) spend_heat(dt);
  if (dt > 0 && validator_.cause() == Cause::nothing) {
    // a rejected sample is no motion, and does no work; work of the sent forces against the field
    // at both ends of the step
    uint32_t unused = 0;
    Twist step = {hand.position - last_.position, Vec3::Zero()};
    if (traits_->renders_torque) step.angular = small_rotation(last_.orientation, hand.orientation);
    energy_.take_step(step, {sent_, before_}, field_, rendered(wanted(onset_), unused));
  }
  last_ = hand;
  age(dt);
  take_updates();
  const bool may_feel = status_.model_age <= limits_.stale_s && !validator_.is_parked();
  onset_ = std::min(1.0, onset_ + dt / onset_s);
  const bool was_armed = gate_.is_armed();
  share_ = gate_.share({validator_.cause(), may_feel, gated_size(wanted(1)), validator_.passed()},
                       limits_);
  if (!was_armed && gate_.is_armed()) energy_.forget();
  before_ = sent_;
  sent_ = limited(wanted(onset_));
  write_force(force);
  publish(sample);
}

void Servo::spend_heat(double dt) {
  heat_.spend(sent_.force, dt, force_limits(limits_), limits_.thermal_s);
  torque_heat_.spend(sent_.torque, dt, torque_limits(limits_), limits_.thermal_s);
}

void Servo::lose(Cause cause) {
  links_->requests.cut(cause);
  share_ = gate_.share({}, limits_);
  sent_ = {};
  status_.phase = gate_.phase();
  status_.cause = gate_.cause();
  status_.device_cause = cause;
  status_.force = sent_.force;
  status_.torque = sent_.torque;
  links_->status.post(status_);
}

// A new model of the same contact keeps the energy account; a model of another contact resets it.
// A grasp or a felt chord acts at any distance: its force begins with a ramp, where it would jump
// under a still hand. A tool that pushes begins clear of tissue.
void Servo::take_updates() {
  if (links_->limits.refresh()) limits_ = links_->limits.get();
  if (!links_->tissue.refresh()) return;
  TissueModel next = links_->tissue.get();
  if (!is_finite(next) || (next.turns != 0 && !has_finite_torque(next))) {
    bits_ |= MVS_LIMITED_NUMBER;
    tissue_ = {};
    return links_->requests.cut(Cause::not_finite);
  }
  if (!traits_->renders_torque) next.turns = 0;
  const bool same_contact = next.contact == tissue_.contact && next.kind != TissueModel::free;
  if (same_contact && tissue_.kind != TissueModel::free) {
    energy_.take_model(tissue_, next, validator_.pose().placement(), share_ * onset_);
  } else {
    energy_.forget();
    // a changed view or gain is another contact of the same kind: it keeps its place on the ramp
    const bool ramps = next.kind == TissueModel::held || next.kind == TissueModel::pulled;
    if (!ramps || next.kind != tissue_.kind) onset_ = ramps ? 0 : 1;
  }
  tissue_ = next;
  status_.model_age = 0;
}

// Returns a share of the force of the tissue, and the force of the wall.
Wrench Servo::wanted(double share) const {
  const Placement hand = validator_.pose().placement();
  Wrench wrench = wrench_at(tissue_, hand);
  wrench.force *= share;
  wrench.torque *= share;
  wrench.force += workspace_wall(*traits_, limits_, hand.position);
  return wrench;
}

// Returns the size of the field for the gate, N: a torque counts as the same share of its limit.
double Servo::gated_size(const Wrench &field) const {
  const double size = field.force.norm();
  if (limits_.torque <= 0) return size;
  return std::max(size, field.torque.norm() * (limits_.force / limits_.torque));
}

// Clamps a wrench to the largest force and to the heat budget.
Wrench Servo::bounded(const Wrench &given, uint32_t &bits) const {
  const bool is_warm = (validator_.flags() & MVS_DRIVER_FLAG_WARM) != 0;
  Wrench out;
  out.force = clamped(given.force, limits_.force, MVS_LIMITED_FORCE, bits);
  out.force =
      clamped(out.force, heat_.most(force_limits(limits_), is_warm), MVS_LIMITED_CONTINUOUS, bits);
  if (!traits_->renders_torque) return out;
  out.torque = clamped(given.torque, limits_.torque, MVS_LIMITED_TORQUE, bits);
  out.torque = clamped(out.torque, torque_heat_.most(torque_limits(limits_), is_warm),
                       MVS_LIMITED_CONTINUOUS, bits);
  return out;
}

// Returns the gated field within its bounds.
Wrench Servo::rendered(const Wrench &given, uint32_t &bits) const {
  return bounded({share_ * given.force, share_ * given.torque}, bits);
}

Wrench Servo::limited(const Wrench &given) {
  field_ = rendered(given, bits_);
  if (share_ == 0) return {};
  const HandPose &pose = validator_.pose();
  if (!workspace_wall(*traits_, limits_, pose.position).isZero(0)) bits_ |= MVS_LIMITED_WALL;
  const double dt = validator_.dt();
  Wrench next = field_;
  if (dt > 0) {
    const Twist velocity = {pose.velocity, pose.spin};
    const double working = energy_.working_share(field_, velocity, surplus_way * limits_.force);
    // it returns slowly, as a velocity of changing sign would make the hand buzz
    working_ = std::min(working, working_ + dt / working_s);
    next.force *= working_;
    next.torque *= working_;
    if (working_ < 1) bits_ |= MVS_LIMITED_ENERGY;
    const Damping most = {traits_->info.max_damping, traits_->info.max_angular_damping};
    Wrench damping = energy_.damp(velocity, dt, most);
    // it dissipates what forces of this share generate, and begins with their ramp
    damping.force *= share_;
    damping.torque *= share_;
    if (!damping.force.isZero(0) || !damping.torque.isZero(0)) bits_ |= MVS_LIMITED_ENERGY;
    next = bounded({next.force + damping.force, next.torque + damping.torque}, bits_);
  }
  const mvs_device_info &device = traits_->info;
  next.force = slewed(sent_.force, next.force, limits_.slew, device.peak_force);
  next.torque = slewed(sent_.torque, next.torque, limits_.torque_slew, device.peak_torque);
  return next;
}

// Returns the next force, at most `slew` times the time away from the last one. A gap between two
// samples allows no more than a late one. A lower force may also fall as fast as the device's
// default slew allows: a lowered limit, or a release, takes effect within 10 ms.
Vec3 Servo::slewed(const Vec3 &last, const Vec3 &next, double slew, double peak) {
  const double dt = std::min(validator_.dt(), late_periods / traits_->info.rate);
  const double rate = next.norm() < last.norm() ? std::max(slew, default_slew * peak) : slew;
  return last + clamped(next - last, rate * dt, MVS_LIMITED_SLEW, bits_);
}

void Servo::write_force(mvs_driver_force &force) const {
  const Vec3 sent = traits_->turn.transpose() * sent_.force;
  const Vec3 torque = traits_->turn.transpose() * sent_.torque;
  std::copy(sent.data(), sent.data() + 3, force.force);
  std::copy(torque.data(), torque.data() + 3, force.torque);
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
  status_.has_pose = validator_.has_pose();
  status_.pose = validator_.pose();
  status_.force = sent_.force;
  status_.torque = sent_.torque;
  status_.energy = energy_.energy();
  status_.heat = std::max(heat_.heat(), torque_heat_.heat());
  if (buttons_.take(sample.buttons, validator_.dt())) {
    ++status_.button_changes;
    links_->buttons.push({buttons_.down(), status_.button_changes, status_.pose.position});
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
  std::copy_n(sent_.force.data(), 3, row.force);
  std::copy_n(sent_.torque.data(), 3, row.torque);
  row.servo_s = servo_s_;
  row.gripper = status_.pose.gripper;
  row.buttons = sample.buttons;
  row.limited = bits_;
  links_->trace.push(row);
}

}  // namespace mvs::core
