/* Plans replay to the same bits. */
#include <stdlib.h>

#include "repair.h"

static void operate(mvs_sim *sim) {
  shorten(sim, "P2/3", 0.75);
  close_a_bit(sim);
  MUST(mvs_begin_group(sim, "repair"));
  add_chord(sim);
  scale(sim, 0.95);
  MUST(mvs_end_group(sim));
  close_a_bit(sim);
}

static char *plan_of(mvs_sim *sim, uint64_t *size) {
  const mvs_snapshot *snapshot = NULL;
  mvs_plan_options options = {.struct_size = sizeof options, .measures = 1, .author = "a surgeon"};
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST(mvs_write_plan(snapshot, &options, NULL, 0, size));
  char *text = malloc(*size + 1);
  MUST(mvs_write_plan(snapshot, &options, text, *size, size));
  text[*size] = 0;
  mvs_snapshot_release(snapshot);
  return text;
}

static void a_plan_replays_to_the_same_bits(void) {
  mvs_sim *sim = new_valve(0), *again = new_valve(0), *other = new_valve(800);
  uint64_t size = 0, size_again = 0;
  mvs_replay replay = {.struct_size = sizeof replay};
  operate(sim);
  char *text = plan_of(sim, &size);
  CHECK(strstr(text, "\"regurgitant_orifice_area_m2\"") && strstr(text, "a surgeon"));
  CHECK(strstr(text, "\"factor\": 0.75") && strstr(text, "\"chord\": \"P2/3\""));
  const hash128 fresh = sim_hash(again);
  MUST(mvs_check_plan(again, text, size, &replay));
  CHECK(replay.operations == 3 && replay.same_valve == 1);
  CHECK(same_hash(fresh, sim_hash(again)));
  MUST(mvs_replay_plan(again, text, size, &replay));
  CHECK(replay.operations == 3 && replay.same_valve == 1 && replay.same_result == 1);
  CHECK(same_hash(sim_hash(sim), sim_hash(again)));
  /* groups as well: one undo reverts both operations */
  MUST(mvs_undo(sim));
  MUST(mvs_undo(again));
  CHECK(same_hash(sim_hash(sim), sim_hash(again)));
  MUST(mvs_redo(sim));
  MUST(mvs_redo(again));
  /* on another valve, by name and place */
  MUST(mvs_replay_plan(other, text, size, &replay));
  CHECK(replay.operations == 3 && replay.same_valve == 0 && replay.same_result == 0);
  CHECK(named(other, MVS_PART_CHORD, "new one") != 0);
  char *third = plan_of(other, &size_again);
  CHECK(size_again > 0);
  free(third);
  free(text);
  mvs_destroy(sim);
  mvs_destroy(again);
  mvs_destroy(other);
}

/* Entries hold their time of application; all other bytes of two plans can be compared. */
static void blank_times(char *text) {
  static const char key[] = "\"time\": \"";
  for (char *at = text; (at = strstr(at, key)) != NULL;) {
    for (at += strlen(key); *at && *at != '"'; ++at) *at = '-';
  }
}

static void a_replayed_plan_is_written_as_it_was_read(void) {
  mvs_sim *sim = new_valve(200), *again = new_valve(200), *third = new_valve(200);
  uint64_t size = 0, size_again = 0;
  mvs_replay replay = {.struct_size = sizeof replay};
  operate(sim);
  char *text = plan_of(sim, &size);
  MUST(mvs_replay_plan(again, text, size, NULL));
  char *text_again = plan_of(again, &size_again);
  MUST(mvs_replay_plan(third, text_again, size_again, &replay));
  CHECK(replay.same_result == 1 && same_hash(sim_hash(sim), sim_hash(third)));
  blank_times(text);
  blank_times(text_again);
  CHECK(strcmp(text, text_again) == 0);
  free(text_again);
  free(text);
  mvs_destroy(sim);
  mvs_destroy(again);
  mvs_destroy(third);
}

