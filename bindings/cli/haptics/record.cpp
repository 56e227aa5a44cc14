// `mvs haptics record`: writes the motion of the hand in the format of the driver replay
// (haptic_drivers/replay/README.md).
#include <cstdio>

#include "commands/commands.h"
#include "haptics/device.h"
#include "haptics/haptics.h"
#include "haptics/recording_file.h"
#include "haptics/sample_faults.h"

namespace cli {
namespace {

constexpr double record_period = 0.02;  // s, between two reads of the trace
constexpr double patience = 0.5;        // s, for samples whose time stands still

struct RecordOptions {
  DeviceOptions device;
  std::string out;
  double seconds = 0;  // 0: until Ctrl-C
};

// The time of refused samples stands still: a device without others does not reach the end.
bool stands_still(const RecordOptions &options, const Session &session) {
  return options.seconds > 0 && session.elapsed() > options.seconds + patience;
}

// Returns false where the samples stood still before the end.
bool record_samples(const RecordOptions &options, Session &session, RecordingFile &file) {
  for (;;) {
    const bool is_over = session.is_over(), is_still = stands_still(options, session);
    bool more = true;
    for (const mvs_device_sample &sample : session.pass(record_period)) {
      more = !file.is_full() && (options.seconds == 0 || sample.time < options.seconds);
      if (!more) break;
      file.add(sample);
    }
    file.flush();
    if (!more || is_over) return true;
    if (is_still) return false;
  }
}

// Records, and returns whether the device was sound to the end: its faults go to stderr.
bool record_device(const RecordOptions &options, Session &session, RecordingFile &file) {
  const bool has_samples = record_samples(options, session, file);
  const mvs_device_state state = session.device().state();
  print_faults(session.device().info(), state, sample_faults(state));
  if (!has_samples) {
    std::fprintf(stderr, "mvs: %s gave no good samples to the end of the %g s (mvs haptics test)\n",
                 options.device.driver.c_str(), options.seconds);
  }
  return has_samples && !is_lost(state);
}

void run_record(const RecordOptions &options, Console &console) {
  if (options.device.is_virtual && options.seconds == 0) {
    fail(MVS_E_ARGUMENT, "seconds", "a virtual clock does not wait: give --seconds");
  }
  Session session(options.device);
  const mvs_device_info info = session.device().info();
  RecordingFile file(options.out);
  file.begin(info);
  if (options.seconds == 0) std::fprintf(stderr, "mvs: recording; Ctrl-C ends it\n");
  session.start();
  if (!record_device(options, session, file)) console.exit_code = 1;
  session.stop();
  if (!file.can_be_played()) {
    fail(MVS_E_DEVICE, options.device.driver,
         text("%s reported fewer than two positions: nothing to replay",
              options.device.driver.c_str()));
  }
  file.finish();
  print(console,
        {{"file", options.out},
         {"device", info_json(info)},
         {"samples", file.count()},
         {"seconds", file.seconds()},
         {"lost", session.lost()}},
        text("%s: %zu samples in %.3f s%s", options.out.c_str(), file.count(), file.seconds(),
             session.lost() > 0
                 ? text(", %llu lost", static_cast<unsigned long long>(session.lost())).c_str()
                 : ""));
}

}  // namespace

void add_haptics_record(CLI::App &haptics, Console &console) {
  const auto [command, options] = add_command<RecordOptions>(
      haptics, console, "record",
      "write the motion of the hand for the driver replay; without forces; exit code 1 for a "
      "device that is lost or gives no good samples",
      run_record);
  add_device_options(*command, options->device);
  command->add_option("-o,--output", options->out, "recording to write")->required();
  command
      ->add_option("--seconds", options->seconds,
                   "duration, at most 1000 s at 1 kHz [until Ctrl-C]")
      ->check(positive());
}

}  // namespace cli
