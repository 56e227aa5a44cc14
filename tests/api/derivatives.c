/* Sensitivities through the C interface: a chord of the default valve against a settle, the
 * summary, the arrays, and bad input, which changes nothing. */
#include <math.h>
#include <stdlib.h>

#include "tests/api/check.h"

#define SIZES(list) (uint32_t)(sizeof(list) / sizeof *(list)), sizeof *(list)

static const mvs_settle_options tight = {.struct_size = sizeof tight, .residual = 1e-10};

static mvs_sim *closed_valve_of(uint32_t vertices) {
  mvs_sim *sim = NULL;
  mvs_load_case load = {sizeof load, 0, MVS_SYSTOLE_PA, 1};
  mvs_parametric_desc desc = {.struct_size = sizeof desc, .vertices = vertices};
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_generate_valve(sim, &desc));
  MUST(mvs_set_load(sim, &load));
  MUST(mvs_settle(sim, &tight, NULL));
  return sim;
}

static mvs_sim *closed_valve(void) {
  return closed_valve_of(250);
}

static const mvs_snapshot *snapshot_of(mvs_sim *sim) {
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_get_snapshot(sim, &snapshot));
  return snapshot;
}

static const double *numbers(const mvs_sensitivity *found, mvs_sensitivity_array which) {
  mvs_view view = {0};
  MUST(mvs_sensitivity_get_array(found, which, &view));
  return (const double *)view.data;
}

static uint32_t first_taut_chord(const mvs_snapshot *snapshot) {
  mvs_view strain = {0};
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_CHORD_STRAIN, &strain));
  for (uint32_t c = 0; c < strain.count; ++c) {
    if (((const double *)strain.data)[c] > 0.02) return c;
  }
  const int no_chord_is_taut = 1;
  CHECK(!no_chord_is_taut);
  return 0;
}

/* The chord is made 0.02 um longer and shorter. */
static void a_rest_length_moves_what_it_says(void) {
  mvs_sim *sim = closed_valve();
  const mvs_snapshot *closed = snapshot_of(sim);
  const uint32_t chord = first_taut_chord(closed);
  mvs_part part;
  mvs_chord_info info = {.struct_size = sizeof info};
  MUST(mvs_snapshot_get_part(closed, MVS_PART_CHORD, chord, &part));
  MUST(mvs_snapshot_get_chord(closed, chord, &info));
  const mvs_quantity of[] = {{.kind = MVS_QUANTITY_MEASURE, .measure = "coaptation_area"},
                             {.kind = MVS_QUANTITY_CHORD_TENSION, .index = chord},
                             {.kind = MVS_QUANTITY_HEAD_FORCE, .index = 0, .component = 3}};
  const mvs_parameter to[] = {{.kind = MVS_PARAMETER_CHORD_REST_LENGTH, .index = chord}};
  mvs_sensitivity *found = NULL;
  MUST(mvs_sensitivity_run(closed, of, SIZES(of), to, SIZES(to), NULL, &found));
  const double *slope = numbers(found, MVS_SENSITIVITY_ARRAY_DERIVATIVE);
  const double *value = numbers(found, MVS_SENSITIVITY_ARRAY_VALUE);
  double side[2][3];
  const double h = 2e-8;
  for (int k = 0; k < 2; ++k) {
    mvs_op_chord_length op = {.op = {sizeof op, MVS_OP_CHORD_LENGTH},
                              .chord = part.id,
                              .length = info.rest_length + (k == 0 ? h : -h)};
    mvs_measures m = {.struct_size = sizeof m};
    mvs_view tension, force;
    MUST(mvs_restore(sim, closed));
    MUST(mvs_apply_op(sim, &op.op, NULL));
    MUST(mvs_settle(sim, &tight, NULL));
    const mvs_snapshot *moved = snapshot_of(sim);
    MUST(mvs_snapshot_measure(moved, &m));
    MUST(mvs_snapshot_get_array(moved, MVS_ARRAY_CHORD_TENSION, &tension));
    MUST(mvs_snapshot_get_array(moved, MVS_ARRAY_HEAD_FORCE, &force));
    const double *f = force.data;
    side[k][0] = m.coaptation_area;
    side[k][1] = ((const double *)tension.data)[chord];
    side[k][2] = sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
    mvs_snapshot_release(moved);
  }
  for (int q = 0; q < 3; ++q) {
    const double difference = (side[0][q] - side[1][q]) / (2 * h);
    /* rounding of the settles, and kinks of single samples of the coaptation */
    CHECK(fabs(difference / slope[q] - 1) < 1e-3);
    CHECK(fabs(0.5 * (side[0][q] + side[1][q]) / value[q] - 1) < 1e-6);
  }
  mvs_sensitivity_release(found);
  mvs_snapshot_release(closed);
  mvs_destroy(sim);
}

