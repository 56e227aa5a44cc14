// A new mesh, its leaflets, their tissue and chordae.
#include "patient/patient_valve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "anatomy/leaflet_names.h"
#include "base/error.h"
#include "model/sides.h"
#include "patient/chordae/patient_chordae.h"
#include "patient/findings.h"
#include "patient/fit/thickness_range.h"
#include "patient/mesh/remesh_sheet.h"

namespace mvs::core {
namespace {

// Pa: five times the systolic pressure, under which leaflets then stay 0.77 of the contact
// thickness apart. With the default of the model, 20 kPa, they come as close as 0.58 of it, where
// contact is stiff and slack folds creep: closures take 100 to 360 iterations instead of 50 to 100.
constexpr double contact_stiffness = 80e3;
constexpr double degree = std::numbers::pi / 180;
// A mesh of sound labels or surfaces has 30 degrees and sides of 0.4 edges or more. Valves with
// triangles or sides below these did not come to rest, or fitted badly.
constexpr double flat_angle = 5 * degree, micro_side = 1.0 / 50;  // of the wanted edge
constexpr double faulty_confidence = 0.1;

}  // namespace

Finding mesh_finding(size_t vertices, double edge, const RemeshReport &report) {
  const bool is_flat = report.worst_angle < flat_angle;
  const bool is_faulty = is_flat || report.shortest < micro_side * edge;
  std::string sentence = format(
      "%zu vertices, sides of %.2f mm in the mean and %.2f to %.2f mm, worst angle %.0f "
      "degrees, at most %.2f mm from the given surface",
      vertices, 1e3 * report.mean_edge, 1e3 * report.shortest, 1e3 * report.longest,
      report.worst_angle / degree, 1e3 * report.largest_distance);
  if (is_faulty) {
    const Vec3 at = 1e3 * (is_flat ? report.worst_at : report.shortest_at);
    sentence += format(
        "; a %s near (%.1f, %.1f, %.1f) mm, with which the valve may not come to rest: smooth the "
        "labels or the surface there, or fill its notches, and build again",
        is_flat ? "triangle is flat" : "side is far too short", at.x(), at.y(), at.z());
  }
  return {"mesh",
          FindingSource::measured,
          is_faulty ? faulty_confidence : 1,
          std::move(sentence),
          {report.mean_edge, report.shortest, report.longest, report.largest_distance},
          "m"};
}

namespace {

MidSheet remeshed(const MidSheet &mid, double edge, Findings &findings) {
  RemeshGoal goal;
  goal.edge = edge;
  RemeshedSheet made = remesh_sheet(mid.sheet, mid.rims, goal);
  const RemeshReport &report = made.report;
  MVS_MUST(report.crossings == 0, MVS_E_INTERNAL, "mesh", "%zu pairs of the new mesh cross",
           report.crossings);
  findings.push_back(mesh_finding(made.sheet.x.size(), edge, report));
  return {std::move(made.sheet), std::move(made.rims)};
}

// Thickness of each triangle: the mean of its vertices if it is known.
void set_thickness(const LeafletSheet &sheet, const BuildSettings &settings, Valve &valve,
                   Findings &findings) {
  const bool found = find_finding(findings, "thickness") != nullptr;
  if (sheet.thickness.empty()) {
    if (!found) {
      const bool given = settings.thickness_is_given;
      findings.push_back({"thickness",
                          given ? FindingSource::given : FindingSource::assumed,
                          given ? 1 : 0.5,
                          format("%.2f mm everywhere%s", 1e3 * settings.thickness,
                                 given ? ", as given" : "; give it if it is known"),
                          {settings.thickness},
                          "m"});
    }
    return;
  }
  double least = sheet.thickness[0], most = least;
  for (const Tri &t : sheet.triangles) {
    const double thickness =
        (sheet.thickness[t[0]] + sheet.thickness[t[1]] + sheet.thickness[t[2]]) / 3;
    least = std::min(least, thickness);
    most = std::max(most, thickness);
    valve.triangle_thickness.push_back(thickness);
  }
  if (!found) {
    findings.push_back({"point_thickness",
                        FindingSource::given,
                        1,
                        format("%.2f to %.2f mm, as given", 1e3 * least, 1e3 * most),
                        {least, most},
                        "m"});
  }
}

Valve tissue_of(const PatientGeometry &g, const BuildSettings &settings, LeafletLawId law,
                Findings &findings) {
  Valve valve;
  name_leaflets(law, settings.thickness, valve);
  valve.rest = g.sheet.x;
  valve.triangles = g.sheet.triangles;
  valve.annulus = g.rims.annulus;
  for (const Tri &t : g.sheet.triangles) {
    const uint32_t scallop =
        scallop_of(g.arcs, triangle_foot(g.coordinates, t), g.coordinates.annulus_length);
    valve.triangle_scallop.push_back(scallop);
    valve.triangle_leaflet.push_back(valve.scallops[scallop].leaflet);
  }
  set_thickness(g.sheet, settings, valve, findings);
  valve.contact_thickness = contact_thickness(valve);
  report_thin_contact(valve, findings);
  valve.contact_stiffness = contact_stiffness;
  return valve;
}

// The leaflets found on the given surface, on its new mesh.
LeafletArcs arcs_on(const MidSheet &mesh, const SheetCoordinates &coordinates,
                    const Findings &findings) {
  Findings unused;  // they are those of the given surface
  return find_leaflets(mesh.sheet, mesh.rims, coordinates,
                       {points_in(*find_finding(findings, "commissures")),
                        points_in(*find_finding(findings, "anterior")),
                        {}},
                       unused);
}

}  // namespace

double edge_for(const LeafletSheet &sheet, double vertices) {
  // two triangles for each vertex
  return std::sqrt(surface_area(sheet.x, sheet.triangles) / (vertices * 0.5 * std::sqrt(3.0)));
}

PatientGeometry patient_geometry(const MidSheet &mid, double edge, Findings &findings) {
  MidSheet mesh = remeshed(mid, edge, findings);
  PatientGeometry g;
  g.coordinates = sheet_coordinates(mesh.sheet, mesh.rims);
  g.arcs = arcs_on(mesh, g.coordinates, findings);
  g.sheet = std::move(mesh.sheet);
  g.rims = std::move(mesh.rims);
  return g;
}

Valve patient_valve(const BuildSettings &settings, LeafletLawId law, const PatientGeometry &g,
                    const Boundary &boundary, Findings &findings) {
  Valve valve = tissue_of(g, settings, law, findings);
  if (boundary.moves()) {
    valve.loaded = valve.rest;
    for (const uint32_t i : g.rims.annulus) {
      if (boundary.annulus.moves()) valve.loaded.edit()[i] = boundary.annulus(g.sheet.x[i]);
    }
  }
  add_chordae(valve, g, boundary.tips,
              {settings.chords, settings.chord_factor, settings.coaptation_length}, findings);
  return valve;
}

}  // namespace mvs::core
