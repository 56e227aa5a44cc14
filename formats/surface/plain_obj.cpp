// OBJ as a plain surface: v, f, l; all other statements, and the #mvs lines of an extended OBJ, are
// skipped. References are v, v/vt, v//vn or v/vt/vn, counted from 1, or from the end with -1.
#include <charconv>
#include <span>

#include "base/utf8.h"
#include "formats/surface/cursor.h"
#include "formats/surface/parts.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

// The cells are added when all points are known: a reference may name a later point.
struct ObjCell {
  bool is_face = true;
  int32_t line = 0;
  size_t end = 0;  // of its corners in a list of all
};

int64_t obj_corner(std::string_view word, size_t points, const Line &line) {
  int64_t index = 0;
  const std::string_view number = word.substr(0, word.find('/'));
  const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), index);
  if (error != std::errc() || stop != number.data() + number.size() || index == 0) {
    line.fail("%s is not a vertex: write its number, 1 for the first, -1 for the last",
              quoted(word).c_str());
  }
  const auto count = static_cast<int64_t>(points);
  if (index < -count)
    line.fail("vertex %s is not one of the %zu above", quoted(word).c_str(), points);
  return index > 0 ? index - 1 : count + index;
}

// The next line, with those that a backslash at its end continues.
std::string obj_statement(Cursor &cursor) {
  std::string statement(cursor.line());
  while (statement.ends_with('\\') && cursor.left() > 0) {
    statement.back() = ' ';
    statement += cursor.line();
  }
  return statement;
}

}  // namespace

SurfaceParts read_plain_obj(std::string_view bytes) {
  SurfaceParts parts;
  parts.format = "OBJ";
  std::vector<ObjCell> cells;
  std::vector<int64_t> corners;  // of all cells, from 0
  Cursor cursor(without_byte_order_mark(bytes));
  while (cursor.left() > 0) {
    const int32_t number = cursor.line_number();
    const std::string statement = obj_statement(cursor);
    Line line(statement, number);
    const std::string_view keyword = line.word();
    if (keyword.starts_with('#')) {
      note_comment(parts, statement);
    } else if (keyword == "v") {
      const double x = line.number(), y = line.number(), z = line.number();
      add_points(parts, std::vector<double>{x, y, z});
    } else if (keyword == "f" || keyword == "l") {
      for (std::string_view word = line.word(); !word.empty(); word = line.word()) {
        corners.push_back(obj_corner(word, parts.points.size(), line));
      }
      cells.push_back({keyword == "f", number, corners.size()});
    }
  }
  size_t start = 0;
  for (const ObjCell &cell : cells) {
    const std::span<const int64_t> own(corners.data() + start, cell.end - start);
    if (cell.is_face) {
      add_polygon(parts, own, cell.line);
    } else {
      add_path(parts, own, cell.line);
    }
    start = cell.end;
  }
  return parts;
}

}  // namespace mvs::core