static void adjoint_and_direct_agree_and_say_what_they_did(void) {
  mvs_sim *sim = closed_valve();
  const mvs_snapshot *closed = snapshot_of(sim);
  mvs_view chords = {0};
  MUST(mvs_snapshot_get_array(closed, MVS_ARRAY_CHORD_NODES, &chords));
  const uint32_t count = (uint32_t)chords.count;
  mvs_parameter *to = calloc(count, sizeof *to);
  for (uint32_t c = 0; c < count; ++c) {
    to[c].kind = MVS_PARAMETER_CHORD_REST_LENGTH;
    to[c].index = c;
  }
  const mvs_quantity of[] = {{.kind = MVS_QUANTITY_MEASURE, .measure = "coaptation_area"}};
  const mvs_sensitivity_options direct = {
      .struct_size = sizeof direct, .flags = MVS_SENSITIVITY_MOTION | MVS_SENSITIVITY_NO_TEST};
  mvs_sensitivity *a = NULL, *d = NULL;
  MUST(mvs_sensitivity_run(closed, of, SIZES(of), to, count, sizeof *to, NULL, &a));
  MUST(mvs_sensitivity_run(closed, of, SIZES(of), to, count, sizeof *to, &direct, &d));
  mvs_sensitivity_summary of_a = {.struct_size = sizeof of_a};
  mvs_sensitivity_summary of_d = {.struct_size = sizeof of_d};
  MUST(mvs_sensitivity_get_summary(a, &of_a));
  MUST(mvs_sensitivity_get_summary(d, &of_d));
  const uint32_t switches = of_a.weak_chords + of_a.weak_contacts;
  CHECK(of_a.adjoint_solves == 1 + switches && of_d.adjoint_solves == 0);
  CHECK(of_d.direct_solves == count + switches);
  CHECK(of_a.quantities == 1 && of_a.parameters == count);
  CHECK(of_a.stiffness_margin > 0 && of_a.linear_error < 1e-9 && of_a.residual < 1e-10);
  const double *x = numbers(a, MVS_SENSITIVITY_ARRAY_DERIVATIVE);
  const double *y = numbers(d, MVS_SENSITIVITY_ARRAY_DERIVATIVE);
  double largest = 0;
  for (uint32_t c = 0; c < count; ++c) largest = fmax(largest, fabs(x[c]));
  CHECK(largest > 0);
  for (uint32_t c = 0; c < count; ++c) CHECK(fabs(x[c] - y[c]) < 1e-8 * largest);
  mvs_view motion = {0}, nodes = {0};
  MUST(mvs_sensitivity_get_array(d, MVS_SENSITIVITY_ARRAY_MOTION, &motion));
  MUST(mvs_snapshot_get_array(closed, MVS_ARRAY_NODE_POSITION, &nodes));
  CHECK(motion.count == nodes.count * count && motion.components == 3);
  MUST(mvs_sensitivity_get_array(a, MVS_SENSITIVITY_ARRAY_MOTION, &motion));
  CHECK(motion.count == 0);
  mvs_sensitivity_release(a);
  mvs_sensitivity_release(d);
  free(to);
  mvs_snapshot_release(closed);
  mvs_destroy(sim);
}

/* Whether contact is about to switch at this distance, for a wider annulus, with a value on each
 * side. */
