/* A simulator from create to destroy, and the data that its snapshots keep alive. */
#include <math.h>

#include "check.h"
#include "funnel.h"

static mvs_sim *funnel_sim(void) {
  static funnel f;
  mvs_sim *sim = NULL;
  make_funnel(&f);
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_set_valve(sim, &f.desc));
  return sim;
}

static const mvs_snapshot *present(mvs_sim *sim) {
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_get_snapshot(sim, &snapshot));
  return snapshot;
}

static void restore_brings_back_every_bit(void) {
  mvs_sim *sim = funnel_sim();
  const mvs_snapshot *start = present(sim);
  hash128 before = snapshot_hash(start);
  mvs_load_case load = funnel_load();
  mvs_stats stats = {.struct_size = sizeof stats};
  MUST(mvs_set_load(sim, &load));
  MUST(mvs_settle(sim, NULL, &stats));
  CHECK(stats.iterations > 0);
  hash128 settled = sim_hash(sim);
  CHECK(!same_hash(before, settled));
  MUST(mvs_restore(sim, start));
  CHECK(same_hash(before, sim_hash(sim)));
  /* and the steps from there give the same bits again */
  MUST(mvs_set_load(sim, &load));
  MUST(mvs_settle(sim, NULL, NULL));
  CHECK(same_hash(settled, sim_hash(sim)));
  mvs_snapshot_release(start);
  mvs_destroy(sim);
}

static void two_simulators_give_the_same_bits(void) {
  hash128 hash[2];
  for (int k = 0; k < 2; ++k) {
    mvs_sim *sim = funnel_sim();
    mvs_load_case load = funnel_load();
    MUST(mvs_set_load(sim, &load));
    MUST(mvs_settle(sim, NULL, NULL));
    hash[k] = sim_hash(sim);
    mvs_destroy(sim);
  }
  CHECK(same_hash(hash[0], hash[1]));
}

static void a_snapshot_restores_into_another_simulator(void) {
  mvs_sim *sim = funnel_sim(), *other = NULL;
  const mvs_snapshot *snapshot = present(sim);
  MUST(mvs_create(NULL, &other));
  MUST(mvs_restore(other, snapshot));
  mvs_destroy(sim);
  CHECK(same_hash(snapshot_hash(snapshot), sim_hash(other)));
  mvs_snapshot_release(snapshot);
  mvs_destroy(other);
}

static void a_snapshot_outlives_its_simulator(void) {
  mvs_sim *sim = funnel_sim();
  const mvs_snapshot *snapshot = present(sim);
  hash128 before = snapshot_hash(snapshot);
  mvs_snapshot_retain(snapshot);
  mvs_destroy(sim);
  mvs_snapshot_release(snapshot);
  CHECK(same_hash(before, snapshot_hash(snapshot)));
  mvs_view view;
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_NODE_POSITION, &view));
  CHECK(((const double *)view.data)[0] == 15e-3);
  CHECK(strcmp(mvs_snapshot_get_name(snapshot), "funnel") == 0);
  mvs_snapshot_release(snapshot);
}

static void a_snapshot_does_not_change_with_its_simulator(void) {
  mvs_sim *sim = funnel_sim();
  const mvs_snapshot *snapshot = present(sim);
  hash128 before = snapshot_hash(snapshot);
  mvs_load_case load = funnel_load();
  MUST(mvs_set_load(sim, &load));
  MUST(mvs_step(sim, NULL));
  CHECK(same_hash(before, snapshot_hash(snapshot)));
  mvs_snapshot_release(snapshot);
  mvs_destroy(sim);
}

