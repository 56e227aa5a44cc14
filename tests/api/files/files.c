/* Loading and saving through memory and through paths. */
#include <dirent.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/api/check.h"
#include "tests/api/funnel.h"
#include "tests/founding.h"

static mvs_sim *sim;

static const mvs_snapshot *present(mvs_sim *of) {
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_get_snapshot(of, &snapshot));
  return snapshot;
}

static char *save(const mvs_snapshot *snapshot, uint32_t format, uint64_t *size) {
  uint64_t again = 0;
  MUST(mvs_save_memory(snapshot, format, NULL, 0, size));
  char *bytes = malloc(*size + 1);
  if (!bytes) exit(2);
  bytes[*size] = 0x55;
  MUST(mvs_save_memory(snapshot, format, bytes, *size, &again));
  CHECK(again == *size && bytes[*size] == 0x55);
  return bytes;
}

static void saved_and_loaded_settles_to_the_same_bits(void) {
  mvs_load_case load = funnel_load();
  MUST(mvs_set_load(sim, &load));
  MUST(mvs_step(sim, NULL)); /* so that velocity and time are saved as well */
  const mvs_snapshot *start = present(sim);
  uint64_t size = 0;
  char *bytes = save(start, MVS_FORMAT_OBJ, &size);
  mvs_sim *other = NULL;
  MUST(mvs_create(NULL, &other));
  MUST(mvs_load_memory(other, bytes, size, MVS_FORMAT_AUTO));
  CHECK(same_hash(sim_hash(sim), sim_hash(other)));
  MUST(mvs_settle(sim, NULL, NULL));
  MUST(mvs_settle(other, NULL, NULL));
  CHECK(same_hash(sim_hash(sim), sim_hash(other)));
  MUST(mvs_restore(sim, start));
  mvs_snapshot_release(start);
  mvs_destroy(other);
  free(bytes);
}

static void a_file_comes_back_the_same(void) {
  const mvs_snapshot *snapshot = present(sim);
  hash128 before = snapshot_hash(snapshot);
  MUST(mvs_save_file(snapshot, "files_test.obj", MVS_FORMAT_AUTO));
  MUST(generate_founding(sim));
  MUST(mvs_load_file(sim, "files_test.obj", MVS_FORMAT_AUTO));
  CHECK(same_hash(before, sim_hash(sim)));
  MUST(mvs_save_file(snapshot, "files_test.other", MVS_FORMAT_OBJ));
  MUST(mvs_load_file(sim, "files_test.other", MVS_FORMAT_OBJ));
  CHECK(same_hash(before, sim_hash(sim)));
  remove("files_test.obj");
  remove("files_test.other");
  mvs_snapshot_release(snapshot);
}

static void vtp_is_written_with_results(void) {
  const mvs_snapshot *snapshot = present(sim);
  uint64_t size = 0;
  char *bytes = save(snapshot, MVS_FORMAT_VTP, &size);
  bytes[size] = 0;
  CHECK(strstr(bytes, "<VTKFile") != NULL);
  free(bytes);
  MUST(mvs_save_file(snapshot, "files_test.vtp", MVS_FORMAT_AUTO));
  remove("files_test.vtp");
  mvs_snapshot_release(snapshot);
}

