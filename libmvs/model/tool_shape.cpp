// Weights of the vertices of convex tools; poses of their frames.
#include "model/tool_shape.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "geometry/aabb.h"
#include "geometry/convex_hull.h"

namespace mvs::core {
namespace {

// m. A frame smaller than this turns about itself too easily: its resistance grows with the square.
constexpr double least_arm = 2e-3;
// Turns of the polar decomposition: it doubles the digits in each, and a frame is stretched by a
// few per cent.
constexpr int polar_turns = 8;

FrameWeights weights_of(const Vec3 &vertex, double arm) {
  FrameWeights weights;
  for (uint32_t k = 0; k < frame_points; ++k)
    weights[k] = 0.25 + 0.75 / arm * frame_corner(k).dot(vertex);
  return weights;
}

// -0.0 and 0.0 differ, as in a hash.
bool have_same_bits(const std::vector<Vec3> &a, const std::vector<Vec3> &b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0);
}

// m. A body is 0.1 mm long at least (session/tool_bodies.cpp); the box around an oblique one is
// shorter by up to the square root of 3.
constexpr double least_side = 0.5e-4;

bool is_within_extent(const Vec3 &v) {
  return (v.cwiseAbs().array() <= most_body_extent).all();
}

}  // namespace

const Vec3 &frame_corner(uint32_t k) {
  static const double s = 1 / std::sqrt(3.0);
  static const std::array<Vec3, frame_points> corners = {Vec3(s, s, s), Vec3(s, -s, -s),
                                                         Vec3(-s, s, -s), Vec3(-s, -s, s)};
  return corners[k];
}

double frame_edge(double arm) {
  return std::sqrt(8.0 / 3) * arm;
}

ToolShape::ToolShape(std::vector<ToolBody> bodies) : bodies_(std::move(bodies)), arm_(least_arm) {
  for (const ToolBody &body : bodies_) {
    for (const Vec3 &v : body.vertices.get()) arm_ = std::max(arm_, v.norm());
  }
  for (const ToolBody &body : bodies_) {
    std::vector<FrameWeights> weights;
    for (const Vec3 &v : body.vertices.get()) weights.push_back(weights_of(v, arm_));
    weights_.push_back(std::move(weights));
    faces_.push_back(convex_hull(body.vertices).faces);
  }
}

size_t ToolShape::vertex_count() const {
  size_t count = 0;
  for (const ToolBody &body : bodies_) count += body.vertices.size();
  return count;
}

bool ToolShapePtr::operator==(const ToolShapePtr &other) const {
  if (shape_ == other.shape_) return true;
  if (!shape_ || !other.shape_) return false;
  return std::equal(shape_->bodies().begin(), shape_->bodies().end(), other->bodies().begin(),
                    other->bodies().end(), [](const ToolBody &a, const ToolBody &b) {
                      return a.kind == b.kind && a.radius == b.radius &&
                             have_same_bits(a.vertices, b.vertices);
                    });
}

bool are_valid(const std::vector<ToolBody> &bodies) {
  size_t count = 0;
  for (const ToolBody &body : bodies) {
    const std::vector<Vec3> &vertices = body.vertices;
    count += vertices.size();
    const bool is_body = body.kind >= BodyKind::hull && body.kind <= BodyKind::cone &&
                         body.radius >= 0 && body.radius <= most_body_radius && !vertices.empty() &&
                         count <= most_tool_vertices;
    if (!is_body || !std::all_of(vertices.begin(), vertices.end(), is_within_extent)) return false;
    if (vertices.size() > 1 && aabb_of(vertices).longest_side() < least_side) return false;
  }
  return !bodies.empty() && bodies.size() <= most_tool_bodies;
}

Quaternion quaternion_of(const Vec3 &m) {
  const double s = m.squaredNorm(), scale = 2 / (1 + s);
  return {(1 - s) / (1 + s), scale * m.x(), scale * m.y(), scale * m.z()};
}

Vec3 rodrigues_of(const Quaternion &q) {
  const double size = std::max({std::abs(q[0]), std::abs(q[1]), std::abs(q[2]), std::abs(q[3])});
  const double w = q[0] / size;
  const Vec3 v = Vec3(q[1], q[2], q[3]) / size;
  const double length = std::sqrt(w * w + v.squaredNorm());
  return (w < 0 ? -1 : 1) / (length + std::abs(w)) * v;
}

Mat3 rotation_of(const Vec3 &rodrigues) {
  const auto [w, x, y, z] = quaternion_of(rodrigues);
  Mat3 r;
  r << 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),   //
      2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y);
  return r;
}

FramePose pose_of(const std::array<Vec3, frame_points> &points, double arm) {
  FramePose pose;
  pose.position = 0.25 * (points[0] + points[1] + points[2] + points[3]);
  Mat3 map = Mat3::Zero();
  for (uint32_t k = 0; k < frame_points; ++k)
    map += 0.75 / arm * (points[k] - pose.position) * frame_corner(k).transpose();
  for (int turn = 0; turn < polar_turns && map.determinant() != 0; ++turn)
    map = 0.5 * (map + map.inverse().transpose()).eval();
  pose.rotation = map;
  return pose;
}

// From the largest of the four numbers (Shepperd, J. Guidance Control 1, 1978).
Quaternion quaternion_of(const Mat3 &r) {
  const std::array<double, 4> four = {
      1 + r(0, 0) + r(1, 1) + r(2, 2), 1 + r(0, 0) - r(1, 1) - r(2, 2),
      1 - r(0, 0) + r(1, 1) - r(2, 2), 1 - r(0, 0) - r(1, 1) + r(2, 2)};
  const auto largest = std::max_element(four.begin(), four.end()) - four.begin();
  const double x = r(2, 1) - r(1, 2), y = r(0, 2) - r(2, 0), z = r(1, 0) - r(0, 1);
  const double xy = r(0, 1) + r(1, 0), xz = r(0, 2) + r(2, 0), yz = r(1, 2) + r(2, 1);
  const std::array<Quaternion, 4> rows = {
      Quaternion{four[0], x, y, z}, Quaternion{x, four[1], xy, xz}, Quaternion{y, xy, four[2], yz},
      Quaternion{z, xz, yz, four[3]}};
  Quaternion q = rows[static_cast<size_t>(largest)];
  double length2 = 0;
  for (const double c : q) length2 += c * c;
  const double scale = (q[0] < 0 ? -1 : 1) / std::sqrt(length2);
  for (double &c : q) c *= scale;
  return q;
}

}  // namespace mvs::core
