/* The next steps depend on the snapshot alone: not on the steps before it, nor on whether it was
 * kept in memory or in a file. */
#include <stdlib.h>

#include "check.h"

enum { steps_before = 25, steps_after = 15 };

static mvs_sim *closing_sim(uint32_t solver) {
  mvs_sim *sim = NULL;
  mvs_parametric_desc small = {
      .struct_size = sizeof small, .vertices = 200, .shape = MVS_SHAPE_FOUNDING};
  mvs_load_case load = {
      .struct_size = sizeof load, .pressure = MVS_SYSTOLE_PA, .boundary_fraction = 1};
  mvs_step_options how = {.struct_size = sizeof how, .solver = solver};
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_generate_valve(sim, &small));
  MUST(mvs_set_load(sim, &load));
  for (int k = 0; k < steps_before; ++k) MUST(mvs_step(sim, &how));
  return sim;
}

static hash128 step_on(mvs_sim *sim, uint32_t solver) {
  mvs_step_options how = {.struct_size = sizeof how, .solver = solver};
  for (int k = 0; k < steps_after; ++k) MUST(mvs_step(sim, &how));
  return sim_hash(sim);
}

static void restored_steps_give_the_same_bits(uint32_t solver) {
  mvs_sim *sim = closing_sim(solver), *fresh = NULL;
  const mvs_snapshot *middle = NULL;
  MUST(mvs_get_snapshot(sim, &middle));
  hash128 straight_on = step_on(sim, solver);
  MUST(mvs_restore(sim, middle));
  CHECK(same_hash(straight_on, step_on(sim, solver)));
  MUST(mvs_create(NULL, &fresh));
  MUST(mvs_restore(fresh, middle));
  CHECK(same_hash(straight_on, step_on(fresh, solver)));
  mvs_snapshot_release(middle);
  mvs_destroy(fresh);
  mvs_destroy(sim);
}

static void loaded_steps_give_the_same_bits(uint32_t solver) {
  mvs_sim *sim = closing_sim(solver), *fresh = NULL;
  const mvs_snapshot *middle = NULL;
  uint64_t size = 0;
  MUST(mvs_get_snapshot(sim, &middle));
  MUST(mvs_save_memory(middle, MVS_FORMAT_OBJ, NULL, 0, &size));
  void *file = malloc(size);
  CHECK(file != NULL);
  MUST(mvs_save_memory(middle, MVS_FORMAT_OBJ, file, size, &size));
  MUST(mvs_create(NULL, &fresh));
  MUST(mvs_load_memory(fresh, file, size, MVS_FORMAT_OBJ));
  CHECK(same_hash(step_on(sim, solver), step_on(fresh, solver)));
  free(file);
  mvs_snapshot_release(middle);
  mvs_destroy(fresh);
  mvs_destroy(sim);
}

int main(void) {
  restored_steps_give_the_same_bits(MVS_SOLVER_IMPLICIT);
  restored_steps_give_the_same_bits(MVS_SOLVER_EXPLICIT);
  loaded_steps_give_the_same_bits(MVS_SOLVER_IMPLICIT);
  loaded_steps_give_the_same_bits(MVS_SOLVER_EXPLICIT);
  return finish("replay");
}
