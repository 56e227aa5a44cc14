// Torque on a simulated hand that turns: the device premium6 and sigma of haptic_drivers/hand have
// motors for it. Stable at the stiffest setting, no work from nothing, limits, faults.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/haptics/loop.h"

using namespace mvs::core;

namespace {

struct Kind {
  const char *name;
  double resolution, turn_resolution;  // m, rad, of haptic_drivers/hand
};
constexpr Kind kinds[] = {{"premium6", 30e-6, 1.4e-4}, {"sigma", 10e-6, 2.3e-4}};

// The worst hand: no arm, no wrist, no inertia or damping but the device's own.
constexpr char held_by_nobody[] =
    "\nmass=0\narm_stiffness=0\narm_damping=0\ninertia=0\nwrist_stiffness=0\nwrist_damping=0"
    "\nfrom=0.001,0,0\nturned=0.02,0.02,0.01";

// The stiffest spring of six freedoms that the device allows. `mix` of its stiffness couples
// translation and rotation, as a rod does.
TissueModel stiffest(const mvs_device_info &info, double mix) {
  TissueModel tissue = spring(info.max_stiffness / (1 + mix));
  tissue.turns = 1;
  tissue.most_torque = 100;
  tissue.lever = 0.02;
  tissue.turning = info.max_angular_stiffness / (1 + mix) * Mat3::Identity();
  Mat3 cross = Mat3::Zero();
  cross(0, 1) = -1;
  cross(1, 0) = 1;
  cross(2, 2) = 1;
  tissue.coupling =
      mix / (1 + mix) * std::sqrt(info.max_stiffness * info.max_angular_stiffness) * cross;
  return tissue;
}

// The energy of two encoder steps in the stiffest springs: the resolution of the servo.
double unseen(const mvs_device_info &info, const Kind &kind) {
  return info.max_stiffness * std::pow(2 * kind.resolution, 2) +
         info.max_angular_stiffness * std::pow(2 * kind.turn_resolution, 2);
}

// From the servo's own trace: the work on the hand of forces and torques that act a sample late.
class Work {
 public:
  explicit Work(const mvs_device_info &info) : info_(info) {}
  void follow(Loop &loop, double seconds) {
    const auto turns = static_cast<int>(std::ceil(seconds / 0.04));
    for (int k = 0; k < turns; ++k) {
      loop.run(0.04);
      mvs_device_sample row;
      uint64_t lost = 0;
      while (loop.device().links().trace.pop(row, lost)) take(row);
      REQUIRE_EQ(lost, 0);
    }
  }
  double most() const { return most_; }
  double largest_torque() const { return torque_; }
  // The largest energy of the stiffest uncoupled springs since the last call, J.
  double farthest() {
    const double energy = farthest_;
    farthest_ = 0;
    return energy;
  }

 private:
  void take(const mvs_device_sample &row) {
    const double *const q = row.orientation;
    const Placement now = {Vec3::Map(row.position), Eigen::Quaterniond(q[0], q[1], q[2], q[3])};
    if (begun_) {
      sum_ += acting_.force.dot(now.position - last_.position) +
              acting_.torque.dot(small_rotation(last_.orientation, now.orientation));
    }
    begun_ = true;
    acting_ = told_;
    told_ = {Vec3::Map(row.force), Vec3::Map(row.torque)};
    last_ = now;
    most_ = std::max(most_, sum_);
    torque_ = std::max(torque_, told_.torque.norm());
    const double turn = small_rotation(Eigen::Quaterniond::Identity(), now.orientation).norm();
    farthest_ = std::max(farthest_, 0.5 * info_.max_stiffness * now.position.squaredNorm() +
                                        0.5 * info_.max_angular_stiffness * turn * turn);
  }
  mvs_device_info info_;
  bool begun_ = false;
  Placement last_;
  Wrench acting_, told_;
  double sum_ = 0, most_ = 0, farthest_ = 0, torque_ = 0;
};

void check_torque(const ServoStatus &now) {
  CHECK_EQ(now.phase, DevicePhase::on);
  CHECK_GT(now.torque.norm(), 1e-3);
}

}  // namespace

