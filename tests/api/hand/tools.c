/* Instruments through the C interface: life cycle, refused calls, and the calls that keep or remove
 * them. */
#include <math.h>
#include <pthread.h>
#include <stdlib.h>

#include "tests/api/check.h"
#include "tests/api/hand/small_valve.h"
#include "tests/api/hand/tool_count.h"
#include "tests/api/saved.h"

static void steps(mvs_sim *of, int count) {
  for (int k = 0; k < count; ++k) MUST(mvs_step(of, NULL));
}

/* The first vertex of the free edge of a small valve under some load in *node, its place in at. */
static void start_at_edge(uint32_t *node, double at[3]) {
  mvs_view edge, x;
  start();
  const mvs_snapshot *snapshot = present(sim);
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_FREE_EDGE_NODES, &edge));
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_NODE_POSITION, &x));
  *node = ((const uint32_t *)edge.data)[0];
  memcpy(at, (const double *)x.data + 3 * *node, 3 * sizeof *at);
  mvs_snapshot_release(snapshot);
}

static mvs_tool_desc grasp_at(const double at[3]) {
  mvs_tool_desc desc = {.struct_size = sizeof desc, .kind = MVS_TOOL_KIND_GRASP};
  memcpy(desc.position, at, sizeof desc.position);
  return desc;
}

static void a_grasp_takes_the_nearest_vertex_and_is_moved_and_let_go(void) {
  uint32_t node, count = 9;
  double at[3];
  mvs_id tool = 0;
  start_at_edge(&node, at);
  const hash128 before = sim_hash(sim);
  at[2] += 1e-4;
  mvs_tool_desc desc = grasp_at(at);
  MUST(mvs_add_tool(sim, &desc, &tool));
  mvs_tool_state held = state_of(sim, tool);
  CHECK(held.id == tool && held.kind == MVS_TOOL_KIND_GRASP && held.node == node &&
        held.touching == 1);
  CHECK(held.stiffness == 200 && held.max_force == 5);
  /* the spring at its present length, pulling the hand down */
  CHECK(fabs(held.force[2] + 200 * 1e-4) < 1e-12);
  CHECK(!same_hash(before, sim_hash(sim)));

  /* a move has no effect until a step begins with it */
  const hash128 added = sim_hash(sim);
  at[2] += 3e-3;
  MUST(mvs_move_tool(sim, tool, at, NULL));
  CHECK(same_hash(added, sim_hash(sim)));
  steps(sim, 20);
  held = state_of(sim, tool);
  CHECK(held.position[2] == at[2]);
  CHECK(held.force[2] < -0.01 && held.proxy[2] > at[2] - 3.1e-3);

  MUST(mvs_remove_tool(sim, tool));
  const mvs_snapshot *snapshot = present(sim);
  MUST(mvs_snapshot_get_tool_count(snapshot, &count));
  CHECK(count == 0);
  MUST_FAIL(mvs_snapshot_get_tool(snapshot, 0, &held), MVS_E_ARGUMENT, "has 0 tools");
  mvs_snapshot_release(snapshot);
  MUST_FAIL(mvs_get_tool(sim, tool, &held), MVS_E_ID, "does not exist");
  MUST_FAIL(mvs_move_tool(sim, tool, at, NULL), MVS_E_ID, "does not exist");
  MUST_FAIL(mvs_remove_tool(sim, tool), MVS_E_ID, "does not exist");
  MUST_FAIL(mvs_remove_tool(sim, 17), MVS_E_ID, "not that of a tool");
}

