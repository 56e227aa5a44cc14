// Points, cells and arrays of a valve as VTK PolyData.
#include "formats/vtk/polydata.h"

#include <algorithm>
#include <utility>

#include "base/error.h"

namespace mvs::core {
namespace {

constexpr double vtk_mm = 1e3;  // per m

std::vector<double> in_mm(const std::vector<Vec3> &places) {
  std::vector<double> numbers;
  numbers.reserve(3 * places.size());
  for (const Vec3 &place : places) {
    numbers.insert(numbers.end(), {place[0] * vtk_mm, place[1] * vtk_mm, place[2] * vtk_mm});
  }
  return numbers;
}

template <typename Part>
std::vector<std::string> names_of(const std::vector<Part> &parts) {
  std::vector<std::string> names;
  names.reserve(parts.size());
  for (const Part &part : parts) names.push_back(part.name);
  return names;
}

void add(std::vector<VtkArray> &to, const std::string &name, uint32_t components, H5Values values) {
  to.push_back({name, components, std::move(values)});
}

void add_text(std::vector<VtkArray> &to, const std::string &name, const std::string &text) {
  add(to, name, 1, std::vector<std::string>(1, text));
}

void add_number(std::vector<VtkArray> &to, const std::string &name, double number) {
  add(to, name, 1, std::vector<double>(1, number));
}

// 3D Slicer reads SPACE, ParaView reads TimeValue. (No braced lists here: GCC 12 destroys elements
// it has not constructed if an allocation fails in one.)
void add_field_data(std::vector<VtkArray> &to, const Valve &valve, const State &state) {
  add_text(to, "SPACE", "LPS");
  add_text(to, "UNITS", "mm");
  add_text(to, "name", valve.name);
  add(to, "leaflet_names", 1, names_of<Leaflet>(valve.leaflets));
  add(to, "scallop_names", 1, names_of<Scallop>(valve.scallops));
  add(to, "chord_names", 1, names_of<Chord>(valve.chords));
  add_number(to, "TimeValue", state.time);
  add_number(to, "pressure_Pa", state.load.pressure);
  add_number(to, "boundary_fraction", state.load.boundary_fraction);
  add_number(to, "at_rest", state.is_at_rest());
}

// Adds one value per chord, then one per triangle.
template <typename Number, typename OfChord, typename OfTriangle>
void add_cells(std::vector<VtkArray> &to, const Valve &valve, const char *name, OfChord of_chord,
               OfTriangle of_triangle) {
  std::vector<Number> values;
  values.reserve(valve.chords.size() + valve.triangles.size());
  for (const Chord &chord : valve.chords) values.push_back(static_cast<Number>(of_chord(chord)));
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    values.push_back(static_cast<Number>(of_triangle(t)));
  }
  add(to, name, 1, std::move(values));
}

void add_cell_data(std::vector<VtkArray> &to, const Valve &valve) {
  constexpr double nothing = 0;  // colour bars of viewers break on NaN
  const auto no_chord = [](const Chord &) { return -1; };
  const auto no_triangle = [](size_t) { return -1; };
  add_cells<int64_t>(
      to, valve, "id", [](const Chord &c) { return c.id; },
      [&](size_t t) { return valve.leaflets[valve.triangle_leaflet[t]].id; });
  add_cells<int32_t>(to, valve, "leaflet", no_chord,
                     [&](size_t t) { return valve.triangle_leaflet[t]; });
  add_cells<int32_t>(to, valve, "scallop", no_chord,
                     [&](size_t t) { return valve.triangle_scallop[t]; });
  add_cells<int32_t>(
      to, valve, "chord_kind", [](const Chord &c) { return c.kind; }, no_triangle);
  add_cells<double>(
      to, valve, "rest_length_mm", [](const Chord &c) { return c.rest_length * vtk_mm; },
      [](size_t) { return nothing; });
  add_cells<double>(
      to, valve, "thickness_mm", [](const Chord &) { return nothing; },
      [&](size_t t) { return valve.triangle_thickness[t] * vtk_mm; });
}

// The caller orders triangles first, VTK lines first: rotates the rows.
void add_given(VtkPolyData &current, const VtpArray &given) {
  const size_t components = static_cast<size_t>(given.components);
  const size_t rows =
      given.on_points ? current.points.size() / 3 : current.triangles.count + current.lines.count;
  MVS_MUST(given.components > 0 && given.values.size() == rows * components, MVS_E_INTERNAL,
           given.name, "array %s has %zu values for %zu rows of %d", given.name.c_str(),
           given.values.size(), rows, given.components);
  VtkArray array{given.name, static_cast<uint32_t>(components), given.values};
  if (given.on_points) return current.point_data.push_back(std::move(array));
  auto &values = std::get<std::vector<double>>(array.values);
  const auto middle = static_cast<ptrdiff_t>(current.triangles.count * components);
  std::rotate(values.begin(), values.begin() + middle, values.end());
  current.cell_data.push_back(std::move(array));
}

template <typename Cell>
VtkCells cells_of(const std::vector<Cell> &cells) {
  VtkCells made{cells.size(), std::tuple_size_v<Cell>, {}};
  for (const Cell &cell : cells) made.nodes.insert(made.nodes.end(), cell.begin(), cell.end());
  return made;
}

}  // namespace

VtkPolyData make_vtk_polydata(const Model &model, const State &state,
                              const std::vector<VtpArray> &arrays) {
  const Valve &valve = model.valve;
  MVS_MUST(state.x.size() == model.node_count(), MVS_E_INTERNAL, "state",
           "the state has %zu positions for %zu nodes", state.x.size(), model.node_count());
  VtkPolyData current;
  current.points = in_mm(state.x);
  current.lines = {valve.chords.size(), 2, {}};
  for (const Chord &chord : valve.chords) {
    current.lines.nodes.insert(current.lines.nodes.end(), {chord.a, chord.b});
  }
  current.triangles = cells_of<Tri>(valve.triangles);
  add_field_data(current.field_data, valve, state);
  const auto *const kind = reinterpret_cast<const uint8_t *>(model.topology.node_kind.data());
  add(current.point_data, "node_kind", 1, std::vector<uint8_t>(kind, kind + model.node_count()));
  add(current.point_data, "rest_mm", 3, in_mm(valve.rest));
  add_cell_data(current.cell_data, valve);
  for (const VtpArray &given : arrays) add_given(current, given);
  return current;
}

VtkPolyData make_vtk_polydata(const VtkBlock &block) {
  VtkPolyData current;
  current.points = in_mm(block.points);
  current.lines = cells_of(block.lines);
  current.triangles = cells_of(block.triangles);
  add_text(current.field_data, "SPACE", "LPS");
  add_text(current.field_data, "UNITS", "mm");
  for (const auto &[name, value] : block.numbers) add_number(current.field_data, name, value);
  for (const VtpArray &given : block.arrays) add_given(current, given);
  return current;
}

}  // namespace mvs::core
