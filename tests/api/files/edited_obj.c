/* An edited OBJ file: its state is at rest only where the forces balance. */
#include <stdlib.h>

#include "tests/api/check.h"
#include "tests/api/funnel.h"
#include "tests/founding.h"

static mvs_sim *sim, *other;
static char warned[1024];

static void take_warning(void *user, mvs_log_level level, const char *text) {
  (void)user;
  if (level == MVS_LOG_WARNING && strstr(text, "at rest")) {
    snprintf(warned, sizeof warned, "%s", text);
  }
}

/* The OBJ of the present valve. */
static char *saved(uint64_t *size) {
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST(mvs_save_memory(snapshot, MVS_FORMAT_OBJ, NULL, 0, size));
  char *text = malloc(*size + 1);
  if (!text) exit(2);
  MUST(mvs_save_memory(snapshot, MVS_FORMAT_OBJ, text, *size, size));
  mvs_snapshot_release(snapshot);
  text[*size] = 0;
  return text;
}

static int rests(mvs_sim *of) {
  const mvs_snapshot *snapshot = NULL;
  mvs_rest rest = {.struct_size = sizeof rest};
  MUST(mvs_get_snapshot(of, &snapshot));
  MUST(mvs_snapshot_get_rest(snapshot, &rest));
  mvs_snapshot_release(snapshot);
  return (int)rest.at_rest;
}

static void loads_at_rest(const char *what) {
  uint64_t size = 0;
  char *text = saved(&size);
  warned[0] = 0;
  CHECK(rests(sim));
  MUST(mvs_load_memory(other, text, size, MVS_FORMAT_OBJ));
  if (!rests(other) || warned[0]) {
    ++failures;
    printf("%s: not at rest: %s\n", what, warned);
  }
  CHECK(same_hash(sim_hash(sim), sim_hash(other)));
  free(text);
}

static void settle(mvs_load_case load, mvs_solver solver, double residual) {
  mvs_settle_options how = {.struct_size = sizeof how, .solver = solver, .residual = residual};
  mvs_stats stats = {.struct_size = sizeof stats};
  MUST(mvs_set_load(sim, &load));
  MUST(mvs_settle(sim, &how, &stats));
  CHECK(stats.converged == 1);
}

/* Springs without contact, by every solver. */
static void a_funnel_at_rest_stays_at_rest(void) {
  static funnel f;
  for (mvs_solver solver = MVS_SOLVER_NEWTON; solver <= MVS_SOLVER_EXPLICIT; ++solver) {
    for (int exact = 0; exact < 2; ++exact) {
      if (exact && solver != MVS_SOLVER_NEWTON) continue;
      make_funnel(&f);
      MUST(mvs_set_valve(sim, &f.desc));
      settle(funnel_load(), solver, exact ? 1e-10 : 0);
      loads_at_rest("a funnel");
    }
  }
  MUST(mvs_step(sim, NULL)); /* which may stand still or move */
  for (int k = 0; k < 40000 && !rests(sim); ++k) MUST(mvs_step(sim, NULL));
  loads_at_rest("a funnel after steps");
}

/* Springs and membranes, closed with contact, with a ring and without, and open. */
static void a_valve_at_rest_stays_at_rest(void) {
  static const mvs_leaflet_law laws[] = {MVS_LEAFLET_LAW_SPRING, MVS_LEAFLET_LAW_FUNG};
  const mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1},
                      none = {sizeof none, 0, 0, 0};
  for (int k = 0; k < 4; ++k) {
    mvs_parametric_desc desc = founding_valve();
    mvs_leaflet_desc tissue = {.law = laws[k / 2]};
    mvs_op_ring ring = {.op = {sizeof ring, MVS_OP_RING}, .size = 0.034};
    desc.vertices = 250;
    MUST(mvs_generate_valve(sim, &desc));
    MUST(mvs_set_leaflet(sim, 0, &tissue));
    if (k % 2) MUST(mvs_apply_op(sim, &ring.op, NULL));
    settle(systole, MVS_SOLVER_NEWTON, 0);
    loads_at_rest("a closed valve");
    settle(none, MVS_SOLVER_NEWTON, 0);
    loads_at_rest("an open valve");
  }
  mvs_parametric_desc dilated = founding_valve();
  dilated.annulus_scale = 1.1;
  MUST(mvs_generate_valve(sim, &dilated));
  settle(systole, MVS_SOLVER_NEWTON, 0);
  loads_at_rest("the founding valve, dilated under load");
}

