// Surfaces and landmarks of `mvs import`, in one frame, in m.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <mvs/experimental.hpp>
#include <string>
#include <vector>

namespace cli {

// How files state their unit and frame.
struct FileOptions {
  std::string unit = "mm";  // of files that state none
  std::string frame;        // of files that state none; empty: that of the others
};
void add_file_options(CLI::App &command, FileOptions &options);

// Files of one patient. Those that state a frame are turned to LPS, in which valves are in memory
// and in files; the others are taken to be in the frame that the user gives, else in that of the
// surface, else in that which all landmarks state.
class PatientFiles {
 public:
  PatientFiles(const FileOptions &options, const std::string &surface);

  // Opens a file of landmarks, or of a surface. Nothing for an empty path.
  void add_landmarks(const std::string &path);
  void add_surface(const std::string &path);

  // Finds the frame of files that state none. Fails if landmarks of a surface that states none are
  // in different frames. Then points can be read.
  void settle_frames();

  const mvs::SurfaceFile &file(const std::string &path) const { return files_.at(path); }
  // Points x, y, z in turn, m, in LPS where the frame is known.
  std::vector<double> points(const std::string &path) const;
  // LPS, or unknown.
  mvs_patient_frame frame() const;

 private:
  FileOptions options_;
  std::string surface_;
  std::map<std::string, mvs::SurfaceFile> files_;
  mvs_patient_frame unstated_ = MVS_PATIENT_FRAME_UNKNOWN;
};

// Metres of a unit.
double metres(mvs_length_unit unit);
const char *frame_name(mvs_patient_frame frame);

}  // namespace cli
