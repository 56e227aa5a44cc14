// `mvs haptics record`: writes the motion of the hand in the format of the driver replay
// (haptic_drivers/replay/README.md).
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "commands/commands.h"
#include "haptics/device.h"
#include "haptics/haptics.h"

namespace cli {
namespace {

constexpr double record_period = 0.02;    // s, between two reads of the trace
constexpr double min_sample_step = 1e-6;  // s, required by the format
constexpr size_t max_samples = 1000000;   // of the format

struct RecordOptions {
  DeviceOptions device;
  std::string out;
  double seconds = 0;  // 0: until Ctrl-C
};

// Writes samples as they arrive: a file truncated by a crash can be played.
class RecordingFile {
 public:
  explicit RecordingFile(const std::string &path)
      : path_(path), file_(std::fopen(path.c_str(), "w"), &std::fclose) {
    if (!file_) fail_to_write();
  }

  void begin(const mvs_device_info &info);
  void add(const mvs_device_sample &sample);
  void flush() {
    if (std::fflush(file_.get()) != 0) fail_to_write();
  }
  size_t count() const { return count_; }
  double seconds() const { return last_s_ - first_s_; }

 private:
  [[noreturn]] void fail_to_write() const {
    fail(MVS_E_IO, path_, path_ + " cannot be written: " + std::strerror(errno));
  }

  std::string path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE *)> file_;
  size_t count_ = 0;
  double first_s_ = 0, last_s_ = 0;
};

void RecordingFile::begin(const mvs_device_info &info) {
  const double *const low = info.workspace_min, *const high = info.workspace_max;
  std::fprintf(file_.get(), "mvs-recording 1\n# by mvs haptics record, driver %s\n", info.driver);
  if (info.model[0]) std::fprintf(file_.get(), "device %s\n", info.model);
  std::fprintf(file_.get(), "force %.9g\n", info.freedoms_out == 0 ? 0 : info.peak_force);
  std::fprintf(file_.get(), "continuous_force %.9g\nstiffness %.9g\ndamping %.9g\nrate %.9g\n",
               info.continuous_force, info.max_stiffness, info.max_damping, info.rate);
  if (low[0] < high[0]) {
    std::fprintf(file_.get(), "workspace %.9g %.9g %.9g %.9g %.9g %.9g\n", low[0], low[1], low[2],
                 high[0], high[1], high[2]);
  }
  std::fprintf(file_.get(), "buttons %u\n", info.buttons);
  std::fprintf(file_.get(),
               "# time s, position m x y z, orientation w x y z, buttons, gripper rad\n");
}

// Nanoseconds and nanometres, the resolution of replay.
void RecordingFile::add(const mvs_device_sample &sample) {
  if (count_ > 0 && sample.time < last_s_ + min_sample_step) return;
  const double *const p = sample.position, *const q = sample.orientation;
  std::fprintf(file_.get(), "%.9f %.9f %.9f %.9f %.9f %.9f %.9f %.9f %u %.6f\n", sample.time, p[0],
               p[1], p[2], q[0], q[1], q[2], q[3], sample.buttons, sample.gripper);
  if (count_++ == 0) first_s_ = sample.time;
  last_s_ = sample.time;
}

void record_samples(const RecordOptions &options, Session &session, RecordingFile &file) {
  bool more = true;
  while (more) {
    const bool over = session.is_over();
    for (const mvs_device_sample &sample : session.pass(record_period)) {
      more = file.count() < max_samples && (options.seconds == 0 || sample.time < options.seconds);
      if (!more) break;
      file.add(sample);
    }
    file.flush();
    more = more && !over;
  }
}

void run_record(const RecordOptions &options, const Console &console) {
  if (options.device.is_virtual && options.seconds == 0) {
    fail(MVS_E_ARGUMENT, "seconds", "a virtual clock does not wait: give --seconds");
  }
  Session session(options.device);
  const mvs_device_info info = session.device().info();
  RecordingFile file(options.out);
  file.begin(info);
  if (options.seconds == 0) std::fprintf(stderr, "mvs: recording; Ctrl-C ends it\n");
  session.start();
  record_samples(options, session, file);
  session.stop();
  if (file.count() < 2) {
    fail(MVS_E_DEVICE, options.device.driver,
         text("%s reported fewer than two positions: nothing to replay",
              options.device.driver.c_str()));
  }
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
      "write the motion of the hand for the driver replay; without forces", run_record);
  add_device_options(*command, options->device);
  command->add_option("-o,--output", options->out, "recording to write")->required();
  command
      ->add_option("--seconds", options->seconds,
                   "duration, at most 1000 s at 1 kHz [until Ctrl-C]")
      ->check(positive());
}

}  // namespace cli
