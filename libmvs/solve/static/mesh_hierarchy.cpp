// Nested iteration: coarsens, settles the coarse mesh, transfers its shape, settles the fine mesh.
#include "solve/static/mesh_hierarchy.h"

#include <algorithm>
#include <optional>

#include "anatomy/coarsen.h"
#include "base/error.h"
#include "geometry/intersect.h"
#include "solve/nodes.h"
#include "solve/settings.h"

namespace mvs::core {
namespace {

size_t sheet_vertices(const Model &model) {
  return static_cast<size_t>(std::count_if(model.vertex_area.begin(), model.vertex_area.end(),
                                           [](double area) { return area > 0; }));
}

double coarse_residual(const Model &coarse, const Load &load) {
  return settings::mesh_hierarchy::coarse_residual * std::abs(load.pressure) * mean_area(coarse);
}

// A mesh of the hierarchy with its state.
struct Level {
  ModelPtr model;
  State state;
};
// Returns the next coarser level; empty where the valve cannot have so few vertices or its coarse
// mesh intersects itself.
std::optional<Level> coarser(const Model &model, const State &state, size_t vertices) {
  try {
    Coarsened made = coarsen(model, std::max(vertices / settings::mesh_hierarchy::coarsening,
                                             settings::mesh_hierarchy::min_coarse_vertices));
    Level level{std::move(made.model), to_coarse(made.map, state)};
    if (!find_intersections(level.state.x, level.model->valve.triangles).empty()) return {};
    return level;
  } catch (const Error &error) {
    if (error.code != MVS_E_ARGUMENT && error.code != MVS_E_OP) throw;
    return {};
  }
}

// Settles the coarse level and returns its shape on this mesh; empty where that intersects itself.
std::optional<State> start_from(Solver &solver, Level &level, const Model &model,
                                const State &state, const SolveOptions &options,
                                const Progress &progress, SolveStats &spent) {
  SolveOptions coarse = options;
  coarse.residual = std::max(options.residual, coarse_residual(*level.model, state.load));
  coarse.max_iterations = settings::mesh_hierarchy::max_coarse_iterations;
  const auto tell = [&](double share, double residual) {
    return progress(settings::mesh_hierarchy::coarse_progress * share, residual);
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
  if (options.solver <= SolverKind::newton && vertices >= settings::mesh_hierarchy::min_vertices &&
      state.tools.empty() && far_from_rest(model, state)) {
    if (std::optional<Level> level = coarser(model, state, vertices)) {
      if (auto start = start_from(solver, *level, model, state, options, progress, spent)) {
        state = std::move(*start);
      }
      remaining = [&](double share, double residual) {
        return !progress || progress(settings::mesh_hierarchy::coarse_progress +
                                         (1 - settings::mesh_hierarchy::coarse_progress) * share,
                                     residual);
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
