/* Groups of measures: each alone has the bits of the whole, the other fields are NaN and 0. */
#include <math.h>

#include "check.h"
#include "funnel.h"

static const uint32_t groups[] = {MVS_MEASURE_GROUP_CROSSINGS,  MVS_MEASURE_GROUP_ORIFICE,
                                  MVS_MEASURE_GROUP_COAPTATION, MVS_MEASURE_GROUP_TENTING,
                                  MVS_MEASURE_GROUP_ANNULUS,    MVS_MEASURE_GROUP_CHORDS,
                                  MVS_MEASURE_GROUP_LEAFLETS};
enum { GROUPS = sizeof groups / sizeof *groups };

static mvs_sim *sim;
static funnel f;

/* A snapshot that has computed nothing yet of the open funnel. */
static const mvs_snapshot *new_snapshot(void) {
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_set_valve(sim, &f.desc));
  MUST(mvs_get_snapshot(sim, &snapshot));
  return snapshot;
}

/* Whether the fields of `groups` have the bits of `whole`, and all others are NaN or 0. */
static int holds_exactly(const mvs_measures *some, uint32_t asked, const mvs_measures *whole) {
  int good = 1;
  for (uint32_t k = 0; k < mvs_get_field_count(MVS_STRUCT_MEASURES); ++k) {
    mvs_field_info field = {.struct_size = sizeof field};
    MUST(mvs_get_field(MVS_STRUCT_MEASURES, k, &field));
    const char *at = (const char *)some + field.offset, *is = (const char *)whole + field.offset;
    const size_t size = field.type == MVS_FIELD_COUNT ? sizeof(uint32_t) : sizeof(double);
    double number = 0;
    uint32_t count = 0;
    memcpy(field.type == MVS_FIELD_COUNT ? (void *)&count : (void *)&number, at, size);
    if (field.group == 0 || (field.group & asked) != 0) {
      good &= same_bits(at, is, size);
    } else {
      good &= field.type == MVS_FIELD_COUNT ? count == 0 : isnan(number);
    }
  }
  return good;
}

static void every_field_but_two_has_a_group_with_its_word(void) {
  const char *const words[GROUPS] = {"crossings", "orifice", "coaptation", "tenting",
                                     "annulus",   "chords",  "leaflets"};
  uint32_t seen = 0, without = 0;
  for (uint32_t k = 0; k < mvs_get_field_count(MVS_STRUCT_MEASURES); ++k) {
    mvs_field_info field = {.struct_size = sizeof field};
    MUST(mvs_get_field(MVS_STRUCT_MEASURES, k, &field));
    seen |= field.group;
    if (field.group == 0) {
      ++without;
      CHECK(field.group_name[0] == 0);
      CHECK(strcmp(field.name, "at_rest") == 0 || strcmp(field.name, "under_load") == 0);
    }
    for (int g = 0; g < GROUPS; ++g) {
      if (field.group == groups[g]) CHECK(strcmp(field.group_name, words[g]) == 0);
    }
  }
  CHECK(seen == (1u << GROUPS) - 1 && without == 2);
}

static void each_group_alone_has_the_bits_of_the_whole(void) {
  mvs_measures whole = {.struct_size = sizeof whole};
  const mvs_snapshot *measured = new_snapshot();
  MUST(mvs_snapshot_measure(measured, &whole));
  CHECK(holds_exactly(&whole, (1u << GROUPS) - 1, &whole));
  for (uint32_t asked = 0; asked < 1u << GROUPS; ++asked) {
    /* every group alone on a snapshot of its own; all subsets on the one that knows the whole */
    const int alone = (asked & (asked - 1)) == 0;
    const mvs_snapshot *snapshot = alone ? new_snapshot() : measured;
    mvs_measures some = {.struct_size = sizeof some};
    MUST(mvs_snapshot_measure_groups(snapshot, asked, &some));
    CHECK(some.struct_size == sizeof some && holds_exactly(&some, asked, &whole));
    if (!alone) continue;
    /* the groups that were left out are computed when they are asked for */
    MUST(mvs_snapshot_measure(snapshot, &some));
    CHECK(same_bits(&some, &whole, sizeof whole));
    mvs_snapshot_release(snapshot);
  }
  mvs_snapshot_release(measured);
}

static void unknown_groups_are_refused(void) {
  const mvs_snapshot *snapshot = new_snapshot();
  mvs_measures m = {.struct_size = sizeof m};
  MUST_FAIL(mvs_snapshot_measure_groups(snapshot, MVS_MEASURE_GROUP_ANNULUS | 128, &m),
            MVS_E_ARGUMENT, "groups has bits 0x80 that this version does not know");
  MUST_FAIL(mvs_snapshot_measure_groups(NULL, 1, &m), MVS_E_ARGUMENT, "snapshot is a null pointer");
  MUST_FAIL(mvs_snapshot_measure_groups(snapshot, 1, NULL), MVS_E_ARGUMENT,
            "measures is a null pointer");
  m.struct_size = 0;
  MUST_FAIL(mvs_snapshot_measure_groups(snapshot, 1, &m), MVS_E_ARGUMENT, "measures.struct_size");
  mvs_snapshot_release(snapshot);
}

int main(void) {
  make_funnel(&f);
  MUST(mvs_create(NULL, &sim));
  every_field_but_two_has_a_group_with_its_word();
  each_group_alone_has_the_bits_of_the_whole();
  unknown_groups_are_refused();
  mvs_destroy(sim);
  return finish("groups");
}
