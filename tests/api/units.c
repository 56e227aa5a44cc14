/* A value that looks like a number in a wrong unit causes a warning; values in the usual range do
 * not. */
#include "check.h"
#include "funnel.h"
#include "tests/founding.h"

typedef struct host {
  char told[1024]; /* the warnings, concatenated */
  int warnings;
} host;

static void take_line(void *user, mvs_log_level level, const char *text) {
  host *h = user;
  if (level != MVS_LOG_WARNING) return;
  ++h->warnings;
  const size_t used = strlen(h->told);
  snprintf(h->told + used, sizeof h->told - used, "%s\n", text);
}

static host heard;
static mvs_sim *sim;
static funnel f;

/* The warnings of a call that succeeds. */
static void must_warn(mvs_result result, int count, const char *words, int line) {
  if (result != MVS_OK || heard.warnings != count || !strstr(heard.told, words)) {
    ++failures;
    printf("line %d: %s, %d warnings: %s\n  wanted %d and \"%s\"\n", line, mvs_result_name(result),
           heard.warnings, heard.told, count, words);
  }
  heard = (host){0};
}
#define WARNS(call, count, words) must_warn(call, count, words, __LINE__)
/* The warnings of the funnel with one change. */
#define CHANGED(change, count, words)                                   \
  do {                                                                  \
    make_funnel(&f);                                                    \
    change;                                                             \
    must_warn(mvs_set_valve(sim, &f.desc), (count), (words), __LINE__); \
  } while (0)

static void ogden(mvs_chord_desc *chord, double mu, double alpha, double mu2, double alpha2) {
  chord->law = MVS_CHORD_LAW_OGDEN;
  chord->constants[0] = mu;
  chord->constants[1] = alpha;
  chord->constants[2] = mu2;
  chord->constants[3] = alpha2;
}

static mvs_result load(double pressure) {
  const mvs_load_case to = {sizeof to, 0, pressure, 1};
  return mvs_set_load(sim, &to);
}

static mvs_result tissue(uint32_t law, double first, double second) {
  const mvs_leaflet_desc to = {.law = law, .constants = {first, second}};
  return mvs_set_leaflet(sim, 0, &to);
}

/* Published values cause no warning: every law with its defaults, and the softest and stiffest
 * natural chordae (Kunzelman and Cochran 1990: 10 to 130 MPa). */
static void what_tissue_is_like_is_not_warned_of(void) {
  mvs_law law = {.struct_size = sizeof law};
  WARNS(generate_founding(sim), 0, "");
  for (uint32_t k = 0; k < mvs_get_leaflet_law_count(); ++k) {
    MUST(mvs_get_leaflet_law(k, &law));
    WARNS(tissue(law.number, 0, 0), 0, "");
  }
  CHANGED((void)0, 0, "");
  CHANGED(f.chords[2].young = 10e6, 0, "");
  CHANGED(f.chords[2].young = 130e6, 0, "");
  CHANGED(f.chords[2].rest_length = 3e-3, 0, "");
  CHANGED(f.leaflets[0].thickness = 0.4e-3, 0, "");
  WARNS(load(MVS_SYSTOLE_PA), 0, "");
  WARNS(load(25 * MVS_SYSTOLE_PA / 120), 0, "");
  for (int k = 0; k <= 100; ++k) WARNS(load(k * MVS_SYSTOLE_PA / 100), 0, "");
}

static void bilinear(mvs_chord_desc *chord, double high) {
  chord->law = MVS_CHORD_LAW_BILINEAR;
  chord->constants[1] = high;
}

