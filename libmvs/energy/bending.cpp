// Angle, gradient and Hessian of a hinge, as in Tamstorf & Grinspun, Graphical Models 75, 2013; the
// Hessian is derived here from the gradient.
#include "energy/bending.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/atan2_batch.h"
#include "base/simd.h"

namespace mvs::core {
namespace {

// Quantities that the derivatives of a hinge share. N1 = e x (x2 - x0), N2 = (x3 - x0) x e.
struct Parts {
  Vec3 e, n1, n2, m1, m2;  // m = N / |N|^2
  double q1, q2;           // |N|^2
  double length;
  std::array<double, 4> a, b;  // dtheta/dx_k = a_k m1 + b_k m2
};

// dm / dN
Mat3 slope_of(const Vec3 &n, double norm2) {
  return (Mat3::Identity() - (2 / norm2) * n * n.transpose()) / norm2;
}

Parts parts_of(const Vec3 &x0, const Vec3 &x1, const Vec3 &x2, const Vec3 &x3) {
  Parts p;
  p.e = x1 - x0;
  p.n1 = p.e.cross(x2 - x0);
  p.n2 = (x3 - x0).cross(p.e);
  p.q1 = p.n1.squaredNorm();
  p.q2 = p.n2.squaredNorm();
  p.m1 = p.n1 / p.q1;
  p.m2 = p.n2 / p.q2;
  p.length = p.e.norm();
  const double s2 = (x2 - x0).dot(p.e) / p.length, s3 = (x3 - x0).dot(p.e) / p.length;
  // theta grows as x2 sinks below the fold
  p.a = {p.length - s2, s2, -p.length, 0};
  p.b = {p.length - s3, s3, 0, -p.length};
  return p;
}

// d(a_k)/dx for the first triangle, with its corner c at place `corner` of the four nodes.
void slope_of_weights(const Vec3 &e, double length, const Vec3 &c, uint32_t corner,
                      std::array<std::array<Vec3, 4>, 4> &da) {
  const Vec3 u = e / length;
  const double s = c.dot(u);
  const Vec3 ds_de = (c - s * u) / length;
  for (auto &row : da) row.fill(Vec3::Zero());
  const std::array<Vec3, 2> dl{-u, u};
  const std::array<Vec3, 2> ds{-ds_de - u, ds_de};  // c = x_corner - x0 as well
  for (uint32_t l = 0; l < 2; ++l) {
    da[0][l] = dl[l] - ds[l];
    da[1][l] = ds[l];
    da[corner][l] = -dl[l];
  }
  da[0][corner] = -u;
  da[1][corner] = u;
}

using Hessian = std::array<std::array<Mat3, 4>, 4>;

// Second derivative of theta.
MVS_INLINE void angle_hessian(const Vec3 &x0, const Vec3 &x2, const Vec3 &x3, const Parts &p,
                              Hessian &h) {
  std::array<std::array<Vec3, 4>, 4> da, db;
  slope_of_weights(p.e, p.length, x2 - x0, 2, da);
  slope_of_weights(p.e, p.length, x3 - x0, 3, db);
  // N1 = e x c2: dN1 = -[c2]x de + [e]x dc2; N2 = c3 x e: dN2 = [c3]x de - [e]x dc3.
  const Mat3 e = cross_matrix(p.e), c2 = cross_matrix(x2 - x0), c3 = cross_matrix(x3 - x0);
  const std::array<Mat3, 4> dn1{c2 - e, -c2, e, Mat3::Zero()};
  const std::array<Mat3, 4> dn2{e - c3, c3, Mat3::Zero(), -e};
  const Mat3 dm1 = slope_of(p.n1, p.q1), dm2 = slope_of(p.n2, p.q2);
  for (uint32_t l = 0; l < 4; ++l) {
    const Mat3 d1 = dm1 * dn1[l], d2 = dm2 * dn2[l];
    for (uint32_t k = 0; k < 4; ++k) {
      h[k][l] =
          p.m1 * da[k][l].transpose() + p.m2 * db[k][l].transpose() + p.a[k] * d1 + p.b[k] * d2;
    }
  }
}

// The difference of two angles in (-pi, pi].
double wrap(double angle) {
  if (std::abs(angle) <= std::numbers::pi) return angle;
  return angle > 0 ? angle - 2 * std::numbers::pi : angle + 2 * std::numbers::pi;
}

// A hinge with the quantities that its angle and gradient need.
struct Fold {
  Vec3 e, c2, c3, n1, n2;  // c = x - x0
  double length;

