/* Conventions and basic types of all headers: export macro, results, errors, ids, arrays.
 *
 * Units are SI (m, kg, s, N, Pa, rad). Text is UTF-8: a name with other bytes is refused, by the
 * call with the code of its other faults, from a file with MVS_E_FORMAT. Pointers must not be null
 * unless the function says nullable; a null pointer gives MVS_E_ARGUMENT, never a crash.
 *
 * Structs that may grow start with `struct_size`, which the caller sets to sizeof the struct, for
 * input and output alike. They grow only at their end. Fields that an older program does not have
 * count as zero. A newer program that sets a field unknown to this library gets MVS_E_VERSION. An
 * output is filled as far as the caller's struct extends. Structs that are elements of a caller's
 * array have no struct_size: their stride in bytes is given beside the array, sizeof the struct,
 * and the same rules hold for each element.
 *
 * One way to leave a field out: zero. A zero field takes the default in brackets. Where zero is
 * itself a value, a flag states it. Fields named `reserved` must be zero.
 *
 * One way to enumerate: a count, and a get function with an index from 0 to count - 1. Functions
 * that search or check (mvs_check_valve, mvs_device_list, mvs_device_doctor) report their findings
 * through a callback while they run.
 *
 * One way to return arrays: stored arrays as a mvs_view, zero-copy; computed arrays as (data,
 * capacity, &count): the function writes at most `capacity` elements and stores the number that
 * exists in *count. `data` is nullable if `capacity` is 0.
 *
 * Enumerations are named enum mvs_x_e with a typedef mvs_x of fixed width for fields and
 * parameters. Callbacks run on the thread of the call that they belong to. They must return, not
 * throw or longjmp. */
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

/* The result of a function that can fail: MVS_OK or a negative code; mvs_last_error() returns the
 * sentence. After a failure the simulator is bit for bit as before the call and outputs are
 * unchanged. */
enum mvs_result_e {
  MVS_OK = 0,
  MVS_E_ARGUMENT = -1,     /* a null pointer, or a value out of its range */
  MVS_E_ID = -2,           /* the valve has no part of this kind with this id */
  MVS_E_STATE = -3,        /* the simulator's state forbids the call, e.g. no valve is set */
  MVS_E_OP = -4,           /* an impossible surgical operation, or an invalid valve or tissue */
  MVS_E_DIVERGED = -5,     /* the solution diverged: numbers left their valid range */
  MVS_E_FORMAT = -6,       /* a malformed file; mvs_error.line is the line */
  MVS_E_VERSION = -7,      /* a file, struct or driver of a version this library does not know */
  MVS_E_IO = -8,           /* the operating system refused to read or write */
  MVS_E_DEVICE = -9,       /* a haptic device or its driver failed */
  MVS_E_MEMORY = -10,      /* out of memory, or above a stated limit */
  MVS_E_UNSUPPORTED = -11, /* this build, solver or file format lacks the requested part */
  MVS_E_INTERNAL = -12,    /* a defect of the library: please report it */
  MVS_E_CANCELLED = -13    /* the progress callback cancelled the call */
};
typedef int32_t mvs_result;

/* A failure in words. Texts are zero-terminated and truncated to fit. */
typedef struct mvs_error {
  mvs_result code;
  int32_t line;      /* 1-based line of the file being read, 0 without a file */
  char part[64];     /* the part concerned ("triangle 17", "chord P2/3"), or "" */
  char message[432]; /* one sentence: the fault and the remedy */
} mvs_error;

/* Returns the last failure on the calling thread, of any simulator; a success does not change it.
 * Valid until the thread's next failing call or its end. Never null: before any failure the code is
 * MVS_OK. */
MVS_API const mvs_error *mvs_last_error(void);

/* Returns the name of a result code, "MVS_E_FORMAT"; "MVS_E_UNKNOWN" for an undefined number.
 * Static. */
MVS_API const char *mvs_result_name(mvs_result code);

