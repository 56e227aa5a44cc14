// PLY: ASCII, binary little-endian and big-endian. Points, polygons, and every other number of a
// point or polygon as an array of its name; other elements are skipped.
#include <algorithm>
#include <optional>

#include "base/error.h"
#include "formats/surface/cursor.h"
#include "formats/surface/numbers.h"
#include "formats/surface/parts.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

enum class PlyCoding { ascii, little, big };

struct PlyProperty {
  std::string name;
  NumberType type;
  std::optional<NumberType> count_type;  // of a list
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyCoding coding = PlyCoding::ascii;
  std::vector<PlyElement> elements;
};

NumberType ply_type(Line &line) {
  const std::string_view word = line.word();
  const std::optional<NumberType> type = number_type(word);
  if (!type) line.fail("%s is not a type of numbers of PLY", quoted(word).c_str());
  return *type;
}

PlyProperty ply_property(Line &line) {
  Line ahead = line;
  PlyProperty property;
  if (ahead.word() == "list") {
    line.word();
    property.count_type = ply_type(line);
    if (property.count_type->kind == NumberType::Kind::floating) {
      line.fail("the lengths of a list have to be whole numbers");
    }
  }
  property.type = ply_type(line);
  property.name = as_utf8(line.word());
  return property;
}

PlyCoding ply_coding(Line &line) {
  const std::string_view word = line.word();
  if (word == "ascii") return PlyCoding::ascii;
  if (word == "binary_little_endian") return PlyCoding::little;
  if (word == "binary_big_endian") return PlyCoding::big;
  line.fail("%s is not a format of PLY", quoted(word).c_str());
}

PlyHeader read_ply_header(Cursor &cursor, SurfaceParts &parts) {
  PlyHeader header;
  bool has_coding = false;
  if (without_blanks(cursor.line()) != "ply") cursor.fail("the file does not begin with `ply`");
  for (;;) {
    if (cursor.left() == 0) cursor.fail("the file ends within its header: it is cut short");
    const int32_t number = cursor.line_number();
    const std::string_view text = without_blanks(cursor.line());
    Line line(text, number);
    const std::string_view keyword = line.word();
    if (keyword == "end_header") break;
    if (keyword == "comment" || keyword == "obj_info") {
      note_comment(parts, text);
    } else if (keyword == "format") {
      header.coding = ply_coding(line);
      has_coding = true;
    } else if (keyword == "element") {
      PlyElement element;
      element.name = line.word();
      element.count = line.whole();
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      if (header.elements.empty()) line.fail("a property stands before the first element");
      header.elements.back().properties.push_back(ply_property(line));
    } else if (!keyword.empty()) {
      line.fail("%s is not a word of a PLY header", quoted(keyword).c_str());
    }
  }
  if (!has_coding) cursor.fail("the header does not state its format");
  return header;
}

// The numbers of one element after another.
class PlyReader {
 public:
  PlyReader(Cursor &cursor, PlyCoding coding) : cursor_(cursor), coding_(coding) {}

  bool is_ascii() const { return coding_ == PlyCoding::ascii; }
  double number(NumberType type) {
    if (is_ascii()) return cursor_.number_or_nan("a number");
    return number_at(cursor_.bytes(type.size, "an element").data(), type,
                     coding_ == PlyCoding::big);
  }
  uint64_t length(NumberType type) {
    const double count = number(type);
    if (!(count >= 0 && count <= static_cast<double>(cursor_.left()))) {
      cursor_.fail("a list states %g numbers, but the file ends after %zu bytes: it is cut short",
                   count, cursor_.left());
    }
    return static_cast<uint64_t>(count);
  }
  // Fails unless the rows of an element can follow.
  void must_hold(const PlyElement &element) {
    if (element.count == 0) return;
    if (element.properties.empty()) {
      cursor_.fail("the element %s has no property", quoted(element.name).c_str());
    }
    size_t least = 0;
    for (const PlyProperty &property : element.properties) {
      const NumberType stored = property.count_type ? *property.count_type : property.type;
      least += is_ascii() ? 2 : stored.size;
    }
    cursor_.must_hold(element.count, least, ("the number of " + as_utf8(element.name)).c_str());
  }
  int32_t line() const { return cursor_.line_number(); }

 private:
  Cursor &cursor_;
  PlyCoding coding_;
};

