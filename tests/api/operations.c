/* Operations: check and apply give the same verdict, undo and redo are exact, groups, checkpoints.
 * */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

#include "check.h"
#include "tests/founding.h"

static mvs_sim *sim;

static const mvs_snapshot *present(void) {
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_get_snapshot(sim, &snapshot));
  return snapshot;
}

static mvs_id id_of(uint32_t kind, const char *name) {
  const mvs_snapshot *snapshot = present();
  mvs_part part = {0};
  MUST(mvs_snapshot_find_part(snapshot, kind, name, &part));
  mvs_snapshot_release(snapshot);
  return part.id;
}

static mvs_history history(void) {
  const mvs_snapshot *snapshot = present();
  mvs_history found = {.struct_size = sizeof found};
  MUST(mvs_snapshot_get_history(snapshot, &found));
  mvs_snapshot_release(snapshot);
  return found;
}

static mvs_site on_scallop(const char *name, double along, double height) {
  mvs_site site = {MVS_SITE_ANATOMICAL, 0, id_of(MVS_PART_SCALLOP, name), {along, height, 0}};
  return site;
}

static void new_valve(void) {
  MUST(generate_founding(sim));
}

static void close_a_bit(void) {
  mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  mvs_settle_options options = {.struct_size = sizeof options, .max_iterations = 5};
  MUST(mvs_set_load(sim, &systole));
  MUST(mvs_settle(sim, &options, NULL));
}

/* One operation of each kind that this valve accepts. */
enum { most_examples = 16 };
typedef union example {
  mvs_op op;
  mvs_op_chord_length length;
  mvs_op_chord_remove remove;
  mvs_op_chord_add add;
  mvs_op_chord_transfer transfer;
  mvs_op_annulus_scale scale;
  mvs_op_neochord neochord;
  mvs_op_head_move move;
  mvs_op_ring ring;
  mvs_op_band band;
  mvs_op_clip clip;
  mvs_op_resect resect;
  mvs_op_patch patch;
} example;

static int make_examples(example *out) {
  mvs_id chord = id_of(MVS_PART_CHORD, "P2/3"), head = id_of(MVS_PART_HEAD, "PM1");
  mvs_id other = id_of(MVS_PART_HEAD, "PM2");
  int n = 0;
  out[n++].length = (mvs_op_chord_length){
      {sizeof(mvs_op_chord_length), MVS_OP_CHORD_LENGTH}, chord, 0, 0.75, {{0}, 0, 0}};
  out[n++].remove =
      (mvs_op_chord_remove){{sizeof(mvs_op_chord_remove), MVS_OP_CHORD_REMOVE}, chord};
  out[n++].add = (mvs_op_chord_add){.op = {sizeof(mvs_op_chord_add), MVS_OP_CHORD_ADD},
                                    .head = head,
                                    .site = on_scallop("P2", 0.4, 0.8)};
  out[n++].transfer =
      (mvs_op_chord_transfer){.op = {sizeof(mvs_op_chord_transfer), MVS_OP_CHORD_TRANSFER},
                              .chord = chord,
                              .site = on_scallop("A2", 0.5, 0.9)};
  out[n++].transfer =
      (mvs_op_chord_transfer){.op = {sizeof(mvs_op_chord_transfer), MVS_OP_CHORD_TRANSFER},
                              .chord = id_of(MVS_PART_CHORD, "A1/2"),
                              .end = MVS_CHORD_END_HEAD,
                              .head = other};
  out[n++].scale =
      (mvs_op_annulus_scale){{sizeof(mvs_op_annulus_scale), MVS_OP_ANNULUS_SCALE}, 0.95, 0, 0};
  out[n++].neochord = (mvs_op_neochord){.op = {sizeof(mvs_op_neochord), MVS_OP_NEOCHORD},
                                        .head = head,
                                        .site = on_scallop("P2", 0.5, 1)};
  out[n++].move = (mvs_op_head_move){.op = {sizeof(mvs_op_head_move), MVS_OP_HEAD_MOVE},
                                     .head = head,
                                     .by = {0, 0, 2e-3},
                                     .frame = 1};
  out[n++].ring = (mvs_op_ring){.op = {sizeof(mvs_op_ring), MVS_OP_RING}, .size = 34e-3};
  out[n++].band = (mvs_op_band){.op = {sizeof(mvs_op_band), MVS_OP_BAND}, .factor = 0.9};
  out[n++].clip = (mvs_op_clip){.op = {sizeof(mvs_op_clip), MVS_OP_CLIP}};
  out[n++].resect =
      (mvs_op_resect){.op = {sizeof(mvs_op_resect), MVS_OP_RESECT}, .width = 7e-3, .position = 0.2};
  out[n++].patch = (mvs_op_patch){.op = {sizeof(mvs_op_patch), MVS_OP_PATCH},
                                  .site = on_scallop("A2", 0.5, 0.5)};
  return n;
}

