// short_run(): MVS_TEST_SHORT asks tests that repeat one check many times to repeat it less often.
// CI sets it for the sanitizers, since the release build has run every repetition. long_run():
// MVS_TEST_LONG asks for the cases that only the long gate has time for.
#ifndef MVS_TESTS_SHORT_RUN_H
#define MVS_TESTS_SHORT_RUN_H

#include <cstdlib>

inline bool is_asked_for(const char *variable) {
  const char *asked = std::getenv(variable);
  return asked != nullptr && *asked != 0;
}

inline bool short_run() {
  return is_asked_for("MVS_TEST_SHORT");
}

inline bool long_run() {
  return is_asked_for("MVS_TEST_LONG");
}

#endif