static void refused(mvs_sim *sim, const char *text, mvs_result code, const char *word) {
  const hash128 before = sim_hash(sim);
  MUST_FAIL(mvs_check_plan(sim, text, strlen(text), NULL), code, word);
  MUST_FAIL(mvs_replay_plan(sim, text, strlen(text), NULL), code, word);
  CHECK(same_hash(before, sim_hash(sim)));
}

#define PLAN(steps) "{\"format\":\"mvs-plan\",\"version\":1,\"steps\":[" steps "]}"

static void remove_blanks(char *text) {
  char *to = text;
  for (; *text; ++text) {
    if (*text != ' ' && *text != '\n') *to++ = *text;
  }
  *to = 0;
}

/* Consecutive equal steps are one entry of the plan, whether they were taken in one call or
 * several. */
static void equal_steps_are_counted_together(void) {
  static const char plan[] = PLAN(
      "{\"do\":\"load\",\"pressure_Pa\":9000,\"boundary_fraction\":1},"
      "{\"do\":\"step\",\"count\":2},{\"do\":\"step\",\"count\":3},"
      "{\"do\":\"step\",\"solver\":\"implicit\",\"count\":2}");
  mvs_sim *sim = new_valve(200), *stepped = new_valve(200);
  mvs_load_case load = {sizeof load, 0, 9000, 1};
  uint64_t size = 0;
  MUST(mvs_replay_plan(sim, plan, strlen(plan), NULL));
  MUST(mvs_set_load(stepped, &load));
  for (int k = 0; k < 7; ++k) MUST(mvs_step(stepped, NULL));
  CHECK(same_hash(sim_hash(sim), sim_hash(stepped)));
  char *text = plan_of(sim, &size);
  remove_blanks(text);
  CHECK(strstr(text,
               "{\"do\":\"step\",\"count\":5},"
               "{\"do\":\"step\",\"count\":2,\"solver\":\"implicit\"}]"));
  free(text);
  mvs_destroy(sim);
  mvs_destroy(stepped);
}

/* A step with a budget is replayed with that budget, in an entry of its own. */
static void steps_keep_their_budget(void) {
  mvs_sim *sim = new_valve(200), *again = new_valve(200);
  const mvs_load_case load = {sizeof load, 0, 9000, 1};
  const mvs_step_options tight = {.struct_size = sizeof tight, .budget = 4};
  uint64_t size = 0;
  MUST(mvs_set_load(sim, &load));
  MUST(mvs_step(sim, NULL));
  for (int k = 0; k < 3; ++k) MUST(mvs_step(sim, &tight));
  char *text = plan_of(sim, &size);
  MUST(mvs_replay_plan(again, text, size, NULL));
  CHECK(same_hash(sim_hash(sim), sim_hash(again)));
  remove_blanks(text);
  CHECK(strstr(text, "{\"do\":\"step\"},{\"do\":\"step\",\"count\":3,\"budget\":4}]"));
  free(text);
  mvs_destroy(sim);
  mvs_destroy(again);
}

/* A host that cancels at a given call of its progress callback. */
typedef struct host {
  int calls, stop_at;
  double share;
} host;

static int32_t tell(void *user, double share, double residual) {
  host *h = user;
  CHECK(share >= h->share && share <= 1 && residual >= 0);
  h->share = share;
  return ++h->calls == h->stop_at;
}

/* A replay of 1e12 steps ends when the host cancels, and the state is unchanged. */
static void a_cancelled_replay_changes_nothing(void) {
  static const char plan[] = PLAN(
      "{\"do\":\"annulus_scale\",\"factor\":0.9},"
      "{\"do\":\"step\",\"solver\":\"explicit\",\"count\":1000000000000}");
  host h = {0, 3, 0};
  mvs_sim_desc desc = {.struct_size = sizeof desc, .progress = tell, .user = &h};
  mvs_sim *sim = NULL, *undisturbed = new_valve(0);
  uint64_t size = 0;
  MUST(mvs_create(&desc, &sim));
  MUST(generate_founding(sim));
  MUST(mvs_step(sim, NULL));
  MUST(mvs_step(undisturbed, NULL));
  char *before = plan_of(sim, &size);
  MUST_FAIL(mvs_replay_plan(sim, plan, strlen(plan), NULL), MVS_E_CANCELLED,
            "step 2 of the plan: ");
  CHECK(h.calls == 3 && h.share > 0);
  char *after = plan_of(sim, &size);
  CHECK(strcmp(before, after) == 0);
  MUST(mvs_step(sim, NULL));
  MUST(mvs_step(undisturbed, NULL));
  CHECK(same_hash(sim_hash(undisturbed), sim_hash(sim)));
  free(after);
  free(before);
  mvs_destroy(undisturbed);
  mvs_destroy(sim);
}

