// Energy, gradient and Hessian of all hinges, in batches that share the arc tangents.
#include "energy/bending.h"

#include <algorithm>

#include "base/atan2_batch.h"
#include "energy/hinge.h"
#include "energy/hinge_batch.h"

namespace mvs::core {
namespace {

constexpr size_t hinges_per_batch = HingeBatch::most;

}  // namespace

double hinge_angle(const Vec3 &x0, const Vec3 &x1, const Vec3 &x2, const Vec3 &x3) {
  const HingeFold fold(x0, x1, x2, x3);
  const double sine = fold.sine(), cosine = fold.cosine();
  double angle = 0;
  atan2_batch(&sine, &cosine, &angle, 1);
  return angle;
}

BendingTerm::BendingTerm(const Model &model, Elements which) {
  const Valve &valve = model.valve;
  const Topology &topology = model.topology;
  if (valve.bending_scale <= 0) return;
  std::vector<double> modulus;
  for (const Leaflet &leaflet : valve.leaflets) {
    modulus.push_back(bending_modulus(*find_leaflet_law(leaflet.law), leaflet.constants));
  }
  for (size_t h = 0; h < topology.hinges.size(); ++h) {
    const auto &node = topology.hinges[h];
    const bool all_prescribed =
        std::all_of(node.begin(), node.end(), [&](uint32_t i) { return topology.fixed[i] != 0; });
    if (!takes(which, all_prescribed)) continue;
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
  return energy_at(h, hinge_angle(x[h.node[0]], x[h.node[1]], x[h.node[2]], x[h.node[3]]));
}

double BendingTerm::energy_at(const Hinge &h, double angle) {
  const double bent = wrap_angle(angle - h.rest_angle);
  return 0.5 * h.stiffness * bent * bent;
}

double BendingTerm::energy(const std::vector<Vec3> &x) const {
  double sum = 0;
  HingeBatch batch;
  for (size_t first = 0; first < hinges_.size(); first += hinges_per_batch) {
    const size_t count = std::min(hinges_per_batch, hinges_.size() - first);
    for (size_t k = 0; k < count; ++k) batch.set_nodes(k, hinges_[first + k].node, x);
    find_angles(batch, count);
    for (size_t k = 0; k < count; ++k) sum += energy_at(hinges_[first + k], batch.angle[k]);
  }
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

template <typename Takes, typename Use>
void BendingTerm::for_batches(const Takes &takes, const Use &use) const {
  std::array<uint32_t, hinges_per_batch> taken;
  for (uint32_t k = 0; k < hinges_.size();) {
    size_t count = 0;
    for (; k < hinges_.size() && count < hinges_per_batch; ++k) {
      if (takes(hinges_[k].node)) taken[count++] = k;
    }
    use(taken.data(), count);
  }
}

template <typename Gradient>
void BendingTerm::add_gradient(const std::vector<Vec3> &x, Gradient &to) const {
  const auto takes = [&](const auto &node) { return to.takes(node); };
  for_batches(takes, [&](const uint32_t *hinge, size_t count) {
    Gradient of_batch = to.begin_batch();
    add_batch(hinge, count, x, of_batch);
    to.end_batch(of_batch);
  });
}

template <typename Gradient>
void BendingTerm::add_batch(const uint32_t *hinge, size_t count, const std::vector<Vec3> &x,
                            Gradient &to) const {
  HingeBatch batch;
  for (size_t k = 0; k < count; ++k) batch.set_nodes(k, hinges_[hinge[k]].node, x);
  find_slopes(batch, count);
  for (size_t k = 0; k < count; ++k) {
    const Hinge &h = hinges_[hinge[k]];
    const double bent = wrap_angle(batch.angle[k] - h.rest_angle), moment = h.stiffness * bent;
    to.add_energy(hinge[k], h.node[0], 0.5 * moment * bent);
    for (uint32_t n = 0; n < 4; ++n) to.add(h.node[n], moment * batch.slope_at(k, n));
  }
}

template <typename Assembler>
void BendingTerm::hessian(const std::vector<Vec3> &x, Curvature curvature,
                          Assembler &assembler) const {
  if (curvature == Curvature::exact) {
    add_exact(x, assembler);
  } else {
    add_projected(x, assembler);
  }
}

template <typename Assembler>
void BendingTerm::add_exact(const std::vector<Vec3> &x, Assembler &assembler) const {
  const auto takes = [&](const auto &node) { return assembler.takes(node); };
  for_batches(takes, [&](const uint32_t *hinge, size_t count) {
    add_exact_batch(hinge, count, x, assembler);
  });
}

template <typename Assembler>
void BendingTerm::add_exact_batch(const uint32_t *hinge, size_t count, const std::vector<Vec3> &x,
                                  Assembler &assembler) const {
  HingeBatch batch;
  for (size_t k = 0; k < count; ++k) batch.set_nodes(k, hinges_[hinge[k]].node, x);
  find_angles(batch, count);
  HingeHessian exact;
  for (size_t i = 0; i < count; ++i) {
    const Hinge &h = hinges_[hinge[i]];
    size_t pair = 6 * size_t{hinge[i]};
    const HingeParts p(x[h.node[0]], x[h.node[1]], x[h.node[2]], x[h.node[3]]);
    const double moment = h.stiffness * wrap_angle(batch.angle[i] - h.rest_angle);
    angle_hessian(p, exact);
    std::array<Vec3, 4> slope;
    for (uint32_t k = 0; k < 4; ++k) slope[k] = p.a[k] * p.m1 + p.b[k] * p.m2;
    for (uint32_t k = 0; k < 4; ++k) {
      const Vec3 stiff = h.stiffness * slope[k];
      for (uint32_t l = 0; l <= k; ++l) {
        const Mat3 block = stiff * slope[l].transpose() + moment * exact[k][l];
        if (k == l) {
          assembler.add_diagonal(h.node[k], block);
        } else {
          assembler.add(pair++, h.node[k], h.node[l], block);
        }
      }
    }
  }
}

template <typename Assembler>
void BendingTerm::add_projected(const std::vector<Vec3> &x, Assembler &assembler) const {
  Slope slope;
  for (const Hinge &h : hinges_) {
    if (!assembler.takes(h.node)) continue;
    HingeFold(x[h.node[0]], x[h.node[1]], x[h.node[2]], x[h.node[3]]).slopes(slope);
    const size_t pair = 6 * static_cast<size_t>(&h - hinges_.data());
    assembler.add_outer_product(pair, h.node, slope, h.stiffness);
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
