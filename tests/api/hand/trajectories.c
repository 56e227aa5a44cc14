/* Replay of tool trajectories from plans and sessions, also while the simulator holds other tools.
 * */
#include <stdlib.h>

#include "tests/api/check.h"
#include "tests/api/hand/tool_count.h"

static mvs_sim *make_sim(void) {
  mvs_sim *sim = NULL;
  mvs_parametric_desc small = {
      .struct_size = sizeof small, .vertices = 200, .shape = MVS_SHAPE_FOUNDING};
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_generate_valve(sim, &small));
  return sim;
}

/* The position of node k of the free edge. */
static uint32_t place(mvs_sim *sim, uint32_t k, double at[3]) {
  const mvs_snapshot *snapshot = NULL;
  mvs_view edge, x;
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_FREE_EDGE_NODES, &edge));
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_NODE_POSITION, &x));
  const uint32_t node = ((const uint32_t *)edge.data)[k];
  memcpy(at, (const double *)x.data + 3 * node, 3 * sizeof *at);
  mvs_snapshot_release(snapshot);
  return node;
}

static mvs_id grasp(mvs_sim *sim, uint32_t k, double at[3]) {
  mvs_tool_desc desc = {.struct_size = sizeof desc, .kind = MVS_TOOL_KIND_GRASP, .by_node = 1};
  mvs_id tool = 0;
  desc.node = place(sim, k, at);
  memcpy(desc.position, at, sizeof desc.position);
  MUST(mvs_add_tool(sim, &desc, &tool));
  return tool;
}

static mvs_id rod(mvs_sim *sim, const double at[3]) {
  mvs_tool_desc desc = {.struct_size = sizeof desc, .kind = MVS_TOOL_KIND_ROD};
  mvs_id tool = 0;
  memcpy(desc.position, at, sizeof desc.position);
  MUST(mvs_add_tool(sim, &desc, &tool));
  return tool;
}

static mvs_tool_state state_of(mvs_sim *sim, mvs_id tool) {
  mvs_tool_state state = {.struct_size = sizeof state};
  MUST(mvs_get_tool(sim, tool, &state));
  return state;
}

static int is_same_place(const double a[3], const double b[3]) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

typedef struct plan {
  char *text;
  uint64_t size;
} plan;

static plan plan_of(mvs_sim *sim) {
  const mvs_snapshot *snapshot = NULL;
  plan made = {NULL, 0};
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST(mvs_write_plan(snapshot, NULL, NULL, 0, &made.size));
  made.text = malloc(made.size);
  if (!made.text) exit(2);
  MUST(mvs_write_plan(snapshot, NULL, made.text, made.size, &made.size));
  mvs_snapshot_release(snapshot);
  return made;
}

/* A grasp and a rod, moved in turn and together, with steps at rest; the rod is removed. */
static void work(mvs_sim *sim) {
  double at[3], tip[3] = {0, 0, 0.02}, axis[3] = {0, 0.1, 1};
  const mvs_id held = grasp(sim, 0, at);
  const mvs_id pushing = rod(sim, tip);
  mvs_step_options longer = {.struct_size = sizeof longer, .dt = 2e-3};
  for (int k = 0; k < 150; ++k) {
    at[2] += 1e-5;
    tip[2] -= 1e-5;
    axis[0] = 1e-3 * k;
    if (k % 3 != 1) MUST(mvs_move_tool(sim, held, at, NULL));
    if (k % 4 != 2) MUST(mvs_move_tool(sim, pushing, tip, axis));
    MUST(mvs_step(sim, k == 100 ? &longer : NULL));
  }
  MUST(mvs_remove_tool(sim, pushing));
  for (int k = 0; k < 5; ++k) MUST(mvs_step(sim, NULL));
}

static void a_plan_moves_tools_to_the_same_bits(void) {
  mvs_sim *sim = make_sim(), *other = make_sim();
  mvs_replay replay = {.struct_size = sizeof replay};
  work(sim);
  const plan made = plan_of(sim);
  MUST(mvs_replay_plan(other, made.text, made.size, &replay));
  CHECK(replay.same_valve == 1 && replay.same_result == 1);
  CHECK(same_hash(sim_hash(sim), sim_hash(other)));
  /* and the plan of the replay is the same plan */
  const plan again = plan_of(other);
  CHECK(again.size == made.size && same_bits(again.text, made.text, made.size));
  free(made.text);
  free(again.text);
  mvs_destroy(sim);
  mvs_destroy(other);
}

static void looking_on_changes_no_plan(void) {
  mvs_sim *sim = make_sim(), *watched = make_sim();
  double at[3], same[3];
  const mvs_id tool = grasp(sim, 0, at), seen = grasp(watched, 0, same);
  for (int k = 0; k < 300; ++k) {
    at[2] += 1e-5;
    MUST(mvs_move_tool(sim, tool, at, NULL));
    MUST(mvs_move_tool(watched, seen, at, NULL));
    MUST(mvs_step(sim, NULL));
    MUST(mvs_step(watched, NULL));
    if (k % 7 == 0) state_of(watched, seen);
  }
  const plan alone = plan_of(sim), followed = plan_of(watched);
  CHECK(alone.size == followed.size && same_bits(alone.text, followed.text, alone.size));
  free(alone.text);
  free(followed.text);
  mvs_destroy(sim);
  mvs_destroy(watched);
}