static void moduli_in_kpa_are_warned_of(void) {
  CHANGED(f.chords[2].young = 40e3, 1, "bears");
  CHANGED(for (int c = 0; c < FUNNEL_CHORDS; ++c) f.chords[c].young = 40e3, 1,
          "looks like a modulus in kPa or MPa given as Pa (10 of them)");
  CHANGED(f.chords[2].area = 0.785e-10, 1, "its share of the systolic force");
  CHANGED(bilinear(&f.chords[2], 0), 0, "");
  CHANGED(bilinear(&f.chords[2], 100), 1, "Pa, tissue about 1e+08: looks like kPa or MPa");
  CHANGED(f.chords[2].young = 40e9, 1, "as steel wire does");
  CHANGED(f.leaflets[0].constants[0] = 100, 1, "has low modulus 100 Pa, tissue about 100000");
  CHANGED(f.desc.contact_stiffness = 20, 1, "contact stiffness is 20 Pa");
  MUST(generate_founding(sim));
  WARNS(tissue(MVS_LEAFLET_LAW_PROT, 0.052, 0), 2, "leaflet P has constant c0 0.052 Pa");
  WARNS(tissue(MVS_LEAFLET_LAW_NEO_HOOKEAN, 3000, 0), 2, "over 10 times its length");
  WARNS(tissue(MVS_LEAFLET_LAW_NEO_HOOKEAN, 33e9, 0), 2, "by less than 0.1 %");
}

/* A chord that follows a curve up to 5 MPa, its strains multiplied by a factor. */
static void follow_curve(double factor) {
  static double points[6];
  static mvs_curve_desc curve;
  const double given[6] = {0, 0, 0.05 * factor, 0.2e6, 0.15 * factor, 5e6};
  memcpy(points, given, sizeof points);
  curve = (mvs_curve_desc){.name = "measured", .points = packed(points, 3, 2, MVS_TYPE_F64)};
  f.desc.curves = &curve;
  f.desc.curve_count = 1;
  f.desc.curve_stride = sizeof curve;
  f.chords[2].law = MVS_CHORD_LAW_TABLE;
  f.chords[2].constants[0] = 0;
}

static void strains_in_percent_are_warned_of(void) {
  CHANGED(follow_curve(1), 0, "");
  CHANGED(follow_curve(100), 1, "follows curve measured, which ends at a strain of 15");
}

static void lengths_in_other_units_are_warned_of(void) {
  CHANGED(f.leaflets[0].thickness = 1e-2, 1, "is 10 mm thick, which is too much");
  CHANGED(f.leaflets[0].thickness = 1e-5, 1, "is 0.01 mm thick, which is little");
  /* terms of different signs, which stiffen the chord up to 5 % and fall later: by the derivative
   * of the sum from a stretch of 1.23 on, by the sum itself from 1.38 on */
  CHANGED(ogden(&f.chords[2], 1e7, 2, -9e5, 14), 1, "pulls less again from a strain of 0.2");
  CHANGED(ogden(&f.chords[2], 1e7, 2, -9e5, 14), 1, "pushes from 0.39 on");
  CHANGED(ogden(&f.chords[2], 1e7, 14, 0, 0), 0, "");
  CHANGED(f.chords[2].rest_length = 0.98, 1, "is 980 mm long at rest");
  CHANGED(f.chords[2].rest_length = 1e-5, 1, "is 0.01 mm long at rest");
}

static void pressures_in_mmhg_are_warned_of(void) {
  MUST(generate_founding(sim));
  WARNS(load(120), 1, "a pressure of 120 Pa is 0.9 mmHg: looks like mmHg given as Pa");
  WARNS(load(-35), 1, "-35 mmHg are -4666.27 Pa");
  WARNS(load(120.5), 1, "looks like mmHg given as Pa; 120.5 mmHg are 16065.301 Pa");
  WARNS(load(122.3), 1, "looks like mmHg given as Pa");
  WARNS(load(199.9), 1, "looks like mmHg given as Pa");
  WARNS(load(120 * 133.322 * 20), 1, "looks like Pa taken for mmHg");
}

