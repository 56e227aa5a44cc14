/* mvs_ensemble_run closes a valve along several paths: reproducibility, statistics, refusals. */
#include <math.h>

#include "check.h"

enum { PATHS = 4 }; /* the last one in time, with inertia */

static const mvs_load_case systole = {sizeof(mvs_load_case), 0, MVS_SYSTOLE_PA, 1};

/* The default valve, coarse, and half as thick so that it can fold in several ways. */
static mvs_sim *thin_valve(void) {
  mvs_sim *sim = NULL;
  mvs_parametric_desc desc = {.struct_size = sizeof desc,
                              .vertices = 250,
                              .thickness = 0.5e-3,
                              .shape = MVS_SHAPE_FOUNDING};
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_generate_valve(sim, &desc));
  return sim;
}

static const mvs_snapshot *snapshot_of(mvs_sim *sim) {
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_get_snapshot(sim, &snapshot));
  return snapshot;
}

static mvs_ensemble_options options_of(uint32_t paths, uint64_t seed) {
  mvs_ensemble_options options = {.struct_size = sizeof options, .members = paths, .seed = seed};
  return options;
}

static mvs_ensemble *run(const mvs_snapshot *start, mvs_ensemble_options options) {
  mvs_ensemble *ensemble = NULL;
  MUST(mvs_ensemble_run(start, &systole, NULL, &options, &ensemble));
  return ensemble;
}

static hash128 path_hash(const mvs_ensemble *ensemble, uint32_t path) {
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_ensemble_get_member_snapshot(ensemble, path, &snapshot));
  hash128 hash = snapshot_hash(snapshot);
  mvs_snapshot_release(snapshot);
  return hash;
}

static void path_0_is_the_plain_closure(const mvs_ensemble *ensemble, mvs_sim *sim) {
  mvs_stats plain = {.struct_size = sizeof plain}, told = plain;
  hash128 before = sim_hash(sim);
  const mvs_snapshot *start = snapshot_of(sim), *closed = NULL;
  MUST(mvs_set_load(sim, &systole));
  MUST(mvs_settle(sim, NULL, &plain));
  CHECK(!same_hash(before, sim_hash(sim)));
  CHECK(same_hash(path_hash(ensemble, 0), sim_hash(sim)));
  MUST(mvs_ensemble_get_member_stats(ensemble, 0, &told));
  CHECK(told.converged == 1 && told.iterations == plain.iterations);
  CHECK(told.energy == plain.energy && told.residual == plain.residual);
  /* its plan leads to the same state, so that it can replace the simulator's */
  mvs_replay replay = {.struct_size = sizeof replay};
  static char text[65536];
  uint64_t size = 0;
  MUST(mvs_ensemble_get_member_snapshot(ensemble, 0, &closed));
  MUST(mvs_write_plan(closed, NULL, text, sizeof text, &size));
  MUST(mvs_restore(sim, start));
  MUST(mvs_replay_plan(sim, text, size, &replay));
  CHECK(replay.same_valve == 1 && replay.same_result == 1);
  MUST(mvs_restore(sim, start));
  mvs_snapshot_release(start);
  mvs_snapshot_release(closed);
}

/* The result depends only on the seed, not on earlier runs; more paths do not change the first. */
static void same_seed_same_bits(const mvs_snapshot *start, const mvs_ensemble *ensemble) {
  mvs_ensemble *other = run(start, options_of(3, 5)), *again = run(start, options_of(2, 0));
  for (uint32_t k = 0; k < 2; ++k) CHECK(same_hash(path_hash(ensemble, k), path_hash(again, k)));
  CHECK(same_hash(path_hash(ensemble, 0), path_hash(other, 0)));
  mvs_ensemble_member path = {.struct_size = sizeof path}, moved = path;
  MUST(mvs_ensemble_get_member(ensemble, 2, &path));
  MUST(mvs_ensemble_get_member(other, 2, &moved));
  /* another seed gives another perturbation, which may lead to the same fold */
  CHECK(!same_hash(path_hash(ensemble, 2), path_hash(other, 2)));
  CHECK(path.perturbation > 0 && moved.perturbation > 0);
  mvs_ensemble_release(other);
  mvs_ensemble_release(again);
}

static double number_at(const mvs_view *view, uint64_t row, uint32_t column) {
  return ((const double *)view->data)[row * view->components + column];
}

