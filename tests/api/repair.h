/* Small valves and a few operations on them, for plans and journals. */
#ifndef MVS_TESTS_API_REPAIR_H
#define MVS_TESTS_API_REPAIR_H

#include "check.h"
#include "tests/founding.h"

static inline mvs_id named(mvs_sim *sim, uint32_t kind, const char *name) {
  const mvs_snapshot *snapshot = NULL;
  mvs_part part = {0};
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST(mvs_snapshot_find_part(snapshot, kind, name, &part));
  mvs_snapshot_release(snapshot);
  return part.id;
}

static inline mvs_sim *new_valve(uint32_t vertices) {
  mvs_sim *sim = NULL;
  mvs_parametric_desc desc = {
      .struct_size = sizeof desc, .vertices = vertices, .shape = MVS_SHAPE_FOUNDING};
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_generate_valve(sim, &desc));
  return sim;
}

static inline void shorten(mvs_sim *sim, const char *name, double factor) {
  mvs_op_chord_length op = {{sizeof op, MVS_OP_CHORD_LENGTH}, 0, 0, factor, {{0}, 0, 0}};
  op.chord = named(sim, MVS_PART_CHORD, name);
  MUST(mvs_apply_op(sim, &op.op, NULL));
}

static inline void add_chord(mvs_sim *sim) {
  mvs_op_chord_add op = {.op = {sizeof op, MVS_OP_CHORD_ADD}, .name = "new one"};
  op.head = named(sim, MVS_PART_HEAD, "PM1");
  op.site = (mvs_site){MVS_SITE_ANATOMICAL, 0, named(sim, MVS_PART_SCALLOP, "P2"), {0.4, 0.8, 0}};
  MUST(mvs_apply_op(sim, &op.op, NULL));
}

static inline void scale(mvs_sim *sim, double factor) {
  mvs_op_annulus_scale op = {{sizeof op, MVS_OP_ANNULUS_SCALE}, factor, 0, 0};
  MUST(mvs_apply_op(sim, &op.op, NULL));
}

static inline void close_a_bit(mvs_sim *sim) {
  mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  mvs_settle_options options = {.struct_size = sizeof options, .max_iterations = 4};
  MUST(mvs_set_load(sim, &systole));
  MUST(mvs_settle(sim, &options, NULL));
  for (int k = 0; k < 3; ++k) MUST(mvs_step(sim, NULL));
}

#endif
