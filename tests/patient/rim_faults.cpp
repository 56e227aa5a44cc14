// Notches and corners of rims of which flat triangles remained in the mesh, and their finding;
// findings that are doubtful.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/intersect.h"
#include "patient/doubtful.h"
#include "patient/mid_sheet.h"
#include "patient/patient_valve.h"
#include "patient/surface/mend_free_edge.h"
#include "patient/surface/rims.h"
#include "tests/patient/sheets.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr double one_degree = std::numbers::pi / 180;

// A band around the z axis with an annulus at z = 0, `round` columns and `rows` rows of sides
// `side`, whose free edge lies at -depth(x) for a distance x along it (m).
template <typename Depth>
SheetWithRims round_band(uint32_t round, uint32_t rows, double side, Depth depth) {
  SheetWithRims band;
  const double radius = side * round / (2 * std::numbers::pi);
  for (uint32_t j = 0; j <= rows; ++j) {
    for (uint32_t i = 0; i < round; ++i) {
      const double angle = 2 * std::numbers::pi * i / round;
      band.sheet.x.push_back({radius * std::cos(angle), radius * std::sin(angle),
                              -depth(side * (i - 0.5 * round)) * j / rows});
      if (j == rows) continue;
      const uint32_t a = j * round + i, b = j * round + (i + 1) % round;
      band.sheet.triangles.push_back({a, a + round, b + round});
      band.sheet.triangles.push_back({a, b + round, b});
    }
  }
  band.sheet.label.assign(band.sheet.triangles.size(), LeafletLabel::posterior);
  for (const auto &loop : loops_by_length(band.sheet)) {
    const bool is_annulus = loop[0] < round;
    (is_annulus ? band.rims.annulus : band.rims.free_edge) = loop;
  }
  return band;
}

double shortest_side(const LeafletSheet &sheet) {
  double least = 1;
  for (const Tri &t : sheet.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      least = std::min(least, (sheet.x[t[k]] - sheet.x[t[(k + 1) % 3]]).norm());
    }
  }
  return least;
}

bool doubtful(const char *name, FindingSource source, double confidence) {
  return is_doubtful({name, source, confidence, "", {}, ""});
}

}  // namespace

TEST_CASE("a_filled_notch_with_a_wide_mouth_has_no_folds_and_leaves_no_flat_triangles") {
  // A bell as at an indentation of labels, in a surface of much shorter sides than its mouth: with
  // the mouth as one side, vertices of the filling lay on it and in one place.
  constexpr double side = 0.12e-3, width = 5e-3, depth = 2.8e-3;
  SheetWithRims band = round_band(400, 60, side, [](double x) {
    const double bell = std::cos(std::numbers::pi * std::clamp(x / width, -0.5, 0.5));
    return 8e-3 - depth * bell * bell;
  });
  const size_t given = band.sheet.triangles.size();
  const std::vector<uint8_t> kept(band.sheet.x.size(), 0);
  band.sheet.thickness.assign(band.sheet.x.size(), 1.1e-3);
  const FilledNotches filled = fill_notches(band.sheet, band.rims.free_edge, kept);
  REQUIRE(filled.last.size() == 1);
  REQUIRE(filled.deepest > 1e-3);
  LeafletSheet filling;
  filling.x = band.sheet.x;
  for (size_t t = given; t < band.sheet.triangles.size(); ++t) {
    const Tri &tri = band.sheet.triangles[t];
    filling.triangles.push_back(tri);
    const Vec3 &a = filling.x[tri[0]], &b = filling.x[tri[1]], &c = filling.x[tri[2]];
    const Vec3 out(a.x() + b.x() + c.x(), a.y() + b.y() + c.y(), 0);
    REQUIRE((b - a).cross(c - a).dot(out) > 0);  // none is turned over
    CHECK(band.sheet.label[t] == LeafletLabel::posterior);
  }
  CHECK(shortest_side(filling) > 0.2 * side);
  for (const uint32_t i : band.rims.free_edge) {
    REQUIRE(std::abs(band.sheet.thickness[i] - 1.1e-3) < 1e-12);
  }
  REQUIRE(find_intersections(band.sheet.x, band.sheet.triangles).empty());
  for (const double edge : {1.2e-3, 1.6e-3}) {
    CAPTURE(edge);
    const RemeshReport report = remesh_sheet(band.sheet, band.rims, {edge}).report;
    CHECK(report.crossings == 0);
    CHECK(report.worst_angle > 25 * one_degree);
    CHECK(report.shortest > 0.4 * edge);
  }
}

