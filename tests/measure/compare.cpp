// Comparison of shapes against known motions, scales and brute force.
#include "measure/comparison/compare.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "geometry/distance.h"
#include "measure/comparison/surface_distance.h"
#include "tests/measure/shapes.h"

namespace mvs::core::test {
namespace {

// An uneven bowl, so that no rotation maps it onto itself.
Sheet bowl(size_t around, size_t rings) {
  Sheet sheet = disc(18e-3, 4e-3, [](double x, double y) {
    return 20 * (x * x + 0.6 * y * y) - 6e-3 + 300 * x * x * y + 0.2 * x;
  });
  sheet.around = around;
  sheet.rings = rings;
  return sheet;
}

double motion_error(const std::array<double, 12> &found, const RigidMotion &motion) {
  double error = 0;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      error = std::max(error, std::abs(found[4 * row + column] - motion.turn(row, column)));
    }
    error = std::max(error, std::abs(found[4 * row + 3] - motion.shift[row]));
  }
  return error;
}

// The same surface in a finer mesh: each triangle in four, new nodes on its sides.
Valve refined(const Valve &valve) {
  const Topology topology = make_topology(valve);
  Valve fine = valve;
  const uint32_t n = static_cast<uint32_t>(valve.rest.size());
  for (const Edge &edge : topology.edges) {
    fine.rest.push_back(0.5 * (valve.rest[edge[0]] + valve.rest[edge[1]]));
  }
  fine.loaded = fine.rest;
  fine.triangles.clear();
  fine.triangle_leaflet.clear();
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const auto [a, b, c] = valve.triangles[t];
    const auto &sides = topology.triangle_edges[t];
    const uint32_t ab = n + sides[0], bc = n + sides[1], ca = n + sides[2];
    for (const Tri &part : {Tri{a, ab, ca}, Tri{ab, b, bc}, Tri{ca, bc, c}, Tri{ab, bc, ca}}) {
      fine.triangles.push_back(part);
      fine.triangle_leaflet.push_back(valve.triangle_leaflet[t]);
    }
  }
  fine.annulus.clear();
  for (size_t k = 0; k < valve.annulus.size(); ++k) {
    const uint32_t a = valve.annulus[k], b = valve.annulus[(k + 1) % valve.annulus.size()];
    const Edge edge = {std::min(a, b), std::max(a, b)};
    const auto found = std::find(topology.edges.begin(), topology.edges.end(), edge);
    fine.annulus.push_back(a);
    fine.annulus.push_back(n + static_cast<uint32_t>(found - topology.edges.begin()));
  }
  return fine;
}

double brute_force_distance2(const Vec3 &p, const std::vector<Tri> &triangles,
                             const std::vector<Vec3> &x) {
  double nearest2 = HUGE_VAL;
  for (const Tri &t : triangles) {
    nearest2 = std::min(nearest2, closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]).distance2);
  }
  return nearest2;
}

}  // namespace

TEST_CASE("bvh_queries_equal_brute_force") {
  const ModelPtr model = model_of(bowl(40, 10));
  const std::vector<Vec3> &x = model->valve.rest;
  const TriangleBvh tree(model->valve.triangles, x);
  for (int i = 0; i < 2000; ++i) {
    // a low-discrepancy cloud in and around the valve
    const auto fraction = [&](double step) { return std::fmod(0.5 + i * step, 1.0) - 0.5; };
    const Vec3 p = 60e-3 * Vec3(fraction(0.8191725), fraction(0.6710436), fraction(0.5497005));
    const TriangleBvh::Hit hit = tree.closest(p);
    CHECK(hit.distance2 == brute_force_distance2(p, model->valve.triangles, x));
    CHECK((hit.point - p).squaredNorm() == about(hit.distance2, 1e-9));
  }
}

TEST_CASE("a_shape_has_zero_distance_to_itself") {
  const ModelPtr model = model_of(bowl(40, 10));
  const Comparison c = compare_shapes(*model, model->valve.rest, *model, model->valve.rest);
  CHECK(c.same_mesh);
  CHECK(c.node_max == 0);
  CHECK(c.surface_max < 1e-17);  // a centroid's weights need not add up to the same bits
  CHECK(c.node_max_registered < 1e-16);
}

TEST_CASE("registration_finds_a_rigid_motion_of_the_same_mesh") {
  const ModelPtr model = model_of(bowl(40, 10));
  const RigidMotion motion = some_rigid_motion();
  const Comparison c =
      compare_shapes(*model, model->valve.rest, *model, moved(model->valve.rest, motion));
  CHECK(motion_error(c.registration, motion) < 1e-14);
  CHECK(c.node_max_registered < 1e-15);
  CHECK(c.surface_max_registered < 1e-15);
  CHECK(c.node_rms > 0.1);
}

TEST_CASE("a_translation_moves_every_node_by_its_length") {
  const ModelPtr model = model_of(bowl(40, 10));
  const Vec3 shift(1e-3, -2e-3, 2e-3);
  const Comparison c =
      compare_shapes(*model, model->valve.rest, *model,
                     moved(model->valve.rest, [&](const Vec3 &p) { return Vec3(p + shift); }));
  CHECK(c.node_rms == about(3e-3, 1e-12));
  CHECK(c.node_max == about(3e-3, 1e-12));
  CHECK(c.surface_rms < 3e-3);
  CHECK(c.surface_max <= c.node_max * (1 + 1e-12));
}

