// The barrier function, contact pairs of all kinds of features, and sums over contact pairs.
#include "energy/barrier.h"

#include <Eigen/Dense>
#include <cmath>

#include "base/math.h"

namespace mvs::core {

Barrier barrier(double s) {
  if (s >= 1) return {0, 0, 0};
  const double log = math::log(s), q = 1 - s;
  return {-q * q * log, 2 * q * log - q * q / s, -2 * log + 4 * q / s + q * q / (s * s)};
}

Barrier penalty(double s) {
  if (s >= 1) return {0, 0, 0};
  const double q = 1 - s;
  const double scale = -barrier(0.5).first / (3 * 0.25);
  return {scale * q * q * q, -3 * scale * q * q, 6 * scale * q};
}

ContactPair point_point(uint32_t v, uint32_t a) {
  return {{v, a, none, none}, {1, -1, 0, 0}, {}, 2, 0, {}, 0, 0, 0, false};
}

ContactPair point_edge(uint32_t v, uint32_t a, uint32_t b, double s) {
  return {{v, a, b, none}, {1, s - 1, -s, 0}, {{{0, 1, -1, 0}, {}}}, 3, 1, {}, 0, 0, 0, false};
}

ContactPair point_face(uint32_t v, const Tri &t, const std::array<double, 3> &w) {
  return {{v, t[0], t[1], t[2]},
          {1, -w[0], -w[1], -w[2]},
          {{{0, 1, -1, 0}, {0, 1, 0, -1}}},
          4,
          2,
          {},
          0,
          0,
          0,
          false};
}

ContactPair vertex_triangle(uint32_t v, const Tri &t, const TrianglePoint &p) {
  if (p.feature < 3) return point_point(v, t[p.feature]);
  if (p.feature == 6) return point_face(v, t, p.weight);
  const uint32_t k = p.feature - 3, l = (k + 1) % 3;
  return point_edge(v, t[k], t[l], p.weight[l]);
}

ContactPair edge_edge(const Edge &e, const Edge &f, const SegmentPair &p) {
  ContactPair c{
      {e[0], e[1], f[0], f[1]}, {1 - p.s, p.s, p.t - 1, -p.t}, {}, 4, 0, {}, 0, 0, 0, true};
  if (p.s > 0 && p.s < 1) c.slide[c.slides++] = {-1, 1, 0, 0};
  if (p.t > 0 && p.t < 1) c.slide[c.slides++] = {0, 0, 1, -1};
  return c;
}

bool measure(const std::vector<Vec3> &x, ContactPair &s) {
  Vec3 r = Vec3::Zero();
  for (uint32_t k = 0; k < s.count; ++k) r += s.weight[k] * x[s.node[k]];
  s.distance = r.norm();
  if (s.gap() >= s.range) return false;
  s.normal = r / s.distance;
  return true;
}

double energy_of(const std::vector<ContactPair> &contact_pairs, Barrier (*curve)(double)) {
  double sum = 0;
  for (const ContactPair &s : contact_pairs) {
    sum += s.strength * s.range * curve(s.gap() / s.range).value;
  }
  return sum;
}

void energies_of(const std::vector<ContactPair> &contact_pairs, Barrier (*curve)(double),
                 size_t first, size_t last, double *to) {
  for (size_t k = first; k < last; ++k) {
    const ContactPair &s = contact_pairs[k];
    to[k] = s.strength * s.range * curve(s.gap() / s.range).value;
  }
}

double add_gradient(const std::vector<ContactPair> &contact_pairs, Barrier (*curve)(double),
                    std::vector<Vec3> &g) {
  WholeGradient to{g};
  add_gradient(contact_pairs, curve, to);
  return to.energy;
}

template <typename Gradient>
void add_gradient(const std::vector<ContactPair> &contact_pairs, Barrier (*curve)(double),
                  Gradient &to) {
  for (const ContactPair &s : contact_pairs) {
    if (!to.takes(s.nodes())) continue;
    const Barrier b = curve(s.gap() / s.range);
    to.add_energy(static_cast<size_t>(&s - contact_pairs.data()), s.node[0],
                  s.strength * s.range * b.value);
    const Vec3 f = s.strength * b.first * s.normal;
    for (uint32_t k = 0; k < s.count; ++k) to.add(s.node[k], s.weight[k] * f);
  }
}

template void add_gradient(const std::vector<ContactPair> &, Barrier (*)(double), WholeGradient &);
template void add_gradient(const std::vector<ContactPair> &, Barrier (*)(double), PartGradient &);

namespace {

// The second derivative of E(d) over the nodes of one contact pair. With r = sum w_k x_k, n = r /
// |r|, t_a = sum slide_ak x_k and the closest point sliding freely (n t_a = 0), c = E' / d and G_ab
// = t_a t_b, block (k, l) is
//   w_k w_l (E'' n n^T + c (I - n n^T)) - c sum_ab (G^-1)_ab u_ka u_lb^T,
//   u_ka = w_k t_a + slide_ka d n.
// The projected Hessian keeps E'' n n^T where E'' is positive, and leaves the rest out; the
// balanced one is exact for pairs of contact proper between sheets.
class ContactPairHessian {
 public:
  ContactPairHessian(const ContactPair &s, double second, double c, const std::vector<Vec3> &x)
      : pair_(s), c_(c) {
    const Vec3 &n = s.normal;
    along_ = (second - c) * n * n.transpose();
    along_.diagonal().array() += c;
    if (c != 0 && s.slides > 0) slide(x);
  }