static void plans_that_cannot_be_done_are_told(void) {
  mvs_sim *sim = new_valve(0);
  refused(sim, "", MVS_E_FORMAT, "not JSON");
  refused(sim, "{\"format\":\"mvs-plan\",\"version\":1,\"steps\":[", MVS_E_FORMAT, "cut short");
  refused(sim, "[1]", MVS_E_FORMAT, "not a plan");
  refused(sim, "{\"format\":\"mvs-plan\",\"version\":2,\"steps\":[]}", MVS_E_VERSION,
          "version 2, this libmvs reads version 1");
  refused(sim, "{\"format\":\"mvs-plan\",\"version\":0,\"steps\":[]}", MVS_E_VERSION, "version 0");
  refused(sim, "{\"format\":\"mvs-plan\",\"steps\":[]}", MVS_E_FORMAT, "no version");
  refused(sim, "{\"format\":\"mvs-plan\",\"version\":1}", MVS_E_FORMAT, "no \"steps\"");
  refused(sim, PLAN("1"), MVS_E_FORMAT, "step 1");
  refused(sim, PLAN("{\"do\":\"fly\"}"), MVS_E_VERSION, "\"fly\"");
  refused(sim, PLAN("{\"do\":\"settle\",\"dt\":1}"), MVS_E_FORMAT, "no field \"dt\"");
  refused(sim, PLAN("{\"do\":\"settle\",\"count\":2}"), MVS_E_FORMAT, "no field \"count\"");
  refused(sim, PLAN("{\"do\":\"settle\",\"budget\":9}"), MVS_E_FORMAT, "no field \"budget\"");
  refused(sim, PLAN("{\"do\":\"chord_length\",\"chord\":\"Q1/1\",\"factor\":0.5}"), MVS_E_ID,
          "no chord named \"Q1/1\"");
  refused(sim, PLAN("{\"do\":\"chord_length\",\"chord\":\"P2/3\",\"factor\":\"half\"}"),
          MVS_E_FORMAT, "factor has to be a number");
  refused(sim, PLAN("{\"do\":\"chord_length\",\"chord\":\"P2/3\",\"speed\":1}"), MVS_E_FORMAT,
          "no field \"speed\"");
  refused(sim,
          PLAN("{\"do\":\"annulus_scale\",\"factor\":0.9},"
               "{\"do\":\"chord_remove\",\"chord\":\"P2/3\"},"
               "{\"do\":\"chord_remove\",\"chord\":\"P2/3\"}"),
          MVS_E_ID, "step 3 of the plan: chord_remove: ");
  refused(sim,
          PLAN("{\"do\":\"chord_add\",\"head\":\"PM1\",\"site\":{\"scallop\":\"P9\",\"along\":0,"
               "\"height\":1}}"),
          MVS_E_ID, "no scallop named \"P9\"; there are A");
  refused(sim,
          PLAN("{\"do\":\"chord_add\",\"head\":\"PM1\",\"site\":{\"scallop\":\"P2\",\"along\":0,"
               "\"height\":1,\"depth\":1}}"),
          MVS_E_FORMAT, "site has no field \"depth\"");
  refused(sim, PLAN("],\"step\":["), MVS_E_FORMAT, "a plan has no field \"step\"");
  refused(sim, PLAN("],\"steps\":["), MVS_E_FORMAT, "has \"steps\" twice");
  refused(sim,
          PLAN("{\"do\":\"chord_remove\",\"chord\":\"P2/3\",\"group\":\"a\\nb\",\"group_id\":1}"),
          MVS_E_FORMAT, "group has to be a name");
  mvs_destroy(sim);
}