/* Returns the version of the loaded library, 10000 * major + 100 * minor + patch. */
MVS_API uint32_t mvs_version(void);

/* Returns the backends (mvs_sim_desc.backend) and the optional parts of this build, separated by
 * spaces: "block cholmod eigen hdf5 zlib haptics". Static. */
MVS_API const char *mvs_features(void);

/* Identifies a part of the valve across undo, save and load. Zero: no part. */
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

/* An array of the caller: `count` elements of `components` values of `type`, `stride` bytes apart
 * (0: packed), at any alignment. All zero: left out. Read during the call only. */
typedef struct mvs_array {
  const void *data;
  uint64_t count;
  uint32_t components;
  mvs_type type;
  uint64_t stride;
} mvs_array;

/* A read-only array of the library; `stride` is the distance of elements in bytes. Valid while its
 * owner (snapshot or ensemble) is held. `data` may be null where `count` is 0. */
typedef struct mvs_view {
  const void *data;
  uint64_t count;
  uint32_t components;
  mvs_type type;
  uint64_t stride;
} mvs_view;

/* Types of described fields; those from CHORD on belong to operations (op.h). */
enum mvs_field_type_e {
  MVS_FIELD_NUMBER = 1,  /* double */
  MVS_FIELD_COUNT = 2,   /* uint32_t */
  MVS_FIELD_CHOICE = 3,  /* uint32_t, one of `choices` */
  MVS_FIELD_CHORD = 4,   /* mvs_id */
  MVS_FIELD_HEAD = 5,    /* mvs_id */
  MVS_FIELD_SCALLOP = 6, /* mvs_id */
  MVS_FIELD_SITE = 7,    /* mvs_site */
  MVS_FIELD_POINT = 8,   /* mvs_point */
  MVS_FIELD_VECTOR = 9,  /* double[3] */
  MVS_FIELD_POINTS = 10, /* mvs_array, F64, k x 3 */
  MVS_FIELD_TEXT = 11    /* const char * */
};
typedef uint32_t mvs_field_type;

/* Description of a field of a struct, for bindings, dialogs and scripts. Texts are static. */
typedef struct mvs_field_info {
  uint32_t struct_size;
  mvs_field_type type; /* MVS_FIELD_* */
  uint32_t offset;     /* bytes into the struct */
  uint32_t required;   /* 1: it has no default */
  double low, high;    /* range of numbers and counts other than 0, in SI units */
  const char *name;
  const char *label; /* for people: "Coaptation area" */
  const char *unit;  /* "m", "Pa", "m2", or "" */
  const char *help;
  const char *choices; /* "none=0 leaflet=1 head=2", or "" */
  /* The meaning of a zero or empty field of an operation: "40e6", "as taut as its neighbours"; ""
   * if it has none. The same as a number in SI units, or of a choice; NaN if it is not fixed. */
  const char *default_text;
  double default_value;
  const char *group_name; /* of a measure: the word of its group, "coaptation"; "" without one */
  uint32_t group;         /* of a measure: MVS_MEASURE_GROUP_*; 0: not in a group */
  uint32_t reserved;
} mvs_field_info;

/* Structs of results whose fields the library describes. */
enum mvs_struct_e {
  MVS_STRUCT_MEASURES = 1, /* mvs_measures */
  MVS_STRUCT_STATS = 2,    /* mvs_stats */
  MVS_STRUCT_PROFILE = 3,  /* mvs_profile; fields of its array phase_s are listed one by one */
  MVS_STRUCT_COST = 4      /* mvs_cost */
};
typedef uint32_t mvs_struct;

/* Fields of a struct of results in the order of the struct. Offset and type of a field are enough
 * to read it: MVS_FIELD_NUMBER is a double, MVS_FIELD_COUNT a uint32_t. The count is 0 for an
 * unknown struct. */
MVS_API uint32_t mvs_get_field_count(mvs_struct which);
MVS_API mvs_result mvs_get_field(mvs_struct which, uint32_t index, mvs_field_info *field);

#ifdef __cplusplus
}
#endif
#endif
