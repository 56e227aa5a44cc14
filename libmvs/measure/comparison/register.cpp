// Registration by the Kabsch method for points and a damped Gauss-Newton method for surfaces.
#include "measure/comparison/register.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>

#include "base/math.h"
#include "linalg/small_solve.h"

namespace mvs::core {
namespace {

constexpr size_t most_samples = 4000;  // of either surface
constexpr int most_steps = 100;
constexpr double settled = 1e-12;  // relative decrease of the sum of squares at convergence

using Mat6 = Eigen::Matrix<double, 6, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;

Vec3 mean_of(const std::vector<Vec3> &points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3 &p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

Mat3 cross_matrix(const Vec3 &v) {
  Mat3 m;
  m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return m;
}

// Sum of squared distances in both directions, and its quadratic model for a small rotation about
// `centre` and a small translation: the gradient is exact; `to_planes` is the Hessian for distances
// to tangent planes (exact where surfaces slide), `to_points` for distances to fixed points (an
// upper bound).
struct Fit {
  double squares = 0;
  Vec6 gradient = Vec6::Zero();
  Mat6 to_planes = Mat6::Zero(), to_points = Mat6::Zero();

  void add(const Vec3 &moving, const Vec3 &gap, const Vec3 &normal, double weight) {
    Eigen::Matrix<double, 3, 6> change;
    change << -cross_matrix(moving), Mat3::Identity();
    const Vec6 along_normal = change.transpose() * normal;
    squares += weight * gap.squaredNorm();
    gradient += weight * (change.transpose() * gap);
    to_planes += weight * (along_normal * along_normal.transpose());
    to_points += weight * (change.transpose() * change);
  }
};

// Evaluates every n-th sample of a, moved, against b, and of b against a, moved.
Fit fit(const SampledSurface &a, const SampledSurface &b, const Rigid &motion, const Vec3 &centre) {
  const auto stride = [](const SampledSurface &s) { return 1 + s.samples().size() / most_samples; };
  const Rigid back = motion.inverse();
  Fit sum;
  for (size_t i = 0; i < a.samples().size(); i += stride(a)) {
    const Vec3 p = motion(a.samples()[i].point);
    const TriangleBvh::Hit hit = b.tree().closest(p);
    sum.add(p - centre, p - hit.point, b.normal(hit.triangle), a.samples()[i].weight);
  }
  for (size_t i = 0; i < b.samples().size(); i += stride(b)) {
    const Vec3 &p = b.samples()[i].point;
    const TriangleBvh::Hit hit = a.tree().closest(back(p));
    const Vec3 q = motion(hit.point);
    sum.add(q - centre, q - p, motion.turn * a.normal(hit.triangle), b.samples()[i].weight);
  }
  return sum;
}

// Rotation about a vector by its length (Rodrigues).
Mat3 rotation_by(const Vec3 &turn) {
  const double angle = turn.norm();
  if (angle == 0) return Mat3::Identity();
  const Mat3 about = cross_matrix(turn / angle);
  return Mat3::Identity() + math::sin(angle) * about + (1 - math::cos(angle)) * about * about;
}

Rigid moved_by(const Rigid &motion, const Vec6 &step, const Vec3 &centre) {
  const Vec3 turn = step.head<3>();
  const Mat3 more = rotation_by(turn);
  return {more * motion.turn, more * (motion.shift - centre) + centre + step.tail<3>()};
}

}  // namespace

Rigid align(const Frame &a, const Frame &b) {
  const Mat3 turn = b.axes.transpose() * a.axes;
  return {turn, b.origin - turn * a.origin};
}

Rigid register_points(const std::vector<Vec3> &a, const std::vector<Vec3> &b) {
  const Vec3 centre_a = mean_of(a), centre_b = mean_of(b);
  Mat3 covariance = Mat3::Zero();
  for (size_t i = 0; i < a.size(); ++i) {
    covariance += (b[i] - centre_b) * (a[i] - centre_a).transpose();
  }
  // the matrix is square and needs no preconditioner
  const Eigen::JacobiSVD<Mat3, Eigen::NoQRPreconditioner> svd(
      covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 sign = Mat3::Identity();
  sign(2, 2) = svd.matrixU().determinant() * svd.matrixV().determinant() < 0 ? -1 : 1;
  const Mat3 turn = svd.matrixU() * sign * svd.matrixV().transpose();
  return {turn, centre_b - turn * centre_a};
}

Rigid register_surfaces(const SampledSurface &a, const SampledSurface &b, const Rigid &start) {
  std::vector<Vec3> target;
  for (const SampledSurface::Sample &sample : b.samples()) target.push_back(sample.point);
  const Vec3 centre = mean_of(target);
  Rigid best = start;
  Fit now = fit(a, b, best, centre);
  double damping = 1e-3;
  for (int step = 0; step < most_steps; ++step) {
    const Mat6 hessian = now.to_planes + damping * now.to_points;
    const Rigid next = moved_by(best, -solve_positive(hessian, now.gradient), centre);
    const Fit then = fit(a, b, next, centre);
    if (then.squares >= now.squares) {
      // with damping 1 the model is an upper bound: no descent means a local minimum
      if (damping >= 1) break;
      damping *= 10;
      continue;
    }
    const bool done = now.squares - then.squares < settled * now.squares;
    best = next;
    now = then;
    damping = std::max(0.1 * damping, 1e-6);
    if (done) break;
  }
  return best;
}

}  // namespace mvs::core
