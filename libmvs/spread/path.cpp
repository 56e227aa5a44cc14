#include "spread/path.h"

#include <mvs/spread.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace mvs {
namespace {

// Between increments the valve need not be at rest to the last digit: a tenth of the pressure's
// force on a node of mean area, within as many iterations as a closure takes at most.
constexpr double between_residual = 0.1;
constexpr uint32_t between_iterations = 100;

std::vector<Load> stages_of(const Path &path, const Load &from, const Load &to) {
  std::vector<Load> stages;
  const bool together = path.order == MVS_SPREAD_TOGETHER;
  const bool first = path.order == MVS_SPREAD_BOUNDARY_FIRST;
  const bool moves = from.boundary_fraction != to.boundary_fraction;
  if (first && moves) stages.push_back({from.pressure, to.boundary_fraction});
  for (uint32_t k = 1; k <= path.increments; ++k) {
    const double share = static_cast<double>(k) / path.increments;
    const double travelled =
        from.boundary_fraction + share * (to.boundary_fraction - from.boundary_fraction);
    const double held = first ? to.boundary_fraction : from.boundary_fraction;
    stages.push_back(
        {from.pressure + share * (to.pressure - from.pressure), together ? travelled : held});
  }
  // the last one is the load itself, to the bit
  if (path.order == MVS_SPREAD_PRESSURE_FIRST && moves) {
    stages.push_back(to);
  } else {
    stages.back() = to;
  }
  return stages;
}

double force_between(const Model &model, const Load &load) {
  double area = 0;
  for (const double a : model.rest_area) area += a;
  return between_residual * std::abs(load.pressure) * area /
         static_cast<double>(model.node_count());
}

void add_counts(const SolveStats &before, SolveStats &to) {
  to.iterations += before.iterations;
  to.factorisations += before.factorisations;
  to.shifted += before.shifted;
  to.wall_s += before.wall_s;
  for (size_t k = 0; k < to.phase_s.size(); ++k) to.phase_s[k] += before.phase_s[k];
}

void must_be_finite(const std::vector<Vec3> &x) {
  const auto finite = [](const Vec3 &p) { return p.allFinite(); };
  MVS_MUST(std::all_of(x.begin(), x.end(), finite), MVS_E_DIVERGED, "nodes",
           "a node left the range of numbers: take a smaller time step or load");
}

void settle_stages(Solver &solver, const Model &model, const std::vector<Load> &stages,
                   const SolveOptions &options, const Progress &progress, Closing &closing) {
  SolveOptions between = options;
  between.residual = std::max(options.residual, force_between(model, stages.back()));
  between.max_iterations =
      options.solver <= MVS_SOLVER_NEWTON ? between_iterations : options.max_iterations;
  for (size_t k = 0; k < stages.size(); ++k) {
    const auto count = static_cast<double>(stages.size());
    const auto tell = [&](double share, double residual) {
      return progress((static_cast<double>(k) + share) / count, residual);
    };
    const bool last = k + 1 == stages.size();
    closing.state.load = stages[k];
    const SolveStats before = closing.stats;
    closing.stats = solver.settle(model, closing.state, last ? options : between,
                                  progress ? Progress(tell) : Progress());
    add_counts(before, closing.stats);
  }
}

}  // namespace

Path make_path(uint32_t number, const Disturbance &disturbance, uint64_t seed) {
  // 4 and 3 have no common factor: twelve combinations before one comes back
  static constexpr uint32_t increments[] = {1, 4, 2, 8};
  static constexpr uint32_t orders[] = {MVS_SPREAD_TOGETHER, MVS_SPREAD_BOUNDARY_FIRST,
                                        MVS_SPREAD_PRESSURE_FIRST};
  Path path;
  path.plain = number == 0;
  path.increments = increments[number % 4];
  path.order = orders[number % 3];
  if (!path.plain) path.disturbance = disturbance;
  path.random = Random(seed, number);
  return path;
}

Closing close_along(Solver &solver, const Model &model, const State &start, const Load &load,
                    const SolveOptions &options, const Path &path, const Progress &progress) {
  Closing closing;
  State begun = start;
  if (path.disturbance.longest > 0) {
    closing.moved = disturb(model, begun.x.edit(), path.disturbance, path.random);
  }
  closing.state = begun;
  try {
    settle_stages(solver, model, stages_of(path, start.load, load), options, progress, closing);
    must_be_finite(closing.state.x);
  } catch (const Error &error) {
    if (error.code != MVS_E_DIVERGED || path.plain) throw;
    closing.diverged = true;
    closing.state = begun;
    closing.stats.converged = false;
  }
  return closing;
}

}  // namespace mvs
