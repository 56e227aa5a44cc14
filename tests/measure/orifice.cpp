// The orifice against shapes with a known opening.
#include "measure/orifice/orifice.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/sides.h"
#include "tests/measure/shapes.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr double mm = 1e-3, mm2 = 1e-6;

double flat(double, double) {
  return 0;
}

constexpr double seal = 0.6 * mm;  // the contact thickness that the expectations below assume

Valve sealing(const mvs::core::test::Sheet &sheet) {
  Valve valve = valve_of(sheet);
  valve.contact_thickness = seal;
  return valve;
}

double orifice_area(const Valve &valve) {
  const ModelPtr model = make_model(valve);
  return measure_orifice(*model, model->valve.rest).area;
}

// The area of a regular polygon on a circle: the exact opening of a round hole in a mesh.
double polygon_area(double radius, size_t corners) {
  const double n = static_cast<double>(corners);
  return 0.5 * n * radius * radius * std::sin(2 * pi / n);
}

// Leaflets whose free edges, half ellipses seen from the side, reach over each other by 2 * reach
// where `gap` is the distance between them in the middle: lens-shaped seen along the sheets, and
// closed seen from above.
mvs::core::test::Sheet overlap(double gap, double reach) {
  mvs::core::test::Sheet sheet;
  sheet.around = 96;
  sheet.rings = 24;
  sheet.at = [=](double angle, double s) -> Vec3 {
    const double c = std::cos(angle), flat_from = 0.4, there = std::min(1.0, s / flat_from);
    const double from = 16 * mm * c, to = -reach * c;
    // the last term only keeps the triangles at the commissures from having no area
    const double half_width = (16 - 2 * there - 0.02 * s) * mm;
    return {from + s * (to - from), half_width * std::sin(angle), 0.5 * gap * c * there};
  };
  return sheet;
}

// The part of an ellipse gap * width / 2 high and wide, where it is higher than `seal`.
double lens_area(double gap, double half_width) {
  const int steps = 100000;
  double area = 0;
  for (int i = 0; i < steps; ++i) {
    const double y = half_width * (2 * (i + 0.5) / steps - 1);
    const double height = gap * std::sqrt(1 - y * y / (half_width * half_width));
    if (height > seal) area += height * 2 * half_width / steps;
  }
  return area;
}

// A flat disc with a straight slit from side to side, nodes at the corners of the slit.
mvs::core::test::Sheet slit(double width, double length) {
  mvs::core::test::Sheet sheet;
  sheet.around = 72;
  sheet.rings = 16;
  sheet.at = [=](double angle, double s) -> Vec3 {
    // 72 steps along the slit's rim: 4 on each short side, 32 on each long one
    const double step = std::round(72 * angle / (2 * pi)), p = step < 70 ? step : step - 72;
    double x, y;
    if (p <= 2) {
      x = 0.5 * length, y = width * p / 4;
    } else if (p <= 34) {
      x = length * (0.5 - (p - 2) / 32), y = 0.5 * width;
    } else if (p <= 38) {
      x = -0.5 * length, y = width * (36 - p) / 4;
    } else {
      x = length * ((p - 38) / 32 - 0.5), y = -0.5 * width;
    }
    const double r = 16 * mm;
    return {r * (1 - s) * std::cos(angle) + s * x, r * (1 - s) * std::sin(angle) + s * y, 0};
  };
  return sheet;
}

// Every rim of the triangles, as a set of edges.
std::vector<Edge> rim_of(const std::vector<Tri> &triangles) {
  std::vector<Edge> rim;
  const std::vector<Side> sides = sorted_sides(triangles);
  for_each_edge(sides, [&](size_t first, size_t last) {
    if (last == first + 1) rim.push_back(sides[first].edge);
  });
  return rim;
}

}  // namespace

TEST_CASE("a_round_hole_has_its_area") {
  for (const double radius : {0.4 * mm, 0.7 * mm, 1.5 * mm, 3 * mm, 6 * mm, 12 * mm}) {
    const double area = orifice_area(sealing(disc(16 * mm, radius, flat)));
    // the mesh has the polygon as its rim and the surface is flat: only rounding is left
    CHECK(area == about(polygon_area(radius, 48), 1e-4));
    CHECK(area == about(pi * radius * radius, 0.01));
  }
}

