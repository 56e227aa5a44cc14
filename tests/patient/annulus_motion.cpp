// The loaded annulus: by rims of a closed surface, by a given curve, refused.
#include "patient/annulus/annulus_motion.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "patient/build_valve.h"
#include "patient/doubtful.h"
#include "patient/findings.h"
#include "tests/patient/parametric_sheet.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr double mm = 1e-3;

// Dilated by 15 % and 10 %, shifted and tilted: what two phases of one annulus differ by at most.
Vec3 moved(const Vec3 &p) {
  return {1.15 * p.x() + 1 * mm, 1.1 * p.y(), p.z() + 0.05 * p.x() - 0.5 * mm};
}

std::vector<Vec3> annulus_of(const ParametricSheet &p) {
  std::vector<Vec3> points;
  points.reserve(p.rims.annulus.size());
  for (const uint32_t i : p.rims.annulus) points.push_back(p.sheet.x[i]);
  return points;
}

// The same leaflets moved: their annulus and their free edge are rims.
ClosedSurface moved_leaflets(const ParametricSheet &p) {
  ClosedSurface closed{p.sheet.x, p.sheet.triangles};
  for (Vec3 &x : closed.points) x = moved(x);
  return closed;
}

double farthest_from_moved(const std::vector<Vec3> &annulus, const AnnulusMotion &motion) {
  double most = 0;
  for (const Vec3 &p : annulus) most = std::max(most, (motion(p) - moved(p)).norm());
  return most;
}

}  // namespace

TEST_CASE("the_annulus_follows_the_rims_of_closed_leaflets") {
  const ParametricSheet p = parametric_sheet(430);
  const std::vector<Vec3> annulus = annulus_of(p);
  ClosedSurface closed = moved_leaflets(p);
  Findings findings;
  const AnnulusMotion whole = find_annulus_motion(annulus, {}, closed, findings);
  REQUIRE(whole.moves());
  // points move by up to 3.6 mm; the weak preference for none keeps 4 % of that, and points slide
  // along the rim, where nothing holds them
  CHECK(farthest_from_moved(annulus, whole) < 0.35 * mm);
  CHECK(findings[0].name == "closed_annulus");
  CHECK(findings[0].source == FindingSource::measured);
  CHECK(points_in(findings[0]).size() == annulus.size());
  // a fifth of the rim is missing, and 3 mm of tissue below it with it
  const Vec3 at = moved(annulus[0]);
  std::erase_if(closed.triangles,
                [&](const Tri &t) { return (closed.points[t[0]] - at).norm() < 9 * mm; });
  const AnnulusMotion torn = find_annulus_motion(annulus, {}, closed, findings);
  CHECK(farthest_from_moved(annulus, torn) < 0.7 * mm);  // twice that of the whole
}

TEST_CASE("the_annulus_stays_where_rims_lie_on_it_or_are_not_seen") {
  const ParametricSheet p = parametric_sheet(430);
  const std::vector<Vec3> annulus = annulus_of(p);
  Findings findings;
  CHECK(!find_annulus_motion(annulus, {}, {}, findings).moves());
  CHECK(findings.empty());
  const AnnulusMotion same =
      find_annulus_motion(annulus, {}, {p.sheet.x, p.sheet.triangles}, findings);
  CHECK(!same.moves());
  CHECK(same(annulus[3]) == annulus[3]);
  CHECK(findings.back().source == FindingSource::measured);
  ClosedSurface half = moved_leaflets(p);
  std::erase_if(half.triangles, [&](const Tri &t) { return half.points[t[0]].x() < 0; });
  CHECK(!find_annulus_motion(annulus, {}, half, findings).moves());
  CHECK(findings.back().source == FindingSource::assumed);
  // no input of a build: read back as a curve it would give other bits
  CHECK(findings.back().name == "annulus_motion");
  CHECK(findings.back().value.empty());
  CHECK(!is_doubtful(findings.back()));
}

TEST_CASE("a_closed_surface_farther_off_than_an_annulus_moves_is_doubted_with_its_displacement") {
  const ParametricSheet p = parametric_sheet(430);
  const std::vector<Vec3> annulus = annulus_of(p);
  for (const Vec3 &shift : {Vec3(10, 0, 0), Vec3(0, 12, 0), Vec3(0, 0, 14), Vec3(9, -9, 4)}) {
    CAPTURE(shift.transpose());
    ClosedSurface closed{p.sheet.x, p.sheet.triangles};
    for (Vec3 &x : closed.points) x += mm * shift;
    Findings findings;
    CHECK(!find_annulus_motion(annulus, {}, closed, findings).moves());
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].name == "annulus_motion");
    CHECK(findings[0].value.empty());
    CHECK(is_doubtful(findings[0]));
    CHECK(findings[0].sentence.find("have to be registered") != std::string::npos);
  }
}

