/* Another tissue law for a leaflet. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "funnel.h"

static mvs_sim *sim;

static const mvs_snapshot *present(void) {
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_get_snapshot(sim, &snapshot));
  return snapshot;
}

static const void *data_of(const mvs_snapshot *snapshot, uint32_t which) {
  mvs_view view = {0};
  MUST(mvs_snapshot_get_array(snapshot, which, &view));
  return view.data;
}

static void start(void) {
  mvs_parametric_desc desc = {0};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.vertices = 250;
  MUST(mvs_generate_valve(sim, &desc));
}

/* At rest under systolic pressure, without a crossing. */
static mvs_measures close_valve(void) {
  mvs_load_case load = {sizeof load, 0, MVS_SYSTOLE_PA, 1};
  MUST(mvs_set_load(sim, &load));
  mvs_stats stats = {0};
  stats.struct_size = sizeof stats;
  MUST(mvs_settle(sim, NULL, &stats));
  CHECK(stats.converged == 1);
  const mvs_snapshot *closed = present();
  mvs_measures measures = {0};
  measures.struct_size = sizeof measures;
  MUST(mvs_snapshot_measure(closed, &measures));
  CHECK(measures.intersections == 0);
  mvs_snapshot_release(closed);
  return measures;
}

static void a_constant_may_be_zero(void) {
  start();
  mvs_leaflet_desc tissue = {0};
  tissue.law = MVS_LEAFLET_LAW_MAY_NEWMAN_YIN;
  tissue.constants[2] = -0.0;
  MUST(mvs_set_leaflet(sim, 0, &tissue));
  const mvs_snapshot *zero = present();
  const double *constants = data_of(zero, MVS_ARRAY_LEAFLET_CONSTANTS);
  CHECK(constants[1] == 399 && constants[3] == 0 && !signbit(constants[3]));
  mvs_snapshot_release(zero);
  tissue.constants[2] = 0;
  MUST(mvs_set_leaflet(sim, 0, &tissue));
  const mvs_snapshot *published = present();
  constants = data_of(published, MVS_ARRAY_LEAFLET_CONSTANTS);
  CHECK(constants[3] == 1446.5);
  mvs_snapshot_release(published);
}

static void one_leaflet_changes_and_the_other_stays(void) {
  start();
  const mvs_snapshot *before = present();
  mvs_part leaflet = {0};
  MUST(mvs_snapshot_get_part(before, MVS_PART_LEAFLET, 1, &leaflet));
  mvs_leaflet_desc tissue = {0};
  tissue.law = MVS_LEAFLET_LAW_FUNG;
  tissue.thickness = 0.5e-3;
  tissue.constants[2] = 5;
  MUST(mvs_set_leaflet(sim, leaflet.id, &tissue));
  const mvs_snapshot *after = present();
  const uint32_t *law = data_of(after, MVS_ARRAY_LEAFLET_LAW);
  CHECK(law[0] == MVS_LEAFLET_LAW_SPRING && law[1] == MVS_LEAFLET_LAW_FUNG);
  const double *constants = data_of(after, MVS_ARRAY_LEAFLET_CONSTANTS);
  CHECK(constants[9] == 0.5e-3 && constants[10] == 1e3 && constants[11] == 124);
  CHECK(constants[12] == 5);
  const double *thick = data_of(after, MVS_ARRAY_TRIANGLE_THICKNESS);
  const double *thick_before = data_of(before, MVS_ARRAY_TRIANGLE_THICKNESS);
  const uint32_t *of = data_of(after, MVS_ARRAY_TRIANGLE_LEAFLET);
  mvs_view triangles = {0};
  MUST(mvs_snapshot_get_array(after, MVS_ARRAY_TRIANGLE_LEAFLET, &triangles));
  for (uint64_t t = 0; t < triangles.count; ++t) {
    CHECK(thick[t] == (of[t] == 1 ? 0.5 : 1.0) * thick_before[t]);
  }
  mvs_snapshot_release(before);
  mvs_snapshot_release(after);
}

static void springs_become_the_membrane_of_their_curve(void) {
  start();
  mvs_leaflet_desc tissue = {0};
  tissue.law = MVS_LEAFLET_LAW_BILINEAR;
  MUST(mvs_set_leaflet(sim, 0, &tissue));
  const mvs_snapshot *after = present();
  const double *constants = data_of(after, MVS_ARRAY_LEAFLET_CONSTANTS);
  /* the fit of the header; rounding of products */
  const double fit[4] = {18.49e3, 3146e3, 3.1611, 0.006};
  for (int k = 0; k < 4; ++k) CHECK(fabs(constants[1 + k] - fit[k]) < 1e-12 * fit[k]);
  mvs_snapshot_release(after);
}

