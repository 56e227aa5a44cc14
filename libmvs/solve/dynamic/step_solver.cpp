// Conjugate gradients around a cached factor, and the schedule by which factors are made.
#include "solve/dynamic/step_solver.h"

#include <algorithm>

#include "linalg/cholesky.h"
#include "solve/step_settings.h"

namespace mvs::core {
namespace {

constexpr uint32_t reserved_passes = settings::implicit::reserved_passes;

bool is_block_cholesky(Backend backend) {
  return backend == Backend::fastest || backend == Backend::block;
}

std::unique_ptr<DirectSolver> make_preconditioner(const Model &model, Backend backend) {
  if (backend != Backend::fastest) return make_direct_solver(backend);
  return CachedPreconditioner::is_large(model) ? make_compact_factor() : make_float_factor();
}

}  // namespace

StepSolver::StepSolver(const Model &model, const TotalEnergy &total_energy, Backend backend)
    : model_(&model),
      total_energy_(&total_energy),
      first_(model, make_preconditioner(model, backend)),
      second_(model, make_preconditioner(model, backend)),
      direct_(model, make_direct_solver(backend)) {
  // other backends do best with the order that each of them finds for a matrix
  if (is_block_cholesky(backend)) {
    dissects_ = CachedPreconditioner::is_large(model);
    if (!dissects_) order_.emplace(model, total_energy.pairs());
  }
  keys_.reserve(model.node_count());
  for (CowVector<Vec3> &x : positions_) x.reserve(model.node_count());
}

void StepSolver::solve(const StepSystem &system, State &state, StepWork &work) {
  if (keys_.pending().age == pending_->parts()) {
    std::swap(active_, pending_);
    keys_.set({keys_.pending(), {}});
  }
  // the guess: nodes keep their velocity; a third of all steps are solved with one iteration then
  const std::vector<Vec3> &v = state.v.get();
  guess_.resize(system.matrix.size());
  for (uint32_t r = 0; r < system.matrix.size(); ++r) {
    guess_[r] = work.how.dt * v[system.matrix.node(r)];
  }
  if (!keys_.active().empty() && iterate(system, work)) {
    keys_.count_active_use();
    work_ahead(system, work);
  } else if (!factorise_here(system, work)) {
    work.stats.lowered |= MVS_LOWERED_LINEAR;
    system.matrix.divide(system.rows);
  }
  keys_.store(state);
  // the sign of a zero would depend on the pattern
  for (Vec3 &row : system.rows) row.array() += 0.0;
}

// Returns false if the residual stays too large and the budget allows a factorisation instead.
bool StepSolver::iterate(const StepSystem &system, StepWork &work) {
  namespace set = settings::linear;
  const PhaseTimer timer(work.stats.work, MVS_PHASE_SOLVE);
  const auto multiply = [&](const std::vector<Vec3> &v, std::vector<Vec3> &y) {
    product_.multiply(system.matrix.blocks(), v, y);
  };
  const auto precondition = [&](const std::vector<Vec3> &r, std::vector<Vec3> &z) {
    active_->solve(r, z);
  };
  const PcgGoal goal{set::tolerance, std::min(set::max_iterations, work.left - reserved_passes),
                     set::max_residual, set::many_iterations + 1, set::late_tolerance};
  const PcgResult result = pcg_.solve(multiply, precondition, system.rows, guess_, solution_, goal);
  work.left -= result.iterations;
  iterations_ = result.iterations;
  work.stats.work.linear_iterations += result.iterations;
  if (!(result.error <= set::max_residual)) {
    const bool budget_ends = result.iterations > 0 && work.left <= reserved_passes;
    if (!budget_ends) return false;
    work.stats.lowered |= MVS_LOWERED_LINEAR;
  }
  system.rows.swap(solution_);
  return true;
}

// Whether the next factor is to be begun, from the age of the active one and the iterations of this
// step alone: what the steps before needed is no part of the state.
bool StepSolver::is_worn() const {
  namespace set = settings::linear;
  const uint32_t age = keys_.active().age;
  if (!CachedPreconditioner::is_large(*model_)) {
    return iterations_ > set::many_iterations || age > set::max_age;
  }
  if (age > set::max_large_age) return true;
  return iterations_ > set::few_iterations &&
         (iterations_ - set::few_iterations) * age > set::worth;
}

// Begins the next factor where the active one is old or needs many iterations; otherwise does one
// part of the factor that was begun.
void StepSolver::work_ahead(const StepSystem &system, StepWork &work) {
  if (keys_.pending().empty()) {
    work.stats.skipped |= MVS_SKIPPED_FACTOR;
    if (!is_worn()) return;
    keys_.set_pending(key_at(system));
    copy_matrix(system.matrix, keys_.pending(), *pending_, work.stats.work);
  } else if (work.left > reserved_passes) {
    const PhaseTimer timer(work.stats.work, MVS_PHASE_FACTOR);
    --work.left;
    if (!pending_->factorise_part(keys_.pending().age)) {
      keys_.set_pending({});
    } else if (keys_.count_pending_part() == pending_->parts()) {
      ++work.stats.factorisations;
    }
  }
}

// Factorises this matrix and solves with it. Returns false where the budget ends before.
bool StepSolver::factorise_here(const StepSystem &system, StepWork &work) {
  keys_.drop();
  if (work.left <= reserved_passes) return false;
  guess_.clear();  // a factor of this very matrix needs no guess
  const PreconditionerKey key = key_at(system);
  --work.left;  // of every solver alike, also of one that has this factor
  bool positive = active_->is_of(key, active_->parts());
  if (!positive) {
    copy_matrix(system.matrix, key, *active_, work.stats.work);
    const PhaseTimer timer(work.stats.work, MVS_PHASE_FACTOR);
    ++work.stats.factorisations;
    positive = active_->factorise();
  }
  if (positive && (work.left == reserved_passes || iterate(system, work))) {
    if (work.left == reserved_passes) solve_with(*active_, system.rows, work.stats);
    keys_.set({key, {}});
    return true;
  }
  return solve_directly(system, key, work);
}

// Solves in double precision, with more mass where the pressure makes the matrix indefinite, which
// amounts to a smaller time step. This factor serves no other step.
bool StepSolver::solve_directly(const StepSystem &system, const PreconditionerKey &key,
                                StepWork &work) {
  namespace set = settings::linear;
  copy_matrix(system.matrix, key, direct_, work.stats.work);
  double times = 1;
  while (work.left > reserved_passes && times < set::max_mass) {
    --work.left;
    ++work.stats.factorisations;
    bool positive = false;
    {
      const PhaseTimer timer(work.stats.work, MVS_PHASE_FACTOR);
      positive = direct_.factorise();
    }
    if (positive) {
      solve_with(direct_, system.rows, work.stats);
      return true;
    }
    if (times == 1) ++work.stats.shifted;
    direct_.add_mass(system.matrix, (set::mass_growth - 1) * times);
    times *= set::mass_growth;
  }
  return false;
}

void StepSolver::solve_with(CachedPreconditioner &factor, std::vector<Vec3> &rows,
                            SolveStats &stats) {
  const PhaseTimer timer(stats.work, MVS_PHASE_SOLVE);
  factor.solve(rows, solution_);
  rows.swap(solution_);
}

PreconditionerKey StepSolver::key_at(const StepSystem &system) {
  PreconditionerKey key = system.here;
  CowVector<Vec3> &x = free_buffer(positions_);
  x.edit() = system.x;
  key.x = x;
  return key;
}

void StepSolver::copy_matrix(const StepMatrix &matrix, const PreconditionerKey &key,
                             CachedPreconditioner &factor, Profile &profile) {
  const PhaseTimer timer(profile, MVS_PHASE_ORDERING);
  ++profile.orderings;
  if (order_) order_->update(total_energy_->contact().contact_pairs());
  std::vector<uint32_t> dissected;
  if (dissects_) dissected = dissection_order(matrix, key.x);
  factor.copy(matrix, key, order_ ? &order_->nodes() : dissects_ ? &dissected : nullptr);
}

void StepSolver::resume(State &state, const StepOptions &how, StepMatrix &matrix,
                        const Assemble &assemble) {
  keys_.load(state, *model_);
  const auto fits = [&](const PreconditionerKey &key) {
    return key.x.size() == state.x.size() && key.dt == how.dt && key.damping == how.damping;
  };
  if (!keys_.active().empty() && !fits(keys_.active())) keys_.drop();
  if (!keys_.pending().empty() && !fits(keys_.pending())) keys_.set_pending({});
  make_factors(matrix, assemble);
  keys_.store(state);
}

void StepSolver::make_factors(StepMatrix &matrix, const Assemble &assemble) {
  if (keys_.active().empty()) return;
  const uint32_t all = active_->parts(), some = keys_.pending().age;
  if (pending_->is_of(keys_.active(), all)) std::swap(active_, pending_);
  if (!active_->is_of(keys_.active(), all) &&
      !remake(keys_.active(), all, *active_, matrix, assemble)) {
    return keys_.drop();
  }
  if (keys_.pending().empty() || pending_->is_of(keys_.pending(), some)) return;
  if (!remake(keys_.pending(), some, *pending_, matrix, assemble)) keys_.set_pending({});
}

bool StepSolver::remake(const PreconditionerKey &key, uint32_t parts, CachedPreconditioner &factor,
                        StepMatrix &matrix, const Assemble &assemble) {
  assemble(key, matrix);
  Profile unseen{};
  copy_matrix(matrix, key, factor, unseen);
  for (uint32_t part = 0; part < parts; ++part) {
    if (!factor.factorise_part(part)) return false;
  }
  return true;
}

void StepSolver::make_ready(const StepSystem &system) {
  if (!keys_.active().empty()) return;
  Profile unseen{};
  const PreconditionerKey key = key_at(system);
  for (CachedPreconditioner *factor : {pending_, active_}) {
    copy_matrix(system.matrix, key, *factor, unseen);
    factor->factorise();
  }
}

}  // namespace mvs::core