static void paths_are_told(const mvs_ensemble *ensemble, uint32_t count) {
  mvs_ensemble_summary all = {.struct_size = sizeof all};
  mvs_view pairs = {0};
  MUST(mvs_ensemble_get_summary(ensemble, &all));
  MUST(mvs_ensemble_get_array(ensemble, MVS_ENSEMBLE_ARRAY_PAIR_DISTANCE, &pairs));
  CHECK(all.members == count && all.converged == count && all.lowest < count);
  CHECK(pairs.count == count && pairs.components == count && pairs.type == MVS_TYPE_F64);
  double lowest = INFINITY, squares = 0;
  uint32_t at = 0, equilibria = 0;
  for (uint32_t k = 0; k < count; ++k) {
    mvs_ensemble_member path = {.struct_size = sizeof path};
    mvs_stats stats = {.struct_size = sizeof stats};
    MUST(mvs_ensemble_get_member(ensemble, k, &path));
    MUST(mvs_ensemble_get_member_stats(ensemble, k, &stats));
    CHECK(path.converged == 1 && path.diverged == 0 && path.increments >= 1);
    CHECK((path.ramp > 0) == (k == 3));
    CHECK(path.order >= MVS_ENSEMBLE_ORDER_TOGETHER &&
          path.order <= MVS_ENSEMBLE_ORDER_PRESSURE_FIRST);
    /* the default, 0.5 mm, but for rounding; the displacement is cut where sheets would meet */
    CHECK(k == 0 ? path.perturbation == 0 : path.perturbation > 0);
    CHECK(path.perturbation <= 0.5e-3 * (1 + 1e-12));
    CHECK(path.node_rms <= path.node_max && path.surface_rms <= path.surface_max);
    CHECK(number_at(&pairs, 0, k) == path.node_rms && number_at(&pairs, k, 0) == path.node_rms);
    for (uint32_t j = 0; j < k; ++j) squares += pow(number_at(&pairs, j, k), 2);
    equilibria += path.equilibrium == equilibria;
    if (stats.energy < lowest) at = k;
    lowest = fmin(lowest, stats.energy);
  }
  CHECK(all.lowest == at && all.equilibria == equilibria);
  double rms = sqrt(squares / (count * (count - 1) / 2.0));
  CHECK(fabs(all.node_rms - rms) <= 1e-12 * rms);
}

/* Mean, range and deviation match the measures of the paths' own snapshots. */
static void statistics_are_those_of_the_paths(const mvs_ensemble *ensemble, uint32_t count) {
  mvs_measures of[5], each = {.struct_size = sizeof each};
  for (uint32_t s = 0; s < 5; ++s) {
    of[s].struct_size = sizeof of[s];
    MUST(mvs_ensemble_measure(ensemble, s + 1, &of[s]));
  }
  double sum = 0, squares = 0, least = INFINITY, most = 0;
  for (uint32_t k = 0; k < count; ++k) {
    const mvs_snapshot *snapshot = NULL;
    MUST(mvs_ensemble_get_member_snapshot(ensemble, k, &snapshot));
    MUST(mvs_snapshot_measure(snapshot, &each));
    mvs_snapshot_release(snapshot);
    sum += each.coaptation_area;
    squares += pow(each.coaptation_area - of[0].coaptation_area, 2);
    least = fmin(least, each.coaptation_area);
    most = fmax(most, each.coaptation_area);
    CHECK(each.intersections == 0);
  }
  CHECK(fabs(of[0].coaptation_area - sum / count) <= 1e-12 * most);
  CHECK(of[1].coaptation_area == least && of[2].coaptation_area == most);
  CHECK(fabs(of[3].coaptation_area - sqrt(squares / (count - 1))) <= 1e-12 * most);
  CHECK(of[4].coaptation_area == count && of[4].intersections == count);
  /* the annulus is at its prescribed position on every path */
  CHECK(of[3].annulus_ap == 0 && of[1].annulus_ap == of[2].annulus_ap);
}

/* The deviation is zero at prescribed nodes, and its squares match those of the pairs. For n shapes
 * the mean square from the mean is half the mean square between two picked with replacement. */
static void nodes_spread_as_the_pairs_do(const mvs_snapshot *start, const mvs_ensemble *ensemble) {
  mvs_view nodes = {0}, kind = {0}, pairs = {0};
  MUST(mvs_ensemble_get_array(ensemble, MVS_ENSEMBLE_ARRAY_NODE_DEVIATION, &nodes));
  MUST(mvs_ensemble_get_array(ensemble, MVS_ENSEMBLE_ARRAY_PAIR_DISTANCE, &pairs));
  MUST(mvs_snapshot_get_array(start, MVS_ARRAY_NODE_KIND, &kind));
  CHECK(nodes.count == kind.count && nodes.components == 1);
  double squares = 0, between = 0, sheet = 0;
  for (uint64_t k = 0; k < nodes.count; ++k) {
    uint8_t what = ((const uint8_t *)kind.data)[k];
    double spread_here = number_at(&nodes, k, 0);
    if (what == MVS_NODE_KIND_ANNULUS || what == MVS_NODE_KIND_HEAD) CHECK(spread_here == 0);
    if (what > MVS_NODE_KIND_ANNULUS) continue;
    squares += spread_here * spread_here;
    sheet += 1;
  }
  for (uint64_t a = 0; a < pairs.count; ++a) {
    for (uint32_t b = 0; b < pairs.count; ++b) between += pow(number_at(&pairs, a, b), 2);
  }
  between /= (double)(pairs.count * pairs.count);
  CHECK(between > 0);
  /* sums of 250 squares in another order */
  CHECK(fabs(squares / sheet - between / 2) <= 1e-9 * between);
}

