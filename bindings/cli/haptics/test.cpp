// `mvs haptics test`: measures the rate and jitter of a device, and with --force small pushes.
#include <unistd.h>

#include <cstdio>
#include <optional>

#include "haptics/device.h"
#include "haptics/haptics.h"
#include "haptics/push.h"
#include "haptics/sample_faults.h"
#include "haptics/ticks.h"

namespace cli {
namespace {

constexpr double test_period = 0.05;  // s, between two reads of the trace

struct TestOptions {
  DeviceOptions device;
  double seconds = 5;
  bool force = false, yes = false;
};

struct Tested {
  mvs_device_info info;
  mvs_device_state state;
  uint64_t lost;
  std::vector<Push> pushes;
  std::vector<SampleFault> faults;
};

// Asks before the device pushes a hand.
void confirm_push(const TestOptions &options, const mvs_device_info &info) {
  if (info.freedoms_out == 0) {
    fail(MVS_E_UNSUPPORTED, "force", "the device has no motors: leave out --force");
  }
  if (options.yes) return;
  std::fprintf(stderr,
               "The device will push with up to %.3f N for ten seconds. Hold the stylus loosely in "
               "the middle of its workspace; Ctrl-C stops it. Push? [y/N] ",
               push_of(info));
  const int answer = std::getchar();
  if (answer != 'y' && answer != 'Y') {
    fail(MVS_E_CANCELLED, "force", "not confirmed, so nothing was pushed: answer y, or give --yes");
  }
}

// Collects ticks without forces.
void collect_ticks(const TestOptions &options, Session &session, Ticks &ticks) {
  while (session.elapsed() < options.seconds && !session.is_over()) {
    const uint64_t lost = session.lost();
    const auto samples = session.pass(std::min(test_period, options.seconds));
    ticks.take(samples, session.lost() > lost);
  }
}

// Hz, over all ticks, including those lost from the trace.
Json rate_of(const Tested &tested, const Ticks &ticks) {
  if (ticks.count() < 2) return {};
  return static_cast<double>(ticks.count() + tested.lost - 1) / ticks.seconds();
}

Json tested_json(const TestOptions &options, const Tested &tested, const Ticks &ticks) {
  const mvs_device_state &state = tested.state;
  const bool latched = state.phase == MVS_DEVICE_PHASE_LATCHED;
  Json json = {{"device", info_json(tested.info)},
               {"clock", options.device.is_virtual ? "virtual" : "real"},
               {"realtime", tested.info.realtime != 0},
               {"seconds", ticks.seconds()},
               {"ticks", ticks.count()},
               {"rate_Hz", rate_of(tested, ticks)},
               {"late", state.late},
               {"lost", tested.lost},
               {"worst_period_us", 1e6 * state.worst_period},
               {"bad_samples", state.bad_samples},
               {"faults", sample_faults_json(tested.faults)},
               {"latched", latched ? Json(cause_of(state.cause).name) : Json()}};
  json.update(ticks.json());
  if (options.force) json["pushes"] = pushes_json(tested.pushes);
  return json;
}

const char *clock_text(const TestOptions &options, const Tested &tested) {
  if (options.device.is_virtual) return "virtual clock";
  return tested.info.realtime ? "real-time priority granted"
                              : "real-time priority REFUSED: see mvs haptics doctor";
}

std::string tested_text(const TestOptions &options, const Tested &tested, const Ticks &ticks) {
  const mvs_device_state &state = tested.state;
  std::string lines = info_text(tested.info);
  lines += text("  %zu ticks in %.3f s, %llu late; %s\n", ticks.count(), ticks.seconds(),
                static_cast<unsigned long long>(state.late), clock_text(options, tested));
  lines += ticks.text() + pushes_text(tested.pushes) + sample_faults_text(tested.faults, state);
  if (state.phase == MVS_DEVICE_PHASE_LATCHED) {
    lines += text("  forces latched off (%s): %s\n", cause_of(state.cause).name,
                  cause_of(state.cause).sentence);
  }
  lines.pop_back();
  return lines;
}

void run_test(const TestOptions &options, Console &console) {
  Session session(options.device);
  const mvs_device_info info = session.device().info();
  std::optional<TautChord> chord;
  if (options.force) {
    confirm_push(options, info);
    chord = taut_chord();
  }
  session.start();
  Ticks ticks(info.rate);
  collect_ticks(options, session, ticks);
  Tested tested = {};
  const bool is_sound = sample_faults(session.device().state()).empty();
  if (chord && is_sound && !session.is_over()) {
    tested.pushes = push_hand(session, *chord, push_of(info), ticks);
  }
  tested.info = session.device().info();
  tested.state = session.device().state();
  tested.faults = sample_faults(tested.state);
  // a jump is a fault of its own only where the samples are well formed
  if (tested.faults.empty()) {
    tested.faults = trace_faults(ticks.fastest(), ticks.seconds(), session.elapsed());
  }
  tested.lost = session.lost();
  session.stop();
  if (session.is_interrupted()) {
    fail(MVS_E_CANCELLED, "test", "stopped by Ctrl-C; forces are off");
  }
  print(console, tested_json(options, tested, ticks), tested_text(options, tested, ticks));
  print_faults(tested.info, tested.state, tested.faults);
  if (!tested.faults.empty() || is_lost(tested.state)) console.exit_code = 1;
}

}  // namespace

void add_haptics_test(CLI::App &haptics, Console &console) {
  const auto [command, options] = add_command<TestOptions>(
      haptics, console, "test",
      "measure a device's rate and jitter, and check its samples; with --force push the hand; exit "
      "code 1 for a fault",
      run_test);
  add_device_options(*command, options->device);
  command->add_option("--seconds", options->seconds, "duration of the measurement")
      ->capture_default_str()
      ->check(CLI::Range(0.01, 3600.0));
  CLI::Option *force =
      command->add_flag("--force", options->force,
                        "then push along each axis: 0.5 N, or a quarter of the continuous force");
  command->add_flag("--yes", options->yes, "push without asking")->needs(force);
}

}  // namespace cli