static void every_operation_can_be_taken_back_and_done_again(void) {
  example list[most_examples];
  new_valve();
  close_a_bit();
  const int count = make_examples(list);
  for (int k = 0; k < count; ++k) {
    const hash128 before = sim_hash(sim);
    const mvs_history past = history();
    MUST(mvs_check_op(sim, &list[k].op));
    CHECK(same_hash(before, sim_hash(sim)));
    MUST(mvs_apply_op(sim, &list[k].op, NULL));
    const hash128 after = sim_hash(sim);
    CHECK(!same_hash(before, after));
    CHECK(history().done == past.done + 1);
    close_a_bit();
    MUST(mvs_undo(sim));
    CHECK(same_hash(before, sim_hash(sim)));
    CHECK(history().undone == 1);
    MUST(mvs_redo(sim));
    CHECK(same_hash(after, sim_hash(sim)));
    MUST(mvs_undo(sim));
  }
}

static int is_at_rest(void) {
  const mvs_snapshot *snapshot = present();
  mvs_rest rest = {.struct_size = sizeof rest};
  MUST(mvs_snapshot_get_rest(snapshot, &rest));
  mvs_snapshot_release(snapshot);
  return rest.at_rest == 1;
}

/* Measures from before an operation do not hold after it; new ones need a settle. */
static void every_operation_ends_rest(void) {
  example list[most_examples];
  mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  mvs_stats stats = {.struct_size = sizeof stats};
  new_valve();
  MUST(mvs_set_load(sim, &systole));
  MUST(mvs_settle(sim, NULL, NULL));
  const int count = make_examples(list);
  for (int k = 0; k < count; ++k) {
    CHECK(is_at_rest());
    MUST(mvs_apply_op(sim, &list[k].op, NULL));
    MUST(mvs_get_stats(sim, &stats));
    CHECK(!is_at_rest() && stats.converged == 0);
    MUST(mvs_undo(sim));
    MUST(mvs_get_stats(sim, &stats));
    CHECK(is_at_rest() && stats.converged == 1);
  }
}

static void undoing_everything_gives_the_first_valve(void) {
  example list[most_examples];
  new_valve();
  const hash128 first = sim_hash(sim);
  const int count = make_examples(list);
  int done = 0;
  for (int k = 0; k < count; ++k) {
    /* a chord that was cut cannot be transferred */
    if (mvs_apply_op(sim, &list[k].op, NULL) == MVS_OK) ++done;
    close_a_bit();
  }
  CHECK(done >= count - 1);
  const hash128 last_before = sim_hash(sim);
  for (int k = 0; k < done; ++k) MUST(mvs_undo(sim));
  CHECK(same_hash(first, sim_hash(sim)));
  MUST_FAIL(mvs_undo(sim), MVS_E_STATE, "no operation to undo");
  for (int k = 0; k < done; ++k) MUST(mvs_redo(sim));
  CHECK(!same_hash(last_before, sim_hash(sim))); /* redo gives the bits right after the operation */
  MUST_FAIL(mvs_redo(sim), MVS_E_STATE, "no operation to redo");
}

static void groups_go_together(void) {
  example list[most_examples];
  new_valve();
  const hash128 first = sim_hash(sim);
  make_examples(list);
  MUST(mvs_begin_group(sim, "repair of P2"));
  MUST_FAIL(mvs_begin_group(sim, "again"), MVS_E_STATE, "repair of P2");
  MUST(mvs_apply_op(sim, &list[0].op, NULL));
  MUST(mvs_apply_op(sim, &list[2].op, NULL));
  MUST_FAIL(mvs_undo(sim), MVS_E_STATE, "is open");
  MUST(mvs_end_group(sim));
  MUST_FAIL(mvs_end_group(sim), MVS_E_STATE, "no group");
  const hash128 after = sim_hash(sim);
  MUST(mvs_apply_op(sim, &list[5].op, NULL));
  const mvs_snapshot *snapshot = present();
  mvs_history_entry entry[3] = {{.struct_size = sizeof entry[0]},
                                {.struct_size = sizeof entry[0]},
                                {.struct_size = sizeof entry[0]}};
  for (uint32_t k = 0; k < 3; ++k) MUST(mvs_snapshot_get_history_entry(snapshot, k, &entry[k]));
  CHECK(entry[0].group != 0 && entry[0].group == entry[1].group && entry[2].group == 0);
  CHECK(strcmp(entry[0].in_group, "repair of P2") == 0);
  CHECK(strstr(entry[0].title, "Shorten chord P2/3") != NULL);
  CHECK(entry[1].kind == MVS_OP_CHORD_ADD && entry[1].made != 0);
  MUST_FAIL(mvs_snapshot_get_history_entry(snapshot, 3, &entry[0]), MVS_E_ARGUMENT,
            "has 3 entries");
  mvs_snapshot_release(snapshot);
  MUST(mvs_undo(sim));
  CHECK(same_hash(after, sim_hash(sim)));
  MUST(mvs_undo(sim));
  CHECK(same_hash(first, sim_hash(sim)));
  MUST(mvs_redo(sim));
  CHECK(same_hash(after, sim_hash(sim)));
}

