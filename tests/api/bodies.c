/* Convex tools through the C interface: a hook of three bodies is added, turned, felt, saved and
 * replayed; wrong bodies are refused. */
#include <math.h>
#include <stdlib.h>

#include "check.h"
#include "saved.h"

static mvs_sim *sim;
static int warnings;

static void count_warnings(void *user, mvs_log_level level, const char *line) {
  (void)user;
  if (level == MVS_LOG_WARNING && strstr(line, "no corners of their convex hull")) ++warnings;
}

static void start(void) {
  mvs_parametric_desc small = {
      .struct_size = sizeof small, .vertices = 200, .shape = MVS_SHAPE_FOUNDING};
  mvs_load_case load = {sizeof load, 0, 2000, 0.2};
  MUST(mvs_generate_valve(sim, &small));
  MUST(mvs_set_load(sim, &load));
}

static mvs_tool_state state_of(mvs_sim *of, mvs_id tool) {
  mvs_tool_state state = {.struct_size = sizeof state};
  MUST(mvs_get_tool(of, tool, &state));
  return state;
}

/* A shaft, a cross bar of rounded box, and a tip that is a cone. */
static const mvs_body_desc hook[3] = {
    {.kind = MVS_BODY_KIND_CAPSULE, .end = {0, 0, 20e-3}, .radius = 0.6e-3},
    {.kind = MVS_BODY_KIND_BOX,
     .position = {2e-3, 0, 0},
     .size = {4e-3, 1e-3, 1e-3},
     .orientation = {2, 0, 0, 0},
     .radius = 0.2e-3},
    {.kind = MVS_BODY_KIND_CONE,
     .position = {4e-3, 0, 0},
     .end = {4e-3, 0, 3e-3},
     .size = {0.5e-3},
     .radius = 0.1e-3}};

static mvs_tool_desc hook_at(double height) {
  mvs_tool_desc desc = {.struct_size = sizeof desc,
                        .kind = MVS_TOOL_KIND_CONVEX,
                        .bodies = hook,
                        .body_count = 3,
                        .body_stride = sizeof *hook};
  desc.position[2] = height;
  return desc;
}

/* A hook that goes down the orifice and turns, in ten steps. */
static mvs_id make_work(void) {
  mvs_id tool = 0;
  double at[3] = {0, 0, 0.02}, turn[4] = {1, 0, 0, 0};
  start();
  mvs_tool_desc desc = hook_at(at[2]);
  MUST(mvs_add_tool(sim, &desc, &tool));
  for (int k = 0; k < 10; ++k) {
    at[2] -= 1e-3;
    turn[3] += 0.02;
    MUST(mvs_move_tool_pose(sim, tool, at, turn));
    MUST(mvs_step(sim, NULL));
  }
  return tool;
}

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

static void must_refuse(mvs_body_desc body, const char *word) {
  mvs_id tool = 0;
  mvs_tool_desc desc = hook_at(0.03);
  desc.bodies = &body;
  desc.body_count = 1;
  MUST_FAIL(mvs_add_tool(sim, &desc, &tool), MVS_E_ARGUMENT, word);
  CHECK(tool == 0);
}

static const double flat[12] = {0, 0, 0, 1e-3, 0, 0, 0, 1e-3, 0, 1e-3, 1e-3, 0};
static const double dented[15] = {0, 0, 0, 1e-3, 0, 0, 0, 1e-3, 0, 0, 0, 1e-3, 2e-4, 2e-4, 2e-4};

static mvs_body_desc hull_of(const double *vertices, uint32_t count) {
  mvs_body_desc hull = {.kind = MVS_BODY_KIND_HULL,
                        .vertices = {vertices, count, 3, MVS_TYPE_F64, 0},
                        .radius = 1e-4};
  return hull;
}