#define BALL(x)                                                                        \
  "{\"do\":\"tool_add\",\"tool\":281474976710656,\"kind\":\"ball\",\"position_m\":[" x \
  ",0,0.02],\"radius_m\":0.002,\"stiffness_N/m\":200,\"max_force_N\":5}"
#define MOVE(x) "{\"do\":\"tool_move\",\"tool\":281474976710656,\"position_m\":[" x ",0,0.02]}"
#define REMOVE_SECOND "{\"do\":\"tool_remove\",\"tool\":281474976710657}"
#define REMOVE "{\"do\":\"tool_remove\",\"tool\":281474976710656}"

/* As mvs_add_tool and mvs_move_tool refuse them. */
static void tools_far_away_or_of_no_valve_are_told(void) {
  static const char good[] = PLAN(BALL("0") "," MOVE("0.001") "," REMOVE "," BALL("0.001"));
  mvs_sim *sim = new_valve(0);
  refused(sim, PLAN(BALL("1e10")), MVS_E_FORMAT, "step 1: tool_add: the position is (1e+10, ");
  refused(sim, PLAN(BALL("0") "," MOVE("11")), MVS_E_FORMAT, "step 2: tool_move: the position is");
  refused(sim, PLAN(BALL("5")), MVS_E_ARGUMENT, "step 1 of the plan: position_m lies 5 m from");
  refused(sim, PLAN(MOVE("0")), MVS_E_ID, "step 1 of the plan: move: tool 281474976710656");
  refused(sim, PLAN(BALL("0") "," REMOVE "," MOVE("0")), MVS_E_ID, "step 3 of the plan: move: ");
  refused(sim, PLAN(REMOVE), MVS_E_ID, "step 1 of the plan: remove: tool 281474976710656");
  MUST(mvs_check_plan(sim, good, strlen(good), NULL));
  MUST(mvs_replay_plan(sim, good, strlen(good), NULL));
  /* the second tool of the plan is present now */
  MUST_FAIL(mvs_check_plan(sim, PLAN(REMOVE), strlen(PLAN(REMOVE)), NULL), MVS_E_ID, "remove: ");
  MUST(mvs_check_plan(sim, PLAN(REMOVE_SECOND), strlen(PLAN(REMOVE_SECOND)), NULL));
  mvs_destroy(sim);
}

/* As with mvs_move_tool. */
static void a_rod_that_is_moved_without_an_axis_keeps_its_own(void) {
  static const char plan[] = PLAN(
      "{\"do\":\"tool_add\",\"tool\":281474976710656,\"kind\":\"rod\",\"position_m\":[0,0,0.02],"
      "\"axis\":[0,1,0],\"radius_m\":0.002,\"length_m\":0.01,\"stiffness_N/m\":200,"
      "\"max_force_N\":5}," MOVE("0.001"));
  mvs_sim *sim = new_valve(0);
  mvs_tool_state state = {.struct_size = sizeof state};
  MUST(mvs_replay_plan(sim, plan, strlen(plan), NULL));
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST(mvs_snapshot_get_tool(snapshot, 0, &state));
  CHECK(state.position[0] == 0.001);
  CHECK(state.axis[0] == 0 && state.axis[1] == 1 && state.axis[2] == 0);
  mvs_snapshot_release(snapshot);
  mvs_destroy(sim);
}

int main(void) {
  a_plan_replays_to_the_same_bits();
  a_replayed_plan_is_written_as_it_was_read();
  equal_steps_are_counted_together();
  steps_keep_their_budget();
  a_cancelled_replay_changes_nothing();
  plans_that_cannot_be_done_are_told();
  tools_far_away_or_of_no_valve_are_told();
  a_rod_that_is_moved_without_an_axis_keeps_its_own();
  return finish("plan");
}
