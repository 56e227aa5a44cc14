/* Reads a patient's surface, or landmarks, from a file of another program: points, triangles, named
 * arrays and names of points, in m and in a known frame. Experimental (experimental.h).
 *
 * Surfaces: STL, PLY, OBJ, OFF, VTK legacy PolyData (.vtk) and VTK XML PolyData (.vtp, uncompressed
 * or by zlib). Polygons of more than three corners are cut into fans of triangles. Landmarks and
 * curves: 3D Slicer's .mrk.json and .fcsv, .csv tables, and .vtk, .vtp, .ply, .obj without
 * triangles; points of curves are in their order. formats/FORMAT.md has the details. */
#ifndef MVS_SURFACE_FILE_H
#define MVS_SURFACE_FILE_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Frames of patients in medical images. They differ in the signs of x and y. */
enum mvs_patient_frame_e {
  MVS_PATIENT_FRAME_UNKNOWN = 0, /* the file does not state it */
  MVS_PATIENT_FRAME_LPS = 1,     /* x to the left, y to the back, z to the head: DICOM */
  MVS_PATIENT_FRAME_RAS = 2      /* x to the right, y to the front, z to the head */
};
typedef uint32_t mvs_patient_frame;

/* Units of length in files. */
enum mvs_length_unit_e { MVS_LENGTH_UNIT_M = 1, MVS_LENGTH_UNIT_MM = 2, MVS_LENGTH_UNIT_CM = 3 };
typedef uint32_t mvs_length_unit;

/* How to read a file. */
typedef struct mvs_surface_file_options {
  uint32_t struct_size;
  mvs_length_unit unit;    /* MVS_LENGTH_UNIT_* of the file [that which the file states: required
                              unless it does, and if both are there they have to be equal] */
  mvs_patient_frame frame; /* MVS_PATIENT_FRAME_* wanted [that of the file]. Points of a file
                              without a stated frame are never turned */
  uint32_t reserved;
} mvs_surface_file_options;

typedef struct mvs_surface_file mvs_surface_file;

/* The content of a file. Texts and views are valid until the file is released. */
typedef struct mvs_surface_file_info {
  uint32_t struct_size;
  mvs_patient_frame frame;      /* MVS_PATIENT_FRAME_* of `points` */
  mvs_patient_frame file_frame; /* MVS_PATIENT_FRAME_* that the file states */
  mvs_length_unit unit;         /* MVS_LENGTH_UNIT_* of the file */
  const char *format;           /* "STL", "PLY", "OBJ", "OFF", "VTK", "VTP", "markups", "FCSV",
                                   "CSV" */
  mvs_view points;              /* F64, n x 3, m */
  mvs_view triangles;           /* U32, m x 3; of landmarks or a curve empty */
} mvs_surface_file_info;

/* Reads a file; release it with mvs_surface_file_release. The ending of the path selects the
 * format. MVS_E_FORMAT with the line, the point or the polygon that is wrong; MVS_E_UNSUPPORTED,
 * with the remedy, for a variant that is not read. `options` is nullable. */
MVS_API mvs_result mvs_surface_file_open(const char *path, const mvs_surface_file_options *options,
                                         mvs_surface_file **file);

/* Releases a file. `file` is nullable. */
MVS_API void mvs_surface_file_release(mvs_surface_file *file);

/* Returns the points and triangles of a file. */
MVS_API mvs_result mvs_surface_file_get_info(const mvs_surface_file *file,
                                             mvs_surface_file_info *info);

/* Places of arrays. */
enum mvs_surface_place_e {
  MVS_SURFACE_PLACE_POINT = 1,   /* a row for each point */
  MVS_SURFACE_PLACE_TRIANGLE = 2 /* a row for each triangle */
};
typedef uint32_t mvs_surface_place;

/* A named array of a file: labels, radii, colours, normals. Its values are those of the file, of
 * any type there, neither scaled nor turned. */
typedef struct mvs_surface_array {
  uint32_t struct_size;
  mvs_surface_place place; /* MVS_SURFACE_PLACE_* */
  const char *name;
  mvs_view values; /* F64, NaN where the file has no number */
} mvs_surface_array;

/* The arrays of a file, in its order. */
MVS_API mvs_result mvs_surface_file_get_array_count(const mvs_surface_file *file, uint32_t *count);
MVS_API mvs_result mvs_surface_file_get_array(const mvs_surface_file *file, uint32_t index,
                                              mvs_surface_array *array);

/* The names of points ("AL", "PM"): none, or one for each point. */
MVS_API mvs_result mvs_surface_file_get_name_count(const mvs_surface_file *file, uint32_t *count);
MVS_API mvs_result mvs_surface_file_get_name(const mvs_surface_file *file, uint32_t index,
                                             const char **name);

#ifdef __cplusplus
}
#endif
#endif
