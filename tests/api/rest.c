/* Rest is part of the state: what finds it, what ends it, what keeps it; no settle is endless. */
#include <math.h>
#include <stdio.h>

#include "check.h"
#include "funnel.h"
#include "tests/founding.h"

static mvs_sim *sim;

static mvs_measures measures_now(void) {
  const mvs_snapshot *snapshot = NULL;
  mvs_measures m = {.struct_size = sizeof m};
  mvs_rest rest = {.struct_size = sizeof rest};
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST(mvs_snapshot_measure(snapshot, &m));
  MUST(mvs_snapshot_get_rest(snapshot, &rest));
  CHECK(rest.at_rest == m.at_rest && (rest.tolerance > 0) == (m.at_rest == 1));
  mvs_snapshot_release(snapshot);
  return m;
}

static int at_rest(void) {
  return (int)measures_now().at_rest;
}

static mvs_stats settle_at_most(uint32_t iterations) {
  mvs_settle_options options = {.struct_size = sizeof options, .max_iterations = iterations};
  mvs_stats stats = {.struct_size = sizeof stats};
  MUST(mvs_settle(sim, &options, &stats));
  return stats;
}

static void new_valve(mvs_load_case load) {
  static funnel f;
  make_funnel(&f);
  MUST(mvs_set_valve(sim, &f.desc));
  MUST(mvs_set_load(sim, &load));
}

static void only_a_settle_that_converges_finds_rest(void) {
  new_valve(funnel_load());
  CHECK(!at_rest());
  CHECK(settle_at_most(2).converged == 0 && !at_rest());
  CHECK(settle_at_most(0).converged == 1 && at_rest());
  mvs_load_case none = {.struct_size = sizeof none};
  new_valve(none);
  CHECK(settle_at_most(0).converged == 1);
  CHECK(measures_now().at_rest == 1 && measures_now().under_load == 0);
}

/* Rest is stable: the margins of the settle are those of the snapshot, and the mode has length 1.
 */
static void a_settle_reports_how_stable_rest_is(void) {
  const mvs_snapshot *snapshot = NULL;
  mvs_stability stability = {.struct_size = sizeof stability};
  mvs_view mode;
  new_valve(funnel_load());
  const mvs_stats unfinished = settle_at_most(2);
  CHECK(unfinished.stable == 0 && unfinished.stiffness_margin == 0 && unfinished.growth_rate == 0);
  const mvs_stats stats = settle_at_most(0);
  CHECK(stats.stable == 1 && stats.stiffness_margin > 0 && stats.growth_rate < 0);
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST(mvs_snapshot_get_stability(snapshot, &stability));
  CHECK(stability.stable == 1);
  /* each within 1 % */
  CHECK(fabs(stability.stiffness_margin / stats.stiffness_margin - 1) < 0.02);
  CHECK(fabs(stability.growth_rate / stats.growth_rate - 1) < 0.02);
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_NODE_MODE, &mode));
  double longest = 0;
  for (uint64_t i = 0; i < mode.count; ++i) {
    const double *d = (const double *)mode.data + 3 * i;
    longest = fmax(longest, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  }
  CHECK(fabs(longest - 1) < 1e-12);
  MUST_FAIL(mvs_snapshot_get_stability(snapshot, NULL), MVS_E_ARGUMENT, "stability");
  MUST_FAIL(mvs_snapshot_get_stability(NULL, &stability), MVS_E_ARGUMENT, "snapshot");
  mvs_snapshot_release(snapshot);
}

