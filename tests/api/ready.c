/* A call that changes a stepped valve prepares the solver in that call, not in the next step,
 * without changing any bit. */
#include "check.h"
#include "tests/founding.h"

static mvs_sim *sim;
static const mvs_snapshot *closed;

static mvs_profile step(mvs_sim *of) {
  mvs_profile profile = {.struct_size = sizeof profile};
  MUST(mvs_step(of, NULL));
  MUST(mvs_get_profile(of, &profile));
  CHECK(!(profile.skipped & MVS_SKIPPED_STEP));
  return profile;
}

static void shorten(const char *name) {
  mvs_part chord = {0};
  MUST(mvs_snapshot_find_part(closed, MVS_PART_CHORD, name, &chord));
  mvs_op_chord_length op = {{sizeof op, MVS_OP_CHORD_LENGTH}, .chord = chord.id, .factor = 0.85};
  MUST(mvs_apply_op(sim, &op.op, NULL));
}

static void shorten_one(void) {
  shorten("P2/1");
}

static void shorten_two_as_one(void) {
  MUST(mvs_begin_group(sim, "two"));
  shorten("P2/1");
  shorten("P2/2");
  MUST(mvs_end_group(sim));
}

static void shorten_and_lay_a_ball(void) {
  mvs_tool_desc ball = {.struct_size = sizeof ball, .kind = MVS_TOOL_KIND_BALL};
  mvs_id tool = 0;
  shorten("P2/1");
  ball.position[2] = 0.05;
  MUST(mvs_add_tool(sim, &ball, &tool));
}

static void undo_one(void) {
  MUST(mvs_undo(sim));
}

static void shorten_and_undo(void) {
  shorten("P2/1");
  MUST(mvs_undo(sim));
}

static void redo_one(void) {
  MUST(mvs_redo(sim));
}

static void back_to_the_checkpoint(void) {
  MUST(mvs_restore_checkpoint(sim, "less"));
}

/* A simulator that starts from this state prepares everything in its first step. */
static void the_next_step_makes_no_factor(void (*begin)(void), void (*change)(void)) {
  const mvs_snapshot *changed = NULL;
  mvs_sim *fresh = NULL;
  const mvs_load_case less = {sizeof less, 0, 0.9 * MVS_SYSTOLE_PA, 1};
  MUST(mvs_restore(sim, closed));
  if (begin) {
    /* a valve at rest would sleep after undo */
    MUST(mvs_set_load(sim, &less));
    MUST(mvs_set_checkpoint(sim, "less"));
    begin();
  }
  MUST(mvs_step(sim, NULL));
  change();
  MUST(mvs_get_snapshot(sim, &changed));
  MUST(mvs_create(NULL, &fresh));
  MUST(mvs_restore(fresh, changed));
  CHECK(step(sim).factorisations == 0);
  CHECK(step(fresh).factorisations == 1);
  for (int k = 0; k < 20; ++k) {
    CHECK(same_hash(sim_hash(sim), sim_hash(fresh)));
    step(sim);
    step(fresh);
  }
  mvs_snapshot_release(changed);
  mvs_destroy(fresh);
}

/* Of a simulator that has not stepped, from a valve at rest and then under another load, alone and
 * beside a tool that pushes. */
static void the_first_step_after_prepare_step_makes_no_factor(int with_tool) {
  const mvs_load_case less = {sizeof less, 0, 0.9 * MVS_SYSTOLE_PA, 1};
  const mvs_step_options slow = {.struct_size = sizeof slow, .dt = 2e-3, .damping = 5};
  mvs_sim *sims[2] = {NULL, NULL};
  hash128 before;
  int k, of;
  for (of = 0; of < 2; ++of) {
    MUST(mvs_create(NULL, &sims[of]));
    MUST(mvs_restore(sims[of], closed));
    if (of == 0) MUST(mvs_prepare_step(sims[of], NULL)); /* at rest, with other options */
    MUST(mvs_set_load(sims[of], &less));
    if (with_tool) {
      mvs_tool_desc ball = {.struct_size = sizeof ball, .kind = MVS_TOOL_KIND_BALL};
      mvs_id tool = 0;
      ball.position[2] = 0.05;
      MUST(mvs_add_tool(sims[of], &ball, &tool));
    }
  }
  before = sim_hash(sims[0]);
  MUST(mvs_prepare_step(sims[0], &slow));
  CHECK(same_hash(sim_hash(sims[0]), before));
  for (k = 0; k < 20; ++k) {
    for (of = 0; of < 2; ++of) {
      mvs_profile profile = {.struct_size = sizeof profile};
      MUST(mvs_step(sims[of], &slow));
      MUST(mvs_get_profile(sims[of], &profile));
      if (k == 0) CHECK(profile.factorisations == (of == 0 ? 0u : 1u));
      if (k == 0 && of == 0) CHECK(profile.orderings == 0);
    }
    CHECK(same_hash(sim_hash(sims[0]), sim_hash(sims[1])));
  }
  for (of = 0; of < 2; ++of) mvs_destroy(sims[of]);
}

static void prepare_step_has_the_errors_of_step(void) {
  mvs_step_options other = {.struct_size = sizeof other, .solver = MVS_SOLVER_NEWTON};
  mvs_sim *fresh = NULL;
  MUST(mvs_create(NULL, &fresh));
  CHECK(mvs_prepare_step(fresh, NULL) == MVS_E_STATE);
  MUST(mvs_restore(fresh, closed));
  CHECK(mvs_prepare_step(fresh, &other) == MVS_E_ARGUMENT);
  other.solver = MVS_SOLVER_EXPLICIT;
  MUST(mvs_prepare_step(fresh, &other));
  MUST(mvs_step(fresh, &other));
  mvs_destroy(fresh);
}

int main(void) {
  const mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  MUST(mvs_create(NULL, &sim));
  MUST(generate_founding(sim));
  MUST(mvs_set_load(sim, &systole));
  MUST(mvs_settle(sim, NULL, NULL));
  MUST(mvs_get_snapshot(sim, &closed));
  the_next_step_makes_no_factor(NULL, shorten_one);
  the_next_step_makes_no_factor(NULL, shorten_two_as_one);
  the_next_step_makes_no_factor(NULL, shorten_and_lay_a_ball);
  the_next_step_makes_no_factor(shorten_one, undo_one);
  the_next_step_makes_no_factor(shorten_and_undo, redo_one);
  the_next_step_makes_no_factor(shorten_one, back_to_the_checkpoint);
  the_first_step_after_prepare_step_makes_no_factor(0);
  the_first_step_after_prepare_step_makes_no_factor(1);
  prepare_step_has_the_errors_of_step();
  mvs_snapshot_release(closed);
  mvs_destroy(sim);
  return finish("ready");
}
