// Sheets of parametric valves, without their chordae.
#pragma once

#include <doctest/doctest.h>

#include "anatomy/parametric.h"
#include "model/model.h"
#include "patient/leaflet_sheet.h"

namespace mvs::core::test {

struct ParametricSheet {
  ModelPtr model;
  LeafletSheet sheet;
  SheetRims rims;
};

// The annulus as the rims of a build have it: counter-clockwise seen from the atrium.
inline ParametricSheet parametric_sheet(uint32_t vertices) {
  mvs_parametric_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.vertices = vertices;
  ParametricSheet made;
  made.model = make_model(make_parametric_valve(desc));
  const Valve &valve = made.model->valve;
  size_t sheet_nodes = 0;
  for (const Tri &t : valve.triangles.get()) {
    for (const uint32_t n : t) sheet_nodes = std::max<size_t>(sheet_nodes, n + 1);
  }
  const std::vector<Vec3> &rest = valve.rest;
  made.sheet.x.assign(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(sheet_nodes));
  made.sheet.triangles = valve.triangles;
  made.sheet.label.assign(made.sheet.triangles.size(), LeafletLabel::unknown);
  made.rims.annulus = valve.annulus;
  double turn = 0;  // the shape is centred: twice the area in the plane of the annulus
  for (size_t k = 0; k < made.rims.annulus.size(); ++k) {
    const Vec3 &a = made.sheet.x[made.rims.annulus[k]];
    const Vec3 &b = made.sheet.x[made.rims.annulus[(k + 1) % made.rims.annulus.size()]];
    turn += a.x() * b.y() - a.y() * b.x();
  }
  if (turn < 0) std::reverse(made.rims.annulus.begin(), made.rims.annulus.end());
  REQUIRE(made.model->topology.free_edges.size() == 1);
  made.rims.free_edge = made.model->topology.free_edges[0];
  return made;
}

}  // namespace mvs::core::test
