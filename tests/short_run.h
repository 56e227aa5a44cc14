// For tests that repeat one thing: whether less will do (MVS_TEST_SHORT), as it does under the
// sanitizers in CI, where the release build has repeated it in full.
#ifndef MVS_TESTS_SHORT_RUN_H
#define MVS_TESTS_SHORT_RUN_H

#include <cstdlib>

inline bool short_run() {
  const char *asked = std::getenv("MVS_TEST_SHORT");
  return asked != nullptr && *asked != 0;
}

#endif
