// Solutions for unit tensions of the weak chordae with the kept factor, then a small problem for
// each parameter and side.
#include "sensitivity/one_sides.h"

namespace mvs::core {

NodeField elongation_gradient(const Model &model, const WeakChord &weak) {
  NodeField g(model.node_count(), Vec3::Zero());
  g[model.valve.chords[weak.chord].a] -= weak.along;
  g[model.valve.chords[weak.chord].b] += weak.along;
  return g;
}

OneSides::OneSides(const SensitivityRequest &request, const LinearResponse &response,
                   const std::vector<WeakChord> &weak, EquilibriumTangent &tangent)
    : request_(request), response_(response), weak_(weak) {
  for (const WeakChord &chord : weak) {
    motion_.push_back(elongation_gradient(request.model, chord));
    tangent.solve(motion_.back(), false);
  }
  const size_t m = weak.size(), first = request.quantities.size();
  flexibility_.assign(m * m, 0);
  for (size_t i = 0; i < m; ++i) {
    for (size_t j = 0; j < m; ++j) {
      flexibility_[i * m + j] = dot_of(response.gradient(first + i).by_position, motion_[j]);
    }
  }
}

// Rates of the elongations beyond the rest lengths.
std::vector<double> OneSides::rates_of(size_t p) const {
  const Parameter &parameter = request_.parameters[p];
  std::vector<double> rates;
  for (size_t i = 0; i < weak_.size(); ++i) {
    const double rate = response_.row(request_.quantities.size() + i, p);
    const bool own =
        parameter.kind == ParameterKind::chord_rest_length && parameter.index == weak_[i].chord;
    rates.push_back(own ? rate - 1 : rate);
  }
  return rates;
}

double OneSides::change_of(size_t q, size_t p, const std::vector<double> &t) const {
  const QuantityGradient &g = response_.gradient(q);
  if (g.by_differences) {
    NodeField motion = response_.motion(p);
    for (size_t j = 0; j < t.size(); ++j) {
      for (size_t i = 0; i < motion.size(); ++i) motion[i] -= t[j] * motion_[j][i];
    }
    return measure_difference(request_.model, request_.state, request_.quantities[q],
                              request_.parameters[p], motion) -
           response_.row(q, p);
  }
  double sum = 0;
  for (size_t j = 0; j < t.size(); ++j) {
    double by_tension = -dot_of(g.by_position, motion_[j]);
    for (const ChordShare &share : g.tension) {
      if (share.chord == weak_[j].chord) by_tension += share.factor;
    }
    sum += by_tension * t[j];
  }
  return sum;
}

std::vector<double> OneSides::changes(size_t p, const std::vector<double> &tensions) const {
  std::vector<double> list;
  for (size_t q = 0; q < request_.quantities.size(); ++q) {
    list.push_back(change_of(q, p, tensions));
  }
  return list;
}

OneSides::Sides OneSides::sides_of(size_t p) const {
  const std::vector<double> rates = rates_of(p);
  std::vector<double> falling = rates;
  for (double &rate : falling) rate = -rate;
  const std::vector<double> up = extra_tensions(weak_, flexibility_, rates);
  std::vector<double> down = extra_tensions(weak_, flexibility_, falling);
  for (double &t : down) t = -t;
  Sides sides;
  sides.switches = up.empty() || down.empty();
  for (const double t : up) sides.switches = sides.switches || t != 0;
  for (const double t : down) sides.switches = sides.switches || t != 0;
  if (!sides.switches) return sides;
  if (!up.empty()) sides.above = changes(p, up);
  if (!down.empty()) sides.below = changes(p, down);
  return sides;
}

}  // namespace mvs::core
