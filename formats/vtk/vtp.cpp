// VTK XML PolyData: chordae as lines, triangles as polygons, arrays as base64 of little- or
// big-endian numbers behind a 64-bit length (VTK file formats, version 1.0 with header_type
// UInt64).
#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

#include "formats/text/base64.h"
#include "formats/text/xml.h"
#include "formats/vtk/polydata.h"

namespace mvs::core {
namespace {

const char *type_name(double) {
  return "Float64";
}
const char *type_name(int64_t) {
  return "Int64";
}
const char *type_name(uint64_t) {
  return "UInt64";
}
const char *type_name(int32_t) {
  return "Int32";
}
const char *type_name(uint32_t) {
  return "UInt32";
}
const char *type_name(uint8_t) {
  return "UInt8";
}

class VtpWriter {
 public:
  std::string write(const VtkPolyData &current);

 private:
  void section(const char *name, const std::vector<VtkArray> &arrays);
  void cells(const char *name, const VtkCells &cells);

  template <typename Number>
  void array(std::string_view name, size_t components, const std::vector<Number> &values);
  // Strings are written as byte codes with a terminating zero.
  void array(std::string_view name, size_t, const std::vector<std::string> &values);

  std::string out_;
  bool in_field_ = false;  // the section whose arrays state their own lengths
};

std::string VtpWriter::write(const VtkPolyData &current) {
  out_ += "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"";
  out_ += std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
  out_ += "\" header_type=\"UInt64\">\n<PolyData>\n";
  in_field_ = true;
  section("FieldData", current.field_data);
  in_field_ = false;
  out_ += "<Piece NumberOfPoints=\"" + std::to_string(current.points.size() / 3) +
          "\" NumberOfVerts=\"0\" NumberOfLines=\"" + std::to_string(current.lines.count) +
          "\" NumberOfStrips=\"0\" NumberOfPolys=\"" + std::to_string(current.triangles.count) +
          "\">\n";
  section("PointData", current.point_data);
  section("CellData", current.cell_data);
  out_ += "<Points>\n";
  array("Points", 3, current.points);
  out_ += "</Points>\n";
  cells("Lines", current.lines);
  cells("Polys", current.triangles);
  out_ += "</Piece>\n</PolyData>\n</VTKFile>\n";
  return std::move(out_);
}

void VtpWriter::section(const char *name, const std::vector<VtkArray> &arrays) {
  out_.append("<").append(name).append(">\n");
  for (const VtkArray &given : arrays) {
    std::visit([&](const auto &values) { array(given.name, given.components, values); },
               given.values);
  }
  out_.append("</").append(name).append(">\n");
}

void VtpWriter::cells(const char *name, const VtkCells &cells) {
  std::vector<int64_t> ends;
  ends.reserve(cells.count);
  for (size_t k = 1; k <= cells.count; ++k) {
    ends.push_back(static_cast<int64_t>(k * cells.nodes_each));
  }
  out_.append("<").append(name).append(">\n");
  array("connectivity", 1, cells.nodes);
  array("offsets", 1, ends);
  out_.append("</").append(name).append(">\n");
}

template <typename Number>
void VtpWriter::array(std::string_view name, size_t components, const std::vector<Number> &values) {
  const uint64_t size = values.size() * sizeof(Number);
  std::string bytes(sizeof size + size, '\0');
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size > 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
  out_.append("<DataArray type=\"").append(type_name(Number{})).append("\" Name=\"");
  out_ += xml_escaped(name) + "\" NumberOfComponents=\"" + std::to_string(components) + "\"";
  if (in_field_) out_ += " NumberOfTuples=\"" + std::to_string(values.size() / components) + "\"";
  out_ += " format=\"binary\">";
  append_base64(out_, bytes);
  out_ += "</DataArray>\n";
}

void VtpWriter::array(std::string_view name, size_t, const std::vector<std::string> &values) {
  out_.append("<Array type=\"String\" Name=\"").append(name).append("\" NumberOfTuples=\"");
  out_ += std::to_string(values.size()) + "\" format=\"ascii\">";
  for (const std::string &value : values) {
    for (const char c : value) out_ += std::to_string(static_cast<unsigned char>(c)) + " ";
    out_ += "0 ";
  }
  out_ += "</Array>\n";
}

}  // namespace

std::string vtp_text(const VtkPolyData &current) {
  return VtpWriter().write(current);
}

std::string write_vtp(const Model &model, const State &state, const std::vector<VtpArray> &arrays) {
  return vtp_text(make_vtk_polydata(model, state, arrays));
}

}  // namespace mvs::core
