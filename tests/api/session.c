/* HDF5 files restore a whole session, which continues with the same bits as if it had not been
 * saved. */
#include <stdlib.h>

#include "check.h"
#include "tests/founding.h"

static mvs_sim *sim;

static const mvs_snapshot *present(mvs_sim *of) {
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_get_snapshot(of, &snapshot));
  return snapshot;
}

static mvs_id id_of(uint32_t kind, const char *name) {
  const mvs_snapshot *snapshot = present(sim);
  mvs_part part = {0};
  MUST(mvs_snapshot_find_part(snapshot, kind, name, &part));
  mvs_snapshot_release(snapshot);
  return part.id;
}

static char *saved(mvs_sim *of, uint32_t format, uint64_t *size) {
  const mvs_snapshot *snapshot = present(of);
  MUST(mvs_save_memory(snapshot, format, NULL, 0, size));
  char *bytes = malloc(*size);
  if (!bytes) exit(2);
  MUST(mvs_save_memory(snapshot, format, bytes, *size, size));
  mvs_snapshot_release(snapshot);
  return bytes;
}

static mvs_sim *loaded(const char *bytes, uint64_t size, uint32_t format) {
  mvs_sim *other = NULL;
  MUST(mvs_create(NULL, &other));
  MUST(mvs_load_memory(other, bytes, size, format));
  return other;
}

static mvs_sim *saved_and_loaded_as(mvs_sim *of, uint32_t format) {
  uint64_t size = 0;
  char *bytes = saved(of, format, &size);
  mvs_sim *other = loaded(bytes, size, format);
  free(bytes);
  return other;
}

static mvs_sim *saved_and_loaded(mvs_sim *of) {
  return saved_and_loaded_as(of, MVS_FORMAT_H5);
}

static void steps(mvs_sim *of, uint32_t solver, int count) {
  mvs_step_options how = {.struct_size = sizeof how, .solver = solver};
  for (int k = 0; k < count; ++k) MUST(mvs_step(of, &how));
}

/* A moving valve with four operations in its history, the last one undone. */
static void make_session(uint32_t solver) {
  mvs_parametric_desc small = {
      .struct_size = sizeof small, .vertices = 200, .shape = MVS_SHAPE_FOUNDING};
  mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  MUST(mvs_generate_valve(sim, &small));
  mvs_op_chord_length shorter = {
      {sizeof shorter, MVS_OP_CHORD_LENGTH}, id_of(MVS_PART_CHORD, "P2/1"), 0, 0.9, {{0}, 0, 0}};
  mvs_op_annulus_scale smaller = {{sizeof smaller, MVS_OP_ANNULUS_SCALE}, 0.97, 0, 0};
  mvs_op_chord_add added = {
      .op = {sizeof added, MVS_OP_CHORD_ADD}, .head = id_of(MVS_PART_HEAD, "PM1"), .name = "mine"};
  added.site = (mvs_site){MVS_SITE_ANATOMICAL, 0, id_of(MVS_PART_SCALLOP, "P2"), {0.4, 0.8, 0}};
  mvs_op_chord_remove removed = {{sizeof removed, MVS_OP_CHORD_REMOVE},
                                 id_of(MVS_PART_CHORD, "A2/1")};
  MUST(mvs_set_load(sim, &systole));
  steps(sim, solver, 5);
  MUST(mvs_apply_op(sim, &shorter.op, NULL));
  MUST(mvs_set_checkpoint(sim, "one"));
  steps(sim, solver, 5);
  MUST(mvs_begin_group(sim, "both"));
  MUST(mvs_apply_op(sim, &smaller.op, NULL));
  MUST(mvs_apply_op(sim, &added.op, NULL));
  MUST(mvs_end_group(sim));
  steps(sim, solver, 5);
  MUST(mvs_apply_op(sim, &removed.op, NULL));
  MUST(mvs_undo(sim));
  steps(sim, solver, 5);
}

static void the_next_hundred_steps_are_the_same(uint32_t solver, uint32_t format) {
  make_session(solver);
  mvs_sim *other = saved_and_loaded_as(sim, format);
  CHECK(same_hash(sim_hash(sim), sim_hash(other)));
  for (int k = 0; k < 10; ++k) {
    steps(sim, solver, 10);
    steps(other, solver, 10);
    CHECK(same_hash(sim_hash(sim), sim_hash(other)));
  }
  mvs_destroy(other);
}

