// The device that the simulated hand holds: its limits, its encoder, its faults, its options.
#include <chrono>

#include "hand.h"

namespace {

Options with_fault(const std::string &fault, const std::string &lasting) {
  return {{"fault", fault},          {"fault_at", "0.1"}, {"fault_for", lasting}, {"velocity", "1"},
          {"amplitude", "0.01,0,0"}, {"frequency", "1"},  {"device", "touch"}};
}

// The fields of a sample that differ from those of a working device; empty if none differs.
struct Oddities {
  Oddities(const mvs_driver_state &before, const mvs_driver_state &s, uint64_t now) {
    nan_position = std::isnan(s.position[0]);
    inf_velocity = std::isinf(s.velocity[1]);
    jump = std::abs(s.position[0]) > 0.04;
    silent = s.sequence == before.sequence;
    button = (s.buttons & 1) != 0;
    uncalibrated = (s.flags & MVS_DRIVER_FLAG_CALIBRATED) == 0;
    saturated = (s.flags & MVS_DRIVER_FLAG_SATURATED) != 0;
    off = (s.flags & MVS_DRIVER_FLAG_FORCE_ON) == 0;
    clock_back = s.time_ns + 1000000000 == now;
    clock_jump = s.time_ns == now + 10000000000;
    cause = s.cause;
  }
  bool none() const {
    return !(nan_position || inf_velocity || jump || silent || button || uncalibrated ||
             saturated || off || clock_back || clock_jump || cause);
  }

  bool nan_position, inf_velocity, jump, silent, button, uncalibrated, saturated, off, clock_back,
      clock_jump;
  uint32_t cause;
};

}  // namespace

TEST_CASE("a_fault_begins_and_ends_at_its_times") {
  const struct {
    const char *name;
    bool (*shown)(const Oddities &);
  } faults[] = {
      {"nan_position", [](const Oddities &o) { return o.nan_position; }},
      {"inf_velocity", [](const Oddities &o) { return o.inf_velocity; }},
      {"jump", [](const Oddities &o) { return o.jump; }},
      {"silent", [](const Oddities &o) { return o.silent; }},
      {"stuck_button", [](const Oddities &o) { return o.button; }},
      {"uncalibrated", [](const Oddities &o) { return o.uncalibrated; }},
      {"saturated", [](const Oddities &o) { return o.saturated; }},
      {"clock_back", [](const Oddities &o) { return o.clock_back; }},
      {"clock_jump", [](const Oddities &o) { return o.clock_jump; }},
      {"hot", [](const Oddities &o) { return o.cause == MVS_CAUSE_THERMAL && o.off; }},
      {"button", [](const Oddities &o) { return o.cause == MVS_CAUSE_BUTTON && o.off; }},
  };
  for (const auto &fault : faults)
    for (const bool for_ever : {false, true}) {
      CAPTURE(fault.name);
      Hand hand(with_fault(fault.name, for_ever ? "0" : "0.05"));
      for (int ms = 1; ms <= 300; ++ms) {
        CAPTURE(ms);
        const mvs_driver_state before = hand.state;
        hand.plugin.write(0.1, 0, 0);
        const mvs_driver_state state = hand.tick();
        const Oddities odd(before, state, hand.now);
        const bool wanted = ms >= 100 && (for_ever || ms < 150);
        CHECK_EQ(fault.shown(odd), wanted);
        CHECK_EQ(odd.none(), !wanted);
      }
    }
}

TEST_CASE("a_button_that_bounces_changes_at_each_sample") {
  Hand hand(with_fault("bounce", "0.05"));
  for (int ms = 1; ms <= 200; ++ms) {
    const uint32_t before = hand.state.buttons;
    const uint32_t buttons = hand.tick().buttons;
    if (ms > 100 && ms < 150) CHECK_NE(buttons, before);
    if (ms < 100 || ms >= 150) CHECK_EQ(buttons, 0);
  }
}

TEST_CASE("a_dead_mans_switch_is_pressed_until_it_is_released") {
  Hand hand(with_fault("deadman", "0.05"));
  CHECK_EQ(hand.plugin.info().has_deadman, 1);
  for (int ms = 1; ms <= 200; ++ms) {
    const bool held = (hand.tick().flags & MVS_DRIVER_FLAG_HELD) != 0;
    CHECK_EQ(held, ms < 100 || ms >= 150);
  }
}

