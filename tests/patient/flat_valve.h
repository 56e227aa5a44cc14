// A flat ring as a valve: its orifice is a regular polygon.
#pragma once

#include <cmath>

#include "patient/patient_geometry.h"
#include "tests/measure/shapes.h"

namespace mvs::core::test {

// A flat ring with a hole, m, sealed up to 0.6 mm, and the data that a build has of it.
struct Disc {
  explicit Disc(double hole, double outer = 16e-3) {
    mvs::core::test::Sheet sheet = disc(outer, hole, [](double, double) { return 0.0; });
    sheet.around = 96;
    model = model_of(sheet);
    g.sheet.x = model->valve.rest.get();
    g.sheet.triangles = model->valve.triangles.get();
    g.rims.annulus = model->valve.annulus.get();
    g.rims.free_edge = model->topology.free_edges[0];
    g.coordinates = sheet_coordinates(g.sheet, g.rims);
  }
  const std::vector<Vec3> &x() const { return model->valve.rest.get(); }

  ModelPtr model;
  PatientGeometry g;
};

inline double hole_area(double radius) {
  return 96 * 0.5 * radius * radius * std::sin(2 * pi / 96);
}

}  // namespace mvs::core::test
