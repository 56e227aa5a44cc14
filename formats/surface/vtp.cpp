// VTK XML PolyData (.vtp), uncompressed, with any number of pieces. 3D Slicer states the frame in
// the field array SPACE, libmvs its unit in UNITS.
#include "base/error.h"
#include "formats/surface/cursor.h"
#include "formats/surface/parts.h"
#include "formats/surface/vtp_data.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

// A file while it is read.
struct VtpFile {
  std::vector<XmlElement> elements;
  VtpData data;
};

uint64_t vtp_count(const XmlElement &element, const char *key, const char *otherwise) {
  uint64_t count = 0;
  const std::string_view text = element.attribute(key, otherwise);
  if (parse_whole(text, count) && count < none) return count;
  throw Error(MVS_E_FORMAT, "",
              format("%s is %s; a whole number below 2^32 is needed", key, quoted(text).c_str()),
              element.line);
}

const XmlElement &needed_element(const VtpFile &file, const XmlElement &in, const char *name) {
  const XmlElement *found = find_inside(file.elements, in, name);
  if (found) return *found;
  throw Error(MVS_E_FORMAT, "", format("the element %s lacks %s", quoted(in.name).c_str(), name),
              in.line);
}

// The array of this name in a list of cells.
const XmlElement &cell_array(const VtpFile &file, const XmlElement &cells, std::string_view name) {
  for (const uint32_t index : cells.inside) {
    if (file.elements[index].attribute("Name") == name) return file.elements[index];
  }
  throw Error(MVS_E_FORMAT, "",
              format("the element %s lacks the array %s", quoted(cells.name).c_str(),
                     std::string(name).c_str()),
              cells.line);
}

template <typename Add>
void add_vtp_cells(VtpFile &file, const XmlElement &piece, const char *name, const char *key,
                   SurfaceParts &parts, Add add) {
  const uint64_t count = vtp_count(piece, key, "0");
  if (count == 0) return;
  const XmlElement &cells = needed_element(file, piece, name);
  const std::vector<double> ends = file.data.numbers(cell_array(file, cells, "offsets"), count);
  const int64_t nodes = index_of_number(ends.back());
  if (nodes < 0) throw Error(MVS_E_FORMAT, "offsets", "the last offset is no count", cells.line);
  const std::vector<double> points =
      file.data.numbers(cell_array(file, cells, "connectivity"), static_cast<uint64_t>(nodes));
  std::vector<int64_t> corners;
  int64_t at = 0;
  for (const double number : ends) {
    const int64_t end = index_of_number(number);
    if (end < at || end > nodes) {
      throw Error(MVS_E_FORMAT, "offsets", format("offset %g of %s is not valid", number, name),
                  cells.line);
    }
    corners.clear();
    for (; at < end; ++at) corners.push_back(index_of_number(points[static_cast<size_t>(at)]));
    add(parts, corners, cells.line);
  }
}

void add_vtp_arrays(VtpFile &file, const XmlElement &piece, bool on_points, SurfaceParts &parts) {
  const XmlElement *section =
      find_inside(file.elements, piece, on_points ? "PointData" : "CellData");
  if (!section) return;
  for (const uint32_t index : section->inside) {
    const XmlElement &array = file.elements[index];
    if (array.attribute("type") == "String") {
      if (on_points) parts.point_names = file.data.texts(array);
      continue;
    }
    const uint64_t components = vtp_count(array, "NumberOfComponents", "1");
    const uint64_t rows = on_points ? parts.points.size() : parts.cells;
    if (components < 1 || components > 1000) {
      throw Error(MVS_E_FORMAT, "", "NumberOfComponents has to be 1 to 1000", array.line);
    }
    parts.arrays.push_back({as_utf8(array.attribute("Name")), on_points,
                            static_cast<uint32_t>(components),
                            file.data.numbers(array, rows * components)});
  }
}

SurfaceParts read_piece(VtpFile &file, const XmlElement &piece) {
  SurfaceParts parts;
  const uint64_t points = vtp_count(piece, "NumberOfPoints", "0");
  if (points > 0) {
    const XmlElement &section = needed_element(file, piece, "Points");
    add_points(parts, file.data.numbers(needed_element(file, section, "DataArray"), 3 * points));
  }
  add_unused_cells(parts, vtp_count(piece, "NumberOfVerts", "0"));
  add_vtp_cells(file, piece, "Lines", "NumberOfLines", parts, add_path);
  add_vtp_cells(file, piece, "Polys", "NumberOfPolys", parts, add_polygon);
  add_vtp_cells(file, piece, "Strips", "NumberOfStrips", parts, add_strip);
  add_vtp_arrays(file, piece, true, parts);
  add_vtp_arrays(file, piece, false, parts);
  return parts;
}

void read_vtp_fields(VtpFile &file, const XmlElement &data, SurfaceParts &parts) {
  const XmlElement *fields = find_inside(file.elements, data, "FieldData");
  if (!fields) return;
  for (const uint32_t index : fields->inside) {
    const XmlElement &array = file.elements[index];
    const std::string_view name = array.attribute("Name");
    if (array.attribute("type") != "String" || (name != "SPACE" && name != "UNITS")) continue;
    const std::vector<std::string> texts = file.data.texts(array);
    if (!texts.empty()) note_field(parts, name, texts[0]);
  }
}

void must_be_polydata(const XmlElement &root) {
  MVS_MUST(root.name == "VTKFile", MVS_E_FORMAT, "", "the file is not a VTK XML file");
  MVS_MUST(root.attribute("type") == "PolyData", MVS_E_FORMAT, "",
           "the file holds %s: save the surface as PolyData (in ParaView: Extract Surface)",
           quoted(root.attribute("type")).c_str());
  const std::string_view compressor = root.attribute("compressor");
  if (compressor.empty()) return;
  MVS_MUST(
      compressor == "vtkZLibDataCompressor" && has_zlib(), MVS_E_UNSUPPORTED, "compressor",
      "the file is compressed by %s, %s: save it without compression (3D Slicer: the box "
      "Compress off in Save; ParaView: Compressor Type None; PyVista: compression=None), or as "
      ".vtk or .stl",
      quoted(compressor).c_str(),
      has_zlib() ? "only zlib is read" : "and this libmvs was built without zlib (-DMVS_ZLIB=ON)");
}

}  // namespace

SurfaceParts read_vtp(std::string_view bytes) {
  std::vector<XmlElement> elements = read_xml(bytes, "AppendedData");
  const XmlElement root = elements[0];
  must_be_polydata(root);
  const XmlElement *appended = find_inside(elements, root, "AppendedData");
  const VtpData data(root, appended, bytes.size());
  VtpFile file{std::move(elements), data};
  const XmlElement &content = needed_element(file, root, "PolyData");
  SurfaceParts parts;
  parts.format = "VTP";
  read_vtp_fields(file, content, parts);
  bool is_first = true;
  for (const uint32_t index : content.inside) {
    if (file.elements[index].name != "Piece") continue;
    SurfaceParts piece = read_piece(file, file.elements[index]);
    if (is_first) {
      piece.format = parts.format;
      piece.frame = parts.frame;
      piece.unit = parts.unit;
      parts = std::move(piece);
    } else {
      append_piece(parts, std::move(piece));
    }
    is_first = false;
  }
  return parts;
}

}  // namespace mvs::core
