// Builds the springs of the edges and evaluates them.
#include "energy/spring.h"

#include <cmath>

namespace mvs::core {

SpringTerm::SpringTerm(const Model &model, Elements which) {
  const Valve &valve = model.valve;
  for (const Leaflet &leaflet : valve.leaflets) laws_.emplace_back(leaflet.constants);
  for (size_t e = 0; e < model.topology.edges.size(); ++e) {
    const auto [i, j] = model.topology.edges[e];
    if (!takes(which, model.topology.fixed[i] && model.topology.fixed[j])) continue;
    for (const uint32_t t : model.topology.edge_triangles[e]) {
      if (t == none) continue;
      const uint32_t law = valve.triangle_leaflet[t];
      if (valve.leaflets[law].law != LeafletLawId::spring) continue;
      const double volume = valve.triangle_thickness[t] * model.rest_area[t];
      Spring *last = springs_.empty() ? nullptr : &springs_.back();
      if (last != nullptr && last->i == i && last->j == j && last->law == law) {
        last->volume += volume;
      } else {
        springs_.push_back({i, j, law, model.rest_length[e], volume});
      }
    }
  }
  for (Spring &s : springs_) {
    s.per_length = 1 / s.length;
    s.section = s.volume * s.per_length;
  }
}

double SpringTerm::energy_of(const Spring &s, const std::vector<Vec3> &x) const {
  const double e = (x[s.j] - x[s.i]).norm() / s.length - 1;
  return s.volume * laws_[s.law].energy(e);
}

double SpringTerm::energy(const std::vector<Vec3> &x) const {
  double sum = 0;
  for (const Spring &s : springs_) sum += energy_of(s, x);
  return sum;
}

void SpringTerm::energies(const std::vector<Vec3> &x, size_t first, size_t last, double *to) const {
  for (size_t k = first; k < last; ++k) to[k] = energy_of(springs_[k], x);
}

double SpringTerm::gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const {
  WholeGradient to{g};
  add_gradient(x, to);
  return to.energy;
}

template <typename Gradient>
void SpringTerm::add_gradient(const std::vector<Vec3> &x, Gradient &to) const {
  for (const Spring &s : springs_) {
    if (!to.takes(Edge{s.i, s.j})) continue;
    const Vec3 d = x[s.j] - x[s.i];
    const double length = d.norm();
    const double e = length / s.length - 1;
    const Bilinear &law = laws_[s.law];
    to.add_energy(static_cast<size_t>(&s - springs_.data()), s.i, s.volume * law.energy(e));
    const double force = s.section * law.stress(e);
    const Vec3 f = (force / length) * d;
    to.subtract(s.i, f);
    to.add(s.j, f);
  }
}

template <typename Assembler>
void SpringTerm::hessian(const std::vector<Vec3> &x, Curvature curvature,
                         Assembler &assembler) const {
  for (const Spring &s : springs_) {
    if (!assembler.takes(Edge{s.i, s.j})) continue;
    const Vec3 d = x[s.j] - x[s.i];
    const double length = d.norm();
    const double e = length / s.length - 1;
    const Bilinear &law = laws_[s.law];
    const double stiffness = s.section * s.per_length * law.tangent(e);
    const double tension = s.section * law.stress(e), inverse = 1 / length;
    const Mat3 block = axial_block(inverse * d, stiffness, inverse * tension, curvature);
    assembler.add_diagonal(s.i, block);
    assembler.add_diagonal(s.j, block);
    assembler.add(static_cast<size_t>(&s - springs_.data()), s.i, s.j, -block);
  }
}

void SpringTerm::add_pairs(std::vector<Edge> &pairs) const {
  for (const Spring &s : springs_) pairs.push_back({s.i, s.j});
}

std::vector<SpringTerm::Kink> SpringTerm::find_kinks(const std::vector<Vec3> &x,
                                                     double slack) const {
  std::vector<Kink> found;
  for (const Spring &s : springs_) {
    const Bilinear &law = laws_[s.law];
    const double over = (x[s.j] - x[s.i]).norm() - s.length * (1 + law.kink);
    if (!(std::abs(over) <= slack)) continue;
    const double jump = s.section * s.per_length * (law.high - law.low);
    found.push_back({{s.i, s.j}, s.law, s.length, over, jump});
  }
  return found;
}

template void SpringTerm::add_gradient(const std::vector<Vec3> &, WholeGradient &) const;
template void SpringTerm::add_gradient(const std::vector<Vec3> &, PartGradient &) const;
template void SpringTerm::hessian(const std::vector<Vec3> &, Curvature, HessianAssembler &) const;
template void SpringTerm::hessian(const std::vector<Vec3> &, Curvature, HessianPart &) const;

}  // namespace mvs::core
