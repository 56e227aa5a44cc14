/* The present snapshot of a simulator, and a simulator that was saved to memory and loaded. */
#ifndef TESTS_SAVED_H
#define TESTS_SAVED_H

#include <stdlib.h>

#include "check.h"

static inline const mvs_snapshot *present(mvs_sim *of) {
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_get_snapshot(of, &snapshot));
  return snapshot;
}

static inline mvs_sim *saved_and_loaded(mvs_sim *of, uint32_t format) {
  uint64_t size = 0;
  mvs_sim *other = NULL;
  const mvs_snapshot *snapshot = present(of);
  MUST(mvs_save_memory(snapshot, format, NULL, 0, &size));
  char *bytes = malloc(size);
  if (!bytes) exit(2);
  MUST(mvs_save_memory(snapshot, format, bytes, size, &size));
  MUST(mvs_create(NULL, &other));
  MUST(mvs_load_memory(other, bytes, size, format));
  mvs_snapshot_release(snapshot);
  free(bytes);
  return other;
}

#endif
