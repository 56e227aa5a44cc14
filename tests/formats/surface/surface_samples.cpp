// Writers of the sample, each by the description of its format.
#include "tests/formats/surface/surface_samples.h"

#include "formats/surface/vtp_blocks.h"

namespace mvs::core {
namespace {

// The length in front of a block, and the block.
std::string with_length(const std::string &block) {
  return number_bytes(static_cast<uint32_t>(block.size())) + block;
}

std::string base64_of(const std::string &bytes) {
  std::string text;
  append_base64(text, bytes);
  return text;
}

// A zlib stream (RFC 1950) whose bytes are stored as they are.
std::string zlib_stream(const std::string &bytes) {
  uint32_t a = 1, b = 0;  // Adler-32
  for (const char c : bytes) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const uint16_t size = static_cast<uint16_t>(bytes.size());
  std::string stream = "\x78\x01\x01";
  for (const uint16_t word : {size, static_cast<uint16_t>(~size)}) {
    stream += {static_cast<char>(word & 255), static_cast<char>(word >> 8)};
  }
  stream += bytes;
  for (const uint32_t word : {b, a}) {
    stream += {static_cast<char>(word >> 8), static_cast<char>(word & 255)};
  }
  return stream;
}

// A VTP file while it is written: arrays in the element or appended.
struct VtpText {
  std::string coding;
  bool is_compressed;
  std::string appended = {};

  // An array with its length, or its compressed blocks of 32 bytes with their header.
  std::string coded(const std::string &bytes, bool is_raw) const {
    if (!is_compressed) return is_raw ? with_length(bytes) : base64_of(with_length(bytes));
    constexpr uint32_t whole = 32;
    const uint32_t size = static_cast<uint32_t>(bytes.size()), last = size % whole;
    std::string header, blocks;
    for (size_t at = 0; at < size; at += whole) {
      const std::string stream = zlib_stream(bytes.substr(at, whole));
      header += number_bytes(static_cast<uint32_t>(stream.size()));
      blocks += stream;
    }
    const uint32_t count = (size + whole - 1) / whole;
    header = number_bytes(count) + number_bytes(whole) + number_bytes(last) + header;
    return is_raw ? header + blocks : base64_of(header) + base64_of(blocks);
  }

