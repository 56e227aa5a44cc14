/* Every wrong argument fails with its code and a sentence, and changes no state. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "funnel.h"
#include "refused.h"

static void null_pointers_for_a_simulator(void) {
  mvs_stats stats = {.struct_size = sizeof stats};
  mvs_load_case load = funnel_load();
  REFUSED(mvs_create(NULL, NULL), MVS_E_ARGUMENT, "sim is a null pointer");
  REFUSED(mvs_set_valve(NULL, &f.desc), MVS_E_ARGUMENT, "sim is a null pointer");
  REFUSED(mvs_set_valve(sim, NULL), MVS_E_ARGUMENT, "valve is a null pointer");
  REFUSED(mvs_check_valve(NULL, NULL, NULL), MVS_E_ARGUMENT, "valve is a null pointer");
  REFUSED(mvs_generate_valve(NULL, NULL), MVS_E_ARGUMENT, "sim is a null pointer");
  REFUSED(mvs_set_load(NULL, &load), MVS_E_ARGUMENT, "sim is a null pointer");
  REFUSED(mvs_set_load(sim, NULL), MVS_E_ARGUMENT, "load is a null pointer");
  REFUSED(mvs_get_load(NULL, &load), MVS_E_ARGUMENT, "sim is a null pointer");
  REFUSED(mvs_get_load(sim, NULL), MVS_E_ARGUMENT, "load is a null pointer");
  REFUSED(mvs_settle(NULL, NULL, NULL), MVS_E_ARGUMENT, "sim is a null pointer");
  REFUSED(mvs_step(NULL, NULL), MVS_E_ARGUMENT, "sim is a null pointer");
  REFUSED(mvs_get_stats(NULL, &stats), MVS_E_ARGUMENT, "sim is a null pointer");
  REFUSED(mvs_get_stats(sim, NULL), MVS_E_ARGUMENT, "stats is a null pointer");
  REFUSED(mvs_get_snapshot(NULL, &snapshot), MVS_E_ARGUMENT, "sim is a null pointer");
  REFUSED(mvs_get_snapshot(sim, NULL), MVS_E_ARGUMENT, "snapshot is a null pointer");
  REFUSED(mvs_restore(NULL, snapshot), MVS_E_ARGUMENT, "sim is a null pointer");
  REFUSED(mvs_restore(sim, NULL), MVS_E_ARGUMENT, "snapshot is a null pointer");
}

static void null_pointers_for_a_snapshot(void) {
  uint64_t hash[2], size = 0;
  uint32_t count = 0;
  double frame[12], up[3] = {0, 0, 1};
  mvs_view view;
  mvs_part part;
  mvs_measures measures = {.struct_size = sizeof measures};
  mvs_comparison comparison = {.struct_size = sizeof comparison};
  mvs_load_case load = funnel_load();
  REFUSED(mvs_snapshot_get_hash(NULL, hash), MVS_E_ARGUMENT, "snapshot is a null pointer");
  REFUSED(mvs_snapshot_get_hash(snapshot, NULL), MVS_E_ARGUMENT, "hash is a null pointer");
  REFUSED(mvs_snapshot_get_array(NULL, 1, &view), MVS_E_ARGUMENT, "snapshot is a null pointer");
  REFUSED(mvs_snapshot_get_array(snapshot, 1, NULL), MVS_E_ARGUMENT, "view is a null pointer");
  REFUSED(mvs_snapshot_get_part_count(NULL, 1, &count), MVS_E_ARGUMENT,
          "snapshot is a null pointer");
  REFUSED(mvs_snapshot_get_part_count(snapshot, 1, NULL), MVS_E_ARGUMENT,
          "count is a null pointer");
  REFUSED(mvs_snapshot_get_part(NULL, 1, 0, &part), MVS_E_ARGUMENT, "snapshot is a null pointer");
  REFUSED(mvs_snapshot_get_part(snapshot, 1, 0, NULL), MVS_E_ARGUMENT, "part is a null pointer");
  REFUSED(mvs_snapshot_find_part(NULL, 1, "A", &part), MVS_E_ARGUMENT,
          "snapshot is a null pointer");
  REFUSED(mvs_snapshot_find_part(snapshot, 1, NULL, &part), MVS_E_ARGUMENT,
          "name is a null pointer");
  REFUSED(mvs_snapshot_find_part(snapshot, 1, "A", NULL), MVS_E_ARGUMENT, "part is a null pointer");
  REFUSED(mvs_snapshot_get_load(NULL, &load), MVS_E_ARGUMENT, "snapshot is a null pointer");
  REFUSED(mvs_snapshot_get_load(snapshot, NULL), MVS_E_ARGUMENT, "load is a null pointer");
  REFUSED(mvs_snapshot_measure(NULL, &measures), MVS_E_ARGUMENT, "snapshot is a null pointer");
  REFUSED(mvs_snapshot_measure(snapshot, NULL), MVS_E_ARGUMENT, "measures is a null pointer");
  REFUSED(mvs_snapshot_compare(NULL, snapshot, &comparison), MVS_E_ARGUMENT, "a is a null");
  REFUSED(mvs_snapshot_compare(snapshot, NULL, &comparison), MVS_E_ARGUMENT, "b is a null");
  REFUSED(mvs_snapshot_compare(snapshot, snapshot, NULL), MVS_E_ARGUMENT, "comparison is a null");
  REFUSED(mvs_snapshot_section(NULL, up, up, NULL, 0, &size), MVS_E_ARGUMENT, "snapshot is a null");
  REFUSED(mvs_snapshot_section(snapshot, NULL, up, NULL, 0, &size), MVS_E_ARGUMENT, "point is a");
  REFUSED(mvs_snapshot_section(snapshot, up, NULL, NULL, 0, &size), MVS_E_ARGUMENT, "normal is a");
  REFUSED(mvs_snapshot_section(snapshot, up, up, NULL, 1, &size), MVS_E_ARGUMENT, "points is a");
  REFUSED(mvs_snapshot_section(snapshot, up, up, NULL, 0, NULL), MVS_E_ARGUMENT, "count is a");
  REFUSED(mvs_snapshot_get_frame(NULL, frame), MVS_E_ARGUMENT, "snapshot is a null pointer");
  REFUSED(mvs_snapshot_get_frame(snapshot, NULL), MVS_E_ARGUMENT, "frame is a null pointer");
}

static void null_pointers_for_files(void) {
  uint64_t size = 0;
  REFUSED(mvs_load_file(NULL, "a.obj", 0), MVS_E_ARGUMENT, "sim is a null pointer");
  REFUSED(mvs_load_file(sim, NULL, 0), MVS_E_ARGUMENT, "path is a null pointer");
  REFUSED(mvs_load_memory(NULL, "", 0, 0), MVS_E_ARGUMENT, "sim is a null pointer");
  REFUSED(mvs_load_memory(sim, NULL, 0, 0), MVS_E_ARGUMENT, "data is a null pointer");
  REFUSED(mvs_save_file(NULL, "a.obj", 0), MVS_E_ARGUMENT, "snapshot is a null pointer");
  REFUSED(mvs_save_file(snapshot, NULL, 0), MVS_E_ARGUMENT, "path is a null pointer");
  REFUSED(mvs_save_memory(NULL, 0, NULL, 0, &size), MVS_E_ARGUMENT, "snapshot is a null pointer");
  REFUSED(mvs_save_memory(snapshot, 0, NULL, 0, NULL), MVS_E_ARGUMENT, "size is a null pointer");
  REFUSED(mvs_save_memory(snapshot, 0, NULL, 1, &size), MVS_E_ARGUMENT, "data is a null pointer");
}

static void options_out_of_range(void) {
  mvs_sim *other = NULL;
  mvs_sim_desc desc = {.struct_size = sizeof desc, .backend = 9};
  REFUSED(mvs_create(&desc, &other), MVS_E_ARGUMENT, "desc.backend is 9");
  mvs_load_case load = {sizeof load, 1, 0, 0};
  REFUSED(mvs_set_load(sim, &load), MVS_E_ARGUMENT, "reserved");
  load.reserved = 0;
  load.pressure = NAN;
  REFUSED(mvs_set_load(sim, &load), MVS_E_ARGUMENT, "load.pressure is nan");
  load.pressure = 1e9;
  REFUSED(mvs_set_load(sim, &load), MVS_E_ARGUMENT, "120 mmHg are");
  load.pressure = 0;
  load.boundary_fraction = -0.1;
  REFUSED(mvs_set_load(sim, &load), MVS_E_ARGUMENT, "boundary_fraction is -0.1");
  load.boundary_fraction = NAN;
  REFUSED(mvs_set_load(sim, &load), MVS_E_ARGUMENT, "boundary_fraction is nan");
  mvs_settle_options settle = {.struct_size = sizeof settle, .solver = 4};
  REFUSED(mvs_settle(sim, &settle, NULL), MVS_E_ARGUMENT, "options.solver is 4");
  settle = (mvs_settle_options){.struct_size = sizeof settle, .flags = 2};
  REFUSED(mvs_settle(sim, &settle, NULL), MVS_E_ARGUMENT, "options.flags");
  settle = (mvs_settle_options){.struct_size = sizeof settle, .residual = -1};
  REFUSED(mvs_settle(sim, &settle, NULL), MVS_E_ARGUMENT, "options.residual is -1");
  settle.residual = NAN;
  REFUSED(mvs_settle(sim, &settle, NULL), MVS_E_ARGUMENT, "options.residual is nan");
  settle.residual = 1e-15; /* below rounding */
  REFUSED(mvs_settle(sim, &settle, NULL), MVS_E_ARGUMENT, "options.residual is 1e-15");
  settle.residual = 1e6;
  REFUSED(mvs_settle(sim, &settle, NULL), MVS_E_ARGUMENT, "options.residual is 1e+06");
  settle = (mvs_settle_options){.struct_size = sizeof settle, .dt = NAN};
  REFUSED(mvs_settle(sim, &settle, NULL), MVS_E_ARGUMENT, "options.dt is nan");
  settle = (mvs_settle_options){.struct_size = sizeof settle, .damping = 1e9};
  REFUSED(mvs_settle(sim, &settle, NULL), MVS_E_ARGUMENT, "options.damping is 1e+09");
  mvs_step_options step = {sizeof step, MVS_SOLVER_NEWTON, 0, 0, 0, 0};
  REFUSED(mvs_step(sim, &step), MVS_E_ARGUMENT, "options.solver is 1");
  step = (mvs_step_options){sizeof step, 0, 2, 0, 0, 0};
  REFUSED(mvs_step(sim, &step), MVS_E_ARGUMENT, "options.dt is 2");
  step.dt = -1e-3;
  REFUSED(mvs_step(sim, &step), MVS_E_ARGUMENT, "options.dt is -0.001");
  step.dt = NAN;
  REFUSED(mvs_step(sim, &step), MVS_E_ARGUMENT, "options.dt is nan");
  step.dt = 1e-12;
  REFUSED(mvs_step(sim, &step), MVS_E_ARGUMENT, "options.dt is 1e-12");
  step = (mvs_step_options){sizeof step, 0, 0, -1, 0, 0};
  REFUSED(mvs_step(sim, &step), MVS_E_ARGUMENT, "options.damping is -1");
  step = (mvs_step_options){.struct_size = sizeof step, .budget = 3};
  REFUSED(mvs_step(sim, &step), MVS_E_ARGUMENT, "options.budget is 3");
  step.budget = 20000;
  REFUSED(mvs_step(sim, &step), MVS_E_ARGUMENT, "options.budget is 20000");
  mvs_parametric_desc valve = {.struct_size = sizeof valve, .vertices = 3};
  REFUSED(mvs_generate_valve(sim, &valve), MVS_E_ARGUMENT, "vertices");
}

