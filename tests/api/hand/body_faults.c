/* Wrong bodies of convex tools are refused with a sentence, by calls and in plans, and change
 * nothing; hulls that are not convex are hulled with a warning, or refused by option. */
#include <math.h>

#include "hook.h"
#include "tests/api/check.h"
#include "tests/api/saved.h"

static int warnings;

static void count_warnings(void *user, mvs_log_level level, const char *line) {
  (void)user;
  if (level == MVS_LOG_WARNING && strstr(line, "no corners of their convex hull")) ++warnings;
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
  a_wrong_tool_changes_nothing();
  a_wrong_pose_changes_nothing();
  a_dented_hull_is_hulled_with_a_warning_or_refused();
  a_plan_with_wrong_bodies_is_refused();
  mvs_destroy(sim);
  return finish("body_faults");
}
