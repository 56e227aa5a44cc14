// Geometry of a patient from a sheet, its valve with chordae, and the closed valve.
#pragma once

#include <algorithm>
#include <map>

#include "geometry/intersect.h"
#include "measure/measure.h"
#include "model/law.h"
#include "patient/chordae/patient_chordae.h"
#include "patient/fit/surface_match.h"
#include "solve/solver.h"
#include "solve/static/mesh_hierarchy.h"
#include "tests/patient/parametric_sheet.h"

namespace mvs::core::test {

inline constexpr double systole = 120 * 133.322;  // Pa

inline PatientGeometry geometry_of(const LeafletSheet &sheet, const SheetRims &rims) {
  PatientGeometry g{sheet, rims, sheet_coordinates(sheet, rims), {}};
  Findings findings;
  g.arcs = find_leaflets(g.sheet, g.rims, g.coordinates, {}, findings);
  return g;
}

// Made once for all tests.
inline const PatientGeometry &parametric_geometry(uint32_t vertices) {
  static std::map<uint32_t, PatientGeometry> made;
  auto at = made.find(vertices);
  if (at == made.end()) {
    const ParametricSheet p = parametric_sheet(vertices);
    at = made.emplace(vertices, geometry_of(p.sheet, p.rims)).first;
  }
  return at->second;
}

// Leaflets without chordae: two leaflets of one law, six scallops.
inline Valve leaflets_of(const PatientGeometry &g, LeafletLawId law) {
  Valve valve;
  valve.rest = g.sheet.x;
  valve.triangles = g.sheet.triangles;
  valve.annulus = g.rims.annulus;
  for (const char *name : {"A", "P"}) {
    Leaflet leaflet;
    leaflet.name = name;
    leaflet.law = law;
    leaflet.constants = default_constants(find_leaflet_law(law)->constants);
    leaflet.thickness = 0.8e-3;
    valve.leaflets.push_back(leaflet);
  }
  for (const char *name : {"A1", "A2", "A3", "P1", "P2", "P3"}) {
    valve.scallops.push_back({0, name, name[0] == 'A' ? 0u : 1u});
  }
  const SheetCoordinates &c = g.coordinates;
  for (const Tri &t : g.sheet.triangles) {
    const double shift = around(c.foot[t[0]], c.foot[t[1]], c.annulus_length) +
                         around(c.foot[t[0]], c.foot[t[2]], c.annulus_length);
    const uint32_t scallop = scallop_of(g.arcs, c.foot[t[0]] + shift / 3, c.annulus_length);
    valve.triangle_scallop.push_back(scallop);
    valve.triangle_leaflet.push_back(scallop < 3 ? 0 : 1);
  }
  return valve;
}

// A neo-Hookean valve with chordae of normal anatomy. It bends with its full modulus, which
// leaves fewer folds in which it may close.
inline Valve patient_valve(uint32_t vertices) {
  const PatientGeometry g = parametric_geometry(vertices);
  Findings findings;
  Valve valve = leaflets_of(g, LeafletLawId::neo_hookean);
  for (Leaflet &leaflet : valve.leaflets.edit()) leaflet.constants[1] = 0;
  add_chordae(valve, g, find_papillary_tips({}, g, findings), {}, findings);
  return valve;
}

// Distance of a shape of the valve from a surface, both ways.
inline double distance_from(const ClosedSurface &given, const Model &model,
                            const std::vector<Vec3> &x) {
  return rms_distance(SurfaceMatcher(given, model, x).match(model, x));
}

struct ClosedPatient {
  ModelPtr model;
  State state;
  SolveStats stats;
};

inline ClosedPatient close_patient(const Valve &valve, double residual = 0) {
  ClosedPatient closed{make_model(valve), {}, {}};
  closed.state = initial_state(*closed.model);
  closed.state.load = {systole, 1};
  Solver solver(Backend::fastest);
  SolveOptions options;
  options.residual = residual;
  closed.stats = settle_with_mesh_hierarchy(solver, *closed.model, closed.state, options, {});
  return closed;
}

}  // namespace mvs::core::test
