/* mvs_build_valve: a surface and landmarks become a valve that closes; findings; its leak over
 * errors of lengths and thickness; refusals. */
#include <math.h>
#include <stdlib.h>

#include "surface.h"

static void a_surface_becomes_a_valve_that_closes(surface *s) {
  mvs_sim *sim = NULL, *again = NULL;
  mvs_findings *findings = NULL;
  mvs_finding finding = {.struct_size = sizeof finding};
  const mvs_surface_desc desc = desc_of(s);
  /* 350 vertices: closures take a tenth of the time of the default */
  const mvs_build_options coarse = {.struct_size = sizeof coarse, .edge = 2.4e-3};
  const mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  mvs_stats stats = {.struct_size = sizeof stats};
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_build_valve(sim, &desc, &coarse, &findings));
  const char *const wanted[] = {"annulus",        "commissures", "anterior", "thickness",
                                "papillary_tips", "chordae",     "leak"};
  for (size_t k = 0; k < sizeof wanted / sizeof *wanted; ++k) {
    const uint32_t at = find(findings, wanted[k], &finding);
    if (at == UINT32_MAX) printf("no finding \"%s\"\n", wanted[k]);
    CHECK(at != UINT32_MAX);
    if (at == UINT32_MAX) continue;
    CHECK(strlen(finding.sentence) > 10);
    CHECK(finding.confidence >= 0 && finding.confidence <= 1);
    CHECK(finding.doubtful == 0);
    CHECK(finding.source >= MVS_FINDING_SOURCE_GIVEN &&
          finding.source <= MVS_FINDING_SOURCE_ASSUMED);
  }
  CHECK(find(findings, "thickness", &finding) != UINT32_MAX);
  CHECK(finding.source == MVS_FINDING_SOURCE_ASSUMED);
  CHECK(find(findings, "papillary_tips", &finding) != UINT32_MAX);
  CHECK(finding.source == MVS_FINDING_SOURCE_GIVEN);
  MUST(mvs_set_load(sim, &systole));
  MUST(mvs_settle(sim, NULL, &stats));
  CHECK(stats.converged == 1);
  mvs_findings_release(findings);
  /* the same input gives the same bits; no findings are asked for here */
  MUST(mvs_create(NULL, &again));
  MUST(mvs_build_valve(again, &desc, &coarse, NULL));
  MUST(mvs_set_load(again, &systole));
  MUST(mvs_settle(again, NULL, &stats));
  CHECK(same_hash(sim_hash(sim), sim_hash(again)));
  mvs_destroy(again);
  mvs_destroy(sim);
}

static void an_edge_and_a_thickness_that_are_not_sure_change_findings_only(surface *s) {
  mvs_sim *exact = NULL, *unsure = NULL;
  mvs_findings *findings = NULL;
  mvs_finding finding = {.struct_size = sizeof finding};
  const mvs_surface_desc desc = desc_of(s);
  /* 200 vertices: the closures of the interval are short */
  mvs_build_options options = {.struct_size = sizeof options, .edge = 3.2e-3};
  MUST(mvs_create(NULL, &exact));
  MUST(mvs_build_valve(exact, &desc, &options, &findings));
  CHECK(find(findings, "edge_error", &finding) == UINT32_MAX);
  CHECK(find(findings, "edge_lost", &finding) == UINT32_MAX);
  mvs_findings_release(findings);
  options.edge_error = 0.35e-3;
  options.edge_lost = 1.5e-3;
  options.thickness_error = 0.2e-3;
  MUST(mvs_create(NULL, &unsure));
  MUST(mvs_build_valve(unsure, &desc, &options, &findings));
  CHECK(find(findings, "edge_error", &finding) != UINT32_MAX);
  CHECK(((const double *)finding.values.data)[0] == 0.35e-3);
  CHECK(finding.source == MVS_FINDING_SOURCE_GIVEN);
  CHECK(find(findings, "edge_lost", &finding) != UINT32_MAX);
  CHECK(((const double *)finding.values.data)[0] == 1.5e-3);
  CHECK(find(findings, "thickness_error", &finding) != UINT32_MAX);
  CHECK(((const double *)finding.values.data)[0] == 0.2e-3);
  CHECK(find(findings, "leak_interval", &finding) != UINT32_MAX);
  CHECK(strstr(finding.sentence, "1.9 mm farther out") != NULL);
  CHECK(strstr(finding.sentence, "0.20 mm thicker") != NULL);
  CHECK(same_hash(sim_hash(exact), sim_hash(unsure)));
  mvs_findings_release(findings);
  mvs_destroy(exact);
  mvs_destroy(unsure);
}

