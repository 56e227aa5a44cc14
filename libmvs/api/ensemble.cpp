// Ensembles: runs the members, stores their results, returns their statistics.
#include <mvs/ensemble.h>

#include <memory>

#include "api/solve.h"
#include "api/structs.h"
#include "ensemble/loading_path.h"
#include "ensemble/measure_statistics.h"
#include "ensemble/member_distances.h"
#include "session/recorded_event.h"
#include "session/simulator.h"

using namespace mvs::core;

struct mvs_ensemble {
  std::vector<SnapshotPtr> snapshots;
  std::vector<mvs_ensemble_member> members;
  std::vector<SolveStats> stats;
  mvs_ensemble_summary summary = {};
  MemberDistances distances;
  Lazy<Statistics> statistics;
};

namespace {

constexpr uint32_t most_members = 1000;

mvs_ensemble_options read_options(const mvs_ensemble_options *given) {
  mvs_ensemble_options options = read_struct_or_default(given, "options");
  MVS_MUST(options.members <= most_members, MVS_E_ARGUMENT, "options.members",
           "options.members is %u: it has to be 0 (the default, 8) or 1 to %u", options.members,
           most_members);
  MVS_MUST(options.start <= MVS_ENSEMBLE_START_SNAPSHOT, MVS_E_ARGUMENT, "options.start",
           "options.start is %u: it has to be one of MVS_ENSEMBLE_START_*, or 0", options.start);
  must_be_backend(options.backend, "options.backend");
  MVS_MUST((options.flags & ~uint32_t{MVS_ENSEMBLE_FLAG_UNPERTURBED}) == 0, MVS_E_ARGUMENT,
           "options.flags", "options.flags is %u: it has bits that this version does not know",
           options.flags);
  must_be_zero(options.reserved, "options.reserved");
  must_be_in(options.perturbation, 0, 5e-3, "options.perturbation");
  const bool unperturbed = (options.flags & MVS_ENSEMBLE_FLAG_UNPERTURBED) != 0;
  MVS_MUST(!unperturbed || options.perturbation == 0, MVS_E_ARGUMENT, "options.perturbation",
           "options.perturbation is %g m: it has to be 0 with MVS_ENSEMBLE_FLAG_UNPERTURBED",
           options.perturbation);
  must_be_in(options.wavelength, 1e-4, 1, "options.wavelength");
  must_be_in(options.tolerance, 0, 1, "options.tolerance");
  if (options.members == 0) options.members = 8;
  if (options.start == 0) options.start = MVS_ENSEMBLE_START_REST;
  if (options.perturbation == 0 && !unperturbed) options.perturbation = 0.5e-3;
  if (options.wavelength == 0) options.wavelength = 5e-3;
  if (options.tolerance == 0) options.tolerance = 0.1e-3;
  return options;
}

// Input of all members.
struct Task {
  const mvs_snapshot &start;
  Load load;
  SolveOptions solve;
  mvs_ensemble_options options;
};

// Reports the progress of one member as a share of all members.
Progress progress_of(const mvs_ensemble_options &options, uint32_t number) {
  if (!options.progress) return {};
  return [&options, number](double share, double residual) {
    return options.progress(options.user, (number + share) / options.members, residual) == 0;
  };
}

// Returns the snapshot of a member. Member 0 (`plain`) continues the history of the start, as after
// mvs_set_load and mvs_settle. The others begin a history: no plan reproduces them.
SnapshotPtr snapshot_of(const Task &task, State state, bool plain) {
  if (plain) {
    return make_snapshot(after_settle(task.start.value, task.load, task.solve, std::move(state)));
  }
  share(state, task.start.state);
  return make_snapshot({{task.start.model, std::move(state)}, {}});
}

void close_member(const Task &task, uint32_t number, Solver &solver, mvs_ensemble &ensemble) {
  const Model &model = *task.start.model;
  const mvs_ensemble_options &options = task.options;
  const bool plain = number == 0,
             from_start = plain || options.start == MVS_ENSEMBLE_START_SNAPSHOT;
  const Path path = make_path(number, {options.perturbation, options.wavelength}, options.seed);
  Closing closing = close_along(solver, model, from_start ? task.start.state : initial_state(model),
                                task.load, task.solve, path, progress_of(options, number));
  mvs_ensemble_member &member = ensemble.members[number];
  member.struct_size = sizeof member;
  member.converged = closing.stats.converged ? 1 : 0;
  member.increments = path.increments;
  member.order = static_cast<uint32_t>(path.order);
  member.diverged = closing.diverged ? 1 : 0;
  member.perturbation = closing.moved;
  member.ramp = path.ramp;
  ensemble.stats[number] = closing.stats;
  ensemble.snapshots[number] = snapshot_of(task, std::move(closing.state), plain);
}

void compare_members(const Task &task, mvs_ensemble &ensemble) {
  std::vector<const std::vector<Vec3> *> shapes;
  std::vector<uint8_t> at_rest;
  for (size_t k = 0; k < ensemble.members.size(); ++k) {
    shapes.push_back(&ensemble.snapshots[k]->state.x.get());
    at_rest.push_back(ensemble.members[k].converged != 0);
  }
  ensemble.distances = member_distances(*task.start.model, shapes, at_rest, task.options.tolerance);
  for (size_t k = 0; k < ensemble.members.size(); ++k) {
    const MemberDistances::Row &row = ensemble.distances.rows[k];
    mvs_ensemble_member &member = ensemble.members[k];
    member.equilibrium = row.equilibrium;
    member.node_rms = row.node_rms;
    member.node_max = row.node_max;
    member.surface_rms = row.surface_rms;
    member.surface_max = row.surface_max;
  }
}

void summarise(mvs_ensemble &ensemble) {
  mvs_ensemble_summary &summary = ensemble.summary;
  summary.struct_size = sizeof summary;
  summary.members = static_cast<uint32_t>(ensemble.members.size());
  summary.equilibria = ensemble.distances.equilibria;
  summary.node_rms = ensemble.distances.node_rms;
  summary.node_max = ensemble.distances.node_max;
  summary.surface_rms = ensemble.distances.surface_rms;
  summary.surface_max = ensemble.distances.surface_max;
  summary.lowest = none;
  for (uint32_t k = 0; k < summary.members; ++k) {
    if (!ensemble.members[k].converged) continue;
    ++summary.converged;
    const bool lower =
        summary.lowest == none || ensemble.stats[k].energy < ensemble.stats[summary.lowest].energy;
    if (lower) summary.lowest = k;
  }
}

std::unique_ptr<mvs_ensemble> run(const Task &task) {
  auto ensemble = std::make_unique<mvs_ensemble>();
  const uint32_t size = task.options.members;
  ensemble->snapshots.resize(size);
  ensemble->members.resize(size);
  ensemble->stats.resize(size);
  Solver solver(static_cast<Backend>(task.options.backend));
  for (uint32_t k = 0; k < size; ++k) close_member(task, k, solver, *ensemble);
  compare_members(task, *ensemble);
  summarise(*ensemble);
  return ensemble;
}

void must_have_member(const mvs_ensemble *ensemble, uint32_t index) {
  must_point(ensemble, "ensemble");
  MVS_MUST(index < ensemble->members.size(), MVS_E_ARGUMENT, "index",
           "index is %u: the ensemble has members 0 to %zu", index, ensemble->members.size() - 1);
}

Statistics make_statistics(const mvs_ensemble &ensemble) {
  std::vector<const mvs_measures *> measures;
  for (size_t k = 0; k < ensemble.members.size(); ++k) {
    if (ensemble.members[k].converged) measures.push_back(&ensemble.snapshots[k]->measures());
  }
  return statistics_of(measures);
}

}  // namespace

