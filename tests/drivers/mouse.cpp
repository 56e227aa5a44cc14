// The driver mouse, with a test as the window: filter, buttons, torn writes, error messages.
#include <cmath>
#include <set>
#include <thread>

#include "mouse_window.h"
#include "plugin.h"

namespace {

constexpr uint64_t kMouseTick = 1000000;  // ns
constexpr double kFilterTime = 0.02;      // s, of the filter

Plugin mouse_of(MouseWindow &window, const std::string &smooth = "0.02") {
  return Plugin("mouse", {{"pointer", window.name()}, {"smooth", smooth}});
}

}  // namespace

TEST_CASE("a_step_of_the_pointer_becomes_the_step_response_of_the_filter") {
  MouseWindow window;
  Plugin plugin = mouse_of(window);
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  mvs_driver_state state;
  window.point(0.01, 0, 0);
  REQUIRE_EQ(plugin.read(kMouseTick, state), MVS_DRIVER_OK);
  CHECK_EQ(state.position[0], 0.01);  // starts at the pointer, at rest
  CHECK_EQ(state.velocity[0], 0);
  const double step = 0.02;
  window.point(0.01 + step, -0.5 * step, 0);
  for (uint64_t n = 2; n <= 400; ++n) {
    REQUIRE_EQ(plugin.read(n * kMouseTick, state), MVS_DRIVER_OK);
    const double t = 1e-3 * static_cast<double>(n - 1) / kFilterTime;
    const double rest = (1 + t) * std::exp(-t);
    // rounding of 400 steps
    CHECK_LT(std::abs(state.position[0] - (0.01 + step * (1 - rest))), 1e-14);
    CHECK_LT(std::abs(state.position[1] + 0.5 * step * (1 - rest)), 1e-14);
    CHECK_LT(std::abs(state.velocity[0] - step * t * std::exp(-t) / kFilterTime), 1e-12);
    CHECK_EQ(state.position[2], 0);
  }
}

TEST_CASE("the_path_does_not_depend_on_the_rate_of_the_servo") {
  MouseWindow window;
  Plugin fine = mouse_of(window), coarse = mouse_of(window);
  REQUIRE_EQ(fine.open(), MVS_DRIVER_OK);
  REQUIRE_EQ(coarse.open(), MVS_DRIVER_OK);
  mvs_driver_state a, b;
  window.point(0, 0, 0);
  fine.read(kMouseTick, a);
  coarse.read(kMouseTick, b);
  window.point(0.005, 0.01, -0.01);
  for (uint64_t n = 1; n <= 30; ++n) fine.read(kMouseTick + n * kMouseTick, a);
  coarse.read(kMouseTick + 30 * kMouseTick, b);
  for (int k = 0; k < 3; ++k) CHECK_LT(std::abs(a.position[k] - b.position[k]), 1e-15);
}

// Returns the largest deviation of the hand's velocity from that of an even motion, as a share of
// it, for a pointer that is reported in ticks with these remainders modulo `period`.
static double ripple_of(const std::set<uint64_t> &events, uint64_t period) {
  MouseWindow window;
  Plugin plugin = mouse_of(window);
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  const double speed = 0.05;
  double worst = 0;
  for (uint64_t n = 1; n <= 900; ++n) {
    if (events.count(n % period)) window.point(-0.03 + speed * 1e-3 * double(n), 0, 0);
    mvs_driver_state state;
    REQUIRE_EQ(plugin.read(n * kMouseTick, state), MVS_DRIVER_OK);
    // after 20 time constants the filter has settled
    if (n > 420) worst = std::max(worst, std::abs(state.velocity[0] / speed - 1));
  }
  return worst;
}

TEST_CASE("a_pointer_at_60_hz_moves_the_hand_evenly") {
  // The velocity is the sum of the responses v a s exp(-s) to steps of equal size, with a =
  // interval / T and s = time since the step / T; it is smallest just at an event.
  const double a = 0.016 / kFilterTime, r = std::exp(-a);
  const double even = ripple_of({0}, 16);
  CHECK_LT(std::abs(even - (1 - a * a * r / ((1 - r) * (1 - r)))), 1e-6);
  CHECK_LT(even, 0.06);
  // intervals of 17, 16 and 17 ms, because 60 Hz is no divisor of 1 kHz
  CHECK_LT(ripple_of({1, 18, 34}, 50), 0.07);
}

TEST_CASE("a_jump_of_the_pointer_moves_the_hand_at_a_bounded_speed_within_its_box") {
  MouseWindow window;
  Plugin plugin = mouse_of(window, "0.005");
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  mvs_driver_state state, before;
  window.point(-9, 0, 0);
  plugin.read(kMouseTick, before);
  CHECK_EQ(before.position[0], plugin.info().workspace_min[0]);
  window.point(9, 9, 9);
  for (uint64_t n = 2; n <= 600; ++n) {
    REQUIRE_EQ(plugin.read(n * kMouseTick, state), MVS_DRIVER_OK);
    double square = 0, fast = 0;
    for (int k = 0; k < 3; ++k) {
      square += std::pow(state.position[k] - before.position[k], 2);
      fast += std::pow(state.velocity[k], 2);
    }
    CHECK_LE(std::sqrt(square), 0.5e-3 * (1 + 1e-12));
    CHECK_LE(std::sqrt(fast), 0.5 * (1 + 1e-12));
    before = state;
  }
  for (int k = 0; k < 3; ++k) {
    CHECK_LT(std::abs(state.position[k] - plugin.info().workspace_max[k]), 1e-9);
  }
  window.point(NAN, 0, INFINITY);
  for (uint64_t n = 601; n <= 700; ++n)
    REQUIRE_EQ(plugin.read(n * kMouseTick, state), MVS_DRIVER_OK);
  CHECK_LT(std::abs(state.position[0] - 0.05), 1e-9);
}