TEST_CASE("a_hole_narrower_than_the_contact_thickness_is_closed") {
  CHECK(orifice_area(sealing(disc(16 * mm, 0.28 * mm, flat))) == 0);
  Valve valve = sealing(disc(16 * mm, 0.7 * mm, flat));
  CHECK(orifice_area(valve) > 0);
  valve.contact_thickness = 1.5 * mm;
  CHECK(orifice_area(valve) == 0);
}

TEST_CASE("a_slit_has_width_times_length") {
  for (const double width : {0.8 * mm, 1 * mm, 2 * mm, 4 * mm}) {
    const double area = orifice_area(sealing(slit(width, 14 * mm)));
    // A ball of the contact thickness d does not reach into corners: (1 - pi / 4) d2 = 0.08 mm2 of
    // the slit. On samples it loses triangles with legs up to d: at most 0.18 mm2 in each of four.
    CHECK(area < width * 14 * mm);
    CHECK(width * 14 * mm - area < 0.4 * mm2);
  }
  CHECK(orifice_area(sealing(slit(0.5 * mm, 14 * mm))) == 0);
}

TEST_CASE("less_of_a_slit_is_lost_in_its_corners_with_thinner_contact") {
  Valve valve = sealing(slit(2 * mm, 14 * mm));
  double previous = 0.03;
  for (const double d : {1.2 * mm, 0.6 * mm, 0.3 * mm}) {  // it sets the spacing of the samples
    valve.contact_thickness = d;
    const double error = 1 - orifice_area(valve) / (28 * mm2);
    CHECK(error > 0);
    CHECK(error < previous);
    previous = 0.5 * error;  // it falls with the square
  }
}

TEST_CASE("holes_are_summed") {
  mvs::core::test::Sheet sheet = disc(16 * mm, 2 * mm, flat);
  sheet.around = 24;
  sheet.rings = 6;
  Valve valve = sealing(sheet);
  double expected = polygon_area(2 * mm, 24);
  // two cells of the mesh, each of two triangles, far from each other in the third ring
  for (const size_t t : {2u * 48u + 35u, 2u * 48u + 34u, 2u * 48u + 11u, 2u * 48u + 10u}) {
    expected += triangle_area(valve.rest, valve.triangles[t]);
    valve.triangles.erase(valve.triangles.begin() + static_cast<std::ptrdiff_t>(t));
    valve.triangle_leaflet.erase(valve.triangle_leaflet.begin() + static_cast<std::ptrdiff_t>(t));
  }
  // a ball of 0.6 mm does not reach into corners: 0.08 mm2 of each cell, at a spacing of 0.3 mm
  CHECK(orifice_area(valve) == about(expected, 0.02));
  CHECK(orifice_area(valve) > polygon_area(2 * mm, 24) + 6 * mm2);
}

TEST_CASE("overlapping_leaflets_leak_through_the_gap_between_them") {
  for (const double gap : {1 * mm, 1.5 * mm, 3 * mm}) {
    const double expected = lens_area(gap, 14 * mm);
    // the ends, closed where lower than d, move by about a spacing of the samples (0.45 mm)
    CHECK(orifice_area(sealing(overlap(gap, 3 * mm))) == about(expected, 0.03));
  }
}

TEST_CASE("leaflets_within_the_contact_thickness_are_sealed") {
  for (const double gap : {0.1 * mm, 0.2 * mm, 0.4 * mm, 0.58 * mm}) {
    for (const double reach : {1 * mm, 3 * mm}) {
      const ModelPtr model = make_model(sealing(overlap(gap, reach)));
      const Orifice orifice = measure_orifice(*model, model->valve.rest);
      CHECK(orifice.area == 0);
      CHECK(orifice.triangles.empty());
      CHECK(orifice.vertices.empty());
    }
  }
}

TEST_CASE("a_funnel_is_measured_at_its_smallest_cross_section") {
  mvs::core::test::Sheet funnel;  // its free edge is the narrowest place
  funnel.at = [](double angle, double s) -> Vec3 {
    const double r = (16 - 8 * s) * mm;
    return {r * std::cos(angle), r * std::sin(angle), -15 * mm * s};
  };
  CHECK(orifice_area(sealing(funnel)) == about(polygon_area(8 * mm, 48), 1e-3));
  mvs::core::test::Sheet hourglass = funnel;  // here that is half way down
  hourglass.at = [](double angle, double s) -> Vec3 {
    const double r = (8 + 32 * (s - 0.5) * (s - 0.5)) * mm;
    return {r * std::cos(angle), r * std::sin(angle), -15 * mm * s};
  };
  // the surface dips through nodes of the waist, whose rows are 1.25 mm apart
  CHECK(orifice_area(sealing(hourglass)) == about(polygon_area(8 * mm, 48), 5e-3));
}