TEST_CASE("a free device comes to rest in the stiffest spring of six freedoms") {
  for (const Kind &kind : kinds) {
    for (const double mix : {0.0, 0.9}) {
      CAPTURE(kind.name);
      CAPTURE(mix);
      Loop loop(std::string("device=") + kind.name + held_by_nobody);
      loop.arm();
      const mvs_device_info info = loop.device().info();
      loop.post(stiffest(info, mix));
      Work work(info);
      work.follow(loop, 0.4);
      const double first = work.farthest();
      work.follow(loop, 2);
      work.farthest();
      work.follow(loop, 0.4);
      const double last = work.farthest();
      // energies: a tenth less of the amplitude is a fifth less of them
      CHECK_LT(last, std::max(0.8 * first, 4 * unseen(info, kind)));
      // the springs held at most this at first, and nothing adds to it
      const double held = 0.5 * (info.max_stiffness * 1e-6 + info.max_angular_stiffness * 9e-4);
      CHECK_LT(work.most(), held + unseen(info, kind));
      CHECK_GT(work.largest_torque(), 1e-3);
      CHECK_EQ(loop.run(0).phase, DevicePhase::on);
    }
  }
}

TEST_CASE("a stylus that swings into the stiffest wall gains no work from it") {
  for (const Kind &kind : kinds) {
    for (const double frequency : {1.0, 4.0}) {
      CAPTURE(kind.name);
      CAPTURE(frequency);
      Loop loop(std::string("device=") + kind.name +
                "\nturn_amplitude=0.01,0.1,0\nfrequency=" + std::to_string(frequency));
      loop.arm();
      const mvs_device_info info = loop.device().info();
      TissueModel wall = stiffest(info, 0);
      wall.kind = TissueModel::near;
      wall.normal = Vec3::UnitX();
      wall.arm = Vec3(0, 0, 0.03);
      const double limit = 1 / (1 / info.max_stiffness + 9e-4 / info.max_angular_stiffness);
      wall.stiffness = limit * Mat3::Identity();
      loop.post(wall);
      Work work(info);
      work.follow(loop, 3);
      CHECK_LT(work.most(), unseen(info, kind));
      CHECK_GT(work.largest_torque(), 1e-3);  // it did swing into it
      CHECK_EQ(loop.run(0).phase, DevicePhase::on);
    }
  }
}

TEST_CASE("a stylus that drags a coupled spring gains no more work than it stored at first") {
  for (const Kind &kind : kinds) {
    CAPTURE(kind.name);
    // exact orientations, so that work is not mixed with encoder steps
    Loop loop(std::string("device=") + kind.name +
              "\namplitude=0.003,0,0\nturn_amplitude=0.03,0.06,0\nfrequency=2\nresolution=0"
              "\nturn_resolution=0");
    loop.arm();
    const mvs_device_info info = loop.device().info();
    Work work(info);
    work.follow(loop, 0.04);
    loop.post(stiffest(info, 0.9));
    Work felt(info);
    felt.follow(loop, 0.04);
    // the hand moves on by two or three samples before the spring acts
    const double begin = 1.2 * std::max(work.farthest(), felt.farthest());
    felt.follow(loop, 3);
    CHECK_LT(felt.most(), begin);
    CHECK_GT(felt.largest_torque(), 1e-3);
  }
}

// A simulation at 100 Hz that follows the hand 10 ms late, as in stability.cpp.
TEST_CASE("late models keep a coupled grasp stable") {
  for (const Kind &kind : kinds) {
    CAPTURE(kind.name);
    Loop loop(std::string("device=") + kind.name + held_by_nobody);
    loop.arm();
    const mvs_device_info info = loop.device().info();
    const TissueModel grasp = stiffest(info, 0.5);
    Work work(info);
    double first = 0, last = 0;
    for (int k = 0; k < 300; ++k) {
      const ServoStatus now = loop.run(0);
      TissueModel model = grasp;
      model.origin = now.pose.position;
      model.orientation = now.pose.orientation;
      const Vec3 turn = 2 * now.pose.orientation.vec();
      model.force = -grasp.stiffness * model.origin - grasp.coupling * turn;
      model.torque = -grasp.coupling.transpose() * model.origin - grasp.turning * turn;
      loop.post(model);
      work.follow(loop, 0.04);
      if (k < 10) first = std::max(first, work.farthest());
      if (k >= 290) last = std::max(last, work.farthest());
      work.farthest();
    }
    CHECK_LT(last, std::max(0.8 * first, 4 * unseen(info, kind)));
  }
}

