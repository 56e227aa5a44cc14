// The free edge of a surface that lacks tissue, from the closed leaflets: a twin experiment.
#include "patient/fit/edge_overhang.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "patient/fit/extend_free_edge.h"
#include "patient/fit/free_edge_shift.h"
#include "tests/patient/patient_valve.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr double mm = 1e-3;
constexpr double eaten = 2 * mm, half_stretch = 7 * mm;  // m of the annulus

struct Eaten {
  Valve valve;
  PatientGeometry g;
  std::vector<double> missing;  // m, of each free-edge node
};

// The valve without a stretch of its free edge around the foot of a node.
Eaten eaten_around(const Valve &whole, const PatientGeometry &g, uint32_t middle) {
  const SheetCoordinates &c = g.coordinates;
  std::vector<double> by;
  for (const double foot : c.foot) {
    const double far = around(c.foot[middle], foot, c.annulus_length);
    by.push_back(std::abs(far) < half_stretch ? -eaten : 0);
  }
  Eaten made{with_edge_moved(whole, g, by), g, {}};
  std::copy_n(made.valve.rest.get().begin(), g.sheet.x.size(), made.g.sheet.x.begin());
  made.g.coordinates = sheet_coordinates(made.g.sheet, g.rims);
  for (const uint32_t i : g.rims.free_edge) {
    made.missing.push_back((made.g.sheet.x[i] - g.sheet.x[i]).norm());
  }
  return made;
}

double mean(const std::vector<double> &values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

}  // namespace

TEST_CASE("tissue_that_the_open_surface_lacks_is_found_on_the_closed_leaflets") {
  const PatientGeometry &g = parametric_geometry(430);
  Findings findings;
  Valve whole = leaflets_of(g, LeafletLawId::neo_hookean);
  add_chordae(whole, g, find_papillary_tips({}, g, findings), {}, findings);
  const ClosedPatient closed = close_patient(whole);
  ClosedSurface given{closed.state.x, whole.triangles.get()};
  given.points.resize(g.sheet.x.size());

  const uint32_t middle = g.rims.free_edge[g.rims.free_edge.size() / 4];
  Eaten seen = eaten_around(whole, g, middle);
  findings.clear();
  extend_free_edge(seen.valve, seen.g, given, {}, findings, {});
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].name == "edge_found");
  std::vector<double> left_in, left_out;
  for (size_t k = 0; k < seen.missing.size(); ++k) {
    const uint32_t i = g.rims.free_edge[k];
    const double left = (seen.g.sheet.x[i] - g.sheet.x[i]).norm();
    (seen.missing[k] > 0.9 * eaten ? left_in : left_out).push_back(left);
  }
  CHECK(left_in.size() > 3);
  // at least half of it; the fit of chordae stretches the tissue over a part of the rest
  CHECK(mean(left_in) < 0.5 * eaten);
  CHECK(mean(left_out) < 0.2 * eaten);
}

TEST_CASE("a_free_edge_that_the_closed_leaflets_end_at_stays") {
  const PatientGeometry &g = parametric_geometry(430);
  Findings findings;
  Valve whole = leaflets_of(g, LeafletLawId::neo_hookean);
  add_chordae(whole, g, find_papillary_tips({}, g, findings), {}, findings);
  const ClosedPatient closed = close_patient(whole);
  ClosedSurface given{closed.state.x, whole.triangles.get()};
  given.points.resize(g.sheet.x.size());
  const std::vector<Vec3> before = whole.rest.get();
  PatientGeometry same = g;
  findings.clear();
  extend_free_edge(whole, same, given, {}, findings, {});
  CHECK(findings.empty());
  CHECK(whole.rest.get() == before);
}

TEST_CASE("a_softer_tissue_reaches_past_the_edge_and_the_finding_says_so") {
  const PatientGeometry &g = parametric_geometry(430);
  Findings findings;
  Valve stiff = leaflets_of(g, LeafletLawId::neo_hookean);
  add_chordae(stiff, g, find_papillary_tips({}, g, findings), {}, findings);
  Valve soft = stiff;
  // 200 kPa are the default
  for (Leaflet &leaflet : soft.leaflets) leaflet.constants = {130e3};
  const ClosedPatient closed = close_patient(soft);
  ClosedSurface given{closed.state.x, soft.triangles.get()};
  given.points.resize(g.sheet.x.size());
  PatientGeometry moved = g;
  findings.clear();
  extend_free_edge(stiff, moved, given, {}, findings, {});
  REQUIRE(findings.size() == 1);
  const double most = findings[0].value[1];
  CHECK(most > 1 * mm);
  CHECK(findings[0].confidence == (most > 0.9 * most_overhang ? 0.2 : 0.5));
  CHECK(findings[0].sentence.find("the tissue is softer") != std::string::npos);
}