TEST_CASE("an_oblique_tube_is_measured_by_its_cross_section_not_its_mouth") {
  // a round tube that leaves the plane of the annulus at 45 degrees: cut level, it is an ellipse
  const double radius = 5 * mm;
  mvs::core::test::Sheet tube;
  tube.rings = 24;
  tube.at = [=](double angle, double s) -> Vec3 {
    const double c = std::cos(angle), n = std::sin(angle), mouth = radius * std::sqrt(2.0);
    const double u = std::min(1.0, s / 0.3), down = 15 * mm * std::max(0.0, (s - 0.3) / 0.7);
    const double x = (16 * mm * (1 - u) + mouth * u) * c, y = (16 * mm * (1 - u) + radius * u) * n;
    return {x + down, y, -down};
  };
  const double section = pi * radius * radius;
  // a polygon of 48 corners (0.3 %), and nodes that only nearly lie across the tube
  CHECK(orifice_area(sealing(tube)) == about(section, 0.02));
}

TEST_CASE("the_orifice_on_a_saddle_is_a_minimal_surface") {
  // height a cos(2 angle) on the rim: area pi r2 + pi a2 to second order, the next term is 1 % of
  // a2
  const double radius = 5 * mm, a = 0.5 * mm, curvature = a / (radius * radius);
  const auto saddle = [=](double x, double y) { return curvature * (x * x - y * y); };
  const double expected = polygon_area(radius, 48) + pi * a * a;
  CHECK(orifice_area(sealing(disc(16 * mm, radius, saddle))) == about(expected, 2e-3));
}

TEST_CASE("the_area_is_invariant_under_rigid_motion") {
  for (const mvs::core::test::Sheet &sheet :
       {overlap(1.5 * mm, 3 * mm), slit(1 * mm, 14 * mm), disc(16 * mm, 3 * mm, flat)}) {
    const ModelPtr model = make_model(sealing(sheet));
    const std::vector<Vec3> &x = model->valve.rest;
    const double area = measure_orifice(*model, x).area;
    const double there = measure_orifice(*model, moved(x, some_rigid_motion())).area;
    CHECK(area > 0);
    // the samples are placed in the valve's frame; rounding may choose other diagonals of them
    CHECK(there == about(area, 2e-3));
  }
}

TEST_CASE("a_finer_mesh_of_the_same_shape_has_the_same_orifice") {
  mvs::core::test::Sheet sheet = overlap(1.5 * mm, 3 * mm);
  const double coarse = orifice_area(sealing(sheet));
  sheet.around *= 2;
  sheet.rings *= 2;
  CHECK(orifice_area(sealing(sheet)) == about(coarse, 0.02));
}

TEST_CASE("the_returned_surface_has_the_area_and_its_rim_on_the_leaflets") {
  const ModelPtr model = make_model(sealing(disc(16 * mm, 3 * mm, flat)));
  const Orifice orifice = measure_orifice(*model, model->valve.rest);
  double area = 0;
  Vec3 normal = Vec3::Zero();
  for (const Tri &t : orifice.triangles) {
    area += triangle_area(orifice.vertices, t);
    normal += (orifice.vertices[t[1]] - orifice.vertices[t[0]])
                  .cross(orifice.vertices[t[2]] - orifice.vertices[t[0]]);
  }
  CHECK(area == about(orifice.area, 1e-12));
  CHECK(normal.z() == about(2 * area, 1e-6));  // all face the atrium
  const std::vector<Edge> rim = rim_of(orifice.triangles);
  CHECK(rim.size() >= 48);
  for (const Edge &edge : rim) {
    for (const uint32_t v : edge) {
      const double r = orifice.vertices[v].norm();
      CHECK(r <= 3 * mm * (1 + 1e-6));
      CHECK(r >= 3 * mm * std::cos(pi / 48) * (1 - 1e-6));
    }
  }
}

TEST_CASE("the_orifice_is_deterministic") {
  const ModelPtr model = make_model(sealing(overlap(1.5 * mm, 3 * mm)));
  const Orifice a = measure_orifice(*model, model->valve.rest);
  const Orifice b = measure_orifice(*model, model->valve.rest);
  CHECK(a.area == b.area);
  CHECK(a.triangles == b.triangles);
  CHECK(std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin()));
}
