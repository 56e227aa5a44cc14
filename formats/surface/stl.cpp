// STL, binary and ASCII: triangles with corners by value. Corners with equal coordinates become one
// point, in the order of their first appearance.
//
// Binary files may begin with "solid" as well, so that the number of bytes decides: 84 and 50 for
// each triangle.
#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "formats/surface/cursor.h"
#include "formats/surface/numbers.h"
#include "formats/surface/parts.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

constexpr size_t stl_header = 80, stl_start = stl_header + 4, stl_record = 50;
constexpr NumberType stl_float = {NumberType::Kind::floating, 4};
constexpr NumberType stl_count = {NumberType::Kind::whole, 4};

// Whether `a` comes before `b` by x, y, z, then index.
struct BeforeInSpace {
  const std::vector<Vec3> &points;
  bool operator()(uint32_t a, uint32_t b) const {
    for (int c = 0; c < 3; ++c) {
      if (points[a][c] != points[b][c]) return points[a][c] < points[b][c];
    }
    return a < b;
  }
};

// Replaces corners by the first one at the same place.
void merge_corners(SurfaceParts &parts) {
  const std::vector<Vec3> &corners = parts.points;
  std::vector<uint32_t> sorted(corners.size()), first(corners.size());
  std::iota(sorted.begin(), sorted.end(), 0u);
  std::sort(sorted.begin(), sorted.end(), BeforeInSpace{corners});
  for (size_t k = 0; k < sorted.size(); ++k) {
    const bool same = k > 0 && corners[sorted[k]] == corners[sorted[k - 1]];
    first[sorted[k]] = same ? first[sorted[k - 1]] : sorted[k];
  }
  std::vector<uint32_t> number(corners.size());
  std::vector<Vec3> points;
  for (uint32_t k = 0; k < corners.size(); ++k) {
    if (first[k] == k) {
      number[k] = static_cast<uint32_t>(points.size());
      points.push_back(corners[k]);
    } else {
      number[k] = number[first[k]];
    }
  }
  for (Tri &triangle : parts.triangles) {
    for (uint32_t &corner : triangle) corner = number[corner];
  }
  parts.points = std::move(points);
}

void add_corners(SurfaceParts &parts, const std::vector<double> &numbers) {
  const auto start = static_cast<int64_t>(parts.points.size());
  add_points(parts, numbers);
  const int64_t corners[] = {start, start + 1, start + 2};
  add_polygon(parts, corners, 0);
}

bool is_ascii_stl(std::string_view bytes) {
  if (bytes.size() >= stl_start) {
    const double triangles = number_at(bytes.data() + stl_header, stl_count, false);
    if (static_cast<double>(bytes.size()) ==
        static_cast<double>(stl_start) + static_cast<double>(stl_record) * triangles) {
      return false;
    }
  }
  constexpr size_t seen = 2000;  // a name of the solid may be long
  Cursor cursor(bytes);
  if (in_small_letters(cursor.word()) != "solid") return false;
  const std::string start = in_small_letters(bytes.substr(0, seen));
  return start.find("facet") != std::string::npos || start.find("endsolid") != std::string::npos ||
         bytes.find('\0') == std::string_view::npos;
}

void read_binary_stl(std::string_view bytes, SurfaceParts &parts) {
  Cursor cursor(bytes);
  note_comment(parts, cursor.bytes(stl_header, "the header of 80 bytes"));
  const std::string_view number = cursor.bytes(4, "the number of triangles");
  const auto triangles = static_cast<uint64_t>(number_at(number.data(), stl_count, false));
  if (cursor.left() / stl_record < triangles) {
    cursor.fail(
        "the header states %llu triangles, but the file has bytes for %zu: it is cut short, "
        "or no STL file",
        static_cast<unsigned long long>(triangles), cursor.left() / stl_record);
  }
  parts.points.reserve(3 * triangles);
  std::vector<double> corners;
  for (uint64_t k = 0; k < triangles; ++k) {
    const std::string_view record = cursor.bytes(stl_record, "a triangle");
    corners.clear();
    append_numbers(corners, record.substr(12, 36), stl_float, false);
    add_corners(parts, corners);
  }
}

// One facet, behind its first word. The normal is not used: it may be "nan".
void read_facet(Cursor &cursor, SurfaceParts &parts) {
  cursor.expect("normal");
  for (int k = 0; k < 3; ++k) cursor.number_or_nan("a normal");
  cursor.expect("outer");
  cursor.expect("loop");
  std::vector<double> corners;
  for (int k = 0; k < 3; ++k) {
    cursor.expect("vertex");
    for (int c = 0; c < 3; ++c) corners.push_back(cursor.number("a coordinate"));
  }
  cursor.expect("endloop");
  cursor.expect("endfacet");
  add_corners(parts, corners);
}

void read_ascii_stl(std::string_view bytes, SurfaceParts &parts) {
  Cursor cursor(bytes);
  while (!cursor.at_end()) {
    cursor.expect("solid");
    note_comment(parts, cursor.line());
    for (;;) {
      const std::string word = in_small_letters(cursor.word());
      if (word == "endsolid") break;
      if (word.empty()) cursor.fail("the file ends without `endsolid`: it is cut short");
      if (word != "facet") {
        cursor.fail("%s stands where `facet` or `endsolid` is needed", quoted(word).c_str());
      }
      read_facet(cursor, parts);
    }
    cursor.line();
  }
}

}  // namespace

SurfaceParts read_stl(std::string_view bytes) {
  SurfaceParts parts;
  parts.format = "STL";
  if (is_ascii_stl(bytes)) {
    read_ascii_stl(bytes, parts);
  } else {
    read_binary_stl(bytes, parts);
  }
  merge_corners(parts);
  return parts;
}

}  // namespace mvs::core
