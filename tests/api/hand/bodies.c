/* Convex tools through the C interface: a hook of three bodies is added, turned, felt, saved and
 * replayed; bodies of all kinds are read back. body_faults.c tests the refusals. */
#include <math.h>
#include <stdlib.h>

#include "hook.h"
#include "tests/api/check.h"
#include "tests/api/saved.h"

static void a_hook_follows_the_pose_of_its_hand(void) {
  const mvs_id tool = make_work();
  const double length = sqrt(1 + 0.2 * 0.2), still[3] = {0, 0, 0.02};
  mvs_tool_state state = state_of(sim, tool);
  CHECK(state.kind == MVS_TOOL_KIND_CONVEX && state.body_count == 3);
  CHECK(state.vertex_count == 2 + 8 + MVS_BODY_CIRCLE_VERTICES + 1);
  CHECK(fabs(state.orientation[0] - 1 / length) < 1e-15);
  CHECK(fabs(state.orientation[3] - 0.2 / length) < 1e-15);
  CHECK(state.distance > 0 && state.node == UINT32_MAX);
  /* where nothing blocks it, the proxy comes to rest at the hand */
  MUST(mvs_move_tool_pose(sim, tool, still, NULL));
  for (int k = 0; k < 200; ++k) MUST(mvs_step(sim, NULL));
  state = state_of(sim, tool);
  CHECK(state.touching == 0);
  for (int k = 0; k < 4; ++k) CHECK(fabs(state.proxy_orientation[k] - state.orientation[k]) < 1e-6);
  for (int k = 0; k < 3; ++k) CHECK(fabs(state.proxy[k] - state.position[k]) < 1e-6);
  for (int k = 0; k < 3; ++k) CHECK(fabs(state.force[k]) < 1e-3 && fabs(state.torque[k]) < 1e-5);
}

/* Only rods have an axis. */
static void an_axis_leaves_the_pose_of_a_hook(void) {
  const mvs_id tool = make_work();
  const double still[3] = {0, 0, 0.02}, axis[3] = {0, 0, 1};
  const double quarter[4] = {sqrt(0.5), 0, 0, sqrt(0.5)};
  MUST(mvs_move_tool_pose(sim, tool, still, quarter));
  MUST(mvs_move_tool(sim, tool, still, axis));
  MUST(mvs_step(sim, NULL));
  const mvs_tool_state state = state_of(sim, tool);
  for (int k = 0; k < 4; ++k) CHECK(fabs(state.orientation[k] - quarter[k]) < 1e-15);
}

static void check_body(const mvs_snapshot *snapshot, uint32_t body, uint64_t vertices,
                       uint64_t triangles) {
  mvs_tool_body read = {.struct_size = sizeof read};
  MUST(mvs_snapshot_get_tool_body(snapshot, 0, body, &read));
  CHECK(read.kind == hook[body].kind && read.radius == hook[body].radius);
  CHECK(read.vertices.count == vertices && read.vertices.components == 3);
  CHECK(read.triangles.count == triangles && read.triangles.type == MVS_TYPE_U32);
}

static void bodies_are_read_back(void) {
  mvs_tool_body read = {.struct_size = sizeof read};
  make_work();
  const mvs_snapshot *snapshot = present(sim);
  check_body(snapshot, 0, 2, 0);
  check_body(snapshot, 1, 8, 12);
  /* a cone: 24 sides, and 22 triangles of its base */
  check_body(snapshot, 2, 25, 46);
  MUST(mvs_snapshot_get_tool_body(snapshot, 0, 1, &read));
  const double *at = read.vertices.data;
  CHECK(fabs(at[0]) < 1e-15 && fabs(at[1] + 0.5e-3) < 1e-15);
  MUST_FAIL(mvs_snapshot_get_tool_body(snapshot, 0, 3, &read), MVS_E_ARGUMENT, "3 bodies");
  MUST_FAIL(mvs_snapshot_get_tool_body(snapshot, 1, 0, &read), MVS_E_ARGUMENT, "1 tools");
  MUST_FAIL(mvs_snapshot_get_tool_body(snapshot, 0, 0, NULL), MVS_E_ARGUMENT, "null");
  MUST_FAIL(mvs_snapshot_get_tool_body(NULL, 0, 0, &read), MVS_E_ARGUMENT, "null");
  mvs_snapshot_release(snapshot);
}