static void load_and_time_are_part_of_the_state(void) {
  mvs_sim *sim = funnel_sim();
  mvs_load_case load = funnel_load(), read = {.struct_size = sizeof read};
  MUST(mvs_get_load(sim, &read));
  CHECK(read.pressure == 0 && read.boundary_fraction == 0);
  load.boundary_fraction = 0.25;
  hash128 before = sim_hash(sim);
  MUST(mvs_set_load(sim, &load));
  CHECK(!same_hash(before, sim_hash(sim)));
  MUST(mvs_get_load(sim, &read));
  CHECK(read.pressure == load.pressure && read.boundary_fraction == 0.25);
  mvs_step_options explicit_step = {sizeof explicit_step, MVS_SOLVER_EXPLICIT, 1e-5, 0, 0, 0};
  MUST(mvs_step(sim, &explicit_step));
  MUST(mvs_step(sim, &explicit_step));
  const mvs_snapshot *snapshot = present(sim);
  read.pressure = 0;
  MUST(mvs_snapshot_get_load(snapshot, &read));
  CHECK(read.pressure == load.pressure);
  mvs_view time;
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_STATE_TIME, &time));
  CHECK(time.count == 1 && fabs(((const double *)time.data)[0] - 2e-5) < 1e-19); /* one rounding */
  mvs_snapshot_release(snapshot);
  mvs_stats stats = {.struct_size = sizeof stats};
  MUST(mvs_get_stats(sim, &stats));
  CHECK(stats.iterations == 1);
  mvs_destroy(sim);
}

static void a_generated_valve_replaces_the_one_before(void) {
  mvs_sim *sim = funnel_sim();
  hash128 before = sim_hash(sim);
  MUST(mvs_generate_valve(sim, NULL));
  hash128 generated = sim_hash(sim);
  CHECK(!same_hash(before, generated));
  mvs_parametric_desc zeros = {.struct_size = sizeof zeros};
  MUST(mvs_generate_valve(sim, &zeros));
  CHECK(same_hash(generated, sim_hash(sim)));
  mvs_destroy(sim);
}

static void the_last_release_of_a_snapshot_in_use_frees_nothing_else(void) {
  mvs_sim *sim = funnel_sim();
  for (int k = 0; k < 3; ++k) mvs_snapshot_release(present(sim));
  CHECK(sim_hash(sim).word[0] != 0);
  mvs_destroy(sim);
}

static void every_backend_is_there_or_refused(void) {
  int there = 0;
  for (uint32_t backend = MVS_BACKEND_DEFAULT; backend <= MVS_BACKEND_BLOCK; ++backend) {
    mvs_sim_desc desc = {.struct_size = sizeof desc, .backend = backend};
    mvs_sim *sim = NULL;
    mvs_result result = mvs_create(&desc, &sim);
    CHECK(result == MVS_OK || result == MVS_E_UNSUPPORTED);
    CHECK((result == MVS_OK) == (sim != NULL));
    there += result == MVS_OK;
    mvs_destroy(sim);
  }
  CHECK(there >= 2); /* the default and the one in use */
}

static void null_is_accepted_where_it_is_said(void) {
  mvs_destroy(NULL);
  mvs_snapshot_retain(NULL);
  mvs_snapshot_release(NULL);
  CHECK(strcmp(mvs_snapshot_get_name(NULL), "") == 0);
}

static void the_library_tells_its_version_and_names(void) {
  CHECK(mvs_version() == 10000 * MVS_VERSION_MAJOR + 100 * MVS_VERSION_MINOR + MVS_VERSION_PATCH);
  CHECK(strlen(mvs_features()) > 0);
  for (int code = MVS_E_CANCELLED; code <= 0; ++code) {
    CHECK(strncmp(mvs_result_name(code), "MVS_", 4) == 0);
    CHECK(strcmp(mvs_result_name(code), "MVS_E_UNKNOWN") != 0);
    for (int other = code + 1; other <= 0; ++other) {
      CHECK(strcmp(mvs_result_name(code), mvs_result_name(other)) != 0);
    }
  }
  CHECK(strcmp(mvs_result_name(1), "MVS_E_UNKNOWN") == 0);
  CHECK(strcmp(mvs_result_name(MVS_E_CANCELLED - 1), "MVS_E_UNKNOWN") == 0);
}

int main(void) {
  CHECK(mvs_last_error()->code == MVS_OK && mvs_last_error()->message[0] == 0);
  restore_brings_back_every_bit();
  two_simulators_give_the_same_bits();
  a_snapshot_restores_into_another_simulator();
  a_snapshot_outlives_its_simulator();
  a_snapshot_does_not_change_with_its_simulator();
  load_and_time_are_part_of_the_state();
  a_generated_valve_replaces_the_one_before();
  the_last_release_of_a_snapshot_in_use_frees_nothing_else();
  every_backend_is_there_or_refused();
  null_is_accepted_where_it_is_said();
  the_library_tells_its_version_and_names();
  return finish("lifecycle");
}
