#include "module_parts.h"

#include <mvs/surface_file.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <optional>

#include "arrays.h"

namespace mvs_python {
namespace {

using namespace py::literals;

using Text = std::optional<std::string>;

// Owns a file of the C library, which is immutable.
class SurfaceFile {
 public:
  explicit SurfaceFile(mvs_surface_file *made) : handle_(made, &mvs_surface_file_release) {}
  const mvs_surface_file *get() const { return handle_.get(); }

 private:
  std::unique_ptr<mvs_surface_file, void (*)(mvs_surface_file *)> handle_;
};

mvs_length_unit unit_of(const Text &unit) {
  if (!unit) return 0;
  if (*unit == "m") return MVS_LENGTH_UNIT_M;
  if (*unit == "mm") return MVS_LENGTH_UNIT_MM;
  if (*unit == "cm") return MVS_LENGTH_UNIT_CM;
  refuse(
      MVS_E_ARGUMENT, "unit",
      "unit: \"m\", \"mm\", \"cm\" or None (as the file states) is needed, not \"" + *unit + "\"");
}

mvs_patient_frame frame_of(const Text &frame) {
  if (!frame) return MVS_PATIENT_FRAME_UNKNOWN;
  if (*frame == "LPS") return MVS_PATIENT_FRAME_LPS;
  if (*frame == "RAS") return MVS_PATIENT_FRAME_RAS;
  refuse(MVS_E_ARGUMENT, "frame",
         "frame: \"LPS\", \"RAS\" or None (as the file has it) is needed, not \"" + *frame + "\"");
}

Text frame_text(mvs_patient_frame frame) {
  if (frame == MVS_PATIENT_FRAME_LPS) return "LPS";
  if (frame == MVS_PATIENT_FRAME_RAS) return "RAS";
  return {};
}

const char *unit_text(mvs_length_unit unit) {
  return unit == MVS_LENGTH_UNIT_M ? "m" : unit == MVS_LENGTH_UNIT_MM ? "mm" : "cm";
}

std::unique_ptr<SurfaceFile> open_file(const std::filesystem::path &path, const Text &unit,
                                       const Text &frame) {
  auto options = sized<mvs_surface_file_options>();
  options.unit = unit_of(unit);
  options.frame = frame_of(frame);
  const std::string name = path.string();
  mvs_surface_file *made = nullptr;
  release_and([&] { return mvs_surface_file_open(name.c_str(), &options, &made); });
  return std::make_unique<SurfaceFile>(made);
}

mvs_surface_file_info info_of(const SurfaceFile &self) {
  auto info = sized<mvs_surface_file_info>();
  must(mvs_surface_file_get_info(self.get(), &info));
  return info;
}

// Arrays of points or of triangles by name.
py::dict arrays_of(const py::object &self, mvs_surface_place place) {
  const SurfaceFile &file = self.cast<const SurfaceFile &>();
  uint32_t count = 0;
  must(mvs_surface_file_get_array_count(file.get(), &count));
  py::dict found;
  for (uint32_t k = 0; k < count; ++k) {
    auto array = sized<mvs_surface_array>();
    must(mvs_surface_file_get_array(file.get(), k, &array));
    if (array.place == place) found[array.name] = array_of(array.values, self);
  }
  return found;
}

py::tuple names_of(const SurfaceFile &self) {
  uint32_t count = 0;
  must(mvs_surface_file_get_name_count(self.get(), &count));
  py::tuple found(count);
  for (uint32_t k = 0; k < count; ++k) {
    const char *name = nullptr;
    must(mvs_surface_file_get_name(self.get(), k, &name));
    found[k] = name;
  }
  return found;
}

}  // namespace

void bind_surface_file(py::module_ &module) {
  py::class_<SurfaceFile> type(
      module, "SurfaceFile",
      "A file of a surface or of landmarks, for mvs.read_surface and mvs.read_landmarks.");
  type.def(py::init(&open_file), "path"_a, "unit"_a = py::none(), "frame"_a = py::none());
  type.def_property_readonly(
      "points",
      [](const py::object &self) {
        return array_of(info_of(self.cast<const SurfaceFile &>()).points, self);
      },
      "(n, 3) float64, m: the points.");
  type.def_property_readonly(
      "triangles",
      [](const py::object &self) {
        return array_of(info_of(self.cast<const SurfaceFile &>()).triangles, self);
      },
      "(m, 3) uint32: points of each triangle.");
  type.def_property_readonly(
      "point_arrays",
      [](const py::object &self) { return arrays_of(self, MVS_SURFACE_PLACE_POINT); },
      "Arrays of points by name.");
  type.def_property_readonly(
      "triangle_arrays",
      [](const py::object &self) { return arrays_of(self, MVS_SURFACE_PLACE_TRIANGLE); },
      "Arrays of triangles by name.");
  type.def_property_readonly("names", &names_of, "The names of the points.");
  type.def_property_readonly(
      "frame", [](const SurfaceFile &self) { return frame_text(info_of(self).frame); },
      "\"LPS\", \"RAS\" or None.");
  type.def_property_readonly(
      "file_frame", [](const SurfaceFile &self) { return frame_text(info_of(self).file_frame); },
      "The frame that the file states: \"LPS\", \"RAS\" or None.");
  type.def_property_readonly(
      "unit", [](const SurfaceFile &self) { return unit_text(info_of(self).unit); },
      "The unit of the file: \"m\", \"mm\" or \"cm\".");
  type.def_property_readonly(
      "format", [](const SurfaceFile &self) { return info_of(self).format; },
      "The format of the file: \"STL\".");
}

}  // namespace mvs_python
