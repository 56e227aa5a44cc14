/* A haptic device for libmvs: everything that the author of a driver needs.
 *
 * A driver is a shared library that includes only this header and exports one symbol,
 * mvs_driver_negotiate. It says where the hand is and hands a force to the motors; nothing more.
 * What the force is, and whether it is safe (finite, clamped, ramped, faded, latched), is decided
 * by libmvs for every device alike: a driver passes on what it is given, at once, and zero when it
 * is told so. Begin with a copy of haptic_drivers/template.
 *
 * Units are SI (m, m/s, N, N m, rad, s) along the device's own axes, right-handed; mvs_driver_info
 * says how these lie. Structs start with `struct_size`: who fills a struct writes no further than
 * that, and who reads it takes what is not there as zero. They grow only at their end.
 *
 * A function returns MVS_DRIVER_OK or one of MVS_DRIVER_E_*; error() then has a sentence that says
 * what is wrong and what to do. Functions that are called at the device's rate (read, write, and
 * what run() does between two calls of the servo) take no lock, allocate nothing, and wait for
 * nothing but the device, and for that at most MVS_DRIVER_PATIENCE_MS. Nothing is thrown. */
#ifndef MVS_DRIVER_H
#define MVS_DRIVER_H

#include <stdint.h>

#if defined(_WIN32)
#define MVS_DRIVER_EXPORT __declspec(dllexport)
#elif defined(__GNUC__)
#define MVS_DRIVER_EXPORT __attribute__((visibility("default")))
#else
#define MVS_DRIVER_EXPORT
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* The version of this interface. */
#define MVS_DRIVER_VERSION 1u

/* How long a driver may wait for its device before it says MVS_DRIVER_E_LOST. */
#define MVS_DRIVER_PATIENCE_MS 100u

/* What a function returns. */
enum mvs_driver_result_e {
  MVS_DRIVER_OK = 0,
  MVS_DRIVER_STOP = 1,           /* of the servo only: leave run() now */
  MVS_DRIVER_E_ABSENT = -1,      /* no such device is there */
  MVS_DRIVER_E_LIBRARY = -2,     /* the vendor's library, or one that it needs, is not there */
  MVS_DRIVER_E_PERMISSION = -3,  /* the system does not let this user at the device */
  MVS_DRIVER_E_LICENCE = -4,     /* the vendor's library wants a licence */
  MVS_DRIVER_E_CALIBRATION = -5, /* the device must be calibrated: the sentence says how */
  MVS_DRIVER_E_BUSY = -6,        /* somebody else has it open */
  MVS_DRIVER_E_LOST = -7,        /* it was there, and is gone or silent */
  MVS_DRIVER_E_FAULT = -8,       /* it says that it is broken, or too hot */
  MVS_DRIVER_E_OPTION = -9,      /* an option makes no sense, or a file that it names */
  MVS_DRIVER_E_END = -10,        /* of a recording: it is over */
  MVS_DRIVER_E_VERSION = -11,    /* no version of this interface that both sides know */
  MVS_DRIVER_E_UNSUPPORTED = -12,
  MVS_DRIVER_E_INTERNAL = -13
};
typedef int32_t mvs_driver_result;

/* Why forces are off; the numbers of mvs_driver_state.cause, and those of libmvs' own latch. */
enum mvs_cause_e {
  MVS_CAUSE_NONE = 0,
  MVS_CAUSE_BUTTON = 1,     /* the user switched them off at the device */
  MVS_CAUSE_VELOCITY = 2,   /* it moves too fast, or jumped */
  MVS_CAUSE_WATCHDOG = 3,   /* somebody did not answer in time */
  MVS_CAUSE_SOFTWARE = 4,   /* a program asked for it */
  MVS_CAUSE_UNPLUGGED = 5,  /* the device is gone */
  MVS_CAUSE_DEADMAN = 6,    /* nobody holds it */
  MVS_CAUSE_NOT_FINITE = 7, /* a number was none */
  MVS_CAUSE_THERMAL = 8,    /* the motors are too warm */
  MVS_CAUSE_CALIBRATION = 9 /* where it is cannot be trusted */
};
typedef uint32_t mvs_cause;

