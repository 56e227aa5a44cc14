// A stretched cable has the energy of its law (model/chord_law.h) times its volume, a slack one 0.
#include "energy/cable.h"

#include "model/chord_law.h"

namespace mvs::core {

CableTerm::CableTerm(const Model &model) : valve_(&model.valve) {}

double CableTerm::energy(const std::vector<Vec3> &x) const {
  double sum = 0;
  for (const Chord &c : valve_->chords) {
    const double e = (x[c.b] - x[c.a]).norm() / c.rest_length - 1;
    if (e > 0) sum += c.area * c.rest_length * chord_response(*valve_, c, e).energy;
  }
  return sum;
}

double CableTerm::gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const {
  double sum = 0;
  for (const Chord &c : valve_->chords) {
    const Vec3 d = x[c.b] - x[c.a];
    const double length = d.norm();
    const double e = length / c.rest_length - 1;
    if (e <= 0) continue;
    const Axial at = chord_response(*valve_, c, e);
    sum += c.area * c.rest_length * at.energy;
    const Vec3 f = (c.area * at.stress / length) * d;
    g[c.a] -= f;
    g[c.b] += f;
  }
  return sum;
}

void CableTerm::hessian(const std::vector<Vec3> &x, Curvature curvature,
                        HessianAssembler &system) const {
  for (const Chord &c : valve_->chords) {
    const Vec3 d = x[c.b] - x[c.a];
    const double length = d.norm();
    const double e = length / c.rest_length - 1;
    if (e <= 0) continue;
    const Axial at = chord_response(*valve_, c, e);
    const Mat3 block = axial_block(d / length, c.area * at.slope / c.rest_length,
                                   c.area * at.stress / length, curvature);
    system.add_diagonal(c.a, block);
    system.add_diagonal(c.b, block);
    system.add(static_cast<size_t>(&c - valve_->chords.data()), c.a, c.b, -block);
  }
}

void CableTerm::add_pairs(std::vector<Edge> &pairs) const {
  for (const Chord &c : valve_->chords) pairs.push_back({c.a, c.b});
}

}  // namespace mvs::core
