/* Files of surfaces and landmarks through the C interface. */
#include <mvs/mvs.h>
#include <stdio.h>

#include "tests/api/check.h"

static const char *const obj_path = "surface_test.obj", *const points_path =
                                                            "surface_test.mrk.json";

static void write_text(const char *path, const char *text) {
  FILE *file = fopen(path, "wb");
  CHECK(file != NULL);
  if (!file) return;
  CHECK(fputs(text, file) >= 0);
  CHECK(fclose(file) == 0);
}

static mvs_surface_file_info info_of(const mvs_surface_file *file) {
  mvs_surface_file_info info = {.struct_size = sizeof info};
  MUST(mvs_surface_file_get_info(file, &info));
  return info;
}

static void a_surface_is_read_in_metres_and_in_the_frame_that_is_wanted(void) {
  mvs_surface_file *file = NULL;
  mvs_surface_file_options options = {
      .struct_size = sizeof options, .unit = MVS_LENGTH_UNIT_CM, .frame = MVS_PATIENT_FRAME_LPS};
  write_text(obj_path, "# SPACE=RAS\nv 1 2 3\nv 4 0 0\nv 0 5 0\nv 1 1 1\nf 1 2 3 4\n");
  MUST(mvs_surface_file_open(obj_path, &options, &file));
  const mvs_surface_file_info info = info_of(file);
  const double *points = info.points.data;
  const uint32_t *triangles = info.triangles.data;
  uint32_t count = 7;
  CHECK(strcmp(info.format, "OBJ") == 0 && info.unit == MVS_LENGTH_UNIT_CM);
  CHECK(info.frame == MVS_PATIENT_FRAME_LPS && info.file_frame == MVS_PATIENT_FRAME_RAS);
  CHECK(info.points.count == 4 && info.points.components == 3 && info.points.stride == 24);
  CHECK(info.points.type == MVS_TYPE_F64 && info.triangles.type == MVS_TYPE_U32);
  CHECK(points[0] == -0.01 && points[1] == -0.02 && points[2] == 0.03);
  CHECK(info.triangles.count == 2 && info.triangles.stride == 12);
  CHECK(triangles[0] == 0 && triangles[1] == 1 && triangles[2] == 2 && triangles[5] == 3);
  MUST(mvs_surface_file_get_array_count(file, &count));
  CHECK(count == 0);
  MUST(mvs_surface_file_get_name_count(file, &count));
  CHECK(count == 0);
  mvs_surface_file_release(file);
  remove(obj_path);
}

static void landmarks_have_names_and_arrays_have_places(void) {
  mvs_surface_file *file = NULL;
  const char *name = NULL;
  mvs_surface_array array = {.struct_size = sizeof array};
  const char *const ply_path = "surface_test.ply";
  uint32_t count = 0;
  write_text(points_path,
             "{\"markups\": [{\"coordinateSystem\": \"LPS\", \"coordinateUnits\": \"mm\", "
             "\"controlPoints\": [{\"label\": \"AL\", \"position\": [1, 2, 3]}]}]}");
  MUST(mvs_surface_file_open(points_path, NULL, &file));
  CHECK(info_of(file).unit == MVS_LENGTH_UNIT_MM && info_of(file).triangles.count == 0);
  MUST(mvs_surface_file_get_name_count(file, &count));
  CHECK(count == 1);
  MUST(mvs_surface_file_get_name(file, 0, &name));
  CHECK(strcmp(name, "AL") == 0);
  MUST_FAIL(mvs_surface_file_get_name(file, 1, &name), MVS_E_ARGUMENT, "index");
  mvs_surface_file_release(file);
  remove(points_path);

  const mvs_surface_file_options options = {.struct_size = sizeof options,
                                            .unit = MVS_LENGTH_UNIT_M};
  write_text(ply_path,
             "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
             "property float z\nproperty float radius\nend_header\n1 2 3 0.5\n");
  MUST(mvs_surface_file_open(ply_path, &options, &file));
  MUST(mvs_surface_file_get_array_count(file, &count));
  CHECK(count == 1);
  MUST(mvs_surface_file_get_array(file, 0, &array));
  CHECK(strcmp(array.name, "radius") == 0 && array.place == MVS_SURFACE_PLACE_POINT);
  CHECK(array.values.count == 1 && *(const double *)array.values.data == 0.5);
  MUST_FAIL(mvs_surface_file_get_array(file, 1, &array), MVS_E_ARGUMENT, "index");
  mvs_surface_file_release(file);
  remove(ply_path);
}

static void wrong_files_and_options_are_refused_with_path_and_line(void) {
  mvs_surface_file *file = NULL;
  mvs_surface_file_options options = {.struct_size = sizeof options};
  uint32_t count = 7;
  write_text(obj_path, "v 0 0 0\nv 1 0 0\nv 0 nan 0\n");
  MUST_FAIL(mvs_surface_file_open(obj_path, NULL, &file), MVS_E_FORMAT, "surface_test.obj:3: ");
  write_text(obj_path, "v 0 0 0\n");
  MUST_FAIL(mvs_surface_file_open(obj_path, NULL, &file), MVS_E_ARGUMENT, "state its unit");
  options.unit = 4;
  MUST_FAIL(mvs_surface_file_open(obj_path, &options, &file), MVS_E_ARGUMENT, "options.unit");
  options.unit = MVS_LENGTH_UNIT_MM;
  options.frame = 3;
  MUST_FAIL(mvs_surface_file_open(obj_path, &options, &file), MVS_E_ARGUMENT, "options.frame");
  options.frame = 0;
  options.reserved = 1;
  MUST_FAIL(mvs_surface_file_open(obj_path, &options, &file), MVS_E_ARGUMENT, "reserved");
  MUST_FAIL(mvs_surface_file_open("surface_test.step", NULL, &file), MVS_E_IO, "surface_test.step");
  MUST_FAIL(mvs_surface_file_open(NULL, NULL, &file), MVS_E_ARGUMENT, "path");
  MUST_FAIL(mvs_surface_file_open(obj_path, NULL, NULL), MVS_E_ARGUMENT, "file");
  MUST_FAIL(mvs_surface_file_get_info(NULL, NULL), MVS_E_ARGUMENT, "file");
  MUST_FAIL(mvs_surface_file_get_array_count(NULL, &count), MVS_E_ARGUMENT, "file");
  MUST_FAIL(mvs_surface_file_get_name_count(NULL, &count), MVS_E_ARGUMENT, "file");
  mvs_surface_file_release(NULL);
  CHECK(file == NULL && count == 7);
  remove(obj_path);
}

int main(void) {
  a_surface_is_read_in_metres_and_in_the_frame_that_is_wanted();
  landmarks_have_names_and_arrays_have_places();
  wrong_files_and_options_are_refused_with_path_and_line();
  return finish("surface");
}
