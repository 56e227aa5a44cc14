/* Haptic devices, for applications: open a device through its driver and couple it to a valve.
 *
 * Two loops run. The servo runs at the device's rate (1 kHz): it reads the position of the hand and
 * computes the force from a local model of the tissue around the tool, without lock, allocation or
 * system call. The simulation runs as fast as it can: before each mvs_step the application calls
 * mvs_device_sync, which passes position and buttons to the valve and a new tissue model (force,
 * its derivative, nearby surfaces) to the servo.
 *
 *   mvs_device_open(&desc, &device);  mvs_prepare_step(sim, NULL);
 *   mvs_device_start(device);  mvs_device_arm(device);
 *   for (;;) { mvs_device_sync(device, sim, &report);  mvs_step(sim, NULL); }
 *
 * Two clocks run as well: mvs_step advances the valve by its `dt`, the hand moves in wall time. A
 * sync takes the newest position of the hand, whatever the time of the valve is: hands have no time
 * of their own. Where a step takes longer than dt, the valve moves in slow motion, and its inertia
 * and damping resist a hand that is faster by that factor: forces then depend on the load of the
 * computer. Where steps are faster than dt, wait after each for wall time, or the valve moves too
 * fast. The lag is the wall time since a sync minus the advance of MVS_ARRAY_STATE_TIME; model_age
 * shows how long a step takes. Against a lag, in this order: a longer dt, `budget` in
 * mvs_step_options, more workers, a coarser valve. Forces fade only if a step takes more than
 * `stale_s`.
 *
 * The library, not the driver, makes forces safe: a force that is not finite becomes zero; forces
 * are clamped to the limits of user, device and motor temperature, and limited in their rate of
 * change; they start with a ramp after a gate, fade when the simulation stalls, and push back at
 * the edge of the workspace. A dangerous condition latches forces off with a cause until
 * mvs_device_arm. A device whose read, write or loop fails is lost: libmvs writes zero to a
 * device that it polls, and calls the driver's stop(), at once. Whether a driver answers is seen by
 * mvs_device_sync, mvs_device_arm and mvs_device_get_state: the first of them after 0.1 s without
 * an answer calls its panic(), which switches the motors off. A host that waits longer between two
 * syncs calls mvs_device_get_state from another thread. Both can be armed again after
 * mvs_device_stop and mvs_device_start. A new grasp or felt chord acts with
 * a ramp of 50 ms. A passivity observer measures energy that the sampled loop generates, and
 * damping removes it. What the damping of a device cannot take out, as of a stiff tool in a
 * simulation that is late by 30 ms or more, takes away the work of the force on the hand: a force
 * along the motion of the hand is reduced. These measures do not make a device a medical one.
 *
 * Threads of the library and those that it starts in a driver block all signals but those of a
 * fault of their own (SIGSEGV, SIGBUS, SIGFPE, SIGILL). A function of a driver has to return within
 * 10 s, its loop within 2 s of mvs_device_stop. mvs_device_close, mvs_device_list and
 * mvs_device_doctor return when their threads have ended; then libmvs may be unloaded (dlclose). A
 * thread that hangs in a driver is abandoned, and libmvs stays loaded until the process ends, as
 * every driver does in any case.
 *
 * Positions are in the scene (the valve's frame) unless marked "of the device": there x points to
 * the user's right, y up, z towards the user, and 0 is the centre of the workspace. A device is
 * used by one thread at a time; any thread may call mvs_device_get_state and mvs_device_cut. */
#ifndef MVS_DEVICE_H
#define MVS_DEVICE_H

#include "base.h"
#include "driver.h"
#include "sim.h"
#include "tool.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mvs_device mvs_device;

/* Drivers in the folder mvs/drivers beside the library. mvs_get_driver_count reads the folder for
 * the calling thread; mvs_get_driver returns name and path of a driver, valid until this thread
 * reads the folder again. */
