// The cascade: one coarser mesh, which has its own turn.
#include "solve/static/mesh_hierarchy.h"

#include <mvs/sim.h>

#include <algorithm>
#include <optional>

#include "anatomy/coarsen.h"
#include "base/error.h"
#include "geometry/intersect.h"
#include "solve/nodes.h"

namespace mvs::core {
namespace {

// A quarter of the vertices have edges twice as long: an eighth of the work or less.
constexpr size_t fewer = 4;
constexpr size_t fewest = 425;
// The coarse shape is a start, so its forces need not be smaller than this share of the pressure's
// force on a mean node; nor is it worth more iterations than a valve mostly takes.
constexpr double coarse_rest = 0.25;
constexpr uint32_t coarse_iterations = 200;
// Share of the time that the coarse meshes take, for progress: about what they do.
constexpr double coarse_share = 0.25;

size_t sheet_vertices(const Model &model) {
  return static_cast<size_t>(std::count_if(model.vertex_area.begin(), model.vertex_area.end(),
                                           [](double area) { return area > 0; }));
}

double coarse_residual(const Model &coarse, const Load &load) {
  return coarse_rest * std::abs(load.pressure) * mean_area(coarse);
}

// A coarser mesh of the valve and its state there; nothing where there is none that could do.
struct Level {
  ModelPtr model;
  State state;
};
std::optional<Level> coarser(const Model &model, const State &state, size_t vertices) {
  try {
    Coarsened made = coarsen(model, std::max(vertices / fewer, fewest));
    Level level{std::move(made.model), to_coarse(made.map, state)};
    if (!find_intersections(level.state.x, level.model->valve.triangles).empty()) return {};
    return level;
  } catch (const Error &error) {
    // a valve that cannot have so few vertices is closed as it is
    if (error.code != MVS_E_ARGUMENT && error.code != MVS_E_OP) throw;
    return {};
  }
}

// The state that the coarser mesh closes to, on this mesh; nothing where it crosses itself.
std::optional<State> start_from(Solver &solver, Level &level, const Model &model,
                                const State &state, const SolveOptions &options,
                                const Progress &progress, SolveStats &spent) {
  SolveOptions coarse = options;
  coarse.residual = std::max(options.residual, coarse_residual(*level.model, state.load));
  coarse.max_iterations = coarse_iterations;
  const auto tell = [&](double share, double residual) {
    return progress(coarse_share * share, residual);
  };
  spent = settle_with_mesh_hierarchy(solver, *level.model, level.state, coarse,
                                     progress ? Progress(tell) : Progress());
  State start = transferred(*level.model, level.state, model);
  if (!find_intersections(start.x, model.valve.triangles).empty()) return {};
  start.time = state.time;
  start.steps = state.steps;
  start.load = state.load;
  return start;
}

}  // namespace

SolveStats settle_with_mesh_hierarchy(Solver &solver, const Model &model, State &state,
                                      const SolveOptions &options, const Progress &progress) {
  const size_t vertices = sheet_vertices(model);
  SolveStats spent;
  Progress remaining = progress;
  if (options.solver <= MVS_SOLVER_NEWTON && vertices >= hierarchy_vertices &&
      state.tools.empty() && far_from_rest(model, state)) {
    if (std::optional<Level> level = coarser(model, state, vertices)) {
      if (auto start = start_from(solver, *level, model, state, options, progress, spent)) {
        state = std::move(*start);
      }
      remaining = [&](double share, double residual) {
        return !progress || progress(coarse_share + (1 - coarse_share) * share, residual);
      };
    }
  }
  SolveStats stats = solver.settle(model, state, options, remaining);
  const uint32_t iterations = stats.iterations;
  stats.add(spent);
  stats.iterations = iterations;
  return stats;
}

}  // namespace mvs::core