TEST_CASE("an_unplugged_device_is_lost_until_it_returns") {
  Hand hand(with_fault("unplug", "0.05"));
  for (int ms = 1; ms <= 200; ++ms) {
    mvs_driver_state state;
    const int32_t code = hand.plugin.read(hand.now += 1000000, state);
    const bool gone = ms >= 100 && ms < 150;
    CHECK_EQ(code, gone ? MVS_DRIVER_E_LOST : MVS_DRIVER_OK);
    CHECK_EQ(hand.plugin.write(0, 0, 0), gone ? MVS_DRIVER_E_LOST : MVS_DRIVER_OK);
    if (gone) CHECK(has(hand.plugin.error(), "unplugged"));
  }
}

TEST_CASE("a_slow_device_takes_longer_than_its_patience") {
  Options options = with_fault("slow", "0.001");
  options["fault_at"] = "0.001";
  Hand hand(options);
  const auto begin = std::chrono::steady_clock::now();
  hand.tick();
  const auto taken = std::chrono::steady_clock::now() - begin;
  CHECK_GT(taken, std::chrono::milliseconds(MVS_DRIVER_PATIENCE_MS));  // it sleeps 150 ms
}

TEST_CASE("a_device_that_cannot_be_opened_reports_why") {
  const std::map<std::string, int32_t> codes = {{"absent", MVS_DRIVER_E_ABSENT},
                                                {"licence", MVS_DRIVER_E_LICENCE}};
  for (const auto &[fault, code] : codes) {
    Plugin plugin("hand", {{"fault", fault}});
    CHECK_EQ(plugin.open(), code);
    CHECK(has(plugin.error(), fault));
    CHECK_EQ(plugin.list().empty(), fault == "absent");
  }
  Plugin plugin("hand", {{"fault", "uncalibrated"}});
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  CHECK_EQ(plugin.api.calibrate(plugin.device), MVS_DRIVER_E_CALIBRATION);
  CHECK(has(plugin.error(), "into its holder"));
  Plugin other("hand");
  CHECK_EQ(other.open("foot"), MVS_DRIVER_E_ABSENT);
}

TEST_CASE("the_devices_have_the_limits_of_the_published_tables") {
  const struct {
    const char *name;
    double force, stiffness;
  } table[] = {{"touch", 3.3, 400},     {"omni", 3.3, 700},      {"desktop", 7.9, 1000},
               {"premium15", 8.5, 800}, {"premium30", 22, 1000}, {"omega", 12, 5000},
               {"delta", 20, 5000},     {"lambda", 12, 8000},    {"falcon", 8, 3000}};
  for (const auto &row : table) {
    CAPTURE(row.name);
    Hand hand(Options{{"device", row.name}});
    const mvs_driver_info info = hand.plugin.info();
    CHECK_EQ(info.peak_force, row.force);
    CHECK_EQ(info.max_stiffness, row.stiffness);
    CHECK_LE(info.continuous_force, info.peak_force);
    CHECK_GE(info.rate, 1000);
    CHECK_GT(info.max_damping, 0);
    CHECK_GE(info.workspace_max[0], 0.04);
    CHECK(has(info.model, "(simulated)"));
  }
  Hand other(Options{{"device", "falcon"}, {"force", "2"}, {"stiffness", "50"}, {"rate", "333"}});
  CHECK_EQ(other.plugin.info().peak_force, 2);
  CHECK_EQ(other.plugin.info().max_stiffness, 50);
  CHECK_EQ(other.plugin.info().rate, 333);
}

TEST_CASE("a_position_is_a_multiple_of_the_encoder_step") {
  const Options swing = {{"amplitude", "0.01,0.02,0.03"}, {"frequency", "2"}};
  Options coarse = swing, fine = swing;
  coarse["resolution"] = "0.0001";
  fine["resolution"] = "0";
  Hand rough(coarse), smooth(fine);
  double least = 1, most = 0;
  for (int ms = 0; ms < 1000; ++ms) {
    rough.tick();
    smooth.tick();
    for (int k = 0; k < 3; ++k) {
      const double steps = rough.state.position[k] / 0.0001;
      CHECK(std::abs(steps - std::round(steps)) < 1e-9);
      const double error = std::abs(rough.state.position[k] - smooth.state.position[k]);
      CHECK_LE(error, 0.00005 * (1 + 1e-9));
      least = std::min(least, error);
      most = std::max(most, error);
    }
    CHECK_EQ(rough.state.velocity[0], 0);  // not measured, and not reported as measured
    CHECK_EQ(rough.state.flags & MVS_DRIVER_FLAG_VELOCITY, 0);
  }
  CHECK_GT(most, 0.00004);
}

