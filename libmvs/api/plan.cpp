// Plans: writes the history of a snapshot as JSON, and replays a plan on the present valve.
#include <mvs/plan.h>

#include "api/sim_call.h"
#include "base/utf8.h"
#include "formats/formats.h"
#include "session/commit.h"
#include "session/replay.h"
#include "session/unit_warnings.h"

using namespace mvs::core;

namespace {

std::string plan_text(const mvs_snapshot *snapshot, const mvs_plan_options *given) {
  must_point(snapshot, "snapshot");
  const mvs_plan_options options = read_struct_or_default(given, "options");
  MVS_MUST(options.measures <= 1, MVS_E_ARGUMENT, "options.measures",
           "options.measures is %u: it has to be 0 or 1", options.measures);
  MVS_MUST(is_utf8(text_or_empty(options.author)), MVS_E_ARGUMENT, "options.author",
           "options.author is not UTF-8: convert it");
  MVS_MUST(is_utf8(text_or_empty(options.notes)), MVS_E_ARGUMENT, "options.notes",
           "options.notes is not UTF-8: convert it");
  return write_plan(snapshot->value, {text_or_empty(options.author), text_or_empty(options.notes)},
                    options.measures ? plan_measures : Measure());
}

mvs_replay replay_of(const Plan &plan, const Snapshot &from, const Snapshot &to) {
  mvs_replay replay = {};
  replay.operations = static_cast<uint32_t>(to.history.past.size() - from.history.past.size());
  replay.same_valve = plan.valve_hash == hash_text(from.current) ? 1 : 0;
  replay.same_result = plan.result_hash == hash_text(to.current) ? 1 : 0;
  return replay;
}

// Warns of tissue and pressures of a plan that are probably in other units.
void log_plan(const mvs_sim &sim, const Plan &plan, const Model &after, const Model &before) {
  log_units(sim, after, &before);
  for (const PlanStep &step : plan.steps) {
    if (step.event && step.event->kind == RecordedEvent::load) {
      log_pressure(sim, step.event->pressure);
    }
  }
}

}  // namespace

extern "C" {

mvs_result mvs_save_plan(const mvs_snapshot *snapshot, const mvs_plan_options *options,
                         const char *path) {
  return file_at_boundary(path ? path : "", [&] {
    must_point(path, "path");
    write_whole_file(path, plan_text(snapshot, options));
  });
}

mvs_result mvs_write_plan(const mvs_snapshot *snapshot, const mvs_plan_options *options, void *data,
                          uint64_t capacity, uint64_t *size) {
  return at_boundary(
      [&] { write_bytes(data, capacity, size, [&] { return plan_text(snapshot, options); }); });
}

mvs_result mvs_replay_plan(mvs_sim *sim, const void *data, uint64_t size, mvs_replay *replay) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    const SnapshotPtr before = s.present();
    if (replay) checked_struct_size(replay, "replay");
    const Plan plan = read_plan(read_bytes(data, size));
    const bool exact = plan.valve_hash == hash_text(before->value.current);
    must_be_no_group(s, "replay");
    Replay steps(before->value, exact, event_runner(s));
    steps.run(plan.steps);
    const mvs_replay how = replay_of(plan, before->value, steps.now);
    commit(s, std::move(steps.now),
           [&](const Snapshot &after) { return steps_record(before->value, after); });
    if (replay) write_struct(replay, how, "replay");
    log_plan(s, plan, *s.present()->model, *before->model);
  });
}

mvs_result mvs_check_plan(const mvs_sim *sim, const void *data, uint64_t size, mvs_replay *replay) {
  return at_boundary([&] {
    if (replay) checked_struct_size(replay, "replay");
    if (!sim) {
      mvs_replay how = {};
      how.operations = check_steps(read_plan(read_bytes(data, size)).steps);
      if (replay) write_struct(replay, how, "replay");
      return;
    }
    const SnapshotPtr before = sim->present();
    const Plan plan = read_plan(read_bytes(data, size));
    const bool exact = plan.valve_hash == hash_text(before->value.current);
    Replay steps(before->value, exact, {});
    steps.run(plan.steps);
    if (replay) write_struct(replay, replay_of(plan, before->value, steps.now), "replay");
    log_plan(*sim, plan, *steps.now.current.model, *before->model);
  });
}

}  // extern "C"
