// Search by length, and the complementarity problem by enumeration.
#include "sensitivity/weak_chords.h"

#include <Eigen/LU>
#include <cmath>

#include "model/chord_law.h"

namespace mvs::core {

std::vector<WeakChord> find_weak_chords(const Model &model, const std::vector<Vec3> &x,
                                        double slack) {
  std::vector<WeakChord> weak;
  for (uint32_t c = 0; c < model.valve.chords.size(); ++c) {
    const Chord &chord = model.valve.chords[c];
    const Vec3 d = x[chord.b] - x[chord.a];
    const double length = d.norm(), over = length - chord.rest_length;
    if (!(std::abs(over) <= slack) || length == 0) continue;
    // the stiffness at the beginning of tension, from a strain that is small for every law
    const double slope = chord_response(model.valve, chord, 1e-9).slope;
    weak.push_back({c, d / length, chord.area * slope / chord.rest_length, over > 0});
  }
  return weak;
}

namespace {

// The solution with these chordae changed, or empty if it contradicts their state.
std::vector<double> solution_of(const std::vector<WeakChord> &chords,
                                const std::vector<double> &flexibility,
                                const std::vector<double> &rates, uint32_t changed) {
  const auto m = static_cast<Eigen::Index>(chords.size());
  // u + S t = u0, t = k u or -k u or 0
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(m, m);
  Eigen::VectorXd b(m);
  const auto factor = [&](Eigen::Index j) {
    const WeakChord &chord = chords[static_cast<size_t>(j)];
    if ((changed >> j & 1) == 0) return 0.0;
    return chord.is_taut ? -chord.stiffness : chord.stiffness;
  };
  for (Eigen::Index i = 0; i < m; ++i) {
    b[i] = rates[static_cast<size_t>(i)];
    for (Eigen::Index j = 0; j < m; ++j) {
      a(i, j) += flexibility[static_cast<size_t>(i * m + j)] * factor(j);
    }
  }
  const Eigen::VectorXd u = a.partialPivLu().solve(b);
  std::vector<double> t(chords.size(), 0);
  for (Eigen::Index i = 0; i < m; ++i) {
    const bool is_changed = (changed >> i & 1) != 0;
    const bool becomes_taut = u[i] > 0;
    const bool ends_taut = is_changed != chords[static_cast<size_t>(i)].is_taut;
    if (ends_taut != becomes_taut && u[i] != 0) return {};
    t[static_cast<size_t>(i)] = factor(i) * u[i];
  }
  return t;
}

}  // namespace

std::vector<double> extra_tensions(const std::vector<WeakChord> &chords,
                                   const std::vector<double> &flexibility,
                                   const std::vector<double> &rates) {
  for (uint32_t changed = 0; changed < 1u << chords.size(); ++changed) {
    std::vector<double> t = solution_of(chords, flexibility, rates, changed);
    if (!t.empty()) return t;
  }
  return {};
}

}  // namespace mvs::core
