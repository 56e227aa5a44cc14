// Sets the load, settles, steps in time, and returns the statistics of the solver.
#include "api/solve.h"

#include <cmath>

#include "api/sim_call.h"
#include "history/event_limits.h"
#include "session/recorded_event.h"
#include "session/simulator.h"
#include "session/slack_chordae.h"
#include "session/unit_warnings.h"
#include "solve/static/mesh_hierarchy.h"

namespace mvs::core {
Load read_load(const mvs_load_case *given) {
  const mvs_load_case load = read_struct(given, "load");
  must_be_zero(load.reserved, "load.reserved");
  MVS_MUST(std::abs(load.pressure) <= limits::pressure, MVS_E_ARGUMENT, "load.pressure",
           "load.pressure is %g Pa: it has to be within %g Pa; 120 mmHg are 15998.64 Pa",
           load.pressure, limits::pressure);
  MVS_MUST(load.boundary_fraction >= 0 && load.boundary_fraction <= 1, MVS_E_ARGUMENT,
           "load.boundary_fraction",
           "load.boundary_fraction is %g: it has to be 0 (open) to 1 (loaded)",
           load.boundary_fraction);
  return {load.pressure, load.boundary_fraction};
}

SolveOptions read_options(const mvs_settle_options *given) {
  const mvs_settle_options options = read_struct_or_default(given, "options");
  MVS_MUST((options.flags & ~MVS_SETTLE_NO_MARGINS) == 0, MVS_E_ARGUMENT, "options.flags",
           "options.flags is %#x: it has to be 0 or MVS_SETTLE_NO_MARGINS", options.flags);
  MVS_MUST(options.solver <= MVS_SOLVER_EXPLICIT, MVS_E_ARGUMENT, "options.solver",
           "options.solver is %u: it has to be one of MVS_SOLVER_*, or 0", options.solver);
  must_be_in(options.residual, limits::residual, "options.residual");
  must_be_in(options.dt, limits::dt, "options.dt");
  must_be_in(options.damping, limits::damping, "options.damping");
  SolveOptions how{static_cast<SolverKind>(options.solver), options.max_iterations,
                   options.residual, options.dt, options.damping};
  how.margins = (options.flags & MVS_SETTLE_NO_MARGINS) == 0;
  return how;
}

mvs_stats public_stats(const SolveStats &from) {
  mvs_stats stats = {};
  stats.struct_size = sizeof stats;
  stats.converged = from.converged ? 1 : 0;
  stats.iterations = from.iterations;
  stats.contact_pairs = from.contact_pairs;
  stats.lowered = from.lowered;
  stats.residual = from.residual;
  stats.energy = from.energy;
  stats.kinetic = from.kinetic;
  stats.wall_s = from.wall_s;
  stats.stable = from.stable ? 1 : 0;
  stats.stiffness_margin = from.stiffness_margin;
  stats.growth_rate = from.growth_rate;
  return stats;
}

mvs_profile public_profile(const SolveStats &from) {
  mvs_profile profile = {};
  profile.struct_size = sizeof profile;
  profile.skipped = from.skipped;
  profile.factorisations = from.factorisations;
  profile.shifted = from.shifted;
  profile.broad_phases = from.work.broad_phases;
  profile.orderings = from.work.orderings;
  profile.linear_iterations = from.work.linear_iterations;
  profile.passes = from.work.passes;
  profile.untangled = from.untangled;
  profile.discarded_levels = from.discarded;
  std::copy(from.work.seconds.begin(), from.work.seconds.end(), profile.phase_s);
  return profile;
}

}  // namespace mvs::core

using namespace mvs::core;

namespace {

SolveOptions read_options(const mvs_step_options *given) {
  const mvs_step_options options = read_struct_or_default(given, "options");
  MVS_MUST(options.solver == 0 || options.solver == MVS_SOLVER_IMPLICIT ||
               options.solver == MVS_SOLVER_EXPLICIT,
           MVS_E_ARGUMENT, "options.solver",
           "options.solver is %u: a step is MVS_SOLVER_IMPLICIT or MVS_SOLVER_EXPLICIT",
           options.solver);
  must_be_in(options.dt, limits::dt, "options.dt");
  must_be_in(options.damping, limits::damping, "options.damping");
  must_be_zero(options.reserved, "options.reserved");
  MVS_MUST(options.budget == 0 ||
               (options.budget >= limits::least_budget && options.budget <= limits::most_budget),
           MVS_E_ARGUMENT, "options.budget",
           "options.budget is %u: a step needs %u passes over the terms and may take %u; 0 is the "
           "default",
           options.budget, limits::least_budget, limits::most_budget);
  return {
      static_cast<SolverKind>(options.solver), 0, 0, options.dt, options.damping, options.budget};
}

// Makes a settled state the present one, and records the tool moves before the settle and the
// settle itself.
void finish_settle(mvs_sim &sim, const Snapshot &before, State state,
                   const std::vector<RecordedEvent> &hands, const SolveOptions &how,
                   const SolveStats &found, mvs_stats *stats) {
  const RecordedEvent event = event_of(RecordedEvent::settle, how);
  sim.replace(make_snapshot(after_event(before, std::move(state), hands, event)));
  sim.hands.done(sim.present()->state);
  sim.stats = found;
  if (stats) write_struct(stats, public_stats(found), "stats");
  const bool returns =
      !found.converged && found.growth_rate > 0 && found.residual <= how.tolerance();
  const char *outcome = found.converged ? "converged"
                        : returns       ? "in an unstable equilibrium, to which it always returns,"
                                        : "not converged";
  sim.log(found.converged ? MVS_LOG_INFO : MVS_LOG_WARNING,
          "settle: %s after %u iterations, residual %.3g N, %.3f s", outcome, found.iterations,
          found.residual, found.wall_s);
  if (found.converged && sim.load().pressure > 0) log_slack_chordae(sim, *sim.present().get());
}

// Works on the slices of a simulator; an error ends them.
template <typename Work>
auto work_on_slices(mvs_sim &sim, Work &&work) {
  MVS_MUST(sim.slices, MVS_E_STATE, "settle",
           "no settle is under way: it ended, was cancelled, or the valve changed; call "
           "mvs_begin_settle");
  try {
    return work(*sim.slices);
  } catch (...) {
    sim.slices.reset();
    throw;
  }
}

const SolveStats &last_stats(const mvs_sim *sim) {
  must_point(sim, "sim");
  MVS_MUST(sim->stats, MVS_E_STATE, "sim",
           "the simulator has no statistics: this valve was neither settled nor stepped");
  return *sim->stats;
}

}  // namespace

