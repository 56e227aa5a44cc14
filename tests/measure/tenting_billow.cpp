// Tenting and billow against closed forms.
#include "measure/tenting/tenting_billow.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/measure/shapes.h"

namespace mvs::core::test {
namespace {

constexpr double radius = 18e-3, depth = 5e-3;

// The polygon of 96 sides loses 0.07 % of the circle, the rings of 0.7 mm 0.1 % of the bowl's
// volume; the loss by the pinhole of 0.05 mm is negligible.
constexpr double meshed = 3e-3;

Sheet bowl(double height, double saddle = 0) {
  Sheet sheet = disc(radius, 0.05e-3, [=](double x, double y) {
    const double r2 = (x * x + y * y) / (radius * radius);
    return height * (1 - r2) + 0.5 * saddle * (x * x - y * y) / (radius * radius);
  });
  sheet.around = 96;
  sheet.rings = 26;
  return sheet;
}

TentingBillow tenting_billow_of(const Sheet &sheet) {
  const ModelPtr model = model_of(sheet);
  return measure_tenting_billow(*model, model->valve.rest);
}

}  // namespace

TEST_CASE("a_bowl_tents_by_its_paraboloid") {
  const TentingBillow measured = tenting_billow_of(bowl(-depth));
  // the ball sinks 0.004 mm into the pinhole
  CHECK(measured.tenting_height == about(depth, 1e-3));
  CHECK(measured.tenting_area == about(4.0 / 3 * radius * depth, meshed));
  CHECK(measured.tenting_volume == about(0.5 * pi * radius * radius * depth, meshed));
  CHECK(measured.billow_height == 0);
  // on the rim the ball has less room, and bridges a few micrometres of the bowl
  CHECK(measured.billow_volume < 1e-5 * measured.tenting_volume);
}

TEST_CASE("a_dome_billows_by_its_paraboloid") {
  const TentingBillow measured = tenting_billow_of(bowl(depth));
  CHECK(measured.billow_height == about(depth, 1e-3));
  CHECK(measured.billow_volume == about(0.5 * pi * radius * radius * depth, meshed));
  CHECK(measured.tenting_height == 0);
  CHECK(measured.tenting_area == 0);
  CHECK(measured.tenting_volume == 0);
}

TEST_CASE("a_sheet_on_its_saddle_neither_tents_nor_billows") {
  const TentingBillow measured = tenting_billow_of(bowl(0, 6e-3));
  // 24 rings of elements follow the saddle to 1 um where it is steepest
  CHECK(measured.billow_height < 5e-6);
  CHECK(measured.tenting_volume < 5e-6 * pi * radius * radius);
  CHECK(measured.billow_volume < 5e-6 * pi * radius * radius);
}

TEST_CASE("volumes_are_measured_from_the_saddle_not_from_the_plane") {
  const TentingBillow measured = tenting_billow_of(bowl(-depth, 6e-3));
  CHECK(measured.tenting_volume == about(0.5 * pi * radius * radius * depth, meshed));
  CHECK(measured.tenting_area == about(4.0 / 3 * radius * depth, meshed));
  CHECK(measured.billow_height < 5e-6);
}

TEST_CASE("half_a_valve_can_tent_while_the_other_billows") {
  Sheet sheet = disc(radius, 0.05e-3, [](double x, double y) {
    return depth * x / radius * (1 - (x * x + y * y) / (radius * radius));
  });
  sheet.around = 96;
  sheet.rings = 26;
  const TentingBillow measured = tenting_billow_of(sheet);
  CHECK(measured.billow_volume == about(4.0 / 15 * depth * radius * radius, meshed));
  CHECK(measured.tenting_volume == about(4.0 / 15 * depth * radius * radius, meshed));
  const double highest = depth * 2 / (3 * std::sqrt(3.0));
  CHECK(measured.billow_height == about(highest, 1e-3));  // nodes every 0.7 mm see the flat top
  CHECK(measured.tenting_height == about(highest, 1e-3));
}

TEST_CASE("tissue_below_the_coaptation_line_does_not_tent") {
  const auto closed = [](double wall) {
    Sheet sheet;
    sheet.around = 96;
    sheet.rings = 24;
    sheet.at = [=](double angle, double s) -> Vec3 {
      const Vec3 rim(14e-3 * std::cos(angle), 18e-3 * std::sin(angle), 0);
      const double side = std::clamp(1e3 * std::cos(angle), -1.0, 1.0);
      const Vec3 line(0.25e-3 * side, 14e-3 * std::sin(angle), -4e-3);
      const double belly = std::min(1.0, 2 * s), down = std::max(0.0, 2 * s - 1) * wall;
      return (1 - belly) * rim + belly * line - Vec3(0, 0, down);
    };
    return sheet;
  };
  const TentingBillow little = tenting_billow_of(closed(2e-3)),
                      lot = tenting_billow_of(closed(9e-3));
  // the ball of 0.6 mm rests on both edges of the gap of 0.5 mm, and sinks 0.13 mm into it
  const double ball = 0.5 * contact_thickness;
  const double sunk = ball - std::sqrt(ball * ball - 0.25e-3 * 0.25e-3);
  CHECK(little.tenting_height == about(4e-3 + sunk, 1e-9));
  CHECK(lot.tenting_height == about(4e-3 + sunk, 1e-9));
  CHECK(lot.tenting_volume == about(little.tenting_volume, 2e-3));
  CHECK(lot.tenting_area == about(0.5 * 28e-3 * 4e-3, 0.02));  // a triangle, but for the gap
}

TEST_CASE("tenting_and_billow_are_invariant_under_motion_and_renumbering") {
  const Valve valve = valve_of(bowl(-depth, 6e-3));
  const ModelPtr model = make_model(valve);
  const TentingBillow still = measure_tenting_billow(*model, valve.rest);
  const auto check_same = [&](const TentingBillow &other) {
    // rounding of 0.3 m against heights of 5 mm; a cell on the very rim is 1e-8 of the volume
    CHECK(other.tenting_height == about(still.tenting_height, 1e-8));
    CHECK(other.tenting_area == about(still.tenting_area, 1e-8));
    CHECK(other.tenting_volume == about(still.tenting_volume, 1e-6));
  };
  check_same(measure_tenting_billow(*model, moved(valve.rest, some_rigid_motion())));
  const Renumbered other = renumbered(valve);
  check_same(measure_tenting_billow(*other.model, other(valve.rest)));
}

// The sheet is moved across the raster in steps of a thousandth of a cell: samples at centres of
// cells would give volumes in steps, exact sections give a line. A hanging wall under an
// overhanging edge.
TEST_CASE("the_volume_under_an_overhang_is_linear_in_its_place") {
  const auto volume = [](double shift) {
    Sheet sheet;
    sheet.around = 96;
    sheet.rings = 24;
    sheet.at = [=](double angle, double s) -> Vec3 {
      const Vec3 rim(14e-3 * std::cos(angle), 18e-3 * std::sin(angle), 0);
      const Vec3 line(0.2e-3 * std::cos(angle) + shift, 14e-3 * std::sin(angle), -4e-3);
      const double belly = std::min(1.0, 2 * s), down = std::max(0.0, 2 * s - 1);
      // the side of +x overhangs the other one by 2 mm
      const double over = std::cos(angle) > 0 ? -2e-3 * down * std::cos(angle) : 0;
      return (1 - belly) * rim + belly * line + Vec3(over, 0, -3e-3 * down);
    };
    return tenting_billow_of(sheet).tenting_volume;
  };
  constexpr double cell = 28e-3 / 256;
  const double first = volume(0), last = volume(cell);
  for (int k = 1; k < 8; ++k) {
    const double share = k / 8.0, line = (1 - share) * first + share * last;
    // what remains is the corner that the ball leaves below the edge, in cells
    CHECK(volume(share * cell) == about(line, 3e-4));
  }
}

}  // namespace mvs::core::test
