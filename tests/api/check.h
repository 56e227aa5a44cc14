/* Checks of the tests in C: a failed check prints its expression and is counted. */
#ifndef TESTS_CHECK_H
#define TESTS_CHECK_H

#include <mvs/experimental.h>
#include <mvs/mvs.h>
#include <stdio.h>
#include <string.h>

static int failures = 0;

#define CHECK(condition)                                             \
  do {                                                               \
    if (!(condition)) {                                              \
      ++failures;                                                    \
      printf("%s:%d: not so: %s\n", __FILE__, __LINE__, #condition); \
    }                                                                \
  } while (0)

/* The call succeeds. */
#define MUST(call)                                                                           \
  do {                                                                                       \
    mvs_result result_ = (call);                                                             \
    if (result_ != MVS_OK) {                                                                 \
      ++failures;                                                                            \
      printf("%s:%d: %s gave %s: %s\n", __FILE__, __LINE__, #call, mvs_result_name(result_), \
             mvs_last_error()->message);                                                     \
    }                                                                                        \
  } while (0)

/* The call fails with this code and a sentence that contains `word`. */
#define MUST_FAIL(call, wanted, word)                                                            \
  do {                                                                                           \
    mvs_result result_ = (call);                                                                 \
    const mvs_error *error_ = mvs_last_error();                                                  \
    if (result_ != (wanted) || error_->code != (wanted) || !strstr(error_->message, (word))) {   \
      ++failures;                                                                                \
      printf("%s:%d: %s gave %s, part \"%s\": %s\n  wanted %s and \"%s\"\n", __FILE__, __LINE__, \
             #call, mvs_result_name(result_), error_->part, error_->message, #wanted, (word));   \
    }                                                                                            \
  } while (0)

static inline int finish(const char *name) {
  printf("%s: %s\n", name, failures ? "FAILED" : "ok");
  return failures ? 1 : 0;
}

/* The hash of the simulator's present state; zeros before it holds a valve. */
typedef struct hash128 {
  uint64_t word[2];
} hash128;

static inline hash128 snapshot_hash(const mvs_snapshot *snapshot) {
  hash128 hash = {{0, 0}};
  CHECK(mvs_snapshot_get_hash(snapshot, hash.word) == MVS_OK);
  return hash;
}

static inline hash128 sim_hash(mvs_sim *sim) {
  hash128 hash = {{0, 0}};
  const mvs_snapshot *snapshot = NULL;
  if (mvs_get_snapshot(sim, &snapshot) != MVS_OK) return hash;
  hash = snapshot_hash(snapshot);
  mvs_snapshot_release(snapshot);
  return hash;
}

static inline int same_hash(hash128 a, hash128 b) {
  return a.word[0] == b.word[0] && a.word[1] == b.word[1];
}

/* Whether two blocks hold the same bits: -0.0 differs from 0.0. Empty ones may be null. */
static inline int same_bits(const void *a, const void *b, size_t size) {
  return size == 0 || memcmp(a, b, size) == 0;
}

#endif
