/* mvs_ensemble_run that is stopped, reaches no rest or gets wrong arguments: nothing is returned or
 * mixed in, and each refusal has its code and a sentence. */
#include <math.h>

#include "check.h"
#include "paths.h"

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
  mvs_ensemble *ensemble = run(start, options_of(PATHS, 0));
  it_is_told_how_far_it_is_and_can_be_stopped(start);
  paths_not_at_rest_are_not_mixed_in(start);
  bad_options_are_refused(start);
  bad_questions_are_refused(ensemble);
  mvs_ensemble_release(ensemble);
  mvs_snapshot_release(start);
  mvs_destroy(sim);
  return finish("ensemble_faults");
}
