/* Fixture: the shipped valve, and an example of each operation that it accepts. */
#ifndef TESTS_EXAMPLES_H
#define TESTS_EXAMPLES_H

#include <math.h>

#include "check.h"
#include "tests/founding.h"

static mvs_sim *sim;

static inline const mvs_snapshot *present(void) {
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_get_snapshot(sim, &snapshot));
  return snapshot;
}

static inline mvs_id id_of(uint32_t kind, const char *name) {
  const mvs_snapshot *snapshot = present();
  mvs_part part = {0};
  MUST(mvs_snapshot_find_part(snapshot, kind, name, &part));
  mvs_snapshot_release(snapshot);
  return part.id;
}

static inline mvs_history history(void) {
  const mvs_snapshot *snapshot = present();
  mvs_history found = {.struct_size = sizeof found};
  MUST(mvs_snapshot_get_history(snapshot, &found));
  mvs_snapshot_release(snapshot);
  return found;
}

static inline mvs_site on_scallop(const char *name, double along, double height) {
  mvs_site site = {MVS_SITE_ANATOMICAL, 0, id_of(MVS_PART_SCALLOP, name), {along, height, 0}};
  return site;
}

static inline void new_valve(void) {
  MUST(generate_founding(sim));
}

static inline void close_a_bit(void) {
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

static inline int make_examples(example *out) {
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

#endif