/* What a device is. Zero of a number means that the device does not say: libmvs then takes the
 * limits of the weakest device that it knows. */
typedef struct mvs_driver_info {
  uint32_t struct_size;
  uint32_t freedoms_in;  /* 3: position; 6: orientation too */
  uint32_t freedoms_out; /* 0: no force; 3: force; 6: torque too */
  uint32_t buttons;      /* how many there are, at most 32 */
  uint32_t has_gripper;
  uint32_t has_deadman;                      /* 1: MVS_DRIVER_FLAG_HELD is told */
  double workspace_min[3], workspace_max[3]; /* m, the corners of the box that the hand can reach,
                                                in the device's axes */
  double peak_force;                         /* N */
  double continuous_force;                   /* N, that the motors bear for ever */
  double peak_torque;                        /* N m */
  double max_stiffness;                      /* N/m, the largest that is stable at its rate */
  double max_damping;                        /* N s/m, likewise */
  double max_speed;                          /* m/s */
  double rate;                               /* Hz, nominal, of its servo */
  /* By rows: rotation and offset (m) from the device's axes to those of libmvs, x to the right, y
   * up, z towards the user: p = frame[:, :3] p_device + frame[:, 3]. All zero: they are the same.
   */
  double frame[12];
  char model[64], serial[64], firmware[64];
} mvs_driver_info;

/* Bits of mvs_driver_state.flags. */
enum mvs_driver_flags_e {
  MVS_DRIVER_FLAG_CALIBRATED = 1 << 0, /* the pose can be trusted */
  MVS_DRIVER_FLAG_VELOCITY = 1 << 1,   /* `velocity` is measured; without it libmvs estimates one */
  MVS_DRIVER_FLAG_FORCE_ON = 1 << 2,   /* the motors follow what is written */
  MVS_DRIVER_FLAG_SATURATED = 1 << 3,  /* the last force was more than the motors could */
  MVS_DRIVER_FLAG_HELD = 1 << 4,       /* the dead-man's switch is held */
  MVS_DRIVER_FLAG_PARKED = 1 << 5,     /* the stylus is in its holder */
  MVS_DRIVER_FLAG_WARM = 1 << 6        /* a warning: the motors grow too warm */
};
typedef uint32_t mvs_driver_flags;

/* Where the hand is. */
typedef struct mvs_driver_state {
  uint32_t struct_size;
  uint32_t flags;        /* MVS_DRIVER_* bits */
  uint64_t time_ns;      /* of this sample, on the clock of `now_ns`, or a monotonic one in run() */
  uint64_t sequence;     /* grows by at least 1 with each new sample, stays when there is none */
  double position[3];    /* m */
  double orientation[4]; /* unit quaternion w x y z, from the stylus' axes to the device's; of a
                            device with 3 freedoms 1 0 0 0 */
  double velocity[3];    /* m/s */
  double gripper;        /* rad, 0 closed */
  uint32_t buttons;      /* bit 0: the first one */
  uint32_t cause;        /* MVS_CAUSE_*: why the device itself took its forces off */
} mvs_driver_state;

/* What the hand is to feel, until the next one. */
typedef struct mvs_driver_force {
  uint32_t struct_size;
  uint32_t on;      /* 0: motors off */
  double force[3];  /* N, on the hand */
  double torque[3]; /* N m, likewise */
  double gripper;   /* N m, opens the fingers */
} mvs_driver_force;

/* The side of libmvs. Valid from negotiate on until the library is unloaded; that of open() until
 * close(). */
typedef struct mvs_driver_host {
  uint32_t struct_size;
  uint32_t oldest, newest; /* the versions of this interface that it speaks */
  uint32_t reserved;
  void *host; /* handed back to the functions below */
  /* The value of an option of the application's, null if it was not given; valid until close(). */
  const char *(*option)(void *host, const char *key);
  /* Says something to who reads the application's log, from any thread but at the device's rate. */
  void (*log)(void *host, const char *sentence);
} mvs_driver_host;