static void checkpoints_are_places_to_come_back_to(void) {
  example list[most_examples];
  new_valve();
  make_examples(list);
  MUST(mvs_apply_op(sim, &list[0].op, NULL));
  MUST(mvs_set_checkpoint(sim, "shortened"));
  const hash128 kept = sim_hash(sim);
  MUST(mvs_undo(sim));
  MUST(mvs_apply_op(sim, &list[5].op, NULL));
  close_a_bit();
  MUST(mvs_restore_checkpoint(sim, "shortened"));
  CHECK(same_hash(kept, sim_hash(sim)));
  CHECK(history().done == 1 && history().undone == 0 && history().checkpoints == 1);
  const mvs_snapshot *snapshot = present();
  const char *name = NULL;
  MUST(mvs_snapshot_get_checkpoint(snapshot, 0, &name));
  CHECK(strcmp(name, "shortened") == 0);
  MUST_FAIL(mvs_snapshot_get_checkpoint(snapshot, 1, &name), MVS_E_ARGUMENT, "1 checkpoints");
  mvs_snapshot_release(snapshot);
  MUST_FAIL(mvs_restore_checkpoint(sim, "none"), MVS_E_ID, "no checkpoint named \"none\"");
  MUST_FAIL(mvs_set_checkpoint(sim, ""), MVS_E_ARGUMENT, "1 to 63 bytes");
}

/* Check and apply return the same code and sentence, and the state is unchanged. */
static void must_refuse(const void *op, mvs_result code, const char *word, int line) {
  char said[sizeof mvs_last_error()->message];
  const hash128 before = sim_hash(sim);
  const mvs_result checked = mvs_check_op(sim, (const mvs_op *)op);
  memcpy(said, mvs_last_error()->message, sizeof said);
  const mvs_result applied = mvs_apply_op(sim, (const mvs_op *)op, NULL);
  if (checked != code || applied != code || strcmp(said, mvs_last_error()->message) != 0 ||
      !strstr(said, word)) {
    ++failures;
    printf("line %d: %s then %s: %s\n  wanted %s and \"%s\"\n", line, mvs_result_name(checked),
           mvs_result_name(applied), said, mvs_result_name(code), word);
  }
  CHECK(same_hash(before, sim_hash(sim)));
}
#define REFUSED(op, code, word) must_refuse(&(op), code, word, __LINE__)

static void what_cannot_be_done_is_said(void) {
  example list[most_examples];
  new_valve();
  make_examples(list);
  mvs_op_chord_length length = list[0].length;
  length.length = 0.02;
  REFUSED(length, MVS_E_ARGUMENT, "2 of length, factor and drag_to");
  length.factor = 0;
  length.length = -0.01;
  REFUSED(length, MVS_E_ARGUMENT, "length is -0.01 m");
  length.length = 20;
  REFUSED(length, MVS_E_ARGUMENT, "0.0001 to 0.2");
  length.length = NAN;
  REFUSED(length, MVS_E_ARGUMENT, "length is");
  length.length = 0;
  REFUSED(length, MVS_E_ARGUMENT, "0 of length, factor and drag_to");
  length.factor = 0.5;
  length.chord = id_of(MVS_PART_HEAD, "PM1");
  REFUSED(length, MVS_E_ID, "is papillary head PM1, not a chord");
  length.chord = 123456;
  REFUSED(length, MVS_E_ID, "no part of this valve ever had id 123456");
  length.chord = 0;
  REFUSED(length, MVS_E_ID, "chord is not given");
  length.op.kind = 999;
  REFUSED(length, MVS_E_VERSION, "op.kind is 999");
  length.op.struct_size = 3;
  REFUSED(length, MVS_E_ARGUMENT, "struct_size is 3");
  mvs_op_chord_add add = list[2].add;
  add.site.u[0] = 1.5;
  REFUSED(add, MVS_E_ARGUMENT, "coordinate of 1.5");
  add.site = (mvs_site){MVS_SITE_NODE, 1000000, 0, {0}};
  REFUSED(add, MVS_E_ID, "node 1000000");
  add.site = (mvs_site){MVS_SITE_TRIANGLE, 3, 0, {0.2, 0.2, 0.2}};
  REFUSED(add, MVS_E_ARGUMENT, "sum up to 0.6");
  const mvs_snapshot *snapshot = present();
  mvs_view view;
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_ANNULUS_NODES, &view));
  add.site = (mvs_site){MVS_SITE_NODE, *(const uint32_t *)view.data, 0, {0}};
  REFUSED(add, MVS_E_OP, "on the annulus");
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_HEAD_NODES, &view));
  add.site.index = *(const uint32_t *)view.data;
  REFUSED(add, MVS_E_OP, "no vertex of a leaflet");
  mvs_snapshot_release(snapshot);
  mvs_op_chord_transfer transfer = list[3].transfer;
  transfer.site.how = MVS_SITE_NONE;
  REFUSED(transfer, MVS_E_ARGUMENT, "needs a site");
  transfer.end = MVS_CHORD_END_HEAD;
  REFUSED(transfer, MVS_E_ID, "needs a papillary head");
  mvs_op_annulus_scale scale = list[5].scale;
  scale.factor = 0;
  REFUSED(scale, MVS_E_ARGUMENT, "at least one of");
  mvs_op_chord_remove remove = list[1].remove;
  MUST(mvs_apply_op(sim, &remove.op, NULL));
  REFUSED(remove, MVS_E_ID, "does not exist any more");
  MUST_FAIL(mvs_check_op(sim, NULL), MVS_E_ARGUMENT, "null pointer");
}

