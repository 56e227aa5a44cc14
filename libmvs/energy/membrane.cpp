// Deformation gradient, stress and stiffness of constant-strain triangles.
#include "energy/membrane.h"

#include <cmath>

#include "base/simd.h"

namespace mvs::core {

// A triangle in its deformed shape.
struct MembraneTerm::Deformed {
  Vec3 f0, f1;  // F
  InPlaneStrain strain;
  Response response;
};

namespace {

// The in-plane stress as a quadratic form on the weights of the corners: [2 Wa, Wc; Wc, 2 Wb].
Mat2 stress_form(const Vec3 &first, Curvature curvature) {
  Mat2 form;
  form << 2 * first[0], first[2], first[2], 2 * first[1];
  if (curvature == Curvature::exact) return form;
  const double mean = first[0] + first[1], half = first[0] - first[1];
  const double radius = std::sqrt(half * half + first[2] * first[2]);
  if (mean >= radius) return form;              // tension in both directions
  if (mean + radius <= 0) return Mat2::Zero();  // compression in both
  // tension along one: its share of the form
  const double large = mean + radius, small = mean - radius;
  return (form - small * Mat2::Identity()) * (large / (large - small));
}

}  // namespace

MembraneTerm::MembraneTerm(const Model &model, Elements which) {
  const Valve &valve = model.valve;
  for (const Leaflet &leaflet : valve.leaflets) {
    tissues_.push_back({find_leaflet_law(leaflet.law)->response, leaflet.constants});
  }
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const Tri &nodes = valve.triangles[t];
    const auto &fixed = model.topology.fixed;
    if (!takes(which, fixed[nodes[0]] && fixed[nodes[1]] && fixed[nodes[2]])) continue;
    const uint32_t leaflet = valve.triangle_leaflet[t];
    if (!tissues_[leaflet].response) continue;
    const double volume = valve.triangle_thickness[t] * model.rest_area[t];
    triangles_.push_back({nodes, leaflet, volume, rest_inverse(valve, t)});
  }
}

MembraneTerm::Deformed MembraneTerm::deform(const Triangle &t, const std::vector<Vec3> &x) const {
  const Vec3 d1 = x[t.nodes[1]] - x[t.nodes[0]], d2 = x[t.nodes[2]] - x[t.nodes[0]];
  Deformed d;
  d.f0 = t.inverse(0, 0) * d1 + t.inverse(1, 0) * d2;
  d.f1 = t.inverse(0, 1) * d1 + t.inverse(1, 1) * d2;
  d.strain = {d.f0.squaredNorm(), d.f1.squaredNorm(), d.f0.dot(d.f1)};
  const double i1 = d.strain.a + d.strain.b + 1 / d.strain.det();
  const Tissue &tissue = tissues_[t.law];
  d.response = tissue.response(tissue.constants, i1, d.strain.a);
  return d;
}

double MembraneTerm::energy(const std::vector<Vec3> &x) const {
  double sum = 0;
  for (const Triangle &t : triangles_) sum += t.volume * deform(t, x).response.w;
  return sum;
}

void MembraneTerm::energies(const std::vector<Vec3> &x, size_t first, size_t last,
                            double *to) const {
  for (size_t k = first; k < last; ++k) {
    to[k] = triangles_[k].volume * deform(triangles_[k], x).response.w;
  }
}

double MembraneTerm::gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const {
  WholeGradient to{g};
  add_gradient(x, to);
  return to.energy;
}

template <typename Gradient>
void MembraneTerm::add_gradient(const std::vector<Vec3> &x, Gradient &to) const {
  for (const Triangle &t : triangles_) {
    if (!to.takes(t.nodes)) continue;
    const Deformed d = deform(t, x);
    const InPlane at = in_plane_stress(d.response, d.strain);
    to.add_energy(static_cast<size_t>(&t - triangles_.data()), t.nodes[0], t.volume * at.w);
    const Vec3 p0 = t.volume * (2 * at.first[0] * d.f0 + at.first[2] * d.f1);
    const Vec3 p1 = t.volume * (2 * at.first[1] * d.f1 + at.first[2] * d.f0);
    const Vec3 g1 = t.inverse(0, 0) * p0 + t.inverse(0, 1) * p1;
    const Vec3 g2 = t.inverse(1, 0) * p0 + t.inverse(1, 1) * p1;
    to.subtract(t.nodes[0], g1 + g2);
    to.add(t.nodes[1], g1);
    to.add(t.nodes[2], g2);
  }
}

namespace {

// d2W / df_p df_q = F m_pq F^T + (part of the stress), from the curvature of W.
struct Middle {
  Mat2 m00, m01, m11;

