// A stretched cable has the energy of its law (model/chord_law.h) times its volume, a slack one 0.
#include "energy/cable.h"

#include <algorithm>

#include "model/chord_law.h"

namespace mvs::core {
namespace {

// Calls use(chord, b - a, its length, response) for each stretched chord.
template <typename Use>
void for_each_stretched(const Valve &valve, const std::vector<Vec3> &x, Use use) {
  for (const Chord &c : valve.chords) {
    const Vec3 d = x[c.b] - x[c.a];
    const double length = d.norm();
    const double e = length / c.rest_length - 1;
    if (e <= 0) continue;
    use(c, d, length, chord_response(valve, c, e));
  }
}

}  // namespace

CableTerm::CableTerm(const Model &model) : valve_(&model.valve) {}

double CableTerm::energy(const std::vector<Vec3> &x) const {
  double sum = 0;
  for_each_stretched(*valve_, x, [&](const Chord &c, const Vec3 &, double, const Axial &at) {
    sum += c.area * c.rest_length * at.energy;
  });
  return sum;
}

// The sum of stretched chords alone would have the same bits: zeros change none.
void CableTerm::energies(const std::vector<Vec3> &x, size_t first, size_t last, double *to) const {
  std::fill(to + first, to + last, 0.0);
  for_each_stretched(*valve_, x, [&](const Chord &c, const Vec3 &, double, const Axial &at) {
    const size_t k = index_of(c);
    if (first <= k && k < last) to[k] = c.area * c.rest_length * at.energy;
  });
}

double CableTerm::gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const {
  WholeGradient to{g};
  add_gradient(x, to);
  return to.energy;
}

template <typename Gradient>
void CableTerm::add_gradient(const std::vector<Vec3> &x, Gradient &to) const {
  for_each_stretched(*valve_, x,
                     [&](const Chord &c, const Vec3 &d, double length, const Axial &at) {
                       to.add_energy(index_of(c), c.a, c.area * c.rest_length * at.energy);
                       const Vec3 f = (c.area * at.stress / length) * d;
                       to.subtract(c.a, f);
                       to.add(c.b, f);
                     });
}

template <typename Assembler>
void CableTerm::hessian(const std::vector<Vec3> &x, Curvature curvature,
                        Assembler &assembler) const {
  for_each_stretched(*valve_, x,
                     [&](const Chord &c, const Vec3 &d, double length, const Axial &at) {
                       if (!assembler.takes(Edge{c.a, c.b})) return;
                       const Mat3 block = axial_block(d / length, c.area * at.slope / c.rest_length,
                                                      c.area * at.stress / length, curvature);
                       assembler.add_diagonal(c.a, block);
                       assembler.add_diagonal(c.b, block);
                       assembler.add(index_of(c), c.a, c.b, -block);
                     });
}

void CableTerm::add_pairs(std::vector<Edge> &pairs) const {
  for (const Chord &c : valve_->chords) pairs.push_back({c.a, c.b});
}

template void CableTerm::add_gradient(const std::vector<Vec3> &, WholeGradient &) const;
template void CableTerm::add_gradient(const std::vector<Vec3> &, PartGradient &) const;
template void CableTerm::hessian(const std::vector<Vec3> &, Curvature, HessianAssembler &) const;
template void CableTerm::hessian(const std::vector<Vec3> &, Curvature, HessianPart &) const;

}  // namespace mvs::core