MVS_API mvs_result mvs_get_driver_count(uint32_t *count);
MVS_API mvs_result mvs_get_driver(uint32_t index, const char **name, const char **path);

/* Loads a driver and reports the devices that it finds. `driver` is a name in that folder or an
 * absolute path; a file that everybody may write, or that belongs to neither root nor the caller,
 * is refused. `options` are "key=value" lines; `options` is nullable. */
MVS_API mvs_result mvs_device_list(const char *driver, const char *options, mvs_driver_found found,
                                   void *user);

/* Checks all requirements of a device, and whether its driver can be loaded. A null `driver` checks
 * every driver in the folder without options; a check is then named "driver: check", and a driver
 * without device or vendor library is one note, not a fault. `driver` and `options` are nullable.
 */
MVS_API mvs_result mvs_device_doctor(const char *driver, const char *options,
                                     mvs_driver_finding finding, void *user);

/* Clocks. */
enum mvs_clock_e {
  MVS_CLOCK_REAL = 0,   /* the device's own, or a thread of the library's at its rate */
  MVS_CLOCK_VIRTUAL = 1 /* advanced by mvs_device_advance: for tests and unattended sessions */
};
typedef uint32_t mvs_clock;

/* Options of mvs_device_open. */
typedef struct mvs_device_desc {
  uint32_t struct_size;
  mvs_clock clock;     /* MVS_CLOCK_* */
  const char *driver;  /* a name, or an absolute path */
  const char *device;  /* a name reported by mvs_device_list; nullable [the first] */
  const char *options; /* of the driver, "key=value" lines; nullable */
  double rate;         /* Hz, of a polled device; 100 to 10000 [its nominal rate, or 1000] */
  /* Receives messages of the driver, one line each and one at a time, from any thread except the
   * servo's, until mvs_device_close returns or mvs_device_open fails: these wait for a message that
   * is being received, so that it must not wait for them. Nullable: silent. */
  void (*log)(void *user, mvs_log_level level, const char *text);
  void *user; /* passed to it */
} mvs_device_desc;

/* Opens a device with its motors off; mvs_device_close frees it. MVS_E_IO if the driver does not
 * exist, MVS_E_VERSION if it has another version, MVS_E_MEMORY if the system has no thread for it,
 * MVS_E_DEVICE with the driver's own sentence for other failures. */
MVS_API mvs_result mvs_device_open(const mvs_device_desc *desc, mvs_device **device);

/* Stops and frees a device, and removes its tools from the simulator of the last mvs_device_sync
 * unless that is destroyed or at work in another thread. Where the driver hangs it waits 10 s for
 * stop(), 2 s for the loop and 10 s for close(), at most 12 s in all, and leaves the device to the
 * driver. No callback of the host is called after it has returned. `device` is nullable. */
MVS_API void mvs_device_close(mvs_device *device);

/* Properties of a device as its driver reports them, in the frame of the device; numbers that the
 * driver does not know are those of the weakest device known to libmvs (3.3 N, 0.88 N continuous,
 * 400 N/m, 4 N s/m, 0.188 N m). `realtime` is set by mvs_device_start: its thread got real-time
 * priority. */
typedef struct mvs_device_info {
  uint32_t struct_size;
  uint32_t freedoms_in, freedoms_out, buttons;
  mvs_clock clock;                           /* MVS_CLOCK_* */
  uint32_t realtime;                         /* 1: SCHED_FIFO granted, or the device's own clock */
  double workspace_min[3], workspace_max[3]; /* m */
  double peak_force, continuous_force;       /* N */
  double max_stiffness, max_damping;         /* N/m, N s/m */
  double max_speed;                          /* m/s */
  double rate;                               /* Hz */
  char driver[64], model[64], serial[64], firmware[64];
  /* 0 unless the device measures orientation and renders torque (6 freedoms in and out). */
  double peak_torque, continuous_torque; /* N m */
  double max_angular_stiffness;          /* N m/rad */
  double max_angular_damping;            /* N m s/rad */
} mvs_device_info;
/* Reads the properties of a device. */
MVS_API mvs_result mvs_device_get_info(const mvs_device *device, mvs_device_info *info);

