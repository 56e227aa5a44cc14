// Cells of a file as triangles and curves, with checks of every index.
#include "formats/surface/parts.h"

#include <cmath>

#include "base/error.h"

namespace mvs::core {
namespace {

uint32_t checked_corner(const SurfaceParts &parts, int64_t corner, const char *what, int32_t line) {
  if (corner >= 0 && static_cast<uint64_t>(corner) < parts.points.size()) {
    return static_cast<uint32_t>(corner);
  }
  throw Error(MVS_E_FORMAT, format("%s %u", what, parts.cells),
              format("%s %u has point %lld, but the points are 0 to %lld, counted from 0", what,
                     parts.cells, static_cast<long long>(corner),
                     static_cast<long long>(parts.points.size()) - 1),
              line);
}

void must_have_corners(const SurfaceParts &parts, size_t found, size_t needed, const char *what,
                       int32_t line) {
  if (found >= needed) return;
  throw Error(MVS_E_FORMAT, format("%s %u", what, parts.cells),
              format("%s %u has %zu points; it needs %zu", what, parts.cells, found, needed), line);
}

void end_cell(SurfaceParts &parts) {
  MVS_MUST(parts.cells < none - 1 && parts.triangles.size() < none, MVS_E_FORMAT, "",
           "the file has more than 2^32 cells");
  ++parts.cells;
}

void add_triangle(SurfaceParts &parts, const Tri &corners) {
  parts.triangles.push_back(corners);
  parts.cell_of_triangle.push_back(parts.cells);
}

}  // namespace

void add_polygon(SurfaceParts &parts, std::span<const int64_t> corners, int32_t line) {
  must_have_corners(parts, corners.size(), 3, "polygon", line);
  const uint32_t first = checked_corner(parts, corners[0], "polygon", line);
  uint32_t before = checked_corner(parts, corners[1], "polygon", line);
  for (size_t k = 2; k < corners.size(); ++k) {
    const uint32_t corner = checked_corner(parts, corners[k], "polygon", line);
    add_triangle(parts, {first, before, corner});
    before = corner;
  }
  end_cell(parts);
}

void add_strip(SurfaceParts &parts, std::span<const int64_t> corners, int32_t line) {
  must_have_corners(parts, corners.size(), 3, "strip", line);
  for (const int64_t corner : corners) checked_corner(parts, corner, "strip", line);
  for (size_t k = 2; k < corners.size(); ++k) {
    // every second triangle of a strip has the other orientation
    const size_t a = k % 2 == 0 ? k - 2 : k - 1, b = k % 2 == 0 ? k - 1 : k - 2;
    add_triangle(parts, {static_cast<uint32_t>(corners[a]), static_cast<uint32_t>(corners[b]),
                         static_cast<uint32_t>(corners[k])});
  }
  end_cell(parts);
}

void add_path(SurfaceParts &parts, std::span<const int64_t> corners, int32_t line) {
  must_have_corners(parts, corners.size(), 1, "line", line);
  parts.path_start.push_back(static_cast<uint32_t>(parts.path.size()));
  for (const int64_t corner : corners) {
    parts.path.push_back(checked_corner(parts, corner, "line", line));
  }
  end_cell(parts);
}

void add_unused_cells(SurfaceParts &parts, uint64_t count) {
  MVS_MUST(count < none - 1 - parts.cells, MVS_E_FORMAT, "", "the file has more than 2^32 cells");
  parts.cells += static_cast<uint32_t>(count);
}

void add_points(SurfaceParts &parts, std::span<const double> numbers) {
  for (size_t k = 0; k + 2 < numbers.size(); k += 3) {
    const size_t index = parts.points.size();
    for (size_t c = 0; c < 3; ++c) {
      MVS_MUST(std::isfinite(numbers[k + c]), MVS_E_FORMAT, format("point %zu", index),
               "point %zu (the first is 0) has a coordinate that is not a finite number", index);
    }
    MVS_MUST(index < none - 1, MVS_E_FORMAT, "", "the file has more than 2^32 points");
    parts.points.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
  }
}

void append_piece(SurfaceParts &to, SurfaceParts &&piece) {
  const size_t offset = to.points.size();
  MVS_MUST(offset + piece.points.size() < none && to.cells + uint64_t{piece.cells} < none,
           MVS_E_FORMAT, "", "the file has more than 2^32 points or cells");
  MVS_MUST(to.arrays.size() == piece.arrays.size() &&
               to.point_names.empty() == piece.point_names.empty(),
           MVS_E_FORMAT, "piece", "the pieces of the file have different arrays");
  for (size_t k = 0; k < piece.arrays.size(); ++k) {
    const SurfaceArray &more = piece.arrays[k];
    SurfaceArray &array = to.arrays[k];
    MVS_MUST(array.name == more.name && array.components == more.components &&
                 array.on_points == more.on_points,
             MVS_E_FORMAT, more.name, "the pieces of the file have different arrays: %s",
             more.name.c_str());
    array.values.insert(array.values.end(), more.values.begin(), more.values.end());
  }
  to.points.insert(to.points.end(), piece.points.begin(), piece.points.end());
  to.point_names.insert(to.point_names.end(), piece.point_names.begin(), piece.point_names.end());
  const auto shift = static_cast<uint32_t>(offset);
  for (const Tri &t : piece.triangles) {
    to.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  }
  for (const uint32_t cell : piece.cell_of_triangle) to.cell_of_triangle.push_back(cell + to.cells);
  const auto along = static_cast<uint32_t>(to.path.size());
  for (const uint32_t start : piece.path_start) to.path_start.push_back(start + along);
  for (const uint32_t point : piece.path) to.path.push_back(point + shift);
  to.cells += piece.cells;
}

}  // namespace mvs::core
