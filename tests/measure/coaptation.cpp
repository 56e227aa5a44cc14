// Coaptation of closed shapes whose overlap is known.
#include "measure/coaptation/coaptation.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "measure/annulus/frame.h"
#include "tests/measure/shapes.h"

namespace mvs::core::test {
namespace {

Coaptation coaptation_of(const ClosedShape &closed) {
  const ModelPtr model = model_of(sheet_of(closed));
  return measure_coaptation(*model, model->valve.rest);
}

}  // namespace

TEST_CASE("parallel_walls_coapt_over_their_overlap") {
  ClosedShape closed;
  closed.anterior_wall = 8e-3;
  closed.posterior_wall = 5e-3;
  const Coaptation coaptation = coaptation_of(closed);
  const double overlap = 5e-3, width = 2 * closed.half_width;
  // samples are 0.25 mm apart, so a border is uncertain by that, in either direction: 1 % of the
  // area; the line loses half a percent of the area at either end
  CHECK(coaptation.area == about(overlap * width, 0.02));
  CHECK(coaptation.length_mean == about(overlap, 0.03));
  // a station has one border's error, and 15 degrees beyond the border (0.13 mm) still face the
  // wall
  CHECK(coaptation.length_max == about(overlap, 0.08));
  CHECK(coaptation.length_min == about(overlap, 0.08));
  // extents are of whole samples
  CHECK(std::abs(coaptation.height - overlap) < 0.3e-3);
  CHECK(std::abs(coaptation.depth - closed.depth) < 0.3e-3);
}

TEST_CASE("facing_nodes_store_their_distance") {
  const ModelPtr model = model_of(sheet_of({}));
  const Coaptation coaptation = measure_coaptation(*model, model->valve.rest);
  size_t facing = 0;
  for (size_t n = 0; n < model->node_count(); ++n) {
    const Vec3 &p = model->valve.rest[n];
    const bool on_wall = p[2] < -5e-3 && p[2] > -9.5e-3 && std::abs(p[1]) < 13e-3;
    if (on_wall) {
      ++facing;
      CHECK(coaptation.distance[n] == about(walls_gap, 1e-9));
    } else if (p[2] > -3.5e-3) {
      CHECK(std::isinf(coaptation.distance[n]));
    }
  }
  CHECK(facing > 500);
}

TEST_CASE("share_is_one_on_the_walls_and_zero_on_the_bellies") {
  const ModelPtr model = model_of(sheet_of({}));
  const Coaptation coaptation = measure_coaptation(*model, model->valve.rest);
  for (size_t t = 0; t < model->valve.triangles.size(); ++t) {
    double highest = -1, lowest = 1, aside = 0;
    for (const uint32_t node : model->valve.triangles[t]) {
      highest = std::max(highest, model->valve.rest[node][2]);
      lowest = std::min(lowest, model->valve.rest[node][2]);
      aside = std::max(aside, std::abs(model->valve.rest[node][1]));
    }
    if (highest < -4.1e-3 && aside < 13e-3) CHECK(coaptation.share[t] == 1);
    if (lowest > -3.5e-3) CHECK(coaptation.share[t] == 0);
  }
}

TEST_CASE("a_v_coapts_up_to_where_it_gapes") {
  const double half_angle = 3 * pi / 180, bottom_gap = 0.2e-3;
  ClosedShape closed;
  closed.wall = [=](double along, double down, double side) -> Vec3 {
    return {side * (0.5 * bottom_gap + (6e-3 - down) * std::tan(half_angle)), along, -down};
  };
  const Coaptation coaptation = coaptation_of(closed);
  // at a slant distance t from the apex the other wall is t sin(2 half_angle) away
  const double from = 0.5 * bottom_gap / std::sin(half_angle);
  const double to = contact_thickness / std::sin(2 * half_angle);
  CHECK(to - from < 6e-3);
  // to half a sample (0.1 mm) of 3.8 mm
  CHECK(coaptation.length_mean == about(to - from, 0.03));
}

TEST_CASE("tilted_walls_are_measured_along_the_tissue") {
  const double tilt = 40 * pi / 180;
  ClosedShape closed;
  closed.wall = [=](double along, double down, double side) -> Vec3 {
    return {0.5 * walls_gap * side + down * std::tan(tilt), along, -down};
  };
  const Coaptation coaptation = coaptation_of(closed);
  // one wall is shifted along the other by the gap's share of the slant
  const double overlap = 6e-3 / std::cos(tilt) - walls_gap * std::sin(tilt);
  CHECK(coaptation.length_mean == about(overlap, 0.03));
  CHECK(coaptation.length_min == about(overlap, 0.06));
}

TEST_CASE("a_curved_line_is_followed") {
  for (const double degrees : {30.0, 60.0, 85.0}) {
    CAPTURE(degrees);
    const double radius = 9e-3, half_angle = degrees * pi / 180;
    ClosedShape closed;
    closed.half_width = radius * half_angle;
    // bulging towards the posterior leaflet, like a smile
    closed.wall = [=](double along, double down, double side) -> Vec3 {
      const double r = radius - 0.5 * walls_gap * side, angle = along / radius;
      return {4e-3 - r * std::cos(angle), r * std::sin(angle), -down};
    };
    closed.rim = [=](double angle, double side) -> Vec3 {
      const double along = half_angle * std::sin(angle);
      const Vec3 straight(16e-3, 9e-3 * std::sin(angle), 0);
      const Vec3 round(4e-3 - 17e-3 * std::cos(along), 17e-3 * std::sin(along), 0);
      return 0.5 * ((1 + side) * straight + (1 - side) * round);
    };
    const Coaptation coaptation = coaptation_of(closed);
    CHECK(coaptation.area == about(6e-3 * 2 * closed.half_width, 0.02));
    CHECK(coaptation.length_mean == about(6e-3, 0.03));
    CHECK(coaptation.length_min == about(6e-3, 0.06));
    CHECK(coaptation.length_max == about(6e-3, 0.06));
    for (const CoaptationStation &station : coaptation.line) {
      const double r = std::hypot(station.point[0] - 4e-3, station.point[1]);
      // means over 1.2 mm of an arc of 9 mm lie 0.02 mm inside, smoothed 0.08 mm
      CHECK(std::abs(r - radius) < 0.15e-3);
    }
  }
}

TEST_CASE("the_shortest_length_is_zero_where_the_line_has_a_gap") {
  ClosedShape closed;
  closed.wall = [](double along, double down, double side) -> Vec3 {
    const double open = std::abs(along) < 3e-3 ? 4e-3 : walls_gap;
    return {0.5 * open * side, along, -down};
  };
  const Coaptation coaptation = coaptation_of(closed);
  CHECK(coaptation.length_min == 0);
  CHECK(coaptation.length_max > 5.5e-3);
  CHECK(coaptation.height == 0);  // the central plane runs through the gap
}

TEST_CASE("leaflets_that_do_not_touch_have_no_coaptation") {
  const ModelPtr model = model_of(
      disc(18e-3, 6e-3, [](double x, double y) { return 0.4 * (std::hypot(x, y) - 18e-3); }));
  const Coaptation coaptation = measure_coaptation(*model, model->valve.rest);
  CHECK(coaptation.area == 0);
  CHECK(coaptation.length_mean == 0);
  CHECK(coaptation.length_min == 0);
  CHECK(coaptation.length_max == 0);
  CHECK(coaptation.height == 0);
  CHECK(coaptation.depth == 0);
  CHECK(coaptation.line.empty());
  for (const double share : coaptation.share) CHECK(share == 0);
  for (const double distance : coaptation.distance) CHECK(std::isinf(distance));
}

TEST_CASE("a_leaflet_that_is_folded_on_itself_has_no_height_of_coaptation") {
  ClosedShape closed;
  closed.posterior_wall = 9e-3;
  // the posterior wall goes down 5 mm and up again, 0.5 mm beside itself and 3.5 mm from the other
  closed.wall = [](double along, double down, double side) -> Vec3 {
    if (side > 0) return {2e-3, along, -down};
    const double fold = down - 5e-3;
    if (fold < 0) return {-2e-3, along, -down};
    if (fold < 0.5e-3) return {-2e-3 + fold, along, -5e-3};
    return {-1.5e-3, along, -5.5e-3 + fold};
  };
  const Coaptation coaptation = coaptation_of(closed);
  CHECK(coaptation.area > 20e-6);  // of the tissue that faces itself
  CHECK(coaptation.height == 0);
  CHECK(coaptation.depth == 0);
}

TEST_CASE("outer_sides_within_reach_do_not_coapt") {
  Valve valve = valve_of(sheet_of({}));
  for (Tri &triangle : valve.triangles) std::swap(triangle[1], triangle[2]);
  // inside out: the sheet's other side faces the other wall. No valve, so not through make_model.
  Model model;
  model.valve = valve;
  model.topology = make_topology(valve);
  const Coaptation coaptation = measure_coaptation(model, valve.rest);
  CHECK(coaptation.area == 0);
}

TEST_CASE("a_cleft_coapts_with_itself_but_forms_no_line") {
  Valve valve = valve_of(sheet_of({}));
  // one leaflet has both walls, the other only the bellies
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    double lowest = 0;
    for (const uint32_t node : valve.triangles[t]) lowest = std::min(lowest, valve.rest[node][2]);
    if (lowest < -3e-3) valve.triangle_leaflet[t] = 1;
  }
  const ModelPtr model = make_model(valve);
  const Coaptation coaptation = measure_coaptation(*model, valve.rest);
  CHECK(coaptation.area == about(6e-3 * 28e-3, 0.02));
  CHECK(coaptation.line.empty());
  CHECK(coaptation.length_mean == 0);
  CHECK(coaptation.length_min == 0);
}

