// The healthy shape: anatomical ranges, the rules of its design, and closures of other sizes. Every
// tissue, pressure and path: python/test_healthy.py.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "anatomy/parametric.h"
#include "anatomy/shape.h"
#include "geometry/intersect.h"
#include "measure/measure.h"
#include "solve/solver.h"
#include "tests/about.h"

using namespace mvs::core;
using mvs::core::test::about;

namespace {

constexpr double systole = 120 * 133.322;  // Pa

double area(const Valve &valve) {
  double sum = 0;
  for (const auto &[a, b, c] : valve.triangles) {
    const Vec3 e = valve.rest[b] - valve.rest[a], f = valve.rest[c] - valve.rest[a];
    sum += 0.5 * e.cross(f).norm();
  }
  return sum;
}

}  // namespace

TEST_CASE("the_healthy_valve_has_anatomical_dimensions") {
  const Dimensions d = resolve_dimensions({});
  CHECK(d.shape == ParametricShape::healthy);
  const Shape shape(d);
  CHECK(shape.height(0) >= 22 * mm);
  CHECK(shape.height(0) <= 25 * mm + 1e-12);
  CHECK(shape.height(pi) >= 12 * mm);
  CHECK(shape.height(pi) <= 14 * mm + 1e-12);
  CHECK(shape.height(Shape::commissure) >= 8 * mm - 1e-12);
  CHECK(shape.height(Shape::commissure) <= 10 * mm);
  CHECK(std::abs(d.papillary_depth - 23.5 * mm) <= 4 * mm);

  const Valve valve = make_parametric_valve({});
  const ModelPtr model = make_model(valve);
  const double annulus = measure_annulus(*model, valve.rest).area;
  CHECK(area(valve) / annulus > 1.43);  // that of the founding shape
  CHECK(area(valve) / annulus < 2.5);
  size_t at_heads = 0;
  for (const Chord &chord : valve.chords) {
    at_heads += static_cast<size_t>(std::count_if(
        valve.heads.begin(), valve.heads.end(), [&](const Head &h) { return h.node == chord.a; }));
  }
  CHECK(at_heads >= 20);  // about 25 in anatomy, 32 here: trunks do not cross rows and tips
  CHECK(at_heads <= 34);
  CHECK(std::abs(static_cast<double>(valve.chords.size()) - 100) <= 8);
}

TEST_CASE("a_trunk_has_the_cross_section_of_its_branches") {
  const Valve valve = make_parametric_valve({});
  for (const Chord &trunk : valve.chords) {
    if (trunk.kind != ChordKind::trunk) continue;
    double branches = 0;
    for (const Chord &chord : valve.chords) {
      if (chord.a == trunk.b) branches += chord.area;
    }
    CHECK(trunk.area == about(branches));
  }
}

TEST_CASE("the_open_leaflets_have_the_heights_of_the_design") {
  const Shape shape(resolve_dimensions({}));
  for (const double theta : {0.0, 0.4, 1.2, Shape::commissure, 2.0, 2.9, pi}) {
    constexpr int steps = 200;
    double length = 0;
    for (int i = 0; i < steps; ++i) {
      length +=
          (shape.open({theta, (i + 1.0) / steps}) - shape.open({theta, 1.0 * i / steps})).norm();
    }
    // the polygon of an arc is shorter by (tilt / steps)^2 / 24
    CHECK(length == about(shape.height(theta), 1e-5));
  }
}

TEST_CASE("both_leaflets_overlap_by_the_same_length_at_every_size") {
  for (const double ap : {24 * mm, 26 * mm, 28 * mm}) {
    mvs_parametric_desc desc = {};
    desc.annulus_ap = ap;
    const Shape shape(resolve_dimensions(desc));
    // both free edges of the closed target lie at one depth, the overlap below the line
    const double anterior = shape.closed({0, 1}).z(), posterior = shape.closed({pi, 1}).z();
    CHECK(anterior == about(posterior, 1e-6));
  }
}

TEST_CASE("healthy_valves_of_other_sizes_close") {
  struct Size {
    double ap, cc, anterior, posterior;
    uint32_t vertices;
  };
  for (const Size &size : {Size{24 * mm, 32 * mm, 23 * mm, 13 * mm, 300},
                           Size{28 * mm, 38 * mm, 27 * mm, 15 * mm, 432}}) {
    CAPTURE(size.ap);
    mvs_parametric_desc desc = {};
    desc.vertices = size.vertices;
    desc.annulus_ap = size.ap;
    desc.annulus_cc = size.cc;
    desc.anterior_height = size.anterior;
    desc.posterior_height = size.posterior;
    const ModelPtr model = make_model(make_parametric_valve(desc));
    State state = initial_state(*model);
    state.load = {systole, 1};
    Solver solver(Backend::fastest);
    SolveOptions options;
    options.residual = 1e-4;
    CHECK(solver.settle(*model, state, options, {}).converged);
    CHECK(find_intersections(state.x, model->valve.triangles).empty());
    CHECK(measure_orifice(*model, state.x).area == 0);
    CHECK(measure_tenting_billow(*model, state.x).billow_height < 2 * mm);
  }
}