static int contact_switches_within(const mvs_snapshot *closed, double slack) {
  const mvs_quantity of[] = {{.kind = MVS_QUANTITY_MEASURE, .measure = "coaptation_area"}};
  const mvs_parameter to[] = {{.kind = MVS_PARAMETER_ANNULUS_SCALE}};
  const mvs_sensitivity_options options = {.struct_size = sizeof options, .slack = slack};
  mvs_sensitivity *found = NULL;
  mvs_sensitivity_summary summary = {.struct_size = sizeof summary};
  mvs_view vertices = {0}, notes = {0};
  MUST(mvs_sensitivity_run(closed, of, SIZES(of), to, SIZES(to), &options, &found));
  MUST(mvs_sensitivity_get_summary(found, &summary));
  MUST(mvs_sensitivity_get_array(found, MVS_SENSITIVITY_ARRAY_WEAK_CONTACTS, &vertices));
  MUST(mvs_sensitivity_get_array(found, MVS_SENSITIVITY_ARRAY_PARAMETER_NOTES, &notes));
  CHECK(vertices.count <= summary.weak_contacts);
  const double above = numbers(found, MVS_SENSITIVITY_ARRAY_ABOVE)[0];
  const double below = numbers(found, MVS_SENSITIVITY_ARRAY_BELOW)[0];
  const mvs_sensitivity_notes note = ((const uint32_t *)notes.data)[0];
  const int switches = (note & MVS_SENSITIVITY_NOTE_CONTACT) != 0;
  if (switches) CHECK(vertices.count > 0 && summary.smooth == 0);
  if (summary.weak_chords + summary.weak_contacts > 64) CHECK(isnan(above) && isnan(below));
  mvs_sensitivity_release(found);
  return switches && isfinite(above) && isfinite(below) && above != below;
}

/* Contact of one of these valves is about to switch. */
static void contact_about_to_switch_has_two_sides(void) {
  const uint32_t vertices[] = {230, 200, 330, 310, 290, 240};
  int switches = 0;
  for (size_t v = 0; v < sizeof vertices / sizeof *vertices && switches == 0; ++v) {
    mvs_sim *sim = closed_valve_of(vertices[v]);
    const mvs_snapshot *closed = snapshot_of(sim);
    double slack = 2.5e-7;
    for (int k = 0; k < 6; ++k) {
      switches += contact_switches_within(closed, slack);
      slack *= 2;
    }
    CHECK(!contact_switches_within(closed, 1e-3)); /* nearly all: no values */
    mvs_snapshot_release(closed);
    mvs_destroy(sim);
  }
  CHECK(switches > 0);
}

struct told {
  double share, force;
  int calls, cancel_at, falls;
};

static int32_t tell(void *user, double share, double residual) {
  struct told *told = (struct told *)user;
  told->falls += share < told->share;
  told->share = share;
  told->force = residual;
  return ++told->calls == told->cancel_at;
}

/* With measures by differences (direct solutions) and without them (adjoint ones). */
static void progress_rises_to_1_and_cancels(void) {
  mvs_sim *sim = closed_valve();
  const mvs_snapshot *closed = snapshot_of(sim);
  const mvs_parameter to[] = {{.kind = MVS_PARAMETER_PRESSURE},
                              {.kind = MVS_PARAMETER_CHORD_REST_LENGTH, .index = 1}};
  for (int k = 0; k < 2; ++k) {
    const mvs_quantity of = {.kind = MVS_QUANTITY_MEASURE,
                             .measure = k ? "tenting_volume" : "coaptation_area"};
    struct told told = {0};
    const mvs_sensitivity_options options = {
        .struct_size = sizeof options, .progress = tell, .user = &told};
    mvs_sensitivity *plain = NULL, *found = NULL;
    mvs_sensitivity_summary summary = {.struct_size = sizeof summary};
    MUST(mvs_sensitivity_run(closed, &of, 1, sizeof of, to, SIZES(to), NULL, &plain));
    MUST(mvs_sensitivity_run(closed, &of, 1, sizeof of, to, SIZES(to), &options, &found));
    MUST(mvs_sensitivity_get_summary(found, &summary));
    CHECK(told.calls >= 2 && told.falls == 0 && told.share == 1);
    CHECK(told.force == summary.residual);
    const double *expected = numbers(plain, MVS_SENSITIVITY_ARRAY_DERIVATIVE);
    const double *told_of = numbers(found, MVS_SENSITIVITY_ARRAY_DERIVATIVE);
    CHECK(told_of[0] == expected[0] && told_of[1] == expected[1]);
    mvs_sensitivity_release(plain);
    mvs_sensitivity_release(found);
    const int calls = told.calls;
    for (int call = 1; call <= calls; call += calls - 1) {
      told = (struct told){.cancel_at = call};
      found = NULL;
      MUST_FAIL(mvs_sensitivity_run(closed, &of, 1, sizeof of, to, SIZES(to), &options, &found),
                MVS_E_CANCELLED, "cancelled");
      CHECK(found == NULL && told.calls == call);
    }
  }
  mvs_snapshot_release(closed);
  mvs_destroy(sim);
}

