// Options and device description of the replay driver.
#include "settings.h"

#include "common/recording_file.h"

namespace replay {

namespace {

using driver::Options;
using driver::refuse;

// m, margin of the default workspace around the recorded positions. The box is symmetric about the
// recording's zero, because libmvs measures positions from the middle of the workspace.
constexpr double kMargin = 0.02;

End end_of(const Options &options) {
  const std::string end = options.text("end").value_or("stay");
  if (end == "stay") return End::kStay;
  if (end == "loop") return End::kLoop;
  if (end == "stop") return End::kStop;
  refuse(MVS_DRIVER_E_OPTION, "option end=" + end + ": give stay, loop or stop");
}

// Returns the number of the option, otherwise of the file, otherwise 0.
double number_of(const Options &options, const char *key, double in_file) {
  return options.number(key, in_file < 0 ? 0 : in_file, 0, 1e6);
}

void put_workspace(const driver::Recording &recording, mvs_driver_info &info) {
  const auto &box = recording.source().workspace;
  for (int k = 0; k < 3; ++k) {
    info.workspace_min[k] = box[k];
    info.workspace_max[k] = box[k + 3];
    if (box[k] < box[k + 3]) continue;
    double most = 0;
    for (const auto &sample : recording.samples())
      most = std::max(most, std::abs(sample.pose.position[k]));
    info.workspace_min[k] = -(most + kMargin);
    info.workspace_max[k] = most + kMargin;
  }
}

// Sets buttons, orientation and gripper by their use in the recording.
void put_freedoms(const driver::Recording &recording, mvs_driver_info &info) {
  const std::array<double, 4> unturned = {1, 0, 0, 0};
  uint32_t pressed = 0;
  info.freedoms_in = 3;
  for (const auto &sample : recording.samples()) {
    pressed |= sample.pose.buttons;
    if (sample.pose.orientation != unturned) info.freedoms_in = 6;
    if (sample.pose.gripper != 0) info.has_gripper = 1;
  }
  info.buttons = recording.source().buttons;
  while (info.buttons < 32 && pressed >> info.buttons) ++info.buttons;
}

mvs_driver_info info_of(const Options &options, const driver::Recording &recording) {
  const driver::Source &source = recording.source();
  mvs_driver_info info = {};
  put_workspace(recording, info);
  put_freedoms(recording, info);
  info.peak_force = number_of(options, "force", source.force);
  // force 0 in file or option: no motors; an unknown force: a device with force
  const bool without_motors = info.peak_force == 0 && (source.force == 0 || options.given("force"));
  info.freedoms_out = without_motors ? 0 : 3;
  info.continuous_force = number_of(options, "continuous_force", source.continuous_force);
  info.max_stiffness = number_of(options, "stiffness", source.stiffness);
  info.max_damping = number_of(options, "damping", source.damping);
  info.rate = number_of(options, "rate", source.rate);
  if (info.rate == 0) info.rate = 1000;
  if (info.rate < 1 || info.rate > 1e5) refuse(MVS_DRIVER_E_OPTION, "rate: give 1 to 100000 Hz");
  const std::string device = options.text("device").value_or(source.device);
  std::snprintf(info.model, sizeof info.model, "%s", device.empty() ? "recording" : device.c_str());
  return info;
}

}  // namespace

Settings settings(const mvs_driver_host *host, const char *name) {
  const Options options(host);
  const std::string file = name ? name : options.text("file").value_or("");
  if (file.empty())
    refuse(MVS_DRIVER_E_OPTION, "replay plays a file: give the option file=RECORDING");
  driver::Recording recording = driver::RecordingFile::load(file);
  const mvs_driver_info info = info_of(options, recording);
  return {file, end_of(options), options.number("speed", 1, 1e-3, 100), std::move(recording), info};
}

}  // namespace replay
