// Vertices of balls, capsules, boxes, cylinders, cones and hulls.
#include "session/tool_bodies.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/array_view.h"
#include "base/error.h"
#include "base/option_checks.h"
#include "geometry/aabb.h"
#include "geometry/convex_hull.h"
#include "session/tools.h"

namespace mvs::core {
namespace {

static_assert(most_tool_bodies == MVS_MAX_BODIES && most_tool_vertices == MVS_MAX_BODY_VERTICES);

constexpr double least_size = 1e-4;    // m, least size of an edge, radius or hull
constexpr double default_ball = 2e-3;  // m

// One body under construction, with the name of its field for messages.
struct BodyReader {
  const mvs_body_desc &desc;
  std::string name;
  bool strict;
  std::vector<std::string> &warnings;

  Vec3 place(const double given[3], const char *field) const;
  double size(int k) const;
  double radius() const;
  std::vector<Vec3> box() const;
  std::vector<Vec3> hull() const;
  std::vector<Vec3> segment() const;
  // Points of a circle around `centre` in the plane normal to the way from `position` to `end`.
  void add_circle(const Vec3 &centre, std::vector<Vec3> &to) const;
  std::vector<Vec3> vertices() const;
};

Vec3 BodyReader::place(const double given[3], const char *field) const {
  const Vec3 at(given[0], given[1], given[2]);
  MVS_MUST((at.cwiseAbs().array() <= most_body_extent).all(), MVS_E_ARGUMENT, name.c_str(),
           "%s.%s is (%g, %g, %g) m: each has to be a number within %g", name.c_str(), field,
           at.x(), at.y(), at.z(), most_body_extent);
  // 0.0 instead of -0.0, so that equal bodies have equal bits
  return at + Vec3::Zero();
}

double BodyReader::size(int k) const {
  const double value = desc.size[k];
  MVS_MUST(value >= least_size && value <= most_body_extent, MVS_E_ARGUMENT, name.c_str(),
           "%s.size[%d] is %g m: it has to be %g to %g", name.c_str(), k, value, least_size,
           most_body_extent);
  return value;
}

double BodyReader::radius() const {
  const bool is_round = desc.kind == MVS_BODY_KIND_BALL || desc.kind == MVS_BODY_KIND_CAPSULE;
  const std::string field = name + ".radius";
  must_be_in(desc.radius, is_round ? least_size : 0, most_body_radius, field.c_str());
  return is_round ? value_or(desc.radius, default_ball) : desc.radius;
}

std::vector<Vec3> BodyReader::segment() const {
  const Vec3 a = place(desc.position, "position"), b = place(desc.end, "end");
  MVS_MUST((b - a).norm() >= least_size, MVS_E_ARGUMENT, name.c_str(),
           "%s has its end within %g m of its position: it has no direction", name.c_str(),
           least_size);
  return {a, b};
}

std::vector<Vec3> BodyReader::box() const {
  const Vec3 centre = place(desc.position, "position");
  const Vec3 half = 0.5 * Vec3(size(0), size(1), size(2));
  const std::string field = name + ".orientation";
  const Mat3 turn = rotation_of(read_orientation(desc.orientation, field.c_str()));
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k) {
    const Vec3 sign(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    corners.push_back(centre + turn * half.cwiseProduct(sign));
  }
  return corners;
}

void BodyReader::add_circle(const Vec3 &centre, std::vector<Vec3> &to) const {
  const std::vector<Vec3> ends = segment();
  const Vec3 axis = (ends[1] - ends[0]).normalized();
  int smallest = 0;
  axis.cwiseAbs().minCoeff(&smallest);
  const Vec3 u = axis.cross(Vec3::Unit(smallest)).normalized(), v = axis.cross(u);
  const double radius = size(0);
  // cosine and sine of 15 degrees
  static_assert(MVS_BODY_CIRCLE_VERTICES == 24);
  const double c = (std::sqrt(6.0) + std::sqrt(2.0)) / 4, s = (std::sqrt(6.0) - std::sqrt(2.0)) / 4;
  double x = 1, y = 0;
  for (int k = 0; k < MVS_BODY_CIRCLE_VERTICES; ++k) {
    to.push_back(centre + radius * (x * u + y * v));
    const double turned = c * x - s * y;
    y = s * x + c * y;
    x = turned;
  }
}

std::vector<Vec3> BodyReader::hull() const {
  const std::vector<Vec3> given = read_points(desc.vertices, (name + ".vertices").c_str());
  MVS_MUST(given.size() >= 4, MVS_E_ARGUMENT, name.c_str(),
           "%s is a hull with %zu vertices: it needs at least 4", name.c_str(), given.size());
  MVS_MUST(given.size() <= most_tool_vertices, MVS_E_ARGUMENT, name.c_str(),
           "%s is a hull with %zu vertices: a tool has at most %u", name.c_str(), given.size(),
           most_tool_vertices);
  std::vector<Vec3> points;
  points.reserve(given.size());
  for (const Vec3 &v : given) points.push_back(place(v.data(), "vertices"));
  const ConvexHull hull = convex_hull(points);
  MVS_MUST(!hull.faces.empty(), MVS_E_ARGUMENT, name.c_str(),
           "%s is a hull whose vertices lie in one plane or coincide: it has no volume; use a box, "
           "or give it a thickness",
           name.c_str());
  const double extent = aabb_of(points).longest_side();
  MVS_MUST(extent >= least_size, MVS_E_ARGUMENT, name.c_str(),
           "%s is a hull whose vertices lie within %g m of each other along every axis: a body is "
           "at least %g m long, so that tissue can feel its shape; check the unit, which is m, or "
           "use a ball",
           name.c_str(), extent, least_size);
  const size_t more = points.size() - hull.corners.size();
  MVS_MUST(more == 0 || !strict, MVS_E_ARGUMENT, name.c_str(),
           "%s is not convex: %zu of its %zu vertices are no corners of their hull", name.c_str(),
           more, points.size());
  if (more > 0) {
    warnings.push_back(name + ": " + std::to_string(more) + " of " + std::to_string(points.size()) +
                       " vertices are no corners of their convex hull and were dropped; split a "
                       "shape that is not convex into several bodies");
  }
  std::vector<Vec3> corners;
  for (const uint32_t k : hull.corners) corners.push_back(points[k]);
  return corners;
}

std::vector<Vec3> BodyReader::vertices() const {
  if (desc.kind == MVS_BODY_KIND_HULL) return hull();
  MVS_MUST(!is_given(desc.vertices), MVS_E_ARGUMENT, name.c_str(),
           "%s has vertices, but only a hull has them", name.c_str());
  if (desc.kind == MVS_BODY_KIND_BALL) return {place(desc.position, "position")};
  if (desc.kind == MVS_BODY_KIND_CAPSULE) return segment();
  if (desc.kind == MVS_BODY_KIND_BOX) return box();
  const std::vector<Vec3> ends = segment();
  std::vector<Vec3> corners;
  add_circle(ends[0], corners);
  if (desc.kind == MVS_BODY_KIND_CYLINDER) {
    add_circle(ends[1], corners);
  } else {
    corners.push_back(ends[1]);
  }
  return corners;
}

ToolBody read_body(const BodyReader &reader) {
  const mvs_body_desc &desc = reader.desc;
  MVS_MUST(desc.kind >= MVS_BODY_KIND_HULL && desc.kind <= MVS_BODY_KIND_CONE, MVS_E_ARGUMENT,
           reader.name.c_str(), "%s.kind is %u: it has to be one of MVS_BODY_KIND_*",
           reader.name.c_str(), desc.kind);
  must_be_zero(desc.reserved, (reader.name + ".reserved").c_str());
  ToolBody body;
  body.kind = static_cast<BodyKind>(desc.kind);
  body.radius = reader.radius();
  body.vertices = reader.vertices();
  return body;
}

}  // namespace

ToolShapePtr read_bodies(const std::vector<mvs_body_desc> &bodies, const std::string &of,
                         bool strict, std::vector<std::string> &warnings) {
  MVS_MUST(!bodies.empty() && bodies.size() <= most_tool_bodies, MVS_E_ARGUMENT, of.c_str(),
           "%s.body_count is %zu: a convex tool has 1 to %u bodies", of.c_str(), bodies.size(),
           most_tool_bodies);
  std::vector<ToolBody> read;
  size_t vertices = 0;
  for (size_t k = 0; k < bodies.size(); ++k) {
    const std::string name = of + ".bodies[" + std::to_string(k) + "]";
    read.push_back(read_body({bodies[k], name, strict, warnings}));
    vertices += read.back().vertices.size();
    MVS_MUST(vertices <= most_tool_vertices, MVS_E_ARGUMENT, name.c_str(),
             "the bodies up to %s have %zu vertices: a tool has at most %u", name.c_str(), vertices,
             most_tool_vertices);
  }
  MVS_MUST(are_valid(read), MVS_E_ARGUMENT, of.c_str(),
           "a body of the tool reaches farther than %g m from the hand along an axis",
           most_body_extent);
  return ToolShapePtr(std::make_shared<const ToolShape>(std::move(read)));
}

Vec3 read_orientation(const double given[4], const char *what) {
  double largest = 0;
  for (int k = 0; k < 4; ++k) {
    MVS_MUST(std::isfinite(given[k]), MVS_E_ARGUMENT, what,
             "%s is (%g, %g, %g, %g): it has to be a quaternion w x y z", what, given[0], given[1],
             given[2], given[3]);
    largest = std::max(largest, std::abs(given[k]));
  }
  if (largest == 0) return Vec3::Zero();
  return rodrigues_of({given[0], given[1], given[2], given[3]}) + Vec3::Zero();
}

}  // namespace mvs::core
