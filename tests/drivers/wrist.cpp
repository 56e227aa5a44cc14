// The simulated hand turns as the closed form, creates no energy, and clamps torque.
#include "hand.h"

#include <array>
#include <complex>

namespace {

using Vector = std::array<double, 3>;

void twist(Hand &hand, const Vector &torque) {
  mvs_driver_force force = {};
  force.struct_size = sizeof force;
  force.on = 1;
  for (int k = 0; k < 3; ++k) force.torque[k] = torque[k];
  REQUIRE_EQ(hand.plugin.api.write(hand.plugin.device, &force), MVS_DRIVER_OK);
}

// The rotation vector from one sample to the next, rad.
Vector turn_between(const mvs_driver_state &from, const mvs_driver_state &to) {
  const double *const a = from.orientation, *const b = to.orientation;
  const double w = b[0] * a[0] + b[1] * a[1] + b[2] * a[2] + b[3] * a[3];
  const Vector v = {-b[0] * a[1] + b[1] * a[0] - b[2] * a[3] + b[3] * a[2],
                    -b[0] * a[2] + b[2] * a[0] - b[3] * a[1] + b[1] * a[3],
                    -b[0] * a[3] + b[3] * a[0] - b[1] * a[2] + b[2] * a[1]};
  const double sine = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  const double share = sine > 0 ? 2 * std::atan2(sine, w) / sine : 2;
  return {share * v[0], share * v[1], share * v[2]};
}

double dot(const Vector &a, const Vector &b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Options free_stylus() {
  return ideal({{"torque", "10"},
                {"inertia", "1e-4"},
                {"device_inertia", "1e-4"},
                {"wrist_stiffness", "0"},
                {"wrist_damping", "0"}});
}

}  // namespace

// I a'' + c a' + k a = 0 about an oblique axis, with complex roots.
TEST_CASE("a_released_wrist_turns_back_as_the_closed_form") {
  Hand hand(ideal({{"torque", "1"},
                   {"inertia", "1e-4"},
                   {"device_inertia", "1e-4"},
                   {"wrist_stiffness", "0.5"},
                   {"wrist_damping", "0.002"},
                   {"turned", "0.2,0.4,-0.4"}}));
  const double inertia = 2e-4, damping = 0.002, stiffness = 0.5;
  const std::complex<double> root =
      (-damping + std::sqrt(std::complex<double>(damping * damping - 4 * inertia * stiffness))) /
      (2 * inertia);
  const mvs_driver_state rest = {0, 0, 0, 0, {}, {1, 0, 0, 0}, {}, 0, 0, 0};
  for (int ms = 1; ms <= 300; ++ms) {
    const std::complex<double> moved = std::exp(root * (1e-3 * ms));
    // a(0) = 0.6, a'(0) = 0: the real part of 0.6 (1 + i re/im) e^(root t)
    const double angle = 0.6 * (moved * std::complex<double>(1, root.real() / root.imag())).real();
    const Vector turned = turn_between(rest, hand.tick());
    // rounding of 300 steps
    CHECK(std::abs(turned[0] - angle / 3) < 1e-12);
    CHECK(std::abs(turned[1] - 2 * angle / 3) < 1e-12);
  }
}

TEST_CASE("the_work_of_torques_is_the_energy_of_the_rotation") {
  Hand hand(free_stylus());
  uint64_t seed = 1;
  double work = 0;
  for (int ms = 0; ms < 500; ++ms) {
    Vector torque;
    for (double &value : torque) {
      seed = seed * 6364136223846793005u + 1442695040888963407u;
      value = 0.2 * (static_cast<double>(seed >> 11) * 0x1p-52 - 1);
    }
    twist(hand, torque);
    const mvs_driver_state before = hand.state;
    work += dot(torque, turn_between(before, hand.tick()));
  }
  twist(hand, {});
  const mvs_driver_state before = hand.state;
  const Vector turn = turn_between(before, hand.tick());
  const double energy = 0.5 * 2e-4 * dot(turn, turn) * 1e6;
  CHECK(energy > 1e-3);
  // rounding of 500 orientations of length 1 in steps of some 0.01 rad
  CHECK(std::abs(work - energy) < 1e-10 * energy);
}

TEST_CASE("a_torque_above_the_peak_is_clamped_and_flagged_and_other_devices_ignore_it") {
  for (const char *peak : {"0.1", "0"}) {
    CAPTURE(peak);
    Options options = free_stylus();
    options["torque"] = peak;
    Hand hand(options);
    CHECK_EQ(hand.plugin.info().freedoms_out, std::string(peak) == "0" ? 3 : 6);
    twist(hand, {0, 0.4, 0});
    const mvs_driver_state before = hand.state;
    const mvs_driver_state now = hand.tick();
    // from rest: half of torque over inertia times the square of the time
    const double wanted = 0.5 * std::stod(peak) / 2e-4 * 1e-6;
    CHECK(std::abs(turn_between(before, now)[1] - wanted) < 1e-14);
    CHECK_EQ((now.flags & MVS_DRIVER_FLAG_SATURATED) != 0, std::string(peak) != "0");
  }
}

TEST_CASE("an_orientation_has_the_steps_of_its_encoder") {
  Options options = free_stylus();
  options["turn_resolution"] = "0.01";
  options["turned"] = "0.034,0,-0.016";
  Hand hand(options);
  const mvs_driver_state rest = {0, 0, 0, 0, {}, {1, 0, 0, 0}, {}, 0, 0, 0};
  const Vector turned = turn_between(rest, hand.state);
  CHECK(std::abs(turned[0] - 0.03) < 1e-15);
  CHECK(std::abs(turned[2] + 0.02) < 1e-15);
}

TEST_CASE("torque_of_a_device_without_orientation_is_refused") {
  Plugin plugin("hand", {{"device", "omega"}, {"torque", "0.1"}});
  CHECK_EQ(plugin.open(), MVS_DRIVER_E_OPTION);
}
