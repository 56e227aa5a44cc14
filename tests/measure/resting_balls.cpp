// Where a ball comes to rest on the leaflets: closed forms, brute force, openings.
#include "measure/tenting/resting_balls.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "measure/tenting/tenting_billow.h"
#include "tests/measure/closed_valve.h"
#include "tests/measure/continuity.h"
#include "tests/measure/shapes.h"

namespace mvs::core::test {
namespace {

constexpr double radius = 0.5e-3;

double depth_of(const Shape &shape, const std::vector<Vec3> &x) {
  return measure_tenting_billow(*shape.model, x).tenting_height;
}

// The height of the centre of a ball let down to the tissue straight from above; -infinity where it
// meets none. By steps of the distance that is left.
double centre_at(const TriangleBvh &tree, double u, double v, double top, double bottom) {
  Vec3 centre(u, v, top);
  while (centre[2] > bottom) {
    const double left = std::sqrt(tree.closest(centre).distance2) - radius;
    if (left < 1e-9) return centre[2];
    centre[2] -= left;
  }
  return -HUGE_VAL;
}

}  // namespace

// The ball touches all faces, each of slope s, with its centre r sqrt(1 + s2) above the apex.
TEST_CASE("a_ball_rests_in_a_pyramid_above_its_apex") {
  const double side = 5e-3, turned = 0.3;
  for (const double slope : {0.2, 1.0, 3.0}) {
    std::vector<Vec3> x = {Vec3(0.3e-3, -0.2e-3, -slope * side)};
    for (int k = 0; k < 4; ++k) {
      const double angle = turned + k * pi / 2;
      // the middle of each side of the square is at `side` from the apex
      x.emplace_back(x[0] + std::sqrt(2) * side * Vec3(std::cos(angle), std::sin(angle), 0) +
                     Vec3(0, 0, slope * side));
    }
    const std::vector<Tri> triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
    const std::vector<Vec3> rim(x.begin() + 1, x.end());
    const TriangleBvh tree(triangles, x);
    const std::vector<Vec3> lows =
        lows_of_ball({tree, x, {}, rim, aabb_of(x), [](const Vec3 &) { return false; }},
                     {{x[0] + Vec3(1.1e-3, -0.7e-3, 4 * side)}, {}}, radius);
    REQUIRE(!lows.empty());
    const Vec3 expected = x[0] + Vec3(0, 0, radius * (std::sqrt(1 + slope * slope) - 1));
    CHECK((lows.front() - expected).norm() < 1e-15);  // rounding of 10 mm
  }
}

// Seen from the atrium on a lattice, no ball is let down to a lower place than the lowest found.
TEST_CASE("no_ball_on_a_lattice_is_lower_than_the_lowest_found") {
  for (const double annulus_scale : {1.0, 1.15}) {
    const Shape shape = closed_valve(annulus_scale);
    const AtrialSurface atrial = atrial_surface(*shape.model, shape.x);
    REQUIRE(shape.model->valve.contact_thickness == 2 * radius);
    const TriangleBvh tree(shape.model->valve.triangles, atrial.local);
    const Vec3 low = atrial.lows.front();
    const double deepest = low[2] + radius;
    double lowest = HUGE_VAL;
    const auto look_at = [&](double u, double v) {
      const double here = centre_at(tree, u, v, 10e-3, deepest - 1e-3);
      if (std::isfinite(here)) lowest = std::min(lowest, here);
    };
    // the whole valve, and the surroundings of the lowest place
    for (int column = 0; column < AnnulusMap::across; column += 3) {
      for (int row = 0; row < AnnulusMap::across; row += 3) {
        if (atrial.map->share(AnnulusMap::at(column, row)) < 1) continue;
        look_at(atrial.map->u()[static_cast<size_t>(column)],
                atrial.map->v()[static_cast<size_t>(row)]);
      }
    }
    for (int i = -20; i <= 20; ++i) {
      for (int j = -20; j <= 20; ++j) look_at(low[0] + i * 1e-6, low[1] + j * 1e-6);
    }
    CHECK(lowest >= deepest - 1e-8);  // heights of the lattice are 1e-9 above contact, along slopes
    // the lowest of the leaking valve is beside its opening, where balls fall
    if (annulus_scale > 1) continue;
    CHECK(std::abs(std::sqrt(tree.closest(low + Vec3(0, 0, radius)).distance2) - radius) < 1e-13);
    CHECK(lowest < deepest + 20e-6);  // walls of a slope up to 10, 1 um from the lowest place
  }
}

// Balls that start all over the annulus, each let down from above, come to no other lowest place
// than those from the raster. Sealed and leaking valves; of some every low of the raster is an
// opening, through which balls fall.
TEST_CASE("balls_from_everywhere_come_to_the_same_lowest_place") {
  struct Case {
    uint32_t vertices, shape;
    double annulus_scale;
  };
  for (const Case &c : {Case{200, MVS_SHAPE_HEALTHY, 1.12}, Case{200, MVS_SHAPE_FOUNDING, 1.15},
                        Case{425, MVS_SHAPE_FOUNDING, 1.16}, Case{425, MVS_SHAPE_HEALTHY, 1.0},
                        Case{425, MVS_SHAPE_HEALTHY, 1.3}}) {
    const Shape shape = closed_valve(c.annulus_scale, c.vertices, c.shape);
    const AtrialSurface atrial = atrial_surface(*shape.model, shape.x);
    const std::vector<Tri> &triangles = shape.model->valve.triangles;
    const TriangleBvh tree(triangles, atrial.local);
    Aabb box;
    for (const Tri &t : triangles) box.add(aabb_of(atrial.local, t));
    BallStarts starts;
    for (int column = 0; column < AnnulusMap::across; column += 6) {
      for (int row = 0; row < AnnulusMap::across; row += 6) {
        if (atrial.map->share(AnnulusMap::at(column, row)) < 1) continue;
        const double u = atrial.map->u()[static_cast<size_t>(column)],
                     v = atrial.map->v()[static_cast<size_t>(row)];
        const double height = centre_at(tree, u, v, box.high[2] + 2 * radius, box.low[2] - radius);
        if (std::isfinite(height)) starts.lowest.emplace_back(u, v, height);
      }
    }
    std::vector<Vec3> rim;
    for (const uint32_t node : shape.model->valve.annulus) rim.push_back(atrial.local[node]);
    const std::vector<Vec3> lows =
        lows_of_ball({tree, atrial.local, shape.model->topology.free_edges, rim, box,
                      [](const Vec3 &) { return true; }},
                     starts, radius);
    CAPTURE(c.vertices);
    CAPTURE(c.annulus_scale);
    CHECK(atrial.depth() > 5e-3);
    CHECK(atrial.depth() == about(-lows.front()[2], 1e-9));
  }
}

// The plane of a floor has a normal that is vertical up to rounding, another one in each frame.
TEST_CASE("a_ball_does_not_sink_into_a_floor") {
  const double depth = 6e-3;
  const Sheet cup = disc(18e-3, 0.01e-3, [&](double x, double y) {
    return -std::min(depth, 2 * (18e-3 - std::sqrt(x * x + y * y)));
  });
  const ModelPtr model = model_of(cup);
  for (int k = 0; k < 8; ++k) {
    const Mat3 turn = Eigen::AngleAxisd(0.7 * k, Vec3(1, k, 2).normalized()).toRotationMatrix();
    const double found = depth_of({model, {}}, moved(model->valve.rest, [&](const Vec3 &p) -> Vec3 {
                                    return turn * p + Vec3(0.01 * k, 0.02, -0.03);
                                  }));
    CHECK(found == about(depth, 1e-5));  // it sinks 0.1 um into the pinhole
  }
}

TEST_CASE("an_open_valve_is_a_radius_deeper_than_its_free_edge") {
  Sheet funnel = disc(18e-3, 5e-3, [](double x, double y) {
    return -10e-3 * (18e-3 - std::sqrt(x * x + y * y)) / 13e-3;
  });
  const ModelPtr model = model_of(funnel);
  const TentingBillow measured = measure_tenting_billow(*model, model->valve.rest);
  CHECK(measured.tenting_height == about(10e-3 + 0.5 * contact_thickness, 1e-12));
}

TEST_CASE("a_ball_sinks_into_a_hole_that_it_does_not_pass") {
  const double hole = 0.2e-3, r = 0.5 * contact_thickness;
  const ModelPtr model = model_of(disc(18e-3, hole, [](double x, double y) {
    return -5e-3 * (1 - (x * x + y * y) / (18e-3 * 18e-3));
  }));
  const TentingBillow measured = measure_tenting_billow(*model, model->valve.rest);
  // it touches the middles of the 48 sides of the hole
  const double touched = hole * std::cos(pi / 48);
  const double edge = 5e-3 * (1 - hole * hole / (18e-3 * 18e-3));
  CHECK(measured.tenting_height == about(edge + r - std::sqrt(r * r - touched * touched), 1e-9));
}

TEST_CASE("the_tenting_height_is_continuous_while_leaflets_move") {
  for (const double annulus_scale : {1.0, 1.15}) {
    const Shape shape = closed_valve(annulus_scale);
    check_continuous([&](double share) {
      return depth_of(shape, moved(shape.x, [&](const Vec3 &p) -> Vec3 {
                        return p + 80e-6 * share * smooth_field(p, 60, 0);
                      }));
    });
  }
}

// A fold that hangs over the annulus holds no ball whose centre is outside of it.
TEST_CASE("balls_stay_inside_the_annulus") {
  Sheet sheet = disc(18e-3, 0.05e-3, [](double x, double y) {
    const double r = std::sqrt(x * x + y * y) / 18e-3;
    return r > 0.9 ? -20e-3 * (1 - r) : -2e-3;  // the lowest place is all around
  });
  const ModelPtr model = model_of(sheet);
  const AtrialSurface atrial = atrial_surface(*model, model->valve.rest);
  REQUIRE(!atrial.lows.empty());
  for (const Vec3 &low : atrial.lows) CHECK(std::hypot(low[0], low[1]) < 18e-3);
  CHECK(atrial.depth() == about(2e-3, 2e-2));
}

}  // namespace mvs::core::test
