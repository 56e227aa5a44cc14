/* Haptic devices, for applications: open one through its driver, tie it to a valve, and stay safe.
 *
 * Two clocks meet here. The servo runs at the device's rate (1 kHz): it takes the hand's place and
 * gives a force from a small model of the tissue around the tool, without lock, allocation or
 * system call. The simulation runs as fast as it can: before each mvs_step the application calls
 * mvs_device_sync, which hands the hand's place and buttons to the valve, and a new model of the
 * tissue (force, its change with the hand's place, what is near) to the servo.
 *
 *   mvs_device_open(&desc, &device);  mvs_device_start(device);  mvs_device_arm(device);
 *   for (;;) { mvs_device_sync(device, sim, &report);  mvs_step(sim, NULL); }
 *
 * Safety is here, not in drivers: numbers that are none become zero force; forces are clamped to
 * what user, device and its motors' temperature allow, and do not change too fast; they begin by a
 * ramp after a gate, fade when the simulation stands still, push back at the edge of the workspace.
 * What is dangerous latches them off with a cause, until mvs_device_arm. What the sampled loop
 * makes of energy is observed and taken out by damping. None of it makes a device a medical one.
 *
 * Places are in the scene (the valve's frame) but where it says "of the device": there x is to the
 * user's right, y up, z towards the user, 0 the middle of its workspace. A device is used by one
 * thread at a time, but for mvs_device_get_state and mvs_device_cut, which any may call. */
#ifndef MVS_DEVICE_H
#define MVS_DEVICE_H

#include "base.h"
#include "driver.h"
#include "sim.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mvs_device mvs_device;

/* Called with the name and path of each driver in the folder mvs/drivers beside the library. */
typedef void (*mvs_driver_fn)(void *user, const char *name, const char *path);
MVS_API mvs_result mvs_driver_each(mvs_driver_fn each, void *user);

/* Loads a driver and names the devices it finds. `driver` is a name in that folder, or an absolute
 * path; a file that others may write is not loaded. Null options: none; else "key=value" lines. */
MVS_API mvs_result mvs_device_list(const char *driver, const char *options, mvs_driver_found found,
                                   void *user);

/* Has a driver look at all that a device needs; also at whether the driver itself can be loaded.
 * Null: every driver in that folder, without options; a check is "driver: check" then, and a driver
 * whose device or vendor's library is not here is one note, not a fault. */
MVS_API mvs_result mvs_device_doctor(const char *driver, const char *options,
                                     mvs_driver_finding finding, void *user);

/* Clocks. */
enum mvs_clock_e {
  MVS_CLOCK_REAL = 0,   /* the device's own, or a thread of the library's at its rate */
  MVS_CLOCK_VIRTUAL = 1 /* mvs_device_advance turns it: for tests and unattended sessions */
};
typedef uint32_t mvs_clock;

/* Which device. */
typedef struct mvs_device_desc {
  uint32_t struct_size;
  uint32_t clock;      /* MVS_CLOCK_* */
  const char *driver;  /* a name, or an absolute path */
  const char *device;  /* as mvs_device_list names it; null: the first */
  const char *options; /* of the driver, "key=value" lines; nullable */
  double rate;         /* Hz, of a polled device; 100 to 10000 [its own, or 1000] */
  /* What the driver says, one line of text, from any thread but the servo's. Nullable: silent. */
  void (*log)(void *user, int32_t level, const char *text);
  void *user; /* handed to it */
} mvs_device_desc;

/* Opens a device; its motors are off. MVS_E_IO if there is no such driver, MVS_E_VERSION if it
 * speaks another version, MVS_E_DEVICE with the driver's own sentence for what else is wrong. */
MVS_API mvs_result mvs_device_open(const mvs_device_desc *desc, mvs_device **device);

/* Stops it first. `device` is nullable. */
MVS_API void mvs_device_close(mvs_device *device);

