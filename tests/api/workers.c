/* Worker threads change no bit: closures, steps in time and operations with 1, 2, 3 and 8 of them,
 * and with pools of a host that run tasks backwards, twice, late or not at all. */
#include <pthread.h>
#include <stddef.h>
#include <stdlib.h>

#include "check.h"

enum { SMALL = 300, FINE = 1300, STEPS = 12 };

/* How a simulator gets its threads. */
typedef struct way {
  const char *name;
  uint32_t workers;
  uint32_t width; /* of a host's pool */
  void (*run_tasks)(void *user, uint32_t count, mvs_task_fn task, void *context);
} way;

typedef struct host {
  uint32_t width, loops, widths_read;
} host;

static uint32_t pool_width(void *user) {
  host *h = user;
  ++h->widths_read;
  return h->width;
}

static void run_backwards(void *user, uint32_t count, mvs_task_fn task, void *context) {
  ++((host *)user)->loops;
  while (count > 0) task(context, --count);
}

static void run_nothing(void *user, uint32_t count, mvs_task_fn task, void *context) {
  ++((host *)user)->loops;
  (void)count, (void)task, (void)context;
}

static void run_twice(void *user, uint32_t count, mvs_task_fn task, void *context) {
  ++((host *)user)->loops;
  for (uint32_t k = 0; k < 2 * count; ++k) task(context, k % count);
}

typedef struct job {
  mvs_task_fn task;
  void *context;
  uint32_t index;
} job;

static void *run_job(void *user) {
  job *j = user;
  j->task(j->context, j->index);
  return NULL;
}

/* A thread for each task. */
static void run_on_threads(void *user, uint32_t count, mvs_task_fn task, void *context) {
  pthread_t threads[8];
  job jobs[8];
  ++((host *)user)->loops;
  for (uint32_t k = 0; k < count && k < 8; ++k) {
    jobs[k] = (job){task, context, k};
    if (pthread_create(&threads[k], NULL, run_job, &jobs[k])) exit(2);
  }
  for (uint32_t k = 0; k < count && k < 8; ++k) pthread_join(threads[k], NULL);
}

static const way alone = {"alone", 0, 0, NULL};
static const way ways[] = {{"1 worker", 1, 0, NULL},
                           {"2 workers", 2, 0, NULL},
                           {"3 workers", 3, 0, NULL},
                           {"8 workers", 8, 0, NULL},
                           {"a pool, backwards", 0, 3, run_backwards},
                           {"a pool that runs nothing", 0, 2, run_nothing},
                           {"a pool that runs all twice", 0, 4, run_twice},
                           {"a pool of width 0", 0, 0, run_backwards}};
enum { WAYS = sizeof ways / sizeof *ways };

static mvs_sim *make_sim(const way *w, host *h) {
  mvs_sim *sim = NULL;
  mvs_sim_desc desc = {.struct_size = sizeof desc, .workers = w->workers};
  h->width = w->width;
  if (w->run_tasks) {
    desc.user = h;
    desc.pool_width = pool_width;
    desc.run_tasks = w->run_tasks;
  }
  MUST(mvs_create(&desc, &sim));
  return sim;
}

static void load_valve(mvs_sim *sim, uint32_t vertices, mvs_leaflet_law law) {
  mvs_parametric_desc valve = {
      .struct_size = sizeof valve, .vertices = vertices, .shape = MVS_SHAPE_FOUNDING};
  mvs_load_case load = {sizeof load, 0, MVS_SYSTOLE_PA, 1};
  mvs_leaflet_desc tissue = {.law = law};
  MUST(mvs_generate_valve(sim, &valve));
  if (law) MUST(mvs_set_leaflet(sim, 0, &tissue));
  MUST(mvs_set_load(sim, &load));
}

static void settle(mvs_sim *sim) {
  mvs_settle_options options = {.struct_size = sizeof options, .residual = 1e-3};
  MUST(mvs_settle(sim, &options, NULL));
}