extern "C" {

mvs_result mvs_set_load(mvs_sim *sim, const mvs_load_case *load) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    const Load given = read_load(load);
    if (s.has_recorded(given)) {
      s.slices.reset();
    } else {
      const SnapshotPtr before = s.present();
      State state = before->state;
      const RecordedEvent event = event_of(given);
      apply_event(*before->model, state, event);
      s.replace(make_snapshot(after_event(before->value, std::move(state), event)));
    }
    log_pressure(s, given.pressure);
  });
}

mvs_result mvs_get_load(const mvs_sim *sim, mvs_load_case *load) {
  return at_boundary([&] {
    must_point(sim, "sim");
    write_struct(load, public_load(sim->load()), "load");
  });
}

mvs_result mvs_settle(mvs_sim *sim, const mvs_settle_options *options, mvs_stats *stats) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    const SolveOptions how = read_options(options);
    if (stats) checked_struct_size(stats, "stats");
    const SnapshotPtr before = s.present();
    State state = before->state;
    const std::vector<RecordedEvent> hands = s.hands.take(state);
    const SolveStats found =
        settle_with_mesh_hierarchy(s.solver, *before->model, state, how, s.progress());
    finish_settle(s, before->value, std::move(state), hands, how, found, stats);
  });
}

mvs_result mvs_begin_settle(mvs_sim *sim, const mvs_settle_options *options) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    const SolveOptions how = read_options(options);
    const SnapshotPtr before = s.present();
    State state = before->state;
    std::vector<RecordedEvent> hands = s.hands.take(state);
    s.slices.reset();
    s.slices = std::make_unique<SettleSlices>(static_cast<Backend>(s.desc.backend), s.workers.get(),
                                              before, std::move(state), std::move(hands), how,
                                              s.progress());
  });
}

mvs_result mvs_advance_settle(mvs_sim *sim, double seconds, double *share, mvs_stats *stats) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    MVS_MUST(seconds >= 0 && seconds <= 3600, MVS_E_ARGUMENT, "seconds",
             "seconds is %g: it has to be 0 to 3600", seconds);
    if (stats) checked_struct_size(stats, "stats");
    const double done = work_on_slices(s, [&](SettleSlices &slices) {
      if (slices.advance(seconds)) return slices.share();
      State state;
      const SolveStats found = slices.finish(state);
      // the replacement of the present snapshot frees the slices
      const std::unique_ptr<SettleSlices> ended = std::move(s.slices);
      finish_settle(s, ended->before()->value, std::move(state), ended->hands(), ended->options(),
                    found, stats);
      return 1.0;
    });
    if (share) *share = done;
  });
}

mvs_result mvs_cancel_settle(mvs_sim *sim) {
  return call_at_boundary(sim, [](mvs_sim &s) { s.slices.reset(); });
}

mvs_result mvs_step(mvs_sim *sim, const mvs_step_options *options) {
  return call_at_boundary(sim, [&](mvs_sim &s) { s.step(read_options(options)); });
}

mvs_result mvs_prepare_step(mvs_sim *sim, const mvs_step_options *options) {
  return call_at_boundary(sim, [&](mvs_sim &s) { s.prepare_step(read_options(options)); });
}

mvs_result mvs_get_stats(const mvs_sim *sim, mvs_stats *stats) {
  return at_boundary([&] {
    checked_struct_size(stats, "stats");
    write_struct(stats, public_stats(last_stats(sim)), "stats");
  });
}

mvs_result mvs_get_profile(const mvs_sim *sim, mvs_profile *profile) {
  return at_boundary([&] {
    checked_struct_size(profile, "profile");
    write_struct(profile, public_profile(last_stats(sim)), "profile");
  });
}

}  // extern "C"
