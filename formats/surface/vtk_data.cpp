// Attribute sections of VTK legacy files. Sections that hold no numbers of points or cells are
// skipped, each by its own layout, as the format states no lengths.
#include "formats/surface/vtk_data.h"

#include <cmath>
#include <optional>

#include "base/error.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

constexpr NumberType one_byte = {NumberType::Kind::whole, 1};

}  // namespace

NumberType VtkDataReader::type() {
  const std::string_view word = cursor_.word();
  const std::optional<NumberType> type = number_type(word);
  if (!type) cursor_.fail("%s is not a type of numbers that is read", quoted(word).c_str());
  return *type;
}

std::string VtkDataReader::name() {
  const std::string_view word = cursor_.word();
  if (word.empty()) cursor_.fail("the file ends where a name is needed: it is cut short");
  return as_utf8(percent_decoded(word));
}

uint32_t VtkDataReader::components(const char *what) {
  constexpr uint64_t most = 1000;
  const uint64_t count = cursor_.whole(what);
  if (count < 1 || count > most) {
    cursor_.fail("%s is %llu; it has to be 1 to %llu", what, static_cast<unsigned long long>(count),
                 static_cast<unsigned long long>(most));
  }
  return static_cast<uint32_t>(count);
}

std::vector<double> VtkDataReader::numbers(uint64_t count, NumberType type, const char *what) {
  std::vector<double> found;
  if (is_binary_) {
    cursor_.must_hold(count, type.size, what);
    append_numbers(found, cursor_.bytes(count * type.size, what), type, true);
    return found;
  }
  cursor_.must_hold(count, 2, what);  // a digit and a blank
  found.reserve(count);
  for (uint64_t k = 0; k < count; ++k) found.push_back(cursor_.number_or_nan("a number"));
  return found;
}

void VtkDataReader::keep(const std::string &name, uint32_t components, uint64_t rows,
                         NumberType type, SurfaceParts &parts) {
  cursor_.must_hold(rows, components, "the number of rows");
  SurfaceArray array{name, place_ == Place::points, components,
                     numbers(rows * components, type, "an array")};
  if (place_ != Place::file && rows == rows_) parts.arrays.push_back(std::move(array));
}

void VtkDataReader::read_attribute(const std::string &keyword, SurfaceParts &parts) {
  if (keyword == "point_data") return begin_data(Place::points);
  if (keyword == "cell_data") return begin_data(Place::cells);
  if (keyword == "field") return read_field(parts);
  if (keyword == "metadata") return skip_metadata();
  if (keyword == "scalars") return read_scalars(parts);
  if (keyword == "color_scalars") return read_colours(parts);
  if (keyword == "lookup_table") return read_lookup_table();
  if (keyword == "texture_coordinates") return read_texture_coordinates(parts);
  if (keyword == "vectors" || keyword == "normals") return read_rows(3, parts);
  if (keyword == "tensors") return read_rows(9, parts);
  if (keyword == "tensors6") return read_rows(6, parts);
  const bool is_single =
      keyword == "global_ids" || keyword == "pedigree_ids" || keyword == "edge_flags";
  if (is_single) return read_rows(1, parts);
  cursor_.fail("%s is not a section of VTK PolyData that is read", quoted(keyword).c_str());
}

void VtkDataReader::begin_data(Place place) {
  rows_ = cursor_.whole("the number of rows");
  place_ = place;
  cursor_.line();
}

void VtkDataReader::read_rows(uint32_t components, SurfaceParts &parts) {
  const std::string title = name();
  const NumberType of = type();
  cursor_.line();
  keep(title, components, rows_, of, parts);
}

void VtkDataReader::read_scalars(SurfaceParts &parts) {
  const std::string title = name();
  const NumberType of = type();
  const std::string_view count = without_blanks(cursor_.line());
  uint64_t columns = 1;
  if (!count.empty() && (!parse_whole(count, columns) || columns < 1 || columns > 4)) {
    cursor_.fail("%s is not a number of components of SCALARS, 1 to 4", quoted(count).c_str());
  }
  Cursor ahead = cursor_;
  if (in_small_letters(ahead.word()) == "lookup_table") {
    ahead.line();
    cursor_ = ahead;
  }
  keep(title, static_cast<uint32_t>(columns), rows_, of, parts);
}

// Binary colours are bytes, ASCII ones these divided by 255; VTK writes labels of one byte so, too.
void VtkDataReader::read_colours(SurfaceParts &parts) {
  const std::string title = name();
  const uint32_t columns = components("the number of colour components");
  cursor_.line();
  const size_t arrays = parts.arrays.size();
  keep(title, columns, rows_, one_byte, parts);
  if (is_binary_ || parts.arrays.size() == arrays) return;
  for (double &value : parts.arrays.back().values) value = std::floor(255 * value + 0.5);
}

void VtkDataReader::read_lookup_table() {
  name();
  const uint64_t size = cursor_.count("the size of the table", 4);
  cursor_.line();
  numbers(4 * size, one_byte, "the table");
}

void VtkDataReader::read_texture_coordinates(SurfaceParts &parts) {
  const std::string title = name();
  const uint32_t columns = components("the number of texture coordinates");
  const NumberType of = type();
  cursor_.line();
  keep(title, columns, rows_, of, parts);
}

void VtkDataReader::read_field(SurfaceParts &parts) {
  name();
  const uint64_t arrays = cursor_.count("the number of arrays", 1);
  cursor_.line();
  for (uint64_t k = 0; k < arrays; ++k) read_field_array(parts);
}

void VtkDataReader::read_field_array(SurfaceParts &parts) {
  std::string title = name();
  if (in_small_letters(title) == "metadata") {
    skip_metadata();
    title = name();
  }
  const uint32_t columns = components("the number of components");
  const uint64_t rows = cursor_.count("the number of rows", 1);
  Cursor ahead = cursor_;
  if (in_small_letters(ahead.word()) == "string") {
    ahead.line();
    cursor_ = ahead;
    cursor_.must_hold(rows, columns, "the number of texts");
    std::vector<std::string> found = texts(rows * columns);
    if (place_ == Place::file && !found.empty()) note_field(parts, title, found[0]);
    if (place_ == Place::points && columns == 1) parts.point_names = std::move(found);
    return;
  }
  const NumberType of = type();
  cursor_.line();
  keep(title, columns, rows, of, parts);
}

// Texts are lines in an ASCII file. In a binary one the two highest bits of the first byte are the
// number of bytes of the length: 3 one, 2 two, 1 four, 0 eight.
std::string VtkDataReader::text() {
  if (!is_binary_) return as_utf8(percent_decoded(without_blanks(cursor_.line())));
  const auto first = static_cast<unsigned char>(cursor_.bytes(1, "a text")[0]);
  uint64_t length = first & 0x3fu;
  const size_t more = first >> 6 == 3 ? 0 : first >> 6 == 2 ? 1 : first >> 6 == 1 ? 3 : 7;
  for (const char c : cursor_.bytes(more, "a text")) {
    length = length << 8 | static_cast<unsigned char>(c);
  }
  return as_utf8(cursor_.bytes(length, "a text"));
}

std::vector<std::string> VtkDataReader::texts(uint64_t count) {
  std::vector<std::string> found;
  for (uint64_t k = 0; k < count; ++k) found.push_back(text());
  return found;
}

// Lines up to an empty one.
void VtkDataReader::skip_metadata() {
  cursor_.line();
  while (cursor_.left() > 0 && !without_blanks(cursor_.line()).empty()) continue;
}

}  // namespace mvs::core
