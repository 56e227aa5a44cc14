// The life of a simulator: create, give it a valve, snapshot, restore, destroy.
#include "api/mesh_notes.h"
#include "api/simulator.h"

#include <cstdarg>
#include <cstdio>

#include "anatomy/parametric.h"
#include "api/commit.h"
#include "api/unit_notes.h"
#include "api/valve_desc.h"
#include "model/check.h"

using namespace mvs::core;

SnapshotPtr mvs_sim::present() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  must_have_valve();
  if (present_) return present_;
  if (stepped_.count > 0) now_.timeline.moves = with_move(now_.timeline.moves, stepped_);
  stepped_.count = 0;
  present_ = make_snapshot(now_);
  return present_;
}

const Picture &mvs_sim::picture() const {
  must_have_valve();
  return now_.picture;
}

void mvs_sim::replace(SnapshotPtr next) {
  const std::lock_guard<std::mutex> lock(mutex_);
  now_ = next->moment;
  stepped_.count = 0;
  present_.swap(next);
}

Load mvs_sim::load() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  must_have_valve();
  return now_.picture.state.load;
}

void mvs_sim::must_have_valve() const {
  MVS_MUST(now_.picture.model, MVS_E_STATE, "sim",
           "the simulator has no valve yet: set, generate or load one first");
}

void mvs_sim::log(int32_t level, const char *pattern, ...) const {
  if (!desc.log) return;
  char text[512];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  desc.log(desc.user, level, text);
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

void replace_valve(mvs_sim &sim, Moment moment) {
  const ModelPtr held = moment.picture.model;
  sim.replace(make_snapshot(std::move(moment)));
  sim.group = {};
  sim.hands.forget();
  if (sim.journal) sim.log(MVS_LOG_INFO, "the journal ends: there is a new valve");
  sim.journal.reset();
  sim.stats = {};
  sim.log(MVS_LOG_INFO, "valve \"%s\": %zu nodes, %zu triangles, %zu chords",
          held->valve.name.c_str(), held->node_count(), held->valve.triangles.size(),
          held->valve.chords.size());
  log_mesh(sim, *held);
  log_units(sim, *held);
  log_pressure(sim, sim.load().pressure);
}

}  // namespace mvs::core

extern "C" {

mvs_result mvs_create(const mvs_sim_desc *desc, mvs_sim **sim) {
  return guarded([&] {
    must_point(sim, "sim");
    const mvs_sim_desc how = read_struct_or_default(desc, "desc");
    MVS_MUST(how.backend <= MVS_BACKEND_BLOCK, MVS_E_ARGUMENT, "desc.backend",
             "desc.backend is %u: it has to be one of MVS_BACKEND_*", how.backend);
    *sim = new mvs_sim(how);
  });
}

void mvs_destroy(mvs_sim *sim) {
  delete sim;
}

mvs_result mvs_set_valve(mvs_sim *sim, const mvs_valve_desc *valve) {
  return guarded_call(sim, [&](mvs_sim &s) {
    Described described = read_valve_desc(valve);
    ModelPtr model = make_model(std::move(described.valve));
    State state = described_state(*model, described.now);
    replace_valve(s, {{std::move(model), std::move(state)}, {}});
  });
}

mvs_result mvs_check_valve(const mvs_valve_desc *valve, mvs_fault_fn fault, void *user) {
  bool told = false;
  const auto tell = [&](const char *part, const char *sentence) {
    told = true;
    if (fault) fault(user, part, sentence);
  };
  const mvs_result result = guarded([&] {
    Described described = read_valve_desc(valve);
    for (const Fault &f : find_faults(described.valve)) tell(f.part.c_str(), f.sentence.c_str());
    described_state(*make_model(std::move(described.valve)), described.now);
  });
  // what kept the description from being read is a fault as well
  if (result != MVS_OK && !told) tell(mvs_last_error()->part, mvs_last_error()->message);
  return result;
}

mvs_result mvs_generate_valve(mvs_sim *sim, const mvs_parametric_desc *desc) {
  return guarded_call(sim, [&](mvs_sim &s) {
    ModelPtr model = make_model(make_parametric_valve(read_struct_or_default(desc, "desc")));
    State state = initial_state(*model);
    replace_valve(s, {{std::move(model), std::move(state)}, {}});
  });
}

mvs_result mvs_get_snapshot(mvs_sim *sim, const mvs_snapshot **snapshot) {
  return guarded([&] {
    must_point(sim, "sim");
    must_point(snapshot, "snapshot");
    *snapshot = sim->present().release();
  });
}

mvs_result mvs_restore(mvs_sim *sim, const mvs_snapshot *snapshot) {
  return guarded_call(sim, [&](mvs_sim &s) {
    must_point(snapshot, "snapshot");
    must_be_no_group(s, "restore");
    restart_journal(s, snapshot->moment);
    mvs_snapshot_retain(snapshot);
    s.replace(SnapshotPtr(snapshot));
    s.hands.forget();
  });
}

}  // extern "C"