/* Limits set by the user; none exceeds the limits of the device. */
typedef struct mvs_device_limits {
  uint32_t struct_size;
  uint32_t reserved;       /* 0 */
  double force;            /* N [peak force of the device] */
  double continuous_force; /* N, allowed average of the force [that of the device] */
  double thermal_s;        /* s, averaging time of that limit; 0.1 to 1000 [10] */
  double slew;             /* N/s, largest rate of change of the force [100 / s times `force`]; a
                              force may fall by 100 / s times the peak force of the device */
  double gate;             /* N, forces start only once a tissue model is there, and while the force
                              is below it, and the torque below the same share of `torque` as it is
                              of `force` [0.2] */
  double ramp_s;           /* s, duration of the initial ramp; 0.01 to 10 [1] */
  double speed;            /* m/s, above it forces latch off [that of the device, at most 1] */
  double stale_s;          /* s, an older tissue model fades; 0.005 to 10 [0.1] */
  double fade_s;           /* s, duration of fading; 0.001 to 1 [0.05]. A fresh model brings forces
                              back in four times as long, without the gate */
  double stiffness;        /* N/m, largest stiffness felt by the hand [that of the device] */
  /* For devices that render torque; 0 for others. thermal_s, ramp_s, stale_s and fade_s hold for
   * the torque as well. */
  double torque;            /* N m [peak torque of the device] */
  double continuous_torque; /* N m, allowed average of the torque [that of the device] */
  double torque_slew;       /* N m/s, its largest rate of change [100 / s times `torque`] */
  double angular_stiffness; /* N m/rad, largest one felt by the hand [that of the device] */
  double angular_speed;     /* rad/s, above it forces latch off; 0.1 to 100 [20] */
} mvs_device_limits;
/* Set and read the limits; unset fields read as the default in effect. */
MVS_API mvs_result mvs_device_set_limits(mvs_device *device, const mvs_device_limits *limits);
MVS_API mvs_result mvs_device_get_limits(const mvs_device *device, mvs_device_limits *limits);

/* Map from the device's workspace to the scene: p = origin + scale * rotation * p_device; forces of
 * the scene are multiplied by `force_scale`, torques by force_scale / scale, which is the torque of
 * these forces at the smaller levers of the device. The hand feels scale * force_scale times the
 * stiffness of the tissue; the tool's spring is softened so that this does not exceed the limit,
 * and on a device that renders torque so that translation and rotation together do not. Of a tool
 * that was made through another view, a share of its force is felt instead. */
typedef struct mvs_device_view {
  uint32_t struct_size;
  uint32_t reserved;  /* 0 */
  double origin[3];   /* m */
  double rotation[4]; /* quaternion w x y z, any length [1 0 0 0] */
  double scale;       /* 0.01 to 100 [1] */
  double force_scale; /* 0.001 to 1000 [1] */
} mvs_device_view;
/* Set and read the map. */
MVS_API mvs_result mvs_device_set_view(mvs_device *device, const mvs_device_view *view);
MVS_API mvs_result mvs_device_get_view(const mvs_device *device, mvs_device_view *view);

/* Functions of the hand. */
enum mvs_hand_mode_e {
  MVS_HAND_MODE_LOOK = 0,  /* points at nodes and chordae without force */
  MVS_HAND_MODE_GRASP = 1, /* the button grasps the nearest node, drags and releases it */
  MVS_HAND_MODE_BALL = 2,  /* pushes tissue with a ball */
  MVS_HAND_MODE_ROD = 3,   /* pushes with a rod along the stylus; its torque is rendered by devices
                              with 6 freedoms out */
  MVS_HAND_MODE_FEEL = 4,  /* feels the tension of `chord` */
  MVS_HAND_MODE_DRAG = 5,  /* the button drags the leaflet end of `chord` to set its length */
  MVS_HAND_MODE_CONVEX = 6 /* pushes with `bodies`, which turn with the stylus */
};
typedef uint32_t mvs_hand_mode;