extern "C" {

mvs_result mvs_ensemble_run(const mvs_snapshot *start, const mvs_load_case *load,
                            const mvs_settle_options *settle, const mvs_ensemble_options *options,
                            mvs_ensemble **ensemble) {
  return at_boundary([&] {
    must_point(start, "start");
    must_point(ensemble, "ensemble");
    const Task task{*start, read_load(load), mvs::core::read_options(settle),
                    read_options(options)};
    *ensemble = run(task).release();
  });
}

void mvs_ensemble_release(mvs_ensemble *ensemble) {
  delete ensemble;
}

mvs_result mvs_ensemble_get_summary(const mvs_ensemble *ensemble, mvs_ensemble_summary *summary) {
  return at_boundary([&] {
    must_point(ensemble, "ensemble");
    write_struct(summary, ensemble->summary, "summary");
  });
}

mvs_result mvs_ensemble_get_member(const mvs_ensemble *ensemble, uint32_t index,
                                   mvs_ensemble_member *member) {
  return at_boundary([&] {
    must_have_member(ensemble, index);
    write_struct(member, ensemble->members[index], "member");
  });
}

mvs_result mvs_ensemble_get_member_stats(const mvs_ensemble *ensemble, uint32_t index,
                                         mvs_stats *stats) {
  return at_boundary([&] {
    must_have_member(ensemble, index);
    write_struct(stats, public_stats(ensemble->stats[index]), "stats");
  });
}

mvs_result mvs_ensemble_get_member_profile(const mvs_ensemble *ensemble, uint32_t index,
                                           mvs_profile *profile) {
  return at_boundary([&] {
    must_have_member(ensemble, index);
    write_struct(profile, public_profile(ensemble->stats[index]), "profile");
  });
}

mvs_result mvs_ensemble_get_member_snapshot(const mvs_ensemble *ensemble, uint32_t index,
                                            const mvs_snapshot **snapshot) {
  return at_boundary([&] {
    must_have_member(ensemble, index);
    must_point(snapshot, "snapshot");
    *snapshot = SnapshotPtr(ensemble->snapshots[index]).release();
  });
}

mvs_result mvs_ensemble_measure(const mvs_ensemble *ensemble, mvs_ensemble_statistic statistic,
                                mvs_measures *measures) {
  return at_boundary([&] {
    must_point(ensemble, "ensemble");
    MVS_MUST(statistic >= MVS_ENSEMBLE_STATISTIC_MEAN && statistic <= MVS_ENSEMBLE_STATISTIC_COUNT,
             MVS_E_ARGUMENT, "statistic",
             "statistic is %u: it has to be one of MVS_ENSEMBLE_STATISTIC_MEAN ... "
             "MVS_ENSEMBLE_STATISTIC_COUNT",
             statistic);
    checked_struct_size(measures, "measures");
    const Statistics &found = ensemble->statistics.get([&] { return make_statistics(*ensemble); });
    write_struct(measures, found[statistic - 1], "measures");
  });
}

mvs_result mvs_ensemble_get_array(const mvs_ensemble *ensemble, mvs_ensemble_array which,
                                  mvs_view *view) {
  return at_boundary([&] {
    must_point(ensemble, "ensemble");
    must_point(view, "view");
    MVS_MUST(
        which == MVS_ENSEMBLE_ARRAY_NODE_DEVIATION || which == MVS_ENSEMBLE_ARRAY_PAIR_DISTANCE,
        MVS_E_ARGUMENT, "which",
        "which is %u: it has to be MVS_ENSEMBLE_ARRAY_NODE_DEVIATION or "
        "MVS_ENSEMBLE_ARRAY_PAIR_DISTANCE",
        which);
    const bool nodes = which == MVS_ENSEMBLE_ARRAY_NODE_DEVIATION;
    const auto columns = nodes ? 1 : static_cast<uint32_t>(ensemble->members.size());
    const std::vector<double> &values =
        nodes ? ensemble->distances.node_deviation : ensemble->distances.pair_rms;
    *view = {values.data(), values.size() / columns, columns, MVS_TYPE_F64,
             columns * sizeof(double)};
  });
}

}  // extern "C"