  explicit Middle(const Mat3 &w) {
    m00 << 4 * w(0, 0), 2 * w(0, 2), 2 * w(0, 2), w(2, 2);
    m01 << 2 * w(0, 2), 4 * w(0, 1), w(2, 2), 2 * w(1, 2);
    m11 << w(2, 2), 2 * w(1, 2), 2 * w(1, 2), 4 * w(1, 1);
  }

  // The same for corners with weights k and l in F.
  Mat2 between(const double (&k)[2], const double (&l)[2]) const {
    return (k[0] * l[0]) * m00 + (k[0] * l[1]) * m01 + (k[1] * l[0]) * m01.transpose() +
           (k[1] * l[1]) * m11;
  }
};

// A block column by column, padded by one number so that SIMD registers of two hold all of it.
using Flat = Eigen::Matrix<double, 10, 1>;

// F m F^T + s I. The products of the columns of F serve three blocks.
struct Outer {
  Flat f00, f01, f10, f11;

  Outer(const Vec3 &f0, const Vec3 &f1) {
    for (int k = 0; k < 3; ++k) {
      f00.segment<3>(3 * k) = f0[k] * f0;
      f01.segment<3>(3 * k) = f1[k] * f0;
      f10.segment<3>(3 * k) = f0[k] * f1;
      f11.segment<3>(3 * k) = f1[k] * f1;
    }
    f00[9] = f01[9] = f10[9] = f11[9] = 0;
  }

  MVS_INLINE Mat3 block(const Mat2 &m, double s) const {
    const Flat b = m(0, 0) * f00 + m(0, 1) * f01 + m(1, 0) * f10 + m(1, 1) * f11;
    Mat3 result = Eigen::Map<const Mat3>(b.data());
    result.diagonal().array() += s;
    return result;
  }
};

// The block of corners with weights k and l in F; `form`: of the stress.
MVS_INLINE Mat3 block_of(const Outer &outer, const Middle &middle, const Mat2 &form,
                         const double (&k)[2], const double (&l)[2]) {
  const double stress = k[0] * (form(0, 0) * l[0] + form(0, 1) * l[1]) +
                        k[1] * (form(1, 0) * l[0] + form(1, 1) * l[1]);
  return outer.block(middle.between(k, l), stress);
}

}  // namespace

// A corner k that moves by dx_k moves column p of F by w_kp dx_k, w its weights, so that
//     d2E / dx_k dx_l = t A sum_pq w_kp w_lq d2W / df_p df_q,
// and the stress adds (w_k . S w_l) I, S its form. A shift of all three corners changes nothing:
// that gives the rows of corner 0.
template <typename Assembler>
void MembraneTerm::hessian(const std::vector<Vec3> &x, Curvature curvature,
                           Assembler &assembler) const {
  for (const Triangle &t : triangles_) {
    if (!assembler.takes(t.nodes)) continue;
    size_t pair = 3 * static_cast<size_t>(&t - triangles_.data());
    const Deformed d = deform(t, x);
    const InPlane at = in_plane_stiffness(d.response, d.strain);
    const Mat2 form = stress_form(t.volume * at.first, curvature);
    const Middle middle(t.volume * at.second);
    const Outer outer(d.f0, d.f1);
    const double w1[2] = {t.inverse(0, 0), t.inverse(0, 1)};
    const double w2[2] = {t.inverse(1, 0), t.inverse(1, 1)};
    const Mat3 b11 = block_of(outer, middle, form, w1, w1);
    const Mat3 b12 = block_of(outer, middle, form, w1, w2);
    const Mat3 b22 = block_of(outer, middle, form, w2, w2);
    const Mat3 b10 = -(b11 + b12), b20 = -(b12.transpose() + b22);
    assembler.add_diagonal(t.nodes[0], -(b10 + b20));
    assembler.add_diagonal(t.nodes[1], b11);
    assembler.add_diagonal(t.nodes[2], b22);
    assembler.add(pair++, t.nodes[1], t.nodes[0], b10);
    assembler.add(pair++, t.nodes[1], t.nodes[2], b12);
    assembler.add(pair++, t.nodes[2], t.nodes[0], b20);
  }
}

void MembraneTerm::add_pairs(std::vector<Edge> &pairs) const {
  for (const Triangle &t : triangles_) {
    for (int k = 0; k < 3; ++k) pairs.push_back({t.nodes[k], t.nodes[(k + 1) % 3]});
  }
}

template void MembraneTerm::add_gradient(const std::vector<Vec3> &, WholeGradient &) const;
template void MembraneTerm::add_gradient(const std::vector<Vec3> &, PartGradient &) const;
template void MembraneTerm::hessian(const std::vector<Vec3> &, Curvature, HessianAssembler &) const;
template void MembraneTerm::hessian(const std::vector<Vec3> &, Curvature, HessianPart &) const;

}  // namespace mvs::core
