// The steps from a surface as people have it to one clean sheet.
#include "patient/mid_sheet.h"

#include <algorithm>

#include "base/error.h"
#include "geometry/intersect.h"
#include "patient/annulus/closed_curve.h"
#include "patient/checks/displaced_points.h"
#include "patient/checks/rim_length.h"
#include "patient/checks/rough_surface.h"
#include "patient/findings.h"
#include "patient/skin/mid_surface.h"
#include "patient/skin/skin_holes.h"
#include "patient/surface/boundary.h"
#include "patient/surface/clean_surface.h"
#include "patient/surface/mend_free_edge.h"
#include "patient/surface/rims.h"

namespace mvs::core {
namespace {

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

// m: errors of surfaces from images make points move so far.
constexpr double small_move = 1e-3;

// The notches of two rims, for keep_crossing(); the second rim was filled after the first.
FilledNotches both(FilledNotches first, const FilledNotches &second) {
  first.last.insert(first.last.end(), second.last.begin(), second.last.end());
  first.inner.insert(first.inner.end(), second.inner.begin(), second.inner.end());
  return first;
}

// The annulus that is given back is the one with its notches filled, unless it is one along which
// tissue was cut off.
void set_filled_annulus(const MidSheet &mid, Findings &findings) {
  if (!find_finding(findings, "annulus_notches") || find_finding(findings, "atrial_tissue")) return;
  if (Finding *annulus = find_finding(findings, "annulus")) {
    set_points(points_along(mid.rims.annulus, mid.sheet.x), *annulus);
  }
}

// Fills notches of both rims, moves an atrial surface to the middle of the tissue, separates
// triangles that cross. Notches whose filling stays crossed are kept open.
CrossingReport mend(const BuildSettings &settings, SurfaceKind kind, MidSheet &mid,
                    Findings &findings) {
  const MidSheet as_found = mid;
  std::vector<uint8_t> kept(mid.sheet.x.size(), 0);
  for (;;) {
    mid = as_found;
    Findings made;
    const FilledNotches of_annulus = fill_notches(mid.sheet, mid.rims.annulus, kept);
    const FilledNotches of_edge = fill_notches(mid.sheet, mid.rims.free_edge, kept);
    report_notches(of_annulus, NotchesOf::annulus, made);
    report_notches(of_edge, NotchesOf::free_edge, made);
    if (kind == SurfaceKind::atrial) move_to_mid(mid.sheet, settings.thickness, made);
    const CrossingReport crossings = mend_crossings(mid.sheet, mid.rims);
    if (crossings.after > 0) {
      const std::vector<Edge> left = find_intersections(mid.sheet.x, mid.sheet.triangles);
      if (keep_crossing(both(of_annulus, of_edge), left, kept)) continue;
    }
    findings.insert(findings.end(), made.begin(), made.end());
    return crossings;
  }
}

}  // namespace

Finding crossings_finding(const CrossingReport &report) {
  const double move = report.largest_move;
  Finding found{"crossings", FindingSource::measured, 0.9, "", {move}, "m"};
  found.confidence *= small_move / std::max(small_move, move);
  found.sentence = format("%zu pairs of triangles crossed and were separated by ", report.before);
  found.sentence += move > 0 ? format("moves of at most %.3g mm", 1e3 * move)
                             : std::string("edge flips; no point moved");
  if (move > small_move) found.sentence += ": smooth the surface where its leaflets touch";
  return found;
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
  doubt_rough_surface(mid.sheet, findings);  // untangling hides a part of the noise
  begin_stage(settings, "untangle");
  const CrossingReport crossings = mend(settings, kind, mid, findings);
  MVS_MUST(crossings.after == 0, MVS_E_OP, "crossings",
           "%zu of %zu pairs of crossing triangles could not be separated by small moves: smooth "
           "the surface where its leaflets touch",
           crossings.after, crossings.before);
  if (crossings.before > 0) findings.push_back(crossings_finding(crossings));
  set_filled_annulus(mid, findings);
  doubt_far_tissue(mid.sheet, mid.rims, findings);
  doubt_annulus_length(mid.sheet, mid.rims, findings);
  return mid;
}

}  // namespace mvs::core
