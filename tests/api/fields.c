/* Described fields of results, and arrays of structs of other sizes than this library's. */
#include <stddef.h>

#include "check.h"
#include "funnel.h"

static void every_field_of_the_measures_is_described(void) {
  mvs_field_info field = {.struct_size = sizeof field};
  uint32_t end = sizeof(uint32_t);
  for (uint32_t k = 0; k < mvs_get_field_count(MVS_STRUCT_MEASURES); ++k) {
    MUST(mvs_get_field(MVS_STRUCT_MEASURES, k, &field));
    CHECK(field.offset == end);
    CHECK(field.name[0] != 0 && field.label[0] != 0 && field.help[0] != 0);
    CHECK(field.type == MVS_FIELD_COUNT || field.type == MVS_FIELD_NUMBER);
    end += field.type == MVS_FIELD_COUNT ? (uint32_t)sizeof(uint32_t) : (uint32_t)sizeof(double);
  }
  CHECK(end == sizeof(mvs_measures));
  MUST(mvs_get_field(MVS_STRUCT_STATS, 5, &field));
  CHECK(strcmp(field.name, "residual") == 0 && strcmp(field.unit, "N") == 0);
  CHECK(field.offset == offsetof(mvs_stats, residual));
  CHECK(mvs_get_field_count(99) == 0);
  MUST_FAIL(mvs_get_field(99, 0, &field), MVS_E_ARGUMENT, "MVS_STRUCT_");
  MUST_FAIL(mvs_get_field(MVS_STRUCT_STATS, 99, &field), MVS_E_ARGUMENT, "11 fields");
  MUST_FAIL(mvs_get_field(MVS_STRUCT_STATS, 0, NULL), MVS_E_ARGUMENT, "field");
}

/* A program built with a later header: its structs are longer. */
static void longer_elements_are_read_by_their_stride(void) {
  static funnel f;
  static struct {
    mvs_chord_desc known;
    double later;
  } chords[FUNNEL_CHORDS];
  mvs_sim *sim = NULL;
  uint64_t before[2], after[2];
  const mvs_snapshot *snapshot = NULL;
  make_funnel(&f);
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_set_valve(sim, &f.desc));
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST(mvs_snapshot_get_hash(snapshot, before));
  mvs_snapshot_release(snapshot);
  for (int c = 0; c < FUNNEL_CHORDS; ++c) chords[c].known = f.chords[c];
  f.desc.chords = &chords[0].known;
  f.desc.chord_stride = sizeof chords[0];
  MUST(mvs_set_valve(sim, &f.desc));
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST(mvs_snapshot_get_hash(snapshot, after));
  mvs_snapshot_release(snapshot);
  CHECK(before[0] == after[0] && before[1] == after[1]);
  chords[2].later = 1;
  MUST_FAIL(mvs_set_valve(sim, &f.desc), MVS_E_VERSION, "chords[2]");
  f.desc.chord_stride = 0;
  MUST_FAIL(mvs_set_valve(sim, &f.desc), MVS_E_ARGUMENT, "stride of chords is 0");
  mvs_destroy(sim);
}

static void no_bending_is_a_flag(void) {
  static funnel f;
  make_funnel(&f);
  f.desc.flags = MVS_VALVE_FLAG_NO_BENDING;
  f.desc.bending_scale = 1;
  MUST_FAIL(mvs_check_valve(&f.desc, NULL, NULL), MVS_E_ARGUMENT, "MVS_VALVE_FLAG_NO_BENDING");
  f.desc.bending_scale = 0;
  MUST(mvs_check_valve(&f.desc, NULL, NULL));
  f.desc.flags = 0;
  f.desc.bending_scale = -1;
  MUST_FAIL(mvs_check_valve(&f.desc, NULL, NULL), MVS_E_OP, "bending scale");
}

/* An operation with a field left at 0 and the same with the described default give the same bits.
 */
static void described_defaults_are_the_defaults(void) {
  mvs_sim *sim = NULL;
  const mvs_snapshot *open = NULL;
  mvs_part head = {0}, scallop = {0};
  mvs_op_ring ring = {.op = {sizeof ring, MVS_OP_RING}, .size = 0.034};
  mvs_op_chord_add chord = {.op = {sizeof chord, MVS_OP_CHORD_ADD}};
  mvs_op *const ops[] = {&ring.op, &chord.op};
  int filled = 0;
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_generate_valve(sim, NULL));
  MUST(mvs_get_snapshot(sim, &open));
  MUST(mvs_snapshot_get_part(open, MVS_PART_HEAD, 0, &head));
  MUST(mvs_snapshot_find_part(open, MVS_PART_SCALLOP, "A2", &scallop));
  chord.head = head.id;
  chord.site.how = MVS_SITE_ANATOMICAL;
  chord.site.scallop = scallop.id;
  chord.site.u[0] = chord.site.u[1] = 0.5;
  for (size_t k = 0; k < 2; ++k) {
    const hash128 before = sim_hash(sim);
    hash128 zero;
    mvs_op_info kind = {.struct_size = sizeof kind};
    uint32_t index = 0;
    MUST(mvs_apply_op(sim, ops[k], NULL));
    zero = sim_hash(sim);
    MUST(mvs_undo(sim));
    while (mvs_get_op_info(index, &kind) == MVS_OK && kind.kind != ops[k]->kind) ++index;
    for (uint32_t f = 0; f < kind.fields; ++f) {
      mvs_field_info field = {.struct_size = sizeof field};
      double *at;
      MUST(mvs_get_op_field(index, f, &field));
      at = (double *)((char *)ops[k] + field.offset);
      if (field.type != MVS_FIELD_NUMBER || *at != 0 || field.default_value != field.default_value)
        continue;
      *at = field.default_value;
      ++filled;
    }
    MUST(mvs_apply_op(sim, ops[k], NULL));
    CHECK(same_hash(sim_hash(sim), zero));
    MUST(mvs_undo(sim));
    CHECK(same_hash(sim_hash(sim), before));
  }
  CHECK(filled == 3); /* ap_ratio; young and area */
  mvs_snapshot_release(open);
  mvs_destroy(sim);
}

int main(void) {
  described_defaults_are_the_defaults();
  every_field_of_the_measures_is_described();
  longer_elements_are_read_by_their_stride();
  no_bending_is_a_flag();
  return finish("fields");
}