static void cut_a_chord(mvs_sim *sim) {
  mvs_op_chord_remove cut = {.op = {sizeof cut, MVS_OP_CHORD_REMOVE}};
  const mvs_snapshot *snapshot = NULL;
  mvs_view ids;
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_CHORD_ID, &ids));
  cut.chord = ((const mvs_id *)ids.data)[0];
  mvs_snapshot_release(snapshot);
  MUST(mvs_apply_op(sim, &cut.op, NULL));
}

/* Closes a valve, cuts a chord, closes it again. */
static void close_twice(mvs_sim *sim, mvs_leaflet_law law, hash128 hashes[2]) {
  load_valve(sim, SMALL, law);
  settle(sim);
  hashes[0] = sim_hash(sim);
  cut_a_chord(sim);
  settle(sim);
  hashes[1] = sim_hash(sim);
}

static void closures_have_the_same_bits(mvs_leaflet_law law) {
  host h = {0};
  hash128 expected[2], found[2];
  mvs_sim *sim = make_sim(&alone, &h);
  close_twice(sim, law, expected);
  mvs_destroy(sim);
  CHECK(!same_hash(expected[0], expected[1]));
  for (int k = 0; k < WAYS; ++k) {
    host of = {0};
    sim = make_sim(&ways[k], &of);
    close_twice(sim, law, found);
    mvs_destroy(sim);
    if (!same_hash(found[0], expected[0]) || !same_hash(found[1], expected[1])) {
      printf("other bits with %s\n", ways[k].name);
      ++failures;
    }
    CHECK((of.widths_read > 0) == (ways[k].run_tasks != NULL));
    CHECK((of.loops > 0) == (ways[k].width > 1));
  }
}

/* Steps of a grasped valve that closes. */
static hash128 step_with_a_hand(const way *w) {
  host h = {0};
  mvs_id tool = 0;
  mvs_sim *sim = make_sim(w, &h);
  load_valve(sim, SMALL, 0);
  mvs_tool_desc hand = {.struct_size = sizeof hand, .kind = MVS_TOOL_KIND_GRASP, .reach = 1};
  MUST(mvs_add_tool(sim, &hand, &tool));
  for (int k = 0; k < STEPS; ++k) MUST(mvs_step(sim, NULL));
  const hash128 hash = sim_hash(sim);
  mvs_destroy(sim);
  return hash;
}

static void steps_have_the_same_bits(void) {
  const hash128 expected = step_with_a_hand(&alone);
  for (int k = 0; k < WAYS; ++k) CHECK(same_hash(step_with_a_hand(&ways[k]), expected));
}

/* Over a hierarchy of meshes, in slices. */
static hash128 close_fine(const way *w) {
  host h = {0};
  double share = 0;
  mvs_settle_options options = {.struct_size = sizeof options, .residual = 1e-2};
  mvs_sim *sim = make_sim(w, &h);
  load_valve(sim, FINE, 0);
  MUST(mvs_begin_settle(sim, &options));
  while (share < 1) MUST(mvs_advance_settle(sim, 0.01, &share, NULL));
  const hash128 hash = sim_hash(sim);
  mvs_destroy(sim);
  return hash;
}

static void slices_over_a_hierarchy_have_the_same_bits(void) {
  const way threads = {"a thread for each task", 0, 3, run_on_threads};
  const hash128 expected = close_fine(&alone);
  CHECK(same_hash(close_fine(&ways[1]), expected));
  CHECK(same_hash(close_fine(&threads), expected));
}

static int32_t stop_soon(void *user, double share, double residual) {
  (void)share, (void)residual;
  return ++*(int *)user == 5;
}

