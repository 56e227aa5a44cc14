// Normals of a surface that is remeshed.
#include "patient/mesh/surface_walk.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

#include "base/math.h"

using namespace mvs::core;

TEST_CASE("normals_of_a_fine_surface_do_not_see_folds_smaller_than_the_new_triangles") {
  // A cylinder of triangles of 0.25 mm with crumpled places 1.5 mm wide, whose triangles turn over
  // each other, as in mid-surfaces of images beside filled notches. With their own normals no
  // collapse turned them back: sides of 0.01 mm and angles of 1 degree were left.
  constexpr uint32_t round = 240, rows = 48;
  constexpr double side = 0.25e-3, radius = round * side / 6.283185307179586;
  LeafletSheet sheet;
  std::mt19937 random(7);
  const auto deviate = [&](double size) {
    return size * (2 * (static_cast<double>(random()) / 4294967295.0) - 1);
  };
  for (uint32_t j = 0; j <= rows; ++j) {
    for (uint32_t i = 0; i < round; ++i) {
      const bool crumpled = i % 40 < 6 && j >= 20 && j < 26;
      const double out = crumpled ? deviate(0.1e-3) : 0, on = crumpled ? deviate(1.5) : 0;
      const double angle = 6.283185307179586 * (i + on) / round;
      const double down = side * (j + (crumpled ? deviate(1.5) : 0));
      sheet.x.emplace_back((radius + out) * math::cos(angle), (radius + out) * math::sin(angle),
                           -down);
      if (j == rows) continue;
      const uint32_t a = j * round + i, b = j * round + (i + 1) % round;
      sheet.triangles.push_back({a, a + round, b + round});
      sheet.triangles.push_back({a, b + round, b});
    }
  }
  const auto least_cosine = [&](double scale) {
    const SurfaceWalk walk(sheet.x, sheet.triangles, scale);
    double least = 1;
    for (uint32_t t = 0; t < sheet.triangles.size(); ++t) {
      const SurfacePlace place{t, {1, 0, 0}};
      const Vec3 p = walk.at(place), outward = Vec3(p.x(), p.y(), 0).normalized();
      least = std::min(least, walk.normal_at(place).dot(outward));
    }
    return least;
  };
  CHECK(least_cosine(0) < 0);         // turned over
  CHECK(least_cosine(1.2e-3) > 0.8);  // 35 degrees: all edits may be made
  // triangles as large as the scale have their own normals
  CHECK(least_cosine(2 * side - 1e-6) == least_cosine(0));
}