/* An open device: the driver's own. */
typedef struct mvs_driver_device mvs_driver_device;

/* The servo of libmvs, for run(): takes a sample, gives the force for it, in a few microseconds.
 * MVS_DRIVER_STOP: write that force (it is zero) and return from run(). */
typedef int32_t (*mvs_driver_servo)(void *user, const mvs_driver_state *state,
                                    mvs_driver_force *force);

/* A device that was found: the name that open() takes, and what it is. */
typedef void (*mvs_driver_found)(void *user, const char *name, const char *model);

/* One check of doctor(): `verdict` is 1 good, 0 a fault, -1 a warning, 2 a note; `check` says what
 * was looked at ("library libHD.so"), `sentence` what was found and what to do. */
typedef void (*mvs_driver_finding)(void *user, int32_t verdict, const char *check,
                                   const char *sentence);

/* The side of the driver. A device is used by one thread at a time, but for stop() and panic(). */
typedef struct mvs_driver_api {
  uint32_t struct_size;
  uint32_t version;  /* the one that the driver speaks, of those that the host offered */
  const char *name;  /* of the driver, as the application asks for it: "phantom" */
  const char *about; /* one line: which devices */
  /* Every option that it knows, an entry for each, "key: what it means", ended by null; libmvs
   * refuses others. Nullable: none. */
  const char *const *options;

  /* Names every device that is there; quick, and without moving any. Nullable: open() takes none.
   */
  int32_t (*list)(const mvs_driver_host *host, mvs_driver_found found, void *user);
  /* Looks at all that a device needs: library, dependency, rights, licence, locale, calibration.
   * Nullable. */
  int32_t (*doctor)(const mvs_driver_host *host, mvs_driver_finding finding, void *user);

  /* `name` is null for the first one. Motors stay off. */
  int32_t (*open)(const mvs_driver_host *host, const char *name, mvs_driver_device **device);
  int32_t (*info)(mvs_driver_device *device, mvs_driver_info *info);
  /* Calibrates, where that needs no more than time; else MVS_DRIVER_E_CALIBRATION says what the
   * user has to do. Nullable: nothing to calibrate. */
  int32_t (*calibrate)(mvs_driver_device *device);
  int32_t (*start)(mvs_driver_device *device);

  /* Either both of these: polled at `info.rate` by a thread of libmvs', or on a clock that the
   * application turns. `now_ns` grows; a simulated device takes its time from it. */
  int32_t (*read)(mvs_driver_device *device, uint64_t now_ns, mvs_driver_state *state);
  int32_t (*write)(mvs_driver_device *device, const mvs_driver_force *force);
  /* Or this one: calls the servo for each sample of the device's own clock, until it says
   * MVS_DRIVER_STOP or somebody calls stop(); then motors are off, and it returns. */
  int32_t (*run)(mvs_driver_device *device, mvs_driver_servo servo, void *user);

  /* Motors off; run() returns soon. From any thread; twice does no harm. */
  int32_t (*stop)(mvs_driver_device *device);
  /* Zero force now, called from a handler of a fatal signal: only what is safe there. Nullable. */
  void (*panic)(mvs_driver_device *device);
  void (*close)(mvs_driver_device *device);
  /* The sentence for the last function of this device that failed; of a null one for list, doctor
   * or open, on this thread. Valid until the next call. Never null. */
  const char *(*error)(const mvs_driver_device *device);
} mvs_driver_api;

/* The one symbol of a driver. `api->struct_size` is what the host has room for; the driver fills
 * that much, sets it to what it filled and `version` to a version within the host's, or returns
 * MVS_DRIVER_E_VERSION. Nothing else happens: no device is touched. */
MVS_DRIVER_EXPORT int32_t mvs_driver_negotiate(const mvs_driver_host *host, mvs_driver_api *api);
typedef int32_t (*mvs_driver_negotiate_fn)(const mvs_driver_host *host, mvs_driver_api *api);

#ifdef __cplusplus
}
#endif
#endif