static void what_cannot_be_is_refused_and_changes_nothing(void) {
  uint32_t node;
  double at[3], nowhere[3] = {0, NAN, 0}, flat[3] = {0, 0, 0};
  mvs_id tool = 0;
  start_at_edge(&node, at);
  const hash128 before = sim_hash(sim);
  mvs_tool_state rod = {.struct_size = sizeof rod};
  mvs_tool_desc good = grasp_at(at), bad = good;
  MUST_FAIL(mvs_add_tool(NULL, &good, &tool), MVS_E_ARGUMENT, "null");
  MUST_FAIL(mvs_add_tool(sim, NULL, &tool), MVS_E_ARGUMENT, "null");
  MUST_FAIL(mvs_add_tool(sim, &good, NULL), MVS_E_ARGUMENT, "null");
#define REFUSED(field, value, code, word)                    \
  do {                                                       \
    bad = good;                                              \
    bad.field = (value);                                     \
    MUST_FAIL(mvs_add_tool(sim, &bad, &tool), (code), word); \
  } while (0)
  REFUSED(struct_size, 0, MVS_E_ARGUMENT, "struct_size");
  REFUSED(kind, 0, MVS_E_ARGUMENT, "MVS_TOOL_");
  REFUSED(kind, 5, MVS_E_ARGUMENT, "MVS_TOOL_");
  REFUSED(position[1], NAN, MVS_E_ARGUMENT, "within 10");
  REFUSED(position[1], 11, MVS_E_ARGUMENT, "within 10");
  REFUSED(position[1], 9, MVS_E_ARGUMENT, "no free vertex");
  REFUSED(radius, 1, MVS_E_ARGUMENT, "desc.radius");
  REFUSED(length, -1, MVS_E_ARGUMENT, "desc.length");
  REFUSED(stiffness, INFINITY, MVS_E_ARGUMENT, "desc.stiffness");
  REFUSED(max_force, NAN, MVS_E_ARGUMENT, "desc.max_force");
  REFUSED(reach, -1, MVS_E_ARGUMENT, "desc.reach");
  REFUSED(by_node, 2, MVS_E_ARGUMENT, "desc.by_node");
  good.by_node = 1;
  REFUSED(node, 100000, MVS_E_ARGUMENT, "nodes");
  REFUSED(kind, MVS_TOOL_KIND_BALL, MVS_E_STATE, "would lie in leaflet tissue");
  REFUSED(kind, MVS_TOOL_KIND_ROD, MVS_E_STATE, "would lie in leaflet tissue");
  bad = good;
  bad.kind = MVS_TOOL_KIND_ROD;
  bad.axis[0] = NAN;
  MUST_FAIL(mvs_add_tool(sim, &bad, &tool), MVS_E_ARGUMENT, "direction");
  bad.axis[0] = 0;
  bad.position[2] = 9; /* mm */
  MUST_FAIL(mvs_add_tool(sim, &bad, &tool), MVS_E_ARGUMENT, "positions are in m, in the frame");
  CHECK(tool == 0);
  CHECK(same_hash(before, sim_hash(sim)));
  bad.position[2] = 0.06;
  bad.axis[0] = bad.axis[1] = 4.94e-324; /* the least number: still a direction */
  MUST(mvs_add_tool(sim, &bad, &tool));
  MUST(mvs_get_tool(sim, tool, &rod));
  CHECK(rod.axis[0] > 0.7071 && rod.axis[0] == rod.axis[1]);
  MUST_FAIL(mvs_move_tool(sim, tool, NULL, NULL), MVS_E_ARGUMENT, "null");
  MUST_FAIL(mvs_move_tool(sim, tool, nowhere, NULL), MVS_E_ARGUMENT, "within 10");
  MUST_FAIL(mvs_move_tool(sim, tool, at, flat), MVS_E_ARGUMENT, "direction");
  const mvs_step_options explicitly = {sizeof explicitly, MVS_SOLVER_EXPLICIT, 0, 0, 0, 0};
  MUST_FAIL(mvs_step(sim, &explicitly), MVS_E_UNSUPPORTED, "explicit solver");
  for (int k = 1; k < MVS_MAX_TOOLS; ++k) MUST(mvs_add_tool(sim, &bad, &tool));
  MUST_FAIL(mvs_add_tool(sim, &bad, &tool), MVS_E_STATE, "there are 64 tools");
}

