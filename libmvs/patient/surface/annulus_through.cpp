// Angles, means of near points, spline.
#include "patient/surface/annulus_through.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/math.h"

namespace mvs::core {
namespace {

// m: noise of points nearer to each other would turn the curve back and forth.
constexpr double near = 2.5e-3;
constexpr size_t least_points = 6;
// Share of the way around between two neighbours. Four points of a circle leave a quarter.
constexpr double longest_gap = 1.0 / 3;

std::vector<Vec3> sorted_around(const std::vector<Vec3> &points) {
  Vec3 centre = Vec3::Zero();
  for (const Vec3 &p : points) centre += p / static_cast<double>(points.size());
  Mat3 spread = Mat3::Zero();
  for (const Vec3 &p : points) spread += (p - centre) * (p - centre).transpose();
  const Mat3 axes = Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvectors();
  std::vector<std::pair<double, size_t>> order;
  for (size_t k = 0; k < points.size(); ++k) {
    const Vec3 local = axes.transpose() * (points[k] - centre);
    order.emplace_back(math::atan2(local[2], local[1]), k);
  }
  std::sort(order.begin(), order.end());
  std::vector<Vec3> sorted;
  sorted.reserve(points.size());
  for (const auto &[angle, k] : order) sorted.push_back(points[k]);
  return sorted;
}

// Means of points in turn that lie within `near` of the first of them.
std::vector<Vec3> means_of_near(const std::vector<Vec3> &points) {
  std::vector<Vec3> means;
  for (size_t k = 0; k < points.size();) {
    Vec3 sum = points[k];
    size_t count = 1;
    while (k + count < points.size() && (points[k + count] - points[k]).norm() < near) {
      sum += points[k + count++];
    }
    means.emplace_back(sum / static_cast<double>(count));
    k += count;
  }
  if (means.size() > 1 && (means.front() - means.back()).norm() < 0.5 * near) {
    means.front() = 0.5 * (means.front() + means.back());
    means.pop_back();
  }
  return means;
}

bool leaves_a_gap(const std::vector<Vec3> &points) {
  double length = 0, longest = 0;
  for (size_t k = 0; k < points.size(); ++k) {
    const double way = (points[(k + 1) % points.size()] - points[k]).norm();
    length += way;
    longest = std::max(longest, way);
  }
  return longest > longest_gap * length;
}

// The point at `share` of the way from p[1] to p[2] (Barry & Goldman 1988).
Vec3 spline_point(const std::array<Vec3, 4> &p, double share) {
  std::array<double, 4> knot{};
  for (size_t k = 1; k < 4; ++k) knot[k] = knot[k - 1] + std::sqrt((p[k] - p[k - 1]).norm());
  const double t = knot[1] + share * (knot[2] - knot[1]);
  const auto between = [t](const Vec3 &a, const Vec3 &b, double from, double to) {
    return Vec3(((to - t) * a + (t - from) * b) / (to - from));
  };
  const Vec3 a = between(p[0], p[1], knot[0], knot[1]), b = between(p[1], p[2], knot[1], knot[2]);
  const Vec3 c = between(p[2], p[3], knot[2], knot[3]);
  return between(between(a, b, knot[0], knot[2]), between(b, c, knot[1], knot[3]), knot[1],
                 knot[2]);
}

}  // namespace

std::vector<Vec3> annulus_through(const std::vector<Vec3> &points, double spacing) {
  if (points.size() < least_points) return {};
  const std::vector<Vec3> through = means_of_near(sorted_around(points));
  const size_t n = through.size();
  if (n < least_points || leaves_a_gap(through)) return {};
  std::vector<Vec3> curve;
  for (size_t k = 0; k < n; ++k) {
    const std::array<Vec3, 4> p = {through[(k + n - 1) % n], through[k], through[(k + 1) % n],
                                   through[(k + 2) % n]};
    const int parts = std::max(1, static_cast<int>(std::ceil((p[2] - p[1]).norm() / spacing)));
    for (int part = 0; part < parts; ++part) {
      curve.push_back(spline_point(p, static_cast<double>(part) / parts));
    }
  }
  return curve;
}

}  // namespace mvs::core