typedef struct host {
  int calls, stop_at, share_fell;
  double share;
} host;

static int32_t take_progress(void *user, double share, double residual) {
  host *h = user;
  ++h->calls;
  h->share_fell |= share < h->share || share > 1 || !(residual >= 0);
  h->share = share;
  return h->stop_at && h->calls >= h->stop_at;
}

static void it_is_told_how_far_it_is_and_can_be_stopped(const mvs_snapshot *start) {
  host h = {0};
  mvs_ensemble_options options = options_of(2, 0);
  options.progress = take_progress;
  options.user = &h;
  mvs_ensemble *ensemble = run(start, options), *kept = NULL;
  CHECK(h.calls > 10 && !h.share_fell && h.share > 0.5);
  mvs_ensemble_release(ensemble);
  /* in the second path: the last call but one */
  h = (host){.stop_at = h.calls - 1};
  MUST_FAIL(mvs_ensemble_run(start, &systole, NULL, &options, &kept), MVS_E_CANCELLED, "cancelled");
  CHECK(kept == NULL);
}

static void paths_not_at_rest_are_not_mixed_in(const mvs_snapshot *start) {
  mvs_settle_options one = {.struct_size = sizeof one, .max_iterations = 1};
  mvs_ensemble_options options = options_of(2, 0);
  mvs_ensemble *ensemble = NULL;
  MUST(mvs_ensemble_run(start, &systole, &one, &options, &ensemble));
  mvs_ensemble_summary all = {.struct_size = sizeof all};
  mvs_ensemble_member path = {.struct_size = sizeof path};
  mvs_measures mean = {.struct_size = sizeof mean}, count = mean;
  MUST(mvs_ensemble_get_summary(ensemble, &all));
  MUST(mvs_ensemble_get_member(ensemble, 1, &path));
  MUST(mvs_ensemble_measure(ensemble, MVS_ENSEMBLE_STATISTIC_MEAN, &mean));
  MUST(mvs_ensemble_measure(ensemble, MVS_ENSEMBLE_STATISTIC_COUNT, &count));
  CHECK(all.converged == 0 && all.equilibria == 0 && all.lowest == UINT32_MAX);
  CHECK(all.node_rms == 0 && path.converged == 0 && path.equilibrium == UINT32_MAX);
  CHECK(path.node_rms > 0); /* the path itself still reports it */
  CHECK(isnan(mean.annulus_ap) && count.annulus_ap == 0);
  mvs_ensemble_release(ensemble);
}

/* From a closed valve: from its present state, the same fold is found; from rest, the plain
 * closure. */
static void a_closed_valve_is_opened_again(mvs_sim *sim) {
  mvs_ensemble_summary near_it = {.struct_size = sizeof near_it};
  mvs_ensemble_member path = {.struct_size = sizeof path};
  const mvs_snapshot *open = snapshot_of(sim);
  mvs_ensemble_options options = options_of(2, 0);
  mvs_ensemble *from_open = run(open, options), *from_rest, *from_start;
  MUST(mvs_set_load(sim, &systole));
  MUST(mvs_settle(sim, NULL, NULL));
  const mvs_snapshot *closed = snapshot_of(sim);
  from_rest = run(closed, options);
  /* the closed valve settles again at once, and the other path is the one from the open valve */
  CHECK(same_hash(path_hash(from_rest, 0), snapshot_hash(closed)));
  CHECK(same_hash(path_hash(from_rest, 1), path_hash(from_open, 1)));
  options.start = MVS_ENSEMBLE_START_SNAPSHOT;
  from_start = run(closed, options);
  MUST(mvs_ensemble_get_summary(from_start, &near_it));
  MUST(mvs_ensemble_get_member(from_start, 1, &path));
  CHECK(near_it.converged == 2 && path.perturbation > 0);
  CHECK(!same_hash(path_hash(from_start, 1), path_hash(from_rest, 1)));
  MUST(mvs_restore(sim, open));
  mvs_snapshot_release(open);
  mvs_snapshot_release(closed);
  mvs_ensemble_release(from_open);
  mvs_ensemble_release(from_rest);
  mvs_ensemble_release(from_start);
}

