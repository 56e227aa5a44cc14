// The content of a file while it is read: in its unit and frame, with polygons of any size cut into
// triangles, and arrays with a row for each of its cells.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/types.h"
#include "formats/surface/surface_file.h"

namespace mvs::core {

struct SurfaceParts {
  const char *format = "";
  PatientFrame frame = PatientFrame::unknown;
  LengthUnit unit = LengthUnit::unknown;
  std::vector<Vec3> points;
  std::vector<std::string> point_names;
  std::vector<Tri> triangles;
  std::vector<uint32_t> cell_of_triangle;
  std::vector<uint32_t> path;        // points along curves, one curve after another
  std::vector<uint32_t> path_start;  // of each curve in `path`
  uint32_t cells = 0;                // points, curves, polygons and strips of the file
  std::vector<SurfaceArray> arrays;  // those not on points have a row for each cell
};

// Adds a cell: a polygon of at least three corners as a fan of triangles, a strip of triangles, a
// curve, or a cell that is not used. `line` is for the sentence, 0: binary. Corners are checked
// against the points that exist.
void add_polygon(SurfaceParts &parts, std::span<const int64_t> corners, int32_t line);
void add_strip(SurfaceParts &parts, std::span<const int64_t> corners, int32_t line);
void add_path(SurfaceParts &parts, std::span<const int64_t> corners, int32_t line);
void add_unused_cells(SurfaceParts &parts, uint64_t count);

// Adds points of x, y, z in turn; throws for a coordinate that is not finite.
void add_points(SurfaceParts &parts, std::span<const double> numbers);

// Adds the parts of a further piece of the same file.
void append_piece(SurfaceParts &to, SurfaceParts &&piece);

// The order of the points along the curves of a file, each point once; points of no curve follow.
std::vector<uint32_t> order_along_curves(const SurfaceParts &parts);

// Returns the content in metres and in the wanted frame, with arrays by triangle and the points of
// a curve in its order.
SurfaceFile finished_surface(SurfaceParts &&parts, const SurfaceFileOptions &options);

// The frame and unit that a comment states: "SPACE=LPS", "coordinate system: RAS", "units=mm";
// unknown if it states none. Two different frames in one text: unknown.
PatientFrame stated_frame(std::string_view comment);
LengthUnit stated_unit(std::string_view comment);
// Stores the frame and the unit of a comment, unless an earlier comment has stated them.
void note_comment(SurfaceParts &parts, std::string_view comment);
// The same for a field of VTK files: SPACE, UNITS.
void note_field(SurfaceParts &parts, std::string_view name, std::string_view text);

// The words of files: "LPS", "ras", "left-posterior-superior"; "mm". Unknown for another word.
PatientFrame frame_of_word(std::string_view word);
LengthUnit unit_of_word(std::string_view word);
const char *frame_word(PatientFrame frame);
const char *unit_word(LengthUnit unit);

// The readers, one a format.
SurfaceParts read_stl(std::string_view bytes);
SurfaceParts read_ply(std::string_view bytes);
SurfaceParts read_plain_obj(std::string_view bytes);
SurfaceParts read_off(std::string_view bytes);
SurfaceParts read_vtk_legacy(std::string_view bytes);
SurfaceParts read_vtp(std::string_view bytes);
SurfaceParts read_mrk_json(std::string_view bytes);
SurfaceParts read_fcsv(std::string_view bytes);
SurfaceParts read_point_table(std::string_view bytes);

}  // namespace mvs::core
