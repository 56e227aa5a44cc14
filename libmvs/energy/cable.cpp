// A stretched cable has the energy of its law (model/chord_law.h) times its volume, a slack one 0.
#include "energy/cable.h"

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

double CableTerm::gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const {
  double sum = 0;
  for_each_stretched(*valve_, x,
                     [&](const Chord &c, const Vec3 &d, double length, const Axial &at) {
                       sum += c.area * c.rest_length * at.energy;
                       const Vec3 f = (c.area * at.stress / length) * d;
                       g[c.a] -= f;
                       g[c.b] += f;
                     });
  return sum;
}

void CableTerm::hessian(const std::vector<Vec3> &x, Curvature curvature,
                        HessianAssembler &system) const {
  for_each_stretched(
      *valve_, x, [&](const Chord &c, const Vec3 &d, double length, const Axial &at) {
        const Mat3 block = axial_block(d / length, c.area * at.slope / c.rest_length,
                                       c.area * at.stress / length, curvature);
        system.add_diagonal(c.a, block);
        system.add_diagonal(c.b, block);
        system.add(static_cast<size_t>(&c - valve_->chords.data()), c.a, c.b, -block);
      });
}

void CableTerm::add_pairs(std::vector<Edge> &pairs) const {
  for (const Chord &c : valve_->chords) pairs.push_back({c.a, c.b});
}

}  // namespace mvs::core
