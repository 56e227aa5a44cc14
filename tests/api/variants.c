/* Variants of a valve share what depends on its mesh, which changes no bit: closures of the same
 * variant in an empty simulator, in one that holds another variant, and on several threads. */
#include <pthread.h>
#include <stdlib.h>

#include "saved.h"

enum { VARIANTS = 3, THREADS = 2, FINE = 1300 };

/* A variant as a file in memory. */
typedef struct variant {
  char *bytes;
  uint64_t size;
  hash128 expected; /* of its closure in a simulator of its own */
} variant;

static mvs_sim *empty(void) {
  mvs_sim *sim = NULL;
  MUST(mvs_create(NULL, &sim));
  return sim;
}

static mvs_sim *like(const mvs_snapshot *valve) {
  mvs_sim *sim = empty();
  MUST(mvs_restore(sim, valve));
  return sim;
}

/* Softens the tissue and shortens a chord, which leaves the mesh as it is. */
static void change(mvs_sim *sim, uint32_t k) {
  mvs_leaflet_desc tissue = {.law = MVS_LEAFLET_LAW_SPRING, .constants = {90e3 + 5e3 * k}};
  mvs_op_chord_length shorter = {.op = {sizeof shorter, MVS_OP_CHORD_LENGTH},
                                 .factor = 0.97 - 0.01 * k};
  mvs_view ids;
  const mvs_snapshot *snapshot = present(sim);
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_CHORD_ID, &ids));
  shorter.chord = ((const mvs_id *)ids.data)[k];
  mvs_snapshot_release(snapshot);
  MUST(mvs_set_leaflet(sim, 0, &tissue));
  MUST(mvs_apply_op(sim, &shorter.op, NULL));
}

static void save(mvs_sim *sim, variant *to) {
  const mvs_snapshot *snapshot = present(sim);
  MUST(mvs_save_memory(snapshot, MVS_FORMAT_OBJ, NULL, 0, &to->size));
  to->bytes = malloc(to->size);
  if (!to->bytes) exit(2);
  MUST(mvs_save_memory(snapshot, MVS_FORMAT_OBJ, to->bytes, to->size, &to->size));
  mvs_snapshot_release(snapshot);
}

/* Loads a variant into a simulator and closes it. */
static hash128 closed(mvs_sim *sim, const variant *of) {
  mvs_settle_options how = {.struct_size = sizeof how, .residual = 1e-2};
  const mvs_load_case load = {sizeof load, 0, MVS_SYSTOLE_PA, 1};
  MUST(mvs_load_memory(sim, of->bytes, of->size, MVS_FORMAT_OBJ));
  MUST(mvs_set_load(sim, &load));
  MUST(mvs_settle(sim, &how, NULL));
  return sim_hash(sim);
}

static void in_one_simulator_or_in_many(const mvs_snapshot *valve, const variant *variants) {
  mvs_sim *sim = like(valve);
  for (int k = 0; k < VARIANTS; ++k) {
    mvs_sim *other = like(valve);
    CHECK(same_hash(closed(other, &variants[k]), variants[k].expected));
    mvs_destroy(other);
    CHECK(same_hash(closed(sim, &variants[k]), variants[k].expected));
  }
  mvs_destroy(sim);
}

typedef struct job {
  const mvs_snapshot *valve;
  const variant *variants;
  hash128 found[VARIANTS];
} job;

static void *close_all(void *user) {
  job *j = user;
  for (int k = 0; k < VARIANTS; ++k) {
    mvs_sim *sim = like(j->valve);
    j->found[k] = closed(sim, &j->variants[k]);
    mvs_destroy(sim);
  }
  return NULL;
}

static void on_threads(const mvs_snapshot *valve, const variant *variants) {
  pthread_t threads[THREADS];
  job jobs[THREADS];
  for (int t = 0; t < THREADS; ++t) {
    jobs[t] = (job){.valve = valve, .variants = variants};
    if (pthread_create(&threads[t], NULL, close_all, &jobs[t])) exit(2);
  }
  for (int t = 0; t < THREADS; ++t) {
    pthread_join(threads[t], NULL);
    for (int k = 0; k < VARIANTS; ++k) CHECK(same_hash(jobs[t].found[k], variants[k].expected));
  }
}

/* Constants are checked although the mesh is known to be valid. */
static void a_bad_constant_is_refused_all_the_same(const mvs_snapshot *valve) {
  mvs_sim *sim = like(valve);
  const hash128 before = sim_hash(sim);
  const mvs_leaflet_desc paper = {.law = MVS_LEAFLET_LAW_SPRING, .thickness = 1.0};
  MUST_FAIL(mvs_set_leaflet(sim, 0, &paper), MVS_E_OP, "thickness");
  CHECK(same_hash(sim_hash(sim), before));
  mvs_destroy(sim);
}

int main(void) {
  variant variants[VARIANTS];
  const mvs_parametric_desc desc = {
      .struct_size = sizeof desc, .vertices = FINE, .shape = MVS_SHAPE_FOUNDING};
  mvs_sim *sim = empty();
  MUST(mvs_generate_valve(sim, &desc));
  const mvs_snapshot *valve = present(sim);
  mvs_destroy(sim);
  for (uint32_t k = 0; k < VARIANTS; ++k) {
    sim = like(valve);
    change(sim, k);
    save(sim, &variants[k]);
    mvs_destroy(sim);
    sim = empty();
    variants[k].expected = closed(sim, &variants[k]);
    mvs_destroy(sim);
  }
  CHECK(!same_hash(variants[0].expected, variants[1].expected));
  in_one_simulator_or_in_many(valve, variants);
  on_threads(valve, variants);
  a_bad_constant_is_refused_all_the_same(valve);
  for (int k = 0; k < VARIANTS; ++k) free(variants[k].bytes);
  mvs_snapshot_release(valve);
  return finish("variants");
}