  std::string array(const std::string &type, const std::string &name, const std::string &values,
                    const std::string &block, int components = 1) {
    std::string text = "<DataArray type=\"" + type + "\" Name=\"" + name +
                       "\" NumberOfComponents=\"" + std::to_string(components) + "\" format=\"";
    const std::string end =
        "\n<InformationKey name=\"a\"><Value "
        "index=\"0\">5</Value></InformationKey>\n</DataArray>\n";
    if (coding == "ascii") return text + "ascii\">\n" + values + end;
    if (coding == "binary") {
      return text + "binary\">\n  " + coded(block, false) + end;
    }
    text += "appended\" offset=\"" + std::to_string(appended.size()) + "\"/>\n";
    appended += coded(block, coding == "raw");
    return text;
  }
};

std::string tuples(const std::vector<int64_t> &numbers) {
  std::string text;
  for (const int64_t number : numbers) text += std::to_string(number) + " ";
  return text;
}

std::string tuple_bytes(const std::vector<int64_t> &numbers, bool is_big = false) {
  std::string bytes;
  for (const int64_t number : numbers) bytes += number_bytes(number, is_big);
  return bytes;
}

const std::vector<int64_t> corners = {0, 1, 2, 0, 2, 3, 1, 4, 5, 2}, ends = {3, 6, 10},
                           labels = {7, 1, 2, 3, 4, 5};

std::string vtk_cells(bool is_binary, bool is_version_5) {
  if (is_version_5) {
    std::vector<int64_t> offsets = {0};
    offsets.insert(offsets.end(), ends.begin(), ends.end());
    return "POLYGONS 4 10\nOFFSETS vtktypeint64\n" +
           (is_binary ? tuple_bytes(offsets, true) : tuples(offsets)) +
           "\nCONNECTIVITY vtktypeint64\n" +
           (is_binary ? tuple_bytes(corners, true) : tuples(corners)) + "\n";
  }
  std::string bytes;
  for (const auto &polygon : sample_polygons) {
    bytes += number_bytes(static_cast<int32_t>(polygon.size()), true);
    for (const uint32_t corner : polygon) bytes += number_bytes(static_cast<int32_t>(corner), true);
  }
  return "POLYGONS 3 13\n" + (is_binary ? bytes + "\n" : polygon_lines());
}

}  // namespace

SurfaceSample stl_sample(bool is_binary, const std::string &title) {
  std::string ascii = "solid " + title + "\n", binary = title;
  binary.resize(80, ' ');
  binary += number_bytes(static_cast<uint32_t>(sample_triangles.size()));
  for (const Tri &triangle : sample_triangles) {
    ascii += "facet normal nan nan nan\n outer loop\n";
    for (int c = 0; c < 3; ++c) binary += number_bytes(0.0f);
    for (const uint32_t corner : triangle) {
      const Vec3 &p = sample_points[corner];
      ascii += "  vertex";
      for (int c = 0; c < 3; ++c) {
        ascii += " " + decimal_text(p[c]);
        binary += number_bytes(static_cast<float>(p[c]));
      }
      ascii += "\n";
    }
    ascii += " endloop\nendfacet\n";
    binary += std::string(2, '\0');
  }
  return {is_binary ? "binary.stl" : "ascii.stl", is_binary ? binary : ascii + "endsolid\n"};
}

SurfaceSample ply_sample(const std::string &coding) {
  std::string bytes =
      "ply\nformat " + coding +
      " 1.0\ncomment SPACE=LPS\nelement vertex 6\nproperty float x\nproperty double y\n"
      "property float z\nproperty uchar label\nelement face 3\nproperty list uchar int "
      "vertex_indices\nelement other 2\nproperty short a\nend_header\n";
  const bool is_ascii = coding == "ascii", is_big = coding == "binary_big_endian";
  for (size_t k = 0; k < sample_points.size(); ++k) {
    const Vec3 &p = sample_points[k];
    if (is_ascii) {
      bytes += decimal_text(p[0]) + " " + decimal_text(p[1]) + " " + decimal_text(p[2]) + " " +
               std::to_string(labels[k]) + "\n";
    } else {
      bytes += number_bytes(static_cast<float>(p[0]), is_big) + number_bytes(p[1], is_big) +
               number_bytes(static_cast<float>(p[2]), is_big) + static_cast<char>(labels[k]);
    }
  }
  if (is_ascii) return {"ascii.ply", bytes + polygon_lines() + "1\n2\n"};
  for (const auto &polygon : sample_polygons) {
    bytes += static_cast<char>(polygon.size());
    for (const uint32_t corner : polygon)
      bytes += number_bytes(static_cast<int32_t>(corner), is_big);
  }
  return {coding + ".ply", bytes + std::string(4, '\1')};
}

SurfaceSample obj_sample() {
  std::string text = "# SPACE=RAS\no sheet\n";
  for (const Vec3 &p : sample_points) {
    text += "v " + decimal_text(p[0]) + " " + decimal_text(p[1]) + " " + decimal_text(p[2]) + "\n";
  }
  return {"plain.obj", text +
                           "vt 0 0\nvn 0 0 1\nusemtl red\nf 1/1 2/1 3/1\nf 1//1 -4//1 \\\n 4//1\n"
                           "f 2/1/1 5/1/1 6/1/1 3/1/1\n"};
}

SurfaceSample off_sample() {
  return {"plain.off", "OFF # a comment\n\n6 3 0\n" + point_lines() + polygon_lines()};
}

SurfaceSample vtk_sample(bool is_binary, bool is_version_5) {
  std::string bytes =
      is_version_5 ? "# vtk DataFile Version 5.1\n" : "# vtk DataFile Version 3.0\n";
  bytes += "3D Slicer output. SPACE=RAS\n";
  bytes += is_binary ? "BINARY\n" : "ASCII\n";
  bytes += "DATASET POLYDATA\nPOINTS 6 double\n";
  bytes += is_binary ? point_bytes<double>(true) + "\n" : point_lines();
  bytes += "METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1\n\n";
  bytes += vtk_cells(is_binary, is_version_5);
  std::string areas, values;
  for (const float area : {0.5f, 1.5f, 2.5f}) {
    areas += decimal_text(area) + " ";
    values += number_bytes(area, true);
  }
  bytes += "CELL_DATA 3\nSCALARS area%20of float 1\nLOOKUP_TABLE default\n";
  bytes += (is_binary ? values : areas) + "\n";
  bytes += "POINT_DATA 6\nFIELD FieldData 1\nlabel 1 6 vtktypeint64\n";
  bytes += (is_binary ? tuple_bytes(labels, true) : tuples(labels)) + "\n";
  return {std::string(is_binary ? "binary" : "ascii") + (is_version_5 ? "_5" : "_3") + ".vtk",
          bytes};
}

SurfaceSample vtp_sample(const std::string &coding, bool is_compressed) {
  VtpText vtp{coding, is_compressed};
  std::string text =
      "<?xml version=\"1.0\"?>\n<!-- a comment -->\n<VTKFile type=\"PolyData\" version=\"0.1\" "
      "byte_order=\"" +
      std::string(std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian") +
      (is_compressed ? "\" compressor=\"vtkZLibDataCompressor" : "") +
      "\" header_type=\"UInt32\">\n<PolyData>\n<FieldData>\n<Array type=\"String\" Name=\"SPACE\" "
      "NumberOfTuples=\"1\" format=\"ascii\">76 80 83 0</Array>\n</FieldData>\n<Piece "
      "NumberOfPoints=\"6\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"3\">\n<PointData Scalars=\"label\">\n";
  // one statement each: the order of the arrays is that of the calls
  text += vtp.array("Int64", "label", tuples(labels), tuple_bytes(labels));
  text += "</PointData>\n<CellData>\n";
  text += vtp.array("Int64", "area &amp; more", "1 2 3", tuple_bytes({1, 2, 3}));
  text += "</CellData>\n<Points>\n";
  text += vtp.array("Float64", "Points", point_lines(),
                    point_bytes<double>(std::endian::native == std::endian::big), 3);
  text += "</Points>\n<Polys>\n";
  text += vtp.array("Int64", "connectivity", tuples(corners), tuple_bytes(corners));
  text += vtp.array("Int64", "offsets", tuples(ends), tuple_bytes(ends));
  text += "</Polys>\n</Piece>\n</PolyData>\n";
  if (!vtp.appended.empty()) {
    text +=
        "<AppendedData encoding=\"" + coding + "\">\n   _" + vtp.appended + "\n  </AppendedData>\n";
  }
  return {coding + (is_compressed ? "_zlib" : "") + ".vtp", text + "</VTKFile>\n"};
}

SurfaceSample markups_sample() {
  return {"points.mrk.json",
          "{\"@schema\": \"https://raw.githubusercontent.com/slicer/slicer/master/markups-schema\","
          " \"markups\": [{\"type\": \"Fiducial\", \"coordinateSystem\": \"LPS\", "
          "\"coordinateUnits\": \"mm\", \"controlPoints\": ["
          "{\"id\": \"1\", \"label\": \"AL\", \"position\": [1.5, -2, 3], \"orientation\": [-1.0, "
          "-0.0, -0.0, -0.0, -1.0, -0.0, 0.0, 0.0, 1.0], \"positionStatus\": \"defined\"}, "
          "{\"id\": \"2\", \"label\": \"gone\", \"position\": [0, 0, 0], "
          "\"positionStatus\": \"undefined\"}, "
          "{\"id\": \"3\", \"label\": \"PM\", \"position\": [4, 5, 6.25]}]}]}"};
}

SurfaceSample fcsv_sample() {
  return {"points.fcsv",
          "# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n"
          "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n"
          "1,1.5,-2,3,0,0,0,1,1,1,0,AL,\"a, b\",,2,0\n2,4,5,6.25,0,0,0,1,1,1,0,PM,,,2,0\n"};
}

SurfaceSample csv_sample() {
  return {"points.csv",
          "label,l,p,s,defined,selected\nAL,1.5,-2,3,1,1\ngone,0,0,0,0,1\nPM,4,5,6.25,1,1\n"};
}

std::vector<SurfaceSample> surface_samples() {
  std::vector<SurfaceSample> samples = {stl_sample(true, "solid but binary"),
                                        stl_sample(false, "name"),
                                        ply_sample("ascii"),
                                        ply_sample("binary_little_endian"),
                                        ply_sample("binary_big_endian"),
                                        obj_sample(),
                                        off_sample(),
                                        vtk_sample(false, false),
                                        vtk_sample(false, true),
                                        vtk_sample(true, false),
                                        vtk_sample(true, true),
                                        vtp_sample("ascii"),
                                        vtp_sample("binary"),
                                        vtp_sample("raw"),
                                        vtp_sample("base64")};
  if (has_zlib()) {
    for (const char *coding : {"binary", "raw", "base64"}) {
      samples.push_back(vtp_sample(coding, true));
    }
  }
  return samples;
}

std::vector<SurfaceSample> landmark_samples() {
  return {markups_sample(), fcsv_sample(), csv_sample()};
}

}  // namespace mvs::core
