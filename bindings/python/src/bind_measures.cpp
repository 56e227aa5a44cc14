// The methods of mvs.Snapshot that measure: the valve, its regions and chordae, the cost of a
// repair, distances and sections.
#include <pybind11/stl.h>

#include <array>

#include "arrays.h"
#include "progress.h"
#include "snapshot.h"
#include "values.h"

namespace mvs_python {
namespace {

using namespace py::literals;

py::object measures(const Snapshot &snapshot) {
  auto found = sized<mvs_measures>();
  release_and([&] { return mvs_snapshot_measure(snapshot.get(), &found); });
  return measures_value(found);
}

py::object measures_of_groups(const Snapshot &snapshot, uint32_t groups) {
  auto found = sized<mvs_measures>();
  release_and([&] { return mvs_snapshot_measure_groups(snapshot.get(), groups, &found); });
  return measures_value(found);
}

py::object frame(const Snapshot &snapshot) {
  double rows[12];
  release_and([&] { return mvs_snapshot_get_frame(snapshot.get(), rows); });
  return frame_value(rows);
}

py::object compare(const Snapshot &snapshot, const Snapshot &other) {
  auto found = sized<mvs_comparison>();
  release_and([&] { return mvs_snapshot_compare(snapshot.get(), other.get(), &found); });
  return comparison_value(found);
}

py::array section(const Snapshot &snapshot, const std::array<double, 3> &point,
                  const std::array<double, 3> &normal) {
  uint64_t count = 0;
  std::vector<double> points;
  const auto cut = [&] {
    return mvs_snapshot_section(snapshot.get(), point.data(), normal.data(), points.data(),
                                points.size() / 3, &count);
  };
  release_and(cut);
  points.resize(3 * count);
  if (count > 0) release_and(cut);
  return py::array_t<double>({static_cast<py::ssize_t>(count / 2), py::ssize_t{2}, py::ssize_t{3}},
                             points.data());
}

// The rows of mvs.tables.chords.
py::list chords_of(const Snapshot &self) {
  uint32_t count = 0;
  must(mvs_snapshot_get_part_count(self.get(), MVS_PART_CHORD, &count));
  py::list rows;
  for (uint32_t c = 0; c < count; ++c) {
    auto chord = sized<mvs_chord_info>();
    release_and([&] { return mvs_snapshot_get_chord(self.get(), c, &chord); });
    rows.append(py::make_tuple(chord.name, chord.kind, chord.heads, chord.scallops, chord.flags,
                               chord.length, chord.rest_length, chord.strain, chord.tension));
  }
  return rows;
}

// The rows of mvs.tables.regions.
py::list regions_of(const Snapshot &self) {
  uint32_t count = 0;
  must(mvs_snapshot_get_region_count(self.get(), &count));
  py::list rows;
  for (uint32_t k = 0; k < count; ++k) {
    auto r = sized<mvs_region_measures>();
    release_and([&] { return mvs_snapshot_get_region(self.get(), k, &r); });
    rows.append(py::make_tuple(r.name, r.kind, r.coaptation_area, r.coaptation_length_mean,
                               r.coaptation_length_min, r.orifice_area, r.gap, r.billow_height,
                               r.billow_volume, r.tenting_height, r.tenting_volume));
  }
  return rows;
}

// The rows of mvs.tables.orifice_parts.
py::list orifice_parts_of(const Snapshot &self) {
  uint32_t count = 0;
  release_and([&] { return mvs_snapshot_get_orifice_part_count(self.get(), &count); });
  py::list rows;
  for (uint32_t k = 0; k < count; ++k) {
    auto p = sized<mvs_orifice_part>();
    must(mvs_snapshot_get_orifice_part(self.get(), k, &p));
    rows.append(py::make_tuple(p.anterior, p.posterior, p.commissures, p.triangles, p.area, p.gap,
                               p.centroid[0], p.centroid[1], p.centroid[2], p.direction[0],
                               p.direction[1], p.direction[2]));
  }
  return rows;
}

// Cost of the repair of the closed valve (mvs.Cost).
py::object cost(const Snapshot &self, std::optional<double> flow, const py::object &septum,
                std::optional<double> pressure, std::optional<double> density,
                std::optional<double> discharge, py::object progress) {
  ProgressCall call(std::move(progress));
  auto options = sized<mvs_cost_options>();
  options.progress = &ProgressCall::callback;
  options.user = &call;
  options.flow = given_or_default(flow, "flow");
  options.pressure = given_or_default(pressure, "pressure");
  options.density = given_or_default(density, "density");
  options.discharge = given_or_default(discharge, "discharge");
  std::vector<py::array> kept;
  if (!septum.is_none()) {
    options.septum =
        described(array_argument(septum, {"septum", 3, {MVS_TYPE_F64, MVS_TYPE_F32}}), kept);
  }
  auto figures = sized<mvs_cost>();
  const mvs_snapshot *opened = nullptr;
  call.run([&] { return mvs_snapshot_measure_cost(self.get(), &options, &figures, &opened); });
  return cost_value(figures, py::cast(Snapshot(opened)));
}

}  // namespace

void bind_measures(py::class_<Snapshot> &type) {
  type.def_property_readonly("measures", &measures,
                             "The measures of the valve (mvs.Measures, SI units). The first call "
                             "on a snapshot computes them; measure(groups) computes some.");
  type.def_property_readonly("frame", &frame, "The anatomical frame of the valve (mvs.Frame), m.");
  type.def("cost", &cost, py::kw_only(), "flow"_a = py::none(), "septum"_a = py::none(),
           "pressure_pa"_a = py::none(), "density"_a = py::none(), "discharge"_a = py::none(),
           "progress"_a = py::none(),
           "Cost of the repair of this closed valve (mvs.Cost), and the valve opened in "
           "diastole.\n\nflow: m3/s through the open valve; None: no gradient\n"
           "septum: (k, 3), m: points of the septum that faces the anterior leaflet in systole; "
           "None: no risk of SAM\npressure_pa: Pa, atrium minus ventricle; None: 5 mmHg\n"
           "density: kg/m3, of blood; None: 1060\ndischarge: discharge coefficient; None: 0.85\n"
           "progress: as for Simulator.settle, of the opening");
  type.def("_measure", &measures_of_groups);
  type.def("_chords", &chords_of);
  type.def("_regions", &regions_of);
  type.def("_orifice_parts", &orifice_parts_of);
  type.def("compare", &compare, "other"_a,
           "Distance between the leaflet surfaces of two snapshots (mvs.Comparison), m.");
  type.def("section", &section, "point"_a, "normal"_a,
           "A planar cut of the leaflets through `point` (m): segments (s, 2, 3), m.");
}

}  // namespace mvs_python
