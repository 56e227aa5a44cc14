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

// Opens a file with the unit that it states, else with that of the user.
mvs::SurfaceFile opened(const std::string &path, const FileOptions &options) {
  mvs_surface_file_options how = {};
  how.unit = unit_number(options.unit);
  how.frame = MVS_PATIENT_FRAME_LPS;
  try {
    return mvs::SurfaceFile(path, how);
  } catch (const mvs::Error &error) {
    if (error.part() != "options.unit") throw;
    how.unit = 0;
    return mvs::SurfaceFile(path, how);
  }
}

bool is_of_slicer(const std::string &path) {
  return path.ends_with(".json") || path.ends_with(".fcsv");
}

}  // namespace

void add_file_options(CLI::App &command, FileOptions &options) {
  command.add_option("--unit", options.unit, "lengths of files that state no unit: mm, cm or m")
      ->capture_default_str()
      ->check(one_of({"mm", "cm", "m"}));
  command
      .add_option(
          "--frame", options.frame,
          "frame of files that state none, LPS or RAS [that of the surface, else that of the "
          "landmarks]; the valve is in LPS")
      ->check(one_of({"LPS", "RAS"}));
}

PatientFiles::PatientFiles(const FileOptions &options, const std::string &surface)
    : options_(options), surface_(surface) {
  add_surface(surface);
}

void PatientFiles::add_surface(const std::string &path) {
  if (path.empty() || files_.contains(path)) return;
  mvs::SurfaceFile file = opened(path, options_);
  if (file.info().triangles.count == 0) {
    fail(MVS_E_FORMAT, path, path + ": has points and no triangles: a surface is needed here");
  }
  files_.emplace(path, std::move(file));
}

void PatientFiles::add_landmarks(const std::string &path) {
  if (path.empty()) return;
  if (!files_.contains(path)) files_.emplace(path, opened(path, options_));
  if (file(path).info().triangles.count > 0) {
    fail(MVS_E_FORMAT, path,
         path + ": is a surface of triangles: landmarks are needed here, as points or a curve");
  }
}

void PatientFiles::settle_frames() {
  unstated_ = frame_number(options_.frame);
  if (unstated_ != MVS_PATIENT_FRAME_UNKNOWN) return;
  for (const auto &[path, file] : files_) {
    if (file.info().file_frame != MVS_PATIENT_FRAME_UNKNOWN || !is_of_slicer(path)) continue;
    log_to_stderr(nullptr, MVS_LOG_WARNING,
                  (path + ": states no frame, as files of 3D Slicer do: it is taken to be in the "
                          "frame of the other files; if it is not, say so by --frame")
                      .c_str());
  }
  unstated_ = file(surface_).info().file_frame;
  if (unstated_ != MVS_PATIENT_FRAME_UNKNOWN) return;
  std::string first;
  for (const auto &[path, file] : files_) {
    const mvs_patient_frame stated = file.info().file_frame;
    if (stated == MVS_PATIENT_FRAME_UNKNOWN) continue;
    if (unstated_ != MVS_PATIENT_FRAME_UNKNOWN && stated != unstated_) {
      fail(
          MVS_E_ARGUMENT, path,
          text("%s is in the frame %s, %s in %s, and %s states none: give the frame of the surface "
               "by --frame",
               first.c_str(), frame_name(unstated_), path.c_str(), frame_name(stated),
               surface_.c_str()));
    }
    unstated_ = stated;
    if (first.empty()) first = path;
  }
  if (first.empty()) return;
  log_to_stderr(nullptr, MVS_LOG_WARNING,
                (first + ": is in the frame " + frame_name(unstated_) +
                 ", the surface states none: both are taken for the same frame; if the surface is "
                 "in the other one, say so by --frame")
                    .c_str());
}

std::vector<double> PatientFiles::points(const std::string &path) const {
  if (path.empty()) return {};
  const mvs_surface_file_info info = file(path).info();
  const mvs::View<double> view(info.points);
  std::vector<double> points(view.begin(), view.end());
  if (info.file_frame == MVS_PATIENT_FRAME_UNKNOWN && unstated_ == MVS_PATIENT_FRAME_RAS) {
    for (size_t k = 0; k < points.size(); ++k) {
      if (k % 3 != 2) points[k] = -points[k];
    }
  }
  return points;
}

mvs_patient_frame PatientFiles::frame() const {
  const bool known = file(surface_).info().file_frame != MVS_PATIENT_FRAME_UNKNOWN ||
                     unstated_ != MVS_PATIENT_FRAME_UNKNOWN;
  return known ? MVS_PATIENT_FRAME_LPS : MVS_PATIENT_FRAME_UNKNOWN;
}

double metres(mvs_length_unit unit) {
  return unit == MVS_LENGTH_UNIT_M ? 1 : (unit == MVS_LENGTH_UNIT_CM ? 1e-2 : 1e-3);
}

const char *frame_name(mvs_patient_frame frame) {
  if (frame == MVS_PATIENT_FRAME_LPS) return "LPS";
  return frame == MVS_PATIENT_FRAME_RAS ? "RAS" : "unknown";
}

}  // namespace cli