// The arrays of an element, one for each property.
std::vector<SurfaceArray> ply_arrays(const PlyElement &element, bool on_points) {
  std::vector<SurfaceArray> arrays;
  for (const PlyProperty &property : element.properties) {
    arrays.push_back({property.name, on_points, 1, {}});
  }
  return arrays;
}

size_t ply_property_index(const PlyElement &element, std::string_view name, bool is_list) {
  for (size_t k = 0; k < element.properties.size(); ++k) {
    const PlyProperty &property = element.properties[k];
    if (property.name == name && property.count_type.has_value() == is_list) return k;
  }
  return element.properties.size();
}

void keep_ply_arrays(std::vector<SurfaceArray> &&arrays, const PlyElement &element,
                     SurfaceParts &parts) {
  for (size_t k = 0; k < arrays.size(); ++k) {
    const std::string &name = arrays[k].name;
    const bool is_coordinate = arrays[k].on_points && (name == "x" || name == "y" || name == "z");
    if (element.properties[k].count_type || is_coordinate) continue;
    parts.arrays.push_back(std::move(arrays[k]));
  }
}

void read_ply_points(PlyReader &reader, const PlyElement &element, SurfaceParts &parts) {
  const size_t axis[] = {ply_property_index(element, "x", false),
                         ply_property_index(element, "y", false),
                         ply_property_index(element, "z", false)};
  for (const size_t index : axis) {
    MVS_MUST(index < element.properties.size(), MVS_E_FORMAT, "vertex",
             "the element `vertex` lacks the properties x, y, z");
  }
  std::vector<SurfaceArray> arrays = ply_arrays(element, true);
  for (uint64_t row = 0; row < element.count; ++row) {
    for (size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty &property = element.properties[k];
      if (property.count_type) {
        for (uint64_t left = reader.length(*property.count_type); left > 0; --left) {
          reader.number(property.type);
        }
      } else {
        arrays[k].values.push_back(reader.number(property.type));
      }
    }
    const double point[] = {arrays[axis[0]].values.back(), arrays[axis[1]].values.back(),
                            arrays[axis[2]].values.back()};
    add_points(parts, point);
  }
  keep_ply_arrays(std::move(arrays), element, parts);
}

// Rows of polygons, or of an element that is not used where `corners` is no property.
void read_ply_rows(PlyReader &reader, const PlyElement &element, size_t corners,
                   SurfaceParts &parts) {
  std::vector<SurfaceArray> arrays = ply_arrays(element, false);
  std::vector<int64_t> polygon;
  for (uint64_t row = 0; row < element.count; ++row) {
    polygon.clear();
    for (size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty &property = element.properties[k];
      const bool is_list = property.count_type.has_value();
      for (uint64_t left = is_list ? reader.length(*property.count_type) : 1; left > 0; --left) {
        const double number = reader.number(property.type);
        if (k == corners) polygon.push_back(index_of_number(number));
        if (!is_list && corners < element.properties.size()) arrays[k].values.push_back(number);
      }
    }
    if (corners < element.properties.size()) add_polygon(parts, polygon, reader.line());
  }
  if (corners < element.properties.size()) keep_ply_arrays(std::move(arrays), element, parts);
}

}  // namespace

SurfaceParts read_ply(std::string_view bytes) {
  SurfaceParts parts;
  parts.format = "PLY";
  Cursor cursor(bytes);
  const PlyHeader header = read_ply_header(cursor, parts);
  PlyReader reader(cursor, header.coding);
  bool has_faces = false;
  for (const PlyElement &element : header.elements) {
    reader.must_hold(element);
    MVS_MUST(element.name != "tristrips" || element.count == 0, MVS_E_UNSUPPORTED, "tristrips",
             "the file has strips of triangles: save it with polygons, or as STL");
    if (element.name == "vertex") {
      MVS_MUST(parts.points.empty(), MVS_E_FORMAT, "vertex", "the element `vertex` is given twice");
      read_ply_points(reader, element, parts);
      continue;
    }
    size_t corners = element.properties.size();
    if (element.name == "face") {
      corners = std::min(ply_property_index(element, "vertex_indices", true),
                         ply_property_index(element, "vertex_index", true));
      MVS_MUST(corners < element.properties.size() && !has_faces, MVS_E_FORMAT, "face",
               "the element `face` needs one list `vertex_indices`, once");
      has_faces = true;
    }
    read_ply_rows(reader, element, corners, parts);
  }
  return parts;
}

}  // namespace mvs::core
