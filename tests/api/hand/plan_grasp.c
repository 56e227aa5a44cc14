/* A plan with a grasp: the same node on the same valve, the same place on another mesh. */
#include <math.h>
#include <stdlib.h>

#include "tests/api/check.h"

static mvs_sim *made_with(uint32_t vertices) {
  mvs_sim *sim = NULL;
  mvs_parametric_desc shape = {.struct_size = sizeof shape, .vertices = vertices};
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_generate_valve(sim, &shape));
  return sim;
}

static void position_of(mvs_sim *sim, uint32_t node, double at[3]) {
  const mvs_snapshot *snapshot = NULL;
  mvs_view x;
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_NODE_POSITION, &x));
  memcpy(at, (const double *)x.data + 3 * node, 3 * sizeof *at);
  mvs_snapshot_release(snapshot);
}

static double distance(const double a[3], const double b[3]) {
  return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
              (a[2] - b[2]) * (a[2] - b[2]));
}

/* The node of the only tool. */
static uint32_t held_node(mvs_sim *sim) {
  const mvs_snapshot *snapshot = NULL;
  mvs_tool_state tool = {.struct_size = sizeof tool};
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST(mvs_snapshot_get_tool(snapshot, 0, &tool));
  mvs_snapshot_release(snapshot);
  return tool.node;
}

/* The plan of a grasp; free it. */
static char *plan_of_grasp(mvs_sim *sim, uint32_t node, uint64_t *size) {
  mvs_tool_desc desc = {
      .struct_size = sizeof desc, .kind = MVS_TOOL_KIND_GRASP, .by_node = 1, .node = node};
  const mvs_snapshot *snapshot = NULL;
  mvs_id tool = 0;
  position_of(sim, node, desc.position);
  MUST(mvs_add_tool(sim, &desc, &tool));
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST(mvs_write_plan(snapshot, NULL, NULL, 0, size));
  char *plan = malloc(*size);
  MUST(mvs_write_plan(snapshot, NULL, plan, *size, size));
  mvs_snapshot_release(snapshot);
  return plan;
}

static void a_grasp_is_at_the_same_place_on_another_mesh(void) {
  mvs_sim *from = made_with(425);
  const mvs_snapshot *snapshot = NULL;
  mvs_view edge;
  MUST(mvs_get_snapshot(from, &snapshot));
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_FREE_EDGE_NODES, &edge));
  uint32_t nodes[4];
  for (int k = 0; k < 4; ++k) nodes[k] = ((const uint32_t *)edge.data)[k * (edge.count / 4)];
  mvs_snapshot_release(snapshot);
  for (int k = 0; k < 4; ++k) {
    mvs_sim *same = made_with(425), *other = made_with(800), *recorded = made_with(425);
    double at[3], there[3];
    uint64_t size = 0;
    char *plan = plan_of_grasp(recorded, nodes[k], &size);
    mvs_replay replay = {.struct_size = sizeof replay};
    MUST(mvs_replay_plan(same, plan, size, &replay));
    CHECK(replay.same_valve && replay.same_result && held_node(same) == nodes[k]);
    MUST(mvs_check_plan(other, plan, size, &replay));
    MUST(mvs_replay_plan(other, plan, size, &replay));
    CHECK(!replay.same_valve);
    position_of(same, nodes[k], at);
    position_of(other, held_node(other), there);
    /* an edge of the coarser mesh; the node of the same number is centimetres away */
    CHECK(distance(at, there) < 3e-3);
    free(plan);
    mvs_destroy(same);
    mvs_destroy(other);
    mvs_destroy(recorded);
  }
  mvs_destroy(from);
}

static void a_place_is_read_strictly_and_may_be_missing(void) {
  const char *pattern =
      "{\"format\": \"mvs-plan\", \"version\": 1, \"steps\": [{\"do\": \"tool_add\", \"tool\": "
      "281474976710656, \"kind\": \"grasp\", \"position_m\": [0, 0, 0], \"stiffness_N/m\": 200, "
      "\"max_force_N\": 5, \"node\": 200%s}]}";
  char plan[512];
  mvs_sim *sim = made_with(425);
  snprintf(plan, sizeof plan, pattern,
           ", \"place\": {\"scallop\": \"P9\", \"along\": 0.5, \"height\": 1}");
  MUST_FAIL(mvs_check_plan(sim, plan, strlen(plan), NULL), MVS_E_ID, "P9");
  MUST_FAIL(mvs_replay_plan(sim, plan, strlen(plan), NULL), MVS_E_ID, "P9");
  snprintf(plan, sizeof plan, pattern,
           ", \"place\": {\"scallop\": \"P2\", \"along\": 7, \"height\": 1}");
  MUST_FAIL(mvs_check_plan(sim, plan, strlen(plan), NULL), MVS_E_FORMAT, "along");
  snprintf(plan, sizeof plan, pattern, ", \"place\": 3");
  MUST_FAIL(mvs_check_plan(sim, plan, strlen(plan), NULL), MVS_E_FORMAT, "place");
  /* the plan of an older version */
  snprintf(plan, sizeof plan, pattern, "");
  MUST(mvs_replay_plan(sim, plan, strlen(plan), NULL));
  CHECK(held_node(sim) == 200);
  mvs_destroy(sim);
}

int main(void) {
  a_grasp_is_at_the_same_place_on_another_mesh();
  a_place_is_read_strictly_and_may_be_missing();
  return finish("plan_grasp");
}
