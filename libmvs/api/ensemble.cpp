// Closing a valve along several paths: run, keep, show.
#include <mvs/ensemble.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "api/solve.h"
#include "api/structs.h"
#include "ensemble/loading_path.h"
#include "ensemble/measure_statistics.h"
#include "ensemble/shape_distances.h"
#include "session/recorded_event.h"
#include "session/simulator.h"

using namespace mvs::core;

struct mvs_ensemble {
  std::vector<SnapshotPtr> snapshots;
  std::vector<mvs_ensemble_member> paths;
  std::vector<mvs_stats> stats;
  mvs_ensemble_summary summary = {};
  std::vector<double> pairs,
      nodes;  // MVS_ENSEMBLE_ARRAY_PAIR_DISTANCE, MVS_ENSEMBLE_ARRAY_NODE_DEVIATION
  Lazy<Statistics> statistics;
};

namespace {

constexpr uint32_t most_paths = 1000;

mvs_ensemble_options read_options(const mvs_ensemble_options *given) {
  mvs_ensemble_options options = read_struct_or_default(given, "options");
  MVS_MUST(options.paths <= most_paths, MVS_E_ARGUMENT, "options.paths",
           "options.paths is %u: it has to be 0 (the default, 8) or 1 to %u", options.paths,
           most_paths);
  MVS_MUST(options.from <= MVS_ENSEMBLE_START_SNAPSHOT, MVS_E_ARGUMENT, "options.from",
           "options.from is %u: it has to be one of MVS_ENSEMBLE_START_*, or 0", options.from);
  MVS_MUST(options.backend <= MVS_BACKEND_BLOCK, MVS_E_ARGUMENT, "options.backend",
           "options.backend is %u: it has to be one of MVS_BACKEND_*", options.backend);
  MVS_MUST(
      options.perturbation <= 5e-3, MVS_E_ARGUMENT, "options.perturbation",
      "options.perturbation is %g m: it has to be 0 (the default), negative (none), or at most "
      "0.005",
      options.perturbation);
  must_be_in(options.wavelength, 1e-4, 1, "options.wavelength");
  must_be_in(options.same, 0, 1, "options.same");
  if (options.paths == 0) options.paths = 8;
  if (options.from == 0) options.from = MVS_ENSEMBLE_START_REST;
  if (options.perturbation == 0) options.perturbation = 0.5e-3;
  if (options.wavelength == 0) options.wavelength = 5e-3;
  if (options.same == 0) options.same = 0.1e-3;
  return options;
}

// What all paths have in common.
struct Task {
  const mvs_snapshot &start;
  Load load;
  SolveOptions solve;
  mvs_ensemble_options options;
};

// The progress of one path within that of all.
Progress progress_of(const mvs_ensemble_options &options, uint32_t number) {
  if (!options.progress) return {};
  return [&options, number](double share, double residual) {
    return options.progress(options.user, (number + share) / options.paths, residual) == 0;
  };
}

// Path 0 goes on with the history of the start, as after mvs_set_load and mvs_settle; no plan leads
// to the others.
SnapshotPtr snapshot_of(const Task &task, State state, bool plain) {
  if (plain) {
    State loaded = task.start.state;
    loaded.load = task.load;
    const Snapshot before = after_move(task.start.value, loaded, move_of(task.load));
    return make_snapshot(
        after_move(before, std::move(state), move_of(RecordedEvent::settle, task.solve)));
  }
  share(state, task.start.state);
  return make_snapshot({{task.start.model, std::move(state)}, {}});
}

void close_path(const Task &task, uint32_t number, Solver &solver, mvs_ensemble &spread) {
  const Model &model = *task.start.model;
  const mvs_ensemble_options &options = task.options;
  const bool plain = number == 0, from_start = plain || options.from == MVS_ENSEMBLE_START_SNAPSHOT;
  const Path path =
      make_path(number, {std::max(options.perturbation, 0.0), options.wavelength}, options.seed);
  Closing closing = close_along(solver, model, from_start ? task.start.state : initial_state(model),
                                task.load, task.solve, path, progress_of(options, number));
  mvs_ensemble_member &told = spread.paths[number];
  told.struct_size = sizeof told;
  told.converged = closing.stats.converged ? 1 : 0;
  told.increments = path.increments;
  told.order = path.order;
  told.diverged = closing.diverged ? 1 : 0;
  told.perturbation = closing.moved;
  told.ramp = path.ramp;
  spread.stats[number] = public_stats(closing.stats);
  spread.snapshots[number] = snapshot_of(task, std::move(closing.state), plain);
}

const Shape &shape(const mvs_ensemble &spread, size_t path) {
  return spread.snapshots[path]->state.x.get();
}

// Node to node, every path with every other, and the equilibria among them.
void compare_nodes(const Model &model, double same, mvs_ensemble &spread) {
  const size_t size = spread.paths.size();
  std::vector<uint8_t> at_rest(size);
  std::vector<const Shape *> shapes;
  for (size_t k = 0; k < size; ++k) {
    at_rest[k] = spread.paths[k].converged != 0;
    if (at_rest[k]) shapes.push_back(&shape(spread, k));
  }
  std::vector<double> farthest(size * size, 0);
  double squares = 0, pairs = 0;
  for (size_t a = 0; a < size; ++a) {
    for (size_t b = a + 1; b < size; ++b) {
      const Apart apart = nodes_apart(model, shape(spread, a), shape(spread, b));
      spread.pairs[a * size + b] = spread.pairs[b * size + a] = apart.rms;
      farthest[a * size + b] = farthest[b * size + a] = apart.max;
      if (a == 0) spread.paths[b].node_rms = apart.rms;
      if (a == 0) spread.paths[b].node_max = apart.max;
      if (!at_rest[a] || !at_rest[b]) continue;
      squares += apart.rms * apart.rms;
      ++pairs;
      spread.summary.node_max = std::max(spread.summary.node_max, apart.max);
    }
  }
  if (pairs > 0) spread.summary.node_rms = std::sqrt(squares / pairs);
  spread.nodes = node_deviation(model.node_count(), shapes);
  const std::vector<uint32_t> equilibrium = find_equilibria(farthest, at_rest, same);
  for (size_t k = 0; k < size; ++k) {
    spread.paths[k].equilibrium = equilibrium[k];
    if (at_rest[k]) {
      spread.summary.equilibria = std::max(spread.summary.equilibria, equilibrium[k] + 1);
    }
  }
}

// Surface distances from path 0.
void compare_surfaces(const Model &model, mvs_ensemble &spread) {
  double squares = 0, others = 0;
  for (size_t k = 1; k < spread.paths.size(); ++k) {
    mvs_ensemble_member &path = spread.paths[k];
    const Comparison found = compare_shapes(model, shape(spread, 0), model, shape(spread, k));
    path.surface_rms = found.surface_rms;
    path.surface_max = found.surface_max;
    if (!path.converged || !spread.paths[0].converged) continue;
    squares += found.surface_rms * found.surface_rms;
    ++others;
    spread.summary.surface_max = std::max(spread.summary.surface_max, found.surface_max);
  }
  if (others > 0) spread.summary.surface_rms = std::sqrt(squares / others);
}

void summarise(mvs_ensemble &spread) {
  mvs_ensemble_summary &summary = spread.summary;
  summary.struct_size = sizeof summary;
  summary.paths = static_cast<uint32_t>(spread.paths.size());
  summary.lowest = none;
  for (uint32_t k = 0; k < summary.paths; ++k) {
    if (!spread.paths[k].converged) continue;
    ++summary.converged;
    const bool lower =
        summary.lowest == none || spread.stats[k].energy < spread.stats[summary.lowest].energy;
    if (lower) summary.lowest = k;
  }
}

std::unique_ptr<mvs_ensemble> run(const Task &task) {
  auto spread = std::make_unique<mvs_ensemble>();
  const uint32_t size = task.options.paths;
  spread->snapshots.resize(size);
  spread->paths.resize(size);
  spread->stats.resize(size);
  spread->pairs.assign(size_t{size} * size, 0);
  Solver solver(task.options.backend);
  for (uint32_t k = 0; k < size; ++k) close_path(task, k, solver, *spread);
  compare_nodes(*task.start.model, task.options.same, *spread);
  compare_surfaces(*task.start.model, *spread);
  summarise(*spread);
  return spread;
}

void must_have_path(const mvs_ensemble *spread, uint32_t path) {
  must_point(spread, "spread");
  MVS_MUST(path < spread->paths.size(), MVS_E_ARGUMENT, "path",
           "path is %u: the spread has paths 0 to %zu", path, spread->paths.size() - 1);
}

Statistics make_statistics(const mvs_ensemble &spread) {
  std::vector<const mvs_measures *> measures;
  for (size_t k = 0; k < spread.paths.size(); ++k) {
    if (spread.paths[k].converged) measures.push_back(&spread.snapshots[k]->measures());
  }
  return statistics_of(measures);
}

}  // namespace