/* The bits after a step of a loaded funnel with this budget. */
static hash128 after_step(uint32_t budget) {
  static funnel g;
  mvs_sim *other = NULL;
  mvs_load_case load = funnel_load();
  mvs_step_options step = {.struct_size = sizeof step, .budget = budget};
  make_funnel(&g);
  MUST(mvs_create(NULL, &other));
  MUST(mvs_set_valve(other, &g.desc));
  MUST(mvs_set_load(other, &load));
  MUST(mvs_step(other, &step));
  const hash128 hash = sim_hash(other);
  mvs_destroy(other);
  return hash;
}

/* Not an error: the default, 64. */
static void a_budget_of_zero_is_the_default(void) {
  CHECK(same_hash(after_step(0), after_step(64)));
}

static void parts_and_arrays_that_are_not_there(void) {
  mvs_part part;
  mvs_view view;
  uint32_t count = 0;
  REFUSED(mvs_snapshot_get_array(snapshot, 0, &view), MVS_E_ARGUMENT, "which is 0");
  REFUSED(mvs_snapshot_get_array(snapshot, 9999, &view), MVS_E_ARGUMENT, "which is 9999");
  REFUSED(mvs_snapshot_get_part_count(snapshot, 7, &count), MVS_E_ARGUMENT, "kind is 7");
  REFUSED(mvs_snapshot_get_part(snapshot, 0, 0, &part), MVS_E_ARGUMENT, "kind is 0");
  for (uint32_t kind = 1; kind <= 5; ++kind) {
    REFUSED(mvs_snapshot_get_part(snapshot, kind, 1000, &part), MVS_E_ARGUMENT, "index is 1000");
    REFUSED(mvs_snapshot_find_part(snapshot, kind, "Q9", &part), MVS_E_ID, "named \"Q9\"");
  }
  double up[3] = {0, 0, 1}, zero[3] = {0, 0, 0}, nan[3] = {0, NAN, 0};
  uint64_t points = 0;
  REFUSED(mvs_snapshot_section(snapshot, nan, up, NULL, 0, &points), MVS_E_ARGUMENT, "point has");
  REFUSED(mvs_snapshot_section(snapshot, up, nan, NULL, 0, &points), MVS_E_ARGUMENT, "normal has");
  REFUSED(mvs_snapshot_section(snapshot, up, zero, NULL, 0, &points), MVS_E_ARGUMENT, "no length");
}

