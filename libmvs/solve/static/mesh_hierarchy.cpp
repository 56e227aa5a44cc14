// Nested iteration: coarsens down to the coarsest mesh, then settles each level from the shape of
// the coarser one.
#include "solve/static/mesh_hierarchy.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "anatomy/family_level.h"
#include "base/error.h"
#include "geometry/intersect.h"
#include "model/law.h"
#include "solve/hierarchy_settings.h"
#include "solve/nodes.h"
#include "solve/settings.h"
#include "solve/static/newton.h"
#include "solve/static/untangle.h"

namespace mvs::core {
namespace {

const settings::mesh_hierarchy::Extent &extent_for(const Model &model) {
  return has_bilinear_tissue(model) ? settings::mesh_hierarchy::bilinear
                                    : settings::mesh_hierarchy::other_laws;
}

// A mesh of the hierarchy.
struct Level {
  const Model *model;
  std::shared_ptr<const Coarsened> made;  // from the next finer level; null at the finest
  ModelPtr surrogate;                     // of the finest level; null on all others
  State state;
  SolveOptions options;
  Progress progress;  // of this level and all coarser ones
  bool has_coarser = false;
};

// Whether the level may have a coarser one if it is far from rest.
bool may_coarsen(const Level &level) {
  return level.options.solver <= SolverKind::newton &&
         sheet_vertices(*level.model) >= extent_for(*level.model).min_vertices &&
         level.state.tools.empty();
}

Progress part_of(const Progress &whole, double from, double to) {
  if (!whole) return {};
  return [whole, from, to](double share, double residual) {
    return whole(from + (to - from) * share, residual);
  };
}

// Prot's law is left out: it closed in half the time, but four of five valves to shapes of higher
// energy (hierarchy_settings.h).
bool has_surrogate(const Leaflet &leaflet) {
  return leaflet.law == LeafletLawId::fung || leaflet.law == LeafletLawId::may_newman_yin;
}

// Options of a level that is left at so many rest forces.
SolveOptions rough(SolveOptions options, double rest_forces, const Model &model, const Load &load) {
  options.residual =
      std::max(options.residual, rest_forces * std::abs(load.pressure) * mean_area(model));
  options.max_iterations = settings::mesh_hierarchy::max_coarse_iterations;
  options.checks_stability = false;
  return options;
}

bool has_tissue_with_surrogate(const Model &model) {
  const auto &leaflets = model.valve.leaflets;
  return std::any_of(leaflets.begin(), leaflets.end(), has_surrogate);
}

// The same mesh with the bilinear membrane. Slack tissue has nearly no stiffness under an
// exponential law, so that the valve creeps towards its fold; with the bilinear law it takes few
// steps.
ModelPtr make_surrogate(const Model &fine) {
  const LeafletLaw &bilinear = *find_leaflet_law(LeafletLawId::bilinear);
  Valve valve = fine.valve;
  for (Leaflet &leaflet : valve.leaflets) {
    if (!has_surrogate(leaflet)) continue;
    leaflet.law = bilinear.id;
    leaflet.constants = default_constants(bilinear.constants);
  }
  return make_model(std::move(valve), &fine);
}

// The level before the finest one where tissue has an exponential law; it is left at so many rest
// forces.
Level surrogate_of(const Level &fine, double rest_forces, CoarseLevels &kept) {
  namespace set = settings::mesh_hierarchy;
  const ModelPtr model = kept.surrogate(*fine.model);
  const SolveOptions options = rough(fine.options, rest_forces, *model, fine.state.load);
  return Level{model.get(), nullptr, model,
               fine.state,  options, part_of(fine.progress, 0, set::coarse_progress)};
}

// Returns the next coarser level; empty where the valve cannot have so few vertices or its coarse
// mesh intersects itself.
std::optional<Level> coarser(const Level &fine, CoarseLevels &kept) {
  namespace set = settings::mesh_hierarchy;
  try {
    const size_t vertices = sheet_vertices(*fine.model) / set::coarsening;
    const std::shared_ptr<const Coarsened> made = kept.coarsened(
        *fine.model, std::max(vertices, extent_for(*fine.model).min_coarse_vertices));
    State state = to_coarse(made->map, fine.state);
    if (!find_intersections(state.x, made->model->valve.triangles).empty()) return {};
    const SolveOptions options =
        rough(fine.options, extent_for(*made->model).coarse_residual, *made->model, state.load);
    return Level{made->model.get(), made,    nullptr,
                 std::move(state),  options, part_of(fine.progress, 0, set::coarse_progress)};
  } catch (const Error &error) {
    if (error.code != MVS_E_ARGUMENT && error.code != MVS_E_OP) throw;
    return {};
  }
}

// Starts a level from the shape of the settled coarser one, unless it intersects itself there and
// cannot be untangled. Counts untangled crossings and a discarded shape in the statistics of the
// coarser levels.
void start_from(const Level &coarse, Level &fine, SolveStats &spent) {
  if (coarse.surrogate) {
    fine.state.x = coarse.state.x;
    return;
  }
  const LevelMap &map = coarse.made->map;
  State start = to_fine(map, *coarse.model, *fine.model, coarse.state);
  const Untangled done = untangle(map, coarse.state.x, *fine.model, start.x.edit());
  spent.untangled += static_cast<uint32_t>(done.found - done.left);
  if (done.left > 0) {
    ++spent.discarded;
    return;
  }
  start.time = fine.state.time;
  start.steps = fine.state.steps;
  start.load = fine.state.load;
  fine.state = std::move(start);
}

}  // namespace

std::shared_ptr<const Coarsened> CoarseLevels::coarsened(const Model &fine, size_t vertices) {
  for (const Kept &kept : kept_) {
    if (kept.serial == fine.serial && kept.vertices == vertices) return kept.made;
  }
  auto made = coarsen_in_family(fine, vertices);
  // a closure of the largest valve has five levels
  if (kept_.size() == 5) kept_.erase(kept_.begin());
  kept_.push_back({fine.serial, vertices, made});
  return made;
}

ModelPtr CoarseLevels::surrogate(const Model &fine) {
  if (!surrogate_ || surrogate_of_ != fine.serial) surrogate_ = make_surrogate(fine);
  surrogate_of_ = fine.serial;
  return surrogate_;
}

namespace {

class HierarchySettling final : public Settling {
 public:
  HierarchySettling(Solver &solver, const Model &model, const State &state,
                    const SolveOptions &options, const Progress &progress)
      : solver_(&solver) {
    levels_.push_back({&model, nullptr, nullptr, state, options, progress});
    if (has_tissue_with_surrogate(model)) {
      namespace set = settings::mesh_hierarchy;
      double left_at = 0;
      if (!begin_near_rest()) {
        left_at = set::surrogate_residual;
      } else if (is_overstretched()) {
        running_.reset();
        left_at = set::overstretched_residual;
      }
      if (left_at > 0) {
        levels_.back().has_coarser = true;
        levels_.push_back(surrogate_of(levels_.back(), left_at, solver.coarse_levels()));
      }
    }
    while (!begin_near_rest()) {
      std::optional<Level> next = coarser(levels_.back(), solver.coarse_levels());
      if (!next) break;
      levels_.back().has_coarser = true;
      levels_.push_back(std::move(*next));
    }
    begin_level();
  }

