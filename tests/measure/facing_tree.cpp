// The hierarchy with normals finds every triangle that may face a point or another triangle; its
// topology is kept while the mesh stays, and decides nothing.
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <cmath>

#include "anatomy/parametric.h"
#include "geometry/intersect.h"
#include "measure/coaptation/facing_tree.h"
#include "measure/coaptation/facing_weight.h"

using namespace mvs::core;

namespace {

// m: far enough to find triangles across the open valve
constexpr double cosine = -0.4, reach = 20e-3;

struct Fixture {
  ModelPtr model;
  std::vector<Vec3> x;
  Surface surface;

  Fixture() {
    mvs_parametric_desc desc = {};
    desc.struct_size = sizeof desc;
    desc.vertices = 200;
    model = make_model(make_parametric_valve(desc));
    x = initial_state(*model).x;
    surface = surface_of(model->valve.triangles, x);
  }
  const std::vector<Tri> &triangles() const { return model->valve.triangles; }
};

}  // namespace

TEST_CASE("pairs_with_opposite_normals_are_found_once") {
  const Fixture f;
  const FacingTree tree(*f.model, f.x, f.surface);
  const auto may_face = [&](uint32_t a, uint32_t b) {
    return f.surface.normal[a].dot(f.surface.normal[b]) <= cosine &&
           tree.box_of(a).distance2(tree.box_of(b)) <= reach * reach;
  };
  std::vector<Edge> found, expected;
  size_t visited = 0;
  tree.for_near_pairs(cosine, reach * reach, [&](uint32_t a, uint32_t b) {
    ++visited;
    if (may_face(a, b)) found.push_back({std::min(a, b), std::max(a, b)});
  });
  const auto count = static_cast<uint32_t>(f.triangles().size());
  for (uint32_t a = 0; a < count; ++a) {
    for (uint32_t b = a + 1; b < count; ++b) {
      if (may_face(a, b)) expected.push_back({a, b});
    }
  }
  std::sort(found.begin(), found.end());
  CHECK(found == expected);
  CHECK(!expected.empty());
  // most pairs are left out: of all, and those of one bulge with the same normals
  CHECK(visited < size_t{count} * count / 4);
}

TEST_CASE("triangles_near_a_point_are_found_by_their_normals") {
  const Fixture f;
  const FacingTree tree(*f.model, f.x, f.surface);
  size_t all = 0;
  for (uint32_t v = 0; v < f.x.size(); ++v) {
    const Vec3 &p = f.x[v], &normal = f.surface.node_normal[v];
    if (normal.isZero()) continue;
    const auto may_face = [&](uint32_t t) {
      return f.surface.normal[t].dot(normal) <= cosine &&
             tree.closest_on(t, p).distance2 <= reach * reach;
    };
    std::vector<uint32_t> found, expected;
    const double limit2 = reach * reach;
    tree.visit_near(p, normal, cosine, limit2, [&](uint32_t t) {
      if (may_face(t)) found.push_back(t);
    });
    for (uint32_t t = 0; t < f.triangles().size(); ++t) {
      if (may_face(t)) expected.push_back(t);
    }
    std::sort(found.begin(), found.end());
    CHECK(found == expected);
    all += expected.size();
  }
  CHECK(all > 0);
}

TEST_CASE("variants_of_a_valve_have_one_topology_and_another_mesh_has_its_own") {
  const Fixture f;
  const auto topology = sheet_topology(*f.model);
  Valve valve = f.model->valve;
  valve.chords.pop_back();
  CHECK(sheet_topology(*make_model(valve, f.model.get())) == topology);
  valve.rest[valve.triangles[0][0]] += Vec3(1e-6, 0, 0);
  valve.open[valve.triangles[0][0]] += Vec3(1e-6, 0, 0);
  valve.loaded[valve.triangles[0][0]] += Vec3(1e-6, 0, 0);
  CHECK(sheet_topology(*make_model(valve)) != topology);
  std::vector<uint32_t> all = topology->order;
  std::sort(all.begin(), all.end());
  CHECK(all.size() == f.triangles().size());
  CHECK(std::adjacent_find(all.begin(), all.end()) == all.end());
}

TEST_CASE("crossings_do_not_depend_on_the_topology") {
  Fixture f;
  // waves of 4 mm, across the open valve: leaflets pass through each other
  for (Vec3 &p : f.x) p += 4e-3 * Vec3(std::sin(900 * p[1]), std::sin(900 * p[2]), 0);
  const std::vector<Edge> found = find_intersections(f.x, f.triangles());
  CHECK(!found.empty());
  CHECK(find_intersections(f.x, f.triangles(), *sheet_topology(*f.model)) == found);
}

// The bounds leave out no point that is near, and most that are not: brute force over random points
// and triangles.
TEST_CASE("points_near_a_triangle_are_marked") {
  uint32_t seed = 1;
  const auto number = [&] {
    seed = seed * 1664525u + 1013904223u;
    return (static_cast<double>(seed >> 8) / (1 << 24) - 0.5) * 1e-2;
  };
  const auto point = [&] {
    const double u = number(), v = number();
    return Vec3(u, v, number());
  };
  size_t left_out = 0;
  for (int k = 0; k < 200; ++k) {
    const std::vector<Vec3> x = {point(), point(), point()};
    const std::vector<Tri> one = {{0, 1, 2}};
    const FacingBounds bounds =
        bounds_of({x[0], x[1], x[2]}, surface_of(one, x).normal[0], aabb_of(x, one[0]));
    FacingPoints points;
    for (int i = 0; i < 18; ++i) points.add(point());  // not a multiple of four
    const auto is_marked = [&](size_t i, double limit2) {
      NearFours near;
      mark_near(bounds, points, limit2, near);
      CHECK((near[4] & ~3u) == 0);  // no mark behind the last point
      return (near[i / 4] >> i % 4 & 1) != 0;
    };
    for (size_t i = 0; i < points.count; ++i) {
      const Vec3 p(points.x[i], points.y[i], points.z[i]);
      const double true2 = closest_on_triangle(p, x[0], x[1], x[2]).distance2;
      CHECK(is_marked(i, true2 * (1 + 1e-9)));  // above the rounding of the nearest point
      left_out += is_marked(i, 0.99 * true2) ? 0 : 1;
    }
  }
  CHECK(left_out > 1000);  // of 3600: beside a side or over the inside the bound is the distance
}
