/* The driver interface: everything that the author of a haptic driver for libmvs needs.
 *
 * A driver is a shared library that includes only this header and exports one symbol,
 * mvs_driver_negotiate. It reads the pose of the hand and sends forces to the motors. libmvs
 * computes the force and makes it safe (finite, clamped, ramped, faded, latched) for every device
 * alike: a driver forwards each force at once and unchanged, zero included. Start from a copy of
 * haptic_drivers/template.
 *
 * Units are SI (m, m/s, N, N m, rad, s) along the device's own right-handed axes, whose orientation
 * mvs_driver_info reports. Structs start with `struct_size`: the writer of a struct stays within
 * that size, and the reader takes missing fields as zero. They grow only at their end.
 *
 * A function returns MVS_DRIVER_OK or one of MVS_DRIVER_E_*; error() then returns a sentence with
 * the fault and the remedy. Functions called at the device's rate (read, write, and the code of
 * run() between two calls of the servo) take no lock, allocate no memory, and wait only for the
 * device, at most MVS_DRIVER_PATIENCE_MS. They throw nothing. */
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

/* Longest wait for a device before a driver returns MVS_DRIVER_E_LOST. */
#define MVS_DRIVER_PATIENCE_MS 100u

/* Results of the functions of a driver. */
enum mvs_driver_result_e {
  MVS_DRIVER_OK = 0,
  MVS_DRIVER_STOP = 1,           /* of the servo only: return from run() now */
  MVS_DRIVER_E_ABSENT = -1,      /* the device is not connected */
  MVS_DRIVER_E_LIBRARY = -2,     /* the vendor's library or a dependency of it is missing */
  MVS_DRIVER_E_PERMISSION = -3,  /* the system denies this user access to the device */
  MVS_DRIVER_E_LICENCE = -4,     /* the vendor's library requires a licence */
  MVS_DRIVER_E_CALIBRATION = -5, /* the device must be calibrated: the sentence explains how */
  MVS_DRIVER_E_BUSY = -6,        /* another process has opened it */
  MVS_DRIVER_E_LOST = -7,        /* it was disconnected or no longer answers */
  MVS_DRIVER_E_FAULT = -8,       /* it reports a fault, or is too hot */
  MVS_DRIVER_E_OPTION = -9,      /* an invalid option, or an invalid file named by one */
  MVS_DRIVER_E_END = -10,        /* the end of a recording */
  MVS_DRIVER_E_VERSION = -11,    /* no common version of this interface */
  MVS_DRIVER_E_UNSUPPORTED = -12,
  MVS_DRIVER_E_INTERNAL = -13
};
typedef int32_t mvs_driver_result;

/* Causes of forces being off, of mvs_driver_state.cause and of the latch of libmvs. */
enum mvs_cause_e {
  MVS_CAUSE_NONE = 0,
  MVS_CAUSE_BUTTON = 1,     /* the user switched them off at the device */
  MVS_CAUSE_VELOCITY = 2,   /* the hand moved too fast or jumped */
  MVS_CAUSE_WATCHDOG = 3,   /* a component did not answer in time */
  MVS_CAUSE_SOFTWARE = 4,   /* a program switched them off */
  MVS_CAUSE_UNPLUGGED = 5,  /* the device was disconnected */
  MVS_CAUSE_DEADMAN = 6,    /* the dead-man's switch is released */
  MVS_CAUSE_NOT_FINITE = 7, /* a number was not finite */
  MVS_CAUSE_THERMAL = 8,    /* the motors are too warm, or the driver reports a fault */
  MVS_CAUSE_CALIBRATION = 9 /* its position is not reliable */
};
typedef uint32_t mvs_cause;

/* Properties of a device. A number left zero is unknown: libmvs then uses the limits of the weakest
 * device known to it. */
