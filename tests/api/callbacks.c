/* Callbacks report progress and warnings to the host, and the host cancels work through them. */
#include "check.h"
#include "funnel.h"

typedef struct host {
  mvs_sim *sim;
  char last[512];
  int lines, warnings, calls, stop_at;
  double share, residual;
  int share_fell, reentered, seen;
} host;

static void take_line(void *user, mvs_log_level level, const char *text) {
  host *h = user;
  ++h->lines;
  h->warnings += level == MVS_LOG_WARNING;
  CHECK(text[0] != 0 && strchr(text, '\n') == NULL);
  if (level != MVS_LOG_INFO || h->warnings == 0) snprintf(h->last, sizeof h->last, "%s", text);
}

static int32_t take_progress(void *user, double share, double residual) {
  host *h = user;
  ++h->calls;
  h->share_fell |= share < h->share;
  h->share = share;
  h->residual = residual;
  /* the simulator is busy: it refuses another call, but returns its latest snapshot */
  h->reentered |= mvs_step(h->sim, NULL) != MVS_E_STATE;
  /* an operation can be checked, as from any thread: it reads the latest snapshot */
  const mvs_op_annulus_scale op = {{sizeof op, MVS_OP_ANNULUS_SCALE}, 0.9, 0, 0};
  CHECK(mvs_check_op(h->sim, &op.op) == MVS_OK);
  CHECK(mvs_apply_op(h->sim, &op.op, NULL) == MVS_E_STATE);
  const mvs_snapshot *snapshot = NULL;
  h->seen += mvs_get_snapshot(h->sim, &snapshot) == MVS_OK;
  mvs_snapshot_release(snapshot);
  return h->stop_at && h->calls >= h->stop_at;
}

static void settle_with(host *h, mvs_result wanted) {
  static funnel f;
  mvs_sim_desc desc = {
      .struct_size = sizeof desc, .log = take_line, .progress = take_progress, .user = h};
  mvs_load_case load = funnel_load();
  make_funnel(&f);
  MUST(mvs_create(&desc, &h->sim));
  MUST(mvs_set_valve(h->sim, &f.desc));
  CHECK(h->lines == 1);
  MUST(mvs_set_load(h->sim, &load));
  hash128 before = sim_hash(h->sim);
  mvs_stats stats = {.struct_size = sizeof stats};
  CHECK(mvs_settle(h->sim, NULL, &stats) == wanted);
  CHECK(same_hash(before, sim_hash(h->sim)) == (wanted != MVS_OK));
  if (wanted != MVS_OK) MUST_FAIL(mvs_get_stats(h->sim, &stats), MVS_E_STATE, "no statistics");
}

static void progress_is_told_rises_and_ends_at_1(void) {
  host h = {0};
  settle_with(&h, MVS_OK);
  CHECK(h.calls > 0 && h.share == 1 && !h.share_fell);
  CHECK(h.residual >= 0);
  CHECK(h.lines == 2);
  CHECK(!h.reentered && h.seen == h.calls);
  mvs_destroy(h.sim);
}

static void a_cancelled_settle_changes_nothing(void) {
  host h = {.stop_at = 1};
  settle_with(&h, MVS_E_CANCELLED);
  CHECK(h.calls == 1);
  CHECK(strlen(mvs_last_error()->message) > 0);
  /* and the simulator still works */
  h.stop_at = 0;
  MUST(mvs_settle(h.sim, NULL, NULL));
  mvs_destroy(h.sim);
}

/* A host that asks to cancel once, at any call, the last included: an ensemble went on with its
 * next member if the request came at the end of one. */
static int32_t cancel_once(void *user, double share, double residual) {
  host *h = user;
  (void)residual;
  ++h->calls;
  if (share <= 0.5) h->seen = h->calls; /* the last call of the first of two members */
  return h->calls == h->stop_at;
}

static void a_single_request_cancels_an_ensemble(void) {
  static funnel f;
  const mvs_snapshot *start;
  mvs_ensemble *made = NULL;
  mvs_sim *sim;
  host h = {0};
  mvs_load_case load = funnel_load();
  mvs_ensemble_options options = {
      .struct_size = sizeof options, .members = 2, .progress = cancel_once, .user = &h};
  make_funnel(&f);
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_set_valve(sim, &f.desc));
  MUST(mvs_get_snapshot(sim, &start));
  MUST(mvs_ensemble_run(start, &load, NULL, &options, &made));
  mvs_ensemble_release(made);
  const int requests[] = {1, h.seen, h.seen + 1, h.calls};
  for (int k = 0; k < 4; ++k) {
    h = (host){.stop_at = requests[k]};
    MUST_FAIL(mvs_ensemble_run(start, &load, NULL, &options, &made), MVS_E_CANCELLED, "cancelled");
    CHECK(h.calls == requests[k]);
  }
  mvs_snapshot_release(start);
  mvs_destroy(sim);
}

