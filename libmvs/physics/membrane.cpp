// The membrane: energy, gradient, Hessian.
#include "physics/membrane.h"

#include <cmath>

namespace mvs {

// A triangle where it is now.
struct MembraneTerm::Deformed {
  Vec3 f0, f1;  // F
  InPlaneStrain strain;
  Response response;
};

namespace {

// The stress that stretching carries as a form on the weights of the corners: [2 Wa, Wc; Wc, 2 Wb].
Mat2 stress_form(const Vec3 &first, Curvature curvature) {
  Mat2 form;
  form << 2 * first[0], first[2], first[2], 2 * first[1];
  if (curvature == Curvature::exact) return form;
  const double mean = first[0] + first[1], half = first[0] - first[1];
  const double radius = std::hypot(half, first[2]);
  if (mean >= radius) return form;              // tension in both directions
  if (mean + radius <= 0) return Mat2::Zero();  // in none
  // tension along one: its share of the form
  const double large = mean + radius, small = mean - radius;
  return (form - small * Mat2::Identity()) * (large / (large - small));
}

}  // namespace

MembraneTerm::MembraneTerm(const Model &model) {
  const Valve &valve = model.valve;
  for (const Leaflet &leaflet : valve.leaflets) {
    tissues_.push_back({find_leaflet_law(leaflet.law)->response, leaflet.constants});
  }
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const Tri &nodes = valve.triangles[t];
    const auto &fixed = model.topology.fixed;
    if (fixed[nodes[0]] && fixed[nodes[1]] && fixed[nodes[2]]) continue;
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

double MembraneTerm::gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const {
  double sum = 0;
  for (const Triangle &t : triangles_) {
    const Deformed d = deform(t, x);
    const InPlane at = in_plane_stress(d.response, d.strain);
    sum += t.volume * at.w;
    const Vec3 p0 = t.volume * (2 * at.first[0] * d.f0 + at.first[2] * d.f1);
    const Vec3 p1 = t.volume * (2 * at.first[1] * d.f1 + at.first[2] * d.f0);
    const Vec3 g1 = t.inverse(0, 0) * p0 + t.inverse(0, 1) * p1;
    const Vec3 g2 = t.inverse(1, 0) * p0 + t.inverse(1, 1) * p1;
    g[t.nodes[0]] -= g1 + g2;
    g[t.nodes[1]] += g1;
    g[t.nodes[2]] += g2;
  }
  return sum;
}

// d2E / dx_k dx_l = F J_k (d2W) J_l^T F^T + (w_k . S w_l) I for corners 1 and 2, with w_k the
// corner's weights, J_k = [2 w0 0 w1; 0 2 w1 w0] and S the stress form. A shift of all three
// corners changes nothing: that gives the rows of corner 0.
void MembraneTerm::hessian(const std::vector<Vec3> &x, Curvature curvature, System &system) const {
  using Weights = Eigen::Matrix<double, 2, 3>;
  for (const Triangle &t : triangles_) {
    const Deformed d = deform(t, x);
    const InPlane at = in_plane_stiffness(d.response, d.strain);
    const Mat2 form = t.inverse * stress_form(at.first, curvature) * t.inverse.transpose();
    Eigen::Matrix<double, 3, 2> f;
    f << d.f0, d.f1;
    Weights j1, j2;
    j1 << 2 * t.inverse(0, 0), 0, t.inverse(0, 1), 0, 2 * t.inverse(0, 1), t.inverse(0, 0);
    j2 << 2 * t.inverse(1, 0), 0, t.inverse(1, 1), 0, 2 * t.inverse(1, 1), t.inverse(1, 0);
    const auto block = [&](const Weights &k, const Weights &l, double stress) -> Mat3 {
      const Mat2 m = k * at.second * l.transpose();
      Mat3 b = f * m * f.transpose();
      b.diagonal().array() += stress;
      return t.volume * b;
    };
    const Mat3 b11 = block(j1, j1, form(0, 0)), b12 = block(j1, j2, form(0, 1));
    const Mat3 b22 = block(j2, j2, form(1, 1));
    const Mat3 b10 = -(b11 + b12), b20 = -(b12.transpose() + b22);
    system.add_diagonal(t.nodes[0], -(b10 + b20));
    system.add_diagonal(t.nodes[1], b11);
    system.add_diagonal(t.nodes[2], b22);
    system.add(t.nodes[1], t.nodes[0], b10);
    system.add(t.nodes[2], t.nodes[0], b20);
    system.add(t.nodes[1], t.nodes[2], b12);
  }
}

void MembraneTerm::add_pairs(std::vector<Edge> &pairs) const {
  for (const Triangle &t : triangles_) {
    for (int k = 0; k < 3; ++k) pairs.push_back({t.nodes[k], t.nodes[(k + 1) % 3]});
  }
}

}  // namespace mvs