/* What the device is, as its driver says; numbers that it does not tell are those of the weakest
 * device that libmvs knows (3.3 N, 0.88 N continuous, 400 N/m, 4 N s/m). In the frame of the
 * device. `realtime` says after mvs_device_start whether its thread got real-time priority. */
typedef struct mvs_device_info {
  uint32_t struct_size;
  uint32_t freedoms_in, freedoms_out, buttons;
  uint32_t clock;                            /* MVS_CLOCK_* */
  uint32_t realtime;                         /* 1: SCHED_FIFO granted, or the device's own clock */
  double workspace_min[3], workspace_max[3]; /* m */
  double peak_force, continuous_force;       /* N */
  double max_stiffness, max_damping;         /* N/m, N s/m */
  double max_speed;                          /* m/s */
  double rate;                               /* Hz */
  char driver[64], model[64], serial[64], firmware[64];
} mvs_device_info;
MVS_API mvs_result mvs_device_get_info(const mvs_device *device, mvs_device_info *info);

/* What the user allows. Zero fields take the defaults in brackets; nothing exceeds the device's own
 * limits. */
typedef struct mvs_device_limits {
  uint32_t struct_size;
  uint32_t reserved;
  double force;            /* N [peak force of the device] */
  double continuous_force; /* N, that the motors may give on average [that of the device] */
  double thermal_s;        /* s, over which it is averaged; 0.1 to 1000 [10] */
  double slew;             /* N/s, how fast the force may change [100 times `force` a second] */
  double gate;             /* N, the force has to be below it for forces to begin [0.2] */
  double ramp_s;           /* s, in which they come up; 0.01 to 10 [1] */
  double speed;            /* m/s, above it forces latch off [that of the device, at most 1] */
  double stale_s;          /* s, a tissue model older than it fades; 0.005 to 10 [0.1] */
  double fade_s;           /* s, in which it does; 0.001 to 1 [0.05] */
  double stiffness;        /* N/m, the most that the hand feels [that of the device] */
} mvs_device_limits;
MVS_API mvs_result mvs_device_set_limits(mvs_device *device, const mvs_device_limits *limits);
MVS_API mvs_result mvs_device_get_limits(const mvs_device *device, mvs_device_limits *limits);

/* How the device's workspace lies in the scene: p = origin + scale * rotation * p_device; a force
 * in the scene is felt times `force_scale`. The stiffness felt is scale * force_scale times that of
 * the tissue: what of it would be above the limit is taken off the tool's spring. */
typedef struct mvs_device_view {
  uint32_t struct_size;
  uint32_t reserved;
  double origin[3];   /* m */
  double rotation[4]; /* quaternion w x y z, any length [1 0 0 0] */
  double scale;       /* 0.01 to 100 [1] */
  double force_scale; /* 0.001 to 1000 [1] */
} mvs_device_view;
MVS_API mvs_result mvs_device_set_view(mvs_device *device, const mvs_device_view *view);
MVS_API mvs_result mvs_device_get_view(const mvs_device *device, mvs_device_view *view);

/* What the hand does. */
enum mvs_hand_mode_e {
  MVS_HAND_MODE_LOOK = 0,  /* points at nodes and chordae, feels nothing */
  MVS_HAND_MODE_GRASP = 1, /* the button takes the nearest node, drags it, lets it go */
  MVS_HAND_MODE_BALL = 2,  /* pushes tissue with a ball */
  MVS_HAND_MODE_ROD = 3,   /* pushes with a rod along the stylus */
  MVS_HAND_MODE_FEEL = 4,  /* feels the tension of `chord` */
  MVS_HAND_MODE_DRAG = 5   /* the button takes the leaflet end of `chord`, to set its length */
};
typedef uint32_t mvs_hand_mode;

