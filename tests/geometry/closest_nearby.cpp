// ClosestNearby finds what TriangleBvh and a search of all triangles find, ties included.
#include "geometry/closest_nearby.h"

#include <doctest/doctest.h>

#include <random>

using namespace mvs::core;

namespace {

struct Sheet {
  std::vector<Tri> triangles;
  std::vector<Vec3> x;
};

// A wavy sheet of 12 by 12 squares of 1 mm, each of two triangles.
Sheet wavy_sheet() {
  constexpr uint32_t n = 12;
  Sheet sheet;
  for (uint32_t i = 0; i <= n; ++i) {
    for (uint32_t j = 0; j <= n; ++j) {
      sheet.x.push_back(1e-3 * Vec3(i, j, (i * j) % 5));
    }
  }
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t j = 0; j < n; ++j) {
      const uint32_t a = i * (n + 1) + j, b = a + n + 1;
      sheet.triangles.push_back({a, b, a + 1});
      sheet.triangles.push_back({b, b + 1, a + 1});
    }
  }
  return sheet;
}

// The first of the triangles that are closest.
uint32_t closest_of_all(const BoxedTriangles &triangles, size_t count, const Vec3 &p) {
  uint32_t best = 0;
  for (uint32_t t = 1; t < count; ++t) {
    if (triangles.closest_on(t, p).distance2 < triangles.closest_on(best, p).distance2) best = t;
  }
  return best;
}

}  // namespace

TEST_CASE("closest triangles of points in a ball are those of the whole sheet") {
  const Sheet sheet = wavy_sheet();
  const TriangleBvh tree(sheet.triangles, sheet.x);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-2e-3, 14e-3), part(-1, 1);
  for (int ball = 0; ball < 100; ++ball) {
    const Vec3 centre(place(random), place(random), place(random));
    const double radius = 1e-3 * (ball % 4);
    const uint32_t hint = ball % 2 == 0 ? none : 5;
    const ClosestNearby near(tree, centre, radius, hint);
    CHECK(near.closest_to_centre() == tree.closest(centre).triangle);
    for (int k = 0; k < 10; ++k) {
      const Vec3 p = centre + radius / 2 * Vec3(part(random), part(random), part(random));
      const TriangleBvh::Hit hit = near.closest(p, hint);
      CHECK(hit.triangle == tree.closest(p).triangle);
      CHECK(hit.distance2 == tree.closest(p).distance2);
      CHECK(hit.triangle == closest_of_all(tree, sheet.triangles.size(), p));
    }
  }
}

TEST_CASE("above a vertex the first of its triangles is the closest, whatever the hint") {
  const Sheet sheet = wavy_sheet();
  const TriangleBvh tree(sheet.triangles, sheet.x);
  for (uint32_t v = 0; v < sheet.x.size(); ++v) {
    const uint32_t first = closest_of_all(tree, sheet.triangles.size(), sheet.x[v]);
    const ClosestNearby near(tree, sheet.x[v] + Vec3(0, 0, 1e-4), 2e-4, none);
    for (uint32_t hint = 0; hint < sheet.triangles.size(); hint += 7) {
      CHECK(tree.closest(sheet.x[v], hint).triangle == first);
      CHECK(near.closest(sheet.x[v], hint).triangle == first);
    }
  }
}

TEST_CASE("a tree without triangles has nothing near") {
  const Sheet nothing;
  const TriangleBvh tree(nothing.triangles, nothing.x);
  const ClosestNearby near(tree, Vec3::Zero(), 1, none);
  CHECK(near.closest_to_centre() == none);
  CHECK(near.closest(Vec3::Zero()).triangle == none);
}
