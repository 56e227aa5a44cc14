#include "solve/dynamic/step_solver.h"

#include <algorithm>

#include "linalg/cholesky.h"

namespace mvs::core {
namespace {

// Of the linear system, in the norm of its preconditioner. What is left of it is small beside what
// linearising a step leaves out, and forces of the next step hold it again.
constexpr double tolerance = 1e-3;
// After the most iterations, each about a tenth of a factor with its order, this will do, and the
// next factor is begun; else one is made at once. What comes to that is a valve a few steps after a
// chord was cut or its leaflets met: each step leads downhill, less far.
constexpr double good_enough = 0.3;
constexpr uint32_t most_iterations = 10;
// More iterations or an older factor: the next one is begun. A factor in parts costs as much as
// some ten iterations.
constexpr uint32_t many_iterations = 3;
constexpr uint32_t oldest = 20;  // steps
// Then this will do: a slow step goes through no more iterations for what linearising it leaves out
// anyway.
constexpr double enough = 1e-2;

bool is_our_own(uint32_t backend) {
  return backend == MVS_BACKEND_DEFAULT || backend == MVS_BACKEND_BLOCK;
}

std::unique_ptr<DirectSolver> make_preconditioner(uint32_t backend) {
  return backend == MVS_BACKEND_DEFAULT ? make_float_factor() : make_direct_solver(backend);
}

}  // namespace

StepSolver::StepSolver(const Model &model, const TotalEnergy &total_energy, uint32_t backend)
    : total_energy_(&total_energy),
      first_(model, make_preconditioner(backend)),
      second_(model, make_preconditioner(backend)),
      exact_(model, make_direct_solver(backend)) {
  // other backends do best with the order that each matrix of its own gives
  if (is_our_own(backend)) order_.emplace(model, total_energy.pairs());
}

void StepSolver::resume(State &state, const StepOptions &how, StepMatrix &matrix,
                        const Look &look) {
  for (PreconditionerKey *place : {&state.serving, &state.coming}) {
    const bool fits =
        place->x.size() == state.x.size() && place->dt == how.dt && place->damping == how.damping;
    if (!fits) *place = {};
  }
  if (state.serving.x.empty()) return state.drop_cache();
  // a file may say anything
  if (state.coming.age > CachedPreconditioner::parts) state.coming = {};
  const uint32_t all = CachedPreconditioner::parts, some = state.coming.age;
  if (coming_->is_of(state.serving, all)) std::swap(serving_, coming_);
  if (!serving_->is_of(state.serving, all) &&
      !remake(state.serving, all, *serving_, matrix, look)) {
    return state.drop_cache();
  }
  if (state.coming.x.empty() || coming_->is_of(state.coming, some)) return;
  if (!remake(state.coming, some, *coming_, matrix, look)) state.coming = {};
}

void StepSolver::make_ready(const StepMatrix &matrix, const PreconditionerKey &here,
                            const std::vector<Vec3> &x, const State &state) {
  if (!state.serving.x.empty()) return;
  Profile unseen{};
  const PreconditionerKey place = with_place(here, x);
  for (CachedPreconditioner *factor : {coming_, serving_}) {
    take(matrix, place, *factor, unseen);
    factor->factorise();
  }
}

bool StepSolver::remake(const PreconditionerKey &place, uint32_t parts,
                        CachedPreconditioner &factor, StepMatrix &matrix, const Look &look) {
  look(place, matrix);
  Profile unseen{};
  take(matrix, place, factor, unseen);
  for (uint32_t part = 0; part < parts; ++part) {
    if (!factor.factorise_part(part)) return false;
  }
  return true;
}

void StepSolver::take(const StepMatrix &matrix, const PreconditionerKey &place,
                      CachedPreconditioner &factor, Profile &profile) {
  const PhaseTimer timer(profile, MVS_PHASE_ORDERING);
  ++profile.orderings;
  if (order_) order_->update(total_energy_->contact().contact_pairs());
  factor.take(matrix, place, order_ ? &order_->nodes() : nullptr);
}

void StepSolver::solve(StepMatrix &matrix, const PreconditionerKey &here,
                       const std::vector<Vec3> &x, State &state, std::vector<Vec3> &rows,
                       uint32_t &left, SolveStats &stats) {
  if (state.coming.age == CachedPreconditioner::parts) {
    std::swap(serving_, coming_);
    state.serving = std::exchange(state.coming, {});
  }
  guess(matrix, here.dt, state.v);
  if (!state.serving.x.empty() && iterate(matrix, rows, left, stats)) {
    ++state.serving.age;
    work_ahead(matrix, here, x, state, left, stats);
  } else if (!factorise_here(matrix, here, x, state, rows, left, stats)) {
    stats.lowered |= MVS_LOWERED_LINEAR;
    matrix.divide(rows);
  }
  // a zero has the sign that it has in any pattern
  for (Vec3 &row : rows) row.array() += 0.0;
}

// That nodes go on as they went: a third of all steps are solved with one iteration from there.
void StepSolver::guess(const StepMatrix &matrix, double dt, const std::vector<Vec3> &v) {
  guess_.resize(matrix.size());
  for (uint32_t r = 0; r < matrix.size(); ++r) guess_[r] = dt * v[matrix.node(r)];
}

bool StepSolver::iterate(const StepMatrix &matrix, std::vector<Vec3> &rows, uint32_t &left,
                         SolveStats &stats) {
  const PhaseTimer timer(stats.work, MVS_PHASE_SOLVE);
  const auto multiply = [&](const std::vector<Vec3> &v, std::vector<Vec3> &y) {
    product_.multiply(matrix.blocks(), v, y);
  };
  const auto precondition = [&](const std::vector<Vec3> &r, std::vector<Vec3> &z) {
    serving_->solve(r, z);
  };
  const PcgGoal goal{tolerance, std::min(most_iterations, left - closing), good_enough,
                     many_iterations + 1, enough};
  const PcgResult result = pcg_.solve(multiply, precondition, rows, guess_, solution_, goal);
  left -= result.iterations;
  iterations_ = result.iterations;
  stats.work.linear_iterations += result.iterations;
  if (!(result.error <= good_enough)) {
    const bool no_more = result.iterations > 0 && left <= closing;
    if (!no_more) return false;
    stats.lowered |= MVS_LOWERED_LINEAR;
  }
  rows.swap(solution_);
  return true;
}

// Begins the next factor, or does a part of it.
void StepSolver::work_ahead(const StepMatrix &matrix, const PreconditionerKey &here,
                            const std::vector<Vec3> &x, State &state, uint32_t &left,
                            SolveStats &stats) {
  if (state.coming.x.empty()) {
    stats.skipped |= MVS_SKIPPED_FACTOR;
    if (iterations_ <= many_iterations && state.serving.age <= oldest) return;
    state.coming = with_place(here, x);
    take(matrix, state.coming, *coming_, stats.work);
  } else if (left > closing) {
    const PhaseTimer timer(stats.work, MVS_PHASE_FACTOR);
    --left;
    if (!coming_->factorise_part(state.coming.age)) {
      state.coming = {};
    } else if (++state.coming.age == CachedPreconditioner::parts) {
      ++stats.factorisations;
    }
  }
}

// False where the budget ends before.
bool StepSolver::factorise_here(const StepMatrix &matrix, const PreconditionerKey &here,
                                const std::vector<Vec3> &x, State &state, std::vector<Vec3> &rows,
                                uint32_t &left, SolveStats &stats) {
  state.drop_cache();
  if (left <= closing) return false;
  guess_.clear();  // a factor of this very matrix needs none
  const PreconditionerKey place = with_place(here, x);
  --left;  // of any solver, whether its factor is ready or not
  bool positive = serving_->is_of(place, CachedPreconditioner::parts);
  if (!positive) {
    take(matrix, place, *serving_, stats.work);
    const PhaseTimer timer(stats.work, MVS_PHASE_FACTOR);
    ++stats.factorisations;
    positive = serving_->factorise();
  }
  if (positive && (left == closing || iterate(matrix, rows, left, stats))) {
    if (left == closing) solve_with(*serving_, rows, stats);
    state.serving = place;
    return true;
  }
  return solve_exactly(matrix, place, rows, left, stats);
}

// In double precision where single does not do, and with more mass where the pressure makes the
// matrix indefinite: a smaller step in disguise. This factor serves no other step.
bool StepSolver::solve_exactly(const StepMatrix &matrix, const PreconditionerKey &place,
                               std::vector<Vec3> &rows, uint32_t &left, SolveStats &stats) {
  take(matrix, place, exact_, stats.work);
  double times = 1;
  while (left > closing && times < 1e18) {
    --left;
    ++stats.factorisations;
    bool positive = false;
    {
      const PhaseTimer timer(stats.work, MVS_PHASE_FACTOR);
      positive = exact_.factorise();
    }
    if (positive) {
      solve_with(exact_, rows, stats);
      return true;
    }
    if (times == 1) ++stats.shifted;
    exact_.add_mass(matrix, 3 * times);
    times *= 4;
  }
  return false;
}

void StepSolver::solve_with(CachedPreconditioner &factor, std::vector<Vec3> &rows,
                            SolveStats &stats) {
  const PhaseTimer timer(stats.work, MVS_PHASE_SOLVE);
  factor.solve(rows, solution_);
  rows.swap(solution_);
}

PreconditionerKey StepSolver::with_place(const PreconditionerKey &here,
                                         const std::vector<Vec3> &x) {
  PreconditionerKey place = here;
  auto free = std::find_if(places_.begin(), places_.end(),
                           [](const CowVector<Vec3> &p) { return p.is_alone(); });
  // snapshots that somebody holds keep their memory
  if (free == places_.end()) *(free = places_.begin()) = {};
  free->edit() = x;
  place.x = *free;
  return place;
}

}  // namespace mvs::core
