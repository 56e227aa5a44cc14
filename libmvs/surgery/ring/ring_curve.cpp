// Parametric ring and checks of closed polygons.
#include "surgery/ring/ring_curve.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/math.h"

namespace mvs::core {
namespace {

using Vec2 = Eigen::Vector2d;

// Smallest and largest width of a ring, as for `size` in ops.def. The valve of a mouse is 2 mm wide
// but is never repaired by a ring; the largest adult ring has label 40.
constexpr double narrowest = 5e-3, widest = 0.1;

// Least roundness (4 pi area / length^2): 1 for a circle, 0.55 for an ellipse of 1 : 4, about 0.9
// for the annulus.
constexpr double least_roundness = 0.2;

// Returns the principal axes of the second moments as rows, the largest first.
Mat3 principal_axes(const Loop &loop) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(second_moments(loop, centroid(loop)));
  return solver.eigenvectors().rowwise().reverse().transpose();
}

// Returns the curve projected onto its own plane.
std::vector<Vec2> flattened(const Loop &loop) {
  const Mat3 axes = principal_axes(loop);
  std::vector<Vec2> flat;
  for (const Vec3 &p : loop.points()) flat.emplace_back((axes * p).head<2>());
  return flat;
}

double cross(const Vec2 &a, const Vec2 &b) {
  return a[0] * b[1] - a[1] * b[0];
}

double area_of(const std::vector<Vec2> &polygon) {
  double sum = 0;
  for (size_t k = 0; k < polygon.size(); ++k) {
    sum += cross(polygon[k] - polygon[0], polygon[(k + 1) % polygon.size()] - polygon[0]);
  }
  return std::abs(sum) / 2;
}

struct RingSide {
  Vec2 a, b;
  size_t number;
  double low() const { return std::min(a[0], b[0]); }
  double high() const { return std::max(a[0], b[0]); }
};

bool cross_each_other(const RingSide &s, const RingSide &t) {
  const Vec2 along = s.b - s.a, other = t.b - t.a;
  return cross(along, t.a - s.a) * cross(along, t.b - s.a) < 0 &&
         cross(other, s.a - t.a) * cross(other, s.b - t.a) < 0;
}

// Sweep along the first coordinate: only sides with overlapping ranges are compared, two at nearly
// every position of a ring, so the cost is about k log k for k points.
void must_not_cross_itself(const char *op_name, const std::vector<Vec2> &polygon) {
  std::vector<RingSide> sides;
  for (size_t k = 0; k < polygon.size(); ++k) {
    sides.push_back({polygon[k], polygon[(k + 1) % polygon.size()], k});
  }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const RingSide &s, const RingSide &t) { return s.low() < t.low(); });
  for (size_t i = 0; i < sides.size(); ++i) {
    for (size_t j = i + 1; j < sides.size() && sides[j].low() <= sides[i].high(); ++j) {
      const auto [first, second] = std::minmax(sides[i].number, sides[j].number);
      MVS_MUST(!cross_each_other(sides[i], sides[j]), MVS_E_ARGUMENT, "curve",
               "%s: the curve crosses itself after points %zu and %zu, seen along its axis: give "
               "the points in order around the ring",
               op_name, first, second);
    }
  }
}

// Two points of a curve closer than this, m, are one: below the resolution of scanners and
// drawings.
constexpr double same_place = 1e-7;

void must_have_distinct_points(const char *op_name, const std::vector<Vec3> &curve) {
  for (size_t k = 0; k < curve.size(); ++k) {
    const size_t next = (k + 1) % curve.size();
    MVS_MUST((curve[next] - curve[k]).norm() > same_place, MVS_E_ARGUMENT, "curve",
             "%s: points %zu and %zu of the curve lie at the same place: leave one out", op_name, k,
             next);
  }
}

}  // namespace

// x = AP/2 ((cos t - q cos 3t) / (1 - q) + c sin^2 t), y = CC/2 (sin t + q sin 3t) / (1 - q),
// z = h (cos 2t + r cos t): c flattens the anterior side, q squares the ellipse, r lifts the
// anterior side over the posterior one. c, q and r follow from three conditions at 34.7 x 26.1 mm
// with a saddle of 4.7 mm: perimeter 100.4 mm, projected area 7.40 cm2, and z = 0 is the best
// plane.
std::vector<Vec3> parametric_ring(double width, double ap, double saddle) {
  constexpr double c = 0.169203011768, q = 0.020174643763, r = 0.069789405284;
  constexpr int count = 360;
  // the range is -1 - r^2 / 8, at cos t = -r / 4, to 1 + r
  const double h = saddle / (2 + r + r * r / 8);
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) {
    const double t = 2 * std::numbers::pi * k / count, sine = math::sin(t);
    points.emplace_back(
        0.5 * ap * ((math::cos(t) - q * math::cos(3 * t)) / (1 - q) + c * sine * sine),
        0.5 * width * (sine + q * math::sin(3 * t)) / (1 - q),
        h * (math::cos(2 * t) + r * math::cos(t)));
  }
  const Vec3 centre = centroid(Loop(points));
  for (Vec3 &p : points) p -= centre;
  return points;
}

Vec3 extent_of(const Loop &curve) {
  const Mat3 axes = principal_axes(curve);
  Vec3 low = axes * curve.point(0), high = low;
  for (const Vec3 &p : curve.points()) {
    low = low.cwiseMin(axes * p);
    high = high.cwiseMax(axes * p);
  }
  return high - low;
}

std::vector<Vec3> without_repeated_start(std::vector<Vec3> curve) {
  const bool repeats = curve.size() > 1 && (curve.back() - curve.front()).norm() <= same_place;
  if (repeats) curve.pop_back();
  return curve;
}

void must_be_a_ring(const char *op_name, const std::vector<Vec3> &curve) {
  must_have_distinct_points(op_name, curve);
  const Loop loop(curve);
  const double width = extent_of(loop)[0];
  MVS_MUST(width >= narrowest, MVS_E_ARGUMENT, "curve",
           "%s: the curve is %.3g m wide, a ring has at least %g m: looks like a curve in other "
           "units than m",
           op_name, width, narrowest);
  MVS_MUST(width <= widest, MVS_E_ARGUMENT, "curve",
           "%s: the curve is %.3g m wide, a ring has at most %g m: looks like mm given as m",
           op_name, width, widest);
  const std::vector<Vec2> flat = flattened(loop);
  must_not_cross_itself(op_name, flat);
  const double roundness = 4 * std::numbers::pi * area_of(flat) / (loop.length() * loop.length());
  MVS_MUST(roundness >= least_roundness, MVS_E_ARGUMENT, "curve",
           "%s: the curve encloses %.0f %% of the area of a circle of its length, a ring at least "
           "%.0f %%: it has to go once around the orifice",
           op_name, 100 * roundness, 100 * least_roundness);
}

}  // namespace mvs::core
