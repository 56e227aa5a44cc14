// The steps of a build in their order, and the tissue of the valve that comes out.
#include "patient/build_valve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "anatomy/leaflet_names.h"
#include "base/error.h"
#include "geometry/intersect.h"
#include "model/sides.h"
#include "patient/chordae/patient_chordae.h"
#include "patient/findings.h"
#include "patient/fit/edge_range.h"
#include "patient/fit/extend_free_edge.h"
#include "patient/fit/fit_over_levels.h"
#include "patient/fit/thickness_range.h"
#include "patient/mesh/remesh_sheet.h"
#include "patient/skin/mid_surface.h"
#include "patient/skin/skin_holes.h"
#include "patient/surface/boundary.h"
#include "patient/surface/clean_surface.h"
#include "patient/surface/mend_crossings.h"
#include "patient/surface/mend_free_edge.h"
#include "patient/surface/rims.h"
#include "patient/tall_leaflets.h"

namespace mvs::core {
namespace {

constexpr double default_vertices = 1000;
// Pa: five times the systolic pressure, under which leaflets then stay 0.77 of the contact
// thickness apart. With the default of the model, 20 kPa, they come as close as 0.58 of it, where
// contact is stiff and slack folds creep: closures take 100 to 360 iterations instead of 50 to 100.
constexpr double contact_stiffness = 80e3;
constexpr double degree = std::numbers::pi / 180;

void begin_stage(const BuildSettings &settings, const char *name) {
  if (settings.on_stage) settings.on_stage(name);
}

// The mid-surface of the leaflets, wound with normals into the atrium, and its rims.
struct MidSheet {
  LeafletSheet sheet;
  SheetRims rims;
};

SurfaceKind kind_of(const PatientSurface &surface, const LeafletSheet &sheet, Findings &findings) {
  const bool closed = boundary_loops(sheet).empty();
  if (surface.kind == SurfaceKind::automatic) {
    const SurfaceKind kind = closed ? SurfaceKind::skin : SurfaceKind::mid;
    findings.push_back({"kind",
                        FindingSource::guessed,
                        closed ? 0.95 : 0.6,
                        closed ? "a closed surface: both sides of the leaflets (skin)"
                               : "an open surface, taken for the mid-surface; if it is the atrial "
                                 "side, say so: kind atrial",
                        {},
                        ""});
    return kind;
  }
  MVS_MUST(surface.kind != SurfaceKind::skin || closed, MVS_E_OP, "kind",
           "the surface is to be a skin and has a boundary: a skin is closed; close its holes, or "
           "give it as mid or atrial");
  MVS_MUST(surface.kind == SurfaceKind::skin || !closed, MVS_E_OP, "kind",
           "the surface is closed: give it as skin; one sheet with annulus and free edge as "
           "boundary is needed for mid and atrial");
  findings.push_back({"kind", FindingSource::given, 1, "as given", {}, ""});
  return surface.kind;
}

// Fills notches of the free edge, moves an atrial surface to the middle of the tissue, separates
// triangles that cross. Notches whose filling stays crossed are kept open.
CrossingReport mend(const BuildSettings &settings, SurfaceKind kind, MidSheet &mid,
                    Findings &findings) {
  const MidSheet as_found = mid;
  std::vector<uint8_t> kept(mid.sheet.x.size(), 0);
  for (;;) {
    mid = as_found;
    Findings made;
    const FilledNotches notches = fill_notches(mid.sheet, mid.rims, kept);
    report_notches(notches, made);
    if (kind == SurfaceKind::atrial) move_to_mid(mid.sheet, settings.thickness, made);
    const CrossingReport crossings = mend_crossings(mid.sheet, mid.rims);
    if (crossings.after > 0) {
      const std::vector<Edge> left = find_intersections(mid.sheet.x, mid.sheet.triangles);
      if (keep_crossing(notches, left, kept)) continue;
    }
    findings.insert(findings.end(), made.begin(), made.end());
    return crossings;
  }
}

MidSheet find_mid_sheet(const PatientSurface &surface, const BuildSettings &settings,
                        Findings &findings) {
  MidSheet mid;
  begin_stage(settings, "clean");
  mid.sheet =
      clean_surface(surface.points, surface.triangles, surface.label, surface.thickness, findings);
  fill_skin_holes(mid.sheet, findings);
  const RimLandmarks landmarks = {surface.annulus, surface.tips};
  const SurfaceKind kind = kind_of(surface, mid.sheet, findings);
  begin_stage(settings, "mid");
  if (kind == SurfaceKind::skin) mid.sheet = mid_of_skin(mid.sheet, landmarks, findings);
  mid.rims = find_rims(mid.sheet, landmarks, findings);
  begin_stage(settings, "untangle");
  const CrossingReport crossings = mend(settings, kind, mid, findings);
  MVS_MUST(crossings.after == 0, MVS_E_OP, "crossings",
           "%zu of %zu pairs of crossing triangles could not be separated by small moves: smooth "
           "the surface where its leaflets touch",
           crossings.after, crossings.before);
  if (crossings.before > 0) {
    findings.push_back({"crossings",
                        FindingSource::measured,
                        0.9,
                        crossings.largest_move > 0
                            ? format("%zu pairs of triangles crossed and were separated by moves "
                                     "of at most %.3g mm",
                                     crossings.before, 1e3 * crossings.largest_move)
                            : format("%zu pairs of triangles crossed and were separated by edge "
                                     "flips; no point moved",
                                     crossings.before),
                        {crossings.largest_move},
                        "m"});
  }
  return mid;
}

// Equilateral triangles, two for each vertex.
double default_edge(const LeafletSheet &sheet) {
  return std::sqrt(surface_area(sheet.x, sheet.triangles) /
                   (default_vertices * 0.5 * std::sqrt(3.0)));
}

MidSheet remeshed(const MidSheet &mid, const BuildSettings &settings, Findings &findings) {
  RemeshGoal goal;
  goal.edge = settings.edge > 0 ? settings.edge : default_edge(mid.sheet);
  RemeshedSheet made = remesh_sheet(mid.sheet, mid.rims, goal);
  const RemeshReport &report = made.report;
  MVS_MUST(report.crossings == 0, MVS_E_INTERNAL, "mesh", "%zu pairs of the new mesh cross",
           report.crossings);
  findings.push_back(
      {"mesh",
       FindingSource::measured,
       1,
       format("%zu vertices, sides of %.2f mm in the mean and %.2f to %.2f mm, worst angle %.0f "
              "degrees, at most %.2f mm from the given surface",
              made.sheet.x.size(), 1e3 * report.mean_edge, 1e3 * report.shortest,
              1e3 * report.longest, report.worst_angle / degree, 1e3 * report.largest_distance),
       {report.mean_edge, report.shortest, report.longest, report.largest_distance},
       "m"});
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

Valve tissue_of(const PatientGeometry &g, const BuildSettings &settings, Findings &findings) {
  Valve valve;
  name_leaflets(settings.law, settings.thickness, valve);
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

PatientGeometry find_geometry(const PatientSurface &surface, const BuildSettings &settings,
                              Findings &findings) {
  const MidSheet mid = find_mid_sheet(surface, settings, findings);
  begin_stage(settings, "leaflets");
  const SheetCoordinates coordinates = sheet_coordinates(mid.sheet, mid.rims);
  const LeafletArcs arcs =
      find_leaflets(mid.sheet, mid.rims, coordinates,
                    {surface.commissures, surface.anterior, surface.tips}, findings);
  doubt_tall_leaflets(mid.rims, coordinates, arcs, findings);
  begin_stage(settings, "remesh");
  MidSheet mesh = remeshed(mid, settings, findings);
  PatientGeometry g;
  g.coordinates = sheet_coordinates(mesh.sheet, mesh.rims);
  g.arcs = arcs_on(mesh, g.coordinates, findings);
  g.sheet = std::move(mesh.sheet);
  g.rims = std::move(mesh.rims);
  return g;
}

// If the free edge is not exact, `g` and the valve get the tissue that the closed surface shows.
ChordFit fit_chords(const ClosedSurface &closed, bool edge_is_exact, const Progress &progress,
                    PatientGeometry &g, Valve &valve, Findings &findings) {
  const FitSettings settings;
  const auto tell = [&](uint32_t search) {
    tell_progress(progress, 0.1 + 0.7 * search / (settings.starts + 1));
  };
  if (!edge_is_exact) extend_free_edge(valve, g, closed, findings, tell);
  return fit_over_levels(valve, closed, settings, findings,
                         [&](uint32_t start) { tell(start + 1); });
}

}  // namespace

void tell_progress(const Progress &progress, double share) {
  MVS_MUST(!progress || progress(share, 0), MVS_E_CANCELLED, "progress",
           "cancelled by the progress callback: the valve is as before");
}

BuiltValve build_valve(const PatientSurface &surface, const BuildSettings &settings,
                       const Progress &progress) {
  BuiltValve built;
  Findings &findings = built.findings;
  tell_progress(progress, 0.0);
  PatientGeometry g = find_geometry(surface, settings, findings);
  begin_stage(settings, "chordae");
  Valve valve = tissue_of(g, settings, findings);
  valve.name = surface.name;
  const PapillaryTips tips = find_papillary_tips(surface.tips, g, findings);
  add_chordae(valve, g, tips, {settings.chords, settings.chord_factor, settings.coaptation_length},
              findings);
  tell_progress(progress, 0.1);
  const EdgeRange edge = find_edge_range(settings.edge_error, settings.edge_lost, g, findings);
  LeakUnknowns unknowns{{}, edge, settings.thickness_error, {}};
  const ClosedSurface closed{surface.closed_points, surface.closed_triangles};
  std::vector<double> leaks;
  double done = 0.1;
  if (!closed.points.empty()) {
    begin_stage(settings, "fit");
    const ChordFit fit = fit_chords(closed, edge.geometry == nullptr, progress, g, valve, findings);
    unknowns.lengths = range_after(fit);
    unknowns.shape = {&closed, &g};
    leaks = fit.leaks;
    done = 0.8;
  }
  built.model = make_model(std::move(valve));
  if (!settings.finds_leak) return built;
  begin_stage(settings, "leak");
  report_thickness_error(settings.thickness_error, findings);
  built.leak = leak_interval(built.model, unknowns, leaks, findings, [&](double share) {
    tell_progress(progress, done + (1 - done) * share);
  });
  return built;
}

}  // namespace mvs::core
