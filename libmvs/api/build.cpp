// Valves from surfaces: reads the surface and the options, builds, keeps the findings.
#include <mvs/build.h>

#include "api/sim_call.h"
#include "base/array_view.h"
#include "base/utf8.h"
#include "model/law.h"
#include "patient/build_valve.h"
#include "patient/doubtful.h"
#include "patient/fit/thickness_range.h"
#include "session/commit.h"

using namespace mvs::core;

struct mvs_findings {
  Findings list;
};

namespace {

std::vector<LeafletLabel> read_labels(const mvs_array &array) {
  std::vector<LeafletLabel> labels;
  for (const uint32_t given : read_indices(array, "surface.triangle_leaflet")) {
    MVS_MUST(given <= MVS_LEAFLET_LABEL_POSTERIOR, MVS_E_ARGUMENT, "surface.triangle_leaflet",
             "triangle %zu of surface.triangle_leaflet is %u: it has to be one of "
             "MVS_LEAFLET_LABEL_*",
             labels.size(), given);
    labels.push_back(static_cast<LeafletLabel>(given));
  }
  return labels;
}

// The triangles of a surface; without a list, each three points in turn are one.
std::vector<Tri> triangles_of(const mvs_array &array, size_t points, const char *what) {
  if (is_given(array)) return read_triangles(array, what);
  MVS_MUST(points % 3 == 0, MVS_E_ARGUMENT, what,
           "%s is not given and there are %zu points: without triangles, each three points in turn "
           "are one, so their number has to be a multiple of 3",
           what, points);
  std::vector<Tri> triangles(points / 3);
  for (uint32_t t = 0; t < triangles.size(); ++t) triangles[t] = {3 * t, 3 * t + 1, 3 * t + 2};
  return triangles;
}

void must_be_one_each(size_t given, size_t wanted, const char *what, const char *of) {
  MVS_MUST(given == 0 || given == wanted, MVS_E_ARGUMENT, what,
           "%s has %zu rows, the surface has %zu %s", what, given, wanted, of);
}

PatientSurface read_surface(const mvs_surface_desc *given) {
  const mvs_surface_desc desc = read_struct(given, "surface");
  MVS_MUST(desc.kind <= MVS_SURFACE_KIND_SKIN, MVS_E_ARGUMENT, "surface.kind",
           "surface.kind is %u: it has to be one of MVS_SURFACE_KIND_*, or 0", desc.kind);
  PatientSurface surface;
  surface.kind = static_cast<SurfaceKind>(desc.kind);
  if (desc.name) surface.name = desc.name;
  MVS_MUST(is_utf8(surface.name), MVS_E_ARGUMENT, "surface.name",
           "surface.name, the name of the valve, is not UTF-8: names are UTF-8, convert it");
  surface.points = read_points(desc.points, "surface.points");
  MVS_MUST(!surface.points.empty(), MVS_E_ARGUMENT, "surface.points",
           "surface.points is empty: give the points of the leaflets, in m");
  surface.triangles = triangles_of(desc.triangles, surface.points.size(), "surface.triangles");
  surface.label = read_labels(desc.triangle_leaflet);
  must_be_one_each(surface.label.size(), surface.triangles.size(), "surface.triangle_leaflet",
                   "triangles");
  surface.thickness = read_numbers(desc.point_thickness, "surface.point_thickness");
  must_be_one_each(surface.thickness.size(), surface.points.size(), "surface.point_thickness",
                   "points");
  surface.annulus = read_points(desc.annulus, "surface.annulus");
  surface.commissures = read_points(desc.commissures, "surface.commissures");
  surface.anterior = read_points(desc.anterior, "surface.anterior");
  surface.tips = read_points(desc.papillary_tips, "surface.papillary_tips");
  surface.closed_points = read_points(desc.closed_points, "surface.closed_points");
  if (!surface.closed_points.empty() || is_given(desc.closed_triangles)) {
    surface.closed_triangles = triangles_of(desc.closed_triangles, surface.closed_points.size(),
                                            "surface.closed_triangles");
  }
  surface.closed_annulus = read_points(desc.closed_annulus, "surface.closed_annulus");
  surface.closed_tips = read_points(desc.closed_tips, "surface.closed_tips");
  return surface;
}

BuildSettings read_options(const mvs_build_options *given) {
  const mvs_build_options options = read_struct_or_default(given, "options");
  must_be_zero(options.reserved, "options.reserved");
  must_be_zero(options.reserved2, "options.reserved2");
  BuildSettings settings;
  MVS_MUST(options.without_leak <= 1, MVS_E_ARGUMENT, "options.without_leak",
           "options.without_leak is %u: it has to be 0 or 1", options.without_leak);
  settings.finds_leak = options.without_leak == 0;
  if (options.leaflet_law != 0) {
    settings.law = static_cast<LeafletLawId>(options.leaflet_law);
    MVS_MUST(find_leaflet_law(*settings.law) != nullptr, MVS_E_ARGUMENT, "options.leaflet_law",
             "options.leaflet_law is %u: it has to be one of MVS_LEAFLET_LAW_*, or 0",
             options.leaflet_law);
  }
  // m: 0.2 mm gives 80,000 vertices
  must_be_in(options.edge, 0.2e-3, 5e-3, "options.edge");
  settings.edge = options.edge;
  settings.thickness_is_given = options.thickness != 0;
  settings.thickness =
      or_default(options.thickness, settings.thickness, 0.1e-3, 5e-3, "options.thickness");
  settings.chord_factor =
      or_default(options.chord_factor, settings.chord_factor, 0.5, 2, "options.chord_factor");
  settings.coaptation_length = or_default(options.coaptation_length, settings.coaptation_length,
                                          1e-3, 20e-3, "options.coaptation_length");
  // m: beyond 5 mm nothing is known of the leaflets
  must_be_in(options.edge_error, 1e-6, 5e-3, "options.edge_error");
  must_be_in(options.edge_lost, 1e-6, 5e-3, "options.edge_lost");
  settings.edge_error = options.edge_error;
  settings.edge_lost = options.edge_lost;
  must_be_in(options.thickness_error, 1e-6, 2e-3, "options.thickness_error");
  settings.thickness_error = options.thickness_error;
  must_be_in(options.closed_error, 1e-6, 5e-3, "options.closed_error");
  settings.closed_error = options.closed_error;
  MVS_MUST(options.chords == 0 || (options.chords >= 20 && options.chords <= 400), MVS_E_ARGUMENT,
           "options.chords", "options.chords is %u: it has to be 0 (the default, 100) or 20 to 400",
           options.chords);
  if (options.chords != 0) settings.chords = options.chords;
  return settings;
}

LeakUnknowns read_errors(const mvs_leak_errors *given) {
  const mvs_leak_errors errors = read_struct_or_default(given, "errors");
  must_be_zero(errors.reserved, "errors.reserved");
  LeakUnknowns unknowns;
  LengthRange &range = unknowns.lengths;
  range.all = or_default(errors.lengths, range.all, 1e-3, 0.5, "errors.lengths");
  range.single = or_default(errors.single, range.single, 1e-3, 0.5, "errors.single");
  must_be_in(errors.thickness, 1e-6, 2e-3, "errors.thickness");
  unknowns.thickness_error = errors.thickness;
  return unknowns;
}

}  // namespace

