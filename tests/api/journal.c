/* Journals survive a killed process. */
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "repair.h"

static char path[64]; /* path of the open journal */

/* The calls of a session with a journal; `after` receives the hash after each recorded call. */
enum { session_length = 9 };
static void session(mvs_sim *sim, int steps, hash128 *after) {
  for (int k = 0; k < steps; ++k) {
    if (k == 0) shorten(sim, "P2/3", 0.75);
    if (k == 1) close_a_bit(sim);
    if (k == 1) add_chord(sim);
    if (k == 2) MUST(mvs_undo(sim));
    if (k == 3) MUST(mvs_redo(sim));
    if (k == 4 || k == 5) close_a_bit(sim);
    if (k == 4) MUST(mvs_set_checkpoint(sim, "here"));
    if (k == 5) scale(sim, 0.9);
    if (k == 6) MUST(mvs_restore_checkpoint(sim, "here"));
    if (k == 7) scale(sim, 1.1);
    if (k == 8) shorten(sim, "A2/2", 1.1);
    if (after) after[k] = sim_hash(sim);
  }
}

static char *whole_file(size_t *size) {
  FILE *file = fopen(path, "rb");
  char *bytes = calloc(1, 1 << 20);
  if (!file || !bytes) exit(2);
  *size = fread(bytes, 1, 1 << 20, file);
  fclose(file);
  return bytes;
}

static void write_file(const char *bytes, size_t size) {
  FILE *file = fopen(path, "wb");
  CHECK(file && fwrite(bytes, 1, size, file) == size);
  if (file) fclose(file);
}

/* A child process is killed after each record; the session is recovered, and the journal continues.
 * */
