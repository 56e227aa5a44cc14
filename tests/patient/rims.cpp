// Rims and the orientation of sheets.
#include "patient/surface/rims.h"

#include <doctest/doctest.h>

#include "base/error.h"
#include "model/sides.h"
#include "patient/surface/boundary.h"
#include "patient/surface/clean_surface.h"
#include "tests/about.h"
#include "tests/patient/cleaned.h"
#include "tests/patient/parametric_sheet.h"
#include "tests/patient/surfaces.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

// Positions of loops, sorted, to compare loops of other numberings; equal up to 1 nm.
std::vector<Vec3> points_of(const std::vector<uint32_t> &loop, const std::vector<Vec3> &x) {
  std::vector<Vec3> points;
  points.reserve(loop.size());
  for (const uint32_t i : loop) points.push_back(x[i]);
  return points;
}

// Whether both loops have the same points in the same order, from any start.
bool same_loop(const std::vector<Vec3> &a, const std::vector<Vec3> &b, double tolerance) {
  for (size_t shift = 0; shift < b.size(); ++shift) {
    bool same = a.size() == b.size();
    for (size_t k = 0; k < a.size() && same; ++k) {
      same = (a[k] - b[(k + shift) % b.size()]).norm() <= tolerance;
    }
    if (same) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("find_rims_guesses_the_annulus_of_parametric_valves_however_they_lie") {
  for (const uint32_t vertices : {200u, 430u, 1600u}) {
    const ParametricSheet p = parametric_sheet(vertices);
    const Surface s = surface_of(p.sheet);
    CAPTURE(vertices);
    for (const bool turned : {false, true}) {
      Surface given = moved(renumbered(s, 7), 2.5);
      if (turned) given = flipped(given, 1);
      LeafletSheet sheet = cleaned(soup(given));
      Findings findings;
      const SheetRims rims = find_rims(sheet, {}, findings);
      const Surface truth = moved(s, 2.5);
      // 32 nm: coordinates of 0.4 m in single precision
      CHECK(same_loop(points_of(rims.annulus, sheet.x), points_of(p.rims.annulus, truth.x), 4e-8));
      CHECK(rims.free_edge.size() == p.rims.free_edge.size());
      REQUIRE(find(findings, "annulus"));
      CHECK(find(findings, "annulus")->source == FindingSource::guessed);
      CHECK(find(findings, "annulus")->confidence > 0.5);
      CHECK(find(findings, "atrium")->confidence > 0.5);
      CHECK(find(findings, "orifice")->confidence == 1);
      CHECK(boundary_loops(sheet).size() == 2);
    }
  }
}

TEST_CASE("find_rims_guesses_the_annulus_of_unusual_parametric_valves") {
  struct Unusual {
    const char *name;
    mvs_shape shape;
    double saddle, anterior, posterior, clefts;
  };
  for (const Unusual &u :
       {Unusual{"founding", MVS_SHAPE_FOUNDING, 0, 0, 0, 0},
        {"saddle", MVS_SHAPE_HEALTHY, 9e-3, 0, 0, 0},
        {"short leaflets", MVS_SHAPE_HEALTHY, 0, 18e-3, 9e-3, 0},
        {"a free edge longer than the annulus", MVS_SHAPE_HEALTHY, 0, 32e-3, 22e-3, 0},
        {"clefts", MVS_SHAPE_HEALTHY, 0, 0, 0, 4e-3}}) {
    mvs_parametric_desc desc = {};
    desc.struct_size = sizeof desc;
    desc.shape = u.shape;
    desc.saddle_height = u.saddle;
    desc.anterior_height = u.anterior;
    desc.posterior_height = u.posterior;
    desc.indentation_depth = u.clefts;
    const ModelPtr model = make_model(make_parametric_valve(desc));
    Findings findings;
    CAPTURE(u.name);
    std::vector<Vec3> found, truth;
    LeafletSheet sheet = cleaned({model->valve.rest, model->valve.triangles});
    const SheetRims rims = find_rims(sheet, {}, findings);
    for (const uint32_t i : rims.annulus) found.push_back(sheet.x[i]);
    for (const uint32_t i : model->valve.annulus) truth.push_back(model->valve.rest[i]);
    std::reverse(truth.begin(), truth.end());
    CHECK(same_loop(found, truth, 0));
    CHECK(find(findings, "annulus")->confidence > 0.3);
    CHECK(find(findings, "orifice")->confidence == 1);
  }
}

TEST_CASE("find_rims_survives_noise_of_an_image") {
  const ParametricSheet p = parametric_sheet(430);
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    Surface s = surface_of(p.sheet);
    uint64_t state = seed;
    // uniform, 0.2 mm rms: half width 0.2 sqrt(3)
    for (Vec3 &x : s.x) {
      x += 0.346e-3 * Vec3{next_share(state), next_share(state), next_share(state)};
    }
    Findings findings;
    const SheetRims rims = rims_of(s, {}, findings);
    std::vector<uint32_t> found = rims.annulus, truth = p.rims.annulus;
    std::sort(found.begin(), found.end());
    std::sort(truth.begin(), truth.end());
    CHECK(found == truth);
    CHECK(find(findings, "annulus")->confidence > 0.4);
  }
}

TEST_CASE("find_rims_takes_the_boundary_near_given_annulus_points") {
  const ParametricSheet p = parametric_sheet(430);
  const Surface s = surface_of(p.sheet);
  RimLandmarks landmarks;
  for (size_t k = 0; k < p.rims.annulus.size(); k += 5) {
    landmarks.annulus.push_back(p.sheet.x[p.rims.annulus[k]] + Vec3(1e-3, 0, 0));
  }
  Findings findings;
  const SheetRims rims = rims_of(s, landmarks, findings);
  CHECK(rims.annulus.size() == p.rims.annulus.size());
  CHECK(findings[0].source == FindingSource::given);
  CHECK(findings[0].confidence > 0.8);
  // points of the free edge make that the annulus, and the funnel stands on its head
  landmarks.annulus.clear();
  for (const uint32_t i : p.rims.free_edge) landmarks.annulus.push_back(p.sheet.x[i]);
  Findings other;
  CHECK(rims_of(s, landmarks, other).annulus.size() == p.rims.free_edge.size());
  CHECK(find(other, "annulus")->confidence < 0.5);
  CHECK(find(other, "annulus")->sentence.find("points are not those of the free edge") !=
        std::string::npos);
  // points in the atrium, as of a surface with some of its wall
  landmarks.annulus.clear();
  for (const uint32_t i : p.rims.annulus) {
    landmarks.annulus.push_back(p.sheet.x[i] + Vec3(0, 0, 4e-3));
  }
  Findings above;
  rims_of(s, landmarks, above);
  CHECK(find(above, "annulus")->confidence < 0.6);
  CHECK(find(above, "annulus")->sentence.find("wall of the atrium") != std::string::npos);
  // LPS for RAS
  for (Vec3 &x : landmarks.annulus) x = Vec3(0.1, 0.1, 0) - x;
  CHECK_THROWS_WITH_AS(rims_of(s, landmarks, other), doctest::Contains("LPS or RAS"), Error);
}

TEST_CASE("steps_of_voxels_do_not_lengthen_the_chords_of_a_rim") {
  // a circle of 20 mm whose vertices lie 0.35 mm in and out in turns, 0.3 mm apart along it
  LeafletSheet sheet;
  std::vector<uint32_t> loop;
  constexpr uint32_t count = 420;
  for (uint32_t k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * k / count, r = 20e-3 + (k % 2 ? 0.35e-3 : -0.35e-3);
    sheet.x.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
    loop.push_back(k);
  }
  const LoopShape shape = shape_of(sheet, loop);
  const double circle = 2 * std::numbers::pi * 20e-3;
  CHECK(shape.length > 2 * circle);
  // chords may begin in and end out, by half a step of 0.7 mm in 2.6 mm at most
  CHECK(shape.chord_length == about(circle, 0.04));
  CHECK(shape.turning < 1.5);
}

TEST_CASE("find_rims_does_not_believe_tips_in_the_atrium") {
  const ParametricSheet p = parametric_sheet(430);
  RimLandmarks landmarks;
  landmarks.tips = {Vec3(10e-3, 0, 25e-3), Vec3(-10e-3, 0, 25e-3)};
  Findings findings;
  // the free edge is farther from such tips, and would pass for the annulus
  CHECK_THROWS_WITH_AS(rims_of(surface_of(p.sheet), landmarks, findings),
                       doctest::Contains("tips lie below the free edge"), Error);
  for (const uint32_t i : p.rims.annulus) landmarks.annulus.push_back(p.sheet.x[i]);
  CHECK_THROWS_WITH_AS(rims_of(surface_of(p.sheet), landmarks, findings),
                       doctest::Contains("on the other side"), Error);
}

TEST_CASE("find_rims_takes_the_boundary_far_from_given_tips") {
  const Surface s = funnel(24, 6);
  RimLandmarks landmarks;
  landmarks.tips = {Vec3(10e-3, 0, -25e-3), Vec3(-10e-3, 0, -25e-3)};
  Findings findings;
  LeafletSheet sheet = cleaned(s);
  const SheetRims rims = find_rims(sheet, landmarks, findings);
  CHECK(sheet.x[rims.annulus[0]].z() == 0);
  CHECK(find(findings, "annulus")->source == FindingSource::measured);
  CHECK(find(findings, "annulus")->confidence > 0.9);
  CHECK(find(findings, "atrium")->value[2] == about(1));
  landmarks.tips[0].x() = landmarks.tips[1].x() = 0.2;
  CHECK_THROWS_WITH_AS(rims_of(s, landmarks, findings), doctest::Contains("papillary tips lie"),
                       Error);
}

TEST_CASE("rims_run_the_way_of_the_triangles_with_normals_into_the_atrium") {
  for (const size_t flips : {1000000u, 1u}) {
    LeafletSheet sheet = cleaned(flipped(funnel(24, 6), flips));
    Findings findings;
    const SheetRims rims = find_rims(sheet, {}, findings);
    CHECK(shape_of(sheet, rims.annulus).area.z() > 0);
    CHECK(shape_of(sheet, rims.free_edge).area.z() < 0);
    const std::vector<std::vector<uint32_t>> loops = boundary_loops(sheet);
    REQUIRE(loops.size() == 2);
    CHECK(loops[0] == rims.annulus);
    CHECK(loops[1] == rims.free_edge);
    for (const Tri &t : sheet.triangles) {
      const Vec3 e1 = sheet.x[t[1]] - sheet.x[t[0]], e2 = sheet.x[t[2]] - sheet.x[t[0]];
      CHECK(e1.cross(e2).z() > 0);
    }
  }
}

TEST_CASE("find_rims_says_whether_it_turned_the_triangles") {
  // a gap with one corner on the free edge: its filling renumbers vertices, so that corners of
  // triangles do not show whether they were turned
  constexpr uint32_t round = 60, down = 8, pinch = down * round + 20;
  for (const bool reversed : {false, true}) {
    Surface s = funnel(round, down);
    const auto is_near = [](uint32_t i) {
      const uint32_t row = i / round, column = i % round;
      return i == pinch || (row == down - 1 && (column == 19 || column == 20 || column == 21));
    };
    std::erase_if(s.triangles,
                  [&](const Tri &t) { return std::all_of(t.begin(), t.end(), is_near); });
    LeafletSheet sheet = cleaned(s);
    const bool is_up = area_normal(sheet.x, sheet.triangles[0]).z() > 0;
    if (is_up == reversed) {
      for (Tri &t : sheet.triangles) std::swap(t[1], t[2]);
    }
    Findings findings;
    const SheetRims rims = find_rims(sheet, {}, findings);
    REQUIRE(find(findings, "pinched_gaps"));
    CHECK(rims.turned == reversed);
    CHECK(area_normal(sheet.x, sheet.triangles[0]).z() > 0);
  }
}

TEST_CASE("shape_of_a_circle_is_that_of_the_circle") {
  const LeafletSheet sheet = cleaned(funnel(200, 8));
  const LoopShape shape = shape_of(sheet, boundary_loops(sheet)[0]);
  const double pi = 3.14159265358979;
  // a polygon of 200 sides: short by pi^2 / (6 n^2) of the length, 4 times that of the area
  CHECK(shape.length == about(2 * pi * 16e-3, 5e-5));
  CHECK(shape.area.norm() == about(pi * 256e-6, 2e-4));
  CHECK(shape.centre.norm() < 1e-15);
  CHECK(shape.turning == about(1));
}

TEST_CASE("a_small_valve_is_as_open_as_a_large_one") {
  // the valve of an infant: an annulus of 33 mm, edges 0.9 mm apart
  const auto pressed = [](double size) {
    Surface s = funnel(48, 12);
    for (Vec3 &x : s.x) x.y() *= 1 + (0.2 - 1) * x.z() / -12e-3;
    for (Vec3 &x : s.x) x *= size;
    return s;
  };
  for (const double size : {1.0, 0.33}) {
    Findings findings;
    rims_of(pressed(size), {}, findings);
    CHECK(find(findings, "orifice")->confidence > 0.3);
  }
}

TEST_CASE("find_rims_guesses_the_annulus_of_real_valves") {
  const Surface s = real_stl("real_mitral/open_1146.stl");
  const nlohmann::json kaiser = read_real_valve("kaiser_mitral_normal_1/N64.json");
  if (s.x.empty() || kaiser.is_null()) {
    MESSAGE("skipped: no real_mitral, kaiser_mitral_normal_1 in MVS_TEST_DATA or ../shared/data");
    return;
  }
  LeafletSheet sheet = cleaned(s);
  Findings findings;
  const SheetRims rims = find_rims(sheet, {}, findings);
  CHECK(rims.annulus.size() == 67);
  CHECK(rims.free_edge.size() == 79);
  CHECK(find(findings, "annulus")->confidence > 0.9);
  CHECK(find(findings, "atrium")->confidence == find(findings, "annulus")->confidence);
  CHECK(find(findings, "orifice")->confidence == 1);

  for (const char *file : {"kaiser_mitral_normal_1/N32.json", "kaiser_mitral_normal_1/N64.json",
                           "kaiser_mitral_normal_1/N128.json"}) {
    const Valve valve = kaiser_valve(read_real_valve(file));
    const Surface open = {valve.rest, valve.triangles};
    LeafletSheet leaflets = cleaned(open);
    Findings found;
    const SheetRims made = find_rims(leaflets, {}, found);
    Findings by_points;
    RimLandmarks landmarks;
    for (const uint32_t n : valve.annulus) landmarks.annulus.push_back(valve.rest[n]);
    LeafletSheet again = cleaned(open);
    CHECK(made.annulus == find_rims(again, landmarks, by_points).annulus);
    CHECK(by_points[0].confidence == 1);
    CHECK(find(found, "annulus")->confidence > 0.9);
    CHECK(find(found, "orifice")->confidence == 1);
  }
}