TEST_CASE("three_leaflets_meet_along_their_lines") {
  const ClosedShape closed;
  Valve valve = valve_of(sheet_of(closed));
  valve.leaflets.resize(3);
  valve.leaflets[2].name = "S";
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const bool left = valve.rest[valve.triangles[t][0]][1] > 0;
    if (valve.triangle_leaflet[t] == 1 && left) valve.triangle_leaflet[t] = 2;
  }
  const ModelPtr model = make_model(valve);
  const Coaptation coaptation = measure_coaptation(*model, valve.rest);
  CHECK(coaptation.area == about(6e-3 * 2 * closed.half_width, 0.02));
  // A with P and A with S; a line of 14 mm is uncertain by a sample at either end: 0.5 mm in all
  CHECK(coaptation.length_mean == about(6e-3, 0.04));
  CHECK(coaptation.length_max == about(6e-3, 0.08));
  // both lines are complete: no station is missing or counted twice
  double furthest = 0, total = 0;
  for (const CoaptationStation &station : coaptation.line) {
    furthest = std::max(furthest, std::abs(station.point[1]));
    total += station.point[1];
  }
  CHECK(furthest > 12e-3);
  CHECK(std::abs(total) / static_cast<double>(coaptation.line.size()) < 1.2e-3);
}

