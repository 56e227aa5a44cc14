// Replay of plan steps: the solver executes events, after_op applies operations.
#include "session/replay.h"

#include <chrono>

#include "base/error.h"
#include "base/struct_fields.h"
#include "formats/plan/grasp.h"
#include "history/tool_trajectory.h"
#include "session/commit.h"
#include "session/recorded_event.h"
#include "session/tools.h"
#include "solve/static/mesh_hierarchy.h"

namespace mvs::core {
namespace {

// Executes the time steps of an event. Calls the progress callback after the first step, and then
// after a step if 50 ms have passed: a host that cancels must not wait for many slow steps.
class Stepping {
 public:
  Stepping(mvs_sim &sim, const RecordedEvent &event)
      : sim_(sim), event_(event), progress_(sim.progress()) {}

  void run(const Model &model, State &state, uint64_t count) {
    for (uint64_t k = 0; k < count; ++k) {
      const SolveStats found = sim_.solver.step(model, state, options_of(event_));
      ++taken_;
      const double share = static_cast<double>(taken_) / static_cast<double>(event_.count);
      MVS_MUST(!is_due() || progress_(share, found.residual), MVS_E_CANCELLED, "step",
               "stepping was cancelled by the progress callback; the valve is as before");
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  bool is_due() {
    const Clock::time_point now = Clock::now();
    if (!progress_ || (taken_ > 1 && now - reported_ < std::chrono::milliseconds(50))) return false;
    reported_ = now;
    return true;
  }

  mvs_sim &sim_;
  const RecordedEvent &event_;
  const Progress progress_;
  uint64_t taken_ = 0;
  Clock::time_point reported_;
};

Snapshot after_running(mvs_sim &sim, const Snapshot &now, const RecordedEvent &event) {
  const Model &model = *now.current.model;
  State state = now.current.state;
  if (event.kind == RecordedEvent::settle) {
    SolveOptions how = options_of(event);
    how.margins = false;
    settle_with_mesh_hierarchy(sim.solver, model, state, how, sim.progress());
  } else if (event.kind == RecordedEvent::step) {
    Stepping(sim, event).run(model, state, event.count);
  } else if (event.kind == RecordedEvent::tool_trajectory) {
    Stepping stepping(sim, event);
    for (size_t row = 0; row < event.steps_per_row.size(); ++row) {
      apply_row(state, event, row);
      stepping.run(model, state, event.steps_per_row.get()[row]);
    }
  } else {
    apply_event(model, state, event);
  }
  return after_event(now, std::move(state), event);
}

// The names of the chordae with a flag.
Json flagged(const mvs_snapshot &snapshot, uint8_t flag) {
  Json names = Json::array();
  for (size_t c = 0; c < snapshot.chords().flags.size(); ++c) {
    if (snapshot.chords().flags[c] & flag) names.add(snapshot.model->valve.chords[c].name);
  }
  return names;
}

// Runs the work of a step; a failure names the step, counted from 1, and its operation.
template <typename Work>
void in_step(const std::vector<PlanStep> &steps, size_t k, Work work) {
  const PlanStep &step = steps[k];
  const std::string word = step.event ? "" : step.op["do"].text() + ": ";
  try {
    work(step);
  } catch (const Error &error) {
    const bool named = std::string_view(error.what()).starts_with(word);
    fail(error.code, error.part, "step %zu of the plan: %s%s", k + 1, named ? "" : word.c_str(),
         error.what());
  }
}

}  // namespace

uint32_t check_steps(const std::vector<PlanStep> &steps) {
  uint32_t operations = 0;
  for (size_t k = 0; k < steps.size(); ++k) {
    in_step(steps, k, [&](const PlanStep &step) {
      if (step.event) return;
      check_op(step.op);
      ++operations;
    });
  }
  return operations;
}

void Replay::operate(const PlanStep &step) {
  const Model &model = *now.current.model;
  const Operation op = read_op(step.op, model, exact_);
  const bool continues_group = step.group == group_ && step.group_id == group_id_;
  if (!step.group.empty() && !continues_group) number_ = now.history.next_group++;
  now = after_op(now, op, step.group.empty() ? Group{} : Group{number_, step.group}, now_ms());
  group_ = step.group;
  group_id_ = step.group_id;
}

// Maps recorded tool ids: a tool that the plan adds gets the next free id of the simulator, and
// later events of that tool use it, so that tools present before the plan are not touched. A grasp
// without a place, of an older file, keeps its node on any valve.
void Replay::execute(RecordedEvent event, const Json &place) {
  if (!exact_ && !place.is_null()) {
    event.tools[0].node = node_at_place(*now.current.model, place);
  }
  const bool is_add = event.kind == RecordedEvent::tool_add;
  if (is_add && !exact_ && event.tools.get()[0].kind != ToolKind::grasp) {
    must_be_near(now.current.model->valve, event.tools.get()[0].position, "position_m");
  }
  if (!run_event_) return note_tools(event);
  const Id added = is_add ? event.tools.get()[0].id : 0;
  const Id next = first_tool_id + now.current.state.tools_made;
  if (added != 0) tools_[added] = next;
  for (size_t k = 0; k < event.tools.size(); ++k) {
    const auto known = tools_.find(event.tools.get()[k].id);
    if (known != tools_.end() && known->first != known->second) event.tools[k].id = known->second;
  }
  now = run_event_(now, event);
}

// Keeps the ids of the tools that a plan would have here; throws where it moves or removes another.
void Replay::note_tools(const RecordedEvent &event) {
  if (event.kind == RecordedEvent::tool_add) added_.insert(event.tools.get()[0].id);
  const bool is_remove = event.kind == RecordedEvent::tool_remove;
  for (const Tool &tool : event.tools.get()) {
    if (added_.count(tool.id) > 0) continue;
    tool_of(now.current.state, tool.id, is_remove ? "remove" : "move");
  }
  if (is_remove) added_.erase(event.tools.get()[0].id);
}

void Replay::run(const std::vector<PlanStep> &steps) {
  for (size_t k = 0; k < steps.size(); ++k) {
    in_step(steps, k, [&](const PlanStep &step) {
      if (step.event) {
        execute(*step.event, step.place);
      } else {
        operate(step);
      }
    });
  }
}

RunEvent event_runner(mvs_sim &sim) {
  return [&sim](const Snapshot &now, const RecordedEvent &event) {
    return after_running(sim, now, event);
  };
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