static void wrong_hulls_are_refused(void) {
  double wild[12];
  memcpy(wild, dented, sizeof wild);
  wild[4] = NAN;
  mvs_body_desc none = hull_of(NULL, 0);
  memset(&none.vertices, 0, sizeof none.vertices);
  must_refuse(none, "0 vertices");
  must_refuse(hull_of(NULL, 8), "vertices");
  must_refuse(hull_of(dented, 3), "at least 4");
  must_refuse(hull_of(flat, 4), "no volume");
  must_refuse(hull_of(wild, 4), "within 0.3");
  wild[4] = 0.4;
  must_refuse(hull_of(wild, 4), "within 0.3");
  /* 30 nm: coordinates in mm or um, taken for m */
  double tiny[12];
  for (int k = 0; k < 12; ++k) tiny[k] = 3e-5 * dented[k];
  must_refuse(hull_of(tiny, 4), "at least 0.0001 m long");
  for (int k = 0; k < 12; ++k) tiny[k] = 0.099 * dented[k];
  must_refuse(hull_of(tiny, 4), "at least 0.0001 m long");
  static double many[3 * (MVS_MAX_BODY_VERTICES + 1)];
  must_refuse(hull_of(many, MVS_MAX_BODY_VERTICES + 1), "at most 2048");
}

static void wrong_bodies_are_refused(void) {
  mvs_body_desc body = hook[0];
  body.kind = 7;
  must_refuse(body, "MVS_BODY_KIND_");
  body = hook[0];
  body.end[2] = 0;
  must_refuse(body, "no direction");
  body = hook[0];
  body.radius = 1;
  must_refuse(body, "radius");
  body = hook[0];
  body.vertices = hull_of(flat, 4).vertices;
  must_refuse(body, "only a hull");
  body = hook[1];
  body.size[1] = 0;
  must_refuse(body, "size[1]");
  body = hook[1];
  body.orientation[2] = NAN;
  must_refuse(body, "quaternion");
  body = hook[1];
  body.size[0] = 0.3;
  body.position[0] = 0.29;
  must_refuse(body, "farther than 0.3");
}

static void wrong_tools_are_refused(void) {
  mvs_id tool = 0;
  mvs_body_desc many[MVS_MAX_BODIES + 1];
  for (int k = 0; k <= MVS_MAX_BODIES; ++k) many[k] = hook[1];
  mvs_tool_desc desc = hook_at(0.03);
  desc.body_count = 0;
  MUST_FAIL(mvs_add_tool(sim, &desc, &tool), MVS_E_ARGUMENT, "1 to 16 bodies");
  desc.body_count = MVS_MAX_BODIES + 1;
  desc.bodies = many;
  MUST_FAIL(mvs_add_tool(sim, &desc, &tool), MVS_E_ARGUMENT, "1 to 16 bodies");
  desc.bodies = NULL;
  MUST_FAIL(mvs_add_tool(sim, &desc, &tool), MVS_E_ARGUMENT, "desc.bodies");
  desc = hook_at(0.03);
  desc.body_stride = 0;
  MUST_FAIL(mvs_add_tool(sim, &desc, &tool), MVS_E_ARGUMENT, "stride");
  desc = hook_at(0.03);
  desc.orientation[1] = INFINITY;
  MUST_FAIL(mvs_add_tool(sim, &desc, &tool), MVS_E_ARGUMENT, "quaternion");
  desc = hook_at(0.03);
  desc.strict_hulls = 2;
  MUST_FAIL(mvs_add_tool(sim, &desc, &tool), MVS_E_ARGUMENT, "strict_hulls");
  desc = hook_at(0.03);
  desc.kind = MVS_TOOL_KIND_BALL;
  MUST_FAIL(mvs_add_tool(sim, &desc, &tool), MVS_E_ARGUMENT, "has bodies");
  CHECK(tool == 0);
}

static void a_tool_in_tissue_is_refused(void) {
  mvs_id tool = 0;
  mvs_view edge, x;
  const mvs_snapshot *snapshot = present(sim);
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_FREE_EDGE_NODES, &edge));
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_NODE_POSITION, &x));
  mvs_tool_desc desc = hook_at(0);
  memcpy(desc.position, (const double *)x.data + 3 * ((const uint32_t *)edge.data)[0],
         sizeof desc.position);
  MUST_FAIL(mvs_add_tool(sim, &desc, &tool), MVS_E_STATE, "would lie in");
  CHECK(tool == 0);
  mvs_snapshot_release(snapshot);
}

static void a_wrong_tool_changes_nothing(void) {
  start();
  const hash128 before = sim_hash(sim);
  wrong_hulls_are_refused();
  wrong_bodies_are_refused();
  wrong_tools_are_refused();
  a_tool_in_tissue_is_refused();
  CHECK(same_hash(before, sim_hash(sim)));
}

