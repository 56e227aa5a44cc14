// Steps of a plan: moves by the solver, operations as any other.
#include "api/replay.h"

#include "api/commit.h"
#include "api/moves.h"
#include "cascade/cascade.h"

namespace mvs {
namespace {

// Takes a step as often as the move says. The host is asked after the first and every 64th one
// more.
void step_on(mvs_sim &sim, const Model &model, State &state, const Move &move) {
  const Progress progress = sim.progress();
  for (uint64_t k = 0; k < move.count; ++k) {
    const SolveStats found = sim.solver.step(model, state, options_of(move));
    const double share = static_cast<double>(k + 1) / static_cast<double>(move.count);
    MVS_MUST(!progress || k % 64 != 0 || progress(share, found.residual), MVS_E_CANCELLED, "step",
             "stepping was cancelled by the progress callback; the valve is as before");
  }
}

Moment moved(mvs_sim &sim, const Moment &now, const Move &move) {
  State state = now.picture.state;
  if (move.kind == Move::settle) {
    settle_by_levels(sim.solver, *now.picture.model, state, options_of(move), sim.progress());
  } else if (move.kind == Move::step) {
    step_on(sim, *now.picture.model, state, move);
  } else {
    take_move(*now.picture.model, state, move);
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
  const Operation op = read_op(step.op, *now.picture.model, exact_);
  const bool goes_on = step.group == group_ && step.group_id == group_id_;
  if (!step.group.empty() && !goes_on) number_ = now.timeline.next_group++;
  now = after_op(now, op, step.group.empty() ? Group{} : Group{number_, step.group}, now_ms());
  group_ = step.group;
  group_id_ = step.group_id;
}

void Replay::go(const std::vector<PlanStep> &steps) {
  for (size_t k = 0; k < steps.size(); ++k) {
    const PlanStep &step = steps[k];
    if (step.move && !take_) continue;
    const std::string word = step.move ? "" : step.op["do"].text() + ": ";
    try {
      if (step.move) {
        now = take_(now, *step.move);
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
  return [&sim](const Moment &now, const Move &move) { return moved(sim, now, move); };
}

Json plan_measures(const Picture &picture) {
  const SnapshotPtr snapshot = make_snapshot({picture, {}});
  const mvs_measures &m = snapshot->measures();
  Json json;
  json.set("regurgitant_orifice_area_m2", m.regurgitant_orifice_area);
  json.set("coaptation_area_m2", m.coaptation_area);
  json.set("coaptation_height_m", m.coaptation_height);
  json.set("coaptation_length_mean_m", m.coaptation_length_mean);
  json.set("tenting_height_m", m.tenting_height);
  json.set("billow_height_m", m.billow_height);
  json.set("annulus_ap_m", m.annulus_ap);
  json.set("annulus_cc_m", m.annulus_cc);
  json.set("max_chord_strain", m.max_chord_strain);
  json.set("max_chord_tension_N", m.max_chord_tension);
  json.set("chords_over_strain", flagged(*snapshot.get(), MVS_CHORD_OVER_STRAIN));
  json.set("chords_over_tension", flagged(*snapshot.get(), MVS_CHORD_OVER_TENSION));
  json.set("intersections", m.intersections);
  return json;
}

}  // namespace mvs
