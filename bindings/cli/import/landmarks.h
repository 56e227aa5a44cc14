// Surfaces and landmarks of `mvs import`, in one frame and in m.
#pragma once

#include <CLI/CLI.hpp>
#include <mvs/experimental.hpp>
#include <string>
#include <vector>

namespace cli {

// How files state their unit and frame.
struct FileOptions {
  std::string unit = "mm";
  std::string frame;  // empty: that of the surface
};
void add_file_options(CLI::App &command, FileOptions &options);

mvs::SurfaceFile read_surface(const std::string &path, const FileOptions &options,
                              mvs_patient_frame wanted = MVS_PATIENT_FRAME_UNKNOWN);

// Points x, y, z in turn, in the frame of the surface. Fails if the file is in another known frame
// and the surface's is not known.
std::vector<double> read_landmarks(const std::string &path, const FileOptions &options,
                                   mvs_patient_frame surface);

// Metres of a unit.
double metres(mvs_length_unit unit);
const char *frame_name(mvs_patient_frame frame);

}  // namespace cli
