// Fixtures: files of recordings for the driver that plays them.
#pragma once

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "plugin.h"

// A temporary file, removed by its owner's destructor.
class RecordingFile {
 public:
  explicit RecordingFile(const std::string &text = {}) {
    static int count = 0;
    const auto folder = std::filesystem::temp_directory_path();
    path_ = folder / ("mvs_replay_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    put(text);
  }
  ~RecordingFile() { std::filesystem::remove(path_); }
  RecordingFile(const RecordingFile &) = delete;
  RecordingFile &operator=(const RecordingFile &) = delete;

  void put(const std::string &text) const { std::ofstream(path_, std::ios::binary) << text; }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

// Starts at 5 s, with samples 10, 40 and 50 ms apart; turns a quarter about z in the first part.
inline const char *const short_recording =
    "mvs-recording 1\n"
    "# for tests\n"
    "device Test stylus\n"
    "force 3.5\n"
    "rate 500\n"
    "\n"
    "5.00 0.01 0 -0.02  1 0 0 0  0 0\n"
    "5.01 0.02 0 -0.02  -0.70710678118654757 0 0 -0.70710678118654757  1 0.2 # grasp\n"
    "5.05 0.02 0.04 -0.02  0.70710678118654757 0 0 0.70710678118654757  1 0.4\n"
    "5.10 0.02 0.04 0.03  0.70710678118654757 0 0 0.70710678118654757  2 0.4\n";

inline const char *const recordings_folder = MVS_SOURCE_DIR "/haptic_drivers/replay/trajectories/";

inline mvs_driver_state at(Plugin &plugin, double seconds) {
  mvs_driver_state state;
  REQUIRE_EQ(plugin.read(static_cast<uint64_t>(std::llround(seconds * 1e9)), state), MVS_DRIVER_OK);
  return state;
}