static void a_valve_closes_in_every_law_of_tissue(void) {
  const uint32_t laws[] = {MVS_LEAFLET_LAW_SPRING, MVS_LEAFLET_LAW_BILINEAR, MVS_LEAFLET_LAW_FUNG,
                           MVS_LEAFLET_LAW_MAY_NEWMAN_YIN, MVS_LEAFLET_LAW_PROT};
  double strain[5];
  for (int k = 0; k < 5; ++k) {
    start();
    mvs_leaflet_desc tissue = {0};
    tissue.law = laws[k];
    MUST(mvs_set_leaflet(sim, 0, &tissue));
    strain[k] = close_valve().max_leaflet_strain;
    CHECK(strain[k] > 0.05 && strain[k] < 2);
    for (int j = 0; j < k; ++j) CHECK(strain[j] != strain[k]); /* the tissues differ */
  }
}

static void what_is_no_tissue_changes_nothing(void) {
  start();
  const mvs_snapshot *before = present();
  uint64_t hash[2], now[2];
  MUST(mvs_snapshot_get_hash(before, hash));
  mvs_leaflet_desc tissue = {0};
  tissue.law = 77;
  MUST_FAIL(mvs_set_leaflet(sim, 0, &tissue), MVS_E_OP, "follows law 77");
  tissue.law = MVS_LEAFLET_LAW_PROT;
  tissue.constants[0] = -1;
  MUST_FAIL(mvs_set_leaflet(sim, 0, &tissue), MVS_E_OP, "constant c0 -1 Pa");
  tissue.constants[0] = 0;
  tissue.constants[3] = 1;
  MUST_FAIL(mvs_set_leaflet(sim, 0, &tissue), MVS_E_OP, "its law (prot) has only 3");
  tissue.constants[3] = 0;
  tissue.name = "A";
  MUST_FAIL(mvs_set_leaflet(sim, 0, &tissue), MVS_E_ARGUMENT, "have to be empty");
  tissue.name = NULL;
  tissue.thickness = 1;
  MUST_FAIL(mvs_set_leaflet(sim, 0, &tissue), MVS_E_OP, "mm given as m");
  tissue.thickness = 0;
  MUST_FAIL(mvs_set_leaflet(sim, 9999, &tissue), MVS_E_ID, "no leaflet with the id 9999");
  MUST_FAIL(mvs_set_leaflet(sim, 0, NULL), MVS_E_ARGUMENT, "tissue");
  MUST_FAIL(mvs_set_leaflet(NULL, 0, &tissue), MVS_E_ARGUMENT, "sim");
  const mvs_snapshot *after = present();
  MUST(mvs_snapshot_get_hash(after, now));
  CHECK(now[0] == hash[0] && now[1] == hash[1]);
  mvs_snapshot_release(before);
  mvs_snapshot_release(after);
}

static void laws_say_what_they_are(void) {
  mvs_law law = {0};
  law.struct_size = sizeof law;
  MUST(mvs_get_leaflet_law(MVS_LEAFLET_LAW_FUNG - 1, &law));
  CHECK(law.number == MVS_LEAFLET_LAW_FUNG);
  CHECK(strcmp(law.word, "fung") == 0 && law.constant_count == 3);
  CHECK(strcmp(law.constants[1].key, "c1") == 0 && strcmp(law.constants[1].unit, "Pa") == 0);
  CHECK(law.constants[1].fallback == 124 && law.constants[1].low > 0);
  MUST(mvs_get_chord_law(MVS_CHORD_LAW_BILINEAR - 1, &law));
  CHECK(strcmp(law.word, "bilinear") == 0 && law.constants[0].fallback == 0.05);
  CHECK(law.struct_size == sizeof law);
  for (uint32_t k = 0; k < mvs_get_leaflet_law_count(); ++k) {
    MUST(mvs_get_leaflet_law(k, &law));
    CHECK(law.number == k + 1);
  }
  CHECK(mvs_get_leaflet_law_count() == 6 && mvs_get_chord_law_count() == 4);
  MUST_FAIL(mvs_get_leaflet_law(6, &law), MVS_E_ARGUMENT, "index is 6, but there are 6 laws");
  MUST_FAIL(mvs_get_chord_law(4, &law), MVS_E_ARGUMENT, "index is 4, but there are 4 laws");
  MUST_FAIL(mvs_get_leaflet_law(1, NULL), MVS_E_ARGUMENT, "law");
}

int main(void) {
  MUST(mvs_create(NULL, &sim));
  a_constant_may_be_zero();
  one_leaflet_changes_and_the_other_stays();
  springs_become_the_membrane_of_their_curve();
  a_valve_closes_in_every_law_of_tissue();
  what_is_no_tissue_changes_nothing();
  laws_say_what_they_are();
  mvs_destroy(sim);
  return finish("tissue");
}
