// The energy account after a rejected sample and at the beginning of forces.
#include <doctest/doctest.h>

#include <algorithm>

#include "tests/haptics/loop.h"

using namespace mvs::core;

TEST_CASE("a_jump_books_no_energy_and_arming_begins_with_an_empty_account") {
  Loop loop(
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

TEST_CASE("damping_begins_with_the_ramp_of_the_force") {
  Loop loop("device=touch\nfrom=-0.03,0,0\ntarget=0.03,0,0\nresolution=0");
  loop.run(0.02);
  mvs_device_limits limits = {};
  limits.ramp_s = 10;
  limits.stale_s = 10;
  limits.speed = 10;
  loop.device().set_limits(limits);
  loop.post({});
  loop.device().arm();
  CHECK_EQ(loop.run(0.01).phase, DevicePhase::ramping);
  // models of one contact, the second without the force that has done work: energy is generated
  TissueModel pull;
  pull.kind = TissueModel::pulled;
  pull.contact = 1;
  pull.force = Vec3(1, 0, 0);
  pull.origin = Vec3(-0.2, 0, 0);
  pull.most = 100;
  TissueModel gone = pull;
  gone.force = Vec3::Zero();
  double most = 0, speed = 0;
  uint32_t limited = 0;
  for (int k = 0; k < 100; ++k) {
    loop.post(k % 2 == 0 ? pull : gone);
    const ServoStatus now = loop.run(1e-3);
    most = std::max(most, now.force.norm());
    speed = std::max(speed, now.pose.velocity.norm());
    limited |= now.limited;
  }
  // damping at its limit would be the largest force of the device; the ramp is at 1 %
  CHECK((limited & MVS_LIMITED_ENERGY) != 0);
  CHECK_GT(speed, 0.05);
  CHECK_LT(most, 0.03);
}