/* The hand's tool. Zero fields take the defaults in brackets. */
typedef struct mvs_device_hand {
  uint32_t struct_size;
  uint32_t mode;   /* MVS_HAND_MODE_* */
  mvs_id chord;    /* to feel or drag [the nearest one when the button goes down] */
  uint32_t button; /* that grasps, 0 the first */
  uint32_t reserved;
  double reach;     /* m, in the scene, to what the button takes [5e-3] */
  double radius;    /* m, of ball or rod [2e-3] */
  double length;    /* m, of the rod [40e-3] */
  double stiffness; /* N/m, of the spring between hand and tool, in the scene [200] */
  double max_force; /* N, of that spring, in the scene [5] */
  double gain;      /* of a felt chord's tension [1] */
} mvs_device_hand;
/* What the hand holds is let go at the next mvs_device_sync. */
MVS_API mvs_result mvs_device_set_hand(mvs_device *device, const mvs_device_hand *hand);
MVS_API mvs_result mvs_device_get_hand(const mvs_device *device, mvs_device_hand *hand);

/* Starts the servo: places are told, forces stay off until mvs_device_arm. */
MVS_API mvs_result mvs_device_start(mvs_device *device);

/* Stops it: zero force, motors off. */
MVS_API mvs_result mvs_device_stop(mvs_device *device);

/* Lets forces begin, by gate and ramp; also after they latched off, once the cause is over:
 * MVS_E_DEVICE says which one is not. */
MVS_API mvs_result mvs_device_arm(mvs_device *device);

/* Forces off now, with cause MVS_CAUSE_SOFTWARE. From any thread. */
MVS_API mvs_result mvs_device_cut(mvs_device *device);

/* On a virtual clock: runs the servo for a time, at its rate. */
MVS_API mvs_result mvs_device_advance(mvs_device *device, double seconds);

/* What happened in mvs_device_sync: bits of mvs_device_report.events. */
enum mvs_event_flags_e {
  MVS_EVENT_PRESSED = 1 << 0, /* the hand's button */
  MVS_EVENT_RELEASED = 1 << 1,
  MVS_EVENT_GRASPED = 1 << 2, /* `tool` holds `node` */
  MVS_EVENT_LET_GO = 1 << 3,
  MVS_EVENT_MISSED = 1 << 4,    /* nothing within reach of the button */
  MVS_EVENT_CHOSEN = 1 << 5,    /* `chord` is the one to feel or drag now */
  MVS_EVENT_DRAGGED = 1 << 6,   /* a chord was dragged: its leaflet end is to come to `drag_to`, for
                                   mvs_op_chord_length.drag_to */
  MVS_EVENT_LOST_TOOL = 1 << 7, /* an undo, an operation or a new valve took it away */
  MVS_EVENT_BLOCKED = 1 << 8,   /* a ball or rod would lie in tissue: move away to let it in */
  MVS_EVENT_LATCHED = 1 << 9    /* forces went off: see mvs_device_state.cause */
};
typedef uint32_t mvs_event_flags;

/* What the hand points at and did. */
typedef struct mvs_device_report {
  uint32_t struct_size;
  uint32_t events;            /* MVS_EVENT_* */
  mvs_id tool;                /* in the valve; 0: none */
  mvs_id chord;               /* chosen; 0: none */
  mvs_id near_chord;          /* nearest to the hand; 0: no chordae */
  double near_chord_distance; /* m */
  uint32_t near_node;         /* nearest free vertex of a leaflet; UINT32_MAX: none */
  uint32_t node;              /* held; UINT32_MAX: none */
  double near_node_distance;  /* m */
  double position[3];         /* m, of the hand */
  double force[3];            /* N, of the tissue on the hand, before it is scaled */
  double stiffness;           /* N/m, the largest that the device renders of it */
  double drag_to[3];          /* m */
} mvs_device_report;

/* Hand to valve, valve to hand; before each mvs_step. `report` is nullable. A hand whose tool went
 * with an undo or a new valve goes on without it. */
MVS_API mvs_result mvs_device_sync(mvs_device *device, mvs_sim *sim, mvs_device_report *report);

