/* The number of tools of a simulator. */
#ifndef TESTS_TOOL_COUNT_H
#define TESTS_TOOL_COUNT_H

#include "tests/api/check.h"

static inline uint32_t tool_count(mvs_sim *of) {
  const mvs_snapshot *snapshot = NULL;
  uint32_t count = 0;
  MUST(mvs_get_snapshot(of, &snapshot));
  MUST(mvs_snapshot_get_tool_count(snapshot, &count));
  mvs_snapshot_release(snapshot);
  return count;
}

#endif