TEST_CASE("buttons_are_those_of_the_pointer") {
  MouseWindow window;
  Plugin plugin = mouse_of(window);
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  mvs_driver_state state;
  REQUIRE_EQ(plugin.read(kMouseTick, state),
             MVS_DRIVER_OK);  // before the first event of the window
  CHECK_EQ(state.buttons, 0);
  window.point(0, 0, 0, MOUSE_POINTER_LEFT);
  REQUIRE_EQ(plugin.read(2 * kMouseTick, state), MVS_DRIVER_OK);
  CHECK_EQ(state.buttons, 1);
  window.point(0, 0, 0, 0xffffffff);
  REQUIRE_EQ(plugin.read(3 * kMouseTick, state), MVS_DRIVER_OK);
  CHECK_EQ(state.buttons, 7);  // as many as info reports
  CHECK_EQ(plugin.info().buttons, 3);
  CHECK_EQ(plugin.info().freedoms_out, 0);
}

// The window writes (x, 2 x, -x) as fast as it can: any other ratio is a mixture of two writes.
TEST_CASE("a_reader_never_gets_parts_of_two_writes") {
  MouseWindow window;
  bool done = false;
  std::thread writer([&] {
    for (int n = 0; !__atomic_load_n(&done, __ATOMIC_RELAXED); n = (n + 1) % 1000) {
      const double x = 1e-5 * n;
      window.point(x, 2 * x, -x, static_cast<uint32_t>(n));
    }
  });
  int read = 0;
  for (int n = 0; n < 200000 || read < 1000; ++n) {
    double at[3];
    uint32_t buttons = 0;
    if (!mouse_pointer_read(&window.pointer(), at, &buttons)) continue;
    ++read;
    const double x = 1e-5 * buttons;
    if (at[0] != x || at[1] != 2 * x || at[2] != -x) FAIL("a torn sample");
  }
  __atomic_store_n(&done, true, __ATOMIC_RELAXED);
  writer.join();
}

TEST_CASE("a_write_that_was_interrupted_keeps_the_last_sample") {
  MouseWindow window;
  Plugin plugin = mouse_of(window);
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  mvs_driver_state state;
  window.point(0.01, 0, 0, MOUSE_POINTER_LEFT);
  REQUIRE_EQ(plugin.read(kMouseTick, state), MVS_DRIVER_OK);
  window.pointer().sequence += 1;
  window.pointer().position[0] = 0.04;
  REQUIRE_EQ(plugin.read(100 * kMouseTick, state), MVS_DRIVER_OK);
  CHECK_EQ(state.position[0], 0.01);
  CHECK_EQ(state.buttons, 1);
}

TEST_CASE("without_a_window_the_driver_explains_how_to_get_one") {
  Plugin plugin("mouse");
  CHECK(plugin.list().empty());
  CHECK_EQ(plugin.open(), MVS_DRIVER_E_ABSENT);
  CHECK_EQ(plugin.device, nullptr);
  CHECK_NE(plugin.error().find("start the example phantom"), std::string::npos);
  const auto findings = plugin.doctor();
  REQUIRE_EQ(findings.size(), 1);
  CHECK_EQ(findings[0].verdict, 2);
  CHECK_NE(findings[0].sentence.find("no program has named"), std::string::npos);
}

TEST_CASE("a_window_is_found_by_its_name") {
  MouseWindow window;
  Plugin plugin("mouse", {{"pointer", window.name()}});
  CHECK_EQ(plugin.list(), std::vector<std::string>{"pointer"});
  CHECK_EQ(plugin.doctor().at(0).verdict, 1);
  CHECK_EQ(plugin.open("touchpad"), MVS_DRIVER_E_ABSENT);
  CHECK_EQ(plugin.error(),
           "there is no device 'touchpad': the one of this driver is called pointer");
  REQUIRE_EQ(plugin.open("pointer"), MVS_DRIVER_OK);
  window.unlink();  // the driver keeps its own mapping
  window.point(0.02, 0, 0);
  mvs_driver_state state;
  REQUIRE_EQ(plugin.read(kMouseTick, state), MVS_DRIVER_OK);
  CHECK_EQ(state.position[0], 0.02);
  mouse_pointer_end(&window.pointer());
  CHECK_EQ(plugin.read(2 * kMouseTick, state), MVS_DRIVER_E_LOST);
  CHECK_EQ(plugin.error(), "the window of the pointer was closed");
}

TEST_CASE("shared_memory_that_is_no_pointer_is_refused") {
  Plugin absent("mouse", {{"pointer", "/mvs-no-such-window"}});
  CHECK_EQ(absent.open(), MVS_DRIVER_E_ABSENT);
  CHECK_NE(absent.error().find("\"/mvs-no-such-window\""), std::string::npos);
  CHECK_EQ(absent.doctor().at(0).verdict, 0);
  MouseWindow window;
  window.pointer().magic = 42;
  Plugin other("mouse", {{"pointer", window.name()}});
  CHECK_EQ(other.open(), MVS_DRIVER_E_OPTION);
  CHECK_NE(other.error().find("is not a mouse_pointer"), std::string::npos);
  window.pointer().magic = MOUSE_POINTER_MAGIC;
  window.resize(16);
  Plugin shorter("mouse", {{"pointer", window.name()}});
  CHECK_EQ(shorter.open(), MVS_DRIVER_E_OPTION);
  Plugin rough("mouse", {{"pointer", window.name()}, {"smooth", "0"}});
  CHECK_EQ(rough.open(), MVS_DRIVER_E_OPTION);
  CHECK_EQ(rough.error(), "option smooth=0: give a number from 0.001 to 1");
}
