#include "solve/dynamic/step_solver.h"

#include <algorithm>

#include "linalg/cholesky.h"
#include "solve/tools/tool_points.h"

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

// The first buffer that is shared with nobody, or else a new one: states and factors that hold the
// others keep their memory.
template <typename Item, size_t count>
CowVector<Item> &free_buffer(std::array<CowVector<Item>, count> &buffers) {
  auto free = std::find_if(buffers.begin(), buffers.end(),
                           [](const CowVector<Item> &buffer) { return buffer.is_alone(); });
  if (free == buffers.end()) *(free = buffers.begin()) = {};
  return *free;
}

}  // namespace

StepSolver::StepSolver(const Model &model, const TotalEnergy &total_energy, uint32_t backend)
    : model_(&model),
      total_energy_(&total_energy),
      first_(model, make_preconditioner(backend)),
      second_(model, make_preconditioner(backend)),
      exact_(model, make_direct_solver(backend)) {
  // other backends do best with the order that each matrix of its own gives
  if (is_our_own(backend)) order_.emplace(model, total_energy.pairs());
}

void StepSolver::resume(State &state, const StepOptions &how, StepMatrix &matrix,
                        const Look &look) {
  load_keys(state);
  const auto fits = [&](const PreconditionerKey &key) {
    return key.x.size() == state.x.size() && key.dt == how.dt && key.damping == how.damping;
  };
  if (!keys_.active.empty() && !fits(keys_.active)) drop_keys();
  if (!keys_.pending.empty() && !fits(keys_.pending)) set_keys({keys_.active, {}});
  make_factors(matrix, look);
  store_keys(state);
}

void StepSolver::make_factors(StepMatrix &matrix, const Look &look) {
  if (keys_.active.empty()) return;
  const uint32_t all = CachedPreconditioner::parts, some = keys_.pending.age;
  if (pending_->is_of(keys_.active, all)) std::swap(active_, pending_);
  if (!active_->is_of(keys_.active, all) && !remake(keys_.active, all, *active_, matrix, look)) {
    return drop_keys();
  }
  if (keys_.pending.empty() || pending_->is_of(keys_.pending, some)) return;
  if (!remake(keys_.pending, some, *pending_, matrix, look)) set_keys({keys_.active, {}});
}

void StepSolver::load_keys(const State &state) {
  const SolverCache &cache = state.cache;
  if (cache.version == packed_.version && cache.data.buffer() == packed_.data.buffer()) {
    unpack_ages(cache.counter, keys_);
  } else {
    keys_ = unpack(cache, *model_, state.x.size() - tool_points(state.tools));
  }
  packed_ = cache;
  is_packed_ = true;
}

void StepSolver::set_keys(PreconditionerKeys keys) {
  keys_ = std::move(keys);
  is_packed_ = false;
}

void StepSolver::store_keys(State &state) {
  if (!is_packed_) packed_ = pack(keys_, free_buffer(caches_));
  packed_.counter = packed_ages(keys_);
  is_packed_ = true;
  state.cache = packed_;
}

void StepSolver::make_ready(const StepMatrix &matrix, const PreconditionerKey &here,
                            const std::vector<Vec3> &x) {
  if (!keys_.active.empty()) return;
  Profile unseen{};
  const PreconditionerKey place = with_place(here, x);
  for (CachedPreconditioner *factor : {pending_, active_}) {
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
  if (keys_.pending.age == CachedPreconditioner::parts) {
    std::swap(active_, pending_);
    set_keys({keys_.pending, {}});
  }
  guess(matrix, here.dt, state.v);
  if (!keys_.active.empty() && iterate(matrix, rows, left, stats)) {
    ++keys_.active.age;
    work_ahead(matrix, here, x, left, stats);
  } else if (!factorise_here(matrix, here, x, rows, left, stats)) {
    stats.lowered |= MVS_LOWERED_LINEAR;
    matrix.divide(rows);
  }
  store_keys(state);
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
    active_->solve(r, z);
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
                            const std::vector<Vec3> &x, uint32_t &left, SolveStats &stats) {
  if (keys_.pending.empty()) {
    stats.skipped |= MVS_SKIPPED_FACTOR;
    if (iterations_ <= many_iterations && keys_.active.age <= oldest) return;
    set_keys({keys_.active, with_place(here, x)});
    take(matrix, keys_.pending, *pending_, stats.work);
  } else if (left > closing) {
    const PhaseTimer timer(stats.work, MVS_PHASE_FACTOR);
    --left;
    if (!pending_->factorise_part(keys_.pending.age)) {
      set_keys({keys_.active, {}});
    } else if (++keys_.pending.age == CachedPreconditioner::parts) {
      ++stats.factorisations;
    }
  }
}

// False where the budget ends before.
bool StepSolver::factorise_here(const StepMatrix &matrix, const PreconditionerKey &here,
                                const std::vector<Vec3> &x, std::vector<Vec3> &rows, uint32_t &left,
                                SolveStats &stats) {
  drop_keys();
  if (left <= closing) return false;
  guess_.clear();  // a factor of this very matrix needs none
  const PreconditionerKey place = with_place(here, x);
  --left;  // of any solver, whether its factor is ready or not
  bool positive = active_->is_of(place, CachedPreconditioner::parts);
  if (!positive) {
    take(matrix, place, *active_, stats.work);
    const PhaseTimer timer(stats.work, MVS_PHASE_FACTOR);
    ++stats.factorisations;
    positive = active_->factorise();
  }
  if (positive && (left == closing || iterate(matrix, rows, left, stats))) {
    if (left == closing) solve_with(*active_, rows, stats);
    set_keys({place, {}});
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
  CowVector<Vec3> &free = free_buffer(places_);
  free.edit() = x;
  place.x = free;
  return place;
}

}  // namespace mvs::core
