#include "tests/solve/convex_tools.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace mvs::core::test {

Tool convex_at(const Vec3 &position, std::vector<ToolBody> bodies) {
  Tool tool;
  tool.kind = ToolKind::convex;
  tool.shape = ToolShapePtr(std::make_shared<const ToolShape>(std::move(bodies)));
  tool.length = tool.shape->arm();
  tool.position = position;
  tool.node = none;
  tool.stiffness = 200;
  tool.max_force = 2;
  return tool;
}

ToolBody hull_body(std::vector<Vec3> points, double radius) {
  return {BodyKind::hull, radius, std::move(points)};
}

ToolBody ball_body(double radius) {
  return {BodyKind::ball, radius, {Vec3::Zero()}};
}

ToolBody capsule_body(const Vec3 &along, double length, double radius) {
  const Vec3 half = 0.5 * length * along.normalized();
  return {BodyKind::capsule, radius, {-half, half}};
}

ToolBody cone_body(const Vec3 &along, double length, double wide, double radius) {
  const Vec3 axis = along.normalized(), u = axis.unitOrthogonal(), v = axis.cross(u);
  std::vector<Vec3> points = {radius * axis};
  for (int k = 0; k < 8; ++k) {
    const double angle = std::numbers::pi * k / 4;
    points.push_back(length * axis + wide * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return hull_body(std::move(points), radius);
}

ToolBody bar_body(const Vec3 &along, const Vec3 &up, double radius) {
  const Vec3 a = along.normalized(), u = up.normalized(), w = a.cross(u);
  std::vector<Vec3> points;
  for (const double s : {-2e-3, 2e-3}) {
    for (const double side : {-0.7e-3, 0.7e-3}) points.push_back(s * a + 0.7e-3 * u + side * w);
    points.push_back(s * a);
    points.push_back(s * a + 1.4e-3 * u);
  }
  return hull_body(std::move(points), radius);
}

ToolBody polyhedral_ball(double radius, uint32_t vertices) {
  std::vector<Vec3> points;
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  for (uint32_t k = 0; k < vertices; ++k) {
    const double z = 1 - (2.0 * k + 1) / vertices, r = std::sqrt(1 - z * z);
    points.push_back(radius * Vec3(r * std::cos(golden * k), r * std::sin(golden * k), z));
  }
  return hull_body(std::move(points), 0);
}

ToolBody box_body(const Vec3 &half, double radius) {
  std::vector<Vec3> points;
  points.reserve(8);
  for (int k = 0; k < 8; ++k)
    points.push_back(half.cwiseProduct(Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
  return {BodyKind::box, radius, std::move(points)};
}

std::vector<ToolBody> hook_bodies(double radius) {
  const Vec3 heel = Vec3::Zero(), toe(3e-3, 0, 0);
  return {{BodyKind::capsule, radius, {heel, Vec3(0, 0, 15e-3)}},
          {BodyKind::capsule, radius, {heel, toe}},
          {BodyKind::capsule, radius, {toe, Vec3(3e-3, 0, 2e-3)}}};
}

// Along the longest side of the box around all of them.
Tool random_tool(Random &random, int kind, const Vec3 &at) {
  const Vec3 along = random.vector(1).normalized();
  const double radius = random(0, 0.5e-3);
  if (kind == 0) return convex_at(at, {cone_body(along, random(2e-3, 6e-3), 2e-3, radius)});
  if (kind == 1) return convex_at(at, {capsule_body(along, random(2e-3, 8e-3), 0.3e-3 + radius)});
  if (kind == 2) return convex_at(at, {hull_body(random.vectors(12, 2e-3), radius)});
  if (kind == 3) return convex_at(at, {bar_body(along, along.unitOrthogonal(), radius)});
  if (kind == 4) return convex_at(at, {polyhedral_ball(random(1e-3, 3e-3), 40)});
  return convex_at(at, hook_bodies(0.4e-3));
}

Tool bounding_capsule(const std::vector<ToolBody> &bodies) {
  Vec3 low = Vec3::Constant(1), high = -low;
  for (const ToolBody &body : bodies) {
    for (const Vec3 &v : body.vertices.get()) {
      low = low.cwiseMin(v - Vec3::Constant(body.radius));
      high = high.cwiseMax(v + Vec3::Constant(body.radius));
    }
  }
  const Vec3 middle = 0.5 * (low + high), half = 0.5 * (high - low);
  int longest = 0;
  half.maxCoeff(&longest);
  Vec3 across = half;
  across[longest] = 0;
  const Vec3 end = half[longest] * Vec3::Unit(longest);
  return convex_at(Vec3::Zero(),
                   {{BodyKind::capsule, across.norm(), {middle - end, middle + end}}});
}

Place place_above(const Model &model, const std::vector<Vec3> &x, uint32_t triangle,
                  double height) {
  const auto [a, b, c] = model.valve.triangles[triangle];
  const Vec3 n = (x[b] - x[a]).cross(x[c] - x[a]).normalized();
  return {(x[a] + x[b] + x[c]) / 3 + height * n, n, (x[b] - x[a]).normalized()};
}

}  // namespace mvs::core::test
