/* Many threads read one snapshot, and the latest snapshot while its simulator works. */
#include <pthread.h>
#include <stdlib.h>

#include "check.h"
#include "funnel.h"

enum { READERS = 4, ROUNDS = 8 };

typedef struct reader {
  mvs_sim *sim;                 /* for the latest snapshot, or null */
  const mvs_snapshot *snapshot; /* one for all, or null */
  hash128 hash;
  mvs_measures measures;
  const void *data[3];
  int bad;
} reader;

static void *read_one(void *user) {
  const uint32_t which[3] = {MVS_ARRAY_NODE_FORCE, MVS_ARRAY_TRIANGLE_STRESS,
                             MVS_ARRAY_ORIFICE_VERTICES};
  reader *r = user;
  mvs_snapshot_retain(r->snapshot);
  r->measures.struct_size = sizeof r->measures;
  r->bad |= mvs_snapshot_measure(r->snapshot, &r->measures) != MVS_OK;
  for (int k = 0; k < 3; ++k) {
    mvs_view view = {0};
    r->bad |= mvs_snapshot_get_array(r->snapshot, which[k], &view) != MVS_OK;
    r->data[k] = view.data;
  }
  r->bad |= mvs_snapshot_get_hash(r->snapshot, r->hash.word) != MVS_OK;
  mvs_snapshot_release(r->snapshot);
  return NULL;
}

static void *read_latest(void *user) {
  reader *r = user;
  for (int k = 0; k < ROUNDS; ++k) {
    mvs_view view = {0};
    r->bad |= mvs_get_snapshot(r->sim, &r->snapshot) != MVS_OK;
    r->bad |= mvs_snapshot_get_array(r->snapshot, MVS_ARRAY_NODE_POSITION, &view) != MVS_OK;
    r->bad |= view.count != FUNNEL_NODES;
    r->bad |= mvs_snapshot_get_array(r->snapshot, MVS_ARRAY_CHORD_TENSION, &view) != MVS_OK;
    mvs_snapshot_release(r->snapshot);
    /* failures are counted per thread */
    r->bad |= mvs_snapshot_get_hash(NULL, r->hash.word) != MVS_E_ARGUMENT;
    r->bad |= mvs_last_error()->code != MVS_E_ARGUMENT;
  }
  return NULL;
}

static mvs_sim *funnel_sim(void) {
  static funnel f;
  mvs_sim *sim = NULL;
  make_funnel(&f);
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_set_valve(sim, &f.desc));
  return sim;
}

static void readers_agree_on_one_snapshot(void) {
  mvs_sim *sim = funnel_sim();
  reader readers[READERS] = {{0}};
  pthread_t threads[READERS];
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_get_snapshot(sim, &snapshot));
  mvs_destroy(sim);
  for (int k = 0; k < READERS; ++k) {
    readers[k].snapshot = snapshot;
    if (pthread_create(&threads[k], NULL, read_one, &readers[k])) exit(2);
  }
  for (int k = 0; k < READERS; ++k) {
    pthread_join(threads[k], NULL);
    CHECK(!readers[k].bad);
    CHECK(same_hash(readers[k].hash, readers[0].hash));
    CHECK(same_bits(&readers[k].measures, &readers[0].measures, sizeof readers[k].measures));
    CHECK(same_bits(readers[k].data, readers[0].data, sizeof readers[k].data));
  }
  mvs_snapshot_release(snapshot);
}

static void the_latest_snapshot_is_read_while_its_simulator_steps(void) {
  mvs_sim *sim = funnel_sim();
  reader readers[READERS] = {{0}};
  pthread_t threads[READERS];
  mvs_load_case load = funnel_load();
  int before = mvs_last_error()->code;
  for (int k = 0; k < READERS; ++k) {
    readers[k].sim = sim;
    if (pthread_create(&threads[k], NULL, read_latest, &readers[k])) exit(2);
  }
  MUST(mvs_set_load(sim, &load));
  for (int k = 0; k < ROUNDS; ++k) MUST(mvs_step(sim, NULL));
  for (int k = 0; k < READERS; ++k) {
    pthread_join(threads[k], NULL);
    CHECK(!readers[k].bad);
  }
  CHECK(mvs_last_error()->code == before);
  mvs_destroy(sim);
}

static void *settle_own(void *user) {
  reader *r = user;
  mvs_load_case load = funnel_load();
  r->bad |= mvs_set_load(r->sim, &load) != MVS_OK;
  r->bad |= mvs_settle(r->sim, NULL, NULL) != MVS_OK;
  r->hash = sim_hash(r->sim);
  return NULL;
}

static void simulators_are_independent(void) {
  reader readers[2] = {{0}};
  pthread_t threads[2];
  for (int k = 0; k < 2; ++k) readers[k].sim = funnel_sim();
  for (int k = 0; k < 2; ++k) {
    if (pthread_create(&threads[k], NULL, settle_own, &readers[k])) exit(2);
  }
  for (int k = 0; k < 2; ++k) {
    pthread_join(threads[k], NULL);
    CHECK(!readers[k].bad);
    mvs_destroy(readers[k].sim);
  }
  CHECK(same_hash(readers[0].hash, readers[1].hash));
}

int main(void) {
  readers_agree_on_one_snapshot();
  the_latest_snapshot_is_read_while_its_simulator_steps();
  simulators_are_independent();
  return finish("threads");
}
