// Chooses between adjoint and direct solutions, and puts the parts together.
#include "sensitivity/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "base/error.h"
#include "sensitivity/idle_branches.h"
#include "sensitivity/one_sides.h"
#include "sensitivity/settings.h"
#include "sensitivity/side_test.h"
#include "solve/stability.h"
#include "solve/tools/tool_points.h"

namespace mvs::core {
namespace {

namespace set = settings::sensitivity;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

class Differentiation {
 public:
  Differentiation(const SensitivityRequest &request, const SensitivityOptions &options)
      : request_(request), options_(options), tangent_(request.model, request.state) {}

  Sensitivity run();

 private:
  void tell_progress();
  void find_margin();
  std::vector<QuantityGradient> gradients();
  void note_everywhere(mvs_sensitivity_notes note);
  void add_one_sides(const LinearResponse &response);
  void test_parameters(const LinearResponse &response);
  void test_quantities(LinearResponse &response);
  bool holds(std::span<const ParameterStep> steps, const NodeField &motion);
  bool confirms(const OneSides &one_sides, size_t p, const std::vector<double> &forces,
                double side);
  size_t at(size_t q, size_t p) const { return q * request_.parameters.size() + p; }

  const SensitivityRequest &request_;
  const SensitivityOptions &options_;
  EquilibriumTangent tangent_;
  std::vector<Switch> switches_;
  std::unique_ptr<OneSides> one_sides_;  // where something is about to switch
  bool snaps_ = false;                   // a fold is about to snap
  uint32_t solves_ = 0;
  size_t units_ = 1, units_done_ = 0;  // of work, of which progress is told
  Sensitivity result_;
};

void Differentiation::tell_progress() {
  ++units_done_;
  const double share = static_cast<double>(units_done_) / static_cast<double>(units_);
  MVS_MUST(!options_.progress || options_.progress(std::min(share, 1.0), result_.residual),
           MVS_E_CANCELLED, "sensitivity", "cancelled by the progress callback");
}

void Differentiation::find_margin() {
  const double rate = must_be_stable(request_.model, request_.state, tangent_);
  result_.residual = tangent_.residual();
  result_.stiffness_margin = options_.with_margin ? tangent_.smallest_stiffness() : unknown;
  snaps_ = tangent_.is_definite() ? result_.stiffness_margin < set::near_snap
                                  : rate > -set::near_snap_rate;
}

// Gradients of the quantities, then of the switches.
std::vector<QuantityGradient> Differentiation::gradients() {
  const auto &[model, state, quantities, parameters] = request_;
  std::vector<QuantityGradient> list;
  for (const Quantity &q : quantities) {
    list.push_back(quantity_gradient(model, state, q, options_.slack,
                                     &tangent_.energy().broad_phase().topology()));
    result_.value.push_back(list.back().value);
    result_.quantity_notes.push_back(list.back().notes);
  }
  result_.parameter_notes.assign(parameters.size(), 0);
  result_.nodes = model.node_count();
  switches_ = find_chord_switches(model, state.x, options_.slack);
  if (options_.tests) {
    find_kinks(model, state.x, options_.slack, tangent_.energy().springs(), switches_);
    find_contact_switches(model, state.x, options_.slack, tangent_.energy(), switches_);
  }
  for (const Switch &at : switches_) {
    if (at.kind == SwitchKind::chord) result_.weak_chords.push_back(at.index);
    if (at.kind == SwitchKind::contact) result_.weak_contacts.push_back(at.index);
    result_.kinks += at.kind == SwitchKind::kink;
  }
  if (switches_.size() > set::most_switches) return list;
  for (const Switch &at : switches_) list.emplace_back().by_position = field_of(model, at);
  return list;
}

bool is_adjoint(const std::vector<QuantityGradient> &gradients, size_t parameters,
                const SensitivityOptions &options) {
  const bool differences = std::any_of(gradients.begin(), gradients.end(),
                                       [](const QuantityGradient &g) { return g.by_differences; });
  return !differences && !options.direct && !options.with_motion && gradients.size() < parameters;
}

void Differentiation::note_everywhere(mvs_sensitivity_notes note) {
  for (mvs_sensitivity_notes &notes : result_.parameter_notes) notes |= note;
  for (mvs_sensitivity_notes &notes : result_.quantity_notes) notes |= note;
}

void Differentiation::add_one_sides(const LinearResponse &response) {
  const size_t count = request_.quantities.size(), size = count * request_.parameters.size();
  const std::vector<double> &rows = response.rows();
  result_.derivative.assign(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(size));
  result_.above = result_.below = result_.derivative;
  if (switches_.empty()) return;
  if (switches_.size() > set::most_switches) {
    if (!result_.weak_chords.empty()) note_everywhere(MVS_SENSITIVITY_NOTE_CHORD);
    if (!result_.weak_contacts.empty()) note_everywhere(MVS_SENSITIVITY_NOTE_CONTACT);
    if (result_.kinks > 0) note_everywhere(MVS_SENSITIVITY_NOTE_KINK);
    result_.above.assign(size, unknown);
    result_.below = result_.above;
    return;
  }
  one_sides_ = std::make_unique<OneSides>(request_, response, switches_, tangent_, options_.slack);
  const OneSides &one_sides = *one_sides_;
  solves_ += static_cast<uint32_t>(switches_.size());
  for (size_t p = 0; p < request_.parameters.size(); ++p) {
    tell_progress();
    const OneSides::Sides sides = one_sides.sides_of(p);
    const mvs_sensitivity_notes notes = one_sides.notes_of_parameter(p, sides);
    if (notes == 0) continue;
    result_.parameter_notes[p] |= notes;
    const std::vector<double> above = one_sides.changes_of(p, sides.up);
    const std::vector<double> below = one_sides.changes_of(p, sides.down);
    for (size_t q = 0; q < count; ++q) {
      result_.above[at(q, p)] += above[q];
      result_.below[at(q, p)] += below[q];
      // with tests: along the gradient
      if (!options_.tests) {
        result_.quantity_notes[q] |= one_sides.notes_of_quantity(q, p, sides);
      }
    }
    if (options_.tests && response.has_motions() && sides.is_known() &&
        confirms(one_sides, p, sides.up, 1) && confirms(one_sides, p, sides.down, -1)) {
      result_.parameter_notes[p] |= MVS_SENSITIVITY_NOTE_SIDES;
    }
  }
}

// Whether the forces on one side follow the motion there.
bool Differentiation::confirms(const OneSides &one_sides, size_t p,
                               const std::vector<double> &forces, double side) {
  ++solves_;
  const ParameterStep step = {&request_.parameters[p], 1};
  const SideMotion moved = {one_sides.motion_of(p, forces), one_sides.rates_of(p, forces), forces};
  return holds_on_one_side(request_.model, request_.state, tangent_, {&step, 1}, moved, switches_,
                           side * options_.slack);
}

bool Differentiation::holds(std::span<const ParameterStep> steps, const NodeField &motion) {
  solves_ += 2;
  return holds_on_both_sides(request_.model, request_.state, tangent_, steps, motion,
                             options_.slack);
}

void Differentiation::test_parameters(const LinearResponse &response) {
  for (size_t p = 0; p < request_.parameters.size(); ++p) {
    tell_progress();
    const ParameterStep step = {&request_.parameters[p], 1};
    if (!holds({&step, 1}, response.motion(p))) {
      result_.parameter_notes[p] |= MVS_SENSITIVITY_NOTE_SWITCH;
    }
  }
}

// Along the gradient of each quantity, with parameters scaled to each other.
void Differentiation::test_quantities(LinearResponse &response) {
  for (size_t q = 0; q < request_.quantities.size(); ++q) {
    tell_progress();
    std::vector<ParameterStep> steps;
    for (size_t p = 0; p < request_.parameters.size(); ++p) {
      const Parameter &parameter = request_.parameters[p];
      const double scale = natural_scale(request_.model, request_.state, parameter);
      const double slope = result_.derivative[at(q, p)];
      if (slope != 0) steps.push_back({&parameter, scale * scale * slope});
    }
    if (steps.empty()) continue;
    const NodeField motion = response.motion_of(steps);
    if (one_sides_) result_.quantity_notes[q] |= one_sides_->notes_along(steps, motion);
    if (!holds(steps, motion)) result_.quantity_notes[q] |= MVS_SENSITIVITY_NOTE_SWITCH;
  }
}

Sensitivity Differentiation::run() {
  find_margin();
  std::vector<QuantityGradient> list = gradients();
  const bool adjoint = is_adjoint(list, request_.parameters.size(), options_);
  const size_t list_size = list.size();
  LinearResponse response(request_, std::move(list), tangent_);
  const size_t columns = request_.parameters.size();
  const size_t tested = (adjoint ? 0 : columns) + request_.quantities.size();
  units_ = (adjoint ? list_size : columns) + (switches_.empty() ? 0 : columns) +
           (options_.tests ? tested : 0);
  const auto after_one = [&] { tell_progress(); };
  if (adjoint) {
    response.solve_adjoint(after_one);
  } else {
    response.solve_directly(options_.tests ? 2 : 0, after_one);
  }
  add_one_sides(response);
  if (options_.tests) {
    if (!adjoint) test_parameters(response);
    test_quantities(response);
  }
  if (snaps_) note_everywhere(MVS_SENSITIVITY_NOTE_SNAP);
  if (options_.with_motion) {
    for (size_t p = 0; p < request_.parameters.size(); ++p) {
      const NodeField &motion = response.motion(p);
      result_.motion.insert(result_.motion.end(), motion.begin(), motion.end());
    }
  }
  result_.adjoint_solves = response.adjoint_solves();
  result_.direct_solves = response.direct_solves() + solves_;
  result_.linear_error = tangent_.linear_error();
  return std::move(result_);
}

// Differentiates with idle branch points out of the way. Values are those of the state itself.
Sensitivity differentiate_at(const Model &model, const State &state,
                             const std::vector<Quantity> &quantities,
                             const std::vector<Parameter> &parameters,
                             const SensitivityOptions &options) {
  const State slack = with_slack_branches(model, state, options.slack);
  const SensitivityRequest request = {model, slack, quantities, parameters};
  Sensitivity found = Differentiation(request, options).run();
  for (size_t q = 0; q < quantities.size(); ++q) {
    // measures do not depend on the place of branch points
    if (quantities[q].kind == QuantityKind::measure) continue;
    found.value[q] = quantity_gradient(model, state, quantities[q]).value;
  }
  return found;
}

void must_be_at_rest(const State &state) {
  MVS_MUST(state.is_at_rest(), MVS_E_STATE, "snapshot",
           "the snapshot is not at rest under its load: settle the valve, then take its "
           "sensitivity");
}

}  // namespace

State with_slack_branches(const Model &model, const State &state, double slack) {
  must_be_at_rest(state);
  State moved = state;
  const double margin = std::max(set::idle_margin, 10 * slack);
  const double tension = set::idle_share * state.rest_tolerance;
  if (!slacken_idle_branches(model, tension, margin, moved.x.edit())) {
    moved.x = state.x;
  } else {
    // the insertions have lost that tension
    moved.rest_tolerance += tension;
  }
  return moved;
}

// With Ks positive definite the equilibrium is stable; otherwise the eigenvalues decide.
double must_be_stable(const Model &model, const State &state, const EquilibriumTangent &tangent) {
  const double limit = set::rest_share * state.rest_tolerance;
  MVS_MUST(tangent.residual() <= limit, MVS_E_STATE, "snapshot",
           "the out-of-balance force is %.2g N, above the %.2g N of its rest: settle the valve "
           "with Newton's method first",
           tangent.residual(), state.rest_tolerance);
  if (tangent.is_definite()) return -std::numeric_limits<double>::infinity();
  const Stability found = check_stability(model, state);
  MVS_MUST(found.is_stable, MVS_E_STATE, "snapshot",
           "the equilibrium is unstable (growth rate %.2g 1/s), so that its derivatives mean "
           "nothing: settle the valve again",
           found.rate);
  return found.rate;
}

Sensitivity differentiate(const Model &model, const State &state,
                          const std::vector<Quantity> &quantities,
                          const std::vector<Parameter> &parameters,
                          const SensitivityOptions &options) {
  must_be_at_rest(state);
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