static void a_session_keeps_what_hands_did(void) {
  if (!strstr(mvs_features(), "hdf5")) return;
  mvs_sim *sim = make_sim(), *other = NULL;
  const mvs_snapshot *snapshot = NULL;
  uint64_t size = 0;
  work(sim);
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST(mvs_save_memory(snapshot, MVS_FORMAT_H5, NULL, 0, &size));
  char *bytes = malloc(size);
  if (!bytes) exit(2);
  MUST(mvs_save_memory(snapshot, MVS_FORMAT_H5, bytes, size, &size));
  MUST(mvs_create(NULL, &other));
  MUST(mvs_load_memory(other, bytes, size, MVS_FORMAT_H5));
  const plan made = plan_of(sim), loaded = plan_of(other);
  CHECK(made.size == loaded.size && same_bits(made.text, loaded.text, made.size));
  mvs_snapshot_release(snapshot);
  free(bytes);
  free(made.text);
  free(loaded.text);
  mvs_destroy(sim);
  mvs_destroy(other);
}

/* The plan's tools are added beside the tools that are held, which stay unchanged. */
static void a_plan_touches_no_tool_that_was_held(void) {
  mvs_sim *sim = make_sim(), *busy = make_sim();
  double at[3];
  mvs_replay replay = {.struct_size = sizeof replay};
  work(sim);
  const plan made = plan_of(sim);
  const mvs_id mine = grasp(busy, 9, at);
  const mvs_tool_state before = state_of(busy, mine);
  MUST(mvs_replay_plan(busy, made.text, made.size, &replay));
  CHECK(replay.same_valve == 0 && replay.same_result == 0);
  /* the simulator's own tool, and the grasp that the plan did not remove */
  CHECK(tool_count(busy) == 2);
  const mvs_tool_state after = state_of(busy, mine);
  CHECK(after.node == before.node);
  CHECK(is_same_place(after.position, before.position));
  const mvs_tool_state moved = state_of(busy, mine + 1), there = state_of(sim, mine);
  CHECK(moved.node == there.node);
  CHECK(is_same_place(moved.position, there.position));
  /* the result has a history of its own: its plan replays to it from the open valve */
  mvs_sim *third = make_sim();
  const plan both = plan_of(busy);
  MUST(mvs_replay_plan(third, both.text, both.size, &replay));
  CHECK(replay.same_valve == 1 && replay.same_result == 1);
  CHECK(same_hash(sim_hash(third), sim_hash(busy)));
  /* the plan applies a second time to its own result */
  MUST(mvs_replay_plan(busy, made.text, made.size, NULL));
  CHECK(tool_count(busy) == 3);
  CHECK(is_same_place(state_of(busy, mine).position, before.position));
  free(made.text);
  free(both.text);
  mvs_destroy(sim);
  mvs_destroy(busy);
  mvs_destroy(third);
}

static void refused(mvs_sim *sim, const char *step, const char *word) {
  char text[600];
  const int size = snprintf(text, sizeof text,
                            "{\"format\": \"mvs-plan\", \"version\": 1, \"steps\": [%s]}", step);
  const hash128 before = sim_hash(sim);
  MUST_FAIL(mvs_replay_plan(sim, text, (uint64_t)size, NULL), MVS_E_FORMAT, word);
  CHECK(same_hash(before, sim_hash(sim)));
}

static void wrong_trajectories_are_refused(void) {
  mvs_sim *sim = make_sim();
  const char hands[] =
      "{\"do\": \"tool_trajectory\", \"count\": 1, \"tools\": [{\"tool\": 281474976710656, "
      "\"kind\": "
      "\"grasp\"}], \"points_m\": ";
  const struct {
    const char *rest, *word;
  } wrong[] = {
      {"\"\"}", "points_m with the same"},
      {"\"AAAAAAAAAAA=\"}", "points_m with the same"},
      {"\"AAA\"}", "base64"},
      {"\"AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA\", \"steps_per_row\": \"AAAAAA==\"}", "steps_per_row"},
      {"\"AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA\", \"steps_per_row\": \"AgAAAA==\"}",
       "whose sum is count"},
      {"\"AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA\", \"speed\": 1}", "speed"},
      {"\"AAAAAAAA+H8AAAAAAAAAAAAAAAAAAAAA\"}", "points_m with the same"}, /* not a number */
  };
  for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
    char step[400];
    snprintf(step, sizeof step, "%s%s", hands, wrong[k].rest);
    refused(sim, step, wrong[k].word);
  }
  refused(sim, "{\"do\": \"tool_trajectory\", \"count\": 0, \"tools\": [], \"points_m\": \"\"}",
          "has to have tools");
  mvs_destroy(sim);
}

int main(void) {
  a_plan_moves_tools_to_the_same_bits();
  looking_on_changes_no_plan();
  a_session_keeps_what_hands_did();
  a_plan_touches_no_tool_that_was_held();
  wrong_trajectories_are_refused();
  return finish("trajectories");
}