TEST_CASE("a torque is limited to the user's maximum, to the device's and to its rate") {
  Loop loop("device=premium6\nturn_resolution=0\nresolution=0");
  loop.arm();
  CHECK_EQ(loop.device().info().peak_torque, 0.188);
  // twice the device's own is not more than the device's own
  mvs_device_limits limits = {};
  limits.torque = 0.4;
  loop.device().set_limits(limits);
  CHECK_EQ(loop.device().limits().torque, 0.188);
  limits.torque = 0.05;
  limits.torque_slew = 1;
  limits.thermal_s = 1000;
  limits.ramp_s = 0.01;
  limits.stale_s = 10;
  loop.device().set_limits(limits);
  TissueModel twist = spring(0);
  twist.turns = 1;
  twist.torque = Vec3(0, 3, 0);
  twist.most_torque = 100;
  loop.post(twist);
  Vec3 before = Vec3::Zero();
  uint32_t limited = 0;
  for (int k = 0; k < 200; ++k) {
    const ServoStatus now = loop.run(1e-3);
    CHECK_LE((now.torque - before).norm(), 1e-3 * (1 + 1e-9));
    CHECK_LE(now.torque.norm(), 0.05 * (1 + 1e-9));
    CHECK(now.force.isZero(1e-12));
    before = now.torque;
    limited |= now.limited;
  }
  CHECK_EQ(before.norm(), doctest::Approx(0.05));
  CHECK((limited & MVS_LIMITED_TORQUE) != 0);
  CHECK((limited & MVS_LIMITED_SLEW) != 0);
}

// 0.188 N m times the share 1.4 / 8.5 of the force, which the motors bear continuously.
TEST_CASE("a lasting torque falls to what the motors bear") {
  Loop loop("device=premium6\nturn_resolution=0\nwrist_stiffness=20");
  loop.arm();
  mvs_device_limits limits = {};
  limits.thermal_s = 1;
  limits.ramp_s = 0.01;
  limits.stale_s = 10;
  loop.device().set_limits(limits);
  TissueModel twist = spring(0);
  twist.turns = 1;
  twist.torque = Vec3(-1, 0, 0);
  twist.most_torque = 100;
  loop.post(twist);
  CHECK_GT(loop.run(0.012).torque.norm(), 0.15);
  ServoStatus hot;
  for (int k = 0; k < 4; ++k) {
    loop.post(twist);
    hot = loop.run(5);
  }
  CHECK_EQ(hot.torque.norm(), doctest::Approx(0.188 * 1.4 / 8.5).epsilon(0.01));
  CHECK((hot.limited & MVS_LIMITED_CONTINUOUS) != 0);
}

TEST_CASE("a torque waits at the gate as a force does") {
  Loop loop("device=premium6\nturn_resolution=0");
  loop.run(0.01);
  mvs_device_limits limits = {};
  limits.stale_s = 10;
  loop.device().set_limits(limits);
  TissueModel twist = spring(0);
  twist.turns = 1;
  twist.most_torque = 100;
  twist.torque = Vec3(0, 0, 0.01);  // the gate is 0.2 N of 8.5 N, which is 0.0044 of 0.188 N m
  loop.post(twist);
  loop.device().arm();
  const ServoStatus waiting = loop.run(0.5);
  CHECK_EQ(waiting.phase, DevicePhase::waiting);
  CHECK(waiting.torque.isZero(0));
  twist.torque = Vec3(0, 0, 0.004);
  loop.post(twist);
  CHECK_EQ(loop.run(0.5).phase, DevicePhase::ramping);
}

TEST_CASE("a torque fades when the simulation stops, and is zero after a cut") {
  Loop loop("device=premium6\nturn_resolution=0\nturned=0.05,0,0");
  loop.arm();
  mvs_device_limits limits = {};
  limits.ramp_s = 0.01;
  loop.device().set_limits(limits);
  TissueModel twist = spring(0);
  twist.turns = 1;
  twist.most_torque = 100;
  twist.torque = Vec3(0, 0, 0.02);
  loop.post(twist);
  check_torque(loop.run(0.09));
  CHECK_EQ(loop.run(0.03).phase, DevicePhase::faded);
  CHECK(loop.run(0.1).torque.isZero(1e-12));
  for (int k = 0; k < 3; ++k) {
    loop.post(twist);
    loop.run(0.09);
  }
  check_torque(loop.run(0));
  loop.device().cut();
  CHECK(loop.run(1e-3).torque.isZero(0));
}

TEST_CASE("a torque model with NaN latches, and never reaches the motors") {
  for (int where = 0; where < 6; ++where) {
    CAPTURE(where);
    Loop loop("device=premium6\nturn_resolution=0\nturned=0.05,0,0");
    loop.arm();
    TissueModel twist = stiffest(loop.device().info(), 0);
    twist.torque = Vec3(0.02, 0, 0);
    loop.post(twist);
    check_torque(loop.run(0.02));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (where == 0) twist.torque.x() = nan;
    if (where == 1) twist.turning(1, 2) = std::numeric_limits<double>::infinity();
    if (where == 2) twist.coupling(0, 0) = nan;
    if (where == 3) twist.orientation.x() = nan;
    if (where == 4) twist.most_torque = nan;
    if (where == 5) twist.arm.z() = nan;
    loop.post(twist);
    const ServoStatus now = loop.run(0.01);
    CHECK_EQ(now.phase, DevicePhase::latched);
    CHECK_EQ(now.cause, Cause::not_finite);
    CHECK(now.torque.isZero(0));
    CHECK(now.force.isZero(0));
  }
}

