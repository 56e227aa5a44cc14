// Frame of a valve from its annulus: centroid, plane of least squares, landmarks.
#include "measure/annulus/frame.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "measure/annulus/landmarks.h"

namespace mvs::core {
namespace {

// Vector area of the annulus, traversed in the winding of its triangles. Their normals point into
// the atrium, and so does this vector, however far the leaflets have moved.
Vec3 area_towards_atrium(const Model &model, const Loop &loop, const Vec3 &origin) {
  const std::vector<uint32_t> triangles = annulus_triangles(model);
  Vec3 sum = Vec3::Zero();
  for (size_t k = 0; k < loop.size(); ++k) {
    if (triangles[k] == none) continue;
    const Tri &triangle = model.valve.triangles[triangles[k]];
    const uint32_t a = model.valve.annulus[k];
    const uint32_t b = model.valve.annulus[(k + 1) % loop.size()];
    bool same_way = false;
    for (size_t c = 0; c < 3; ++c) {
      same_way |= triangle[c] == a && triangle[(c + 1) % 3] == b;
    }
    const Vec3 area = 0.5 * (loop.point(k) - origin).cross(loop.point(k + 1) - origin);
    sum += same_way ? area : -area;
  }
  return sum;
}

}  // namespace

std::vector<Vec3> Frame::local(const std::vector<Vec3> &points) const {
  std::vector<Vec3> moved;
  moved.reserve(points.size());
  for (const Vec3 &p : points) moved.push_back(local(p));
  return moved;
}

Frame valve_frame(const Model &model, const std::vector<Vec3> &x) {
  const Loop loop(model.valve.annulus, x);
  Frame frame;
  frame.origin = centroid(loop);
  const Eigen::SelfAdjointEigenSolver<Mat3> moments(second_moments(loop, frame.origin));
  Vec3 axis = moments.eigenvectors().col(0);
  if (axis.dot(area_towards_atrium(model, loop, frame.origin)) < 0) axis = -axis;

  const Landmarks landmarks = find_landmarks(model, loop);
  Vec3 ap = landmarks.a - landmarks.p;
  ap = (ap - ap.dot(axis) * axis).normalized();
  frame.axes.row(0) = ap;
  frame.axes.row(1) = axis.cross(ap);
  frame.axes.row(2) = axis;
  return frame;
}

}  // namespace mvs::core
