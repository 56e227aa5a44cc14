// Nearest points of the sides, and the affine motion to them by least squares.
#include "patient/annulus/affine_meeting.h"

#include <algorithm>
#include <cmath>

#include "base/median.h"
#include "geometry/distance.h"
#include "patient/fit/normal_equations.h"

namespace mvs::core {
namespace {

// A point counts if it is at most 2.5 times as far from the rims as the median (normal errors: 91 %
// of them), or a millimetre, a voxel and a half of ultrasound.
constexpr double usual_rim_share = 2.5, usual_rim = 1e-3;
// m: spread of the points along an axis from which on their stretch along it counts. In its plane
// the annulus spreads five times as far (RMS), so that a stretch is found to 4 %; across it, by the
// height of the saddle, a stretch would follow the errors of the rims.
constexpr double least_spread = 2e-3;
constexpr double constant_term = 1e-2;  // m, of the affine motion: about as large as coordinates
constexpr int most_motion_rounds = 30;
constexpr double least_motion_step = 1e-6;  // m

// The motion of points `from`, relative to their centre, by `step`, by least squares.
Affine affine_of(const std::vector<Vec3> &from, const std::vector<Vec3> &step) {
  DenseMatrix h(4);
  std::array<std::vector<double>, 3> right;
  right.fill(std::vector<double>(4, 0));
  for (size_t k = 0; k < from.size(); ++k) {
    const std::array<double, 4> terms = {from[k].x(), from[k].y(), from[k].z(), constant_term};
    for (size_t i = 0; i < 4; ++i) {
      for (size_t j = 0; j < 4; ++j) h.at(i, j) += terms[i] * terms[j];
      for (size_t axis = 0; axis < 3; ++axis)
        right[axis][i] += terms[i] * step[k][static_cast<Eigen::Index>(axis)];
    }
  }
  for (size_t i = 0; i < 3; ++i)
    h.at(i, i) += static_cast<double>(from.size()) * least_spread * least_spread;
  Affine found;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const std::vector<double> row = solve_dense(h, right[static_cast<size_t>(axis)]);
    for (Eigen::Index k = 0; k < 3; ++k) found.stretch(axis, k) = row[static_cast<size_t>(k)];
    found.shift[axis] = constant_term * row[3];
  }
  return found;
}

}  // namespace

std::vector<CurveSide> sides_of(const std::vector<Vec3> &polygon) {
  std::vector<CurveSide> sides;
  for (size_t k = 0; k < polygon.size(); ++k)
    sides.push_back({polygon[k], polygon[(k + 1) % polygon.size()]});
  return sides;
}

Vec3 nearest_on_sides(const std::vector<CurveSide> &sides, const Vec3 &p) {
  Vec3 best = p;
  double least = HUGE_VAL;
  for (const CurveSide &side : sides) {
    const SegmentPoint at = closest_on_segment(p, side[0], side[1]);
    const Vec3 q = side[0] + at.s * (side[1] - side[0]);
    const double distance2 = (q - p).squaredNorm();
    if (distance2 >= least) continue;
    least = distance2;
    best = q;
  }
  return best;
}

Meeting meet(const std::vector<Vec3> &points, const Vec3 &centre,
             const std::vector<CurveSide> &sides, double reach) {
  std::vector<Vec3> around;  // relative to the centre
  around.reserve(points.size());
  for (const Vec3 &p : points) around.push_back(p - centre);
  Meeting found;
  for (int round = 0; round < most_motion_rounds; ++round) {
    std::vector<Vec3> to;
    std::vector<double> away;
    for (const Vec3 &p : around) {
      const Vec3 here = centre + p + found.motion.stretch * p + found.motion.shift;
      to.push_back(nearest_on_sides(sides, here));
      away.push_back((to.back() - here).norm());
    }
    const double most = std::min(reach, std::max(usual_rim, usual_rim_share * median_of(away)));
    std::vector<Vec3> from, step;
    double sum = 0;
    for (size_t k = 0; k < around.size(); ++k) {
      if (away[k] > most) continue;
      from.push_back(around[k]);
      step.push_back(to[k] - centre - around[k]);
      sum += away[k] * away[k];
    }
    found.seen = static_cast<double>(from.size()) / static_cast<double>(around.size());
    found.rms = std::sqrt(sum / static_cast<double>(std::max<size_t>(1, from.size())));
    if (found.seen < least_on_curve) break;
    const Affine next = affine_of(from, step);
    double largest = 0;
    for (const Vec3 &p : around) {
      const Vec3 change =
          (next.stretch - found.motion.stretch) * p + next.shift - found.motion.shift;
      largest = std::max(largest, change.norm());
    }
    found.motion = next;
    if (largest < least_motion_step) break;
  }
  return found;
}

}  // namespace mvs::core
