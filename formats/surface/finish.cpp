// From the content of a file to points in metres: arrays by triangle, curves in their order, unit
// and frame.
#include <algorithm>

#include "base/error.h"
#include "formats/surface/parts.h"

namespace mvs::core {
namespace {

double units_per_metre(LengthUnit unit) {
  return unit == LengthUnit::mm ? 1000 : unit == LengthUnit::cm ? 100 : 1;
}

LengthUnit chosen_unit(LengthUnit stated, LengthUnit given) {
  MVS_MUST(stated != LengthUnit::unknown || given != LengthUnit::unknown, MVS_E_ARGUMENT,
           "options.unit",
           "the file does not state its unit of length: give it, as m, mm or cm (medical images "
           "and 3D Slicer have mm)");
  MVS_MUST(stated == given || stated == LengthUnit::unknown || given == LengthUnit::unknown,
           MVS_E_ARGUMENT, "options.unit",
           "the file states that its lengths are in %s, but the unit given is %s: give that of the "
           "file, or none",
           unit_word(stated), unit_word(given));
  return stated != LengthUnit::unknown ? stated : given;
}

void must_have_rows(const SurfaceArray &array, const SurfaceParts &parts) {
  const size_t rows = array.on_points ? parts.points.size() : parts.cells;
  MVS_MUST(array.values.size() == rows * array.components, MVS_E_FORMAT, array.name,
           "the array %s has %zu values, but the file has %zu %s", array.name.c_str(),
           array.values.size(), rows, array.on_points ? "points" : "cells");
}

// Fails if rows by triangle would take far more memory than the file: a polygon of many corners has
// as many triangles, each with the row of the polygon.
void must_fit(const SurfaceParts &parts) {
  constexpr uint64_t most = uint64_t{1} << 28;
  uint64_t values = 0;
  for (const SurfaceArray &array : parts.arrays) {
    if (!array.on_points) values += uint64_t{array.components} * parts.triangles.size();
  }
  MVS_MUST(
      values <= most, MVS_E_MEMORY, "",
      "the arrays of polygons have %llu values as arrays of triangles, the limit is %llu: save "
      "the surface without them",
      static_cast<unsigned long long>(values), static_cast<unsigned long long>(most));
}

// Replaces the row of each cell by a row for each triangle of it.
void spread_over_triangles(SurfaceArray &array, const SurfaceParts &parts) {
  std::vector<double> rows;
  rows.reserve(parts.triangles.size() * array.components);
  for (const uint32_t cell : parts.cell_of_triangle) {
    const auto row = array.values.begin() + static_cast<ptrdiff_t>(cell) * array.components;
    rows.insert(rows.end(), row, row + array.components);
  }
  array.values = std::move(rows);
}

template <typename Row>
void reorder_rows(std::vector<Row> &rows, size_t components, const std::vector<uint32_t> &order) {
  if (rows.empty()) return;
  std::vector<Row> moved;
  moved.reserve(rows.size());
  for (const uint32_t row : order) {
    for (size_t c = 0; c < components; ++c) moved.push_back(rows[row * components + c]);
  }
  rows = std::move(moved);
}

void sort_along_path(SurfaceParts &parts) {
  const std::vector<uint32_t> order = order_along_curves(parts);
  reorder_rows(parts.points, 1, order);
  reorder_rows(parts.point_names, 1, order);
  for (SurfaceArray &array : parts.arrays) {
    if (array.on_points) reorder_rows(array.values, array.components, order);
  }
}

}  // namespace

SurfaceFile finished_surface(SurfaceParts &&parts, const SurfaceFileOptions &options) {
  MVS_MUST(!parts.points.empty(), MVS_E_FORMAT, "", "the file has no points");
  MVS_MUST(parts.point_names.empty() || parts.point_names.size() == parts.points.size(),
           MVS_E_FORMAT, "names", "the file has %zu names, but %zu points",
           parts.point_names.size(), parts.points.size());
  SurfaceFile file;
  file.format = parts.format;
  file.unit = chosen_unit(parts.unit, options.unit);
  file.file_frame = file.frame = parts.frame;
  must_fit(parts);
  for (SurfaceArray &array : parts.arrays) {
    must_have_rows(array, parts);
    if (!array.on_points) spread_over_triangles(array, parts);
  }
  if (parts.triangles.empty() && !parts.path.empty()) sort_along_path(parts);
  const bool turns = options.frame != PatientFrame::unknown &&
                     parts.frame != PatientFrame::unknown && options.frame != parts.frame;
  if (turns) file.frame = options.frame;
  // 0 - x, not -x, which makes a negative zero
  const double units = units_per_metre(file.unit);
  for (Vec3 &point : parts.points) {
    if (turns) point = {0 - point[0], 0 - point[1], point[2]};
    point /= units;
  }
  file.points = std::move(parts.points);
  file.triangles = std::move(parts.triangles);
  file.point_names = std::move(parts.point_names);
  file.arrays = std::move(parts.arrays);
  // arrays of cells that are no triangles have no rows
  std::erase_if(file.arrays, [&](const SurfaceArray &array) {
    return !array.on_points && file.triangles.empty();
  });
  return file;
}

}  // namespace mvs::core
