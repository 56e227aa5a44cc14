// VTK XML PolyData: chordae as lines, triangles as polygons, arrays as base64 of little- or
// big-endian numbers behind a 64-bit length (VTK file formats, version 1.0 with header_type
// UInt64).
#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <string>

#include "base/error.h"
#include "formats/formats.h"

namespace mvs {
namespace {

constexpr double mm = 1e3;

void append_base64(std::string &out, std::string_view bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (size_t at = 0; at < bytes.size(); at += 3) {
    const size_t here = std::min<size_t>(3, bytes.size() - at);
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < here ? static_cast<unsigned char>(bytes[at + k]) : 0u);
    }
    for (size_t k = 0; k < 4; ++k) out += k <= here ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&' || c == '<' || c == '>' || c == '"') {
      out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

const char *type_name(double) {
  return "Float64";
}
const char *type_name(int64_t) {
  return "Int64";
}
const char *type_name(int32_t) {
  return "Int32";
}
const char *type_name(uint8_t) {
  return "UInt8";
}

class VtpWriter {
 public:
  VtpWriter(const Model &model, const State &state) : model_(model), state_(state) {}
  std::string write(const std::vector<VtpArray> &arrays);

 private:
  void field_data();
  void point_data(const std::vector<VtpArray> &arrays);
  void cell_data(const std::vector<VtpArray> &arrays);
  void points();
  void lines();
  void polygons();
  void given_array(const VtpArray &array, size_t rows);

  template <typename Number>
  void array(std::string_view name, size_t components, const std::vector<Number> &values,
             bool in_field = false);
  void strings(std::string_view name, const std::vector<std::string> &values);
  // One value a chord, then one a triangle: the order of cells in the file.
  template <typename Number, typename OfChord, typename OfTriangle>
  void cells(std::string_view name, OfChord of_chord, OfTriangle of_triangle);

