// short_run(): MVS_TEST_SHORT asks tests that repeat one check many times to repeat it less often.
// CI sets it for the sanitizers, since the release build has run every repetition.
#ifndef MVS_TESTS_SHORT_RUN_H
#define MVS_TESTS_SHORT_RUN_H

#include <cstdlib>

inline bool short_run() {
  const char *asked = std::getenv("MVS_TEST_SHORT");
  return asked != nullptr && *asked != 0;
}

#endif
