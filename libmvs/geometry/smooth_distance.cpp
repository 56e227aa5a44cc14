// At the minimum the change of |q - p| along each direction of sliding is D times that of m. The
// least of |q - p|^2 + c sum_i weight_i^2 with c = D |q - p| bend has the same condition. It is the
// point of least norm of a polytope, that of the differences of both hulls with the weights as
// further coordinates, which Wolfe's algorithm finds (Math. Programming 11, 1976); c is repeated
// until it agrees, five times on average in tests/solve.
#include "geometry/smooth_distance.h"

#include <algorithm>
#include <cmath>

#include "geometry/hull_pair.h"

namespace mvs::core {
namespace {

constexpr uint32_t most = SmoothDistance::most_corners;
// The loops end after some five turns and rounds (tests/solve); these bound them where rounding
// decides.
constexpr int most_corners_tried = 64, most_rounds = 40;
// Shares of a square and of a weight that are rounding.
constexpr double least_decrease = 1e-15, least_change = 1e-11, dependent = 1e-11;

// The minimum of |sum theta_k at_k|^2 + c |coordinates|^2 over the corners met so far.
class LeastSquares {
 public:
  LeastSquares(std::span<const Vec3> hull, std::span<const Vec3> part, const HullEdges *edges)
      : hull_(hull), part_(part), edges_(edges) {}

  void start(const ConvexDistance &found) {
    for (uint32_t k = 0; k < found.count; ++k) {
      corner_[k] = make(found.first[k], found.second[k]);
      theta_[k] = found.weight[k];
    }
    count_ = found.count;
    measure();
  }
  void solve(double c) {
    c_ = c;
    settle();
    for (int turn = 0; turn < most_corners_tried && count_ < most; ++turn) {
      const HullPair next = lowest();
      const double square = apart.squaredNorm() + c_ * squared();
      const double along = apart.dot(next.at) + c_ * place[next.j];
      if (square - along <= least_decrease * square ||
          has_pair(std::span(corner_).first(count_), next.i, next.j)) {
        return;
      }
      const LeastSquares kept = *this;
      corner_[count_] = next;
      theta_[count_++] = 0;
      const bool is_solved = settle();
      if (!is_solved || !(apart.squaredNorm() + c_ * squared() < square)) {
        restore(kept);
        return;
      }
    }
  }
  double squared() const { return place[0] * place[0] + place[1] * place[1] + place[2] * place[2]; }
  void write(SmoothDistance &to) const {
    to.count = count_;
    for (uint32_t k = 0; k < count_; ++k) {
      to.first[k] = corner_[k].i;
      to.second[k] = corner_[k].j;
      to.weight[k] = theta_[k];
    }
  }

  Vec3 apart = Vec3::Zero();
  std::array<double, 3> place{};  // coordinates on the part

