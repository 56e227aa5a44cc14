/* Structs of programs compiled against older and newer headers than the library. */
#include <stddef.h>

#include "check.h"
#include "funnel.h"

static funnel f;
static mvs_sim *sim;

/* A load as a program of a later version passes it. */
typedef struct later_load {
  mvs_load_case known;
  double unknown[2];
} later_load;

static void a_shorter_struct_counts_as_zero_beyond_its_end(void) {
  mvs_load_case load = funnel_load(), read = {.struct_size = sizeof read};
  load.struct_size = offsetof(mvs_load_case, boundary_fraction);
  MUST(mvs_set_load(sim, &load));
  MUST(mvs_get_load(sim, &read));
  CHECK(read.pressure == load.pressure && read.boundary_fraction == 0);
}

static void a_longer_struct_is_taken_if_its_tail_is_zero(void) {
  later_load load = {funnel_load(), {0, 0}};
  load.known.struct_size = sizeof load;
  MUST(mvs_set_load(sim, &load.known));
  hash128 before = sim_hash(sim);
  load.unknown[1] = 1;
  MUST_FAIL(mvs_set_load(sim, &load.known), MVS_E_VERSION, "does not know");
  CHECK(same_hash(before, sim_hash(sim)));
}

static void output_is_filled_as_far_as_the_caller_reaches(void) {
  mvs_load_case set = funnel_load(), read = {0, 0, -1, -2};
  MUST(mvs_set_load(sim, &set));
  read.struct_size = offsetof(mvs_load_case, boundary_fraction);
  MUST(mvs_get_load(sim, &read));
  CHECK(read.pressure == set.pressure);
  CHECK(read.boundary_fraction == -2); /* beyond the size that the caller stated */
  CHECK(read.struct_size == offsetof(mvs_load_case, boundary_fraction));
  later_load later = {{sizeof later, 0, 0, 0}, {7, 7}};
  MUST(mvs_get_load(sim, &later.known));
  CHECK(later.known.boundary_fraction == set.boundary_fraction);
  CHECK(later.unknown[0] == 0 && later.unknown[1] == 0);
  CHECK(later.known.struct_size == sizeof later);
}

static void a_size_that_was_not_set_is_refused(void) {
  const uint32_t wrong[] = {0, 4, 7, 13, 5000, UINT32_MAX};
  for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
    mvs_load_case load = funnel_load();
    mvs_stats stats = {.struct_size = wrong[k]};
    mvs_measures measures = {.struct_size = wrong[k]};
    mvs_comparison comparison = {.struct_size = wrong[k]};
    mvs_sim_desc desc = {.struct_size = wrong[k]};
    mvs_settle_options settle = {.struct_size = wrong[k]};
    mvs_step_options step = {.struct_size = wrong[k]};
    mvs_parametric_desc parametric = {.struct_size = wrong[k]};
    mvs_sim *other = NULL;
    const mvs_snapshot *snapshot = NULL;
    hash128 before = sim_hash(sim);
    load.struct_size = wrong[k];
    f.desc.struct_size = wrong[k];
    MUST(mvs_get_snapshot(sim, &snapshot));
    MUST_FAIL(mvs_set_load(sim, &load), MVS_E_ARGUMENT, "load.struct_size");
    MUST_FAIL(mvs_get_load(sim, &load), MVS_E_ARGUMENT, "load.struct_size");
    MUST_FAIL(mvs_snapshot_get_load(snapshot, &load), MVS_E_ARGUMENT, "load.struct_size");
    MUST_FAIL(mvs_set_valve(sim, &f.desc), MVS_E_ARGUMENT, "valve.struct_size");
    MUST_FAIL(mvs_create(&desc, &other), MVS_E_ARGUMENT, "desc.struct_size");
    MUST_FAIL(mvs_generate_valve(sim, &parametric), MVS_E_ARGUMENT, "desc.struct_size");
    MUST_FAIL(mvs_settle(sim, &settle, NULL), MVS_E_ARGUMENT, "options.struct_size");
    MUST_FAIL(mvs_settle(sim, NULL, &stats), MVS_E_ARGUMENT, "stats.struct_size");
    MUST_FAIL(mvs_step(sim, &step), MVS_E_ARGUMENT, "options.struct_size");
    MUST_FAIL(mvs_get_stats(sim, &stats), MVS_E_ARGUMENT, "stats.struct_size");
    MUST_FAIL(mvs_snapshot_measure(snapshot, &measures), MVS_E_ARGUMENT, "measures.struct_size");
    MUST_FAIL(mvs_snapshot_compare(snapshot, snapshot, &comparison), MVS_E_ARGUMENT,
              "comparison.struct_size");
    CHECK(same_hash(before, sim_hash(sim)));
    mvs_snapshot_release(snapshot);
  }
}

int main(void) {
  make_funnel(&f);
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_set_valve(sim, &f.desc));
  a_shorter_struct_counts_as_zero_beyond_its_end();
  a_longer_struct_is_taken_if_its_tail_is_zero();
  output_is_filled_as_far_as_the_caller_reaches();
  a_size_that_was_not_set_is_refused();
  mvs_destroy(sim);
  return finish("structs");
}