static void a_killed_process_loses_nothing(void) {
  hash128 wanted[session_length];
  mvs_sim *whole = new_valve(200);
  session(whole, session_length, wanted);
  for (int steps = 1; steps <= session_length; ++steps) {
    remove(path);
    const pid_t child = fork();
    if (child == 0) {
      mvs_sim *sim = new_valve(200);
      MUST(mvs_open_journal(sim, path));
      session(sim, steps, NULL);
      kill(getpid(), SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    CHECK(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    mvs_sim *sim = new_valve(200);
    mvs_replay replay = {.struct_size = sizeof replay};
    MUST(mvs_recover_journal(sim, path, &replay));
    CHECK(same_hash(wanted[steps - 1], sim_hash(sim)));
    MUST(mvs_close_journal(sim));
    mvs_destroy(sim);
  }
  mvs_destroy(whole);
}

/* The last record is cut at many bytes: the records before it are recovered. */
static void a_torn_record_is_dropped(void) {
  hash128 wanted[session_length];
  size_t size = 0;
  mvs_sim *sim = new_valve(200);
  remove(path);
  MUST(mvs_open_journal(sim, path));
  session(sim, session_length, wanted);
  mvs_destroy(sim);
  char *bytes = whole_file(&size);
  size_t last = size > 0 ? size - 1 : 0;
  while (last > 0 && bytes[last - 1] != '\n') --last;
  for (size_t cut = last; cut < size; cut += (size - last) / 7 + 1) {
    write_file(bytes, cut);
    sim = new_valve(200);
    MUST(mvs_recover_journal(sim, path, NULL));
    CHECK(same_hash(wanted[session_length - 2], sim_hash(sim)));
    /* it continues after the last complete record */
    shorten(sim, "A2/2", 1.1);
    CHECK(same_hash(wanted[session_length - 1], sim_hash(sim)));
    mvs_destroy(sim);
    sim = new_valve(200);
    MUST(mvs_recover_journal(sim, path, NULL));
    CHECK(same_hash(wanted[session_length - 1], sim_hash(sim)));
    mvs_destroy(sim);
  }
  /* damage in the middle is reported as an error */
  bytes[size / 2] ^= 1;
  write_file(bytes, size);
  sim = new_valve(200);
  MUST_FAIL(mvs_recover_journal(sim, path, NULL), MVS_E_FORMAT, "is damaged, and others follow");
  write_file("v 0 0 0\n", 8);
  MUST_FAIL(mvs_recover_journal(sim, path, NULL), MVS_E_FORMAT, "not a journal");
  MUST_FAIL(mvs_open_journal(sim, path), MVS_E_STATE, "is there already");
  MUST_FAIL(mvs_open_journal(sim, "/nowhere/at/all"), MVS_E_IO, "cannot create");
  MUST_FAIL(mvs_close_journal(sim), MVS_E_STATE, "no journal is open");
  bytes[size / 2] ^= 1;
  write_file(bytes, size);
  scale(sim, 0.9);
  MUST_FAIL(mvs_recover_journal(sim, path, NULL), MVS_E_STATE, "load that valve first");
  mvs_destroy(sim);
  free(bytes);
}

static void a_restored_snapshot_is_recovered_with_its_history(void) {
  const mvs_snapshot *early = NULL;
  mvs_sim *sim = new_valve(200);
  remove(path);
  shorten(sim, "P2/3", 0.75); /* before the journal starts: its first record includes it */
  MUST(mvs_open_journal(sim, path));
  close_a_bit(sim);
  MUST(mvs_set_checkpoint(sim, "one"));
  MUST(mvs_get_snapshot(sim, &early));
  scale(sim, 0.9);
  MUST(mvs_set_checkpoint(sim, "one"));
  MUST(mvs_restore(sim, early));
  scale(sim, 1.05);
  const hash128 wanted = sim_hash(sim);
  MUST(mvs_undo(sim));
  MUST(mvs_restore_checkpoint(sim, "one"));
  const hash128 one = sim_hash(sim);
  mvs_destroy(sim);
  sim = new_valve(200);
  MUST(mvs_recover_journal(sim, path, NULL));
  CHECK(same_hash(one, sim_hash(sim)));
  scale(sim, 1.05);
  CHECK(same_hash(wanted, sim_hash(sim)));
  MUST(mvs_undo(sim));
  MUST(mvs_undo(sim));
  mvs_destroy(sim);
  mvs_snapshot_release(early);
}

/* Opens the journal in a session that has a history, goes on, and recovers it on the valve where
 * the history began and on the session as it was when the journal was opened. */
static void is_recovered(const mvs_snapshot *began, mvs_sim *sim, void (*go_on)(mvs_sim *)) {
  const mvs_snapshot *opened = NULL;
  remove(path);
  MUST(mvs_get_snapshot(sim, &opened));
  MUST(mvs_open_journal(sim, path));
  go_on(sim);
  const hash128 wanted = sim_hash(sim);
  MUST(mvs_close_journal(sim));
  for (int k = 0; k < 2; ++k) {
    mvs_sim *again = NULL;
    MUST(mvs_create(NULL, &again));
    MUST(mvs_restore(again, k == 0 ? began : opened));
    MUST(mvs_recover_journal(again, path, NULL));
    CHECK(same_hash(wanted, sim_hash(again)));
    /* the same can be undone, and ends where the history began */
    while (mvs_undo(sim) == MVS_OK) {
      MUST(mvs_undo(again));
      CHECK(same_hash(sim_hash(sim), sim_hash(again)));
    }
    MUST_FAIL(mvs_undo(again), MVS_E_STATE, "no operation to undo");
    while (mvs_redo(sim) == MVS_OK) MUST(mvs_redo(again));
    CHECK(same_hash(sim_hash(sim), sim_hash(again)));
    mvs_destroy(again);
  }
  mvs_snapshot_release(opened);
}

static void redo_and_shorten(mvs_sim *sim) {
  MUST(mvs_redo(sim));
  shorten(sim, "A2/2", 1.1);
}

static void back_and_scale(mvs_sim *sim) {
  scale(sim, 0.95);
  MUST(mvs_restore_checkpoint(sim, "here"));
  MUST(mvs_redo(sim));
  scale(sim, 1.05);
}

static void only_scale(mvs_sim *sim) {
  scale(sim, 1.05);
}

static const mvs_snapshot *undone = NULL; /* with operations to redo */

static void restore_and_redo(mvs_sim *sim) {
  scale(sim, 0.95);
  MUST(mvs_restore(sim, undone));
  redo_and_shorten(sim);
}

static void what_was_done_and_undone_before_is_recovered(void) {
  const mvs_snapshot *began = NULL;
  void (*const ways[])(mvs_sim *) = {redo_and_shorten, back_and_scale, restore_and_redo,
                                     only_scale};
  for (int way = 0; way < 4; ++way) {
    mvs_sim *sim = new_valve(200);
    MUST(mvs_get_snapshot(sim, &began));
    close_a_bit(sim);
    shorten(sim, "P2/3", 0.75);
    close_a_bit(sim);
    MUST(mvs_begin_group(sim, "two"));
    scale(sim, 0.9);
    scale(sim, 0.95);
    MUST(mvs_end_group(sim));
    MUST(mvs_undo(sim));
    MUST(mvs_set_checkpoint(sim, "here"));
    close_a_bit(sim); /* after the undo: redo leads away from it, and a crash must not */
    MUST(mvs_get_snapshot(sim, &undone));
    if (way == 1) shorten(sim, "A2/2", 0.9);
    is_recovered(began, sim, ways[way]);
    mvs_snapshot_release(undone);
    mvs_snapshot_release(began);
    mvs_destroy(sim);
  }
}

static void a_group_that_is_open_stays_one(void) {
  mvs_sim *sim = new_valve(200), *again = new_valve(200);
  remove(path);
  MUST(mvs_begin_group(sim, "two"));
  scale(sim, 0.9);
  MUST(mvs_open_journal(sim, path));
  scale(sim, 0.95);
  MUST(mvs_end_group(sim));
  MUST(mvs_undo(sim));
  MUST_FAIL(mvs_recover_journal(again, path, NULL), MVS_E_STATE, "is open in another simulator");
  MUST(mvs_close_journal(sim));
  MUST(mvs_recover_journal(again, path, NULL));
  CHECK(same_hash(sim_hash(sim), sim_hash(again)));
  MUST(mvs_redo(sim));
  MUST(mvs_redo(again));
  CHECK(same_hash(sim_hash(sim), sim_hash(again)));
  mvs_destroy(sim);
  mvs_destroy(again);
}

/* A session with operations that the journal does not have is not replaced. */
static void another_session_of_the_same_valve_is_refused(void) {
  mvs_sim *sim = new_valve(200);
  remove(path);
  MUST(mvs_open_journal(sim, path));
  scale(sim, 0.9);
  MUST(mvs_close_journal(sim));
  const hash128 here = sim_hash(sim);
  MUST_FAIL(mvs_recover_journal(sim, path, NULL), MVS_E_STATE, "load that valve first");
  CHECK(same_hash(here, sim_hash(sim)));
  mvs_destroy(sim);
}

/* The last record is whole but for one bit: the others are recovered, and the outcome says so. */
static void a_damaged_last_record_is_reported(void) {
  size_t size = 0;
  mvs_replay replay = {.struct_size = sizeof replay};
  mvs_sim *sim = new_valve(200);
  remove(path);
  MUST(mvs_open_journal(sim, path));
  shorten(sim, "P2/3", 0.75);
  const hash128 wanted = sim_hash(sim);
  scale(sim, 0.9);
  mvs_destroy(sim);
  char *bytes = whole_file(&size);
  for (int damaged = 0; damaged < 2; ++damaged) {
    if (damaged) bytes[size - 3] ^= 1;
    write_file(bytes, size);
    sim = new_valve(200);
    MUST(mvs_recover_journal(sim, path, &replay));
    CHECK(replay.same_result == !damaged && replay.operations == 2 - (uint32_t)damaged);
    CHECK(same_hash(wanted, sim_hash(sim)) == damaged);
    mvs_destroy(sim);
  }
  free(bytes);
}

int main(void) {
  snprintf(path, sizeof path, "journal_test_%d.journal", (int)getpid());
  a_killed_process_loses_nothing();
  a_torn_record_is_dropped();
  a_restored_snapshot_is_recovered_with_its_history();
  what_was_done_and_undone_before_is_recovered();
  a_group_that_is_open_stays_one();
  another_session_of_the_same_valve_is_refused();
  a_damaged_last_record_is_reported();
  remove(path);
  return finish("journal");
}