/* The index of a VTM dataset names files that are there; a path of another ending is refused. */
static void vtm_is_an_index_of_its_blocks(void) {
  const mvs_snapshot *snapshot = present(sim);
  uint64_t size = 0;
  char index[2000] = "";
  MUST(mvs_save_file(snapshot, "files_test.vtm", MVS_FORMAT_AUTO));
  MUST(mvs_save_file(snapshot, "files_test.vtm", MVS_FORMAT_VTM)); /* over the old one */
  FILE *file = fopen("files_test.vtm", "rb");
  CHECK(file && fread(index, 1, sizeof index - 1, file) > 0);
  if (file) fclose(file);
  int blocks = 0;
  for (char *at = index; (at = strstr(at, "file=\"")) != NULL; ++blocks) {
    at += strlen("file=\"");
    const size_t length = strcspn(at, "\"");
    char path[200];
    snprintf(path, sizeof path, "%.*s", (int)length, at);
    CHECK(strncmp(path, "files_test/", 11) == 0);
    CHECK(remove(path) == 0);
  }
  CHECK(blocks >= 1);
  remove("files_test.vtm");
  CHECK(remove("files_test") == 0);
  MUST_FAIL(mvs_save_file(snapshot, "files_test.txt", MVS_FORMAT_VTM), MVS_E_ARGUMENT, "NAME.vtm");
  CHECK(mkdir("files_test.vtm", 0777) == 0);
  MUST_FAIL(mvs_save_file(snapshot, "files_test.vtm", MVS_FORMAT_AUTO), MVS_E_IO, "directory");
  CHECK(remove("files_test.vtm") == 0);
  CHECK(remove("files_test") != 0); /* the folder of the blocks is not there */
  MUST_FAIL(mvs_save_file(snapshot, "no/such/files_test.vtm", MVS_FORMAT_AUTO), MVS_E_IO,
            "no/such/files_test");
  MUST_FAIL(mvs_save_memory(snapshot, MVS_FORMAT_VTM, NULL, 0, &size), MVS_E_UNSUPPORTED,
            "several files");
  MUST_FAIL(mvs_load_memory(sim, "x", 1, MVS_FORMAT_VTM), MVS_E_UNSUPPORTED, "not read");
  mvs_snapshot_release(snapshot);
}

static void refused_files_name_themselves_and_change_nothing(void) {
  hash128 before = sim_hash(sim);
  const mvs_snapshot *snapshot = present(sim);
  char path[400];
  uint64_t size = 0;
  MUST_FAIL(mvs_load_file(sim, "no/such/file.obj", 0), MVS_E_IO, "no/such/file.obj: ");
  MUST_FAIL(mvs_load_file(sim, "", 0), MVS_E_ARGUMENT, "path is empty");
  MUST_FAIL(mvs_load_file(sim, "valve.stl", 0), MVS_E_ARGUMENT,
            ".obj, .h5, .vtkhdf, .vtp, .vtm, .inp and .feb");
  MUST_FAIL(mvs_load_file(sim, "obj", 0), MVS_E_ARGUMENT,
            ".obj, .h5, .vtkhdf, .vtp, .vtm, .inp and .feb");
  MUST_FAIL(mvs_load_file(sim, "valve.obj", 7), MVS_E_ARGUMENT, "format is 7");
  MUST_FAIL(mvs_load_memory(sim, "x", 1, 7), MVS_E_ARGUMENT, "format is 7");
  MUST_FAIL(mvs_load_memory(sim, "x", 1, MVS_FORMAT_VTP), MVS_E_UNSUPPORTED, "not read");
  MUST_FAIL(mvs_load_memory(sim, "x", 1, MVS_FORMAT_FEB), MVS_E_UNSUPPORTED, "not read");
  MUST_FAIL(mvs_load_memory(sim, "x", 1, MVS_FORMAT_INP), MVS_E_FORMAT, "before the first keyword");
  CHECK(mvs_last_error()->line == 1);
  MUST_FAIL(mvs_save_memory(snapshot, MVS_FORMAT_INP, NULL, 0, &size), MVS_E_UNSUPPORTED,
            "read, not written");
  MUST_FAIL(mvs_save_memory(snapshot, MVS_FORMAT_FEB, NULL, 0, &size), MVS_E_UNSUPPORTED,
            "net of springs");
  MUST_FAIL(mvs_load_memory(sim, "what is this", 12, 0), MVS_E_FORMAT, "");
  MUST_FAIL(mvs_load_memory(sim, "", 0, 0), MVS_E_FORMAT, "");
  MUST_FAIL(mvs_save_file(snapshot, "no/such/folder/a.obj", 0), MVS_E_IO, "no/such/folder/a.obj");
  MUST_FAIL(mvs_save_file(snapshot, "a.stl", 0), MVS_E_ARGUMENT,
            ".obj, .h5, .vtkhdf, .vtp, .vtm and .feb");
  MUST_FAIL(mvs_save_memory(snapshot, 9, NULL, 0, &size), MVS_E_ARGUMENT, "format is 9");
  /* a long path is abbreviated in its middle, so that the reason remains */
  memset(path, 'd', sizeof path);
  memcpy(path + sizeof path - 10, "/last.obj", 10);
  MUST_FAIL(mvs_load_file(sim, path, 0), MVS_E_IO, "/last.obj: ");
  FILE *file = fopen("files_test.bad.obj", "w");
  if (!file) exit(2);
  fputs("# a comment\nv 1 2 3\nv what\n", file);
  fclose(file);
  MUST_FAIL(mvs_load_file(sim, "files_test.bad.obj", 0), MVS_E_FORMAT, "files_test.bad.obj:");
  CHECK(mvs_last_error()->line > 0);
  remove("files_test.bad.obj");
  CHECK(same_hash(before, sim_hash(sim)));
  mvs_snapshot_release(snapshot);
}