typedef struct mvs_driver_info {
  uint32_t struct_size;
  uint32_t freedoms_in;  /* 3: position; 6: orientation too */
  uint32_t freedoms_out; /* 0: no force; 3: force; 6: torque too */
  uint32_t buttons;      /* number of buttons, at most 32 */
  uint32_t has_gripper;
  uint32_t has_deadman;                      /* 1: MVS_DRIVER_FLAG_HELD is reported */
  double workspace_min[3], workspace_max[3]; /* m, corners of the reachable box, in the device's
                                                axes */
  double peak_force;                         /* N */
  double continuous_force;                   /* N, sustained without time limit */
  double peak_torque;                        /* N m, about any axis */
  double max_stiffness;                      /* N/m, largest stable stiffness at its rate */
  double max_damping;                        /* N s/m, largest stable damping at its rate */
  double max_speed;                          /* m/s */
  double rate;                               /* Hz, nominal rate of its servo */
  /* Row by row: rotation and offset (m) from the device's axes to those of libmvs, x to the right,
   * y up, z towards the user: p = frame[:, :3] p_device + frame[:, 3]. All zero: identity. With a
   * workspace the offset does not count: the centre of the workspace becomes 0. */
  double frame[12];
  char model[64], serial[64], firmware[64];
  /* Limits of the torque of a device with freedoms_out 6; 0 is unknown, as above. Unknown values
   * follow from those of the force with the lever peak_torque / peak_force. */
  double continuous_torque;     /* N m, sustained without time limit */
  double max_angular_stiffness; /* N m/rad, largest stable stiffness of a rotation */
  double max_angular_damping;   /* N m s/rad, likewise */
} mvs_driver_info;

/* Bits of mvs_driver_state.flags. */
enum mvs_driver_flags_e {
  MVS_DRIVER_FLAG_CALIBRATED = 1 << 0, /* the pose can be trusted */
  MVS_DRIVER_FLAG_VELOCITY = 1 << 1,   /* `velocity` is measured; without it libmvs estimates one */
  MVS_DRIVER_FLAG_FORCE_ON = 1 << 2,   /* the motors follow the written force */
  MVS_DRIVER_FLAG_SATURATED = 1 << 3,  /* the last force exceeded the capacity of the motors */
  MVS_DRIVER_FLAG_HELD = 1 << 4,       /* the dead-man's switch is held */
  MVS_DRIVER_FLAG_PARKED = 1 << 5,     /* the stylus is in its holder */
  MVS_DRIVER_FLAG_WARM = 1 << 6        /* a warning: the motors are near their thermal limit */
};
typedef uint32_t mvs_driver_flags;

/* Pose of the hand. */
typedef struct mvs_driver_state {
  uint32_t struct_size;
  mvs_driver_flags flags; /* MVS_DRIVER_FLAG_* */
  uint64_t time_ns;       /* of this sample, on the clock of `now_ns`; monotonic in run() */
  uint64_t sequence;      /* increases with each new sample; unchanged without a new sample */
  double position[3];     /* m */
  double orientation[4];  /* unit quaternion w x y z, from the stylus' axes to the device's;
                             1 0 0 0 for a device with 3 freedoms */
  double velocity[3];     /* m/s */
  double gripper;         /* rad, 0 closed */
  uint32_t buttons;       /* bit 0: the first one */
  mvs_cause cause;        /* MVS_CAUSE_*: the device itself switched its forces off */
} mvs_driver_state;

/* Force on the hand, valid until the next one. Force and torque act at mvs_driver_state.position
 * along the axes of that position. The torque is zero for a device with freedoms_out below 6. */
typedef struct mvs_driver_force {
  uint32_t struct_size;
  uint32_t on;      /* 0: motors off */
  double force[3];  /* N, on the hand */
  double torque[3]; /* N m, on the hand, about its position */
  double gripper;   /* N m, opening the fingers */
} mvs_driver_force;

/* Functions of libmvs for the driver. Valid from negotiate until the driver is unloaded; the host
 * of open() until close(). */
typedef struct mvs_driver_host {
  uint32_t struct_size;
  uint32_t oldest, newest; /* supported versions of this interface */
  uint32_t reserved;
  void *host; /* first argument of the functions below */
  /* Returns an option set by the application, null if it is not set; valid until close(). */
  const char *(*option)(void *host, const char *key);
  /* Writes a sentence to the application's log, from any thread, but not at the device's rate. */
  void (*log)(void *host, const char *sentence);
} mvs_driver_host;

/* An open device, defined by the driver. */
typedef struct mvs_driver_device mvs_driver_device;