  bool advance() override {
    if (running_->advance()) return true;
    if (levels_.size() == 1) return false;
    Level coarse = std::move(levels_.back());
    levels_.pop_back();
    spent_ = finish_level(coarse);
    running_.reset();
    start_from(coarse, levels_.back(), spent_);
    begin_level();
    return true;
  }

  SolveStats finish(State &state) override {
    const SolveStats stats = finish_level(levels_.front());
    state = std::move(levels_.front().state);
    return stats;
  }

 private:
  // Begins the settle of the last level, which evaluates its forces, unless the level is far from
  // rest and a coarser one may begin instead: false then.
  bool begin_near_rest() {
    if (running_) return true;
    const Level &level = levels_.back();
    if (!may_coarsen(level)) {
      begin_level();
      return true;
    }
    if (!boundary_is_there(*level.model, level.state.x, level.state.load.boundary_fraction,
                           settings::boundary::near_distance)) {
      return false;
    }
    try {
      begin_level();
    } catch (const Error &error) {
      // a coarser level may lead away from positions without finite forces
      if (error.code != MVS_E_DIVERGED || !far_from_rest(*level.model, level.state)) throw;
      return false;
    }
    if (!running_->begins_far_from_rest()) return true;
    running_.reset();
    return false;
  }

  // Whether the settle that has begun has tissue stretched so far that its exponential law makes
  // huge forces: Newton's method follows them in tiny steps.
  bool is_overstretched() const {
    const Level &level = levels_.back();
    if (level.options.solver > SolverKind::newton || !level.state.tools.empty()) return false;
    const double rest_force = scale_of(level.state.load) * mean_area(*level.model);
    return running_->largest_first_force() > settings::mesh_hierarchy::overstretched * rest_force;
  }

  void begin_level() {
    if (running_) return;
    const Level &level = levels_.back();
    const double before = level.has_coarser ? settings::mesh_hierarchy::coarse_progress : 0;
    running_ = solver_->begin_settle(*level.model, level.state, level.options,
                                     part_of(level.progress, before, 1));
  }

  // Returns the statistics of this level and all coarser ones.
  SolveStats finish_level(Level &level) {
    SolveStats stats = running_->finish(level.state);
    const uint32_t iterations = stats.iterations;
    if (level.has_coarser) stats.add(spent_);
    stats.iterations = iterations;
    return stats;
  }

  Solver *solver_;
  std::vector<Level> levels_;          // the finest first; the last one is being settled
  std::unique_ptr<Settling> running_;  // of the last level; null until it has begun
  SolveStats spent_;                   // of the coarser levels
};

}  // namespace

std::unique_ptr<Settling> begin_settle_with_mesh_hierarchy(Solver &solver, const Model &model,
                                                           const State &state,
                                                           const SolveOptions &options,
                                                           const Progress &progress) {
  return std::make_unique<HierarchySettling>(solver, model, state, options, progress);
}

SolveStats settle_with_mesh_hierarchy(Solver &solver, const Model &model, State &state,
                                      const SolveOptions &options, const Progress &progress) {
  return run(*begin_settle_with_mesh_hierarchy(solver, model, state, options, progress), state);
}

}  // namespace mvs::core