static void a_node_of_the_annulus_cannot_be_held(void) {
  uint32_t node;
  double at[3];
  mvs_view annulus;
  mvs_id tool = 0;
  start_at_edge(&node, at);
  const mvs_snapshot *snapshot = present(sim);
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_ANNULUS_NODES, &annulus));
  mvs_tool_desc desc = grasp_at(at);
  desc.by_node = 1;
  desc.node = ((const uint32_t *)annulus.data)[0];
  MUST_FAIL(mvs_add_tool(sim, &desc, &tool), MVS_E_ARGUMENT, "only free nodes");
  mvs_snapshot_release(snapshot);
}

/* A grasp that pulls, a ball that is pushed down the orifice, after ten steps. */
static void make_work(mvs_id tools[2]) {
  uint32_t node;
  double at[3];
  start_at_edge(&node, at);
  mvs_tool_desc grasp = grasp_at(at),
                ball = {.struct_size = sizeof ball, .kind = MVS_TOOL_KIND_BALL};
  ball.position[2] = 0.02;
  MUST(mvs_add_tool(sim, &grasp, &tools[0]));
  MUST(mvs_add_tool(sim, &ball, &tools[1]));
  for (int k = 0; k < 10; ++k) {
    at[2] += 2e-4;
    ball.position[2] -= 1e-3;
    MUST(mvs_move_tool(sim, tools[0], at, NULL));
    MUST(mvs_move_tool(sim, tools[1], ball.position, NULL));
    steps(sim, 1);
  }
}

static void undo_and_restore_bring_tools_back(void) {
  mvs_id tools[2];
  make_work(tools);
  const hash128 worked = sim_hash(sim);
  const mvs_snapshot *then = present(sim);
  mvs_op_annulus_scale smaller = {{sizeof smaller, MVS_OP_ANNULUS_SCALE}, 0.97, 0, 0};
  MUST(mvs_apply_op(sim, &smaller.op, NULL));
  /* an operation keeps the tools on all remaining nodes */
  CHECK(state_of(sim, tools[0]).id == tools[0]);
  MUST(mvs_remove_tool(sim, tools[0]));
  MUST(mvs_remove_tool(sim, tools[1]));
  MUST(mvs_undo(sim));
  CHECK(same_hash(worked, sim_hash(sim)));
  CHECK(state_of(sim, tools[1]).kind == MVS_TOOL_KIND_BALL);
  steps(sim, 5);
  const hash128 on = sim_hash(sim);
  const double away[3] = {0, 0, 0.05};
  MUST(mvs_move_tool(sim, tools[1], away, NULL));
  MUST(mvs_restore(sim, then)); /* discards the pending move */
  CHECK(same_hash(worked, sim_hash(sim)));
  steps(sim, 5);
  CHECK(same_hash(on, sim_hash(sim)));
  mvs_snapshot_release(then);
}

static void an_obj_file_is_without_tools(void) {
  mvs_id tools[2];
  make_work(tools);
  mvs_sim *other = saved_and_loaded(sim, MVS_FORMAT_OBJ);
  CHECK(tool_count(other) == 0);
  mvs_destroy(other);
}

static void a_session_keeps_tools_and_the_steps_to_come(void) {
  mvs_id tools[2];
  make_work(tools);
  mvs_sim *other = saved_and_loaded(sim, MVS_FORMAT_H5);
  CHECK(same_hash(sim_hash(sim), sim_hash(other)));
  steps(sim, 50);
  steps(other, 50);
  CHECK(same_hash(sim_hash(sim), sim_hash(other)));
  const mvs_tool_state one = state_of(sim, tools[1]), two = state_of(other, tools[1]);
  CHECK(same_bits(&one, &two, sizeof one));
  mvs_destroy(other);
}