/* The servo of libmvs, for run(): computes the force for a sample in a few microseconds. On
 * MVS_DRIVER_STOP the driver writes that force, which is zero, and returns from run(). */
typedef mvs_driver_result (*mvs_driver_servo)(void *user, const mvs_driver_state *state,
                                              mvs_driver_force *force);

/* Receives a connected device: its name, as for open(), and its model. */
typedef void (*mvs_driver_found)(void *user, const char *name, const char *model);

/* Receives one check of doctor(): `verdict` is 1 passed, 0 a fault, -1 a warning, 2 a note; `check`
 * names its object ("library libHD.so"), `sentence` its finding and the remedy. */
typedef void (*mvs_driver_finding)(void *user, int32_t verdict, const char *check,
                                   const char *sentence);

/* Functions of the driver. A device is used by one thread at a time, except stop() and panic(). */
typedef struct mvs_driver_api {
  uint32_t struct_size;
  uint32_t version;  /* the chosen version, among those that the host supports */
  const char *name;  /* of the driver: "phantom" */
  const char *about; /* one line: its devices */
  /* The options of the driver, one entry each, "key: its meaning", terminated by null; libmvs
   * refuses others. Nullable: no options. */
  const char *const *options;

  /* Reports every connected device, fast and without motion. Nullable: open() takes no name. */
  mvs_driver_result (*list)(const mvs_driver_host *host, mvs_driver_found found, void *user);
  /* Checks all requirements of a device: library, dependencies, rights, licence, locale,
   * calibration. Nullable. */
  mvs_driver_result (*doctor)(const mvs_driver_host *host, mvs_driver_finding finding, void *user);

  /* A null `name` opens the first device. Motors stay off. */
  mvs_driver_result (*open)(const mvs_driver_host *host, const char *name,
                            mvs_driver_device **device);
  mvs_driver_result (*info)(mvs_driver_device *device, mvs_driver_info *info);
  /* Calibrates a device that can do so alone; otherwise MVS_DRIVER_E_CALIBRATION, with instructions
   * for the user. Nullable: the device needs no calibration. */
  mvs_driver_result (*calibrate)(mvs_driver_device *device);
  mvs_driver_result (*start)(mvs_driver_device *device);

  /* A polled device has read and write, called at `info.rate` by a thread of libmvs or on the
   * virtual clock of the application. `now_ns` increases; a simulated device takes its time from
   * it. */
  mvs_driver_result (*read)(mvs_driver_device *device, uint64_t now_ns, mvs_driver_state *state);
  mvs_driver_result (*write)(mvs_driver_device *device, const mvs_driver_force *force);
  /* A device with its own clock has run: it calls the servo for each sample until the servo returns
   * MVS_DRIVER_STOP or stop() is called, then switches motors off and returns. */
  mvs_driver_result (*run)(mvs_driver_device *device, mvs_driver_servo servo, void *user);

  /* Switches motors off; run() returns soon. From any thread, repeatedly. After a failed read,
   * write or run libmvs calls write with zero (of a polled device), then stop, on the thread of
   * that call: both have to do what the device still allows, and a failure of theirs is not
   * reported. */
  mvs_driver_result (*stop)(mvs_driver_device *device);
  /* Sets zero force from a handler of a fatal signal, or from any thread while another call of this
   * device does not come back: async-signal-safe. Motors stay off until start(). Nullable. */
  void (*panic)(mvs_driver_device *device);
  void (*close)(mvs_driver_device *device);
  /* Returns the sentence of the last failed function of this device; for a null device that of
   * list, doctor or open on this thread. Valid until the next call. Never null. */
  const char *(*error)(const mvs_driver_device *device);
} mvs_driver_api;

/* The only symbol of a driver. `api->struct_size` is the capacity of the host's struct; the driver
 * fills at most that, sets it to the filled size and `version` to a version within the host's, or
 * returns MVS_DRIVER_E_VERSION. It accesses no device. */
MVS_DRIVER_EXPORT mvs_driver_result mvs_driver_negotiate(const mvs_driver_host *host,
                                                         mvs_driver_api *api);
typedef mvs_driver_result (*mvs_driver_negotiate_fn)(const mvs_driver_host *host,
                                                     mvs_driver_api *api);

#ifdef __cplusplus
}
#endif
#endif