// The chordae of a valve whose loaded image lay 7 mm from the open one were fitted to make up for
// it.
TEST_CASE("an_annulus_that_is_displaced_as_a_whole_is_found_and_doubted") {
  const ParametricSheet p = parametric_sheet(430);
  const std::vector<Vec3> annulus = annulus_of(p);
  for (const Vec3 &shift : {Vec3(6, 2, -3), Vec3(-5, 5, 1), Vec3(2, -7, 2), Vec3(0, 0, -7)}) {
    CAPTURE(shift.transpose());
    ClosedSurface closed{p.sheet.x, p.sheet.triangles};
    for (Vec3 &x : closed.points) x += mm * shift;
    Findings findings;
    const AnnulusMotion motion = find_annulus_motion(annulus, {}, closed, findings);
    REQUIRE(motion.moves());
    // points slide along the rim, where nothing holds them
    for (const Vec3 &x : annulus) CHECK((motion(x) - x - mm * shift).norm() < 0.5 * mm);
    // across the flat side or along the axis, most rims are beyond 6 mm at first
    CHECK(is_doubtful(findings[0]) == (shift.x() == 2 || shift.x() == 0));
    CHECK(is_doubtful(findings[0]) ==
          (findings[0].sentence.find("displaced by 7.") != std::string::npos));
  }
}

TEST_CASE("a_given_curve_decides_in_any_order_of_its_points") {
  const ParametricSheet p = parametric_sheet(430);
  const std::vector<Vec3> annulus = annulus_of(p);
  std::vector<Vec3> given;
  for (size_t k = 0; k < annulus.size(); k += 2) given.push_back(moved(annulus[k]));
  std::rotate(given.begin(), given.begin() + 5, given.end());
  std::swap(given[1], given[7]);
  Findings findings;
  const AnnulusMotion motion = find_annulus_motion(annulus, given, {}, findings);
  REQUIRE(motion.moves());
  CHECK(findings[0].source == FindingSource::given);
  // on the curve, past which points slide as along a rim
  CHECK(farthest_from_moved(annulus, motion) < 0.35 * mm);
  CHECK(points_in(findings[0]) == given);
  std::vector<Vec3> loaded;
  loaded.reserve(annulus.size());
  for (const Vec3 &x : annulus) loaded.push_back(motion(x));
  for (const Vec3 &g : given) {
    double nearest = HUGE_VAL;
    for (const Vec3 &q : loaded) nearest = std::min(nearest, (q - g).norm());
    CHECK(nearest < 2 * mm);  // nodes of the annulus are 3 mm apart
  }
  // 10 to 15 % longer everywhere: points do not crowd at the corners of the curve
  for (size_t k = 0; k < annulus.size(); ++k) {
    const size_t next = (k + 1) % annulus.size();
    const double ratio = (loaded[next] - loaded[k]).norm() / (annulus[next] - annulus[k]).norm();
    CHECK((ratio > 1.05 && ratio < 1.2));  // 5 %: corners of the polygon
  }
  for (Vec3 &g : given) g.x() += 30 * mm;
  CHECK_THROWS_WITH_AS(find_annulus_motion(annulus, given, {}, findings),
                       doctest::Contains("in one frame (LPS or RAS)"), Error);
  given.resize(4);
  CHECK_THROWS_WITH_AS(find_annulus_motion(annulus, given, {}, findings),
                       doctest::Contains("give six or more"), Error);
}

TEST_CASE("the_annulus_moves_to_a_given_curve_that_no_affine_motion_reaches") {
  const ParametricSheet p = parametric_sheet(430);
  const std::vector<Vec3> annulus = annulus_of(p);
  std::vector<Vec3> given;
  given.reserve(annulus.size());
  for (const Vec3 &x : annulus) {
    const double angle = std::atan2(x.y(), x.x());
    given.push_back(x + 1.5 * mm * std::sin(3 * angle) * Vec3(x.x(), x.y(), 0).normalized());
  }
  Findings findings;
  const AnnulusMotion motion = find_annulus_motion(annulus, given, {}, findings);
  const ClosedCurve curve(given);
  double most = 0;
  for (const Vec3 &x : annulus) {
    const Vec3 loaded = motion(x);
    most = std::max(most, (curve.at(curve.nearest(loaded)) - loaded).norm());
  }
  // three waves of 1.5 mm by the angle are up to six by the length of a D, of which four are kept;
  // no affine motion reaches any
  CHECK(most < 0.4 * mm);
}