TEST_CASE("motors_give_at_most_their_largest_force") {
  const Options free = {{"mass", "1"},        {"arm_stiffness", "0"},  {"arm_damping", "0"},
                        {"device_mass", "0"}, {"device_damping", "0"}, {"delay", "0"},
                        {"resolution", "0"},  {"force", "3"}};
  Hand hand(free);
  hand.plugin.write(30, 40, 0);
  hand.after(1000000000);
  // 3 N along (3, 4, 0) / 5 on 1 kg for 1 s
  CHECK(std::abs(hand.state.position[0] - 0.9) < 1e-12);
  CHECK(std::abs(hand.state.position[1] - 1.2) < 1e-12);
  CHECK((hand.state.flags & MVS_DRIVER_FLAG_SATURATED) != 0);
  hand.plugin.write(0, 3, 0);
  CHECK_EQ(hand.tick().flags & MVS_DRIVER_FLAG_SATURATED, 0);
  hand.plugin.write(0, 3.001, 0);
  CHECK_NE(hand.tick().flags & MVS_DRIVER_FLAG_SATURATED, 0);
}

TEST_CASE("motors_switched_off_by_the_device_have_no_effect") {
  for (const std::string fault : {"hot", "button"}) {
    Hand hand(ideal({{"fault", fault}, {"fault_for", "0.01"}}));
    for (int ms = 1; ms <= 20; ++ms) {
      hand.plugin.write(1, 0, 0);
      CHECK_EQ(hand.tick().position[0] == 0, ms <= 10);
    }
  }
}

TEST_CASE("a_force_with_nan_has_no_effect_and_is_reported") {
  Hand hand(ideal({}));
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    CHECK_EQ(hand.plugin.write(0, bad, 0), MVS_DRIVER_E_FAULT);
    CHECK(has(hand.plugin.error(), "not finite"));
    CHECK_EQ(hand.tick().position[1], 0);
    CHECK_EQ(hand.state.flags & MVS_DRIVER_FLAG_FORCE_ON, 0);
  }
}

TEST_CASE("invalid_options_of_the_hand_are_refused") {
  const std::string file = MVS_SOURCE_DIR "/haptic_drivers/replay/trajectories/circle.txt";
  const Options bad[] = {
      {{"device", "glove"}},
      {{"mass", "-1"}},
      {{"mass", "heavy"}},
      {{"mass", "nan"}},
      {{"mass", "0"}, {"device", "ideal"}},
      {{"arm_stiffness", "1e7"}},
      {{"arm_damping", ""}},
      {{"target", "1,2"}},
      {{"target", "0,0,0,0"}},
      {{"target", "0 0 0"}},
      {{"target", "0,0,2"}},
      {{"amplitude", "0.01,0,0"}},
      {{"frequency", "2"}},
      {{"file", "/no/such/file"}},
      {{"file", file}, {"target", "0,0,0"}},
      {{"push", "1,1,inf"}},
      {{"buttons", "-1"}},
      {{"velocity", "2"}},
      {{"delay", "1.5"}},
      {{"delay", "17"}},
      {{"rate", "0"}},
      {{"resolution", "1"}},
      {{"fault", "gremlin"}},
      {{"fault", "jump"}, {"fault_at", "-1"}},
      {{"fault_at", "1"}},
      {{"fault_for", "1"}},
  };
  for (const Options &options : bad) {
    Plugin plugin("hand", options);
    CAPTURE(options.begin()->first);
    CHECK_EQ(plugin.open(), MVS_DRIVER_E_OPTION);
    CHECK_EQ(plugin.device, nullptr);
    INFO(plugin.error());
    CHECK(has(plugin.error(), options.begin()->first));
    CHECK_EQ(plugin.doctor().at(0).verdict, 0);
  }
}