/* The tool of the hand. */
typedef struct mvs_device_hand {
  uint32_t struct_size;
  mvs_hand_mode mode; /* MVS_HAND_MODE_* */
  mvs_id chord;       /* to feel or drag [the nearest one when the button is pressed] */
  uint32_t button;    /* that grasps [0: the first] */
  uint32_t reserved;
  double reach;                /* m, in the scene, largest distance of a grasped part [5e-3] */
  double radius;               /* m, of ball or rod [2e-3] */
  double length;               /* m, of the rod [40e-3] */
  double stiffness;            /* N/m, of the spring between hand and tool, in the scene [200] */
  double max_force;            /* N, of that spring, in the scene [5] */
  double gain;                 /* factor on the tension of a felt chord, 1e-3 to 1e3 [1] */
  const mvs_body_desc *bodies; /* as those of mvs_tool_desc; null when it is read */
  uint32_t body_count;
  uint32_t body_stride; /* sizeof(mvs_body_desc) */
} mvs_device_hand;
/* Sets or reads the tool. A change releases the held part at the next mvs_device_sync. */
MVS_API mvs_result mvs_device_set_hand(mvs_device *device, const mvs_device_hand *hand);
MVS_API mvs_result mvs_device_get_hand(const mvs_device *device, mvs_device_hand *hand);

/* Starts the servo: positions are read, forces stay off until mvs_device_arm. MVS_E_STATE if it is
 * started, MVS_E_DEVICE with the sentence of the driver, MVS_E_MEMORY if the system has no thread
 * for it. */
MVS_API mvs_result mvs_device_start(mvs_device *device);

/* Stops the servo: zero force, motors off. MVS_E_DEVICE if the driver does not come back from its
 * loop within 2 s. */
MVS_API mvs_result mvs_device_stop(mvs_device *device);

/* Enables forces through gate and ramp, also after a latch whose cause has ended; MVS_E_DEVICE
 * names a cause that persists, MVS_E_STATE if it is not started. */
MVS_API mvs_result mvs_device_arm(mvs_device *device);

/* Switches forces off at once with cause MVS_CAUSE_SOFTWARE. From any thread. */
MVS_API mvs_result mvs_device_cut(mvs_device *device);

/* Virtual clock: runs the servo for `seconds`, 0 to 3600, at its rate. MVS_E_STATE if it is not
 * started, or has a real clock. */
MVS_API mvs_result mvs_device_advance(mvs_device *device, double seconds);

/* Events of mvs_device_sync: bits of mvs_device_report.events. */
enum mvs_event_flags_e {
  MVS_EVENT_PRESSED = 1 << 0, /* the button of the hand */
  MVS_EVENT_RELEASED = 1 << 1,
  MVS_EVENT_GRASPED = 1 << 2, /* `tool` holds `node` */
  MVS_EVENT_LET_GO = 1 << 3,
  MVS_EVENT_MISSED = 1 << 4,    /* no part within reach when the button was pressed */
  MVS_EVENT_CHOSEN = 1 << 5,    /* `chord` is now the one to feel or drag */
  MVS_EVENT_DRAGGED = 1 << 6,   /* a chord was dragged: `drag_to` is the target of its leaflet end,
                                   for mvs_op_chord_length.drag_to */
  MVS_EVENT_LOST_TOOL = 1 << 7, /* an undo, an operation or a new valve removed the tool */
  MVS_EVENT_BLOCKED = 1 << 8,   /* a ball or rod would overlap tissue: move away first */
  MVS_EVENT_LATCHED = 1 << 9    /* forces latched off: see mvs_device_state.cause */
};
typedef uint32_t mvs_event_flags;

