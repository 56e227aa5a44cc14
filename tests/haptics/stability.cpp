// The loop of hand, device and servo at each device's largest stable stiffness: oscillations decay,
// and the motors do no more work than the tissue stores. The devices are those of
// haptic_drivers/hand: their force acts a sample late, their encoders have steps.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/haptics/loop.h"

using namespace mvs::core;

namespace {

struct Kind {
  const char *name;
  double resolution;  // m, of haptic_drivers/hand
};
constexpr Kind kinds[] = {{"touch", 55e-6},     {"omni", 55e-6},      {"desktop", 23e-6},
                          {"premium15", 30e-6}, {"premium30", 20e-6}, {"omega", 10e-6},
                          {"delta", 20e-6},     {"lambda", 10e-6},    {"falcon", 63.5e-6}};

// The worst hand: no arm, no damping but the device's own.
constexpr char held_by_nobody[] = "\nmass=0\narm_stiffness=0\narm_damping=0\nfrom=0.001,0,0";

// The force of two encoder steps in a spring: the resolution of the servo.
double unseen(double stiffness, double resolution) {
  return stiffness * std::pow(2 * resolution, 2);
}

// Along x, from the servo's own trace: the work on the hand of forces that act a sample late.
class Work {
 public:
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
  double farthest() {
    const double x = farthest_;
    farthest_ = 0;
    return x;
  }
  void forget() { sum_ = most_ = farthest_ = 0; }

 private:
  void take(const mvs_device_sample &row) {
    sum_ += acting_ * (row.position[0] - x_);
    acting_ = told_;
    told_ = row.force[0];
    x_ = row.position[0];
    most_ = std::max(most_, sum_);
    farthest_ = std::max(farthest_, std::abs(x_));
  }
  double sum_ = 0, most_ = 0, farthest_ = 0, acting_ = 0, told_ = 0, x_ = 0;
};

}  // namespace

TEST_CASE("a free device comes to rest in the stiffest spring") {
  for (const Kind &kind : kinds) {
    CAPTURE(kind.name);
    ServoLoop loop(std::string("device=") + kind.name + held_by_nobody);
    loop.arm();
    const double stiffness = loop.device().info().max_stiffness;
    loop.post(spring(stiffness));
    Work work;
    work.follow(loop, 0.4);
    const double first = work.farthest();
    work.follow(loop, 2);
    work.farthest();
    work.follow(loop, 0.4);
    const double last = work.farthest();
    CHECK_LT(last, std::max(0.9 * first, 4 * kind.resolution));
    CHECK_EQ(loop.run(0).phase, DevicePhase::on);
  }
}

TEST_CASE("a hand that swings into the stiffest wall gains no work from it") {
  for (const Kind &kind : kinds) {
    for (const double frequency : {1.0, 4.0}) {
      CAPTURE(kind.name);
      CAPTURE(frequency);
      ServoLoop loop(std::string("device=") + kind.name +
                     "\namplitude=0.005,0,0\nfrequency=" + std::to_string(frequency));
      const double stiffness = loop.device().info().max_stiffness;
      loop.arm();
      TissueModel wall = spring(stiffness);
      wall.kind = TissueModel::near;
      wall.normal = Vec3::UnitX();
      loop.post(wall);
      Work work;
      work.follow(loop, 3);
      CHECK_LT(work.most(), unseen(stiffness, kind.resolution));
      CHECK_GT(work.farthest(), 1e-3);  // it did swing
      CHECK_EQ(loop.run(0).phase, DevicePhase::on);
    }
  }
}

TEST_CASE("a hand that drags a spring gains no more work than the spring stored at first") {
  for (const Kind &kind : kinds) {
    CAPTURE(kind.name);
    // exact positions, so that work is not mixed with encoder steps
    ServoLoop loop(std::string("device=") + kind.name +
                   "\namplitude=0.005,0,0\nfrequency=2\nresolution=0");
    loop.arm();
    const double stiffness = loop.device().info().max_stiffness;
    loop.post(spring(stiffness));
    Work work;
    work.follow(loop, 0.08);  // the ramp of a new grasp
    work.forget();
    const double start = loop.run(0).pose.position.x();
    work.follow(loop, 3);
    // forces are two or three samples late
    const double begin = std::abs(start) + 3 * loop.period() * 0.005 * 2 * 3.1416 * 2;
    CHECK_LT(work.most(), 0.5 * stiffness * begin * begin);
  }
}

// A simulation at 100 Hz that follows the hand 10 ms late: each model belongs to an earlier
// position.
TEST_CASE("late models keep a grasp stable") {
  for (const Kind &kind : kinds) {
    CAPTURE(kind.name);
    ServoLoop loop(std::string("device=") + kind.name + held_by_nobody);
    loop.arm();
    const double stiffness = loop.device().info().max_stiffness;
    double first = 0, last = 0;
    for (int k = 0; k < 300; ++k) {
      const Vec3 hand = loop.run(0).pose.position;
      TissueModel model = spring(stiffness, hand);
      model.force = -stiffness * hand;
      loop.post(model);
      for (int tick = 0; tick < 10; ++tick) {
        const double x = std::abs(loop.run(1e-3).pose.position.x());
        if (k < 40) first = std::max(first, x);
        if (k >= 260) last = std::max(last, x);
      }
    }
    CHECK_LT(last, std::max(0.9 * first, 4 * kind.resolution));
  }
}