static int32_t cancel(void *user, double share, double residual) {
  (void)user;
  (void)share;
  (void)residual;
  return 1;
}

static void the_leak_is_found_in_the_build_or_later_with_the_same_figures(surface *s) {
  mvs_sim *with = NULL, *without = NULL, *stopped = NULL;
  mvs_findings *findings = NULL, *found = NULL;
  mvs_finding finding = {.struct_size = sizeof finding};
  const mvs_surface_desc desc = desc_of(s);
  mvs_build_options options = {.struct_size = sizeof options, .edge = 3.2e-3};
  double leak[3], interval[2];
  MUST(mvs_create(NULL, &with));
  MUST(mvs_build_valve(with, &desc, &options, &findings));
  CHECK(find(findings, "leak", &finding) != UINT32_MAX && finding.values.count == 3);
  memcpy(leak, finding.values.data, sizeof leak);
  CHECK(find(findings, "leak_interval", &finding) != UINT32_MAX && finding.values.count == 2);
  memcpy(interval, finding.values.data, sizeof interval);
  mvs_findings_release(findings);
  options.without_leak = 1;
  MUST(mvs_create(NULL, &without));
  MUST(mvs_build_valve(without, &desc, &options, &findings));
  CHECK(find(findings, "leak", &finding) == UINT32_MAX);
  CHECK(find(findings, "leak_interval", &finding) == UINT32_MAX);
  CHECK(same_hash(sim_hash(with), sim_hash(without)));
  mvs_findings_release(findings);
  MUST(mvs_find_leak_interval(without, NULL, &found));
  CHECK(same_hash(sim_hash(with), sim_hash(without)));
  CHECK(find(found, "leak", &finding) != UINT32_MAX);
  CHECK(same_bits(leak, finding.values.data, sizeof leak));
  CHECK(find(found, "leak_interval", &finding) != UINT32_MAX);
  CHECK(same_bits(interval, finding.values.data, sizeof interval));
  mvs_findings_release(found);
  const mvs_leak_errors errors = {
      .struct_size = sizeof errors, .lengths = 0.02, .thickness = 0.1e-3};
  MUST(mvs_find_leak_interval(without, &errors, &found));
  CHECK(find(found, "leak", &finding) != UINT32_MAX);
  CHECK(strstr(finding.sentence, "chordae of 98, 100 and 102 %") != NULL);
  CHECK(((const double *)finding.values.data)[1] == leak[1]);
  CHECK(find(found, "thickness_error", &finding) != UINT32_MAX);
  mvs_findings_release(found);
  found = NULL;
  const mvs_leak_errors wide = {.struct_size = sizeof wide, .lengths = 0.6};
  MUST_FAIL(mvs_find_leak_interval(without, &wide, &found), MVS_E_ARGUMENT, "errors.lengths");
  MUST_FAIL(mvs_find_leak_interval(without, NULL, NULL), MVS_E_ARGUMENT, "findings");
  options.without_leak = 2;
  MUST_FAIL(mvs_build_valve(without, &desc, &options, NULL), MVS_E_ARGUMENT,
            "options.without_leak");
  const mvs_sim_desc host = {.struct_size = sizeof host, .progress = cancel};
  MUST(mvs_create(&host, &stopped));
  MUST_FAIL(mvs_find_leak_interval(stopped, NULL, &found), MVS_E_STATE, "valve");
  MUST(mvs_generate_valve(stopped, NULL));
  MUST_FAIL(mvs_find_leak_interval(stopped, NULL, &found), MVS_E_CANCELLED, "progress");
  CHECK(found == NULL);
  mvs_destroy(with);
  mvs_destroy(without);
  mvs_destroy(stopped);
}

