// The energy account after a rejected sample, at the beginning of forces, and of a late simulation.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/about.h"
#include "tests/haptics/loop.h"

using namespace mvs::core;
using mvs::core::test::about;

TEST_CASE("a_jump_books_no_energy_and_arming_begins_with_an_empty_account") {
  ServoLoop loop(
      "device=touch\nfrom=0.002,0,0\ntarget=0.002,0,0\nresolution=0\n"
      "fault=jump\nfault_at=1\nfault_for=0.5");
  loop.arm();
  loop.post(spring(200));
  const double before = loop.run(0.9).energy;
  const ServoStatus during = loop.run(0.4);
  CHECK_EQ(during.cause, Cause::velocity);
  // the step of the jump would book some hundredths of a joule
  CHECK_LE(during.energy, before + 1e-6);
  loop.run(0.5);
  loop.post({});
  loop.device().arm();
  loop.run(2e-3);
  CHECK_EQ(loop.run(0).energy, 0);
}

namespace {

struct Felt {
  double most = 0, speed = 0;  // N, m/s
  double share = 0;            // largest, of a force of what the motors bear at their heat
  uint32_t limited = 0;
};

// Models of one contact that generate energy: every second one lacks the force that has done work.
Felt feel_energy(ServoLoop &loop, double ramp_s, double force, int begin = 0) {
  loop.run(0.02);
  mvs_device_limits limits = {};
  limits.ramp_s = ramp_s;
  limits.thermal_s = 0.1;
  limits.stale_s = 10;
  limits.speed = 10;
  loop.device().set_limits(limits);
  loop.post({});
  loop.device().arm();
  loop.run(0.01);
  TissueModel pull;
  pull.kind = TissueModel::pulled;
  pull.contact = 1;
  pull.force = Vec3(force, 0, 0);
  pull.origin = Vec3(force > 0 ? -0.2 : 0.2, 0, 0);
  pull.most = 100;
  TissueModel gone = pull;
  gone.force = Vec3::Zero();
  const mvs_device_info info = loop.device().info();
  const auto borne = [&](double heat) {
    const double low = info.continuous_force * info.continuous_force;
    return std::sqrt(low + (info.peak_force * info.peak_force - low) * std::max(0.0, 1 - heat));
  };
  Felt felt;
  double heat = 0;
  for (int k = 0; k < begin + 100; ++k) {
    loop.post(k % 2 == 0 ? pull : gone);
    const ServoStatus now = loop.run(1e-3);
    const double most = borne(std::min(heat, now.heat));  // before or after this tick
    heat = now.heat;
    if (k < begin) continue;
    felt.share = std::max(felt.share, now.force.norm() / most);
    felt.most = std::max(felt.most, now.force.norm());
    felt.speed = std::max(felt.speed, now.pose.velocity.norm());
    felt.limited |= now.limited;
  }
  CHECK((felt.limited & MVS_LIMITED_ENERGY) != 0);
  CHECK_GT(felt.speed, 0.05);
  return felt;
}

constexpr char swinging[] = "device=touch\nfrom=-0.03,0,0\ntarget=0.03,0,0\nresolution=0";

}  // namespace

TEST_CASE("damping_begins_with_the_ramp_of_the_force") {
  ServoLoop loop(swinging);
  // damping at its limit would be the largest force of the device; the ramp is at 1 %
  CHECK_LT(feel_energy(loop, 10, 1).most, 0.03);
  CHECK_EQ(loop.run(0).phase, DevicePhase::ramping);
}

TEST_CASE("damping_stays_within_what_hot_motors_bear") {
  ServoLoop loop(swinging);
  // forces against the motion, to which damping adds
  const Felt felt = feel_energy(loop, 0.01, -10, 50);
  CHECK_LE(felt.share, 1 + 1e-9);
  CHECK((felt.limited & MVS_LIMITED_CONTINUOUS) != 0);
}

TEST_CASE("a_surplus_takes_away_the_work_of_a_force_on_the_hand_only") {
  EnergyObserver observer;
  const Wrench push = {Vec3(2, 0, 0), Vec3::Zero()};
  const Twist out = {Vec3(0.1, 0, 0), Vec3::Zero()}, in = {Vec3(-0.1, 0, 0), Vec3::Zero()};
  const double most = 1e-3;
  CHECK_EQ(observer.working_share(push, out, most), 1);
  // 2 N over 0.75 mm that no tissue has given
  observer.take_step({Vec3(0.75e-3, 0, 0), Vec3::Zero()}, {push, push}, {}, {});
  CHECK_EQ(observer.working_share(push, out, most), about(0.5));
  CHECK_EQ(observer.working_share(push, in, most), 1);
  CHECK_EQ(observer.working_share(push, {}, most), 1);
  observer.take_step({Vec3(0.75e-3, 0, 0), Vec3::Zero()}, {push, push}, {}, {});
  CHECK_EQ(observer.working_share(push, out, most), 0);
  // half of the speed from which the whole share is taken
  CHECK_EQ(observer.working_share(push, {Vec3(5e-3, 0, 0), Vec3::Zero()}, most), about(0.5));
}

// The force of each model is that of the place of the hand 30 ms before, and it holds for 30 ms.
// The spring of the arm would swing in it with growing motion: 1.9 J of work on the hand in 4 s.
TEST_CASE("a_late_simulation_does_little_work_on_the_hand") {
  ServoLoop loop("device=desktop\nfrom=0,0,0\ntarget=0.012,0,0\nresolution=0");
  loop.arm();
  mvs_device_limits limits = {};
  limits.ramp_s = 0.01;
  limits.speed = 10;
  loop.device().set_limits(limits);
  const double force = loop.device().info().peak_force;
  TissueModel late;
  late.kind = TissueModel::held;
  late.contact = 1;
  late.most = 100;
  Vec3 last = loop.run(0).pose.position;
  double work = 0, begun = 0;
  for (int k = 0; k < 133; ++k) {
    if (k == 66) begun = work;
    late.origin = last;
    loop.post(late);
    late.force = -1000 * last;
    for (int tick = 0; tick < 30; ++tick) {
      const ServoStatus status = loop.run(loop.period());
      work += status.force.dot(status.pose.position - last);
      last = status.pose.position;
    }
  }
  // a few times the energy up to which only damping acts, 1 mm at the largest force; it began with
  // the surplus of a model that was late by 12 mm
  CHECK_LE(work - begun, 5 * 1e-3 * force);
  MESSAGE(begun << " J in the first half, " << work << " J in all");
}
