#include "haptics/recording_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "text/output_file.h"
#include "text/replace_file.h"
#include "valve/host.h"

namespace cli {
namespace {

constexpr double min_sample_step = 1e-6;  // s, required by the format
constexpr size_t min_samples = 2;         // of the format
constexpr size_t max_samples = 1000000;   // likewise

}  // namespace

// A pipe or device is no file to be replaced. Of a link the target is.
RecordingFile::RecordingFile(const std::string &path)
    : path_(path), target_(path), file_(nullptr, &std::fclose) {
  std::error_code none;
  const auto old = std::filesystem::status(path, none);
  const bool is_file = std::filesystem::is_regular_file(old);
  if (is_file && ::access(path.c_str(), W_OK) != 0) fail_to_write();
  if (is_file || !std::filesystem::exists(old)) {
    const OutputTarget target = output_target(path_);
    target_ = target.file;  // also of a link to a new file
    const int file = open_new(target.folder, beside_);
    if (file >= 0) file_.reset(::fdopen(file, "w"));
  } else {
    file_.reset(std::fopen(path_.c_str(), "w"));
  }
  if (!file_) {
    beside_.clear();
    fail_to_write();
  }
  replaces_ = is_file;
  if (is_file) std::filesystem::permissions(beside_, old.permissions(), none);
}

RecordingFile::~RecordingFile() {
  if (!beside_.empty()) ::unlink(beside_.c_str());
}

void RecordingFile::fail_to_write() const {
  fail(MVS_E_IO, path_, path_ + " cannot be written: " + std::strerror(errno));
}

void RecordingFile::take_name() {
  if (std::rename(beside_.c_str(), target_.c_str()) != 0) fail_to_write();
  beside_.clear();
}

bool RecordingFile::is_full() const {
  return count_ >= max_samples;
}

bool RecordingFile::can_be_played() const {
  return count_ >= min_samples;
}

void RecordingFile::flush() {
  if (std::fflush(file_.get()) != 0 || std::ferror(file_.get())) fail_to_write();
  if (can_be_played() && !beside_.empty() && !replaces_) take_name();
}

void RecordingFile::finish() {
  flush();
  if (beside_.empty()) return;
  if (::fsync(::fileno(file_.get())) != 0) fail_to_write();
  take_name();
}

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

}  // namespace cli
