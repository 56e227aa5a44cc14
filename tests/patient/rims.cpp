// Holes, rims and the orientation of sheets.
#include "patient/rims.h"

#include <doctest/doctest.h>

#include "base/error.h"
#include "model/sides.h"
#include "patient/boundary.h"
#include "patient/clean_surface.h"
#include "tests/patient/parametric_sheet.h"
#include "tests/patient/surfaces.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

LeafletSheet cleaned(const Surface &s) {
  Findings findings;
  return clean_surface(s.x, s.triangles, {}, {}, findings);
}

SheetRims rims_of(const Surface &s, const RimLandmarks &landmarks, Findings &findings) {
  LeafletSheet sheet = cleaned(s);
  return find_rims(sheet, landmarks, findings);
}

// Positions of loops, sorted, to compare loops of other numberings; equal up to 1 nm.
std::vector<Vec3> points_of(const std::vector<uint32_t> &loop, const std::vector<Vec3> &x) {
  std::vector<Vec3> points;
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

// Drops the triangles around some vertices.
Surface without_stars(Surface s, const std::vector<uint32_t> &vertices) {
  std::erase_if(s.triangles, [&](const Tri &t) {
    return std::any_of(t.begin(), t.end(), [&](uint32_t i) {
      return std::find(vertices.begin(), vertices.end(), i) != vertices.end();
    });
  });
  return s;
}

double area_of(const LeafletSheet &sheet) {
  double area = 0;
  for (const Tri &t : sheet.triangles) area += triangle_area(sheet.x, t);
  return area;
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
      CHECK(find(findings, "atrium")->confidence > 0.9);
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
      x += 0.346e-3 * Vec3(next_share(state), next_share(state), next_share(state));
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
  // LPS for RAS
  for (Vec3 &x : landmarks.annulus) x = Vec3(0.1, 0.1, 0) - x;
  CHECK_THROWS_WITH_AS(rims_of(s, landmarks, other), doctest::Contains("LPS or RAS"), Error);
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
  CHECK(find(findings, "atrium")->value[2] == doctest::Approx(1));
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

TEST_CASE("shape_of_a_circle_is_that_of_the_circle") {
  const LeafletSheet sheet = cleaned(funnel(200, 8));
  const LoopShape shape = shape_of(sheet, boundary_loops(sheet)[0]);
  const double pi = 3.14159265358979;
  // a polygon of 200 sides: short by pi^2 / (6 n^2) of the length, 4 times that of the area
  CHECK(shape.length == doctest::Approx(2 * pi * 16e-3).epsilon(5e-5));
  CHECK(shape.area.norm() == doctest::Approx(pi * 256e-6).epsilon(2e-4));
  CHECK(shape.centre.norm() < 1e-15);
  CHECK(shape.turning == doctest::Approx(1));
}

TEST_CASE("find_rims_fills_holes") {
  const ParametricSheet p = parametric_sheet(1600);
  const double area = area_of(p.sheet);
  const std::vector<uint8_t> rim = [&] {
    std::vector<uint8_t> marks = marks_of(p.rims.annulus, p.sheet.x.size());
    for (const uint32_t i : p.rims.free_edge) marks[i] = 1;
    return marks;
  }();
  // three vertices inside, and one hole of several stars
  std::vector<uint32_t> inside;
  for (uint32_t i = 0; i < p.sheet.x.size() && inside.size() < 3; i += 97) {
    bool far = true;
    for (uint32_t j = 0; j < p.sheet.x.size(); ++j) {
      if (rim[j] != 0) far = far && (p.sheet.x[i] - p.sheet.x[j]).norm() > 4e-3;
    }
    if (far) inside.push_back(i);
  }
  REQUIRE(inside.size() == 3);
  std::vector<uint32_t> removed = inside;
  for (uint32_t j = 0; j < p.sheet.x.size(); ++j) {
    if ((p.sheet.x[j] - p.sheet.x[inside[2]]).norm() < 2e-3) removed.push_back(j);
  }
  Findings findings;
  LeafletSheet sheet = cleaned(without_stars(surface_of(p.sheet), removed));
  sheet.thickness.assign(sheet.x.size(), 1.1e-3);
  sheet.label.assign(sheet.triangles.size(), LeafletLabel::posterior);
  const double open_area = area_of(sheet);
  const SheetRims rims = find_rims(sheet, {}, findings);
  CHECK(rims.annulus.size() == p.rims.annulus.size());
  const Finding *filled = find(findings, "filled_holes");
  REQUIRE(filled);
  CHECK(filled->value.size() == 3);
  // a chord of a curved patch: the hole is 6 mm across, the leaflet has a radius of 10 mm and more
  CHECK(area - open_area > 15e-6);
  CHECK(area_of(sheet) == doctest::Approx(area).epsilon(0.05 * (area - open_area) / area));
  CHECK(sheet.thickness.size() == sheet.x.size());
  CHECK(sheet.label.size() == sheet.triangles.size());
  for (const double t : sheet.thickness) CHECK(t == doctest::Approx(1.1e-3));
  for (const LeafletLabel l : sheet.label) CHECK(l == LeafletLabel::posterior);
  CHECK(boundary_loops(sheet).size() == 2);
  // the filling has sides like those around it
  const double side = std::sqrt(area / double(p.sheet.triangles.size()) * 4 / std::sqrt(3.0));
  for (const Tri &t : sheet.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      CHECK((sheet.x[t[(k + 1) % 3]] - sheet.x[t[k]]).norm() < 2.5 * side);
    }
  }
}

TEST_CASE("find_rims_keeps_a_torn_rim_as_one_boundary") {
  const ParametricSheet p = parametric_sheet(1600);
  std::vector<uint32_t> torn(p.rims.free_edge.begin() + 10, p.rims.free_edge.begin() + 16);
  torn.insert(torn.end(), p.rims.annulus.begin() + 20, p.rims.annulus.begin() + 23);
  LeafletSheet sheet = cleaned(without_stars(surface_of(p.sheet), torn));
  Findings findings;
  const SheetRims rims = find_rims(sheet, {}, findings);
  CHECK(boundary_loops(sheet).size() == 2);
  CHECK(rims.annulus.size() > p.rims.annulus.size() - 4);
  CHECK(shape_of(sheet, rims.annulus).length ==
        doctest::Approx(shape_of(p.sheet, p.rims.annulus).length).epsilon(0.1));
}

TEST_CASE("find_rims_refuses_surfaces_without_two_rims") {
  const Surface whole = funnel(48, 12);
  Findings findings;
  // a hole 1/6 of the way around is no small one
  std::vector<uint32_t> window;
  for (uint32_t j = 3; j < 9; ++j) {
    for (uint32_t i = 0; i < 10; ++i) window.push_back(48 * j + i);
  }
  CHECK_THROWS_WITH_AS(rims_of(without_stars(whole, window), {}, findings),
                       doctest::Contains("3 boundaries: 10"), Error);
  // a strip from rim to rim is missing
  std::vector<uint32_t> strip;
  for (uint32_t j = 0; j <= 12; ++j) strip.push_back(48 * j);
  CHECK_THROWS_WITH_AS(rims_of(without_stars(whole, strip), {}, findings),
                       doctest::Contains("one boundary"), Error);
  // both rims are closed by fans
  Surface closed = whole;
  closed.x.push_back({0, 0, 1e-3});
  closed.x.push_back({0, 0, -13e-3});
  for (uint32_t i = 0; i < 48; ++i) {
    const uint32_t j = (i + 1) % 48;
    closed.triangles.push_back({j, i, static_cast<uint32_t>(whole.x.size())});
    closed.triangles.push_back(
        {12 * 48 + i, 12 * 48 + j, static_cast<uint32_t>(whole.x.size() + 1)});
  }
  CHECK_THROWS_WITH_AS(rims_of(closed, {}, findings), doctest::Contains("give it as skin"), Error);
}

TEST_CASE("find_rims_counts_handles") {
  // a tube joins two windows on opposite sides
  Surface s = without_stars(funnel(48, 12), {48 * 6, 48 * 6 + 24});
  LeafletSheet sheet = cleaned(s);
  std::vector<std::vector<uint32_t>> windows;
  for (const std::vector<uint32_t> &loop : boundary_loops(sheet)) {
    if (loop.size() == 6) windows.push_back(loop);
  }
  REQUIRE(windows.size() == 2);
  const std::vector<uint32_t> &a = windows[0];
  std::vector<uint32_t> b(windows[1].rbegin(), windows[1].rend());
  for (size_t k = 0; k < 6; ++k) {
    const size_t m = (k + 1) % 6;
    sheet.triangles.push_back({a[m], a[k], b[k]});
    sheet.triangles.push_back({a[m], b[k], b[m]});
  }
  Findings findings;
  CHECK_THROWS_WITH_AS(rims_of({sheet.x, sheet.triangles}, {}, findings),
                       doctest::Contains("1 handles"), Error);
}

TEST_CASE("find_rims_doubts_and_refuses_closed_leaflets") {
  // the free edge is pressed flat, to a width of `share`
  const auto pressed = [](double share) {
    Surface s = funnel(48, 12);
    for (Vec3 &x : s.x) x.y() *= 1 + (share - 1) * x.z() / -12e-3;
    return s;
  };
  Findings findings;
  CHECK_THROWS_WITH_AS(rims_of(pressed(0.05), {}, findings), doctest::Contains("to be closed"),
                       Error);
  rims_of(pressed(0.2), {}, findings);
  CHECK(find(findings, "orifice")->confidence < 0.9);
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
  CHECK(find(findings, "atrium")->confidence == 1);
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

TEST_CASE("find_rims_recognises_a_real_valve_that_is_closed") {
  for (const std::string level : {"N32", "N64"}) {
    const nlohmann::json json = read_real_valve("kaiser_mitral_normal_1/" + level + ".json");
    if (json.is_null()) {
      MESSAGE("skipped: no kaiser_mitral_normal_1 in MVS_TEST_DATA or ../shared/data");
      return;
    }
    Valve valve = kaiser_valve(json);
    for (size_t i = 0; i < json["vertices_pressurized"].size(); ++i) {
      valve.rest[i] = in_metres(json["vertices_pressurized"][i]);
    }
    Findings findings;
    const Surface closed = {valve.rest, valve.triangles};
    // the coarse one has a slit of 0.8 mm, the other one of 2.1 mm
    if (level == "N32") {
      CHECK_THROWS_WITH_AS(rims_of(closed, {}, findings), doctest::Contains("closed"), Error);
    } else {
      rims_of(closed, {}, findings);
      CHECK(find(findings, "orifice")->confidence < 0.75);
    }
  }
}