TEST_CASE("a_scaled_shape_keeps_the_distance_that_no_motion_removes") {
  const ModelPtr model = model_of(bowl(40, 10));
  const double scale = 1.05;
  const RigidMotion motion = some_rigid_motion();
  const Comparison c =
      compare_shapes(*model, model->valve.rest, *model,
                     moved(model->valve.rest, [&](const Vec3 &p) { return motion(scale * p); }));
  // the best motion aligns the centroids; the remaining distance is (scale - 1) times that to the
  // centroid
  Vec3 mean = Vec3::Zero();
  const size_t sheet = model->valve.rest.size() - 2;  // the last two are heads
  for (size_t n = 0; n < sheet; ++n) mean += model->valve.rest[n] / static_cast<double>(sheet);
  double squares = 0, furthest = 0;
  for (size_t n = 0; n < sheet; ++n) {
    const double distance = (scale - 1) * (model->valve.rest[n] - mean).norm();
    squares += distance * distance / static_cast<double>(sheet);
    furthest = std::max(furthest, distance);
  }
  CHECK(c.node_rms_registered == about(std::sqrt(squares), 1e-12));
  CHECK(c.node_max_registered == about(furthest, 1e-12));
}

TEST_CASE("parallel_sheets_are_their_distance_apart") {
  const auto flat = [](double z) { return disc(18e-3, 4e-3, [=](double, double) { return z; }); };
  Sheet other = flat(2e-3);
  other.around = 36;  // another mesh; its corners stay within the rim of the first one's circle
  const ModelPtr a = model_of(flat(0)), b = model_of(other);
  const Comparison c = compare_shapes(*a, a->valve.rest, *b, b->valve.rest);
  CHECK(!c.same_mesh);
  CHECK(std::isnan(c.node_rms));
  CHECK(std::isnan(c.node_max_registered));
  // polygons of 48 and 36 sides differ by 0.1 mm at the rim: 1e-3 of 2 mm
  CHECK(c.surface_rms == about(2e-3, 1e-4));
  CHECK(c.surface_max == about(2e-3, 1e-3));
  CHECK(c.surface_max_registered < 0.1e-3);
}

TEST_CASE("squared_distance_to_a_plane_is_integrated_exactly") {
  const ModelPtr model = model_of(disc(18e-3, 4e-3, [](double, double) { return 0.0; }));
  const double slope = 0.3;
  const SampledSurface surface(model->valve.triangles, model->valve.rest);
  double samples = 0, exact = 0;
  for (const auto &sample : surface.samples()) {
    samples += sample.weight * std::pow(slope * sample.point[0], 2);
  }
  for (size_t t = 0; t < model->valve.triangles.size(); ++t) {
    // the integral of a square of linear values a b c at the corners
    const auto value = [&](size_t k) {
      return slope * model->valve.rest[model->valve.triangles[t][k]][0];
    };
    const double a = value(0), b = value(1), c = value(2);
    exact += model->rest_area[t] * (a * a + b * b + c * c + a * b + b * c + c * a) / 6;
  }
  CHECK(samples == about(exact, 1e-13));
}

TEST_CASE("registration_finds_a_rigid_motion_of_another_mesh_of_the_same_surface") {
  const Valve coarse = valve_of(bowl(40, 10));
  const ModelPtr a = make_model(coarse), b = make_model(refined(coarse));
  const RigidMotion motion = some_rigid_motion();
  const Comparison c = compare_shapes(*a, a->valve.rest, *b, moved(b->valve.rest, motion));
  CHECK(!c.same_mesh);
  // zero distance is found as the root of squares: 1e-12 of the first ones
  CHECK(c.surface_max_registered < 1e-9);
  CHECK(motion_error(c.registration, motion) < 1e-8);
}

TEST_CASE("surface_registration_is_a_local_minimum") {
  const ModelPtr a = model_of(bowl(40, 10)), b = model_of(bowl(34, 9));
  // bent and shifted, so that no rigid motion fits
  const std::vector<Vec3> x = moved(b->valve.rest, [](const Vec3 &p) {
    return Vec3(p[0] + 1e-3, 1.04 * p[1], p[2] + 4 * p[0] * p[1]);
  });
  const Comparison c = compare_shapes(*a, a->valve.rest, *b, x);
  CHECK(c.surface_rms_registered < c.surface_rms);
  RigidMotion best;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      best.turn(row, column) = c.registration[4 * row + column];
    best.shift[row] = c.registration[4 * row + 3];
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Mat3 turn = Eigen::AngleAxisd(sign * 2e-3, Vec3::Unit(axis)).toRotationMatrix();
      const auto rms_after = [&](const Mat3 &t, const Vec3 &s) {
        const std::vector<Vec3> there =
            moved(a->valve.rest, [&](const Vec3 &p) { return Vec3(t * best(p) + s); });
        return compare_shapes(*a, there, *b, x).surface_rms;
      };
      CHECK(rms_after(turn, Vec3::Zero()) > c.surface_rms_registered);
      CHECK(rms_after(Mat3::Identity(), sign * 0.04e-3 * Vec3::Unit(axis)) >
            c.surface_rms_registered);
    }
  }
}

TEST_CASE("comparison_is_symmetric_and_deterministic") {
  const ModelPtr a = model_of(bowl(40, 10)), b = model_of(bowl(34, 9));
  const Comparison ab = compare_shapes(*a, a->valve.rest, *b, b->valve.rest);
  const Comparison ba = compare_shapes(*b, b->valve.rest, *a, a->valve.rest);
  CHECK(ab.surface_rms == about(ba.surface_rms, 1e-14));
  CHECK(ab.surface_max == ba.surface_max);
  // two searches end within 1e-6 of the same least sum of squares
  CHECK(ab.surface_rms_registered == about(ba.surface_rms_registered, 1e-6));
  const Comparison again = compare_shapes(*a, a->valve.rest, *b, b->valve.rest);
  CHECK(again.registration == ab.registration);
  CHECK(again.surface_rms_registered == ab.surface_rms_registered);
}

}  // namespace mvs::core::test
