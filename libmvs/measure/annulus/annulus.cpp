// Measures of the annulus: diameters between landmarks, the rest from the loop in the valve's
// frame.
#include "measure/annulus/annulus.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "measure/annulus/annulus_map.h"
#include "measure/annulus/frame.h"
#include "measure/annulus/landmarks.h"

namespace mvs::core {
namespace {

double projected_area(const Loop &loop, const Frame &frame) {
  Vec3 sum = Vec3::Zero();
  for (size_t k = 0; k < loop.size(); ++k) {
    sum += 0.5 * (loop.point(k) - frame.origin).cross(loop.point(k + 1) - frame.origin);
  }
  return std::abs(sum.dot(frame.axes.row(2)));
}

double height_over_plane(const Loop &loop, const Frame &frame) {
  const auto lower = [&](const Vec3 &a, const Vec3 &b) {
    return frame.local(a)[2] < frame.local(b)[2];
  };
  const auto ends = std::minmax_element(loop.points().begin(), loop.points().end(), lower);
  return frame.local(*ends.second)[2] - frame.local(*ends.first)[2];
}

// Angle at the midpoint between the commissures, from the A to the P point; pi for a flat annulus.
double nonplanar_angle(const Landmarks &landmarks) {
  const Vec3 middle = 0.5 * (landmarks.commissure[0] + landmarks.commissure[1]);
  const Vec3 to_a = landmarks.a - middle, to_p = landmarks.p - middle;
  return math::atan2(to_a.cross(to_p).norm(), to_a.dot(to_p));
}

}  // namespace

AnnulusMeasures measure_annulus(const Model &model, const std::vector<Vec3> &x) {
  const Loop loop(model.valve.annulus, x);
  const Frame frame = valve_frame(model, x);
  const Landmarks landmarks = find_landmarks(model, loop);
  AnnulusMeasures measures;
  measures.ap = (landmarks.a - landmarks.p).norm();
  measures.cc = (landmarks.commissure[0] - landmarks.commissure[1]).norm();
  measures.perimeter = loop.length();
  measures.area_3d = annulus_map(frame, loop.points())->area();
  measures.area = projected_area(loop, frame);
  measures.saddle_height = height_over_plane(loop, frame);
  measures.nonplanar_angle = nonplanar_angle(landmarks);
  return measures;
}

}  // namespace mvs::core