/* Without margins the rest is the same, and proved to be stable. */
static void a_settle_leaves_out_margins_where_asked(void) {
  mvs_settle_options options = {.struct_size = sizeof options, .flags = MVS_SETTLE_NO_MARGINS};
  mvs_stats stats = {.struct_size = sizeof stats};
  for (mvs_solver solver = MVS_SOLVER_NEWTON; solver <= MVS_SOLVER_IMPLICIT; ++solver) {
    options.solver = solver;
    uint64_t hash[2][2];
    for (int without = 0; without < 2; ++without) {
      const mvs_snapshot *snapshot = NULL;
      new_valve(funnel_load());
      options.flags = without ? MVS_SETTLE_NO_MARGINS : 0;
      MUST(mvs_settle(sim, &options, &stats));
      CHECK(stats.converged == 1 && stats.stable == 1);
      CHECK((stats.stiffness_margin > 0) == !without && (stats.growth_rate < 0) == !without);
      MUST(mvs_get_snapshot(sim, &snapshot));
      MUST(mvs_snapshot_get_hash(snapshot, hash[without]));
      mvs_snapshot_release(snapshot);
    }
    CHECK(hash[0][0] == hash[1][0] && hash[0][1] == hash[1][1]);
  }
  options.flags = MVS_SETTLE_NO_MARGINS << 1;
  MUST_FAIL(mvs_settle(sim, &options, &stats), MVS_E_ARGUMENT, "options.flags");
}

static mvs_id add_ball(double x) {
  mvs_tool_desc desc = {.struct_size = sizeof desc, .kind = MVS_TOOL_KIND_BALL};
  mvs_id tool = 0;
  desc.position[0] = x;
  desc.radius = 1e-3;
  MUST(mvs_add_tool(sim, &desc, &tool));
  return tool;
}

static void load_tools_and_tissue_end_rest(void) {
  const mvs_load_case load = funnel_load();
  mvs_load_case more = load;
  mvs_leaflet_desc membrane = {.law = MVS_LEAFLET_LAW_BILINEAR};
  mvs_stats stats = {.struct_size = sizeof stats};
  new_valve(load);
  settle_at_most(0);
  more.pressure *= 1.01;
  MUST(mvs_set_load(sim, &more));
  MUST(mvs_get_stats(sim, &stats));
  CHECK(!at_rest() && stats.converged == 0 && stats.stable == 0);
  CHECK(settle_at_most(0).converged == 1 && at_rest());
  const mvs_id tool = add_ball(0.2);
  CHECK(!at_rest());
  CHECK(settle_at_most(0).converged == 1 && at_rest());
  MUST(mvs_remove_tool(sim, tool));
  CHECK(!at_rest());
  CHECK(settle_at_most(0).converged == 1 && at_rest());
  MUST(mvs_set_leaflet(sim, 0, &membrane));
  CHECK(!at_rest());
}

static void a_step_that_moves_ends_rest_and_one_that_stands_keeps_it(void) {
  mvs_load_case load = funnel_load();
  mvs_settle_options exact = {.struct_size = sizeof exact, .residual = 1e-10};
  new_valve(load);
  MUST(mvs_settle(sim, &exact, NULL));
  MUST(mvs_step(sim, NULL));
  CHECK(at_rest());
  load.pressure *= 0.5;
  MUST(mvs_set_load(sim, &load));
  MUST(mvs_step(sim, NULL));
  CHECK(!at_rest());
  for (int k = 0; k < 2000 && !at_rest(); ++k) {
    for (int s = 0; s < 20; ++s) MUST(mvs_step(sim, NULL));
  }
  CHECK(at_rest());
}

static void files_and_snapshots_keep_rest(void) {
  static char text[1 << 20];
  uint64_t size = 0;
  const mvs_snapshot *resting = NULL;
  mvs_load_case none = {.struct_size = sizeof none};
  new_valve(funnel_load());
  settle_at_most(0);
  MUST(mvs_get_snapshot(sim, &resting));
  MUST(mvs_save_memory(resting, MVS_FORMAT_OBJ, text, sizeof text, &size));
  MUST(mvs_set_load(sim, &none));
  CHECK(!at_rest());
  MUST(mvs_load_memory(sim, text, size, MVS_FORMAT_OBJ));
  CHECK(at_rest());
  MUST(mvs_set_load(sim, &none));
  MUST(mvs_restore(sim, resting));
  CHECK(at_rest());
  mvs_snapshot_release(resting);
}

