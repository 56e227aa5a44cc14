// Present snapshot, log and replacement of the valve.
#include "session/simulator.h"

#include <cstdarg>

#include "base/error.h"
#include "base/option_checks.h"
#include "session/mesh_warnings.h"
#include "session/unit_warnings.h"

using namespace mvs::core;

namespace {

std::unique_ptr<Workers> make_workers(const mvs_sim_desc &desc) {
  if (desc.run_tasks) {
    return std::make_unique<Workers>(HostPool{desc.pool_width, desc.run_tasks, desc.user});
  }
  if (desc.workers > 1) return std::make_unique<Workers>(desc.workers);
  return nullptr;
}

}  // namespace

mvs_sim::mvs_sim(const mvs_sim_desc &desc_in)
    : desc(desc_in),
      workers(make_workers(desc)),
      solver(static_cast<Backend>(desc.backend), workers.get()) {}

SnapshotPtr mvs_sim::present() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  must_have_valve();
  if (present_) return present_;
  if (stepped_.count > 0) now_.history.events = with_event(now_.history.events, stepped_);
  stepped_.count = 0;
  present_ = make_snapshot(now_);
  return present_;
}

const ModelState &mvs_sim::current() const {
  must_have_valve();
  return now_.current;
}

void mvs_sim::replace(SnapshotPtr next) {
  const std::lock_guard<std::mutex> lock(mutex_);
  now_ = next->value;
  stepped_.count = 0;
  if (stats) {
    stats->converged = now_.current.state.is_at_rest();
    stats->stable = stats->stable && stats->converged;
  }
  slices.reset();
  present_.swap(next);
}

Load mvs_sim::load() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  must_have_valve();
  return now_.current.state.load;
}

bool mvs_sim::has_recorded(const Load &load) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  must_have_valve();
  const Load &now = now_.current.state.load;
  return now.pressure == load.pressure && now.boundary_fraction == load.boundary_fraction &&
         is_newest_load(now_.history.events, load);
}

void mvs_sim::must_have_valve() const {
  MVS_MUST(now_.current.model, MVS_E_STATE, "sim",
           "the simulator has no valve yet: set, generate or load one first");
}

void mvs_sim::log(mvs_log_level level, const char *pattern, ...) const {
  if (!desc.log) return;
  va_list arguments;
  va_start(arguments, pattern);
  try {
    desc.log(desc.user, level, vformat(pattern, arguments).c_str());
  } catch (...) {  // NOLINT(bugprone-empty-catch): a call that is done does not fail for its log
  }
  va_end(arguments);
}

Progress mvs_sim::progress() const {
  if (!desc.progress) return {};
  return [this](double share, double residual) {
    return desc.progress(desc.user, share, residual) == 0;
  };
}

namespace mvs::core {

AtWork::AtWork(mvs_sim *sim) : sim_(sim) {
  must_point(sim, "sim");
  MVS_MUST(!sim->at_work.exchange(true), MVS_E_STATE, "sim",
           "the simulator is at work in another call: wait for it, and do not call back into it");
}

void must_be_no_group(const mvs_sim &sim, const char *call) {
  MVS_MUST(sim.group.number == 0, MVS_E_STATE, "group",
           "%s: the group \"%.63s\" is open: call mvs_end_group first", call,
           sim.group.name.c_str());
}

void replace_valve(mvs_sim &sim, Snapshot snapshot) {
  check_solver_cache(snapshot.current);
  const ModelPtr held = snapshot.current.model;
  std::vector<Fault> doubtful;  // before the replacement, which nothing may interrupt
  if (sim.desc.log) doubtful = mesh_warnings(*held, snapshot.current.state.x);
  sim.replace(make_snapshot(std::move(snapshot)));
  sim.group = {};
  sim.hands.forget();
  if (sim.journal) sim.log(MVS_LOG_WARNING, "the journal ends: the valve was replaced");
  sim.journal.reset();
  sim.stats.reset();
  sim.log(MVS_LOG_INFO, "valve \"%s\": %zu nodes, %zu triangles, %zu chords",
          held->valve.name.c_str(), held->node_count(), held->valve.triangles.size(),
          held->valve.chords.size());
  for (const Fault &fault : doubtful) sim.log(MVS_LOG_WARNING, "%s", fault.sentence.c_str());
  log_units(sim, *held);
  log_pressure(sim, sim.load().pressure);
}

}  // namespace mvs::core