extern "C" {

mvs_result mvs_build_valve(mvs_sim *sim, const mvs_surface_desc *surface,
                           const mvs_build_options *options, mvs_findings **findings) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    BuildSettings settings = read_options(options);
    const PatientSurface from = read_surface(surface);
    MVS_MUST(settings.closed_error == 0 || !from.closed_points.empty(), MVS_E_ARGUMENT,
             "options.closed_error",
             "options.closed_error is given and surface.closed_points is not: give the closed "
             "surface, or leave the error out");
    settings.workers = s.workers.get();
    BuiltValve built = build_valve(from, settings, s.progress());
    auto made = std::make_unique<mvs_findings>(mvs_findings{std::move(built.findings)});
    State state = initial_state(*built.model);
    replace_valve(s, {{std::move(built.model), std::move(state)}, {}});
    if (findings) *findings = made.release();
  });
}

mvs_result mvs_find_leak_interval(mvs_sim *sim, const mvs_leak_errors *errors,
                                  mvs_findings **findings) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    must_point(findings, "findings");
    const LeakUnknowns unknowns = read_errors(errors);
    auto made = std::make_unique<mvs_findings>();
    report_thickness_error(unknowns.thickness_error, made->list);
    leak_interval(
        s.current().model, unknowns, {}, made->list,
        [&, progress = s.progress()](double share) { tell_progress(progress, share); },
        s.workers.get());
    *findings = made.release();
  });
}

mvs_result mvs_findings_get_count(const mvs_findings *findings, uint32_t *count) {
  return at_boundary([&] {
    must_point(findings, "findings");
    must_point(count, "count");
    *count = static_cast<uint32_t>(findings->list.size());
  });
}

mvs_result mvs_findings_get(const mvs_findings *findings, uint32_t index, mvs_finding *finding) {
  return at_boundary([&] {
    must_point(findings, "findings");
    must_be_index(index, findings->list.size(), "findings", "findings");
    const Finding &found = findings->list[index];
    mvs_finding out = {};
    out.source = static_cast<mvs_finding_source>(found.source);
    out.name = found.name.c_str();
    out.sentence = found.sentence.c_str();
    out.unit = found.unit.c_str();
    out.confidence = found.confidence;
    out.values = {found.value.data(), found.value.size(), 1, MVS_TYPE_F64, sizeof(double)};
    out.doubtful = is_doubtful(found) ? 1 : 0;
    write_struct(finding, out, "finding");
  });
}

void mvs_findings_release(mvs_findings *findings) {
  delete findings;
}

}  // extern "C"