  const Model &model_;
  const State &state_;
  std::string out_;
};

std::string VtpWriter::write(const std::vector<VtpArray> &arrays) {
  const Valve &valve = model_.valve;
  out_ += "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"";
  out_ += std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
  out_ += "\" header_type=\"UInt64\">\n<PolyData>\n";
  field_data();
  out_ += "<Piece NumberOfPoints=\"" + std::to_string(valve.rest.size()) +
          "\" NumberOfVerts=\"0\" NumberOfLines=\"" + std::to_string(valve.chords.size()) +
          "\" NumberOfStrips=\"0\" NumberOfPolys=\"" + std::to_string(valve.triangles.size()) +
          "\">\n";
  point_data(arrays);
  cell_data(arrays);
  points();
  lines();
  polygons();
  out_ += "</Piece>\n</PolyData>\n</VTKFile>\n";
  return std::move(out_);
}

// SPACE is what 3D Slicer looks for, TimeValue what ParaView does.
void VtpWriter::field_data() {
  const Valve &valve = model_.valve;
  std::vector<std::string> leaflets, scallops, chords;
  for (const Leaflet &leaflet : valve.leaflets) leaflets.push_back(leaflet.name);
  for (const Scallop &scallop : valve.scallops) scallops.push_back(scallop.name);
  for (const Chord &chord : valve.chords) chords.push_back(chord.name);
  out_ += "<FieldData>\n";
  strings("SPACE", {"LPS"});
  strings("UNITS", {"mm"});
  strings("name", {valve.name});
  strings("leaflet_names", leaflets);
  strings("scallop_names", scallops);
  strings("chord_names", chords);
  array<double>("TimeValue", 1, {state_.time}, true);
  array<double>("pressure_Pa", 1, {state_.load.pressure}, true);
  array<double>("boundary_fraction", 1, {state_.load.boundary_fraction}, true);
  out_ += "</FieldData>\n";
}

void VtpWriter::point_data(const std::vector<VtpArray> &arrays) {
  std::vector<double> rest;
  for (const Vec3 &place : model_.valve.rest) {
    rest.insert(rest.end(), {place[0] * mm, place[1] * mm, place[2] * mm});
  }
  out_ += "<PointData>\n";
  array("node_kind", 1, model_.topology.node_kind.get());
  array("rest_mm", 3, rest);
  for (const VtpArray &given : arrays) {
    if (given.on_points) given_array(given, model_.node_count());
  }
  out_ += "</PointData>\n";
}

void VtpWriter::cell_data(const std::vector<VtpArray> &arrays) {
  const Valve &valve = model_.valve;
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  out_ += "<CellData>\n";
  cells<int64_t>(
      "id", [&](size_t c) { return static_cast<int64_t>(valve.chords[c].id); },
      [&](size_t t) { return static_cast<int64_t>(valve.leaflets[valve.triangle_leaflet[t]].id); });
  cells<int32_t>(
      "leaflet", [](size_t) { return -1; },
      [&](size_t t) { return static_cast<int32_t>(valve.triangle_leaflet[t]); });
  cells<int32_t>(
      "scallop", [](size_t) { return -1; },
      [&](size_t t) { return static_cast<int32_t>(valve.triangle_scallop[t]); });
  cells<int32_t>(
      "chord_kind", [&](size_t c) { return static_cast<int32_t>(valve.chords[c].kind); },
      [](size_t) { return -1; });
  cells<double>(
      "rest_length_mm", [&](size_t c) { return valve.chords[c].rest_length * mm; },
      [](size_t) { return nothing; });
  cells<double>(
      "thickness_mm", [](size_t) { return nothing; },
      [&](size_t t) { return valve.triangle_thickness[t] * mm; });
  for (const VtpArray &given : arrays) {
    if (!given.on_points) given_array(given, valve.triangles.size() + valve.chords.size());
  }
  out_ += "</CellData>\n";
}

void VtpWriter::points() {
  std::vector<double> places;
  for (const Vec3 &place : state_.x) {
    places.insert(places.end(), {place[0] * mm, place[1] * mm, place[2] * mm});
  }
  out_ += "<Points>\n";
  array("Points", 3, places);
  out_ += "</Points>\n";
}

void VtpWriter::lines() {
  std::vector<int64_t> nodes, ends;
  for (const Chord &chord : model_.valve.chords) {
    nodes.insert(nodes.end(), {chord.a, chord.b});
    ends.push_back(static_cast<int64_t>(nodes.size()));
  }
  out_ += "<Lines>\n";
  array("connectivity", 1, nodes);
  array("offsets", 1, ends);
  out_ += "</Lines>\n";
}

void VtpWriter::polygons() {
  std::vector<int64_t> nodes, ends;
  for (const Tri &triangle : model_.valve.triangles) {
    nodes.insert(nodes.end(), triangle.begin(), triangle.end());
    ends.push_back(static_cast<int64_t>(nodes.size()));
  }
  out_ += "<Polys>\n";
  array("connectivity", 1, nodes);
  array("offsets", 1, ends);
  out_ += "</Polys>\n";
}

void VtpWriter::given_array(const VtpArray &given, size_t rows) {
  const size_t components = static_cast<size_t>(given.components);
  MVS_MUST(given.components > 0 && given.values.size() == rows * components, MVS_E_INTERNAL,
           given.name, "array %s has %zu values for %zu rows of %d", given.name.c_str(),
           given.values.size(), rows, given.components);
  if (given.on_points) return array(given.name, components, given.values);
  // the caller has triangles first, VTK has lines first
  const auto middle =
      given.values.begin() + static_cast<ptrdiff_t>(model_.valve.triangles.size() * components);
  std::vector<double> values(middle, given.values.end());
  values.insert(values.end(), given.values.begin(), middle);
  array(given.name, components, values);
}

template <typename Number>
void VtpWriter::array(std::string_view name, size_t components, const std::vector<Number> &values,
                      bool in_field) {
  const uint64_t size = values.size() * sizeof(Number);
  std::string bytes(sizeof size + size, '\0');
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size > 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
  out_.append("<DataArray type=\"").append(type_name(Number{})).append("\" Name=\"");
  out_ += escaped(name) + "\" NumberOfComponents=\"" + std::to_string(components) + "\"";
  if (in_field) out_ += " NumberOfTuples=\"" + std::to_string(values.size() / components) + "\"";
  out_ += " format=\"binary\">";
  append_base64(out_, bytes);
  out_ += "</DataArray>\n";
}

// Strings are the codes of their bytes, each with a zero at its end.
void VtpWriter::strings(std::string_view name, const std::vector<std::string> &values) {
  out_.append("<Array type=\"String\" Name=\"").append(name).append("\" NumberOfTuples=\"");
  out_ += std::to_string(values.size()) + "\" format=\"ascii\">";
  for (const std::string &value : values) {
    for (const char c : value) out_ += std::to_string(static_cast<unsigned char>(c)) + " ";
    out_ += "0 ";
  }
  out_ += "</Array>\n";
}

template <typename Number, typename OfChord, typename OfTriangle>
void VtpWriter::cells(std::string_view name, OfChord of_chord, OfTriangle of_triangle) {
  std::vector<Number> values;
  for (size_t c = 0; c < model_.valve.chords.size(); ++c) values.push_back(of_chord(c));
  for (size_t t = 0; t < model_.valve.triangles.size(); ++t) values.push_back(of_triangle(t));
  array(name, 1, values);
}

}  // namespace

std::string write_vtp(const Model &model, const State &state, const std::vector<VtpArray> &arrays) {
  MVS_MUST(state.x.size() == model.node_count(), MVS_E_INTERNAL, "state",
           "the state has %zu positions for %zu nodes", state.x.size(), model.node_count());
  return VtpWriter(model, state).write(arrays);
}

}  // namespace mvs