/* Where forces stand. */
enum mvs_device_phase_e {
  MVS_DEVICE_PHASE_STOPPED = 0,
  MVS_DEVICE_PHASE_OFF = 1, /* started, not armed */
  MVS_DEVICE_PHASE_WAITING =
      2, /* armed; the force of the tissue is above the gate: move the hand away */
  MVS_DEVICE_PHASE_RAMPING = 3,
  MVS_DEVICE_PHASE_ON = 4,
  MVS_DEVICE_PHASE_FADED = 5,  /* the simulation stands still */
  MVS_DEVICE_PHASE_LATCHED = 6 /* see `cause` */
};
typedef uint32_t mvs_device_phase;

/* What was done to the last force: bits of mvs_device_state.limited. */
enum mvs_limited_flags_e {
  MVS_LIMITED_FORCE = 1 << 0,      /* clamped */
  MVS_LIMITED_CONTINUOUS = 1 << 1, /* clamped so that the motors stay cool */
  MVS_LIMITED_SLEW = 1 << 2,
  MVS_LIMITED_ENERGY = 1 << 3, /* damped, as the loop had made energy */
  MVS_LIMITED_WALL = 1 << 4,   /* the wall of the workspace pushed */
  MVS_LIMITED_NUMBER = 1 << 5  /* a force was no number, and became zero */
};
typedef uint32_t mvs_limited_flags;

/* The servo as it is now. */
typedef struct mvs_device_state {
  uint32_t struct_size;
  uint32_t phase;        /* MVS_DEVICE_PHASE_* */
  uint32_t cause;        /* MVS_CAUSE_*, of a latch */
  uint32_t flags;        /* MVS_DRIVER_*, of the driver */
  uint32_t limited;      /* MVS_LIMITED_* */
  uint32_t buttons;      /* debounced */
  double time;           /* s, since mvs_device_start */
  double position[3];    /* m, in the scene */
  double orientation[4]; /* w x y z, from the stylus' axes to the scene */
  double velocity[3];    /* m/s, in the scene */
  double hand[3];        /* m, of the device */
  double force[3];       /* N, of the device: what the motors were told */
  double rate;           /* Hz, of late */
  double worst_period;   /* s, the longest between two ticks since mvs_device_start */
  double model_age;      /* s, of the tissue model; infinite: none yet */
  double energy;         /* J, that the loop made and damping has not yet taken out */
  double heat;           /* 0 cool .. 1 at the continuous limit */
  uint64_t ticks;        /* of the servo */
  uint64_t late;         /* ticks that came after more than two periods */
} mvs_device_state;
MVS_API mvs_result mvs_device_get_state(mvs_device *device, mvs_device_state *state);

/* One tick of the servo, of the device. */
typedef struct mvs_device_sample {
  double time;           /* s, since mvs_device_start */
  double position[3];    /* m */
  double orientation[4]; /* w x y z */
  double force[3];       /* N */
  double servo_s;        /* s, that the servo took for it; 0 on a virtual clock */
  double gripper;        /* rad */
  uint32_t buttons;      /* as the driver says */
  uint32_t limited;      /* MVS_LIMITED_* */
} mvs_device_sample;

/* Hands over the ticks since the last call, oldest first, at most `capacity`; the library keeps the
 * last 8192. *lost counts those that nobody fetched in time. */
MVS_API mvs_result mvs_device_trace(mvs_device *device, mvs_device_sample *samples,
                                    uint32_t capacity, uint32_t *count, uint64_t *lost);

/* With 1, zero force to every open device when the process gets a fatal signal (SIGSEGV, SIGBUS,
 * SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGINT), then on to the handler that was there; with 0, takes
 * that back. The library installs no handler unless asked. */
MVS_API mvs_result mvs_device_handle_signals(uint32_t on);

#ifdef __cplusplus
}
#endif
#endif
