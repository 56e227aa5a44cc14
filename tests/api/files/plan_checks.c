/* A plan is checked as it is replayed: without a valve too, and with the same warnings. */
#include "tests/api/check.h"
#include "tests/founding.h"

#define PLAN(steps) "{\"format\":\"mvs-plan\",\"version\":1,\"steps\":[" steps "]}"
#define LOAD(pressure) "{\"do\":\"load\",\"pressure_Pa\":" pressure ",\"boundary_fraction\":1}"
#define RING "{\"do\":\"ring\",\"size_m\":0.034}"

static int warnings;
static char warned[512];

static void take_warning(void *user, mvs_log_level level, const char *text) {
  (void)user;
  if (level != MVS_LOG_WARNING) return;
  ++warnings;
  snprintf(warned, sizeof warned, "%s", text);
}

static mvs_result check(const mvs_sim *sim, const char *text, mvs_replay *replay) {
  return mvs_check_plan(sim, text, strlen(text), replay);
}

/* Parts of a valve are not looked up without one; keys, types and choices are checked. */
static void a_plan_is_checked_without_a_valve(void) {
  mvs_replay replay = {.struct_size = sizeof replay, .same_valve = 7, .same_result = 7};
  MUST(check(NULL,
             PLAN(LOAD("15998.64") "," RING ",{\"do\":\"chord_remove\",\"chord\":\"of no valve\"},"
                                   "{\"do\":\"chord_add\",\"head\":\"PM1\",\"site\":{\"node\":7}}"),
             &replay));
  CHECK(replay.operations == 3 && replay.same_valve == 0 && replay.same_result == 0);
  MUST(check(NULL, PLAN(RING), NULL));
  MUST_FAIL(check(NULL, "[]", NULL), MVS_E_FORMAT, "this is not a plan");
  MUST_FAIL(check(NULL, PLAN("],\"step\":["), NULL), MVS_E_FORMAT, "no field \"step\"");
  MUST_FAIL(check(NULL, PLAN("{\"do\":\"load\",\"pressure\":1}"), NULL), MVS_E_FORMAT,
            "\"pressure\"");
  MUST_FAIL(check(NULL, PLAN(RING ",{\"do\":\"ring\",\"colour\":1}"), NULL), MVS_E_FORMAT,
            "step 2 of the plan: ring: ring has no field \"colour\"");
  MUST_FAIL(check(NULL, PLAN("{\"do\":\"ring\",\"size_m\":\"wide\"}"), NULL), MVS_E_FORMAT,
            "step 1 of the plan: ring: size_m has to be a number");
  MUST_FAIL(check(NULL, PLAN("{\"do\":\"chord_remove\",\"chord\":5}"), NULL), MVS_E_FORMAT,
            "chord has to be a text");
  MUST_FAIL(check(NULL, PLAN("{\"do\":\"fly\"}"), NULL), MVS_E_VERSION, "operation \"fly\"");
  MUST_FAIL(check(NULL, PLAN("],\"valve\":[3"), NULL), MVS_E_FORMAT, "valve has to be an object");
  MUST_FAIL(check(NULL, PLAN("],\"author\":[3"), NULL), MVS_E_FORMAT, "author has to be a text");
  MUST_FAIL(check(NULL, PLAN("{\"do\":\"ring\",\"title\":3}"), NULL), MVS_E_FORMAT,
            "title has to be a text");
}

static void a_check_warns_of_other_units_as_a_replay(void) {
  static const char mmhg[] = PLAN(LOAD("120")), pa[] = PLAN(LOAD("15998.64"));
  mvs_sim_desc desc = {.struct_size = sizeof desc, .log = take_warning};
  mvs_sim *sim = NULL;
  char of_check[sizeof warned];
  MUST(mvs_create(&desc, &sim));
  MUST(generate_founding(sim));
  warnings = 0;
  MUST(check(sim, pa, NULL));
  CHECK(warnings == 0);
  MUST(check(sim, mmhg, NULL));
  CHECK(warnings == 1 && strstr(warned, "mmHg") != NULL);
  memcpy(of_check, warned, sizeof of_check);
  MUST(mvs_replay_plan(sim, mmhg, strlen(mmhg), NULL));
  CHECK(warnings == 2 && strcmp(of_check, warned) == 0);
  mvs_destroy(sim);
}

int main(void) {
  a_plan_is_checked_without_a_valve();
  a_check_warns_of_other_units_as_a_replay();
  return finish("plan_checks");
}