static void bad_options_are_refused(const mvs_snapshot *start) {
  mvs_ensemble *ensemble = NULL;
  mvs_ensemble_options options = options_of(1001, 0);
  MUST_FAIL(mvs_ensemble_run(start, &systole, NULL, &options, &ensemble), MVS_E_ARGUMENT,
            "1 to 1000");
  options = options_of(2, 0);
  options.perturbation = 1;
  MUST_FAIL(mvs_ensemble_run(start, &systole, NULL, &options, &ensemble), MVS_E_ARGUMENT, "0.005");
  options.perturbation = NAN;
  MUST_FAIL(mvs_ensemble_run(start, &systole, NULL, &options, &ensemble), MVS_E_ARGUMENT, "0.005");
  options = options_of(2, 0);
  options.wavelength = 1e-6;
  MUST_FAIL(mvs_ensemble_run(start, &systole, NULL, &options, &ensemble), MVS_E_ARGUMENT,
            "wavelength");
  options = options_of(2, 0);
  options.tolerance = -1;
  MUST_FAIL(mvs_ensemble_run(start, &systole, NULL, &options, &ensemble), MVS_E_ARGUMENT,
            "tolerance");
  options = options_of(2, 0);
  options.start = 3;
  MUST_FAIL(mvs_ensemble_run(start, &systole, NULL, &options, &ensemble), MVS_E_ARGUMENT,
            "ENSEMBLE_START");
  options = options_of(2, 0);
  options.backend = 9;
  MUST_FAIL(mvs_ensemble_run(start, &systole, NULL, &options, &ensemble), MVS_E_ARGUMENT,
            "BACKEND");
  mvs_load_case load = systole;
  load.pressure = 1e9;
  MUST_FAIL(mvs_ensemble_run(start, &load, NULL, NULL, &ensemble), MVS_E_ARGUMENT, "pressure");
  MUST_FAIL(mvs_ensemble_run(NULL, &systole, NULL, NULL, &ensemble), MVS_E_ARGUMENT, "start");
  MUST_FAIL(mvs_ensemble_run(start, NULL, NULL, NULL, &ensemble), MVS_E_ARGUMENT, "load");
  MUST_FAIL(mvs_ensemble_run(start, &systole, NULL, NULL, NULL), MVS_E_ARGUMENT, "ensemble");
  CHECK(ensemble == NULL);
}

static void bad_questions_are_refused(const mvs_ensemble *ensemble) {
  mvs_ensemble_member path = {.struct_size = sizeof path};
  mvs_measures measures = {.struct_size = sizeof measures};
  mvs_stats stats = {.struct_size = sizeof stats};
  const mvs_snapshot *snapshot = NULL;
  mvs_view view;
  MUST_FAIL(mvs_ensemble_get_member(ensemble, PATHS, &path), MVS_E_ARGUMENT, "0 to 3");
  MUST_FAIL(mvs_ensemble_get_member_stats(ensemble, PATHS, &stats), MVS_E_ARGUMENT, "0 to 3");
  MUST_FAIL(mvs_ensemble_get_member_snapshot(ensemble, PATHS, &snapshot), MVS_E_ARGUMENT, "0 to 3");
  MUST_FAIL(mvs_ensemble_measure(ensemble, 0, &measures), MVS_E_ARGUMENT, "statistic");
  MUST_FAIL(mvs_ensemble_measure(ensemble, 6, &measures), MVS_E_ARGUMENT, "statistic");
  MUST_FAIL(mvs_ensemble_get_array(ensemble, 3, &view), MVS_E_ARGUMENT, "which");
  MUST_FAIL(mvs_ensemble_get_summary(NULL, NULL), MVS_E_ARGUMENT, "ensemble");
  mvs_ensemble_release(NULL);
}

int main(void) {
  mvs_sim *sim = thin_valve();
  const mvs_snapshot *start = snapshot_of(sim);
  hash128 before = snapshot_hash(start);
  mvs_ensemble *ensemble = run(start, options_of(PATHS, 0));
  CHECK(same_hash(before, snapshot_hash(start)) && same_hash(before, sim_hash(sim)));
  path_0_is_the_plain_closure(ensemble, sim);
  same_seed_same_bits(start, ensemble);
  paths_are_told(ensemble, PATHS);
  statistics_are_those_of_the_paths(ensemble, PATHS);
  nodes_spread_as_the_pairs_do(start, ensemble);
  it_is_told_how_far_it_is_and_can_be_stopped(start);
  paths_not_at_rest_are_not_mixed_in(start);
  a_closed_valve_is_opened_again(sim);
  bad_options_are_refused(start);
  bad_questions_are_refused(ensemble);
  mvs_ensemble_release(ensemble);
  mvs_snapshot_release(start);
  mvs_destroy(sim);
  return finish("ensemble_run");
}