namespace {

// A servo without a driver: what it writes for a sample.
class Bare {
 public:
  Bare(uint32_t freedoms_in, uint32_t freedoms_out) {
    mvs_driver_info info = {};
    info.struct_size = sizeof info;
    info.freedoms_in = freedoms_in;
    info.freedoms_out = freedoms_out;
    info.peak_torque = 0.2;
    traits_ = read_traits(info, "bare");
    mvs_device_limits limits = {};
    limits.ramp_s = 0.01;
    limits.stale_s = 10;
    servo_ = std::make_unique<Servo>(traits_, resolve_limits(limits, traits_.info), links_);
    servo_->start();
  }
  mvs_driver_force tick(const Eigen::Quaterniond &turn) {
    mvs_driver_state sample = {};
    sample.struct_size = sizeof sample;
    sample.flags = MVS_DRIVER_FLAG_CALIBRATED;
    sample.time_ns = now_ += 1000000;
    sample.sequence = now_;
    sample.position[0] = 1e-3;
    sample.orientation[0] = turn.w();
    for (int k = 0; k < 3; ++k) sample.orientation[1 + k] = turn.vec()[k];
    mvs_driver_force force = {};
    force.torque[0] = 1;  // has to be overwritten
    servo_->tick(sample, force);
    return force;
  }
  ServoLinks &links() { return links_; }
  ServoStatus status() {
    links_.status.refresh();
    return links_.status.get();
  }

 private:
  DeviceTraits traits_;
  ServoLinks links_;
  std::unique_ptr<Servo> servo_;
  uint64_t now_ = 0;
};

mvs_driver_force after_a_ramp(Bare &bare, const TissueModel &tissue) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.1, Vec3::UnitY()));
  bare.tick(turn);
  bare.links().requests.arm();
  for (int k = 0; k < 30; ++k) bare.tick(turn);
  bare.links().tissue.post(tissue);
  mvs_driver_force force = {};
  for (int k = 0; k < 300; ++k) force = bare.tick(turn);  // without a model forces had faded
  return force;
}

}  // namespace

TEST_CASE("a device without motors for torque, or without orientation, gets zero torque") {
  TissueModel grasp = spring(300);
  grasp.turns = 1;
  grasp.turning = 0.1 * Mat3::Identity();
  grasp.coupling = Mat3::Identity();
  grasp.most_torque = 100;
  for (const auto &freedoms : {std::array{6u, 3u}, {3u, 3u}, {3u, 6u}, {6u, 6u}}) {
    const uint32_t in = freedoms[0], out = freedoms[1];
    CAPTURE(in);
    CAPTURE(out);
    Bare bare(in, out);
    const mvs_driver_force force = after_a_ramp(bare, grasp);
    REQUIRE_EQ(force.on, 1);
    const double torque = Vec3::Map(force.torque).norm();
    if (in == 6 && out == 6) {
      // 0.1 N m/rad times 0.1 rad, and the coupling with 1 mm
      CHECK_EQ(torque, doctest::Approx(std::hypot(0.1 * std::sin(0.1), 1e-3)).epsilon(0.01));
    } else {
      CHECK_EQ(torque, 0);
      CHECK_EQ(force.force[0], doctest::Approx(-0.3));  // and rotation does not change the force
      CHECK_EQ(force.force[1], 0);
    }
  }
}

TEST_CASE("an orientation that jumps or spins too fast latches a device that renders torque") {
  for (const bool jumps : {true, false}) {
    CAPTURE(jumps);
    Bare bare(6, 6);
    after_a_ramp(bare, {});
    REQUIRE_EQ(bare.status().phase, DevicePhase::on);
    double angle = 0.1;
    for (int k = 0; k < 5; ++k) {
      angle += jumps ? 0.2 : 0.03;  // the limit is 20 rad/s, of a jump 100 rad/s
      bare.tick(Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitY())));
      if (k == 0) CHECK_EQ(bare.status().phase == DevicePhase::latched, jumps);
    }
    CHECK_EQ(bare.status().cause, Cause::velocity);
    CHECK(bare.status().torque.isZero(0));
  }
}
