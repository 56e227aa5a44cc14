// Chooses between adjoint and direct solutions, and puts the parts together.
#include "sensitivity/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "sensitivity/idle_branches.h"
#include "sensitivity/settings.h"
#include "sensitivity/side_test.h"
#include "sensitivity/weak_chords.h"
#include "solve/stability.h"
#include "solve/tools/tool_points.h"

namespace mvs::core {
namespace {

namespace set = settings::sensitivity;

double dot_of(const NodeField &a, const NodeField &b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

double dot_of(const NodeField &a, const std::vector<NodeVector> &b) {
  double sum = 0;
  for (const NodeVector &v : b) sum += a[v.node].dot(v.value);
  return sum;
}

class Differentiation {
 public:
  Differentiation(const Model &model, const State &state, const std::vector<Quantity> &quantities,
                  const std::vector<Parameter> &parameters, const SensitivityOptions &options)
      : model_(model),
        state_(state),
        quantities_(quantities),
        parameters_(parameters),
        options_(options),
        tangent_(model, state) {}

  Sensitivity run();

 private:
  void must_be_stable();
  void load();
  bool is_adjoint() const;
  NodeField motion_of(const std::vector<ParameterStep> &steps);
  void solve_directly();
  void solve_adjoint();
  void add_one_sides();
  void find_flexibility();
  void add_one_sides_of(size_t p, const std::vector<double> &rates);
  double side_of(size_t q, size_t p, const std::vector<double> &t);
  void test_parameters();
  void test_quantities();
  size_t at(size_t q, size_t p) const { return q * parameters_.size() + p; }

  const Model &model_;
  const State &state_;
  const std::vector<Quantity> &quantities_;
  const std::vector<Parameter> &parameters_;
  const SensitivityOptions &options_;
  EquilibriumTangent tangent_;
  std::vector<QuantityGradient> gradients_;  // of the quantities, then of the weak elongations
  std::vector<ParameterLoad> loads_;
  std::vector<NodeField> motions_;  // per parameter, if solved directly
  std::vector<double> rows_;        // derivatives of gradients_
  std::vector<WeakChord> weak_;
  std::vector<NodeField> weak_motion_;  // K^-1 of a unit tension of each
  std::vector<double> flexibility_;
  bool snaps_ = false;  // a fold is about to snap
  Sensitivity result_;
};

// With Ks positive definite the equilibrium is stable; otherwise the eigenvalues decide.
void Differentiation::must_be_stable() {
  const double limit = set::rest_share * state_.rest_tolerance;
  MVS_MUST(tangent_.residual() <= limit, MVS_E_STATE, "snapshot",
           "the out-of-balance force is %.2g N, above the %.2g N of its rest: settle the valve "
           "with Newton's method first",
           tangent_.residual(), state_.rest_tolerance);
  if (!tangent_.is_definite()) {
    const Stability found = check_stability(model_, state_);
    MVS_MUST(found.is_stable, MVS_E_STATE, "snapshot",
             "the equilibrium is unstable (growth rate %.2g 1/s), so that its derivatives mean "
             "nothing: settle the valve again",
             found.rate);
    snaps_ = found.rate > -set::near_snap_rate;
  }
  result_.residual = tangent_.residual();
  result_.stiffness_margin = options_.with_margin ? tangent_.smallest_stiffness()
                                                  : std::numeric_limits<double>::quiet_NaN();
  if (tangent_.is_definite()) snaps_ = result_.stiffness_margin < set::near_snap;
}

void Differentiation::load() {
  for (const Quantity &q : quantities_) gradients_.push_back(quantity_gradient(model_, state_, q));
  for (const QuantityGradient &g : gradients_) {
    result_.value.push_back(g.value);
    result_.quantity_notes.push_back(g.notes);
  }
  for (const Parameter &p : parameters_) loads_.push_back(parameter_load(model_, state_, p));
  result_.parameter_notes.assign(parameters_.size(), 0);
  result_.nodes = model_.node_count();
  weak_ = find_weak_chords(model_, state_.x, options_.slack);
  for (const WeakChord &weak : weak_) {
    result_.weak_chords.push_back(weak.chord);
    QuantityGradient elongation;
    elongation.by_position.assign(model_.node_count(), Vec3::Zero());
    elongation.by_position[model_.valve.chords[weak.chord].a] -= weak.along;
    elongation.by_position[model_.valve.chords[weak.chord].b] += weak.along;
    gradients_.push_back(elongation);
  }
  rows_.assign(gradients_.size() * parameters_.size(), 0);
}

bool Differentiation::is_adjoint() const {
  const bool differences = std::any_of(gradients_.begin(), gradients_.end(),
                                       [](const QuantityGradient &g) { return g.by_differences; });
  return !differences && !options_.direct && !options_.with_motion &&
         gradients_.size() < parameters_.size();
}

// dx for a change of parameters, by one direct solution.
NodeField Differentiation::motion_of(const std::vector<ParameterStep> &steps) {
  NodeField b(model_.node_count(), Vec3::Zero()), moved = b, pulled;
  bool moves = false;
  for (const ParameterStep &step : steps) {
    const ParameterLoad &load = loads_[static_cast<size_t>(step.parameter - parameters_.data())];
    for (const NodeVector &v : load.force) b[v.node] -= step.by * v.value;
    for (const NodeVector &v : load.motion) moved[v.node] += step.by * v.value;
    moves = moves || !load.motion.empty();
  }
  if (moves) {
    tangent_.multiply(moved, false, pulled);
    for (size_t i = 0; i < b.size(); ++i) b[i] -= pulled[i];
  }
  tangent_.solve(b, false);
  ++result_.direct_solves;
  for (size_t i = 0; i < b.size(); ++i) b[i] += moved[i];
  return b;
}

void Differentiation::solve_directly() {
  tangent_.expect_solutions(options_.tests ? 3 * parameters_.size() : parameters_.size());
  for (size_t p = 0; p < parameters_.size(); ++p) {
    motions_.push_back(motion_of({{&parameters_[p], 1}}));
    for (size_t q = 0; q < gradients_.size(); ++q) {
      const QuantityGradient &g = gradients_[q];
      rows_[at(q, p)] =
          g.by_differences
              ? measure_difference(model_, state_, quantities_[q], parameters_[p], motions_[p])
              : dot_of(g.by_position, motions_[p]) +
                    explicit_derivative(model_, state_.x, g, parameters_[p]);
    }
  }
}

void Differentiation::solve_adjoint() {
  const bool moves = std::any_of(loads_.begin(), loads_.end(),
                                 [](const ParameterLoad &l) { return !l.motion.empty(); });
  NodeField pulled;
  for (size_t q = 0; q < gradients_.size(); ++q) {
    const QuantityGradient &g = gradients_[q];
    NodeField lambda = g.by_position;
    tangent_.solve(lambda, true);
    ++result_.adjoint_solves;
    if (moves) tangent_.multiply(lambda, true, pulled);
    for (size_t p = 0; p < parameters_.size(); ++p) {
      double &row = rows_[at(q, p)];
      row = explicit_derivative(model_, state_.x, g, parameters_[p]) -
            dot_of(lambda, loads_[p].force);
      if (moves) {
        row += dot_of(g.by_position, loads_[p].motion) - dot_of(pulled, loads_[p].motion);
      }
    }
  }
}

void Differentiation::find_flexibility() {
  const size_t m = weak_.size(), first = quantities_.size();
  for (const WeakChord &weak : weak_) {
    NodeField b(model_.node_count(), Vec3::Zero());
    b[model_.valve.chords[weak.chord].a] -= weak.along;
    b[model_.valve.chords[weak.chord].b] += weak.along;
    tangent_.solve(b, false);
    ++result_.direct_solves;
    weak_motion_.push_back(std::move(b));
  }
  flexibility_.assign(m * m, 0);
  for (size_t i = 0; i < m; ++i) {
    for (size_t j = 0; j < m; ++j) {
      flexibility_[i * m + j] = dot_of(gradients_[first + i].by_position, weak_motion_[j]);
    }
  }
}

// The change of a quantity by extra tensions of the weak chordae, added to `t` = 0.
double Differentiation::side_of(size_t q, size_t p, const std::vector<double> &t) {
  const QuantityGradient &g = gradients_[q];
  if (g.by_differences) {
    NodeField motion = motions_[p];
    for (size_t j = 0; j < t.size(); ++j) {
      for (size_t i = 0; i < motion.size(); ++i) motion[i] -= t[j] * weak_motion_[j][i];
    }
    return measure_difference(model_, state_, quantities_[q], parameters_[p], motion) -
           rows_[at(q, p)];
  }
  double sum = 0;
  for (size_t j = 0; j < t.size(); ++j) {
    double by_tension = -dot_of(g.by_position, weak_motion_[j]);
    for (const ChordShare &share : g.tension) {
      if (share.chord == weak_[j].chord) by_tension += share.factor;
    }
    sum += by_tension * t[j];
  }
  return sum;
}

void Differentiation::add_one_sides_of(size_t p, const std::vector<double> &rates) {
  std::vector<double> falling = rates;
  for (double &rate : falling) rate = -rate;
  const std::vector<double> up = extra_tensions(weak_, flexibility_, rates);
  std::vector<double> down = extra_tensions(weak_, flexibility_, falling);
  for (double &t : down) t = -t;
  bool switches = up.empty() || down.empty();
  for (const double t : up) switches = switches || t != 0;
  for (const double t : down) switches = switches || t != 0;
  if (!switches) return;
  result_.parameter_notes[p] |= MVS_SENSITIVITY_NOTE_CHORD;
  for (size_t q = 0; q < quantities_.size(); ++q) {
    if (!up.empty()) result_.above[at(q, p)] += side_of(q, p, up);
    if (!down.empty()) result_.below[at(q, p)] += side_of(q, p, down);
    result_.quantity_notes[q] |= MVS_SENSITIVITY_NOTE_CHORD;
  }
}

void Differentiation::add_one_sides() {
  const size_t size = quantities_.size() * parameters_.size();
  result_.derivative.assign(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(size));
  result_.above = result_.below = result_.derivative;
  if (weak_.empty()) return;
  if (weak_.size() > max_weak_chords) {
    for (mvs_sensitivity_notes &notes : result_.parameter_notes) {
      notes |= MVS_SENSITIVITY_NOTE_CHORD;
    }
    for (mvs_sensitivity_notes &notes : result_.quantity_notes) notes |= MVS_SENSITIVITY_NOTE_CHORD;
    return;
  }
  find_flexibility();
  for (size_t p = 0; p < parameters_.size(); ++p) {
    std::vector<double> rates;
    for (size_t i = 0; i < weak_.size(); ++i) {
      double rate = rows_[at(quantities_.size() + i, p)];
      const bool own = parameters_[p].kind == ParameterKind::chord_rest_length &&
                       parameters_[p].index == weak_[i].chord;
      rates.push_back(own ? rate - 1 : rate);
    }
    add_one_sides_of(p, rates);
  }
}

void Differentiation::test_parameters() {
  for (size_t p = 0; p < parameters_.size(); ++p) {
    const bool holds = holds_on_both_sides(model_, state_, tangent_, {{&parameters_[p], 1}},
                                           motions_[p], options_.slack);
    result_.direct_solves += 2;
    if (!holds) result_.parameter_notes[p] |= MVS_SENSITIVITY_NOTE_SWITCH;
  }
}

// Along the gradient of each quantity, with parameters scaled to each other.
void Differentiation::test_quantities() {
  for (size_t q = 0; q < quantities_.size(); ++q) {
    std::vector<ParameterStep> steps;
    for (size_t p = 0; p < parameters_.size(); ++p) {
      const double scale = natural_scale(model_, state_, parameters_[p]);
      const double slope = result_.derivative[at(q, p)];
      if (slope != 0) steps.push_back({&parameters_[p], scale * scale * slope});
    }
    if (steps.empty()) continue;
    const NodeField motion = motion_of(steps);
    result_.direct_solves += 2;
    if (!holds_on_both_sides(model_, state_, tangent_, steps, motion, options_.slack)) {
      result_.quantity_notes[q] |= MVS_SENSITIVITY_NOTE_SWITCH;
    }
  }
}

Sensitivity Differentiation::run() {
  must_be_stable();
  load();
  const bool adjoint = is_adjoint();
  if (adjoint) {
    solve_adjoint();
  } else {
    solve_directly();
  }
  add_one_sides();
  if (options_.tests) {
    if (!adjoint) test_parameters();
    test_quantities();
  }
  if (snaps_) {
    for (mvs_sensitivity_notes &n : result_.parameter_notes) n |= MVS_SENSITIVITY_NOTE_SNAP;
    for (mvs_sensitivity_notes &n : result_.quantity_notes) n |= MVS_SENSITIVITY_NOTE_SNAP;
  }
  if (options_.with_motion) {
    for (const NodeField &motion : motions_) {
      result_.motion.insert(result_.motion.end(), motion.begin(), motion.end());
    }
  }
  result_.linear_error = tangent_.linear_error();
  return std::move(result_);
}

}  // namespace

namespace {

// Differentiates with idle branch points out of the way. Values are those of the state itself.
Sensitivity differentiate_at(const Model &model, const State &state,
                             const std::vector<Quantity> &quantities,
                             const std::vector<Parameter> &parameters,
                             const SensitivityOptions &options) {
  State slack = state;
  const double margin = std::max(set::idle_margin, 10 * options.slack);
  const double tension = set::idle_share * state.rest_tolerance;
  if (!slacken_idle_branches(model, tension, margin, slack.x.edit())) slack.x = state.x;
  Sensitivity found = Differentiation(model, slack, quantities, parameters, options).run();
  for (size_t q = 0; q < quantities.size(); ++q) {
    // measures do not depend on the place of branch points
    if (quantities[q].kind == QuantityKind::measure) continue;
    found.value[q] = quantity_gradient(model, state, quantities[q]).value;
  }
  return found;
}

}  // namespace

Sensitivity differentiate(const Model &model, const State &state,
                          const std::vector<Quantity> &quantities,
                          const std::vector<Parameter> &parameters,
                          const SensitivityOptions &options) {
  MVS_MUST(state.is_at_rest(), MVS_E_STATE, "snapshot",
           "the snapshot is not at rest under its load: settle the valve, then take its "
           "sensitivity");
  for (size_t q = 0; q < quantities.size(); ++q) check_quantity(model, quantities[q], q);
  for (size_t p = 0; p < parameters.size(); ++p) check_parameter(model, parameters[p], p);
  const uint32_t extra = tool_points(state.tools);
  if (extra == 0) return differentiate_at(model, state, quantities, parameters, options);
  ToolPoints points;
  const Model &with_tools = points.extend(model, extra);
  const State extended = ToolPoints::extended(state);
  const auto widened = [&](auto list, auto field) {
    for (auto &item : list) {
      if (!(item.*field).empty()) (item.*field).resize(with_tools.node_count(), Vec3::Zero());
    }
    return list;
  };
  const std::vector<Quantity> wide = widened(quantities, &Quantity::weights);
  const std::vector<Parameter> wide_parameters = widened(parameters, &Parameter::mode);
  return differentiate_at(with_tools, extended, wide, wide_parameters, options);
}

}  // namespace mvs::core
