// Readers of a patient's surface and of landmarks in the formats of other programs: STL, PLY, OBJ,
// OFF, VTK legacy and XML PolyData, 3D Slicer's markups (.mrk.json, .fcsv) and CSV tables.
//
// A reader checks every count against the bytes that are left before it allocates, every index and
// every coordinate, and throws MVS_E_FORMAT with the line, point or polygon that is wrong.
// FORMAT.md lists the variants of each format that are read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/types.h"

namespace mvs::core {

// The numbers of MVS_PATIENT_FRAME_* and MVS_LENGTH_UNIT_*.
enum class PatientFrame : uint32_t { unknown = 0, lps = 1, ras = 2 };
enum class LengthUnit : uint32_t { unknown = 0, m = 1, mm = 2, cm = 3 };

// An array of the file, as numbers: labels, radii, colours.
struct SurfaceArray {
  std::string name;
  bool on_points = true;  // else on triangles
  uint32_t components = 1;
  std::vector<double> values;
};

struct SurfaceFile {
  const char *format = "";  // "STL"
  PatientFrame file_frame = PatientFrame::unknown;
  PatientFrame frame = PatientFrame::unknown;  // of `points`
  LengthUnit unit = LengthUnit::unknown;       // of the file
  std::vector<Vec3> points;                    // m
  std::vector<Tri> triangles;                  // empty: landmarks or a curve
  std::vector<std::string> point_names;        // empty, or one each
  std::vector<SurfaceArray> arrays;            // as in the file: not scaled, not turned
};

struct SurfaceFileOptions {
  LengthUnit unit = LengthUnit::unknown;       // unknown: that which the file states
  PatientFrame frame = PatientFrame::unknown;  // unknown: that of the file
};

// Reads the bytes of a file; the ending of its name selects the format. MVS_E_ARGUMENT for an
// unknown ending, for a unit that neither file nor options state, and for one that contradicts the
// file.
SurfaceFile read_surface_file(std::string_view bytes, std::string_view name,
                              const SurfaceFileOptions &options);

}  // namespace mvs::core
