/* A journal whose file is deleted while it is open: a call that cannot be recorded fails. */
#include <unistd.h>

#include "tests/api/repair.h"

static void a_call_that_cannot_be_recorded_changes_nothing(const char *path) {
  mvs_sim *sim = new_valve(200), *again = new_valve(200);
  mvs_op_annulus_scale op = {{sizeof op, MVS_OP_ANNULUS_SCALE}, 0.9, 0, 0};
  MUST(mvs_open_journal(sim, path));
  scale(sim, 0.95);
  const hash128 before = sim_hash(sim);
  remove(path);
  MUST_FAIL(mvs_apply_op(sim, &op.op, NULL), MVS_E_IO, "was deleted while it was open");
  MUST_FAIL(mvs_undo(sim), MVS_E_IO, "was deleted");
  MUST_FAIL(mvs_set_checkpoint(sim, "here"), MVS_E_IO, "was deleted");
  CHECK(same_hash(before, sim_hash(sim)));
  /* the end of the journal fails too, and the journal is closed */
  MUST_FAIL(mvs_close_journal(sim), MVS_E_IO, "was deleted");
  MUST_FAIL(mvs_close_journal(sim), MVS_E_STATE, "no journal is open");
  /* another one begins with the history so far */
  MUST(mvs_open_journal(sim, path));
  scale(sim, 0.9);
  MUST(mvs_close_journal(sim));
  MUST(mvs_recover_journal(again, path, NULL));
  CHECK(same_hash(sim_hash(sim), sim_hash(again)));
  mvs_destroy(again);
  mvs_destroy(sim);
}

int main(void) {
  char path[64];
  snprintf(path, sizeof path, "lost_journal_test_%d.journal", (int)getpid());
  remove(path);
  a_call_that_cannot_be_recorded_changes_nothing(path);
  remove(path);
  return finish("lost_journal");
}
