// Numbers and attributes of VTK legacy files: POINT_DATA, CELL_DATA, FIELD, SCALARS, VECTORS ...
#pragma once

#include <string>
#include <vector>

#include "formats/surface/cursor.h"
#include "formats/surface/numbers.h"
#include "formats/surface/parts.h"

namespace mvs::core {

class VtkDataReader {
 public:
  VtkDataReader(Cursor &cursor, bool is_binary, bool is_version_5)
      : cursor_(cursor), is_binary_(is_binary), is_version_5_(is_version_5) {}

  Cursor &cursor() { return cursor_; }
  bool is_version_5() const { return is_version_5_; }
  // The name of a type of numbers.
  NumberType type();
  // `count` numbers that follow the end of a line.
  std::vector<double> numbers(uint64_t count, NumberType type, const char *what);
  // A section that is neither points nor cells, behind its keyword in small letters. Arrays go to
  // `parts`.
  void read_attribute(const std::string &keyword, SurfaceParts &parts);

 private:
  enum class Place { file, points, cells };

  void begin_data(Place place);
  void read_scalars(SurfaceParts &parts);
  void read_colours(SurfaceParts &parts);
  void read_lookup_table();
  void read_rows(uint32_t components, SurfaceParts &parts);
  void read_texture_coordinates(SurfaceParts &parts);
  void read_field(SurfaceParts &parts);
  void read_field_array(SurfaceParts &parts);
  void skip_metadata();
  std::vector<std::string> texts(uint64_t count);
  std::string text();
  // Reads rows of numbers, and keeps them under their name.
  void keep(const std::string &name, uint32_t components, uint64_t rows, NumberType type,
            SurfaceParts &parts);
  std::string name();
  uint32_t components(const char *what);

  Cursor &cursor_;
  bool is_binary_, is_version_5_;
  Place place_ = Place::file;
  uint64_t rows_ = 0;  // of POINT_DATA or CELL_DATA
};

}  // namespace mvs::core
