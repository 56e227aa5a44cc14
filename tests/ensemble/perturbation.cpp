// Perturbations of a starting shape: bounded, smooth, equal on every machine, without crossings.
#include "ensemble/perturbation.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "anatomy/parametric.h"
#include "geometry/intersect.h"
#include "tests/about.h"

using namespace mvs::core;
using mvs::core::test::about;

namespace {

ModelPtr valve(uint32_t vertices) {
  mvs_parametric_desc desc = {};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.vertices = vertices;
  return make_model(make_parametric_valve(desc));
}

}  // namespace

TEST_CASE("random numbers are the same on every machine, uniform, and differ between streams") {
  // computed by the definition with Python's integers
  Random first(0, 0), second(1, 2), random(0, 0);
  CHECK(first.next() == 0xa706dd2f4d197e6fu);
  CHECK(first.next() == 0xb382a305f4414f5eu);
  CHECK(second.next() == 0xf602ec30f98a3929u);
  CHECK(second.next() == 0xd4287dc8647be13du);
  double mean = 0, square = 0;
  Vec3 sum = Vec3::Zero();
  constexpr int count = 10000;
  for (int k = 0; k < count; ++k) {
    const double u = random.uniform();
    CHECK_UNARY(u >= 0 && u < 1);
    mean += u / count;
    square += u * u / count;
    const Vec3 d = random.direction();
    CHECK(d.norm() == about(1, 1e-14));
    sum += d / count;
  }
  // five standard errors: sqrt(1/12 / n), sqrt(4/45 / n), sqrt(1/3 / n) a component
  CHECK(std::abs(mean - 1.0 / 2) < 5 * 0.289 / 100);
  CHECK(std::abs(square - 1.0 / 3) < 5 * 0.298 / 100);
  CHECK(sum.cwiseAbs().maxCoeff() < 5 * 0.577 / 100);
}

TEST_CASE("the farthest node moves by the requested distance, prescribed nodes stay") {
  const ModelPtr model = valve(300);
  const std::vector<Vec3> rest = model->valve.rest;
  std::vector<Vec3> x = rest;
  const double moved = disturb(*model, x, {0.1e-3, 5e-3}, {7, 1});
  // the open leaflets are farther apart than that, so the displacement is not shortened
  CHECK(moved == about(0.1e-3, 1e-12));
  double farthest = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    farthest = std::max(farthest, (x[i] - rest[i]).norm());
    if (model->topology.fixed[i]) CHECK(x[i] == rest[i]);
  }
  CHECK(farthest == about(moved, 1e-12));
  std::vector<Vec3> again = rest, none_at_all = rest;
  disturb(*model, again, {0.1e-3, 5e-3}, {7, 1});
  CHECK(again == x);
  CHECK(disturb(*model, none_at_all, {0, 5e-3}, {7, 1}) == 0);
  CHECK(none_at_all == rest);
}

TEST_CASE("neighbours move together: a wave is longer than an edge") {
  const ModelPtr model = valve(300);
  const std::vector<Vec3> rest = model->valve.rest;
  std::vector<Vec3> x = rest;
  disturb(*model, x, {0.1e-3, 20e-3}, {7, 1});
  double difference = 0, size = 0;
  for (const Edge &e : model->topology.edges) {
    difference += ((x[e[0]] - rest[e[0]]) - (x[e[1]] - rest[e[1]])).squaredNorm();
    size += (x[e[0]] - rest[e[0]]).squaredNorm() + (x[e[1]] - rest[e[1]]).squaredNorm();
  }
  // independent neighbours would give 1; edges of 2 mm under waves of 20 mm and more give (2 pi 2 /
  // 20)^2 / 2 = 0.2 at most
  CHECK(difference / size < 0.2);
}

TEST_CASE("a perturbation that would make sheets meet is shortened before they meet") {
  const ModelPtr model = valve(300);
  for (uint64_t stream = 1; stream <= 10; ++stream) {
    std::vector<Vec3> x = model->valve.rest;
    CHECK(disturb(*model, x, {5e-3, 1e-3}, {1, stream}) > 0);
    CHECK(find_intersections(x, model->valve.triangles).empty());
  }
}