static void options_out_of_range_are_refused(mvs_sim *sim, const mvs_surface_desc *desc) {
  mvs_findings *findings = NULL;
  mvs_build_options options = {.struct_size = sizeof options};
  options.edge = 1;
  MUST_FAIL(mvs_build_valve(sim, desc, &options, &findings), MVS_E_ARGUMENT, "options.edge");
  options.edge = 0;
  options.edge_error = 6e-3;
  MUST_FAIL(mvs_build_valve(sim, desc, &options, &findings), MVS_E_ARGUMENT, "options.edge_error");
  options.edge_error = 0;
  options.edge_lost = -1e-3;
  MUST_FAIL(mvs_build_valve(sim, desc, &options, &findings), MVS_E_ARGUMENT, "options.edge_lost");
  options.edge_lost = 0;
  options.thickness_error = 3e-3;
  MUST_FAIL(mvs_build_valve(sim, desc, &options, &findings), MVS_E_ARGUMENT,
            "options.thickness_error");
  options.thickness_error = 0;
  options.closed_error = 6e-3;
  MUST_FAIL(mvs_build_valve(sim, desc, &options, &findings), MVS_E_ARGUMENT, "0.005");
  options.closed_error = 0.1e-3; /* of a surface that is not given */
  MUST_FAIL(mvs_build_valve(sim, desc, &options, &findings), MVS_E_ARGUMENT,
            "surface.closed_points");
  options.closed_error = 0;
  options.chords = 3;
  MUST_FAIL(mvs_build_valve(sim, desc, &options, &findings), MVS_E_ARGUMENT, "options.chords");
  CHECK(findings == NULL);
}

static void bad_input_is_refused_and_changes_nothing(surface *s) {
  mvs_sim *sim = NULL;
  mvs_findings *findings = NULL;
  mvs_surface_desc desc = desc_of(s);
  mvs_build_options options = {.struct_size = sizeof options};
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_generate_valve(sim, NULL));
  const hash128 before = sim_hash(sim);
  MUST_FAIL(mvs_build_valve(sim, NULL, NULL, NULL), MVS_E_ARGUMENT, "surface");
  MUST_FAIL(mvs_build_valve(NULL, &desc, NULL, NULL), MVS_E_ARGUMENT, "sim");
  desc.kind = 9;
  MUST_FAIL(mvs_build_valve(sim, &desc, NULL, &findings), MVS_E_ARGUMENT, "MVS_SURFACE_KIND_");
  desc = desc_of(s);
  desc.points.data = NULL;
  MUST_FAIL(mvs_build_valve(sim, &desc, NULL, &findings), MVS_E_ARGUMENT, "points");
  desc = desc_of(s);
  desc.triangles.data = NULL;
  desc.triangles.count = 0;
  desc.triangles.components = 0;
  desc.triangles.type = 0;
  desc.points.count = 3 * (desc.points.count / 3) - 1;
  MUST_FAIL(mvs_build_valve(sim, &desc, NULL, &findings), MVS_E_ARGUMENT, "multiple of 3");
  desc = desc_of(s);
  const double few[] = {0, 0, 0, 0.01, 0, 0};
  desc.closed_annulus = (mvs_array){few, 2, 3, MVS_TYPE_F64, 0};
  MUST_FAIL(mvs_build_valve(sim, &desc, &options, &findings), MVS_E_ARGUMENT, "closed_annulus");
  desc = desc_of(s);
  desc.closed_tips = (mvs_array){few, 1, 3, MVS_TYPE_F64, 0};
  MUST_FAIL(mvs_build_valve(sim, &desc, &options, &findings), MVS_E_ARGUMENT, "closed_tips");
  desc = desc_of(s);
  options_out_of_range_are_refused(sim, &desc);
  /* lengths in mm */
  static surface wide;
  wide = *s;
  for (uint32_t k = 0; k < wide.point_count; ++k) {
    for (int c = 0; c < 3; ++c) wide.points[k][c] *= 1e3;
  }
  desc = desc_of(&wide);
  MUST_FAIL(mvs_build_valve(sim, &desc, NULL, &findings), MVS_E_OP, "mm");
  CHECK(findings == NULL);
  CHECK(same_hash(before, sim_hash(sim)));
  mvs_destroy(sim);
  mvs_findings_release(NULL);
}

int main(void) {
  static surface s;
  take_surface(&s);
  a_surface_becomes_a_valve_that_closes(&s);
  an_edge_and_a_thickness_that_are_not_sure_change_findings_only(&s);
  the_leak_is_found_in_the_build_or_later_with_the_same_figures(&s);
  bad_input_is_refused_and_changes_nothing(&s);
  return finish("build");
}
