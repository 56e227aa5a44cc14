/* Fixture: a thin valve that can fold in several ways, and its closure along several paths. */
#ifndef TESTS_PATHS_H
#define TESTS_PATHS_H

#include "check.h"

enum { PATHS = 4 }; /* the last one in time, with inertia */

static const mvs_load_case systole = {sizeof(mvs_load_case), 0, MVS_SYSTOLE_PA, 1};

/* The default valve, coarse, and half as thick so that it can fold in several ways. */
static inline mvs_sim *thin_valve(void) {
  mvs_sim *sim = NULL;
  mvs_parametric_desc desc = {.struct_size = sizeof desc,
                              .vertices = 250,
                              .thickness = 0.5e-3,
                              .shape = MVS_SHAPE_FOUNDING};
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_generate_valve(sim, &desc));
  return sim;
}

static inline const mvs_snapshot *snapshot_of(mvs_sim *sim) {
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_get_snapshot(sim, &snapshot));
  return snapshot;
}

static inline mvs_ensemble_options options_of(uint32_t paths, uint64_t seed) {
  mvs_ensemble_options options = {.struct_size = sizeof options, .members = paths, .seed = seed};
  return options;
}

static inline mvs_ensemble *run(const mvs_snapshot *start, mvs_ensemble_options options) {
  mvs_ensemble *ensemble = NULL;
  MUST(mvs_ensemble_run(start, &systole, NULL, &options, &ensemble));
  return ensemble;
}

static inline hash128 path_hash(const mvs_ensemble *ensemble, uint32_t path) {
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_ensemble_get_member_snapshot(ensemble, path, &snapshot));
  hash128 hash = snapshot_hash(snapshot);
  mvs_snapshot_release(snapshot);
  return hash;
}

#endif