static void a_cancelled_closure_leaves_its_workers_usable(void) {
  int calls = 0;
  mvs_sim_desc desc = {
      .struct_size = sizeof desc, .progress = stop_soon, .user = &calls, .workers = 3};
  mvs_sim *sim = NULL;
  host h = {0};
  hash128 expected[2], found[2];
  MUST(mvs_create(&desc, &sim));
  load_valve(sim, SMALL, 0);
  MUST_FAIL(mvs_settle(sim, NULL, NULL), MVS_E_CANCELLED, "");
  close_twice(sim, 0, found);
  mvs_destroy(sim);
  sim = make_sim(&alone, &h);
  close_twice(sim, 0, expected);
  mvs_destroy(sim);
  CHECK(same_hash(found[0], expected[0]) && same_hash(found[1], expected[1]));
}

typedef struct closing {
  hash128 hashes[2];
} closing;

static void *close_on_thread(void *user) {
  host h = {0};
  mvs_sim *sim = make_sim(&ways[1], &h);
  close_twice(sim, 0, ((closing *)user)->hashes);
  mvs_destroy(sim);
  return NULL;
}

static void simulators_have_workers_of_their_own(void) {
  pthread_t threads[2];
  closing found[2];
  for (int k = 0; k < 2; ++k) {
    if (pthread_create(&threads[k], NULL, close_on_thread, &found[k])) exit(2);
  }
  for (int k = 0; k < 2; ++k) pthread_join(threads[k], NULL);
  CHECK(same_bits(&found[0], &found[1], sizeof found[0]));
}

static void impossible_workers_are_refused(void) {
  mvs_sim *sim = NULL;
  mvs_sim_desc desc = {.struct_size = sizeof desc, .workers = MVS_MAX_WORKERS + 1};
  MUST_FAIL(mvs_create(&desc, &sim), MVS_E_ARGUMENT, "at most 256; more than");
  desc.workers = UINT32_MAX;
  MUST_FAIL(mvs_create(&desc, &sim), MVS_E_ARGUMENT, "4294967295");
  desc.workers = 0;
  desc.run_tasks = run_backwards;
  MUST_FAIL(mvs_create(&desc, &sim), MVS_E_ARGUMENT, "give both or none");
  CHECK(strcmp(mvs_last_error()->part, "desc.pool_width") == 0);
  desc.pool_width = pool_width;
  desc.workers = 2;
  MUST_FAIL(mvs_create(&desc, &sim), MVS_E_ARGUMENT, "beside a pool");
  desc.run_tasks = NULL;
  desc.workers = 0;
  MUST_FAIL(mvs_create(&desc, &sim), MVS_E_ARGUMENT, "give both or none");
  CHECK(strcmp(mvs_last_error()->part, "desc.run_tasks") == 0);
  desc.pool_width = NULL;
  desc.reserved = 1;
  MUST_FAIL(mvs_create(&desc, &sim), MVS_E_ARGUMENT, "reserved");
  CHECK(sim == NULL);
}

/* Fields beyond the caller's struct size are not read. */
static void a_caller_of_before_has_no_workers(void) {
  mvs_sim *sim = NULL;
  mvs_sim_desc desc = {.struct_size = offsetof(mvs_sim_desc, workers), .workers = UINT32_MAX};
  MUST(mvs_create(&desc, &sim));
  mvs_destroy(sim);
}

static void unused_workers_are_destroyed(void) {
  mvs_sim *sim = NULL;
  mvs_sim_desc desc = {.struct_size = sizeof desc, .workers = MVS_MAX_WORKERS};
  MUST(mvs_create(&desc, &sim));
  mvs_destroy(sim);
}

int main(void) {
  /* small valves share their loops, too */
  if (setenv("MVS_WORKERS_LEAST_US", "0", 1)) return 2;
  closures_have_the_same_bits(0);
  closures_have_the_same_bits(MVS_LEAFLET_LAW_BILINEAR);
  steps_have_the_same_bits();
  slices_over_a_hierarchy_have_the_same_bits();
  a_cancelled_closure_leaves_its_workers_usable();
  simulators_have_workers_of_their_own();
  impossible_workers_are_refused();
  a_caller_of_before_has_no_workers();
  unused_workers_are_destroyed();
  return finish("workers");
}
