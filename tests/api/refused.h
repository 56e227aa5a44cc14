/* Fixture: a simulator of a small valve whose bits no refused call may change. */
#ifndef TESTS_REFUSED_H
#define TESTS_REFUSED_H

#include "check.h"
#include "funnel.h"

static mvs_sim *sim = NULL;
static const mvs_snapshot *snapshot = NULL;
static hash128 start;
static funnel f;

/* The call fails with this code, and the simulator is unchanged. */
#define REFUSED(call, code, word)           \
  do {                                      \
    MUST_FAIL(call, code, word);            \
    CHECK(same_hash(start, sim_hash(sim))); \
  } while (0)

static inline void set_funnel(void) {
  make_funnel(&f);
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_set_valve(sim, &f.desc));
  MUST(mvs_get_snapshot(sim, &snapshot));
  start = sim_hash(sim);
}

static inline int finish_unchanged(const char *name) {
  CHECK(same_hash(start, sim_hash(sim)));
  mvs_snapshot_release(snapshot);
  mvs_destroy(sim);
  return finish(name);
}

#endif