/* Result of mvs_device_sync. */
typedef struct mvs_device_report {
  uint32_t struct_size;
  mvs_event_flags events;     /* MVS_EVENT_* */
  mvs_id tool;                /* in the valve; 0: no tool */
  mvs_id chord;               /* chosen; 0: no chord */
  mvs_id near_chord;          /* nearest to the hand; 0: no chordae */
  double near_chord_distance; /* m */
  uint32_t near_node;         /* nearest free vertex of a leaflet; UINT32_MAX: no vertex */
  uint32_t node;              /* held; UINT32_MAX: no node */
  double near_node_distance;  /* m */
  double position[3];         /* m, of the hand */
  double force[3];            /* N, of the tissue on the hand, before it is scaled */
  double stiffness;           /* N/m, largest stiffness of the rendered tissue model */
  double drag_to[3];          /* m, target of a dragged chord end */
  double torque[3];         /* N m, in the scene, on the hand about `position`, before it is scaled;
                               of a rod or convex tool, on every device */
  double angular_stiffness; /* N m/rad, largest one of that model; 0 if it has no torque */
} mvs_device_report;

/* Exchanges hand and tissue data before each mvs_step; no tool is added before the first sample.
 * `report` is nullable. A hand whose tool an undo or a new valve removed continues without it.
 * Tools that the hand made belong to it: one that an undo, a restored snapshot or a file brings
 * back is taken by the hand again if it has no tool and still holds the button or pushes, and is
 * removed otherwise. */
MVS_API mvs_result mvs_device_sync(mvs_device *device, mvs_sim *sim, mvs_device_report *report);

/* Phases of the force output. */
enum mvs_device_phase_e {
  MVS_DEVICE_PHASE_STOPPED = 0,
  MVS_DEVICE_PHASE_OFF = 1,     /* started, not armed */
  MVS_DEVICE_PHASE_WAITING = 2, /* armed; there is no tissue model yet, or its force exceeds the
                                   gate: move the hand away */
  MVS_DEVICE_PHASE_RAMPING = 3,
  MVS_DEVICE_PHASE_ON = 4,
  MVS_DEVICE_PHASE_FADED = 5,  /* the tissue model is too old */
  MVS_DEVICE_PHASE_LATCHED = 6 /* see `cause` */
};
typedef uint32_t mvs_device_phase;

/* Limits applied to the last force: bits of mvs_device_state.limited. */
enum mvs_limited_flags_e {
  MVS_LIMITED_FORCE = 1 << 0,      /* clamped */
  MVS_LIMITED_CONTINUOUS = 1 << 1, /* to the continuous limit of the motors; also of the torque */
  MVS_LIMITED_SLEW = 1 << 2,       /* also of the torque */
  MVS_LIMITED_ENERGY = 1 << 3,     /* damped or reduced: the loop had generated energy */
  MVS_LIMITED_WALL = 1 << 4,       /* the wall of the workspace acted */
  MVS_LIMITED_NUMBER = 1 << 5,     /* a force was not finite and became zero */
  MVS_LIMITED_TORQUE = 1 << 6      /* the torque was clamped */
};
typedef uint32_t mvs_limited_flags;

/* Defects of the driver's samples: bits of mvs_device_state.sample_faults. */
enum mvs_sample_fault_flags_e {
  MVS_SAMPLE_FAULT_NUMBER = 1 << 0,      /* position or velocity not finite, or above 1000 m/s */
  MVS_SAMPLE_FAULT_ORIENTATION = 1 << 1, /* not a unit quaternion */
  MVS_SAMPLE_FAULT_FAR = 1 << 2,         /* more than 1 m from the centre of the workspace */
  MVS_SAMPLE_FAULT_SEQUENCE = 1 << 3,    /* `sequence` did not change for 0.1 s: no new sample */
  MVS_SAMPLE_FAULT_CLOCK = 1 << 4        /* `time_ns` went back, or stood still for 0.1 s */
};
typedef uint32_t mvs_sample_fault_flags;

