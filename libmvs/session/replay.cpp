// Steps of a plan: moves by the solver, operations as any other.
#include "session/replay.h"

#include "base/error.h"
#include "base/struct_fields.h"
#include "history/tool_trajectory.h"
#include "session/commit.h"
#include "session/recorded_event.h"
#include "solve/static/mesh_hierarchy.h"

namespace mvs::core {
namespace {

// Takes the steps of a move. The host is asked after the first and every 64th one more.
class Stepping {
 public:
  Stepping(mvs_sim &sim, const RecordedEvent &move)
      : sim_(sim), move_(move), progress_(sim.progress()) {}

  void on(const Model &model, State &state, uint64_t count) {
    for (uint64_t k = 0; k < count; ++k) {
      const SolveStats found = sim_.solver.step(model, state, options_of(move_));
      ++taken_;
      const double share = static_cast<double>(taken_) / static_cast<double>(move_.count);
      MVS_MUST(!progress_ || taken_ % 64 != 1 || progress_(share, found.residual), MVS_E_CANCELLED,
               "step", "stepping was cancelled by the progress callback; the valve is as before");
    }
  }

 private:
  mvs_sim &sim_;
  const RecordedEvent &move_;
  const Progress progress_;
  uint64_t taken_ = 0;
};

Snapshot moved(mvs_sim &sim, const Snapshot &now, const RecordedEvent &move) {
  const Model &model = *now.current.model;
  State state = now.current.state;
  if (move.kind == RecordedEvent::settle) {
    settle_with_mesh_hierarchy(sim.solver, model, state, options_of(move), sim.progress());
  } else if (move.kind == RecordedEvent::step) {
    Stepping(sim, move).on(model, state, move.count);
  } else if (move.kind == RecordedEvent::lead) {
    Stepping stepping(sim, move);
    for (size_t row = 0; row < move.pace.size(); ++row) {
      take_row(state, move, row);
      stepping.on(model, state, move.pace.get()[row]);
    }
  } else {
    take_move(model, state, move);
  }
  return after_move(now, std::move(state), move);
}

// The names of the chordae with a flag.
Json flagged(const mvs_snapshot &snapshot, uint8_t flag) {
  Json names = Json::array();
  for (size_t c = 0; c < snapshot.chords().flags.size(); ++c) {
    if (snapshot.chords().flags[c] & flag) names.add(snapshot.model->valve.chords[c].name);
  }
  return names;
}

}  // namespace

void Replay::operate(const PlanStep &step) {
  const Model &model = *now.current.model;
  const Operation op = read_op(step.op, model, exact_);
  const bool goes_on = step.group == group_ && step.group_id == group_id_;
  if (!step.group.empty() && !goes_on) number_ = now.history.next_group++;
  now = after_op(now, op, step.group.empty() ? Group{} : Group{number_, step.group}, now_ms());
  group_ = step.group;
  group_id_ = step.group_id;
}

// Tools are called otherwise here where there were some before the plan: those that it adds get the
// next numbers, and what it does with them is done with these, not with tools that were there.
void Replay::move(RecordedEvent step) {
  const Id added = step.kind == RecordedEvent::tool_add ? step.tool.get()[0].id : 0;
  const Id next = first_tool_id + now.current.state.tools_made;
  if (added != 0) tools_[added] = next;
  for (size_t k = 0; k < step.tool.size(); ++k) {
    const auto known = tools_.find(step.tool.get()[k].id);
    if (known != tools_.end() && known->first != known->second) step.tool[k].id = known->second;
  }
  now = take_(now, step);
}

void Replay::go(const std::vector<PlanStep> &steps) {
  for (size_t k = 0; k < steps.size(); ++k) {
    const PlanStep &step = steps[k];
    if (step.move && !take_) continue;
    const std::string word = step.move ? "" : step.op["do"].text() + ": ";
    try {
      if (step.move) {
        move(*step.move);
      } else {
        operate(step);
      }
    } catch (const Error &error) {
      const bool named = std::string_view(error.what()).starts_with(word);
      fail(error.code, error.part, "step %zu of the plan: %s%s", k + 1, named ? "" : word.c_str(),
           error.what());
    }
  }
}

TakeMove moves_of(mvs_sim &sim) {
  return [&sim](const Snapshot &now, const RecordedEvent &move) { return moved(sim, now, move); };
}

Json plan_measures(const ModelState &current) {
  const SnapshotPtr snapshot = make_snapshot({current, {}});
  const mvs_measures &m = snapshot->measures();
  Json json;
  for (const mvs_field_info &field : struct_fields(MVS_STRUCT_MEASURES)) {
    if (field.type != MVS_FIELD_NUMBER) continue;
    const std::string unit = *field.unit ? std::string("_") + field.unit : "";
    json.set(field.name + unit, read_field(&m, field));
  }
  json.set("chords_over_strain", flagged(*snapshot.get(), MVS_CHORD_FLAG_OVER_STRAIN));
  json.set("chords_over_tension", flagged(*snapshot.get(), MVS_CHORD_FLAG_OVER_TENSION));
  json.set("intersections", m.intersections);
  return json;
}

}  // namespace mvs::core
