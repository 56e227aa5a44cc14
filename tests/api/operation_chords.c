/* Operations on chordae: the lengths of those that are dragged or tied to another head, and the
 * warning of those that carry no force. */
#include "examples.h"

/* A chord that is moved at its present tension ends at the requested place. */
static void a_dragged_chord_has_the_length_to_there(void) {
  new_valve();
  mvs_op_chord_length drag = {
      {sizeof drag, MVS_OP_CHORD_LENGTH}, id_of(MVS_PART_CHORD, "P2/3"), 0, 0, {{0}, 1, 0}};
  const mvs_snapshot *snapshot = present();
  mvs_part part;
  mvs_view nodes, x, lengths;
  MUST(mvs_snapshot_find_part(snapshot, MVS_PART_CHORD, "P2/3", &part));
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_CHORD_NODES, &nodes));
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_NODE_POSITION, &x));
  const uint32_t *ends = (const uint32_t *)nodes.data + 2 * part.index;
  const double *from = (const double *)x.data + 3 * ends[0];
  for (int k = 0; k < 3; ++k) drag.drag_to.at[k] = from[k] + (k == 2 ? 0.017 : 0);
  mvs_snapshot_release(snapshot);
  MUST(mvs_apply_op(sim, &drag.op, NULL));
  snapshot = present();
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_CHORD_REST_LENGTH, &lengths));
  /* the chord was slack or unstretched in the open valve; rounding of a few sums */
  CHECK(fabs(((const double *)lengths.data)[part.index] - 0.017) < 1e-9);
  mvs_snapshot_release(snapshot);
}

/* A chord's rest length and the leaflet node that it holds. */
typedef struct seen_chord {
  double length;
  uint32_t leaflet_end;
} seen_chord;

static seen_chord see(const char *chord) {
  const mvs_snapshot *snapshot = present();
  mvs_part part;
  mvs_view lengths, nodes;
  MUST(mvs_snapshot_find_part(snapshot, MVS_PART_CHORD, chord, &part));
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_CHORD_REST_LENGTH, &lengths));
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_CHORD_NODES, &nodes));
  const seen_chord seen = {((const double *)lengths.data)[part.index],
                           ((const uint32_t *)nodes.data)[2 * part.index + 1]};
  mvs_snapshot_release(snapshot);
  return seen;
}

/* Transferring a chord to another head sets the length that lets the leaflet close: that of a new
 * chord between the same places. Moving its leaflet end keeps its length. */
static void a_chord_tied_to_another_head_gets_the_length_of_a_new_one(void) {
  new_valve();
  mvs_op_chord_transfer transfer = {.op = {sizeof transfer, MVS_OP_CHORD_TRANSFER},
                                    .chord = id_of(MVS_PART_CHORD, "A1/2"),
                                    .end = MVS_CHORD_END_HEAD,
                                    .head = id_of(MVS_PART_HEAD, "PM3")};
  mvs_op_chord_add add = {.op = {sizeof add, MVS_OP_CHORD_ADD},
                          .head = transfer.head,
                          .site = {MVS_SITE_NODE, see("A1/2").leaflet_end, 0, {0}},
                          .name = "new"};
  const double kept = see("A1/2").length;
  MUST(mvs_apply_op(sim, &add.op, NULL));
  const double wanted = see("new").length;
  CHECK(wanted > 1.2 * kept); /* PM3 is on the far side: with its old length the chord would tear */
  MUST(mvs_undo(sim));
  MUST(mvs_apply_op(sim, &transfer.op, NULL));
  CHECK(see("A1/2").length == wanted);
  MUST(mvs_undo(sim));
  transfer.length = 0.019;
  MUST(mvs_apply_op(sim, &transfer.op, NULL));
  CHECK(see("A1/2").length == 0.019);
  MUST(mvs_undo(sim));
  transfer.length = 0;
  transfer.end = MVS_CHORD_END_LEAFLET;
  transfer.site = on_scallop("A2", 0.3, 0.9);
  MUST(mvs_apply_op(sim, &transfer.op, NULL));
  CHECK(see("A1/2").length == kept);
}

static int without_force; /* warnings of chordae that carry none */

static void count_warnings(void *user, mvs_log_level level, const char *text) {
  (void)user;
  if (strstr(text, "carries no force") == NULL) return;
  CHECK(level == MVS_LOG_WARNING && strstr(text, "chord loop ") == text);
  ++without_force;
}

/* Closes the valve with an artificial chord of a length under a pressure; returns the warnings. */
static int warnings_with(double length, double pressure) {
  new_valve();
  const mvs_op_neochord loop = {.op = {sizeof loop, MVS_OP_NEOCHORD},
                                .head = id_of(MVS_PART_HEAD, "PM1"),
                                .site = on_scallop("P2", 0.5, 1),
                                .length = length,
                                .name = "loop"};
  const mvs_load_case load = {sizeof load, 0, pressure, 1};
  without_force = 0;
  MUST(mvs_apply_op(sim, &loop.op, NULL));
  CHECK(without_force == 0);
  MUST(mvs_set_load(sim, &load));
  MUST(mvs_settle(sim, NULL, NULL));
  return without_force;
}

/* The head lies 20 to 25 mm below the free edge: 40 mm hold nothing, 15 mm pull. No chord holds an
 * open valve. */
static void a_new_chord_without_force_is_warned_of(void) {
  CHECK(warnings_with(0.040, MVS_SYSTOLE_PA) == 1);
  CHECK(warnings_with(0.015, MVS_SYSTOLE_PA) == 0);
  CHECK(warnings_with(0.040, 0) == 0);
  /* undone, it is no longer there */
  CHECK(warnings_with(0.040, MVS_SYSTOLE_PA) == 1);
  MUST(mvs_undo(sim));
  const mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  MUST(mvs_set_load(sim, &systole));
  MUST(mvs_settle(sim, NULL, NULL));
  CHECK(without_force == 1);
}

int main(void) {
  const mvs_sim_desc desc = {.struct_size = sizeof desc, .log = count_warnings};
  MUST(mvs_create(&desc, &sim));
  a_dragged_chord_has_the_length_to_there();
  a_chord_tied_to_another_head_gets_the_length_of_a_new_one();
  a_new_chord_without_force_is_warned_of();
  mvs_destroy(sim);
  return finish("operation_chords");
}