/* A neo-Hookean balloon has a limit load: with mu h / r of 1.3 kPa it bears about 0.8 kPa. */
static void tissue_that_yields_without_end_is_refused(void) {
  mvs_leaflet_desc soft = {.law = MVS_LEAFLET_LAW_NEO_HOOKEAN};
  mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  soft.constants[0] = 1e5 / 3;
  new_valve(systole);
  MUST(mvs_set_leaflet(sim, 0, &soft));
  const hash128 before = sim_hash(sim);
  MUST_FAIL(mvs_settle(sim, NULL, NULL), MVS_E_DIVERGED, "yields without end");
  CHECK(same_hash(before, sim_hash(sim)) && !at_rest());
  /* the law's own constants bear systolic pressure */
  memset(soft.constants, 0, sizeof soft.constants);
  MUST(generate_founding(sim));
  MUST(mvs_set_leaflet(sim, 0, &soft));
  MUST(mvs_set_load(sim, &systole));
  CHECK(settle_at_most(0).converged == 1);
  CHECK(measures_now().max_leaflet_strain < 1);
}

/* Two triangles of a leaflet are pulled through another: the valve is accepted, with a warning. */
static void take_fault(void *user, const char *part, const char *sentence) {
  (void)part;
  if (strstr(sentence, "triangles cross")) ++*(int *)user;
}

static void triangles_that_cross_are_warned_of(void) {
  static funnel f;
  int crossings = 0;
  make_funnel(&f);
  MUST(mvs_check_valve(&f.desc, take_fault, &crossings));
  CHECK(crossings == 0);
  /* a vertex of the lowest row goes through the opposite wall */
  const uint32_t low = FUNNEL_SHEET - FUNNEL_SEGMENTS;
  f.nodes[low][0] = -16e-3;
  f.nodes[low][2] = -9e-3;
  MUST(mvs_check_valve(&f.desc, take_fault, &crossings));
  CHECK(crossings == 1);
}

typedef struct told {
  int count;
  char part[64], sentence[512];
} told;

static void take_touching(void *user, const char *part, const char *sentence) {
  told *t = user;
  if (!strstr(sentence, "do not touch each other")) return;
  ++t->count;
  snprintf(t->part, sizeof t->part, "%s", part);
  snprintf(t->sentence, sizeof t->sentence, "%s", sentence);
}

/* A tip of the lowest row, 0.4 mm from the opposite wall: they would pass for one piece of tissue,
   without contact. */
static void tissue_that_touches_itself_at_rest_is_warned_of(void) {
  static funnel f;
  static told t;
  const uint32_t low = FUNNEL_SHEET - FUNNEL_SEGMENTS, across = low + FUNNEL_SEGMENTS / 2;
  make_funnel(&f);
  f.desc.contact_thickness = 1e-3;
  MUST(mvs_check_valve(&f.desc, take_touching, &t));
  CHECK(t.count == 0);
  f.nodes[low][0] = f.nodes[across][0] + 0.4e-3;
  MUST(mvs_check_valve(&f.desc, take_touching, &t));
  CHECK(t.count == 1);
  /* from the lower side of a triangle of node 56: 0.4 mm times the cosine of half a segment */
  CHECK(strcmp(t.part, "node 48") == 0);
  CHECK(strstr(t.sentence, "2 vertices lie nearer than the contact thickness of 0.001 m") != NULL);
  CHECK(strstr(t.sentence, "node 48 of ") != NULL &&
        strstr(t.sentence, " is 0.000392 m from") != NULL);
  CHECK(strstr(t.sentence, "at (-0.0086, ") != NULL);
  /* farther than the contact thickness */
  f.nodes[low][0] = f.nodes[across][0] + 1.2e-3;
  t.count = 0;
  MUST(mvs_check_valve(&f.desc, take_touching, &t));
  CHECK(t.count == 0);
}

int main(void) {
  MUST(mvs_create(NULL, &sim));
  only_a_settle_that_converges_finds_rest();
  a_settle_reports_how_stable_rest_is();
  a_settle_leaves_out_margins_where_asked();
  load_tools_and_tissue_end_rest();
  a_step_that_moves_ends_rest_and_one_that_stands_keeps_it();
  files_and_snapshots_keep_rest();
  tissue_that_yields_without_end_is_refused();
  triangles_that_cross_are_warned_of();
  tissue_that_touches_itself_at_rest_is_warned_of();
  mvs_destroy(sim);
  return finish("rest");
}