/* 16 bodies of all kinds, 4 mm apart along the shaft. */
static void a_tool_has_up_to_sixteen_bodies_of_all_kinds(void) {
  static const double corner[12] = {0, 0, 0, 1e-3, 0, 0, 0, 1e-3, 0, 0, 0, 1e-3};
  static const uint32_t vertices[] = {
      0, 4, 1, 2, 8, 2 * MVS_BODY_CIRCLE_VERTICES, MVS_BODY_CIRCLE_VERTICES + 1};
  mvs_body_desc bodies[MVS_MAX_BODIES] = {0};
  mvs_tool_body read = {.struct_size = sizeof read};
  double shifted[MVS_MAX_BODIES][12];
  const double rounding = 3e-17; /* m, of heights up to 62 mm: 7e-18 in each of some operations */
  uint32_t all = 0;
  mvs_id tool = 0;
  start();
  for (uint32_t k = 0; k < MVS_MAX_BODIES; ++k) {
    mvs_body_desc *const body = &bodies[k];
    const double height = 4e-3 * k;
    body->kind = 1 + k % 6;
    all += vertices[body->kind];
    body->position[2] = height;
    body->end[2] = height + 2e-3;
    body->radius = 0.2e-3;
    for (int c = 0; c < 3; ++c) body->size[c] = 1e-3;
    if (body->kind != MVS_BODY_KIND_HULL) continue;
    for (int c = 0; c < 12; ++c) shifted[k][c] = corner[c] + (c % 3 == 2 ? height : 0);
    body->vertices = (mvs_array){shifted[k], 4, 3, MVS_TYPE_F64, 0};
  }
  mvs_tool_desc desc = hook_at(0.03);
  desc.bodies = bodies;
  desc.body_count = MVS_MAX_BODIES;
  MUST(mvs_add_tool(sim, &desc, &tool));
  MUST(mvs_step(sim, NULL));
  CHECK(state_of(sim, tool).body_count == MVS_MAX_BODIES);
  CHECK(state_of(sim, tool).vertex_count == all);
  const mvs_snapshot *snapshot = present(sim);
  for (uint32_t k = 0; k < MVS_MAX_BODIES; ++k) {
    MUST(mvs_snapshot_get_tool_body(snapshot, 0, k, &read));
    CHECK(read.kind == bodies[k].kind && read.vertices.count == vertices[read.kind]);
    const double *const at = read.vertices.data;
    for (uint64_t v = 0; v < read.vertices.count; ++v) {
      const double *const p = at + 3 * v, z = p[2] - bodies[k].position[2];
      if (read.kind == MVS_BODY_KIND_CYLINDER) {
        /* corners lie on the circle */
        CHECK(fabs(hypot(p[0], p[1]) - 1e-3) < rounding);
        CHECK(fabs(z) < rounding || fabs(z - 2e-3) < rounding);
      }
      if (read.kind == MVS_BODY_KIND_CONE) {
        CHECK(fabs(hypot(p[0], p[1]) - (fabs(z) < rounding ? 1e-3 : 0)) < rounding);
      }
    }
  }
  mvs_snapshot_release(snapshot);
}

static void a_rod_takes_the_z_axis_of_a_pose(void) {
  mvs_id tool = 0;
  const double at[3] = {0, 0, 0.04}, quarter[4] = {1, 1, 0, 0};
  start();
  mvs_tool_desc rod = {.struct_size = sizeof rod, .kind = MVS_TOOL_KIND_ROD};
  rod.position[2] = 0.04;
  MUST(mvs_add_tool(sim, &rod, &tool));
  MUST(mvs_move_tool_pose(sim, tool, at, quarter));
  MUST(mvs_step(sim, NULL));
  const mvs_tool_state state = state_of(sim, tool);
  CHECK(fabs(state.axis[1] + 1) < 1e-15 && state.orientation[0] == 0);
}

