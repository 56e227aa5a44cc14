/* Operations: undo and redo are exact, every operation ends rest, groups, checkpoints.
 * operation_faults.c tests refusals, operation_chords.c the lengths of chordae. */
#include "examples.h"

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

int main(void) {
  MUST(mvs_create(NULL, &sim));
  MUST_FAIL(mvs_undo(sim), MVS_E_STATE, "no valve");
  every_operation_can_be_taken_back_and_done_again();
  every_operation_ends_rest();
  undoing_everything_gives_the_first_valve();
  groups_go_together();
  checkpoints_are_places_to_come_back_to();
  mvs_destroy(sim);
  return finish("operations");
}
