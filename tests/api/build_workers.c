/* Builds on worker threads: the same bits, progress on the calling thread, cancelling. */
#include <pthread.h>

#include "surface.h"

/* Calls of the progress callback. */
typedef struct progress_log {
  uint32_t calls, most_calls; /* the call of this number cancels; 0: none does */
  double last;
  int grows, is_on_caller;
  pthread_t caller;
} progress_log;

static int32_t log_progress(void *user, double share, double residual) {
  progress_log *log = user;
  (void)residual;
  log->grows = log->grows && share >= log->last && share <= 1;
  log->is_on_caller = log->is_on_caller && pthread_equal(log->caller, pthread_self());
  log->last = share;
  return ++log->calls == log->most_calls;
}

static mvs_sim *sim_with(uint32_t workers, progress_log *log) {
  mvs_sim *sim = NULL;
  const mvs_sim_desc desc = {
      .struct_size = sizeof desc, .workers = workers, .progress = log_progress, .user = log};
  MUST(mvs_create(&desc, &sim));
  return sim;
}

/* The positions of the closed leaflets of the generated valve with chords a twentieth longer. */
static void take_closed(const surface *s, double (*closed)[3]) {
  mvs_sim *sim = NULL;
  const mvs_snapshot *snapshot = NULL;
  const mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  const mvs_parametric_desc longer = {.struct_size = sizeof longer, .chord_slack = 1.05};
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_generate_valve(sim, &longer));
  MUST(mvs_set_load(sim, &systole));
  MUST(mvs_settle(sim, NULL, NULL));
  MUST(mvs_get_snapshot(sim, &snapshot));
  const mvs_view nodes = array_of(snapshot, MVS_ARRAY_NODE_POSITION, most_points);
  memcpy(closed, nodes.data, sizeof(double) * 3 * s->point_count);
  mvs_snapshot_release(snapshot);
  mvs_destroy(sim);
}

static int same_findings(const mvs_findings *a, const mvs_findings *b) {
  uint32_t count = 0, others = 0;
  MUST(mvs_findings_get_count(a, &count));
  MUST(mvs_findings_get_count(b, &others));
  for (uint32_t k = 0; count == others && k < count; ++k) {
    mvs_finding x = {.struct_size = sizeof x}, y = {.struct_size = sizeof y};
    MUST(mvs_findings_get(a, k, &x));
    MUST(mvs_findings_get(b, k, &y));
    if (strcmp(x.name, y.name) != 0 || strcmp(x.sentence, y.sentence) != 0 ||
        x.confidence != y.confidence || x.values.count != y.values.count ||
        !same_bits(x.values.data, y.values.data, sizeof(double) * x.values.count)) {
      printf("\"%s\": %s\n\"%s\": %s\n", x.name, x.sentence, y.name, y.sentence);
      return 0;
    }
  }
  return count == others;
}

static void workers_change_no_bit_of_a_build(const mvs_surface_desc *desc) {
  /* 110 vertices and one law: a fit takes a second */
  const mvs_build_options options = {.struct_size = sizeof options,
                                     .edge = 4.5e-3,
                                     .thickness_error = 0.2e-3,
                                     .leaflet_law = MVS_LEAFLET_LAW_BILINEAR};
  progress_log of_one = {.grows = 1, .is_on_caller = 1, .caller = pthread_self()};
  progress_log of_three = of_one;
  mvs_sim *one = sim_with(1, &of_one), *three = sim_with(3, &of_three);
  mvs_findings *a = NULL, *b = NULL;
  MUST(mvs_build_valve(one, desc, &options, &a));
  MUST(mvs_build_valve(three, desc, &options, &b));
  CHECK(same_hash(sim_hash(one), sim_hash(three)));
  CHECK(same_findings(a, b));
  CHECK(of_one.grows && of_one.is_on_caller && of_one.calls > 10);
  CHECK(of_three.grows && of_three.is_on_caller && of_three.calls > 10);
  mvs_findings_release(a);
  mvs_findings_release(b);
  mvs_destroy(one);
  mvs_destroy(three);
}

/* At the first call of the callback, in the fit and in the closures for the leak. */
static void a_build_on_workers_can_be_cancelled(const mvs_surface_desc *desc) {
  const mvs_build_options options = {.struct_size = sizeof options, .edge = 4.5e-3};
  for (uint32_t calls = 1; calls <= 31; calls += 15) {
    progress_log log = {
        .most_calls = calls, .grows = 1, .is_on_caller = 1, .caller = pthread_self()};
    mvs_sim *sim = sim_with(3, &log);
    MUST(mvs_generate_valve(sim, NULL));
    const hash128 before = sim_hash(sim);
    mvs_findings *findings = NULL;
    MUST_FAIL(mvs_build_valve(sim, desc, &options, &findings), MVS_E_CANCELLED, "progress");
    CHECK(log.calls == calls);
    CHECK(findings == NULL);
    CHECK(same_hash(before, sim_hash(sim)));
    mvs_destroy(sim);
  }
}

int main(void) {
  static surface s;
  static double closed[most_points][3];
  take_surface(&s);
  take_closed(&s, closed);
  mvs_surface_desc desc = desc_of(&s);
  desc.closed_points = points_of(closed, s.point_count);
  desc.closed_triangles = desc.triangles;
  workers_change_no_bit_of_a_build(&desc);
  a_build_on_workers_can_be_cancelled(&desc);
  return finish("build_workers");
}
