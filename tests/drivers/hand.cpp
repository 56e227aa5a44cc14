// The simulated hand follows its equation of motion and creates no energy.
#include "hand.h"

#include <complex>

namespace {

std::string bytes_of(const mvs_driver_state &state) {
  return {reinterpret_cast<const char *>(&state), sizeof state};
}

using Complex = std::complex<double>;

// m x'' + d x' + k x = 0 by the distinct roots of its characteristic equation.
struct Free {
  double mass, damping, stiffness;

  double operator()(double x, double v, double t) const {
    const Complex root = std::sqrt(Complex(damping * damping - 4 * mass * stiffness));
    const Complex a = (-damping + root) / (2 * mass), b = (-damping - root) / (2 * mass);
    return ((v - b * x) / (a - b) * std::exp(a * t) - (v - a * x) / (a - b) * std::exp(b * t))
        .real();
  }
};

// Pseudo-random numbers from -1 to 1, the same in every run.
struct Noise {
  uint64_t state = 1;
  double operator()() {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 11) * 0x1p-52 - 1;
  }
};

double energy(const mvs_driver_state &s, double mass, double stiffness) {
  double sum = 0;
  for (int k = 0; k < 3; ++k)
    sum += mass * s.velocity[k] * s.velocity[k] + stiffness * s.position[k] * s.position[k];
  return sum / 2;
}

}  // namespace

TEST_CASE("a_released_hand_decays_as_the_closed_form") {
  const double mass = 0.2, stiffness = 180;
  // oscillating, nearly critical (12), overdamped, and stiff with time constants 1:10000
  for (const double damping : {0.0, 1.5, 11.999, 40.0, 600.0}) {
    CAPTURE(damping);
    Hand hand(ideal({{"mass", "0.2"},
                     {"arm_stiffness", "180"},
                     {"arm_damping", std::to_string(damping)},
                     {"from", "0.03,0,0"}}));
    const Free exact = {mass, damping, stiffness};
    double t = 0;
    // any interval is exact: 0.1 ms to 0.1 s
    for (int n = 1; n <= 300; ++n) {
      const uint64_t ns = n % 3 ? 1000000 : n % 2 ? 100000 : 100000000;
      t += static_cast<double>(ns) * 1e-9;
      // with nearly equal roots the closed form loses half of its digits
      CHECK(std::abs(hand.after(ns).position[0] - exact(0.03, 0, t)) < 1e-9 * 0.03);
    }
  }
}

TEST_CASE("a_hand_led_along_a_sine_follows_the_closed_form") {
  const double mass = 0.3, stiffness = 200, arm = 3, drag = 0.5, amplitude = 0.02;
  const double w = 2 * std::acos(-1.0) * 3;
  Hand hand(ideal({{"mass", "0.3"},
                   {"arm_stiffness", "200"},
                   {"arm_damping", "3"},
                   {"device_damping", "0.5"},
                   {"target", "0.01,0,0"},
                   {"amplitude", "0.02,0,-0.02"},
                   {"frequency", "3"}}));
  const Complex response =
      amplitude * Complex(stiffness, arm * w) / Complex(stiffness - mass * w * w, (arm + drag) * w);
  const Free transient = {mass, arm + drag, stiffness};
  for (int ms = 1; ms <= 2000; ++ms) {
    const double t = ms * 1e-3;
    const double steady = (response * std::exp(Complex(0, w * t))).imag();
    const double begin = -(response * Complex(0, w)).imag();
    const double moved = steady + transient(-response.imag(), begin, t);
    const mvs_driver_state state = hand.tick();
    CHECK(std::abs(state.position[0] - 0.01 - moved) < 1e-11);  // 0.02 m, 2000 roundings
    CHECK(std::abs(state.position[2] + moved) < 1e-11);
    CHECK_EQ(state.position[1], 0);
  }
}

TEST_CASE("a_hand_led_by_a_recording_is_exact_at_any_sampling") {
  const std::string file = MVS_SOURCE_DIR "/haptic_drivers/replay/trajectories/grasp_a2.txt";
  Hand often(ideal({{"file", file}})), seldom(ideal({{"file", file}}));
  for (int n = 0; n < 100; ++n) {
    for (int k = 0; k < 77; ++k) often.tick();
    seldom.after(77000000);
    for (int k = 0; k < 3; ++k)
      CHECK(std::abs(often.state.position[k] - seldom.state.position[k]) < 1e-12);
    CHECK_EQ(often.state.buttons, seldom.state.buttons);
  }
  // and it arrives: at the end the script rests at 0.0268
  CHECK(std::abs(seldom.after(10000000000).position[1] - 0.0268) < 1e-9);
}

TEST_CASE("an_undamped_hand_has_the_energy_that_forces_supplied") {
  const double mass = 0.1, stiffness = 300;
  Hand hand(ideal({{"mass", "0.1"}, {"arm_stiffness", "300"}, {"arm_damping", "0"}}));
  Noise noise;
  double work = 0;
  for (int n = 0; n < 20000; ++n) {
    const double force = 3 * noise();
    hand.plugin.write(force, -force, 0.5);
    const mvs_driver_state before = hand.state, after = hand.tick();
    work += force * (after.position[0] - before.position[0]) -
            force * (after.position[1] - before.position[1]) +
            0.5 * (after.position[2] - before.position[2]);
    // rounding only: some J of energy, 20000 steps
    REQUIRE(std::abs(energy(after, mass, stiffness) - work) < 1e-10);
  }
  CHECK_GT(work, 0.1);
}