TEST_CASE("errors_of_the_points_of_a_given_curve_do_not_wrinkle_the_annulus") {
  const ParametricSheet p = parametric_sheet(430);
  const std::vector<Vec3> annulus = annulus_of(p);
  // up and down by 0.5 mm, the error of an observer, at every other point of 20
  const ClosedCurve smooth(annulus);
  std::vector<Vec3> given;
  for (int k = 0; k < 20; ++k) {
    const Vec3 up(0, 0, (k % 2 == 0 ? 0.5 : -0.5) * mm);
    given.push_back(moved(smooth.at(k * smooth.length() / 20)) + up);
  }
  Findings findings;
  const AnnulusMotion motion = find_annulus_motion(annulus, given, {}, findings);
  double most = 0;
  for (const Vec3 &x : annulus) most = std::max(most, std::abs((motion(x) - moved(x)).z()));
  // waves of a tenth of a lap have no part in the first four but for the uneven nodes
  CHECK(most < 0.1 * mm);
  CHECK(findings[0].sentence.find("0.3") != std::string::npos);  // mm, RMS of a wave 0.5 mm high
}

TEST_CASE("heads_keep_their_distance_from_an_annulus_that_moves_as_a_whole") {
  const ParametricSheet p = parametric_sheet(430);
  Rigid motion;
  motion.turn << 0.995, 0, 0.0998749, 0, 1, 0, -0.0998749, 0, 0.995;  // 5.7 degrees
  motion.shift = Vec3(1, -1, 4) * mm;
  PatientSurface surface;
  surface.points = p.sheet.x;
  surface.triangles = p.sheet.triangles;
  BuildSettings settings;
  settings.edge = 2.4 * mm;
  settings.finds_leak = false;
  for (const Vec3 &x : annulus_of(p)) surface.closed_annulus.push_back(motion(x));
  const Valve valve = build_valve(surface, settings, {}).model->valve;
  REQUIRE(valve.heads.size() == 2);
  for (const Head &head : valve.heads) {
    // corners of the curve are cut off by up to 0.1 mm; the heads are as far below the annulus as
    // it is wide
    CHECK((valve.loaded.get()[head.node] - motion(valve.rest.get()[head.node])).norm() < 0.2 * mm);
  }
}

TEST_CASE("a_built_valve_has_its_annulus_and_heads_under_load") {
  const ParametricSheet p = parametric_sheet(430);
  PatientSurface surface;
  surface.points = p.sheet.x;
  surface.triangles = p.sheet.triangles;
  surface.tips = {Vec3(-10, -3, -24) * mm, Vec3(10, -3, -24) * mm};
  BuildSettings settings;
  settings.edge = 2.4 * mm;
  settings.finds_leak = false;
  const BuiltValve still = build_valve(surface, settings, {});
  CHECK(still.model->valve.loaded.get() == still.model->valve.rest.get());
  for (const Vec3 &x : annulus_of(p)) surface.closed_annulus.push_back(moved(x));
  for (const Vec3 &tip : surface.tips) surface.closed_tips.push_back(tip + Vec3(0, 1, 2) * mm);
  const BuiltValve built = build_valve(surface, settings, {});
  const Valve &valve = built.model->valve;
  for (const uint32_t i : valve.annulus) {
    // chords of the given points, which are 3 mm apart on a curve of 12 mm, cut 0.1 mm off
    CHECK((valve.loaded.get()[i] - moved(valve.rest.get()[i])).norm() < 0.5 * mm);
  }
  REQUIRE(valve.heads.size() == 2);
  for (const Head &head : valve.heads) {
    CHECK(
        (valve.loaded.get()[head.node] - valve.rest.get()[head.node] - Vec3(0, 1, 2) * mm).norm() <
        1e-12);
  }
  CHECK(find_finding(built.findings, "closed_tips")->source == FindingSource::given);
  // the tips come nearer, so that chordae are shorter than with a still boundary
  double before = 0, after = 0;
  for (const Chord &c : still.model->valve.chords) before += c.rest_length;
  for (const Chord &c : valve.chords) after += c.rest_length;
  CHECK(after < before);
  surface.closed_tips.pop_back();
  CHECK_THROWS_WITH_AS(build_valve(surface, settings, {}), doctest::Contains("in the same order"),
                       Error);
  surface.closed_tips.push_back(Vec3(40, 0, -24) * mm);
  CHECK_THROWS_WITH_AS(build_valve(surface, settings, {}), doctest::Contains("tip 2 would move"),
                       Error);
}