extern "C" {

mvs_result mvs_ensemble_run(const mvs_snapshot *start, const mvs_load_case *load,
                            const mvs_settle_options *settle, const mvs_ensemble_options *options,
                            mvs_ensemble **spread) {
  return guarded([&] {
    must_point(start, "start");
    must_point(spread, "spread");
    const Task task{*start, read_load(load), mvs::core::read_options(settle),
                    read_options(options)};
    *spread = run(task).release();
  });
}

void mvs_ensemble_release(mvs_ensemble *spread) {
  delete spread;
}

mvs_result mvs_ensemble_get_summary(const mvs_ensemble *spread, mvs_ensemble_summary *summary) {
  return guarded([&] {
    must_point(spread, "spread");
    write_struct(summary, spread->summary, "summary");
  });
}

mvs_result mvs_ensemble_get_member(const mvs_ensemble *spread, uint32_t path,
                                   mvs_ensemble_member *found) {
  return guarded([&] {
    must_have_path(spread, path);
    write_struct(found, spread->paths[path], "found");
  });
}

mvs_result mvs_ensemble_get_member_stats(const mvs_ensemble *spread, uint32_t path,
                                         mvs_stats *stats) {
  return guarded([&] {
    must_have_path(spread, path);
    write_struct(stats, spread->stats[path], "stats");
  });
}

mvs_result mvs_ensemble_get_member_snapshot(const mvs_ensemble *spread, uint32_t path,
                                            const mvs_snapshot **snapshot) {
  return guarded([&] {
    must_have_path(spread, path);
    must_point(snapshot, "snapshot");
    *snapshot = SnapshotPtr(spread->snapshots[path]).release();
  });
}

mvs_result mvs_ensemble_measure(const mvs_ensemble *spread, uint32_t statistic,
                                mvs_measures *measures) {
  return guarded([&] {
    must_point(spread, "spread");
    MVS_MUST(statistic >= MVS_ENSEMBLE_STATISTIC_MEAN && statistic <= MVS_ENSEMBLE_STATISTIC_COUNT,
             MVS_E_ARGUMENT, "statistic",
             "statistic is %u: it has to be one of MVS_ENSEMBLE_STATISTIC_MEAN ... "
             "MVS_ENSEMBLE_STATISTIC_COUNT",
             statistic);
    checked_struct_size(measures, "measures");
    const Statistics &found = spread->statistics.get([&] { return make_statistics(*spread); });
    write_struct(measures, found[statistic - 1], "measures");
  });
}

mvs_result mvs_ensemble_get_array(const mvs_ensemble *spread, uint32_t which, mvs_view *view) {
  return guarded([&] {
    must_point(spread, "spread");
    must_point(view, "view");
    MVS_MUST(
        which == MVS_ENSEMBLE_ARRAY_NODE_DEVIATION || which == MVS_ENSEMBLE_ARRAY_PAIR_DISTANCE,
        MVS_E_ARGUMENT, "which",
        "which is %u: it has to be MVS_ENSEMBLE_ARRAY_NODE_DEVIATION or "
        "MVS_ENSEMBLE_ARRAY_PAIR_DISTANCE",
        which);
    const bool nodes = which == MVS_ENSEMBLE_ARRAY_NODE_DEVIATION;
    const auto columns = nodes ? 1 : static_cast<uint32_t>(spread->paths.size());
    const std::vector<double> &values = nodes ? spread->nodes : spread->pairs;
    *view = {values.data(), values.size() / columns, columns, MVS_TYPE_F64,
             columns * sizeof(double)};
  });
}

}  // extern "C"