  Fold(const Vec3 &x0, const Vec3 &x1, const Vec3 &x2, const Vec3 &x3)
      : e(x1 - x0), c2(x2 - x0), c3(x3 - x0), n1(e.cross(c2)), n2(c3.cross(e)), length(e.norm()) {}

  // The sine and cosine of the angle, both times |N1| |N2|: N1 x N2 = -e (N1 c3).
  double sine() const { return 0 - length * n1.dot(c3); }
  double cosine() const { return n1.dot(n2); }

  // Gradient of the angle by nodes. s is the position of the foot of a corner along the edge, m.
  MVS_INLINE void slopes(Slope &slope) const {
    const double per_length = 1 / length, s2 = c2.dot(e) * per_length, s3 = c3.dot(e) * per_length;
    const Vec3 m1 = 1 / n1.squaredNorm() * n1, m2 = 1 / n2.squaredNorm() * n2;
    slope.node(0) = (length - s2) * m1 + (length - s3) * m2;
    slope.node(1) = s2 * m1 + s3 * m2;
    slope.node(2) = -length * m1;
    slope.node(3) = -length * m2;
  }
};

constexpr size_t hinges_per_batch = 32;  // of atan2_batch()

}  // namespace

double hinge_angle(const Vec3 &x0, const Vec3 &x1, const Vec3 &x2, const Vec3 &x3) {
  const Fold fold(x0, x1, x2, x3);
  const double sine = fold.sine(), cosine = fold.cosine();
  double angle = 0;
  atan2_batch(&sine, &cosine, &angle, 1);
  return angle;
}

BendingTerm::BendingTerm(const Model &model) {
  const Valve &valve = model.valve;
  const Topology &topology = model.topology;
  if (valve.bending_scale <= 0) return;
  std::vector<double> modulus;
  for (const Leaflet &leaflet : valve.leaflets) {
    modulus.push_back(bending_modulus(*find_leaflet_law(leaflet.law), leaflet.constants));
  }
  for (size_t h = 0; h < topology.hinges.size(); ++h) {
    const auto &node = topology.hinges[h];
    const uint32_t edge = topology.hinge_edge[h];
    double area = 0, rigidity = 0;
    for (const uint32_t t : topology.edge_triangles[edge]) {
      const double thickness = valve.triangle_thickness[t];
      const double young = modulus[valve.triangle_leaflet[t]];
      area += model.rest_area[t];
      rigidity += 0.5 * young * thickness * thickness * thickness / (12 * (1 - 0.25));
    }
    const double length = model.rest_length[edge];
    const double k = valve.bending_scale * rigidity * length * length / area;
    const auto &x = valve.rest;
    const double rest = hinge_angle(x[node[0]], x[node[1]], x[node[2]], x[node[3]]);
    hinges_.push_back({node, k, rest});
  }
}

double BendingTerm::energy_of(const Hinge &h, const std::vector<Vec3> &x) {
  const double bent =
      wrap(hinge_angle(x[h.node[0]], x[h.node[1]], x[h.node[2]], x[h.node[3]]) - h.rest_angle);
  return 0.5 * h.stiffness * bent * bent;
}

double BendingTerm::energy(const std::vector<Vec3> &x) const {
  double sum = 0;
  for (const Hinge &h : hinges_) sum += energy_of(h, x);
  return sum;
}

void BendingTerm::energies(const std::vector<Vec3> &x, size_t first, size_t last,
                           double *to) const {
  for (size_t k = first; k < last; ++k) to[k] = energy_of(hinges_[k], x);
}

double BendingTerm::sum_by_batches(const double *energies) const {
  double sum = 0;
  for (size_t first = 0; first < hinges_.size(); first += hinges_per_batch) {
    double of_batch = 0;
    const size_t last = std::min(first + hinges_per_batch, hinges_.size());
    for (size_t k = first; k < last; ++k) of_batch += energies[k];
    sum += of_batch;
  }
  return sum;
}

double BendingTerm::gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const {
  WholeGradient to{g};
  add_gradient(x, to);
  return to.energy;
}

template <typename Gradient>
void BendingTerm::add_gradient(const std::vector<Vec3> &x, Gradient &to) const {
  std::array<uint32_t, hinges_per_batch> taken;
  for (uint32_t k = 0; k < hinges_.size();) {
    size_t count = 0;
    for (; k < hinges_.size() && count < hinges_per_batch; ++k) {
      if (to.takes(hinges_[k].node)) taken[count++] = k;
    }
    Gradient of_batch = to.begin_batch();
    add_batch(taken.data(), count, x, of_batch);
    to.end_batch(of_batch);
  }
}

template <typename Gradient>
void BendingTerm::add_batch(const uint32_t *hinge, size_t count, const std::vector<Vec3> &x,
                            Gradient &to) const {
  std::array<double, hinges_per_batch> sine{}, cosine{}, angle{};
  std::array<Slope, hinges_per_batch> slope;
  for (size_t k = 0; k < count; ++k) {
    const auto &node = hinges_[hinge[k]].node;
    const Fold fold(x[node[0]], x[node[1]], x[node[2]], x[node[3]]);
    sine[k] = fold.sine();
    cosine[k] = fold.cosine();
    fold.slopes(slope[k]);
  }
  atan2_batch(sine.data(), cosine.data(), angle.data(), count);
  for (size_t k = 0; k < count; ++k) {
    const Hinge &h = hinges_[hinge[k]];
    const double bent = wrap(angle[k] - h.rest_angle), moment = h.stiffness * bent;
    to.add_energy(hinge[k], h.node[0], 0.5 * moment * bent);
    for (uint32_t c = 0; c < 4; ++c) to.add(h.node[c], moment * slope[k].node(c));
  }
}

template <typename System>
void BendingTerm::hessian(const std::vector<Vec3> &x, Curvature curvature, System &system) const {
  if (curvature == Curvature::exact) {
    add_exact(x, system);
  } else {
    add_projected(x, system);
  }
}

template <typename System>
void BendingTerm::add_exact(const std::vector<Vec3> &x, System &system) const {
  Hessian exact;
  for (const Hinge &h : hinges_) {
    if (!system.takes(h.node)) continue;
    size_t pair = 6 * static_cast<size_t>(&h - hinges_.data());
    const Vec3 &x0 = x[h.node[0]], &x1 = x[h.node[1]], &x2 = x[h.node[2]], &x3 = x[h.node[3]];
    const Parts p = parts_of(x0, x1, x2, x3);
    const double moment = h.stiffness * wrap(hinge_angle(x0, x1, x2, x3) - h.rest_angle);
    angle_hessian(x0, x2, x3, p, exact);
    std::array<Vec3, 4> slope;
    for (uint32_t k = 0; k < 4; ++k) slope[k] = p.a[k] * p.m1 + p.b[k] * p.m2;
    for (uint32_t k = 0; k < 4; ++k) {
      const Vec3 stiff = h.stiffness * slope[k];
      for (uint32_t l = 0; l <= k; ++l) {
        const Mat3 block = stiff * slope[l].transpose() + moment * exact[k][l];
        if (k == l) {
          system.add_diagonal(h.node[k], block);
        } else {
          system.add(pair++, h.node[k], h.node[l], block);
        }
      }
    }
  }
}

template <typename System>
void BendingTerm::add_projected(const std::vector<Vec3> &x, System &system) const {
  Slope slope;
  for (const Hinge &h : hinges_) {
    if (!system.takes(h.node)) continue;
    Fold(x[h.node[0]], x[h.node[1]], x[h.node[2]], x[h.node[3]]).slopes(slope);
    const size_t pair = 6 * static_cast<size_t>(&h - hinges_.data());
    system.add_outer_product(pair, h.node, slope, h.stiffness);
  }
}

void BendingTerm::add_pairs(std::vector<Edge> &pairs) const {
  for (const Hinge &h : hinges_) {
    for (uint32_t k = 0; k < 4; ++k) {
      for (uint32_t l = 0; l < k; ++l) pairs.push_back({h.node[k], h.node[l]});
    }
  }
}

template void BendingTerm::add_gradient(const std::vector<Vec3> &, WholeGradient &) const;
template void BendingTerm::add_gradient(const std::vector<Vec3> &, PartGradient &) const;
template void BendingTerm::hessian(const std::vector<Vec3> &, Curvature, HessianAssembler &) const;
template void BendingTerm::hessian(const std::vector<Vec3> &, Curvature, HessianPart &) const;

}  // namespace mvs::core
