// OFF, ASCII: points and polygons; colours and normals behind them are skipped.
#include "formats/surface/cursor.h"
#include "formats/surface/parts.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

// The next line that holds more than a comment.
Line next_off_line(Cursor &cursor, SurfaceParts &parts, const char *what) {
  for (;;) {
    cursor.skip_blanks();
    const int32_t number = cursor.line_number();
    std::string_view text = cursor.line();
    const size_t comment = text.find('#');
    if (comment != std::string_view::npos) {
      note_comment(parts, text.substr(comment));
      text = text.substr(0, comment);
    }
    if (!without_blanks(text).empty()) return {without_blanks(text), number};
    if (cursor.left() == 0) cursor.fail("the file ends where %s is needed: it is cut short", what);
  }
}

// Skips the first word, "OFF" with letters for further columns, and returns the line of the counts.
Line counts_line(Cursor &cursor, SurfaceParts &parts) {
  Line line = next_off_line(cursor, parts, "`OFF`");
  const std::string word = in_small_letters(line.word());
  const bool is_plain = word == "off" || word == "coff" || word == "noff" || word == "cnoff" ||
                        word == "stoff" || word == "stcoff" || word == "stnoff";
  if (!is_plain) line.fail("%s stands where `OFF` is needed", quoted(word).c_str());
  if (line.at_end()) return next_off_line(cursor, parts, "the number of points");
  return line;
}

}  // namespace

SurfaceParts read_off(std::string_view bytes) {
  SurfaceParts parts;
  parts.format = "OFF";
  Cursor cursor(bytes);
  Line counts = counts_line(cursor, parts);
  constexpr size_t shortest_point = 6, shortest_polygon = 8;  // bytes: "0 0 0\n", "3 0 1 2\n"
  const uint64_t points = counts.whole(), polygons = counts.whole();
  cursor.must_hold(points, shortest_point, "the number of points");
  for (uint64_t k = 0; k < points; ++k) {
    Line line = next_off_line(cursor, parts, "a point");
    const double x = line.number(), y = line.number(), z = line.number();
    add_points(parts, std::vector<double>{x, y, z});
  }
  cursor.must_hold(polygons, shortest_polygon, "the number of polygons");
  for (uint64_t k = 0; k < polygons; ++k) {
    Line line = next_off_line(cursor, parts, "a polygon");
    const uint64_t corners = line.whole();
    std::vector<int64_t> polygon;
    for (uint64_t c = 0; c < corners; ++c) polygon.push_back(static_cast<int64_t>(line.whole()));
    add_polygon(parts, polygon, line.number_of_line());
  }
  return parts;
}

}  // namespace mvs::core
