// The frame and the annulus against closed forms: circles, ellipses, saddles.
#include "measure/annulus/annulus.h"

#include <doctest/doctest.h>

#include <cmath>

#include "measure/annulus/annulus_map.h"
#include "measure/annulus/frame.h"
#include "measure/annulus/landmarks.h"
#include "tests/measure/shapes.h"

namespace mvs::core::test {
namespace {

constexpr double radius = 18e-3;

Sheet flat_ring() {
  return disc(radius, 6e-3, [](double, double) { return 0.0; });
}

// Saddle height h on a circle: the rim is at h / 2 cos 2 angle.
Sheet saddle(double h, size_t around = 96) {
  Sheet sheet = disc(radius, 6e-3, [=](double x, double y) {
    return 0.5 * h * (x * x - y * y) / (radius * radius);
  });
  sheet.around = around;
  return sheet;
}

double largest_difference(const AnnulusMeasures &l, const AnnulusMeasures &r) {
  const double lengths =
      std::max({std::abs(l.ap - r.ap), std::abs(l.cc - r.cc), std::abs(l.perimeter - r.perimeter),
                std::abs(l.saddle_height - r.saddle_height)});
  return std::max({lengths, std::abs(l.area - r.area), std::abs(l.area_3d - r.area_3d),
                   std::abs(l.nonplanar_angle - r.nonplanar_angle)});
}

}  // namespace

TEST_CASE("frame_of_a_level_valve_is_aligned_with_its_axes") {
  const ModelPtr model = model_of(saddle(6e-3));
  const Frame frame = valve_frame(*model, model->valve.rest);
  // rounding of sums over 96 points of 18 mm
  CHECK((frame.axes - Mat3::Identity()).norm() < 1e-14);
  CHECK(frame.origin.norm() < 1e-16);
}

TEST_CASE("frame_origin_weighs_by_arc_length_not_by_nodes") {
  Sheet sheet = flat_ring();
  const auto even = sheet.at;
  // angles crowd towards 0, the circle stays
  sheet.at = [=](double angle, double s) { return even(angle - 0.5 * std::sin(angle), s); };
  sheet.around = 400;
  const ModelPtr model = model_of(sheet);
  // the polygon's sagitta at its longest side (0.42 mm) shifts the centroid by under 2 um;
  // the mean of the nodes lies 4.4 mm off
  CHECK(valve_frame(*model, model->valve.rest).origin.norm() < 2e-6);
}

TEST_CASE("frame_turns_with_the_valve") {
  const ModelPtr model = model_of(saddle(6e-3));
  const RigidMotion motion = some_rigid_motion();
  const Frame still = valve_frame(*model, model->valve.rest);
  const Frame turned = valve_frame(*model, moved(model->valve.rest, motion));
  CHECK((turned.axes - still.axes * motion.turn.transpose()).norm() < 1e-13);
  CHECK((turned.origin - motion(still.origin)).norm() < 1e-15);
}

TEST_CASE("frame_is_fixed_while_leaflets_move") {
  const ModelPtr model = model_of(saddle(6e-3));
  std::vector<Vec3> x = model->valve.rest;
  const Frame before = valve_frame(*model, x);
  for (size_t n = model->valve.annulus.size(); n < x.size(); ++n) x[n] += Vec3(1e-3, 2e-3, 40e-3);
  const Frame after = valve_frame(*model, x);
  CHECK(after.axes == before.axes);
  CHECK(after.origin == before.origin);
}

TEST_CASE("frame_axis_points_into_the_atrium_for_either_order_of_the_annulus") {
  Valve valve = valve_of(saddle(6e-3));
  std::reverse(valve.annulus.begin(), valve.annulus.end());
  const ModelPtr model = make_model(valve);
  CHECK((valve_frame(*model, model->valve.rest).axes - Mat3::Identity()).norm() < 1e-13);
}

TEST_CASE("circle_is_measured_as_its_polygon") {
  const Sheet sheet = flat_ring();
  const double n = static_cast<double>(sheet.around);
  const ModelPtr model = model_of(sheet);
  const AnnulusMeasures measures = measure_annulus(*model, model->valve.rest);
  // rounding only: everything here is a sum over 48 sides
  CHECK(measures.perimeter == about(2 * n * radius * std::sin(pi / n), 1e-13));
  CHECK(measures.area == about(0.5 * n * radius * radius * std::sin(2 * pi / n), 1e-13));
  CHECK(measures.area_3d == about(measures.area, 1e-12));
  CHECK(measures.ap == about(2 * radius, 1e-13));
  CHECK(measures.cc == about(2 * radius, 1e-13));
  CHECK(measures.saddle_height < 1e-16);
  CHECK(measures.nonplanar_angle == about(pi, 1e-12));
}

TEST_CASE("ellipse_has_its_two_diameters") {
  const double a = 13e-3, b = 18e-3;
  Sheet sheet;
  sheet.at = [=](double angle, double s) -> Vec3 {
    return (1 - 0.6 * s) * Vec3(a * std::cos(angle), b * std::sin(angle), 0);
  };
  const ModelPtr model = model_of(sheet);
  const AnnulusMeasures measures = measure_annulus(*model, model->valve.rest);
  const double n = static_cast<double>(sheet.around);
  CHECK(measures.ap == about(2 * a, 1e-13));
  CHECK(measures.cc == about(2 * b, 1e-13));
  CHECK(measures.area == about(0.5 * n * a * b * std::sin(2 * pi / n), 1e-13));
  CHECK(measures.area_3d == about(measures.area, 1e-12));
}

TEST_CASE("commissures_are_where_the_leaflet_changes") {
  Sheet sheet = flat_ring();
  sheet.anterior = pi / 3;
  const ModelPtr model = model_of(sheet);
  const AnnulusMeasures measures = measure_annulus(*model, model->valve.rest);
  CHECK(measures.cc == about(2 * radius * std::sin(pi / 3), 1e-13));
  CHECK(measures.ap == about(2 * radius, 1e-13));
}

TEST_CASE("saddle_has_its_height_angle_and_film_area") {
  const double h = 7e-3;
  const ModelPtr model = model_of(saddle(h, 192));
  const AnnulusMeasures measures = measure_annulus(*model, model->valve.rest);
  CHECK(measures.saddle_height == about(h, 1e-12));
  CHECK(measures.nonplanar_angle == about(pi - 2 * std::atan(h / radius), 1e-12));
  // z = c (x^2 - y^2) is harmonic: its area over the disc, with slope 2 c r
  const double g = h / radius;
  const double film = 2 * pi * radius * radius * (std::pow(1 + g * g, 1.5) - 1) / (3 * g * g);
  // 192 sides lose 1.8e-4 of the disc's area, 24 rings 1e-4 of the bulge
  CHECK(measures.area_3d == about(film, 3e-4));
  CHECK(measures.area_3d > measures.area);
}

TEST_CASE("annulus_measures_survive_motion_and_renumbering") {
  Sheet sheet = saddle(6e-3);
  sheet.anterior = pi / 3;
  const Valve valve = valve_of(sheet);
  const ModelPtr model = make_model(valve);
  const AnnulusMeasures before = measure_annulus(*model, valve.rest);
  const AnnulusMeasures after = measure_annulus(*model, moved(valve.rest, some_rigid_motion()));
  // rounding of coordinates of 0.3 m against lengths of 0.04 m
  CHECK(largest_difference(before, after) < 1e-13);
  const Renumbered other = renumbered(valve);
  CHECK(largest_difference(before, measure_annulus(*other.model, other(valve.rest))) < 1e-14);
}

TEST_CASE("annulus_of_one_leaflet_has_quarter_points") {
  Valve valve = valve_of(flat_ring());
  valve.leaflets.resize(1);
  std::fill(valve.triangle_leaflet.begin(), valve.triangle_leaflet.end(), 0u);
  const ModelPtr model = make_model(valve);
  const AnnulusMeasures measures = measure_annulus(*model, valve.rest);
  CHECK(measures.ap == about(2 * radius, 1e-13));
  CHECK(measures.cc == about(2 * radius, 1e-13));
  CHECK((valve_frame(*model, valve.rest).axes - Mat3::Identity()).norm() < 1e-13);
}

// Six annuli are more than are kept, so that some are taken from memory and some made anew.
TEST_CASE("a_kept_annulus_map_has_the_bits_of_a_new_one") {
  for (int k = 0; k < 18; ++k) {
    const ModelPtr model = model_of(saddle((k / 3 % 6 + 1) * 1e-3));
    const Frame frame = valve_frame(*model, model->valve.rest);
    const Loop loop(model->valve.annulus, model->valve.rest);
    const auto kept = annulus_map(frame, loop.points());
    const AnnulusMap made(frame, loop.points());
    CHECK(kept->area() == made.area());
    bool same = true;
    for (size_t c = 0; c < made.heights().size(); ++c) {
      same &= kept->inside(c) == made.inside(c);
      same &= !made.inside(c) || kept->heights()[c] == made.heights()[c];
    }
    CHECK(same);
  }
}

// Each side of the rim starts the search once, inside and outside of the annulus.
TEST_CASE("height_of_the_annulus_surface_does_not_depend_on_where_the_search_begins") {
  const ModelPtr model = model_of(saddle(6e-3, 24));
  const Frame frame = valve_frame(*model, model->valve.rest);
  const AnnulusSurface surface(frame, Loop(model->valve.annulus, model->valve.rest).points());
  for (int i = -12; i <= 12; ++i) {
    for (int j = -12; j <= 12; ++j) {
      const double u = 1.6e-3 * i, v = 1.6e-3 * j, height = surface.height(u, v);
      for (size_t begin = 0; begin < 24; ++begin) {
        size_t near = begin;
        const double found = surface.height(u, v, near);
        CHECK((found == height || (std::isnan(found) && std::isnan(height))));
      }
    }
  }
}

}  // namespace mvs::core::test
