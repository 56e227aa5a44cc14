// Lanczos' and Davidson's methods with full orthogonalisation: few iterations, small spaces.
#include "linalg/extreme_eigenvalue.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.h"
#include "linalg/gmres.h"
#include "linalg/small_eigen.h"

namespace mvs::core {
namespace {

void scale(BlockVector &v, double by) {
  for (Vec3 &row : v) row *= by;
}
void add(BlockVector &v, double times, const BlockVector &other) {
  for (size_t i = 0; i < v.size(); ++i) v[i] += times * other[i];
}
BlockVector combination(const std::vector<BlockVector> &basis, const std::vector<double> &share) {
  BlockVector sum(basis[0].size(), Vec3::Zero());
  for (size_t k = 0; k < share.size(); ++k) add(sum, share[k], basis[k]);
  return sum;
}

bool is_zero(const BlockVector &v) {
  return std::all_of(v.begin(), v.end(), [](const Vec3 &row) { return row.isZero(0); });
}

double weighted_dot(const std::vector<double> &weight, const BlockVector &a, const BlockVector &b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += weight[i] * a[i].dot(b[i]);
  return sum;
}

}  // namespace

Eigenpair smallest_eigenvalue(const LinearMap &solve, const BlockVector &start,
                              const EigenGoal &goal, std::vector<BlockVector> &basis) {
  Eigenpair found;
  std::vector<double> diagonal, beside;
  BlockVector v = start, w;
  const double size = std::sqrt(dot(v, v));
  if (size == 0) return found;
  scale(v, 1 / size);
  const size_t first = basis.size();
  std::vector<double> share;
  while (true) {
    basis.push_back(v);
    solve(v, w);
    ++found.iterations;
    diagonal.push_back(-dot(v, w));
    // twice is enough for vectors orthogonal to rounding
    for (int pass = 0; pass < 2; ++pass) {
      for (size_t k = first; k < basis.size(); ++k) add(w, -dot(w, basis[k]), basis[k]);
    }
    const double next = std::sqrt(dot(w, w));
    // the largest eigenvalue of the inverse, with its sign changed
    const SmallestEigen ritz = smallest_eigen(diagonal, beside);
    share = ritz.vector;
    found.real = -1 / ritz.value;
    found.error = next * std::abs(share.back()) / std::abs(ritz.value);
    if (found.error <= goal.error || found.iterations == goal.most || next == 0) break;
    beside.push_back(-next);
    v = w;
    scale(v, 1 / next);
  }
  found.vector.assign(start.size(), Vec3::Zero());
  for (size_t k = 0; k < share.size(); ++k) add(found.vector, share[k], basis[first + k]);
  return found;
}

namespace {

// The space of Davidson's method: vectors v, orthonormal in the weights, K v, and the small matrix
// of K in that space.
class RitzSpace {
 public:
  RitzSpace(const LinearMap &multiply, const std::vector<double> &weight)
      : multiply_(&multiply), weight_(&weight) {}

  // Returns false, and adds nothing, if the vector lies in the space already.
  bool add_vector(BlockVector v) {
    const double whole = std::sqrt(weighted_dot(*weight_, v, v));
    for (int pass = 0; pass < 2; ++pass) {
      for (const BlockVector &other : v_) add(v, -weighted_dot(*weight_, other, v), other);
    }
    const double left = std::sqrt(weighted_dot(*weight_, v, v));
    if (!(left > least_share * whole)) return false;
    scale(v, 1 / left);
    BlockVector product;
    (*multiply_)(v, product);
    v_.push_back(std::move(v));
    product_.push_back(std::move(product));
    const size_t last = v_.size() - 1;
    SmallMatrix larger(last + 1);
    for (size_t r = 0; r < last; ++r) {
      for (size_t c = 0; c < last; ++c) larger(r, c) = small_(r, c);
      larger(r, last) = dot(v_[r], product_[last]);
      larger(last, r) = dot(v_[last], product_[r]);
    }
    larger(last, last) = dot(v_[last], product_[last]);
    small_ = std::move(larger);
    return true;
  }

  size_t size() const { return v_.size(); }
  LeftmostEigen ritz() const { return leftmost_eigen(small_); }

  BlockVector vector(const LeftmostEigen &pair) const { return combination(v_, pair.vector_real); }

  // Both parts of K v - kappa B v for a Ritz pair; the second is empty if the pair is real. Returns
  // its norm in the inverse weights.
  double residual(const LeftmostEigen &pair, std::array<BlockVector, 2> &parts) const {
    const BlockVector real = vector(pair);
    parts[0] = combination(product_, pair.vector_real);
    subtract_weighted(pair.real, real, parts[0]);
    parts[1].clear();
    if (pair.imaginary != 0) {
      const BlockVector imaginary = combination(v_, pair.vector_imaginary);
      parts[1] = combination(product_, pair.vector_imaginary);
      subtract_weighted(pair.real, imaginary, parts[1]);
      subtract_weighted(pair.imaginary, real, parts[1]);
      subtract_weighted(-pair.imaginary, imaginary, parts[0]);
    }
    double square = 0;
    for (const BlockVector &part : parts) {
      for (size_t i = 0; i < part.size(); ++i) square += part[i].squaredNorm() / (*weight_)[i];
    }
    return std::sqrt(square);
  }

 private:
  // A vector with a smaller share outside the space is rounding.
  static constexpr double least_share = 1e-10;

  void subtract_weighted(double times, const BlockVector &v, BlockVector &from) const {
    for (size_t i = 0; i < v.size(); ++i) from[i] -= (times * (*weight_)[i]) * v[i];
  }

  const LinearMap *multiply_;
  const std::vector<double> *weight_;
  std::vector<BlockVector> v_, product_;
  SmallMatrix small_{0};
};

}  // namespace

Eigenpair leftmost_eigenvalue(const LinearMap &multiply, const LinearMap &solve,
                              const std::vector<double> &weight, std::vector<BlockVector> basis,
                              const EigenGoal &goal) {
  RitzSpace space(multiply, weight);
  for (BlockVector &v : basis) space.add_vector(std::move(v));
  Eigenpair found;
  if (space.size() == 0) return found;
  while (true) {
    const LeftmostEigen pair = space.ritz();
    std::array<BlockVector, 2> residual;
    const double size = math::hypot(pair.real, pair.imaginary);
    found.error = space.residual(pair, residual) / std::max(size, goal.scale);
    found.real = pair.real;
    found.imaginary = pair.imaginary;
    bool grows = false;
    if (found.error > goal.error && found.iterations < goal.most) {
      ++found.iterations;
      for (const BlockVector &part : residual) {
        if (is_zero(part)) continue;  // as the imaginary part of a real pair, which is empty
        BlockVector correction;
        solve(part, correction);
        grows = space.add_vector(std::move(correction)) || grows;
      }
    }
    if (grows) continue;
    found.vector = space.vector(pair);
    return found;
  }
}

}  // namespace mvs::core