static void undo_and_restore_bring_a_hook_back(void) {
  const mvs_id tool = make_work();
  const hash128 worked = sim_hash(sim);
  const mvs_snapshot *then = present(sim);
  mvs_op_annulus_scale smaller = {{sizeof smaller, MVS_OP_ANNULUS_SCALE}, 0.97, 0, 0};
  MUST(mvs_apply_op(sim, &smaller.op, NULL));
  CHECK(state_of(sim, tool).body_count == 3);
  MUST(mvs_remove_tool(sim, tool));
  MUST(mvs_undo(sim));
  CHECK(same_hash(worked, sim_hash(sim)));
  for (int k = 0; k < 5; ++k) MUST(mvs_step(sim, NULL));
  const hash128 on = sim_hash(sim);
  MUST(mvs_restore(sim, then));
  CHECK(same_hash(worked, sim_hash(sim)));
  for (int k = 0; k < 5; ++k) MUST(mvs_step(sim, NULL));
  CHECK(same_hash(on, sim_hash(sim)));
  mvs_snapshot_release(then);
}

/* After an undo the next tool has the id of the undone one, and may be of another shape. */
static void a_tool_of_the_same_id_has_its_own_shape(void) {
  mvs_id first = 0, second = 0;
  mvs_op_annulus_scale smaller = {{sizeof smaller, MVS_OP_ANNULUS_SCALE}, 0.97, 0, 0};
  start();
  MUST(mvs_apply_op(sim, &smaller.op, NULL));
  mvs_tool_desc desc = hook_at(0.02);
  MUST(mvs_add_tool(sim, &desc, &first));
  MUST(mvs_step(sim, NULL));
  MUST(mvs_undo(sim));
  desc.body_count = 1;
  MUST(mvs_add_tool(sim, &desc, &second));
  CHECK(first == second);
  MUST(mvs_step(sim, NULL));
  const hash128 after = sim_hash(sim);
  CHECK(state_of(sim, second).body_count == 1);
  start();
  MUST(mvs_add_tool(sim, &desc, &first));
  MUST(mvs_step(sim, NULL));
  CHECK(same_hash(after, sim_hash(sim)));
}

static void a_session_keeps_a_hook_and_the_steps_to_come(void) {
  const mvs_id tool = make_work();
  mvs_sim *other = saved_and_loaded(sim, MVS_FORMAT_H5);
  CHECK(same_hash(sim_hash(sim), sim_hash(other)));
  for (int k = 0; k < 20; ++k) {
    MUST(mvs_step(sim, NULL));
    MUST(mvs_step(other, NULL));
  }
  CHECK(same_hash(sim_hash(sim), sim_hash(other)));
  const mvs_tool_state one = state_of(sim, tool), two = state_of(other, tool);
  CHECK(same_bits(&one, &two, sizeof one));
  mvs_destroy(other);
}

static void a_plan_does_with_a_hook_what_was_done(void) {
  uint64_t size = 0;
  mvs_replay replay = {.struct_size = sizeof replay};
  const double at[3] = {1e-3, 0, 0.012}, turn[4] = {1, 0.1, 0.2, 0.3};
  const mvs_id tool = make_work();
  MUST(mvs_move_tool_pose(sim, tool, at, turn));
  MUST(mvs_settle(sim, NULL, NULL));
  const hash128 done = sim_hash(sim);
  const mvs_snapshot *snapshot = present(sim);
  MUST(mvs_write_plan(snapshot, NULL, NULL, 0, &size));
  char *text = malloc(size);
  if (!text) exit(2);
  MUST(mvs_write_plan(snapshot, NULL, text, size, &size));
  mvs_snapshot_release(snapshot);
  start();
  MUST(mvs_replay_plan(sim, text, size, &replay));
  CHECK(replay.same_result == 1);
  CHECK(same_hash(done, sim_hash(sim)));
  free(text);
}

int main(void) {
  MUST(mvs_create(NULL, &sim));
  a_hook_follows_the_pose_of_its_hand();
  an_axis_leaves_the_pose_of_a_hook();
  bodies_are_read_back();
  a_tool_has_up_to_sixteen_bodies_of_all_kinds();
  a_rod_takes_the_z_axis_of_a_pose();
  undo_and_restore_bring_a_hook_back();
  a_tool_of_the_same_id_has_its_own_shape();
  a_session_keeps_a_hook_and_the_steps_to_come();
  a_plan_does_with_a_hook_what_was_done();
  mvs_destroy(sim);
  return finish("bodies");
}
