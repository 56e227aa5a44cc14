/* mvs_ensemble_run closes a valve along several paths: reproducibility, statistics. */
#include <math.h>

#include "check.h"
#include "paths.h"

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
  a_closed_valve_is_opened_again(sim);
  mvs_ensemble_release(ensemble);
  mvs_snapshot_release(start);
  mvs_destroy(sim);
  return finish("ensemble_run");
}