static void a_plan_does_with_tools_what_was_done(void) {
  uint64_t size = 0;
  mvs_id tools[2];
  mvs_replay replay = {.struct_size = sizeof replay};
  mvs_op_annulus_scale smaller = {{sizeof smaller, MVS_OP_ANNULUS_SCALE}, 0.97, 0, 0};
  const double axis[3] = {0, 1, 1}, up[3] = {0, 0, 0.03};
  mvs_tool_desc rod = {.struct_size = sizeof rod, .kind = MVS_TOOL_KIND_ROD};
  mvs_id third = 0;
  make_work(tools);
  MUST(mvs_apply_op(sim, &smaller.op, NULL));
  MUST(mvs_remove_tool(sim, tools[0]));
  rod.position[2] = 0.04;
  MUST(mvs_add_tool(sim, &rod, &third));
  MUST(mvs_move_tool(sim, third, up, axis));
  steps(sim, 3);
  const hash128 done = sim_hash(sim);
  const mvs_snapshot *snapshot = present(sim);
  MUST(mvs_write_plan(snapshot, NULL, NULL, 0, &size));
  char *text = malloc(size);
  if (!text) exit(2);
  MUST(mvs_write_plan(snapshot, NULL, text, size, &size));
  mvs_snapshot_release(snapshot);
  new_valve();
  MUST(mvs_replay_plan(sim, text, size, &replay));
  CHECK(replay.same_result == 1);
  CHECK(same_hash(done, sim_hash(sim)));
  free(text);
}

/* A hand that moves in a thread of its own, as fast as it can. */
typedef struct hand {
  mvs_id tool;
  double at[3];
  int bad;
} hand;

static void *move_on(void *user) {
  hand *h = user;
  for (int k = 0; k < 2000; ++k) {
    h->at[2] += 1e-6;
    h->bad |= mvs_move_tool(sim, h->tool, h->at, NULL) != MVS_OK;
  }
  return NULL;
}

static void a_hand_moves_from_another_thread(void) {
  uint32_t node;
  pthread_t thread;
  hand h = {0, {0, 0, 0}, 0};
  start_at_edge(&node, h.at);
  mvs_tool_desc desc = grasp_at(h.at);
  MUST(mvs_add_tool(sim, &desc, &h.tool));
  if (pthread_create(&thread, NULL, move_on, &h)) exit(2);
  steps(sim, 10);
  pthread_join(thread, NULL);
  CHECK(!h.bad);
  steps(sim, 1);
  /* the last position, independent of the earlier ones */
  CHECK(state_of(sim, h.tool).position[2] == h.at[2]);
}

static void a_failed_settle_keeps_what_the_hand_wants(void) {
  uint32_t node;
  double at[3];
  mvs_id tool = 0;
  start_at_edge(&node, at);
  mvs_tool_desc desc = grasp_at(at);
  MUST(mvs_add_tool(sim, &desc, &tool));
  const hash128 before = sim_hash(sim);
  at[2] += 1e-3;
  MUST(mvs_move_tool(sim, tool, at, NULL));
  const mvs_step_options wrong = {sizeof wrong, MVS_SOLVER_EXPLICIT, 0.5, 0, 0, 0};
  MUST_FAIL(mvs_step(sim, &wrong), MVS_E_DIVERGED, "diverged");
  CHECK(same_hash(before, sim_hash(sim)));
  steps(sim, 1);
  CHECK(state_of(sim, tool).position[2] == at[2]);
}

int main(void) {
  MUST(mvs_create(NULL, &sim));
  a_grasp_takes_the_nearest_vertex_and_is_moved_and_let_go();
  what_cannot_be_is_refused_and_changes_nothing();
  a_node_of_the_annulus_cannot_be_held();
  undo_and_restore_bring_tools_back();
  an_obj_file_is_without_tools();
  a_session_keeps_tools_and_the_steps_to_come();
  a_plan_does_with_tools_what_was_done();
  a_hand_moves_from_another_thread();
  a_failed_settle_keeps_what_the_hand_wants();
  mvs_destroy(sim);
  return finish("tools");
}