static void not_converged_is_a_warning_and_no_error(void) {
  host h = {0};
  settle_with(&h, MVS_OK);
  CHECK(h.warnings == 0);
  mvs_settle_options once = {.struct_size = sizeof once, .max_iterations = 1, .residual = 1e-12};
  mvs_load_case load = funnel_load();
  load.pressure *= 2;
  MUST(mvs_set_load(h.sim, &load));
  mvs_stats stats = {.struct_size = sizeof stats};
  MUST(mvs_settle(h.sim, &once, &stats));
  CHECK(stats.converged == 0);
  CHECK(h.warnings == 1);
  mvs_destroy(h.sim);
}

/* Edges below the contact thickness and needles are no faults; both are warned of with the remedy.
 */
static void small_edges_and_needles_are_warned_of(void) {
  static funnel f;
  host h = {0};
  mvs_sim_desc desc = {.struct_size = sizeof desc, .log = take_line, .user = &h};
  make_funnel(&f);
  f.desc.contact_thickness = 5e-3; /* the funnel's lower edges are 3.5 mm long */
  MUST(mvs_create(&desc, &h.sim));
  MUST(mvs_set_valve(h.sim, &f.desc));
  CHECK(h.lines == 2 && h.warnings == 1);
  CHECK(strstr(h.last, "`mvs remesh FILE --edge 10 -o OUT`") != NULL);
  CHECK(strstr(h.last, "edges are shorter than the contact thickness of 0.005 m") != NULL);
  /* node 33 is a micrometre away from node 32 */
  for (int k = 0; k < 3; ++k) f.nodes[33][k] = f.nodes[32][k] + (k == 1 ? 1e-6 : 0);
  MUST(mvs_set_valve(h.sim, &f.desc));
  CHECK(h.warnings == 3);
  CHECK(strstr(h.last, "`mvs remesh FILE --edge 10 -o OUT`") != NULL);
  CHECK(strstr(h.last, "the triangle of nodes 17, 33, 32 is 7.74e-07 m high") != NULL);
  CHECK(strstr(h.last, "under a hundredth of the contact thickness of 0.005 m (2 of") != NULL);
  /* a corner far from the others, but nearly on the line between them */
  make_funnel(&f);
  f.desc.contact_thickness = 5e-3;
  const uint32_t *t = f.triangles[FUNNEL_TRIANGLES - 1];
  const uint32_t top = t[0] > t[1] ? (t[0] > t[2] ? 0 : 2) : (t[1] > t[2] ? 1 : 2);
  double *moved = f.nodes[t[top]];
  const double *b = f.nodes[t[(top + 1) % 3]], *c = f.nodes[t[(top + 2) % 3]];
  for (int k = 0; k < 3; ++k) moved[k] = 0.5 * (b[k] + c[k]) + (k == 0 ? 2e-5 : 0);
  h.warnings = 0;
  MUST(mvs_set_valve(h.sim, &f.desc));
  CHECK(h.warnings == 2);
  char told[80];
  snprintf(told, sizeof told, "the triangle of nodes %u, %u, %u is ", t[0], t[1], t[2]);
  CHECK(strstr(h.last, told) != NULL && strstr(h.last, "(1 of them)") != NULL);
  mvs_destroy(h.sim);
}

/* Every measure depends on AP, CC, A and P. */
static void which_side_is_taken_for_the_anterior_one_is_told(void) {
  static funnel f;
  host h = {0};
  mvs_sim_desc desc = {.struct_size = sizeof desc, .log = take_line, .user = &h};
  make_funnel(&f);
  f.leaflets[0].name = "Septal";
  MUST(mvs_create(&desc, &h.sim));
  MUST(mvs_set_valve(h.sim, &f.desc));
  CHECK(h.warnings == 1);
  CHECK(strstr(h.last, "no leaflet is named A: Septal is assumed to be anterior") != NULL);
  f.leaflets[0].name = "M";
  f.desc.leaflet_count = 1;
  for (int t = 0; t < FUNNEL_TRIANGLES; ++t) f.leaflet[t] = 0;
  MUST(mvs_set_valve(h.sim, &f.desc));
  CHECK(h.warnings == 2);
  CHECK(strstr(h.last, "so that the annulus is 30 mm wide") != NULL);
  mvs_destroy(h.sim);
}

/* The commonest mistake of an import: the loop of the free edge given as the annulus. */
static void chordae_at_the_annulus_are_told(void) {
  static funnel f;
  host h = {0};
  mvs_sim_desc desc = {.struct_size = sizeof desc, .log = take_line, .user = &h};
  make_funnel(&f);
  f.chords[3].node_b = f.annulus[2];
  MUST(mvs_create(&desc, &h.sim));
  MUST(mvs_set_valve(h.sim, &f.desc));
  CHECK(h.warnings == 1);
  CHECK(strstr(h.last, "1 of 10 chordae end at the annulus") != NULL);
  mvs_destroy(h.sim);
}

int main(void) {
  which_side_is_taken_for_the_anterior_one_is_told();
  chordae_at_the_annulus_are_told();
  small_edges_and_needles_are_warned_of();
  progress_is_told_rises_and_ends_at_1();
  a_cancelled_settle_changes_nothing();
  a_single_request_cancels_an_ensemble();
  not_converged_is_a_warning_and_no_error();
  return finish("callbacks");
}
