// Files of surfaces and landmarks: opens, describes and releases them.
#include <mvs/surface_file.h>

#include <memory>

#include "api/structs.h"
#include "formats/formats.h"
#include "formats/surface/surface_file.h"

struct mvs_surface_file {
  mvs::core::SurfaceFile content;
};

using namespace mvs::core;

namespace {

SurfaceFileOptions read_file_options(const mvs_surface_file_options *given) {
  const mvs_surface_file_options options = read_struct_or_default(given, "options");
  MVS_MUST(options.unit <= MVS_LENGTH_UNIT_CM, MVS_E_ARGUMENT, "options.unit",
           "options.unit is %u: it has to be one of MVS_LENGTH_UNIT_*", options.unit);
  MVS_MUST(options.frame <= MVS_PATIENT_FRAME_RAS, MVS_E_ARGUMENT, "options.frame",
           "options.frame is %u: it has to be one of MVS_PATIENT_FRAME_*", options.frame);
  must_be_zero(options.reserved, "options.reserved");
  return {static_cast<LengthUnit>(options.unit), static_cast<PatientFrame>(options.frame)};
}

mvs_view rows_of(const void *data, uint64_t count, uint32_t components, mvs_type type,
                 size_t bytes_each) {
  return {count > 0 ? data : nullptr, count, components, type, components * bytes_each};
}

}  // namespace

extern "C" {

mvs_result mvs_surface_file_open(const char *path, const mvs_surface_file_options *options,
                                 mvs_surface_file **file) {
  return file_at_boundary(path ? path : "", [&] {
    must_point(path, "path");
    must_point(file, "file");
    const SurfaceFileOptions how = read_file_options(options);
    auto made = std::make_unique<mvs_surface_file>();
    made->content = read_surface_file(read_whole_file(path), path, how);
    *file = made.release();
  });
}

void mvs_surface_file_release(mvs_surface_file *file) {
  delete file;
}

mvs_result mvs_surface_file_get_info(const mvs_surface_file *file, mvs_surface_file_info *info) {
  return at_boundary([&] {
    must_point(file, "file");
    const SurfaceFile &content = file->content;
    mvs_surface_file_info found = {};
    found.frame = static_cast<mvs_patient_frame>(content.frame);
    found.file_frame = static_cast<mvs_patient_frame>(content.file_frame);
    found.unit = static_cast<mvs_length_unit>(content.unit);
    found.format = content.format;
    found.points =
        rows_of(content.points.data(), content.points.size(), 3, MVS_TYPE_F64, sizeof(double));
    found.triangles = rows_of(content.triangles.data(), content.triangles.size(), 3, MVS_TYPE_U32,
                              sizeof(uint32_t));
    write_struct(info, found, "info");
  });
}

mvs_result mvs_surface_file_get_array_count(const mvs_surface_file *file, uint32_t *count) {
  return at_boundary([&] {
    must_point(file, "file");
    must_point(count, "count");
    *count = static_cast<uint32_t>(file->content.arrays.size());
  });
}

mvs_result mvs_surface_file_get_array(const mvs_surface_file *file, uint32_t index,
                                      mvs_surface_array *array) {
  return at_boundary([&] {
    must_point(file, "file");
    must_be_index(index, file->content.arrays.size(), "file", "arrays");
    const SurfaceArray &values = file->content.arrays[index];
    mvs_surface_array found = {};
    found.place = values.on_points ? MVS_SURFACE_PLACE_POINT : MVS_SURFACE_PLACE_TRIANGLE;
    found.name = values.name.c_str();
    found.values = rows_of(values.values.data(), values.values.size() / values.components,
                           values.components, MVS_TYPE_F64, sizeof(double));
    write_struct(array, found, "array");
  });
}

mvs_result mvs_surface_file_get_name_count(const mvs_surface_file *file, uint32_t *count) {
  return at_boundary([&] {
    must_point(file, "file");
    must_point(count, "count");
    *count = static_cast<uint32_t>(file->content.point_names.size());
  });
}

mvs_result mvs_surface_file_get_name(const mvs_surface_file *file, uint32_t index,
                                     const char **name) {
  return at_boundary([&] {
    must_point(file, "file");
    must_point(name, "name");
    must_be_index(index, file->content.point_names.size(), "file", "names of points");
    *name = file->content.point_names[index].c_str();
  });
}

}  // extern "C"
