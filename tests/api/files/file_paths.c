/* Paths of files: links, endings, long paths, a byte order mark, a format taken for another. */
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/api/check.h"
#include "tests/api/funnel.h"

static mvs_sim *sim;
static const mvs_snapshot *snapshot;

static int is_link(const char *path) {
  struct stat found;
  return lstat(path, &found) == 0 && S_ISLNK(found.st_mode);
}

static void make_link(const char *target, const char *path) {
  remove(path);
  CHECK(symlink(target, path) == 0);
}

static void links_to_new_files_stay_and_their_target_is_written(void) {
  const hash128 saved = snapshot_hash(snapshot);
  remove("file_paths.folder/new.obj");
  rmdir("file_paths.folder");
  CHECK(mkdir("file_paths.folder", 0755) == 0);
  make_link("file_paths.folder/second.obj", "file_paths.link.obj");
  make_link("new.obj", "file_paths.folder/second.obj");
  MUST(mvs_save_file(snapshot, "file_paths.link.obj", MVS_FORMAT_AUTO));
  CHECK(is_link("file_paths.link.obj") && is_link("file_paths.folder/second.obj"));
  MUST(mvs_load_file(sim, "file_paths.folder/new.obj", MVS_FORMAT_AUTO));
  CHECK(same_hash(saved, sim_hash(sim)));
  make_link("no/such/folder.obj", "file_paths.link.obj");
  MUST_FAIL(mvs_save_file(snapshot, "file_paths.link.obj", MVS_FORMAT_AUTO), MVS_E_IO,
            "create the folder first");
  CHECK(is_link("file_paths.link.obj"));
  remove("file_paths.folder/new.obj");
  remove("file_paths.folder/second.obj");
  remove("file_paths.folder");
  remove("file_paths.link.obj");
}

static void links_in_a_circle_are_an_error_and_stay(void) {
  make_link("file_paths.a.obj", "file_paths.b.obj");
  make_link("file_paths.b.obj", "file_paths.a.obj");
  make_link("file_paths.self.obj", "file_paths.self.obj");
  MUST_FAIL(mvs_save_file(snapshot, "file_paths.a.obj", 0), MVS_E_IO, "leads back to itself");
  MUST_FAIL(mvs_save_file(snapshot, "file_paths.self.obj", 0), MVS_E_IO, "leads back to itself");
  CHECK(is_link("file_paths.a.obj") && is_link("file_paths.b.obj"));
  CHECK(is_link("file_paths.self.obj"));
  remove("file_paths.a.obj");
  remove("file_paths.b.obj");
  remove("file_paths.self.obj");
}

static void endings_may_be_in_capital_letters(void) {
  const hash128 saved = snapshot_hash(snapshot);
  MUST(mvs_save_file(snapshot, "file_paths.OBJ", MVS_FORMAT_AUTO));
  MUST(mvs_load_file(sim, "file_paths.OBJ", MVS_FORMAT_AUTO));
  CHECK(same_hash(saved, sim_hash(sim)));
  remove("file_paths.OBJ");
  if (!strstr(mvs_features(), "hdf5")) return;
  MUST(mvs_save_file(snapshot, "file_paths.H5", MVS_FORMAT_AUTO));
  MUST(mvs_load_file(sim, "file_paths.H5", MVS_FORMAT_AUTO));
  CHECK(same_hash(saved, sim_hash(sim)));
  MUST_FAIL(mvs_load_file(sim, "file_paths.H5", MVS_FORMAT_OBJ), MVS_E_FORMAT, "is HDF5, not OBJ");
  remove("file_paths.H5");
}

static int count_of(const char *text, const char *word) {
  int count = 0;
  for (const char *at = text; (at = strstr(at, word)) != NULL; ++at) ++count;
  return count;
}

static void the_path_stands_once_and_the_reason_at_the_end(void) {
  char path[400];
  MUST_FAIL(mvs_load_file(sim, "no/such/valve.obj", 0), MVS_E_IO, "cannot open it: No such file");
  CHECK(count_of(mvs_last_error()->message, "valve.obj") == 1);
  for (size_t length = 100; length < sizeof path; length += 49) {
    memset(path, 'd', length);
    path[2] = '/';
    memcpy(path + length - 10, "/last.obj", 10);
    MUST_FAIL(mvs_load_file(sim, path, 0), MVS_E_IO, "No such file or directory");
    CHECK(strstr(mvs_last_error()->message, "last.obj: ") != NULL);
    CHECK(count_of(mvs_last_error()->message, "last.obj") == 1);
    MUST_FAIL(mvs_save_file(snapshot, path, 0), MVS_E_IO, "create the folder first");
  }
}

static void a_byte_order_mark_is_skipped(void) {
  static const unsigned char mark[] = {0xef, 0xbb, 0xbf};
  uint64_t size = 0;
  MUST(mvs_save_memory(snapshot, MVS_FORMAT_OBJ, NULL, 0, &size));
  char *text = malloc(size + 3);
  if (!text) exit(2);
  memcpy(text, mark, sizeof mark);
  MUST(mvs_save_memory(snapshot, MVS_FORMAT_OBJ, text + 3, size, &size));
  MUST(mvs_load_memory(sim, text, size + 3, MVS_FORMAT_OBJ));
  CHECK(same_hash(snapshot_hash(snapshot), sim_hash(sim)));
  free(text);
}

int main(void) {
  static funnel f;
  make_funnel(&f);
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_set_valve(sim, &f.desc));
  MUST(mvs_get_snapshot(sim, &snapshot));
  links_to_new_files_stay_and_their_target_is_written();
  links_in_a_circle_are_an_error_and_stay();
  endings_may_be_in_capital_letters();
  the_path_stands_once_and_the_reason_at_the_end();
  a_byte_order_mark_is_skipped();
  mvs_snapshot_release(snapshot);
  mvs_destroy(sim);
  return finish("file_paths");
}