  Mat3 block(uint32_t k, uint32_t l) const {
    Mat3 sum = pair_.weight[k] * pair_.weight[l] * along_;
    for (uint32_t a = 0; a < slides_; ++a) {
      for (uint32_t b = 0; b < slides_; ++b) {
        sum -= c_ * inverse_(a, b) * u_[a][k] * u_[b][l].transpose();
      }
    }
    return sum;
  }

 private:
  void slide(const std::vector<Vec3> &x) {
    slides_ = pair_.slides;
    std::array<Vec3, 2> t{Vec3::Zero(), Vec3::Zero()};
    Eigen::Matrix2d gram = Eigen::Matrix2d::Identity();
    for (uint32_t a = 0; a < slides_; ++a) {
      for (uint32_t k = 0; k < pair_.count; ++k) t[a] += pair_.slide[a][k] * x[pair_.node[k]];
    }
    for (uint32_t a = 0; a < slides_; ++a) {
      for (uint32_t b = 0; b < slides_; ++b) gram(a, b) = t[a].dot(t[b]);
      for (uint32_t k = 0; k < pair_.count; ++k) {
        u_[a][k] = pair_.weight[k] * t[a] + pair_.slide[a][k] * pair_.distance * pair_.normal;
      }
    }
    inverse_ = gram.inverse();
  }

  const ContactPair &pair_;
  double c_;
  Mat3 along_;
  uint32_t slides_ = 0;
  std::array<std::array<Vec3, 4>, 2> u_;
  Eigen::Matrix2d inverse_;
};

}  // namespace

template <typename Assembler>
bool add_hessian(const std::vector<ContactPair> &contact_pairs, Barrier (*curve)(double),
                 const std::vector<Vec3> &x, Curvature curvature, Assembler &assembler) {
  bool complete = true;
  for (const ContactPair &s : contact_pairs) {
    if (!assembler.takes(s.nodes())) continue;
    const Barrier b = curve(s.gap() / s.range);
    const double second = s.strength / s.range * b.second;
    const bool balances = curvature == Curvature::balanced && !s.is_barrier && s.radius == 0;
    const bool exact = curvature == Curvature::exact || balances;
    if (!exact && second <= 0) continue;
    const ContactPairHessian blocks(s, second, exact ? s.strength * b.first / s.distance : 0, x);
    for (uint32_t k = 0; k < s.count; ++k) {
      assembler.add_diagonal(s.node[k], blocks.block(k, k));
      for (uint32_t l = 0; l < k; ++l) {
        complete = assembler.add(s.node[k], s.node[l], blocks.block(k, l)) && complete;
      }
    }
  }
  return complete;
}

template bool add_hessian(const std::vector<ContactPair> &, Barrier (*)(double),
                          const std::vector<Vec3> &, Curvature, HessianAssembler &);
template bool add_hessian(const std::vector<ContactPair> &, Barrier (*)(double),
                          const std::vector<Vec3> &, Curvature, HessianPart &);

void add_pairs(const std::vector<ContactPair> &contact_pairs, std::vector<Edge> &pairs) {
  for (const ContactPair &s : contact_pairs) {
    for (uint32_t k = 0; k < s.count; ++k) {
      for (uint32_t l = 0; l < k; ++l) pairs.push_back({s.node[k], s.node[l]});
    }
  }
}

}  // namespace mvs::core