static void pressures_in_kpa_are_warned_of(void) {
  MUST(generate_founding(sim));
  WARNS(load(16), 1, "a pressure of 16 Pa is 0.12 mmHg: looks like kPa given as Pa; 16 kPa are");
  WARNS(load(-13.33), 1, "-13.33 kPa are -13330 Pa");
  WARNS(load(25), 1, "looks like kPa given as Pa");
  WARNS(load(120 * 133.322 / 1000), 1, "looks like kPa given as Pa; 15.99864 kPa are 15998.64 Pa");
  WARNS(load(120 * 133.322 / 900), 0, ""); /* the first of 900 steps of a ramp */
  WARNS(load(5 * 133.322), 0, "");         /* 5 mmHg, of early filling */
  WARNS(load(0), 0, "");
}

static void pressures_in_mpa_are_warned_of(void) {
  MUST(generate_founding(sim));
  WARNS(load(0.016), 1, "a pressure of 0.016 Pa is 0.00012 mmHg: looks like MPa given as Pa");
  WARNS(load(-0.013), 1, "-0.013 MPa are -13000 Pa");
  WARNS(load(118.3 * 133.322387415e-6), 1, "looks like MPa given as Pa");
  WARNS(load(1e-12), 0, ""); /* zero, rounded */
}

static mvs_op_chord_add added(double along, double young) {
  mvs_part head, scallop;
  const mvs_snapshot *now = NULL;
  MUST(mvs_get_snapshot(sim, &now));
  MUST(mvs_snapshot_find_part(now, MVS_PART_HEAD, "PM1", &head));
  MUST(mvs_snapshot_find_part(now, MVS_PART_SCALLOP, "P2", &scallop));
  mvs_snapshot_release(now);
  const mvs_op_chord_add op = {.op = {sizeof op, MVS_OP_CHORD_ADD},
                               .head = head.id,
                               .site = {MVS_SITE_ANATOMICAL, 0, scallop.id, {along, 1, 0}},
                               .length = 12e-3,
                               .young = young};
  return op;
}

/* An operation is warned of as a valve is, and not of what it left as it was. */
static void operations_are_warned_of(void) {
  MUST(generate_founding(sim));
  const mvs_op_chord_add usual = added(0.2, 0), soft = added(0.4, 40), next = added(0.6, 0),
                         stiff = added(0.8, 40e9);
  WARNS(mvs_apply_op(sim, &usual.op, NULL), 0, "");
  WARNS(mvs_apply_op(sim, &soft.op, NULL), 1,
        "looks like a modulus in kPa or MPa given as Pa (1 of");
  WARNS(mvs_apply_op(sim, &next.op, NULL), 0, "");
  WARNS(mvs_apply_op(sim, &stiff.op, NULL), 1, "as steel wire does");
}

/* So is a plan. */
static void plans_are_warned_of(void) {
  static char text[1 << 20];
  uint64_t size = 0;
  const mvs_snapshot *now = NULL;
  MUST(generate_founding(sim));
  const mvs_op_chord_add soft = added(0.4, 40);
  WARNS(mvs_apply_op(sim, &soft.op, NULL), 1, "bears");
  MUST(mvs_get_snapshot(sim, &now));
  MUST(mvs_write_plan(now, NULL, text, sizeof text, &size));
  mvs_snapshot_release(now);
  MUST(generate_founding(sim));
  WARNS(mvs_replay_plan(sim, text, size, NULL), 1,
        "looks like a modulus in kPa or MPa given as Pa");
}

int main(void) {
  const mvs_sim_desc desc = {.struct_size = sizeof desc, .log = take_line, .user = &heard};
  MUST(mvs_create(&desc, &sim));
  what_tissue_is_like_is_not_warned_of();
  moduli_in_kpa_are_warned_of();
  strains_in_percent_are_warned_of();
  lengths_in_other_units_are_warned_of();
  pressures_in_mmhg_are_warned_of();
  pressures_in_kpa_are_warned_of();
  pressures_in_mpa_are_warned_of();
  operations_are_warned_of();
  plans_are_warned_of();
  mvs_destroy(sim);
  return finish("units");
}
