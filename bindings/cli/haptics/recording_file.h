// A recording of the motion of a hand, in the format of the driver replay
// (haptic_drivers/replay/README.md).
#pragma once

#include <mvs/device.h>

#include <cstdio>
#include <memory>
#include <string>

namespace cli {

// Writes samples as they arrive: a file truncated by a crash can be played. It is written beside
// `path` and takes that name with the first samples that can be played; where it replaces a file,
// only at the end, so that a full disk or a crash leaves the former recording whole.
class RecordingFile {
 public:
  // These throw mvs::Error.
  explicit RecordingFile(const std::string &path);
  RecordingFile(const RecordingFile &) = delete;
  RecordingFile &operator=(const RecordingFile &) = delete;
  ~RecordingFile();

  void begin(const mvs_device_info &info);
  void add(const mvs_device_sample &sample);
  void flush();
  // Writes all of it to the disk and gives the file its name.
  void finish();
  size_t count() const { return count_; }
  double seconds() const { return last_s_ - first_s_; }
  bool is_full() const;
  bool can_be_played() const;

 private:
  [[noreturn]] void fail_to_write() const;
  void take_name();

  std::string path_, target_, beside_;  // `beside_` is empty once the file has its name
  std::unique_ptr<std::FILE, int (*)(std::FILE *)> file_;
  bool replaces_ = false;
  size_t count_ = 0;
  double first_s_ = 0, last_s_ = 0;
};

}  // namespace cli