/* Loads the file with the text at `old`, up to the next blank, replaced. */
static mvs_result load_edited(const char *text, const char *old, const char *instead) {
  char *made = malloc(strlen(text) + 200);
  const char *at = strstr(text, old);
  if (!made || !at) exit(2);
  const int size = sprintf(made, "%.*s%s%s", (int)(at - text), text, instead,
                           at + strlen(old) + strcspn(at + strlen(old), " \n"));
  warned[0] = 0;
  const mvs_result result = mvs_load_memory(other, made, (uint64_t)size, MVS_FORMAT_OBJ);
  free(made);
  return result;
}

static void an_edited_state_is_not_at_rest(void) {
  uint64_t size = 0;
  char *text = saved(&size);
  static const char *const edits[][3] = {
      {"pressure=", "pressure=26664", "at rest within 1e-05 N, but its largest out-of-balance"},
      {"boundary_fraction=", "boundary_fraction=0.5", "is not where its load puts it"},
      {" thickness=", " thickness=3", "its largest out-of-balance"},
      {"rest_length=", "rest_length=5", "its largest out-of-balance"}};
  for (int k = 0; k < 4; ++k) {
    MUST(load_edited(text, edits[k][0], edits[k][1]));
    if (rests(other) || !strstr(warned, edits[k][2])) {
      ++failures;
      printf("%s: the warning is \"%s\"\n", edits[k][1], warned);
    }
  }
  MUST_FAIL(load_edited(text, "rest_tolerance=", "rest_tolerance=1e30"), MVS_E_FORMAT,
            "at most 1000 N");
  MUST_FAIL(load_edited(text, "rest_tolerance=", "rest_tolerance=-1"), MVS_E_FORMAT, "1000 N");
  MUST_FAIL(load_edited(text, "pressure=", "pressure=1e9"), MVS_E_FORMAT, "within 400000 Pa");
  MUST_FAIL(load_edited(text, "pressure=", "pressure=-400001"), MVS_E_FORMAT, "within 400000 Pa");
  free(text);
}

/* A tool that was removed is still counted in the hash, on which journals and plans depend. */
static void the_count_of_tools_is_kept(void) {
  uint64_t size = 0;
  mvs_tool_desc desc = {.struct_size = sizeof desc, .kind = MVS_TOOL_KIND_BALL};
  mvs_id tool = 0, next = 0;
  desc.position[2] = 0.03;
  MUST(generate_founding(sim));
  char *text = saved(&size);
  CHECK(strstr(text, "tools_made") == NULL);
  free(text);
  for (int k = 0; k < 2; ++k) MUST(mvs_add_tool(sim, &desc, &tool));
  MUST(mvs_remove_tool(sim, tool));
  MUST(mvs_remove_tool(sim, tool - 1));
  text = saved(&size);
  MUST(mvs_load_memory(other, text, size, MVS_FORMAT_OBJ));
  CHECK(same_hash(sim_hash(sim), sim_hash(other)));
  MUST_FAIL(load_edited(text, "tools_made=", "tools_made=99999999999999"), MVS_E_FORMAT,
            "tools_made");
  MUST(mvs_add_tool(other, &desc, &next));
  CHECK(next == tool + 1);
  free(text);
}

int main(void) {
  mvs_sim_desc desc = {.struct_size = sizeof desc, .log = take_warning};
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_create(&desc, &other));
  a_funnel_at_rest_stays_at_rest();
  a_valve_at_rest_stays_at_rest();
  an_edited_state_is_not_at_rest();
  the_count_of_tools_is_kept();
  mvs_destroy(other);
  mvs_destroy(sim);
  return finish("edited_obj");
}
