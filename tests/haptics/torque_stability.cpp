// The loop of a hand that turns, a device with motors for torque (premium6 and sigma of
// haptic_drivers/hand) and the servo, at the largest stiffness of all six freedoms: oscillations
// decay, and the motors do no more work than the tissue stores. Like stability.cpp.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

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
  void follow(ServoLoop &loop, double seconds) {
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

}  // namespace

TEST_CASE("a free device comes to rest in the stiffest spring of six freedoms") {
  for (const Kind &kind : kinds) {
    for (const double mix : {0.0, 0.9}) {
      CAPTURE(kind.name);
      CAPTURE(mix);
      ServoLoop loop(std::string("device=") + kind.name + held_by_nobody);
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
      ServoLoop loop(std::string("device=") + kind.name +
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
    ServoLoop loop(std::string("device=") + kind.name +
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
    ServoLoop loop(std::string("device=") + kind.name + held_by_nobody);
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