/* Present status of the servo. */
typedef struct mvs_device_state {
  uint32_t struct_size;
  mvs_device_phase phase;    /* MVS_DEVICE_PHASE_* */
  mvs_cause cause;           /* MVS_CAUSE_*, of a latch */
  mvs_driver_flags flags;    /* MVS_DRIVER_FLAG_*, of the driver */
  mvs_limited_flags limited; /* MVS_LIMITED_* */
  uint32_t buttons;          /* debounced */
  double time;               /* s, since mvs_device_start */
  double position[3];        /* m, in the scene */
  double orientation[4];     /* w x y z, from the stylus' axes to the scene */
  double velocity[3];        /* m/s, in the scene */
  double hand[3];            /* m, of the device */
  double force[3];           /* N, of the device: the commanded force */
  double rate;               /* Hz, recent average */
  double worst_period;       /* s, the longest between two ticks since mvs_device_start */
  double model_age;          /* s, of the tissue model; infinite before the first */
  double energy;             /* J, generated by the loop, work of torques included, and not yet
                                removed by damping */
  double heat;               /* 0 cool .. 1 at the continuous limit, of force or torque */
  uint64_t ticks;            /* of the servo */
  uint64_t late;             /* ticks later than two periods */
  uint64_t bad_samples;      /* samples with a defect since mvs_device_start */
  mvs_sample_fault_flags sample_faults; /* MVS_SAMPLE_FAULT_*, of these samples; each latches
                                           forces off once they are armed, and refuses to arm
                                           while it lasts */
  uint32_t reserved;
  double torque[3]; /* N m, of the device, about `hand`: the commanded torque */
} mvs_device_state;
/* Reads the status, from any thread. */
MVS_API mvs_result mvs_device_get_state(mvs_device *device, mvs_device_state *state);

/* One tick of the servo, in the frame of the device. */
typedef struct mvs_device_sample {
  double time;               /* s, since mvs_device_start */
  double position[3];        /* m */
  double orientation[4];     /* w x y z */
  double force[3];           /* N */
  double servo_s;            /* s, computing time of the servo; 0 on a virtual clock */
  double gripper;            /* rad */
  uint32_t buttons;          /* as the driver reports them */
  mvs_limited_flags limited; /* MVS_LIMITED_* */
  double torque[3];          /* N m, about `position` */
} mvs_device_sample;

/* Takes the ticks since the last call, oldest first, out of a buffer of 8192: writes at most
 * `capacity` samples, `stride` bytes apart (sizeof(mvs_device_sample)), stores their number in
 * *count and the number of ticks lost by overflow of the buffer in *lost. */
MVS_API mvs_result mvs_device_take_samples(mvs_device *device, mvs_device_sample *samples,
                                           uint32_t stride, uint64_t capacity, uint64_t *count,
                                           uint64_t *lost);

/* 1: installs a handler of fatal signals (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM,
 * SIGINT) that sets zero force on every started device, which keeps it until it is stopped and
 * started again, and calls the previous handler with the same arguments and signal mask, or ends
 * the process as the default action would. It runs on the alternate stack of the thread, if there
 * is one, and stays installed after a signal that the host survives. A signal that the host ignores
 * stays ignored. A host that has replaced the handler may call this again: the new handler then
 * becomes the previous one (MVS_E_STATE after 8 different ones).
 * 0: restores the previous handler where this one is installed; a newer handler of the host stays,
 * and may still call this one, which only passes the signal on.
 * libmvs stays loaded while the handler is installed, or was replaced. The library installs no
 * handler by default. */
MVS_API mvs_result mvs_device_handle_signals(uint32_t on);

#ifdef __cplusplus
}
#endif
#endif
