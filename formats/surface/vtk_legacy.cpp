// VTK legacy PolyData, ASCII and binary (big-endian): file versions up to 4.2, which list cells as
// "count index index ...", and 5.x, which have offsets and connectivity.
#include <algorithm>

#include "base/error.h"
#include "formats/surface/cursor.h"
#include "formats/surface/parts.h"
#include "formats/surface/vtk_data.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

// The cells of one section, as points of all cells and the end of each.
struct VtkCellList {
  std::vector<double> nodes;
  std::vector<uint64_t> ends;
};

// "count index index ..." for each cell.
VtkCellList split_counted_cells(std::vector<double> numbers, uint64_t cells, const Cursor &cursor) {
  VtkCellList list;
  size_t at = 0;
  for (uint64_t k = 0; k < cells; ++k) {
    const int64_t count = at < numbers.size() ? index_of_number(numbers[at]) : -1;
    if (count < 0 || static_cast<uint64_t>(count) > numbers.size() - at - 1) {
      cursor.fail("cell %llu of the section has no valid number of points",
                  static_cast<unsigned long long>(k));
    }
    for (int64_t c = 1; c <= count; ++c) list.nodes.push_back(numbers[at + c]);
    at += static_cast<size_t>(count) + 1;
    list.ends.push_back(list.nodes.size());
  }
  return list;
}

// The section of a 5.x file: one offset more than cells, beginning with 0, then the points.
VtkCellList read_offset_cells(VtkDataReader &reader, uint64_t offsets, uint64_t nodes) {
  Cursor &cursor = reader.cursor();
  VtkCellList list;
  const auto block = [&](const char *keyword, uint64_t count) {
    cursor.expect(keyword);
    const NumberType type = reader.type();
    cursor.line();
    return reader.numbers(count, type, keyword);
  };
  const std::vector<double> ends = block("offsets", offsets);
  list.nodes = block("connectivity", nodes);
  for (size_t k = 0; k < ends.size(); ++k) {
    const int64_t end = index_of_number(ends[k]);
    const uint64_t least = list.ends.empty() ? 0 : list.ends.back();
    const bool is_valid = end >= 0 && static_cast<uint64_t>(end) <= list.nodes.size() &&
                          static_cast<uint64_t>(end) >= least && (k > 0 || end == 0);
    if (!is_valid) cursor.fail("offset %zu of the cells is not valid", k);
    if (k > 0) list.ends.push_back(static_cast<uint64_t>(end));
  }
  return list;
}

VtkCellList read_cells(VtkDataReader &reader) {
  Cursor &cursor = reader.cursor();
  const uint64_t first = cursor.whole("the number of cells");
  const uint64_t second = cursor.whole("the size of the cells");
  cursor.line();
  if (reader.is_version_5()) return read_offset_cells(reader, first, second);
  constexpr NumberType integer = {NumberType::Kind::whole_signed, 4};
  return split_counted_cells(reader.numbers(second, integer, "the cells"), first, cursor);
}

// PolyData orders its cells: points, lines, polygons, strips, whatever the order of the sections.
struct VtkSections {
  VtkCellList points, lines, polygons, strips;
};

void add_vtk_cells(const VtkSections &sections, SurfaceParts &parts) {
  std::vector<int64_t> corners;
  const auto each = [&](const VtkCellList &list, auto add) {
    uint64_t at = 0;
    for (const uint64_t end : list.ends) {
      corners.clear();
      for (; at < end; ++at) corners.push_back(index_of_number(list.nodes[at]));
      add(parts, corners, 0);
    }
  };
  add_unused_cells(parts, sections.points.ends.size());
  each(sections.lines, add_path);
  each(sections.polygons, add_polygon);
  each(sections.strips, add_strip);
}

// Reads the head of the file; returns whether the rest is binary.
VtkDataReader read_vtk_head(Cursor &cursor, SurfaceParts &parts) {
  constexpr std::string_view start = "# vtk datafile version ";
  const std::string version = in_small_letters(cursor.line());
  if (!version.starts_with(start)) {
    cursor.fail("the file does not begin with `# vtk DataFile Version`");
  }
  const bool is_version_5 = version.size() > start.size() && version[start.size()] >= '5';
  note_comment(parts, cursor.line());
  const std::string coding = in_small_letters(cursor.word());
  if (coding != "ascii" && coding != "binary") {
    cursor.fail("%s stands where `ASCII` or `BINARY` is needed", quoted(coding).c_str());
  }
  cursor.expect("dataset");
  const std::string kind = in_small_letters(cursor.word());
  if (kind != "polydata") {
    cursor.fail("the file holds %s: save the surface as PolyData (in ParaView: Extract Surface)",
                quoted(kind).c_str());
  }
  cursor.line();
  return {cursor, coding == "binary", is_version_5};
}

}  // namespace

SurfaceParts read_vtk_legacy(std::string_view bytes) {
  SurfaceParts parts;
  parts.format = "VTK";
  Cursor cursor(bytes);
  VtkDataReader reader = read_vtk_head(cursor, parts);
  VtkSections sections;
  bool has_points = false;
  while (!cursor.at_end()) {
    const std::string keyword = in_small_letters(cursor.word());
    if (keyword == "points") {
      if (has_points) cursor.fail("the section POINTS is given twice");
      has_points = true;
      const uint64_t count = cursor.whole("the number of points");
      const NumberType type = reader.type();
      cursor.line();
      cursor.must_hold(count, 3, "the number of points");
      add_points(parts, reader.numbers(3 * count, type, "the points"));
    } else if (keyword == "vertices") {
      sections.points = read_cells(reader);
    } else if (keyword == "lines") {
      sections.lines = read_cells(reader);
    } else if (keyword == "polygons") {
      sections.polygons = read_cells(reader);
    } else if (keyword == "triangle_strips") {
      sections.strips = read_cells(reader);
    } else {
      reader.read_attribute(keyword, parts);
    }
  }
  add_vtk_cells(sections, parts);
  return parts;
}

}  // namespace mvs::core
