// Forces of the follower pressure, its energy with a frozen free edge, and both parts of its
// derivative.
#include "energy/follower_pressure.h"

#include <Eigen/Geometry>

namespace mvs::core {
namespace {

// The corner of a triangle that is neither i nor j.
uint32_t corner_opposite(const Tri &t, uint32_t i, uint32_t j) {
  for (const uint32_t k : t) {
    if (k != i && k != j) return k;
  }
  return none;
}

bool has_directed(const Tri &t, uint32_t i, uint32_t j) {
  return (t[0] == i && t[1] == j) || (t[1] == i && t[2] == j) || (t[2] == i && t[0] == j);
}

}  // namespace

FollowerPressureTerm::FollowerPressureTerm(const Model &model) : triangles_(model.valve.triangles) {
  const Topology &topology = model.topology;
  origin_ = model.valve.rest.empty() ? Vec3::Zero() : model.valve.rest[0];
  for (size_t e = 0; e < topology.edges.size(); ++e) {
    const auto [i, j] = topology.edges[e];
    const auto [first, second] = topology.edge_triangles[e];
    const Tri &t = triangles_[first];
    const bool along = has_directed(t, i, j);
    const uint32_t a = along ? i : j, b = along ? j : i;
    const uint32_t right = second == none ? none : corner_opposite(triangles_[second], i, j);
    slopes_.push_back({a, b, corner_opposite(t, i, j), right});
    const bool both_fixed = topology.fixed[i] && topology.fixed[j];
    if (second == none && !both_fixed) free_edges_.push_back({a, b});
  }
  frozen_.assign(free_edges_.size(), Vec3::Zero());
}

void FollowerPressureTerm::freeze(const std::vector<Vec3> &x) {
  for (size_t k = 0; k < free_edges_.size(); ++k) {
    const auto [a, b] = free_edges_[k];
    frozen_[k] = (x[a] - origin_).cross(x[b] - origin_) / 6;
  }
}

double FollowerPressureTerm::volume_of(const Tri &t, const std::vector<Vec3> &x) const {
  const Vec3 a = x[t[0]] - origin_;
  return a.dot((x[t[1]] - origin_).cross(x[t[2]] - origin_)) / 6;
}

double FollowerPressureTerm::with_edges(double volume, const std::vector<Vec3> &x) const {
  for (size_t k = 0; k < free_edges_.size(); ++k) {
    const auto [a, b] = free_edges_[k];
    volume += frozen_[k].dot(x[a] - origin_ + x[b] - origin_);
  }
  return -pressure_ * volume;
}

double FollowerPressureTerm::energy(const std::vector<Vec3> &x) const {
  if (empty()) return 0;
  double volume = 0;
  for (const Tri &t : triangles_) volume += volume_of(t, x);
  return with_edges(volume, x);
}

void FollowerPressureTerm::volumes(const std::vector<Vec3> &x, size_t first, size_t last,
                                   double *to) const {
  if (empty()) return;
  for (size_t t = first; t < last; ++t) to[t] = volume_of(triangles_[t], x);
}

double FollowerPressureTerm::energy_of(const std::vector<Vec3> &x, const double *volumes) const {
  if (empty()) return 0;
  double volume = 0;
  for (size_t t = 0; t < triangles_.size(); ++t) volume += volumes[t];
  return with_edges(volume, x);
}

double FollowerPressureTerm::gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const {
  WholeGradient to{g};
  add_gradient(x, to);
  return energy(x);
}

template <typename Gradient>
void FollowerPressureTerm::add_gradient(const std::vector<Vec3> &x, Gradient &to) const {
  if (empty()) return;
  for (const Tri &t : triangles_) {
    if (!to.takes(t)) continue;
    const Vec3 f = (pressure_ / 6) * (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
    for (const uint32_t i : t) to.subtract(i, f);
  }
}

// Force p N / 6 on each corner, N = e2 x (-e1), dN = sum_k [e_k]x dx_k with e_k the edge opposite
// corner k. The symmetric part for the corners (i, j) of one triangle is
// -p / 12 [x_i + x_j - 2 x_k]x, and zero on the diagonal.
template <typename Assembler>
void FollowerPressureTerm::hessian(const std::vector<Vec3> &x, Assembler &assembler) const {
  if (empty()) return;
  for (const Slope &s : slopes_) {
    if (!assembler.takes(Edge{s.i, s.j})) continue;
    const Vec3 arm = s.right == none ? Vec3(x[s.i] + x[s.j] - 2 * x[s.left])
                                     : Vec3(2 * (x[s.right] - x[s.left]));
    assembler.add(static_cast<size_t>(&s - slopes_.data()), s.i, s.j,
                  cross_matrix((-pressure_ / 12) * arm));
  }
}

// The derivative of the force (p / 6) a x b on both ends of a free edge, less its symmetric part.
void FollowerPressureTerm::add_skew(const std::vector<Vec3> &x, const std::vector<Vec3> &v,
                                    std::vector<Vec3> &y) const {
  if (empty()) return;
  const double p = pressure_ / 12;
  for (const auto &[a, b] : free_edges_) {
    const Vec3 xa = x[a] - origin_, xb = x[b] - origin_, ab = xa - xb;
    y[a] -= p * (ab.cross(v[b]) - 2 * xb.cross(v[a]));
    y[b] -= p * (ab.cross(v[a]) + 2 * xa.cross(v[b]));
  }
}

void FollowerPressureTerm::add_pairs(std::vector<Edge> &pairs) const {
  for (const Slope &s : slopes_) pairs.push_back({s.i, s.j});
}

template void FollowerPressureTerm::add_gradient(const std::vector<Vec3> &, WholeGradient &) const;
template void FollowerPressureTerm::add_gradient(const std::vector<Vec3> &, PartGradient &) const;
template void FollowerPressureTerm::hessian(const std::vector<Vec3> &, HessianAssembler &) const;
template void FollowerPressureTerm::hessian(const std::vector<Vec3> &, HessianPart &) const;

}  // namespace mvs::core
