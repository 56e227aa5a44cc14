/* What every other header stands on: export macro, results, errors, ids and array descriptions.
 *
 * Units are SI everywhere (m, kg, s, N, Pa, rad). Text is UTF-8. A pointer must not be null unless
 * its function says nullable; null gives MVS_E_ARGUMENT, never a crash.
 *
 * Structs that may grow start with `struct_size`, set by the caller to sizeof the struct, for input
 * and output alike; they grow only at their end. Of an input, a field left zero takes its default,
 * and what an older program does not have counts as zero; what a newer program sets and this
 * library does not know gives MVS_E_VERSION. An output is filled as far as the caller's reaches.
 * Fields named `reserved` must be zero.
 *
 * Callbacks of the host run on the thread of the call that they belong to; they must return, not
 * throw or jump out. */
#ifndef MVS_BASE_H
#define MVS_BASE_H

#include <stdint.h>

#define MVS_VERSION_MAJOR 0
#define MVS_VERSION_MINOR 1
#define MVS_VERSION_PATCH 0

#if defined(_WIN32) && defined(MVS_BUILDING)
#define MVS_API __declspec(dllexport)
#elif defined(_WIN32)
#define MVS_API __declspec(dllimport)
#elif defined(__GNUC__)
#define MVS_API __attribute__((visibility("default")))
#else
#define MVS_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* What a fallible function returns: MVS_OK, or a negative code; the sentence is in
 * mvs_last_error(). After a failure the simulator is bit for bit as before the call, and outputs
 * are as the caller left them. */
typedef int32_t mvs_result;
enum mvs_result_e {
  MVS_OK = 0,
  MVS_E_ARGUMENT = -1,     /* a null pointer, a size, a range: the caller's value is wrong */
  MVS_E_ID = -2,           /* no part of the valve has this id, or it is of another kind */
  MVS_E_STATE = -3,        /* the call does not fit the simulator's state, e.g. no valve yet */
  MVS_E_OP = -4,           /* a surgical operation, or a valve, that cannot be */
  MVS_E_DIVERGED = -5,     /* the numbers left the range in which they mean something */
  MVS_E_FORMAT = -6,       /* a file that is not what it should be; the error has its line */
  MVS_E_VERSION = -7,      /* a file, struct or driver of a version this library does not know */
  MVS_E_IO = -8,           /* the operating system refused to read or write */
  MVS_E_DEVICE = -9,       /* a haptic device or its driver */
  MVS_E_MEMORY = -10,      /* out of memory, or above a stated limit */
  MVS_E_UNSUPPORTED = -11, /* this build lacks the part asked for */
  MVS_E_INTERNAL = -12,    /* a fault of the library itself: please report it */
  MVS_E_CANCELLED = -13    /* the progress callback asked to stop */
};

/* A failure in words. Texts end with a zero byte and are cut to fit. */
typedef struct mvs_error {
  mvs_result code;
  int32_t line;      /* 1-based line of the file being read, 0 if there is none */
  char part[64];     /* the part it is about ("triangle 17", "chord P2/3"), or "" */
  char message[432]; /* one sentence: what is wrong, and what to do */
} mvs_error;

/* The last failure on the calling thread, of any simulator; a success leaves it as it is. Valid
 * until the thread's next failing call or end. Never null: before any failure its code is MVS_OK.
 */
MVS_API const mvs_error *mvs_last_error(void);

/* The name of a result code, "MVS_E_FORMAT"; "MVS_E_UNKNOWN" for a number that is none. Static. */
MVS_API const char *mvs_result_name(mvs_result code);

/* The version of the library in use, 10000 * major + 100 * minor + patch. */
MVS_API uint32_t mvs_version(void);

/* The names of the optional parts this build has, separated by spaces: "cholmod hdf5". Static. */
MVS_API const char *mvs_features(void);

/* Names a part of the valve for its whole life: survives undo, save and load. Zero is none. */
typedef uint64_t mvs_id;

/* Element types of arrays. */
enum mvs_type_e {
  MVS_TYPE_F64 = 1,
  MVS_TYPE_F32 = 2,
  MVS_TYPE_U32 = 3,
  MVS_TYPE_U64 = 4,
  MVS_TYPE_U8 = 5
};
typedef uint32_t mvs_type;

/* An array of the caller: `count` elements of `components` values of `type`, the elements
 * `stride` bytes apart (0: packed), at any alignment. All zero: not given. Read during the call
 * only. */
typedef struct mvs_array {
  const void *data;
  uint64_t count;
  uint32_t components;
  uint32_t type;
  uint64_t stride;
} mvs_array;

/* An array of the library, read-only, packed (`stride` says how far apart elements are, for those
 * who want it); valid while its snapshot is held. `data` may be null where `count` is 0. */
typedef struct mvs_view {
  const void *data;
  uint64_t count;
  uint32_t components;
  uint32_t type;
  uint64_t stride;
} mvs_view;

#ifdef __cplusplus
}
#endif
#endif