TEST_CASE("coaptation_is_invariant_under_motion_and_renumbering") {
  const Valve valve = valve_of(sheet_of({}));
  const ModelPtr model = make_model(valve);
  const Coaptation still = measure_coaptation(*model, valve.rest);
  const auto check_same = [&](const Coaptation &other) {
    // a sample counts or does not: one of them is 1e-5 of the area
    CHECK(other.area == about(still.area, 1e-4));
    CHECK(other.length_mean == about(still.length_mean, 1e-3));
    CHECK(other.length_min == about(still.length_min, 1e-2));
    CHECK(other.length_max == about(still.length_max, 1e-2));
    CHECK(other.height == about(still.height, 1e-9));
    CHECK(other.depth == about(still.depth, 1e-9));
  };
  check_same(measure_coaptation(*model, moved(valve.rest, some_rigid_motion())));
  const Renumbered other = renumbered(valve);
  check_same(measure_coaptation(*other.model, other(valve.rest)));
}

namespace {

// The closed sheet with its posterior leaflet cut in two along the plane between both commissures,
// the anterior one last, as in a tricuspid valve.
ModelPtr three_leaflets(const ClosedShape &closed) {
  Valve valve = valve_of(sheet_of(closed));
  valve.leaflets.resize(3);
  valve.leaflets[0].name = "Septal";
  valve.leaflets[1].name = "Posterior";
  valve.leaflets[2].name = "Anterior";
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const Tri &nodes = valve.triangles[t];
    const double across =
        valve.rest[nodes[0]].y() + valve.rest[nodes[1]].y() + valve.rest[nodes[2]].y();
    uint32_t &leaflet = valve.triangle_leaflet[t];
    leaflet = leaflet == 0 ? 2 : across > 0 ? 0 : 1;
  }
  valve.scallops.clear();
  valve.triangle_scallop.clear();
  return make_model(valve);
}

}  // namespace

TEST_CASE("three_leaflets_coapt_where_two_do") {
  const ClosedShape closed;
  const ModelPtr two = model_of(sheet_of(closed)), three = three_leaflets(closed);
  const Coaptation of_two = measure_coaptation(*two, two->valve.rest);
  const Coaptation of_three = measure_coaptation(*three, three->valve.rest);
  // facing pairs do not depend on the names of leaflets
  CHECK(of_three.distance == of_two.distance);
  CHECK(of_three.share == of_two.share);
  CHECK(of_three.area == of_two.area);
  // the line of A with P is now one with each half of P; stations at the cut are distributed anew
  CHECK(of_three.line.size() + 2 >= of_two.line.size());
  CHECK(of_three.length_mean == about(of_two.length_mean, 0.05));
  CHECK(of_three.height == about(of_two.height, 1e-9));
}

TEST_CASE("three_leaflets_have_the_frame_of_the_anterior_one") {
  const ClosedShape closed;
  const ModelPtr two = model_of(sheet_of(closed)), three = three_leaflets(closed);
  const Frame of_two = valve_frame(*two, two->valve.rest);
  const Frame of_three = valve_frame(*three, three->valve.rest);
  CHECK(of_three.axes == of_two.axes);
  CHECK(of_three.origin == of_two.origin);
}

}  // namespace mvs::core::test
