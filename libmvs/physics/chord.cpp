// Tension-only cables: E = E A L0 e^2 / 2 for e > 0, else nothing.
#include "physics/chord.h"

namespace mvs {

ChordTerm::ChordTerm(const Model &model) {
  for (const Chord &c : model.valve.chords) {
    cables_.push_back({c.a, c.b, c.rest_length, c.stiffness()});
  }
}

double ChordTerm::energy(const std::vector<Vec3> &x) const {
  double sum = 0;
  for (const Cable &c : cables_) {
    const double e = (x[c.b] - x[c.a]).norm() / c.length - 1;
    if (e > 0) sum += 0.5 * c.stiffness * c.length * e * e;
  }
  return sum;
}

double ChordTerm::gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const {
  double sum = 0;
  for (const Cable &c : cables_) {
    const Vec3 d = x[c.b] - x[c.a];
    const double length = d.norm();
    const double e = length / c.length - 1;
    if (e <= 0) continue;
    sum += 0.5 * c.stiffness * c.length * e * e;
    const Vec3 f = (chord_tension(c.stiffness, e) / length) * d;
    g[c.a] -= f;
    g[c.b] += f;
  }
  return sum;
}

void ChordTerm::hessian(const std::vector<Vec3> &x, Curvature curvature, System &system) const {
  for (const Cable &c : cables_) {
    const Vec3 d = x[c.b] - x[c.a];
    const double length = d.norm();
    const double e = length / c.length - 1;
    if (e <= 0) continue;
    const double tension = chord_tension(c.stiffness, e);
    const Mat3 block = axial_block(d / length, c.stiffness / c.length, tension / length, curvature);
    system.add_diagonal(c.a, block);
    system.add_diagonal(c.b, block);
    system.add(c.a, c.b, -block);
  }
}

void ChordTerm::add_pairs(std::vector<Edge> &pairs) const {
  for (const Cable &c : cables_) pairs.push_back({c.a, c.b});
}

}  // namespace mvs
