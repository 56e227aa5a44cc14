// Tips of the papillary muscles: grouped, assumed, refused.
#include "patient/chordae/papillary_tips.h"

#include <doctest/doctest.h>

#include "base/error.h"
#include "patient/doubtful.h"
#include "patient/findings.h"
#include "tests/patient/patient_valve.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr double mm = 1e-3;

PapillaryTips tips_of(const PatientGeometry &g, const std::vector<Vec3> &given) {
  Findings findings;
  return find_papillary_tips(given, g, findings);
}

}  // namespace

TEST_CASE("assumed_tips_lie_where_the_parametric_valve_has_them") {
  const PatientGeometry g = parametric_geometry(430);
  Findings findings;
  const PapillaryTips tips = find_papillary_tips({}, g, findings);
  REQUIRE(tips.anterolateral.size() == 1);
  REQUIRE(tips.posteromedial.size() == 1);
  // x is posteromedial, y towards A, z into the atrium; 1 mm: commissures are found to 0.4 mm, and
  // the middle of the annulus' heights depends on its nodes
  CHECK((tips.anterolateral[0] - Vec3(-10, -3.1, -23.5) * mm).norm() < 1 * mm);
  CHECK((tips.posteromedial[0] - Vec3(10, -3.1, -23.5) * mm).norm() < 1 * mm);
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].source == FindingSource::assumed);
  CHECK(findings[0].confidence < 0.5);
  CHECK(findings[0].value.size() == 6);
}

TEST_CASE("assumed_tips_stay_below_leaflets_that_hang_deep") {
  ParametricSheet p = parametric_sheet(430);
  for (Vec3 &x : p.sheet.x) x.z() *= 2;
  const PatientGeometry g = geometry_of(p.sheet, p.rims);
  double lowest = 0;
  for (const Vec3 &x : g.sheet.x) lowest = std::min(lowest, x.z());
  REQUIRE(lowest < -30 * mm);
  CHECK(tips_of(g, {}).anterolateral[0].z() < lowest);
}

TEST_CASE("given_tips_are_grouped_by_their_side") {
  const PatientGeometry g = parametric_geometry(430);
  Findings findings;
  const PapillaryTips tips = find_papillary_tips(
      {Vec3(9, 0, -25) * mm, Vec3(-12, -2, -20) * mm, Vec3(7, -5, -22) * mm}, g, findings);
  REQUIRE(tips.anterolateral.size() == 1);
  CHECK(tips.anterolateral[0] == Vec3(-12, -2, -20) * mm);
  REQUIRE(tips.posteromedial.size() == 2);
  CHECK(tips.posteromedial[1] == Vec3(7, -5, -22) * mm);
  CHECK(findings.back().source == FindingSource::given);
  CHECK(findings.back().value.size() == 9);
  CHECK(findings.back().confidence == 1);
}

TEST_CASE("tips_follow_the_annulus_unless_they_are_given_under_load") {
  const PatientGeometry g = parametric_geometry(430);
  const Vec3 medial = Vec3(10, -2, -23) * mm, lateral = Vec3(-10, -2, -23) * mm;
  Rigid annulus;
  annulus.turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  annulus.shift = Vec3(0, 0, 3) * mm;
  Findings findings;
  const PapillaryTips tips = find_papillary_tips({medial, lateral}, g, findings, {}, annulus);
  CHECK(tips.loaded_posteromedial[0] == annulus(medial));
  CHECK(tips.loaded_anterolateral[0] == annulus(lateral));
  CHECK(find_finding(findings, "head_motion")->source == FindingSource::assumed);
  // in the order of the given ones, as their loaded places are
  CHECK(points_in(*find_finding(findings, "papillary_tips"))[0] == medial);
  const PapillaryTips none = find_papillary_tips({}, g, findings, {}, annulus);
  CHECK(none.loaded_anterolateral[0] == annulus(none.anterolateral[0]));
  const PapillaryTips given =
      find_papillary_tips({medial, lateral}, g, findings, {medial, lateral}, annulus);
  CHECK(given.loaded_posteromedial[0] == medial);
}

TEST_CASE("tips_under_the_anterior_leaflet_lower_the_confidence") {
  const PatientGeometry g = parametric_geometry(430);
  Findings findings;
  find_papillary_tips({Vec3(-10, 8, -23) * mm, Vec3(10, 8, -23) * mm}, g, findings);
  CHECK(findings.back().confidence < 0.5);
  CHECK(findings.back().sentence.find("swapped") != std::string::npos);
}

// The annulus is 35 mm wide.
TEST_CASE("tips_in_places_without_muscles_are_doubted") {
  const PatientGeometry g = parametric_geometry(430);
  const auto said = [&](const Vec3 &lateral, const Vec3 &medial) {
    Findings findings;
    find_papillary_tips({lateral * mm, medial * mm}, g, findings);
    CHECK(is_doubtful(findings.back()) == (findings.back().confidence < 1));
    return findings.back().confidence < 1 ? findings.back().sentence : "";
  };
  // normal, dilated, of a child with short chordae, and moved apically and sideways by an infarct
  CHECK(said({-10, -3, -23}, {10, -3, -23}).empty());
  CHECK(said({-17, -6, -40}, {17, -6, -40}).empty());
  CHECK(said({-6, -3, -12}, {6, -3, -12}).empty());
  CHECK(said({-10, -3, -23}, {16, -9, -33}).empty());
  CHECK(said({-10, -3, -60}, {10, -3, -60}).find("60 and 60 mm below the plane") !=
        std::string::npos);
  CHECK(said({-10, -3, -8}, {10, -3, -23}).find("8 and 23 mm below") != std::string::npos);
  CHECK(said({-3, -3, -23}, {3, -3, -23}).find("6 mm apart") != std::string::npos);
  CHECK(said({-2, -13, -23}, {2, 7, -23}).find("one behind the other") != std::string::npos);
}

TEST_CASE("tips_of_another_frame_or_of_one_muscle_are_refused") {
  const PatientGeometry g = parametric_geometry(430);
  const Vec3 lateral = Vec3(-10, -2, -23) * mm, medial = Vec3(10, -2, -23) * mm;
  CHECK_THROWS_WITH_AS(tips_of(g, {lateral, medial + Vec3(0.2, 0, 0)}),
                       doctest::Contains("LPS or RAS"), Error);
  CHECK_THROWS_WITH_AS(tips_of(g, {lateral, Vec3(10, -2, 23) * mm}), doctest::Contains("above"),
                       Error);
  CHECK_THROWS_WITH_AS(tips_of(g, {lateral, Vec3(10, -2, -1) * mm}), doctest::Contains("below"),
                       Error);
  CHECK_THROWS_WITH_AS(tips_of(g, {medial, medial + Vec3(1, 0, 0) * mm}),
                       doctest::Contains("one tip of each of the two papillary muscles"), Error);
  CHECK_THROWS_WITH_AS(tips_of(g, std::vector<Vec3>(65, lateral)), doctest::Contains("at most 64"),
                       Error);
  CHECK_THROWS_WITH_AS(tips_of(g, {medial}), doctest::Contains("the only papillary tip lies on"),
                       Error);
}