static void undo_and_redo_go_on_after_loading(void) {
  make_session(MVS_SOLVER_IMPLICIT);
  mvs_sim *other = saved_and_loaded(sim);
  mvs_sim *both[] = {sim, other};
  hash128 seen[2][6];
  for (int k = 0; k < 2; ++k) {
    int n = 0;
    MUST(mvs_redo(both[k]));
    seen[k][n++] = sim_hash(both[k]);
    for (int level = 0; level < 3; ++level) {
      MUST(mvs_undo(both[k]));
      seen[k][n++] = sim_hash(both[k]);
    }
    MUST_FAIL(mvs_undo(both[k]), MVS_E_STATE, "no operation to undo");
    MUST(mvs_restore_checkpoint(both[k], "one"));
    seen[k][n++] = sim_hash(both[k]);
  }
  for (int n = 0; n < 5; ++n) CHECK(same_hash(seen[0][n], seen[1][n]));
  mvs_destroy(other);
}

static void the_history_is_listed_as_before(void) {
  make_session(MVS_SOLVER_IMPLICIT);
  mvs_sim *other = saved_and_loaded(sim);
  const mvs_snapshot *a = present(sim), *b = present(other);
  mvs_history history = {.struct_size = sizeof history}, again = {.struct_size = sizeof again};
  MUST(mvs_snapshot_get_history(a, &history));
  MUST(mvs_snapshot_get_history(b, &again));
  CHECK(history.done == 3 && history.undone == 1 && history.checkpoints == 1);
  CHECK(same_bits(&history, &again, sizeof history));
  for (uint32_t k = 0; k < 4; ++k) {
    mvs_history_entry x = {.struct_size = sizeof x}, y = {.struct_size = sizeof y};
    MUST(mvs_snapshot_get_history_entry(a, k, &x));
    MUST(mvs_snapshot_get_history_entry(b, k, &y));
    CHECK(same_bits(&x, &y, sizeof x));
  }
  const char *name = NULL;
  MUST(mvs_snapshot_get_checkpoint(b, 0, &name));
  CHECK(strcmp(name, "one") == 0);
  mvs_snapshot_release(a);
  mvs_snapshot_release(b);
  mvs_destroy(other);
}

static void a_session_goes_through_paths(void) {
  const char *const paths[] = {"session_test.h5", "session_test.vtkhdf"};
  for (int k = 0; k < 2; ++k) {
    const mvs_snapshot *snapshot = present(sim);
    const hash128 before = sim_hash(sim);
    MUST(mvs_save_file(snapshot, paths[k], MVS_FORMAT_AUTO));
    MUST(generate_founding(sim));
    MUST(mvs_load_file(sim, paths[k], MVS_FORMAT_AUTO));
    CHECK(same_hash(before, sim_hash(sim)));
    MUST(mvs_undo(sim));
    MUST(mvs_restore(sim, snapshot));
    mvs_snapshot_release(snapshot);
    remove(paths[k]);
  }
}

static void a_spoilt_file_changes_nothing(void) {
  uint64_t size = 0;
  char *bytes = saved(sim, MVS_FORMAT_H5, &size);
  const hash128 before = sim_hash(sim);
  const uint32_t h5 = MVS_FORMAT_H5;
  MUST_FAIL(mvs_load_memory(sim, bytes, size - 1, h5), MVS_E_FORMAT, "the file was cut");
  MUST_FAIL(mvs_load_memory(sim, bytes, 100, h5), MVS_E_FORMAT, "the file was cut after 100");
  bytes[size / 2] ^= 1;
  MUST_FAIL(mvs_load_memory(sim, bytes, size, h5), MVS_E_FORMAT, "checksum does not fit");
  MUST_FAIL(mvs_load_memory(sim, "v 0 0 0\n", 8, h5), MVS_E_FORMAT, "not an HDF5 file of libmvs");
  CHECK(same_hash(before, sim_hash(sim)));
  MUST(mvs_undo(sim));
  free(bytes);
}

static void without_hdf5_it_says_so(void) {
  uint64_t size = 0;
  MUST(generate_founding(sim));
  const mvs_snapshot *snapshot = present(sim);
  MUST_FAIL(mvs_save_memory(snapshot, MVS_FORMAT_H5, NULL, 0, &size), MVS_E_UNSUPPORTED,
            "built without HDF5");
  MUST_FAIL(mvs_load_memory(sim, "x", 1, MVS_FORMAT_H5), MVS_E_UNSUPPORTED, "built without HDF5");
  mvs_snapshot_release(snapshot);
}

int main(void) {
  MUST(mvs_create(NULL, &sim));
  if (strstr(mvs_features(), "hdf5")) {
    the_next_hundred_steps_are_the_same(MVS_SOLVER_IMPLICIT, MVS_FORMAT_H5);
    the_next_hundred_steps_are_the_same(MVS_SOLVER_IMPLICIT, MVS_FORMAT_OBJ);
    the_next_hundred_steps_are_the_same(MVS_SOLVER_EXPLICIT, MVS_FORMAT_H5);
    undo_and_redo_go_on_after_loading();
    the_history_is_listed_as_before();
    a_session_goes_through_paths();
    a_spoilt_file_changes_nothing();
  } else {
    without_hdf5_it_says_so();
  }
  mvs_destroy(sim);
  return finish("session");
}