static void bad_input_is_refused(void) {
  mvs_sim *sim = closed_valve();
  const mvs_snapshot *closed = snapshot_of(sim);
  const hash128 before = snapshot_hash(closed);
  mvs_sensitivity *found = NULL;
  const mvs_quantity area = {.kind = MVS_QUANTITY_MEASURE, .measure = "coaptation_area"};
  const mvs_parameter pressure = {.kind = MVS_PARAMETER_PRESSURE};
#define REFUSED(q, p, code, word)                                                              \
  do {                                                                                         \
    const mvs_quantity q_ = q;                                                                 \
    const mvs_parameter p_ = p;                                                                \
    MUST_FAIL(mvs_sensitivity_run(closed, &q_, 1, sizeof q_, &p_, 1, sizeof p_, NULL, &found), \
              code, word);                                                                     \
    CHECK(found == NULL);                                                                      \
  } while (0)
#define Q(...) ((mvs_quantity){__VA_ARGS__})
#define P(...) ((mvs_parameter){__VA_ARGS__})
  REFUSED(Q(.kind = 99), pressure, MVS_E_ARGUMENT, "MVS_QUANTITY_");
  REFUSED(Q(.kind = MVS_QUANTITY_MEASURE, .measure = "coaptation"), pressure, MVS_E_ARGUMENT,
          "coaptation_area");
  REFUSED(Q(.kind = MVS_QUANTITY_MEASURE, .measure = "chords_over_strain"), pressure,
          MVS_E_ARGUMENT, "no derivative");
  REFUSED(Q(.kind = MVS_QUANTITY_CHORD_TENSION, .index = 100000), pressure, MVS_E_ARGUMENT,
          "below");
  REFUSED(Q(.kind = MVS_QUANTITY_LINEAR), pressure, MVS_E_ARGUMENT, "weights has 0 rows");
  REFUSED(area, P(.kind = 99), MVS_E_ARGUMENT, "MVS_PARAMETER_");
  REFUSED(area, P(.kind = MVS_PARAMETER_CHORD_REST_LENGTH, .index = 100000), MVS_E_ARGUMENT,
          "chord segments");
  REFUSED(area, P(.kind = MVS_PARAMETER_LEAFLET_CONSTANT, .component = 7), MVS_E_ARGUMENT,
          "component is 7");
  REFUSED(area, P(.kind = MVS_PARAMETER_CHORD_SITE, .component = 100000), MVS_E_ARGUMENT, "chord");
  REFUSED(area, P(.kind = MVS_PARAMETER_BOUNDARY_MODE), MVS_E_ARGUMENT, "mode has 0 rows");
  mvs_view fixed = {0};
  MUST(mvs_snapshot_get_array(closed, MVS_ARRAY_NODE_KIND, &fixed));
  for (uint32_t i = 0; i < fixed.count; ++i) {
    if (((const uint8_t *)fixed.data)[i] != MVS_NODE_KIND_LEAFLET) continue;
    REFUSED(area, P(.kind = MVS_PARAMETER_NODE_POSITION, .index = i), MVS_E_ARGUMENT, "is free");
    break;
  }
  const mvs_sensitivity_options wide = {.struct_size = sizeof wide, .slack = 1};
  MUST_FAIL(mvs_sensitivity_run(closed, &area, 1, sizeof area, &pressure, 1, sizeof pressure, &wide,
                                &found),
            MVS_E_ARGUMENT, "options.slack");
  mvs_load_case load = {sizeof load, 0, 0.9 * MVS_SYSTOLE_PA, 1};
  MUST(mvs_set_load(sim, &load));
  const mvs_snapshot *moving = snapshot_of(sim);
  MUST_FAIL(mvs_sensitivity_run(moving, &area, 1, sizeof area, &pressure, 1, sizeof pressure, NULL,
                                &found),
            MVS_E_STATE, "not at rest");
  MUST_FAIL(mvs_sensitivity_get_array(NULL, 1, NULL), MVS_E_ARGUMENT, "null");
  CHECK(memcmp(&before, &(hash128){{0, 0}}, sizeof before) != 0);
  const hash128 after = snapshot_hash(closed);
  CHECK(memcmp(&before, &after, sizeof before) == 0);
  mvs_sensitivity_release(NULL);
  mvs_snapshot_release(moving);
  mvs_snapshot_release(closed);
  mvs_destroy(sim);
}

int main(void) {
  a_rest_length_moves_what_it_says();
  adjoint_and_direct_agree_and_say_what_they_did();
  contact_about_to_switch_has_two_sides();
  progress_rises_to_1_and_cancels();
  bad_input_is_refused();
  return finish("derivatives");
}
