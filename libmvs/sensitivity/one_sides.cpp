// Solutions for unit forces along the switches with the kept factor, then a small problem for each
// parameter and side.
#include "sensitivity/one_sides.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sensitivity/measure_differences.h"
#include "sensitivity/settings.h"
#include "sensitivity/side_test.h"

namespace mvs::core {
namespace {

mvs_sensitivity_notes note_of(SwitchKind kind) {
  switch (kind) {
    case SwitchKind::chord:
      return MVS_SENSITIVITY_NOTE_CHORD;
    case SwitchKind::kink:
      return MVS_SENSITIVITY_NOTE_KINK;
    case SwitchKind::contact:
      break;
  }
  return MVS_SENSITIVITY_NOTE_CONTACT;
}

}  // namespace

OneSides::OneSides(const SensitivityRequest &request, const LinearResponse &response,
                   const std::vector<Switch> &switches, EquilibriumTangent &tangent, double slack)
    : request_(request), response_(response), switches_(switches), slack_(slack) {
  for (const Switch &s : switches) {
    motion_.push_back(field_of(request.model, s));
    tangent.solve(motion_.back(), false);
  }
  const size_t m = switches.size(), first = request.quantities.size();
  flexibility_.assign(m * m, 0);
  for (size_t i = 0; i < m; ++i) {
    for (size_t j = 0; j < m; ++j) {
      flexibility_[i * m + j] = dot_of(response.gradient(first + i).by_position, motion_[j]);
    }
  }
}

std::vector<double> OneSides::rates_of(size_t p, const std::vector<double> &forces) const {
  const size_t m = switches_.size();
  std::vector<double> rates;
  for (size_t i = 0; i < m; ++i) {
    double rate = response_.row(request_.quantities.size() + i, p) +
                  own_rate(request_.model, request_.state.x, switches_[i], request_.parameters[p]);
    for (size_t j = 0; j < forces.size(); ++j) rate -= flexibility_[i * m + j] * forces[j];
    rates.push_back(rate);
  }
  return rates;
}

NodeField OneSides::motion_of(size_t p, const std::vector<double> &forces) const {
  NodeField motion = response_.motion(p);
  for (size_t j = 0; j < forces.size(); ++j) {
    for (size_t i = 0; i < motion.size(); ++i) motion[i] -= forces[j] * motion_[j][i];
  }
  return motion;
}

std::vector<double> OneSides::changes_of(size_t p, const std::vector<double> &forces) const {
  const auto &[model, state, quantities, parameters] = request_;
  if (forces.empty()) {
    return std::vector<double>(quantities.size(), std::numeric_limits<double>::quiet_NaN());
  }
  std::optional<MeasureDifferences> differences;
  std::vector<double> changes;
  for (size_t q = 0; q < quantities.size(); ++q) {
    double change = 0;
    if (response_.gradient(q).by_differences) {
      if (!differences) differences.emplace(model, state, parameters[p], motion_of(p, forces));
      change = differences->of(*quantities[q].measure) - response_.row(q, p);
    } else {
      for (size_t j = 0; j < forces.size(); ++j) change += change_by(q, j) * forces[j];
    }
    changes.push_back(change);
  }
  return changes;
}

double OneSides::change_by(size_t q, size_t j) const {
  const QuantityGradient &g = response_.gradient(q);
  double change = -dot_of(g.by_position, motion_[j]);
  for (const ChordShare &share : g.tension) {
    if (switches_[j].is_chord && share.chord == switches_[j].index) change += share.factor;
  }
  return change;
}

// Calls matters(switch, force) with the larger of both sides. Where no state is known all matter.
template <typename Matters>
mvs_sensitivity_notes OneSides::notes_where(const Sides &sides, Matters matters) const {
  mvs_sensitivity_notes notes = 0;
  for (size_t j = 0; j < switches_.size(); ++j) {
    const bool counts =
        !sides.is_known() || matters(j, std::max(std::abs(sides.up[j]), std::abs(sides.down[j])));
    if (counts) notes |= note_of(switches_[j].kind);
  }
  return notes;
}

mvs_sensitivity_notes OneSides::notes_of_motion(const Sides &sides, double fastest) const {
  return notes_where(sides, [&](size_t j, double force) {
    return fastest_of(motion_[j]) * force > settings::sensitivity::mean_error * fastest;
  });
}

// Without motions: by the rates of the switches themselves.
mvs_sensitivity_notes OneSides::notes_of_parameter(size_t p, const Sides &sides) const {
  const size_t m = switches_.size();
  mvs_sensitivity_notes notes = 0;
  if (response_.has_motions()) {
    notes = notes_of_motion(sides, fastest_of(response_.motion(p)));
  } else {
    double fastest = 0;
    for (const double rate : rates_of(p, {})) fastest = std::max(fastest, std::abs(rate));
    notes = notes_where(sides, [&](size_t j, double force) {
      double moved = 0;
      for (size_t i = 0; i < m; ++i) moved = std::max(moved, std::abs(flexibility_[i * m + j]));
      return moved * force > settings::sensitivity::mean_error * fastest;
    });
  }
  for (size_t q = 0; q < request_.quantities.size(); ++q) {
    if (!response_.gradient(q).by_differences) notes |= notes_of_quantity(q, p, sides);
  }
  return notes;
}

mvs_sensitivity_notes OneSides::notes_along(std::span<const ParameterStep> steps,
                                            const NodeField &motion) const {
  std::vector<double> rates;
  for (size_t j = 0; j < switches_.size(); ++j) {
    double rate = dot_of(response_.gradient(request_.quantities.size() + j).by_position, motion);
    for (const ParameterStep &step : steps) {
      rate += step.by * own_rate(request_.model, request_.state.x, switches_[j], *step.parameter);
    }
    rates.push_back(rate);
  }
  return notes_of_motion(sides_along(rates, fastest_along(steps, motion)), fastest_of(motion));
}

mvs_sensitivity_notes OneSides::notes_of_quantity(size_t q, size_t p, const Sides &sides) const {
  if (response_.gradient(q).by_differences) return notes_of_parameter(p, sides);
  const double least = settings::sensitivity::mean_error * std::abs(response_.row(q, p));
  return notes_where(
      sides, [&](size_t j, double force) { return std::abs(change_by(q, j)) * force > least; });
}

OneSides::Sides OneSides::sides_of(size_t p) const {
  double fastest = 0;
  if (response_.has_motions()) {
    const ParameterStep step = {&request_.parameters[p], 1};
    fastest = fastest_along({&step, 1}, response_.motion(p));
  }
  return sides_along(rates_of(p, {}), fastest);
}

// `fastest`: displacement of the fastest node, 0 if it is not known.
OneSides::Sides OneSides::sides_along(std::vector<double> rates, double fastest) const {
  std::vector<Switch> reached = switches_;
  for (size_t j = 0; j < reached.size(); ++j) {
    if (std::abs(reached[j].over) * fastest <= slack_ * std::abs(rates[j])) continue;
    reached[j].up = reached[j].down = reached[j].strength = 0;
  }
  Sides sides;
  sides.up = extra_forces(reached, flexibility_, rates, slack_);
  for (double &rate : rates) rate = -rate;
  sides.down = extra_forces(reached, flexibility_, rates, slack_);
  for (double &t : sides.down) t = -t;
  return sides;
}

}  // namespace mvs::core
