// Assembly of a valve from the parts of an Abaqus input file.
#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>

#include "formats/abaqus/valve.h"
#include "formats/text/line.h"
#include "model/checks/check.h"

namespace mvs::core {
namespace {

// Builds the valve. A row is an index of the valve, a node an index of the file.
class ValveBuilder {
 public:
  ValveBuilder(const InpMesh &mesh, const InpProperties &properties, const InpLoad &load,
               InpNotes &notes)
      : mesh_(mesh),
        properties_(properties),
        load_(load),
        notes_(notes),
        sheet_(make_inp_sheet(mesh, properties, load, notes)),
        chordae_(make_inp_chordae(mesh, properties, load, sheet_, notes)) {}

  Loaded build();

 private:
  void add_nodes();
  void add_leaflets();
  void add_triangles();
  void add_fibres();
  void add_chordae();
  void set_density();
  void set_contact();
  void orient_sheet();
  double pressure() const;
  void check() const;
  int32_t line_of(const std::string &part) const;

  const InpMesh &mesh_;
  const InpProperties &properties_;
  const InpLoad &load_;
  InpNotes &notes_;
  const InpSheet sheet_;
  const InpChordae chordae_;
  std::vector<uint32_t> row_, node_;  // row of each node; node of each row
  std::vector<uint8_t> turned_;       // 1: a triangle whose orientation was reversed
  Valve valve_;
};

// Nodes keep the order of the file, without the inner nodes of cables and nodes without elements.
void ValveBuilder::add_nodes() {
  std::vector<uint8_t> kept = sheet_.holds;
  for (const uint32_t head : chordae_.heads) kept[head] = 1;
  for (const InpCable &cable : chordae_.cables) kept[cable.a] = kept[cable.b] = 1;
  std::vector<uint8_t> known(kept.size(), 0);
  for (const InpElement &element : mesh_.elements) {
    for (const uint32_t node : element.nodes) known[node] = 1;
  }
  row_.assign(kept.size(), none);
  for (uint32_t n = 0; n < kept.size(); ++n) {
    if (!known[n]) notes_.left_out(mesh_.nodes[n].line, "a node of no element is left out");
    if (!kept[n]) continue;
    row_[n] = static_cast<uint32_t>(node_.size());
    node_.push_back(n);
    const Vec3 &x = mesh_.nodes[n].x;
    const auto moved = load_.moved.find(n);
    valve_.rest.push_back(x);
    valve_.loaded.push_back(moved == load_.moved.end() ? x : Vec3(x + moved->second));
  }
}

void ValveBuilder::add_leaflets() {
  std::set<std::string> taken;
  for (const InpSection &section : properties_.shells) {
    Leaflet leaflet;
    leaflet.name = inp_leaflet_name(section.name);
    if (!taken.insert(leaflet.name).second) leaflet.name = section.name;
    taken.insert(leaflet.name);
    leaflet.thickness = section.size;
    set_inp_law(leaflet, properties_.materials.at(section.material), notes_);
    valve_.leaflets.push_back(std::move(leaflet));
  }
}

void ValveBuilder::add_triangles() {
  for (size_t t = 0; t < sheet_.triangles.size(); ++t) {
    const Tri &nodes = sheet_.triangles[t];
    valve_.triangles.push_back({row_[nodes[0]], row_[nodes[1]], row_[nodes[2]]});
    valve_.triangle_leaflet.push_back(sheet_.section[t]);
  }
  for (const uint32_t node : sheet_.annulus) valve_.annulus.push_back(row_[node]);
  for (const uint32_t node : chordae_.heads) valve_.heads.push_back({0, "", row_[node]});
}

// Without any *ORIENTATION fibres are circumferential, the default of a valve. If only some
// sections have one, the others use the default of Abaqus: the first axis projected onto the shell.
void ValveBuilder::add_fibres() {
  const auto has = [](const InpSection &section) { return !section.orientation.empty(); };
  if (std::none_of(properties_.shells.begin(), properties_.shells.end(), has)) return;
  static const InpOrientation global;
  size_t across = 0;
  for (size_t t = 0; t < sheet_.triangles.size(); ++t) {
    const InpSection &section = properties_.shells[sheet_.section[t]];
    const InpOrientation &orientation =
        has(section) ? properties_.orientations.at(section.orientation) : global;
    const Tri &nodes = valve_.triangles[t];
    const Vec3 side = valve_.rest[nodes[1]] - valve_.rest[nodes[0]];
    const Vec3 normal = side.cross(valve_.rest[nodes[2]] - valve_.rest[nodes[0]]).normalized();
    const Vec3 fibre = orientation.fibre(sheet_.element[t]);
    const Vec3 flat = fibre - fibre.dot(normal) * normal;
    const bool lies = flat.norm() > 1e-3;  // false: nearly parallel to the normal
    across += !lies;
    valve_.triangle_fibre.push_back(lies ? flat.normalized() : side.normalized());
  }
  if (across > 0) {
    notes_.chosen("%zu triangles have fibres along their normal: their first side is taken",
                  across);
  }
}

ChordKind kind_of(const InpCable &cable, const InpSheet &sheet) {
  if (!sheet.holds[cable.b]) return ChordKind::trunk;
  return sheet.in_free_edge[cable.b] ? ChordKind::marginal : ChordKind::rough_zone;
}

void ValveBuilder::add_chordae() {
  for (const InpCable &cable : chordae_.cables) {
    const InpSection &section = properties_.trusses[cable.section];
    Chord chord;
    chord.a = row_[cable.a];
    chord.b = row_[cable.b];
    chord.kind = kind_of(cable, sheet_);
    chord.rest_length = cable.rest_length;
    chord.area = section.size;
    set_inp_law(chord, properties_.materials.at(section.material));
    valve_.chords.push_back(std::move(chord));
  }
}

// A valve has one density; the density of the first leaflet is used.
void ValveBuilder::set_density() {
  const auto density_of = [&](const InpSection &section) {
    return properties_.materials.at(section.material).density;
  };
  const double first = density_of(properties_.shells[0]);
  if (first == 0) {
    return notes_.chosen("no *DENSITY of the first leaflet: %g kg/m3 is taken", valve_.density);
  }
  valve_.density = first;
  for (const auto *sections : {&properties_.shells, &properties_.trusses}) {
    for (const InpSection &section : *sections) {
      const double other = density_of(section);
      if (other == 0 || other == first) continue;
      const InpMaterial &material = properties_.materials.at(section.material);
      notes_.left_out(material.line,
                      "the density of material " + quoted(material.name) +
                          " is left out: a valve has one, that of its first leaflet");
    }
  }
}

// Contact distance: Abaqus uses the shell thickness, limited to a share of the shortest edge or
// diagonal of each element. A valve has one distance; the median over the elements is used.
void ValveBuilder::set_contact() {
  std::vector<double> distances;
  size_t reduced = 0;
  for (const InpSection &section : properties_.shells) {
    for (const uint32_t e : section.elements) {
      const std::vector<uint32_t> &corners = mesh_.elements[e].nodes;
      double shortest = section.size / load_.max_ratio;
      for (size_t i = 0; i < corners.size(); ++i) {
        for (size_t j = 0; j < i; ++j) {
          if (corners[i] == corners[j]) continue;
          const double length = (mesh_.nodes[corners[i]].x - mesh_.nodes[corners[j]].x).norm();
          shortest = std::min(shortest, length);
        }
      }
      distances.push_back(load_.max_ratio * shortest);
      reduced += distances.back() < 0.999 * section.size;
    }
  }
  std::sort(distances.begin(), distances.end());
  valve_.contact_thickness = distances[distances.size() / 2];
  notes_.chosen(
      "contact at %.4g mm, the median of the shell thickness limited to %g of the shortest "
      "line of each element, which reduces %zu of %zu shells (%.4g to %.4g mm)",
      1e3 * valve_.contact_thickness, load_.max_ratio, reduced, distances.size(),
      1e3 * distances.front(), 1e3 * distances.back());
}

void ValveBuilder::orient_sheet() {
  const std::vector<Tri> before = valve_.triangles;
  orient(valve_);
  for (size_t t = 0; t < before.size(); ++t) turned_.push_back(before[t] != valve_.triangles[t]);
  const auto count = std::count(turned_.begin(), turned_.end(), 1);
  if (count == 0) return;
  notes_.counted("%td of %zu triangles turned so that their normals point into the atrium", count,
                 turned_.size());
}

// Pressure from the ventricle, positive along the normals, which point into the atrium.
double ValveBuilder::pressure() const {
  if (load_.pressure.empty()) return 0;
  double low = 1e300, high = -1e300;
  for (size_t t = 0; t < turned_.size(); ++t) {
    const auto found = load_.pressure.find(sheet_.element[t]);
    const double along = found == load_.pressure.end() ? 0 : found->second;
    low = std::min(low, turned_[t] ? -along : along);
    high = std::max(high, turned_[t] ? -along : along);
  }
  const double pressure = high >= -low ? high : low;
  if (low != high) {
    notes_.chosen(
        "the pressure is not the same everywhere (%g to %g Pa from the ventricle): %g Pa "
        "is taken",
        low, high, pressure);
  }
  constexpr double limit = 400e3;  // Pa, ten times a high ventricular pressure
  if (std::abs(pressure) > limit) {
    inp_fail(0,
             "the pressure is %g Pa: a heart has up to 40e3; say the units of the file as "
             "`** units: mm MPa`",
             pressure);
  }
  return pressure;
}

// Returns whether a part is of a kind ("node 17" of "node"), and its index.
bool is_part(std::string_view part, std::string_view kind, uint32_t &index) {
  if (!part.starts_with(kind) || part.size() < kind.size() + 2) return false;
  const char *const first = part.data() + kind.size() + 1;
  return std::from_chars(first, part.data() + part.size(), index).ec == std::errc();
}

// Returns the line of a part named by find_faults, or 0.
int32_t ValveBuilder::line_of(const std::string &part) const {
  uint32_t index = 0;
  if (is_part(part, "node", index) || is_part(part, "edge", index) ||
      is_part(part, "annulus", index)) {
    return index < node_.size() ? mesh_.nodes[node_[index]].line : 0;
  }
  if (is_part(part, "triangle", index)) {
    return index < sheet_.element.size() ? mesh_.elements[sheet_.element[index]].line : 0;
  }
  for (size_t l = 0; l < valve_.leaflets.size(); ++l) {
    if (part == "leaflet " + valve_.leaflets[l].name) return properties_.shells[l].line;
  }
  if (is_part(part, "chord", index)) {
    return index < chordae_.cables.size() ? mesh_.elements[chordae_.cables[index].element].line : 0;
  }
  return 0;
}

// Checks the assembled valve; its messages count nodes from 0.
void ValveBuilder::check() const {
  const std::vector<Fault> faults = find_faults(valve_);
  if (faults.empty()) return;
  inp_fail(line_of(faults[0].part), "as a valve (rows from 0): %s", faults[0].sentence.c_str());
}

Loaded ValveBuilder::build() {
  if (!mesh_.heading.empty()) valve_.name = mesh_.heading;
  add_nodes();
  add_leaflets();
  add_triangles();
  add_chordae();
  set_density();
  set_contact();
  orient_sheet();
  add_fibres();
  check();
  Loaded loaded;
  loaded.state.x = valve_.rest;
  loaded.state.v.assign(valve_.rest.size(), Vec3::Zero());
  loaded.state.load = {pressure(), 1};
  loaded.valve = std::move(valve_);
  return loaded;
}

}  // namespace

Loaded build_inp_valve(const InpMesh &mesh, const InpProperties &properties, const InpLoad &load,
                       InpNotes &notes) {
  return ValveBuilder(mesh, properties, load, notes).build();
}

}  // namespace mvs::core