static void a_wrong_pose_changes_nothing(void) {
  const mvs_id tool = make_work();
  const hash128 before = sim_hash(sim);
  const double at[3] = {0, 0, 0.02}, wild[4] = {1, NAN, 0, 0}, zero[4] = {0, 0, 0, 0},
               nowhere[3] = {NAN, 0, 0};
  MUST_FAIL(mvs_move_tool_pose(sim, tool, at, wild), MVS_E_ARGUMENT, "quaternion");
  MUST_FAIL(mvs_move_tool_pose(sim, tool, at, zero), MVS_E_ARGUMENT, "orientation is (0, 0, 0, 0)");
  MUST_FAIL(mvs_move_tool_pose(sim, tool, nowhere, NULL), MVS_E_ARGUMENT, "within 10");
  MUST_FAIL(mvs_move_tool_pose(sim, tool, NULL, NULL), MVS_E_ARGUMENT, "null");
  MUST_FAIL(mvs_move_tool_pose(sim, tool + 1, at, NULL), MVS_E_ID, "does not exist");
  CHECK(same_hash(before, sim_hash(sim)));
}

static void a_dented_hull_is_hulled_with_a_warning_or_refused(void) {
  mvs_id tool = 0;
  start();
  const mvs_body_desc body = hull_of(dented, 5);
  mvs_tool_desc desc = hook_at(0.03);
  desc.bodies = &body;
  desc.body_count = 1;
  desc.strict_hulls = 1;
  MUST_FAIL(mvs_add_tool(sim, &desc, &tool), MVS_E_ARGUMENT, "not convex: 1 of its 5");
  CHECK(warnings == 0);
  desc.strict_hulls = 0;
  MUST(mvs_add_tool(sim, &desc, &tool));
  CHECK(warnings == 1);
  CHECK(state_of(sim, tool).vertex_count == 4);
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

static void must_refuse_plan(const char *step, const char *word) {
  char plan[1024];
  mvs_replay replay = {.struct_size = sizeof replay};
  const int size = snprintf(plan, sizeof plan,
                            "{\"format\": \"mvs-plan\", \"version\": 1, \"steps\": [%s]}", step);
  MUST_FAIL(mvs_replay_plan(sim, plan, (uint64_t)size, &replay), MVS_E_FORMAT, word);
}

static void a_plan_with_wrong_bodies_is_refused(void) {
#define ADDED(bodies, turn)                                                                        \
  "{\"do\": \"tool_add\", \"tool\": 281474976710656, \"kind\": \"convex\", "                       \
  "\"position_m\": [0, 0, 0.03], \"stiffness_N/m\": 200, \"max_force_N\": 5, \"rodrigues\": " turn \
  ", \"bodies\": " bodies "}"
#define BODY(kind, radius, vertices) \
  "[{\"kind\": \"" kind "\", \"radius_m\": " radius ", \"vertices_m\": \"" vertices "\"}]"
  start();
  const hash128 before = sim_hash(sim);
  must_refuse_plan(ADDED("[]", "[0, 0, 0]"), "1 to 16 bodies");
  must_refuse_plan(ADDED(BODY("ball", "0.001", ""), "[0, 0, 0]"), "1 to 16 bodies");
  must_refuse_plan(ADDED(BODY("torus", "0.001", "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"), "[0, 0, 0]"),
                   "1 to 16 bodies");
  must_refuse_plan(ADDED(BODY("ball", "1", "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"), "[0, 0, 0]"),
                   "1 to 16 bodies");
  must_refuse_plan(ADDED(BODY("ball", "0.001", "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"), "[0, 2, 0]"),
                   "longer than 1");
  CHECK(same_hash(before, sim_hash(sim)));
}

int main(void) {
  mvs_sim_desc desc = {.struct_size = sizeof desc, .log = count_warnings};
  MUST(mvs_create(&desc, &sim));
  a_hook_follows_the_pose_of_its_hand();
  bodies_are_read_back();
  a_wrong_tool_changes_nothing();
  a_wrong_pose_changes_nothing();
  a_dented_hull_is_hulled_with_a_warning_or_refused();
  a_rod_takes_the_z_axis_of_a_pose();
  undo_and_restore_bring_a_hook_back();
  a_tool_of_the_same_id_has_its_own_shape();
  a_session_keeps_a_hook_and_the_steps_to_come();
  a_plan_does_with_a_hook_what_was_done();
  a_plan_with_wrong_bodies_is_refused();
  mvs_destroy(sim);
  return finish("bodies");
}
