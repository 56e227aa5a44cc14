// The annulus of a torn or noisy surface.
#include "patient/checks/rim_length.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "patient/annulus/closed_curve.h"
#include "patient/doubtful.h"
#include "patient/mid_sheet.h"
#include "tests/about.h"
#include "tests/patient/parametric_sheet.h"
#include "tests/patient/surfaces.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

double annulus_length(const MidSheet &mid) {
  return ClosedCurve(points_along(mid.rims.annulus, mid.sheet.x)).length();
}

MidSheet mid_of(const Surface &s, Findings &findings) {
  PatientSurface surface;
  surface.points = s.x;
  surface.triangles = s.triangles;
  return find_mid_sheet(surface, {}, findings);
}

}  // namespace

TEST_CASE("the_smooth_length_of_a_saddle_is_its_length_and_leaves_noise_out") {
  const auto saddle = [](double noise) {
    uint64_t seed = 3;
    std::vector<Vec3> points;
    for (size_t k = 0; k < 150; ++k) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(k) / 150;
      points.push_back({17e-3 * std::cos(angle),
                        15e-3 * std::sin(angle) * (1 + 0.2 * std::sin(angle)),
                        3e-3 * std::cos(2 * angle)});
      points.back() += noise * Vec3(next_share(seed), next_share(seed), next_share(seed));
    }
    return points;
  };
  const double length = ClosedCurve(saddle(0)).length();
  CHECK(smooth_length(saddle(0)) == about(length, 2e-3));
  // arc length of a noisy curve is uneven, which bends the series by a little
  CHECK(ClosedCurve(saddle(0.5e-3)).length() > 1.2 * length);
  CHECK(smooth_length(saddle(0.5e-3)) == about(length, 0.02));
}

TEST_CASE("notches_of_a_torn_annulus_are_filled") {
  Surface s = funnel(120, 24);  // sides of 0.84 mm at the annulus
  Findings whole;
  const double length = annulus_length(mid_of(s, whole));
  uint64_t seed = 8;
  for (size_t t = 2 * 120; t-- > 0;) {  // of the row at the annulus
    if (next_share(seed) < -0.7) s.triangles.erase(s.triangles.begin() + std::ptrdiff_t(t));
  }
  Findings findings;
  const MidSheet mid = mid_of(s, findings);
  REQUIRE(find(findings, "annulus_notches"));
  CHECK(annulus_length(mid) == about(length, 0.03));
  CHECK(find(findings, "annulus_length") == nullptr);
}

TEST_CASE("an_annulus_that_is_longer_than_a_smooth_curve_is_a_doubtful_finding") {
  ParametricSheet p = parametric_sheet(430);
  Findings findings = {{"annulus", FindingSource::given, 0.97, "", {}, ""}};
  doubt_annulus_length(p.sheet, p.rims, findings);
  CHECK(findings.size() == 1);
  CHECK(findings[0].confidence == 0.97);
  for (size_t k = 0; k < p.rims.annulus.size(); k += 2) {
    p.sheet.x[p.rims.annulus[k]] += Vec3(0, 0, 1.5e-3);  // sides are 2 mm long
  }
  doubt_annulus_length(p.sheet, p.rims, findings);
  REQUIRE(findings.size() == 2);
  CHECK(findings[1].name == "annulus_length");
  CHECK(is_doubtful(findings[1]));
  CHECK(findings[0].confidence < 0.9);
}

TEST_CASE("a_noisy_surface_is_a_doubtful_finding") {
  Surface s = funnel(120, 24);
  Findings findings;
  mid_of(s, findings);
  CHECK(find(findings, "rough_surface") == nullptr);
  uint64_t seed = 4;
  for (Vec3 &x : s.x) x += 0.5e-3 * Vec3(next_share(seed), next_share(seed), next_share(seed));
  mid_of(s, findings);
  REQUIRE(find(findings, "rough_surface"));
  CHECK(is_doubtful(*find(findings, "rough_surface")));
}

TEST_CASE("real_annuli_are_smooth") {
  const Surface real = real_stl("real_mitral/open_1146.stl");
  if (real.x.empty()) {
    MESSAGE("skipped: no real_mitral/open_1146.stl in MVS_TEST_DATA or ../shared/data");
    return;
  }
  Findings findings;
  const MidSheet mid = mid_of(real, findings);
  MESSAGE("smooth " << smooth_length(points_along(mid.rims.annulus, mid.sheet.x)) << " of "
                    << annulus_length(mid));
  for (const char *name : {"annulus_length", "far_tissue", "annulus_notches", "rough_surface"}) {
    CHECK(find(findings, name) == nullptr);
  }
}