TEST_CASE("a_corner_of_a_rim_with_a_vertex_of_three_triangles_behind_it_is_cut") {
  // p and q on the annulus are joined by a side inside; beyond it lie a vertex v of the annulus and
  // a vertex w with three triangles, which is folded over that side into the sheet. No collapse is
  // possible there: v and q have two neighbours in common, p and w.
  constexpr double side = 0.2e-3;
  for (const double edge : {0.6e-3, 1e-3, 1.5e-3}) {
    CAPTURE(edge);
    SheetWithRims band = round_band(200, 40, side, [](double) { return 40 * side; });
    LeafletSheet &sheet = band.sheet;
    const uint32_t p = band.rims.annulus[4], q = band.rims.annulus[5];
    const auto v = static_cast<uint32_t>(sheet.x.size()), w = v + 1;
    const auto beside = [&](double along, double up, double outward) {
      const Vec3 at = (1 - along) * sheet.x[p] + along * sheet.x[q];
      const Vec3 out = Vec3(at.x(), at.y(), 0).normalized();
      sheet.x.push_back(at + side * (outward * out + Vec3(0, 0, up)));
    };
    beside(0.26, 0.01, 0);
    beside(0.4, -0.16, 0.01);
    // the annulus passes from p to q as its triangles do
    for (const Tri &t : {Tri{p, v, w}, Tri{v, q, w}, Tri{q, p, w}}) {
      sheet.triangles.push_back(t);
      sheet.label.push_back(LeafletLabel::posterior);
    }
    band.rims.annulus.insert(band.rims.annulus.begin() + 5, v);
    REQUIRE(find_intersections(sheet.x, sheet.triangles).empty());
    const RemeshReport report = remesh_sheet(sheet, band.rims, {edge}).report;
    CHECK(report.crossings == 0);
    CHECK(report.worst_angle > 25 * one_degree);
    CHECK(report.shortest > 0.3 * edge);
  }
}

TEST_CASE("a_mesh_with_a_flat_triangle_or_a_tiny_side_is_a_doubtful_finding") {
  RemeshReport report;
  report.worst_angle = 31 * one_degree;
  report.worst_at = {0.01, 0, 0};
  report.shortest = 0.5e-3;
  report.shortest_at = {0.02, 0, 0};
  CHECK_FALSE(is_doubtful(mesh_finding(900, 1.8e-3, report)));
  CHECK(mesh_finding(900, 1.8e-3, report).confidence == 1);
  report.shortest = 0.03e-3;
  const Finding tiny = mesh_finding(900, 1.8e-3, report);
  CHECK(is_doubtful(tiny));
  CHECK(tiny.sentence.find("side is far too short near (20.0, 0.0, 0.0) mm") != std::string::npos);
  report.worst_angle = 4 * one_degree;
  const Finding flat = mesh_finding(900, 1.8e-3, report);
  CHECK(is_doubtful(flat));
  CHECK(flat.sentence.find("triangle is flat near (10.0, 0.0, 0.0) mm") != std::string::npos);
}

TEST_CASE("crossings_that_moved_points_far_are_a_doubtful_finding") {
  const auto finding = [](double move) { return crossings_finding({12, 0, move}); };
  CHECK_FALSE(is_doubtful(finding(0)));
  CHECK(finding(0).sentence.find("no point moved") != std::string::npos);
  CHECK_FALSE(is_doubtful(finding(1e-3)));
  CHECK(finding(2e-3).sentence.find("smooth the surface") != std::string::npos);
  CHECK(is_doubtful(finding(3e-3)));  // 0.9 / 3 is below a third
}

// As the steps of voxels do: a rim that spans 2.2 times the area of the other one, and is longer
// and more bent than its area asks for.
TEST_CASE("a_rough_annulus_is_not_taken_for_the_free_edge") {
  std::vector<std::array<double, 2>> profile;
  for (int row = 0; row <= 8; ++row) profile.push_back({18e-3 - 0.75e-3 * row, -2e-3 * row});
  SheetWithRims band = revolved(profile, 120);
  Findings smooth, rough;
  find_rims(band.sheet, {}, smooth);
  CHECK_FALSE(is_doubtful(*find_finding(smooth, "annulus")));
  std::mt19937 random(3);
  for (const uint32_t node : band.rims.annulus) {
    band.sheet.x[node].z() += 3e-3 * (static_cast<double>(random()) / 4294967295.0 - 0.5);
  }
  const SheetRims found = find_rims(band.sheet, {}, rough);
  CHECK(found.annulus.size() == 120);
  CHECK(band.sheet.x[found.annulus[0]].head<2>().norm() > 17e-3);
  const Finding &finding = *find_finding(rough, "annulus");
  CHECK(is_doubtful(finding));
  CHECK(finding.sentence.find("spans more, though") != std::string::npos);
}

TEST_CASE("given_landmarks_are_doubtful_sooner_than_guessed_ones") {
  for (const char *name : {"annulus", "commissures", "anterior"}) {
    CHECK(doubtful(name, FindingSource::given, 0.5));
    CHECK_FALSE(doubtful(name, FindingSource::given, 0.51));
    CHECK(doubtful(name, FindingSource::guessed, 0.25));
    CHECK_FALSE(doubtful(name, FindingSource::guessed, 0.26));
  }
}

TEST_CASE("findings_of_faults_are_doubtful_and_assumptions_are_not") {
  CHECK(doubtful("tall_leaflets", FindingSource::measured, 1));
  CHECK(doubtful("closed_fit", FindingSource::measured, 0.33));
  CHECK_FALSE(doubtful("closed_fit", FindingSource::measured, 0.34));
  CHECK_FALSE(doubtful("thickness", FindingSource::assumed, 0));
}