TEST_CASE("a_damped_hand_loses_the_energy_of_its_dampers") {
  const double mass = 0.15, stiffness = 250, damping = 1.7 + 0.3;
  Hand hand(ideal({{"mass", "0.15"},
                   {"arm_stiffness", "250"},
                   {"arm_damping", "1.7"},
                   {"device_damping", "0.3"}}));
  Noise noise;
  double most = 0;
  for (int n = 0; n < 2000; ++n) {
    const double force = 2 * noise();
    hand.plugin.write(force, 0, 0);
    const mvs_driver_state a = hand.state, b = hand.after(100000), c = hand.after(100000);
    const double lost = force * (c.position[0] - a.position[0]) + energy(a, mass, stiffness) -
                        energy(c, mass, stiffness);
    const auto square = [](const mvs_driver_state &s) { return s.velocity[0] * s.velocity[0]; };
    const double taken = damping * 2e-4 * (square(a) + 4 * square(b) + square(c)) / 6;
    CHECK_GE(lost, -1e-15);
    // Simpson's rule errs by d h^5 / 2880 (v^2)'''': 1e-16 J for v' = 2 N / 0.15 kg, d / m = 13 / s
    CHECK(std::abs(lost - taken) < 1e-15);
    most = std::max(most, taken);
  }
  CHECK_GT(most, 1e-8);  // J: a million times the error of the rule
}

TEST_CASE("a_spring_stiffer_than_damping_and_delay_allow_diverges") {
  // a sampled spring is stable for K < b / (T / 2 + delay) (Gil et al. 2009, Stability boundary for
  // haptic rendering)
  const double stiffness = 1000, period = 1e-3;
  for (const int delay : {0, 1, 3})
    for (const double share : {0.5, 2.0}) {
      CAPTURE(delay);
      CAPTURE(share);
      const double damping = share * stiffness * period * (0.5 + delay);
      Hand hand(ideal({{"mass", "0.1"},
                       {"arm_stiffness", "0"},
                       {"arm_damping", "0"},
                       {"device_damping", std::to_string(damping)},
                       {"delay", std::to_string(delay)},
                       {"from", "0.001,0,0"}}));
      for (int ms = 0; ms < 3000; ++ms) {
        hand.plugin.write(-stiffness * hand.x(), 0, 0);
        hand.tick();
      }
      const double left = std::hypot(hand.x(), hand.v() * std::sqrt(0.1 / stiffness));
      if (share < 1)
        CHECK_GT(left, 0.01);
      else
        CHECK_LT(left, 1e-4);
    }
}

TEST_CASE("a_force_acts_as_many_samples_late_as_the_device_states") {
  for (const int delay : {0, 1, 2, 16}) {
    Hand hand(ideal({{"arm_stiffness", "0"}, {"delay", std::to_string(delay)}}));
    hand.plugin.write(1, 0, 0);
    for (int n = 0; n < delay; ++n) CHECK_EQ(hand.tick().position[0], 0);
    CHECK_GT(hand.tick().position[0], 0);
  }
}

TEST_CASE("the_same_options_and_clock_give_the_same_bits") {
  const Options options = {{"device", "omni"}, {"amplitude", "0.02,0.01,0"}, {"frequency", "1.7"}};
  Hand one(options), other(options);
  Noise noise;
  for (int n = 0; n < 2000; ++n) {
    const uint64_t ns = static_cast<uint64_t>(1e6 * (1.5 + noise()));
    const double force = noise();
    one.plugin.write(force, force, 0);
    other.plugin.write(force, force, 0);
    const mvs_driver_state a = one.after(ns), b = other.after(ns);
    CHECK_EQ(bytes_of(a), bytes_of(b));
  }
}

TEST_CASE("two_hands_do_not_feel_each_other") {
  Hand pulled(ideal({})), idle(ideal({}));
  pulled.plugin.write(1, 0, 0);
  for (int n = 0; n < 100; ++n) {
    pulled.tick();
    idle.tick();
  }
  CHECK_GT(pulled.x(), 1e-4);
  CHECK_EQ(idle.x(), 0);
  pulled.plugin.close();
  CHECK_EQ(idle.tick().position[0], 0);
}

TEST_CASE("a_pushed_hand_rests_where_the_arm_balances_it") {
  Hand hand(ideal({{"push", "0.27,0,-0.54"}, {"target", "0,0.01,0"}}));
  hand.after(20000000000);
  CHECK(std::abs(hand.x() - 0.27 / 135) < 1e-12);
  CHECK(std::abs(hand.state.position[1] - 0.01) < 1e-12);
  CHECK(std::abs(hand.state.position[2] + 0.54 / 135) < 1e-12);
}

TEST_CASE("disabled_motors_have_no_effect") {
  Hand hand(ideal({{"arm_stiffness", "0"}, {"arm_damping", "0"}}));
  hand.plugin.write(5, 0, 0, false);
  CHECK_EQ(hand.tick().position[0], 0);
  hand.plugin.write(5, 0, 0);
  hand.plugin.api.stop(hand.plugin.device);  // before the force has acted
  CHECK_EQ(hand.tick().position[0], 0);
}
