// The steps of a build in their order.
#include "patient/build_valve.h"

#include <optional>

#include "base/error.h"
#include "model/sides.h"
#include "patient/checks/input_arrays.h"
#include "patient/findings.h"
#include "patient/fit/edge_range.h"
#include "patient/fit/fitted_law.h"
#include "patient/fit/shown_gaps.h"
#include "patient/fit/thickness_range.h"
#include "patient/fitted_valve.h"
#include "patient/patient_valve.h"
#include "patient/skin/closed_skin.h"
#include "patient/tall_leaflets.h"

namespace mvs::core {
namespace {

constexpr double default_vertices = 1000;

// Findings on the given surface; patient_geometry() finds the leaflets again on the new mesh.
void report_leaflets(const PatientSurface &surface, const MidSheet &mid, Findings &findings) {
  const SheetCoordinates coordinates = sheet_coordinates(mid.sheet, mid.rims);
  const LeafletArcs arcs =
      find_leaflets(mid.sheet, mid.rims, coordinates,
                    {surface.commissures, surface.anterior, surface.tips}, findings);
  doubt_tall_leaflets(mid.sheet, mid.rims, coordinates, arcs, surface.commissures, findings);
}

// Along the axis of the valve: the area vector of leaflets whose normals point into the atrium,
// which is that of the annulus without the open orifice.
Vec3 into_atrium(const LeafletSheet &sheet) {
  Vec3 sum = Vec3::Zero();
  for (const Tri &t : sheet.triangles) sum += area_normal(sheet.x, t);
  return sum.normalized();
}

// The heads follow the annulus as a whole, unless they are given under load.
Boundary boundary_of(const PatientSurface &surface, const PatientGeometry &g,
                     const ClosedSurface &closed, Findings &findings) {
  const std::vector<Vec3> annulus = points_along(g.rims.annulus, g.sheet.x);
  AnnulusMotion motion = find_annulus_motion(annulus, surface.closed_annulus, closed, findings);
  std::optional<Rigid> rigid;
  if (motion.moves()) rigid = rigid_part(motion, annulus);
  return {std::move(motion),
          find_papillary_tips(surface.tips, g, findings, surface.closed_tips, rigid)};
}

// Adds to the sentence on the chordae from normal anatomy.
void add_to_chordae(const char *words, Findings &findings) {
  for (Finding &finding : findings) {
    if (finding.name == "chordae") finding.sentence += words;
  }
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
  check_landmarks(surface);
  const MidSheet mid = find_mid_sheet(surface, settings, findings);
  begin_stage(settings, "leaflets");
  report_leaflets(surface, mid, findings);
  begin_stage(settings, "remesh");
  PatientGeometry g = patient_geometry(
      mid, settings.edge > 0 ? settings.edge : edge_for(mid.sheet, default_vertices), findings);
  const ClosedSurface closed = mid_of_closed({surface.closed_points, surface.closed_triangles},
                                             into_atrium(mid.sheet), findings);
  const Boundary boundary = boundary_of(surface, g, closed, findings);
  LeakUnknowns unknowns;
  unknowns.thickness_error = settings.thickness_error;
  Valve valve;
  std::vector<double> leaks;
  double done = 0.1;
  if (closed.points.empty()) {
    if (settings.law) findings.push_back(given_tissue(*settings.law));
    begin_stage(settings, "chordae");
    valve = patient_valve(settings, settings.law.value_or(fitted_laws[0]), g, boundary, findings);
    unknowns.edge = find_edge_range(settings.edge_error, settings.edge_lost, g, findings);
    tell_progress(progress, done);
  } else {
    FittedValve fitted =
        fitted_valve({mid, boundary, closed}, settings, g, findings,
                     [&](double share) { tell_progress(progress, 0.1 + 0.7 * share); });
    valve = std::move(fitted.valve);
    g = std::move(fitted.g);
    findings = std::move(fitted.findings);
    Findings unused = findings;  // the fit has reported the range
    unknowns.edge = find_edge_range(settings.edge_error, settings.edge_lost, g, unused);
    unknowns.lengths = range_after(fitted.fit);
    unknowns.shape = {&closed, &g,
                      settings.closed_error > 0 ? settings.closed_error : usual_closed_error};
    leaks = fitted.leaks;
    done = 0.8;
  }
  add_to_chordae(closed.points.empty() ? "; give the closed leaflets to fit the lengths to them"
                                       : "; the fit to the closed leaflets has changed the lengths",
                 findings);
  valve.name = surface.name;
  built.model = make_model(std::move(valve));
  if (!settings.finds_leak) return built;
  begin_stage(settings, "leak");
  report_thickness_error(settings.thickness_error, findings);
  report_closed_error(settings.closed_error, findings);
  built.leak = leak_interval(
      built.model, unknowns, leaks, findings,
      [&](double share) { tell_progress(progress, done + (1 - done) * share); }, settings.workers);
  return built;
}

}  // namespace mvs::core
