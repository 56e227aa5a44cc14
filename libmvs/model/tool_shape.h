// The shape of a convex tool: rounded convex bodies on an affine frame of four points.
//
// A body is the hull of its vertices, rounded by a radius. The four points of the frame are the
// corners of a regular tetrahedron around the hand's place c at the distance `arm`: p_k = c + arm R
// t_k, R the orientation. Each vertex v, in the frame of the hand, is an affine combination of
// them with the weights w_k = 1/4 + 3/4 t_k v / arm, so that forces on a body, their derivatives
// and limits of steps become those of four nodes (affine body dynamics: Lan et al., ACM Trans.
// Graph. 41(4), 2022). Springs of equal stiffness at the four points resist translation alone where
// a force acts at c, and the rotation about each axis alike.
//
// An orientation is stored as modified Rodrigues parameters m = q_v / (1 + q_w) of the quaternion
// with q_w >= 0 (Schaub & Junkins, J. Astronaut. Sci. 44, 1996): three numbers, rational both ways.
#pragma once

#include <memory>
#include <vector>

#include "base/cow_vector.h"
#include "base/types.h"
#include "model/kinds.h"

namespace mvs::core {

// Points of the frame of a convex tool.
inline constexpr uint32_t frame_points = 4;
using FrameWeights = std::array<double, frame_points>;
using Quaternion = std::array<double, 4>;  // w x y z

struct ToolBody {
  BodyKind kind = BodyKind::hull;  // as given
  double radius = 0;               // m, of the rounding
  CowVector<Vec3> vertices;        // m, in the frame of the hand
};

class ToolShape {
 public:
  explicit ToolShape(std::vector<ToolBody> bodies);

  const std::vector<ToolBody> &bodies() const { return bodies_; }
  // Weights of the frame's points, for each vertex of a body.
  const std::vector<FrameWeights> &weights(size_t body) const { return weights_[body]; }
  // Triangles of the surface of the hull of a body, with outward normals; none for a flat one.
  const std::vector<Tri> &faces(size_t body) const { return faces_[body]; }
  double arm() const { return arm_; }  // m, distance of the frame's points from the hand
  size_t vertex_count() const;

 private:
  std::vector<ToolBody> bodies_;
  std::vector<std::vector<FrameWeights>> weights_;
  std::vector<std::vector<Tri>> faces_;
  double arm_ = 0;
};

// A shape that tools share; equal if the bodies have the same bits. Null for a tool without.
class ToolShapePtr {
 public:
  ToolShapePtr() = default;
  ToolShapePtr(std::shared_ptr<const ToolShape> shape) : shape_(std::move(shape)) {}
  const ToolShape &operator*() const { return *shape_; }
  const ToolShape *operator->() const { return shape_.get(); }
  const ToolShape *get() const { return shape_.get(); }
  explicit operator bool() const { return shape_ != nullptr; }
  bool operator==(const ToolShapePtr &other) const;

 private:
  std::shared_ptr<const ToolShape> shape_;
};

// Limits of a shape.
inline constexpr uint32_t most_tool_bodies = 16, most_tool_vertices = 2048;
inline constexpr double most_body_extent = 0.3, most_body_radius = 0.02;  // m

// Returns whether bodies can be those of a tool: counts and sizes are in their limits, and each
// body has a vertex. A shape is only made of such bodies.
bool are_valid(const std::vector<ToolBody> &bodies);

// Direction t_k of a corner of the frame's tetrahedron.
const Vec3 &frame_corner(uint32_t k);
// m, the length of the six edges of the frame.
double frame_edge(double arm);

Mat3 rotation_of(const Vec3 &rodrigues);
Quaternion quaternion_of(const Vec3 &rodrigues);
Vec3 rodrigues_of(const Quaternion &quaternion);  // any length above 0

// The pose of a frame: the mean of its points, and the rotation nearest to its affine map (the
// orthogonal factor of a polar decomposition, by Newton's iteration: Higham, SIAM J. Sci. Stat.
// Comput. 7, 1986).
struct FramePose {
  Vec3 position;
  Mat3 rotation;
};
FramePose pose_of(const std::array<Vec3, frame_points> &points, double arm);
Quaternion quaternion_of(const Mat3 &rotation);

}  // namespace mvs::core
