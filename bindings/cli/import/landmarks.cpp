#include "import/landmarks.h"

#include "commands/commands.h"

namespace cli {
namespace {

mvs_length_unit unit_number(const std::string &unit) {
  if (unit == "m") return MVS_LENGTH_UNIT_M;
  return unit == "cm" ? MVS_LENGTH_UNIT_CM : MVS_LENGTH_UNIT_MM;
}

mvs_patient_frame frame_number(const std::string &frame) {
  if (frame == "LPS") return MVS_PATIENT_FRAME_LPS;
  return frame == "RAS" ? MVS_PATIENT_FRAME_RAS : MVS_PATIENT_FRAME_UNKNOWN;
}

}  // namespace

void add_file_options(CLI::App &command, FileOptions &options) {
  command.add_option("--unit", options.unit, "lengths of all files: mm, cm or m")
      ->capture_default_str()
      ->check(one_of({"mm", "cm", "m"}));
  command
      .add_option("--frame", options.frame,
                  "frame of the valve, LPS or RAS [that of the surface]; files that state theirs "
                  "are turned to it")
      ->check(one_of({"LPS", "RAS"}));
}

mvs::SurfaceFile read_surface(const std::string &path, const FileOptions &options,
                              mvs_patient_frame wanted) {
  mvs_surface_file_options how = {};
  how.unit = unit_number(options.unit);
  how.frame = wanted != MVS_PATIENT_FRAME_UNKNOWN ? wanted : frame_number(options.frame);
  mvs::SurfaceFile file(path, how);
  if (file.info().triangles.count == 0) {
    fail(MVS_E_FORMAT, path, path + ": has points and no triangles: a surface is needed here");
  }
  return file;
}

std::vector<double> read_landmarks(const std::string &path, const FileOptions &options,
                                   mvs_patient_frame surface) {
  mvs_surface_file_options how = {};
  const bool states_unit = path.size() > 5 && path.substr(path.size() - 5) == ".json";
  how.unit = states_unit ? 0 : unit_number(options.unit);
  how.frame = surface;
  const mvs::SurfaceFile file(path, how);
  const mvs_surface_file_info info = file.info();
  if (surface == MVS_PATIENT_FRAME_UNKNOWN && info.frame != MVS_PATIENT_FRAME_UNKNOWN) {
    log_to_stderr(nullptr, MVS_LOG_WARNING,
                  (path + ": is in the frame " + frame_name(info.frame) +
                   ", the surface states none: both are taken for the same frame")
                      .c_str());
  }
  const mvs::View<double> points(info.points);
  return {points.begin(), points.end()};
}

double metres(mvs_length_unit unit) {
  return unit == MVS_LENGTH_UNIT_M ? 1 : (unit == MVS_LENGTH_UNIT_CM ? 1e-2 : 1e-3);
}

const char *frame_name(mvs_patient_frame frame) {
  if (frame == MVS_PATIENT_FRAME_LPS) return "LPS";
  return frame == MVS_PATIENT_FRAME_RAS ? "RAS" : "unknown";
}

}  // namespace cli