static hash128 clipped(mvs_op_clip op) {
  new_valve();
  MUST(mvs_apply_op(sim, &op.op, NULL));
  return sim_hash(sim);
}

/* A program compiled before clips could be turned has a shorter struct. */
static void a_clip_of_an_older_program_is_not_turned(void) {
  mvs_op_clip clip = {.op = {sizeof clip, MVS_OP_CLIP}};
  const hash128 straight = clipped(clip);
  clip.angle = 0.4;
  CHECK(!same_hash(straight, clipped(clip)));
  clip.op.struct_size = offsetof(mvs_op_clip, angle);
  CHECK(same_hash(straight, clipped(clip)));
  clip.op.struct_size = sizeof clip;
  clip.angle = 30;
  REFUSED(clip, MVS_E_ARGUMENT, "angle is 30 rad");
}

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

/* Every field of an operation's struct is described with its offset. */
static void operations_describe_themselves(void) {
  CHECK(mvs_get_op_count() >= 7);
  for (uint32_t k = 0; k < mvs_get_op_count(); ++k) {
    mvs_op_info info = {.struct_size = sizeof info};
    MUST(mvs_get_op_info(k, &info));
    CHECK(info.fields > 0 && info.size > sizeof(mvs_op) && *info.help);
    uint32_t end = sizeof(mvs_op);
    for (uint32_t f = 0; f < info.fields; ++f) {
      mvs_field_info field = {.struct_size = sizeof field};
      MUST(mvs_get_op_field(k, f, &field));
      CHECK(field.offset >= end && field.offset < info.size && *field.help);
      end = field.offset + 4;
      /* a default that is a number or a choice may be given */
      const double fallback = field.default_value;
      CHECK((field.default_text[0] != 0) == (strchr(field.help, '[') != NULL));
      CHECK(isnan(fallback) || (fallback >= field.low && fallback <= field.high));
      if (strcmp(field.name, "young") == 0 && strcmp(info.name, "chord_add") == 0) {
        CHECK(fallback == 40e6 && strcmp(field.default_text, "40e6") == 0);
      }
      if (strcmp(field.name, "end") == 0) CHECK(fallback == 1);
    }
    mvs_field_info none = {.struct_size = sizeof none};
    MUST_FAIL(mvs_get_op_field(k, info.fields, &none), MVS_E_ARGUMENT, "fields");
  }
  mvs_op_info none = {.struct_size = sizeof none};
  MUST_FAIL(mvs_get_op_info(mvs_get_op_count(), &none), MVS_E_ARGUMENT, "kinds of operations");
}

int main(void) {
  MUST(mvs_create(NULL, &sim));
  MUST_FAIL(mvs_undo(sim), MVS_E_STATE, "no valve");
  every_operation_can_be_taken_back_and_done_again();
  every_operation_ends_rest();
  undoing_everything_gives_the_first_valve();
  groups_go_together();
  checkpoints_are_places_to_come_back_to();
  what_cannot_be_done_is_said();
  a_clip_of_an_older_program_is_not_turned();
  a_dragged_chord_has_the_length_to_there();
  a_chord_tied_to_another_head_gets_the_length_of_a_new_one();
  operations_describe_themselves();
  mvs_destroy(sim);
  return finish("operations");
}