static void an_empty_simulator_says_so(void) {
  mvs_sim *empty = NULL;
  const mvs_snapshot *nothing = NULL;
  mvs_load_case load = funnel_load();
  mvs_stats stats = {.struct_size = sizeof stats};
  MUST(mvs_create(NULL, &empty));
  MUST_FAIL(mvs_get_snapshot(empty, &nothing), MVS_E_STATE, "has no valve yet");
  CHECK(nothing == NULL);
  MUST_FAIL(mvs_set_load(empty, &load), MVS_E_STATE, "has no valve yet");
  MUST_FAIL(mvs_get_load(empty, &load), MVS_E_STATE, "has no valve yet");
  MUST_FAIL(mvs_settle(empty, NULL, NULL), MVS_E_STATE, "has no valve yet");
  MUST_FAIL(mvs_step(empty, NULL), MVS_E_STATE, "has no valve yet");
  MUST_FAIL(mvs_get_stats(empty, &stats), MVS_E_STATE, "has no statistics");
  mvs_destroy(empty);
}

static void an_error_stays_until_the_next_and_fits_its_room(void) {
  char name[2000];
  mvs_part part;
  MUST_FAIL(mvs_snapshot_find_part(snapshot, 1, "one", &part), MVS_E_ID, "one");
  MUST(mvs_snapshot_find_part(snapshot, 1, "A", &part));
  CHECK(mvs_last_error()->code == MVS_E_ID);
  CHECK(strcmp(mvs_last_error()->part, "one") == 0);
  /* a name that does not fit is cut before a character of two bytes, not within it */
  memset(name, 'x', sizeof name);
  memcpy(name + 62, "\xc3\xa4", 2);
  name[sizeof name - 1] = 0;
  MUST_FAIL(mvs_snapshot_find_part(snapshot, 1, name, &part), MVS_E_ID, "named");
  CHECK(strlen(mvs_last_error()->part) == 62);
}

int main(void) {
  set_funnel();
  null_pointers_for_a_simulator();
  null_pointers_for_a_snapshot();
  null_pointers_for_files();
  options_out_of_range();
  a_budget_of_zero_is_the_default();
  parts_and_arrays_that_are_not_there();
  an_empty_simulator_says_so();
  an_error_stays_until_the_next_and_fits_its_room();
  return finish_unchanged("errors");
}