static int entries_of(const char *folder) {
  DIR *const open = opendir(folder);
  int count = -2; /* the folder itself and its parent */
  if (!open) return -1;
  while (readdir(open)) ++count;
  closedir(open);
  return count;
}

static void make_folder(const char *path, mode_t mode) {
  if (mkdir(path, 0755) != 0 || chmod(path, mode) != 0) exit(2);
}

/* Root may write anywhere, so that it becomes another user while it saves. */
static void save_must_fail(const mvs_snapshot *snapshot, const char *path, const char *words) {
  const int is_root = geteuid() == 0;
  if (is_root && seteuid(65534) != 0) exit(2);
  MUST_FAIL(mvs_save_file(snapshot, path, MVS_FORMAT_OBJ), MVS_E_IO, words);
  CHECK(strncmp(mvs_last_error()->message, path, strlen(path)) == 0);
  if (is_root && seteuid(0) != 0) exit(2);
}

static void a_target_that_cannot_be_replaced_is_an_io_error_with_a_remedy(void) {
  const mvs_snapshot *snapshot = present(sim);
  FILE *old;
  /* of an earlier run that was stopped */
  remove("files_test.sticky/a.obj");
  rmdir("files_test.folder.obj");
  rmdir("files_test.closed");
  rmdir("files_test.sticky");
  make_folder("files_test.folder.obj", 0755);
  save_must_fail(snapshot, "files_test.folder.obj", "give the name of a file");
  CHECK(entries_of("files_test.folder.obj") == 0);
  make_folder("files_test.closed", 0555);
  save_must_fail(snapshot, "files_test.closed/a.obj", "choose another folder");
  CHECK(entries_of("files_test.closed") == 0);
  save_must_fail(snapshot, "files_test.none/a.obj", "create the folder first");
  /* a file of root's in a sticky folder may be written, but not replaced, by other users */
  make_folder("files_test.sticky", 01777);
  old = fopen("files_test.sticky/a.obj", "w");
  if (!old || fclose(old) != 0 || chmod("files_test.sticky/a.obj", 0666) != 0) exit(2);
  if (geteuid() == 0) {
    save_must_fail(snapshot, "files_test.sticky/a.obj", "cannot replace");
    save_must_fail(snapshot, "files_test.sticky/a.obj", "choose another folder");
  }
  CHECK(entries_of("files_test.sticky") == 1);
  remove("files_test.sticky/a.obj");
  rmdir("files_test.sticky");
  rmdir("files_test.closed");
  rmdir("files_test.folder.obj");
  mvs_snapshot_release(snapshot);
}

static void a_solver_cache_of_another_version_is_refused(void) {
  const mvs_snapshot *snapshot = present(sim);
  const hash128 before = snapshot_hash(snapshot);
  const char *const line = "#mvs solver_cache version=";
  uint64_t size = 0;
  char *text = save(snapshot, MVS_FORMAT_OBJ, &size);
  text[size] = 0;
  char *at = strstr(text, line);
  CHECK(at != NULL);
  if (at) at[strlen(line)] = '7';
  MUST_FAIL(mvs_load_memory(sim, text, size, 0), MVS_E_VERSION, "solver cache");
  CHECK(same_hash(before, sim_hash(sim)));
  free(text);
  mvs_snapshot_release(snapshot);
}

int main(void) {
  static funnel f;
  make_funnel(&f);
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_set_valve(sim, &f.desc));
  saved_and_loaded_settles_to_the_same_bits();
  a_solver_cache_of_another_version_is_refused();
  a_file_comes_back_the_same();
  vtp_is_written_with_results();
  vtm_is_an_index_of_its_blocks();
  refused_files_name_themselves_and_change_nothing();
  a_target_that_cannot_be_replaced_is_an_io_error_with_a_remedy();
  mvs_destroy(sim);
  return finish("files");
}
