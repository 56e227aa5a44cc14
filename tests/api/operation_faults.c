/* Operations: check and apply refuse with the same sentence, older structs are accepted, and every
 * field is described. */
#include <stddef.h>

#include "examples.h"

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
  length.op.kind = 0;
  REFUSED(length, MVS_E_ARGUMENT, "op.kind is not set");
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
  add.site = (mvs_site){MVS_SITE_ANATOMICAL, 0, 0, {0.5, 0.5, 0}};
  REFUSED(add, MVS_E_ID, "chord_add: site.scallop is not given");
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
  what_cannot_be_done_is_said();
  a_clip_of_an_older_program_is_not_turned();
  operations_describe_themselves();
  mvs_destroy(sim);
  return finish("operation_faults");
}