 private:
  HullPair make(uint32_t i, uint32_t j) const { return {hull_[i] - part_[j], i, j}; }
  void restore(const LeastSquares &kept) {
    corner_ = kept.corner_;
    theta_ = kept.theta_;
    count_ = kept.count_;
    measure();
  }
  HullPair lowest() const {
    const uint32_t i = lowest_corner(edges_, hull_, apart, corner_[0].i);
    uint32_t j = 0;
    double low = c_ * place[0] - apart.dot(part_[0]);
    for (uint32_t k = 1; k < part_.size(); ++k) {
      const double along = c_ * place[k] - apart.dot(part_[k]);
      if (along < low) low = along, j = k;
    }
    return make(i, j);
  }
  void measure() {
    apart.setZero();
    place = {};
    for (uint32_t k = 0; k < count_; ++k) {
      apart += theta_[k] * corner_[k].at;
      place[corner_[k].j] += theta_[k];
    }
  }
  // Moves to the minimum over the affine hull of the corners, and drops those that it leaves out.
  // Returns false if they are dependent.
  bool settle() {
    for (uint32_t turn = 0; turn < 2 * most; ++turn) {
      std::array<double, most> to;
      if (!affine_minimum(to)) return false;
      double share = 1;
      uint32_t drop = most;
      for (uint32_t k = 0; k < count_; ++k) {
        if (to[k] > 0) continue;
        const double way = theta_[k] - to[k];
        const double part = way > 0 ? theta_[k] / way : 0;
        if (drop == most || part < share) {
          share = std::min(part, 1.0);
          drop = k;
        }
      }
      for (uint32_t k = 0; k < count_; ++k) theta_[k] += share * (to[k] - theta_[k]);
      if (drop == most) {
        theta_ = to;
        measure();
        return true;
      }
      --count_;
      for (uint32_t k = drop; k < count_; ++k) {
        corner_[k] = corner_[k + 1];
        theta_[k] = theta_[k + 1];
      }
    }
    return false;
  }
  bool affine_minimum(std::array<double, most> &to) const {
    const uint32_t n = count_ - 1;
    std::array<std::array<double, most>, most> a;
    std::array<double, most> rhs;
    const HullPair &base = corner_[0];
    for (uint32_t r = 0; r < n; ++r) {
      const HullPair &cr = corner_[r + 1];
      const Vec3 dr = cr.at - base.at;
      for (uint32_t s = 0; s <= r; ++s) {
        const HullPair &cs = corner_[s + 1];
        a[r][s] = dr.dot(cs.at - base.at) +
                  c_ * ((cr.j == cs.j) - (cr.j == base.j) - (cs.j == base.j) + 1.0);
      }
      rhs[r] = -dr.dot(base.at) - c_ * ((cr.j == base.j) - 1.0);
    }
    for (uint32_t r = 0; r < n; ++r) {
      const double whole = a[r][r];
      for (uint32_t s = 0; s <= r; ++s) {
        double sum = a[r][s];
        for (uint32_t t = 0; t < s; ++t) sum -= a[r][t] * a[s][t];
        if (s < r) {
          a[r][s] = sum / a[s][s];
        } else {
          if (!(sum > dependent * whole)) return false;
          a[r][r] = std::sqrt(sum);
        }
      }
    }
    for (uint32_t r = 0; r < n; ++r) {
      for (uint32_t t = 0; t < r; ++t) rhs[r] -= a[r][t] * rhs[t];
      rhs[r] /= a[r][r];
    }
    for (uint32_t r = n; r-- > 0;) {
      for (uint32_t t = r + 1; t < n; ++t) rhs[r] -= a[t][r] * rhs[t];
      rhs[r] /= a[r][r];
    }
    to[0] = 1;
    for (uint32_t r = 0; r < n; ++r) {
      to[r + 1] = rhs[r];
      to[0] -= rhs[r];
    }
    return true;
  }

  std::span<const Vec3> hull_, part_;
  const HullEdges *edges_;  // nullable
  std::array<HullPair, most> corner_;
  std::array<double, most> theta_{};
  uint32_t count_ = 0;
  double c_ = 0;
};

SmoothDistance plain(const ConvexDistance &found, double farthest) {
  SmoothDistance same;
  same.count = found.count;
  for (uint32_t k = 0; k < found.count; ++k) {
    same.first[k] = found.first[k];
    same.second[k] = found.second[k];
    same.weight[k] = found.weight[k];
  }
  same.apart = found.apart;
  same.distance = found.distance;
  same.is_beyond = found.is_beyond || found.distance >= farthest;
  return same;
}

}  // namespace

SmoothDistance smooth_distance(std::span<const Vec3> hull, std::span<const Vec3> part,
                               double radius, double share, double cutoff, const HullEdges *edges) {
  const bool has_kinks = hull.size() > 1 && part.size() > 1;
  const double farthest = has_kinks ? 1 + 0.5 * share : 1;
  const double reach = radius + farthest * cutoff;
  const ConvexDistance found = convex_distance(hull, part, reach, edges);
  if (!has_kinks || found.is_beyond || found.count == 0 || !(found.distance > radius)) {
    return plain(found, reach);
  }
  const double g_max = 1 - 1 / static_cast<double>(part.size());
  SmoothDistance smooth;
  smooth.bend = 2 * share / g_max;
  LeastSquares least(hull, part, edges);
  least.start(found);
  double c = 0;
  for (int round = 0; round < most_rounds; ++round) {
    smooth.distance = least.apart.norm();
    smooth.factor = 1 + share * ((1 - least.squared()) / g_max - 0.5);
    const double next = smooth.bend * (smooth.distance - radius) / smooth.factor * smooth.distance;
    if (std::abs(next - c) <= least_change * next) break;
    c = next;
    least.solve(c);
  }
  least.write(smooth);
  smooth.apart = least.apart;
  smooth.is_beyond = smooth.distance - radius >= smooth.factor * cutoff;
  return smooth;
}

}  // namespace mvs::core
