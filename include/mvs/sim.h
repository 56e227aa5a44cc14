/* The simulator: create it, set a valve and a load, settle or step it, read statistics.
 *
 * Different simulators are independent. One simulator is used by one thread at a time: a second
 * call during a call, from another thread or from a callback, gives MVS_E_STATE. A callback may
 * call mvs_get_stats and mvs_get_profile, which give the figures before the call. mvs_get_snapshot,
 * all functions of a const mvs_snapshot *, mvs_check_op, mvs_check_plan, mvs_move_tool,
 * mvs_move_tool_pose and mvs_get_tool may be called from any thread at any time. */
#ifndef MVS_SIM_H
#define MVS_SIM_H

#include "base.h"
#include "valve.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mvs_sim mvs_sim;

/* Logging levels. Failures are returned, not logged. */
enum mvs_log_level_e {
  MVS_LOG_ERROR = 1,
  MVS_LOG_WARNING = 2,
  MVS_LOG_INFO = 3,
  MVS_LOG_DEBUG = 4
};
typedef uint32_t mvs_log_level;

/* Sparse factorisations. */
enum mvs_backend_e {
  MVS_BACKEND_DEFAULT = 0, /* the fastest: block Cholesky in single precision as preconditioner of
                              conjugate gradients in double precision */
  MVS_BACKEND_CHOLMOD = 1, /* SuiteSparse CHOLMOD, simplicial LDL^T */
  MVS_BACKEND_EIGEN = 2,   /* Eigen SimplicialLDLT */
  MVS_BACKEND_BLOCK = 3    /* the library's own Cholesky on 3x3 blocks, in double precision */
};
typedef uint32_t mvs_backend;

/* One task of a loop that a host's pool runs, see mvs_sim_desc.run_tasks. */
typedef void (*mvs_task_fn)(void *context, uint32_t index);

/* Largest number of threads that share the work of one simulator. */
#define MVS_MAX_WORKERS 256

/* Options of a new simulator. */
typedef struct mvs_sim_desc {
  uint32_t struct_size;
  mvs_backend backend; /* MVS_BACKEND_* */
  /* Receives one line of text without its end of line. Nullable: silent. */
  void (*log)(void *user, mvs_log_level level, const char *text);
  /* Receives, during long calls, the completed share in [0, 1] and the largest out-of-balance nodal
   * force in N; a non-zero return value cancels the call. Nullable. */
  int32_t (*progress)(void *user, double share, double residual);
  void *user; /* passed to all callbacks */
  /* Threads that share the work of mvs_settle, mvs_advance_settle, mvs_step, mvs_build_valve and
   * mvs_find_leak_interval, the calling one included, at most MVS_MAX_WORKERS; 0 and 1: the calling
   * thread alone. Results have the same bits for any number. The library starts its threads in the
   * first loop that is long enough to be shared (in valves of more than about a thousand vertices;
   * in a build the closures of its variants), and joins them in mvs_destroy.
   * They run no callback, block all signals but those of a fault of their own (SIGSEGV, SIGBUS,
   * SIGFPE, SIGILL), and sleep between calls. Where there are no threads, as in WebAssembly, or the
   * system grants fewer, the others do the work. A process made by fork() has none of them and must
   * not destroy the simulator. */
  uint32_t workers;
  uint32_t reserved; /* 0 */
  /* A thread pool of the host instead of `workers`, which is 0 then: both callbacks or none. They
   * are called on the thread of the call, and do not call the simulator. `pool_width` returns how
   * many tasks the pool can run at the same time, the calling thread included: 1 to
   * MVS_MAX_WORKERS; it is asked at the start of each call. Nullable. */
  uint32_t (*pool_width)(void *user);
  /* Calls task(context, index) for each index below `count`, in any order, on any threads, and
   * returns when all have returned. A loop takes tens of microseconds or more. A pool that runs
   * fewer tasks, runs one twice, or returns early changes no bit of a result: the calling thread
   * does the remaining work, and a late task returns at once; none may come after mvs_destroy.
   * A C++ exception that leaves the callback ends the call with MVS_E_INTERNAL. Nullable. */
  void (*run_tasks)(void *user, uint32_t count, mvs_task_fn task, void *context);
} mvs_sim_desc;

/* Creates an empty simulator in *sim; mvs_destroy frees it. `desc` is nullable. MVS_E_UNSUPPORTED
 * if this build lacks the backend; MVS_E_ARGUMENT for too many workers or half of a pool. */
MVS_API mvs_result mvs_create(const mvs_sim_desc *desc, mvs_sim **sim);

/* Frees a simulator outside of any call on it; its snapshots stay valid. `sim` is nullable. */
MVS_API void mvs_destroy(mvs_sim *sim);

/* Replaces the valve by one described by arrays, at rest and without load. The arrays are copied.
 * MVS_E_OP names the first fault of an invalid valve; mvs_check_valve reports all faults.
 *
 * A variant of the present valve shares with it what depends on the mesh alone: topology, the
 * checks of the mesh, the coarser meshes of mvs_settle. A variant has the same nodes, triangles,
 * leaflets, fibres, annulus and heads, and chordae of the same kinds between the same nodes; rest
 * lengths, laws, constants, thickness, names and the load may differ (other thickness: no shared
 * coarser meshes). To close many variants fast, restore each simulator (mvs_restore) to a snapshot
 * of one of them first; it may be one simulator, or several in threads. mvs_load_file,
 * mvs_set_leaflet and operations share in the same way. It changes no bit.
 *
 * Suspicious input is logged as MVS_LOG_WARNING, also by mvs_load_file and mvs_set_leaflet:
 * needle-shaped triangles, tissue that crosses or touches itself at rest, and numbers that look
 * like those of another unit. */
MVS_API mvs_result mvs_set_valve(mvs_sim *sim, const mvs_valve_desc *valve);

/* Replaces the valve by a parametric mitral valve. `desc` is nullable: the default valve.
 * MVS_E_ARGUMENT names an impossible dimension. Its rest shape is no equilibrium without load:
 * chordae are taut there (libmvs/anatomy/PARAMETRIC.md), and a settle at zero pressure moves it. */
MVS_API mvs_result mvs_generate_valve(mvs_sim *sim, const mvs_parametric_desc *desc);

/* Receives one fault of a valve: the part ("triangle 17") and a sentence, valid during the callback
 * only. */
typedef void (*mvs_fault_fn)(void *user, const char *part, const char *sentence);

/* Checks a valve without a simulator: returns the result that mvs_set_valve would return, and
 * reports every fault. Faults that prevent further checks (an index out of range) are reported
 * alone. With MVS_OK the sentences are warnings: triangles that cross, needles, edges shorter than
 * the contact thickness. `fault` and `user` are nullable. */
MVS_API mvs_result mvs_check_valve(const mvs_valve_desc *valve, mvs_fault_fn fault, void *user);

/* Changes the tissue of a leaflet, of all leaflets if `leaflet` is 0: law, thickness and constants
 * of `tissue`, whose name is null and whose id is 0. A thickness of 0 keeps the present one;
 * another thickness scales that of each triangle. Constants of 0 take the law's defaults, -0.0 is
 * zero; MVS_LEAFLET_LAW_BILINEAR without constants, on a leaflet of springs, becomes the membrane
 * that follows the curve of those springs. Shape, chordae and load do not change; the history is
 * emptied, because operations cannot be undone into another tissue, and an open journal ends.
 * MVS_E_ID if the leaflet does not exist, MVS_E_OP for constants that the law cannot have. */
MVS_API mvs_result mvs_set_leaflet(mvs_sim *sim, mvs_id leaflet, const mvs_leaflet_desc *tissue);

/* Load on the valve. */
typedef struct mvs_load_case {
  uint32_t struct_size;
  uint32_t reserved;
  double pressure;          /* Pa, ventricle minus atrium, on every leaflet face, following it;
                               at most 400 kPa either way */
  double boundary_fraction; /* position of annulus and heads: 0 open .. 1 loaded */
} mvs_load_case;

/* Sets the load for the next settle or step; nothing moves yet. A new valve has pressure 0 and
 * fraction 0. A pressure that looks like a value in mmHg is logged as MVS_LOG_WARNING.
 * The history records loads for plans. Each change of the load with a step after it takes 290 bytes
 * of memory (260 MB an hour at 250 steps a second) and 150 bytes in a plan; changes without a step
 * or settle between them are one. The same load again, without an operation in between, records
 * and changes nothing. A settle takes 130 bytes, also at rest. */
MVS_API mvs_result mvs_set_load(mvs_sim *sim, const mvs_load_case *load);

/* 120 mmHg in Pa (1 mmHg = 133.322 Pa): the default systolic load. */
#define MVS_SYSTOLE_PA 15998.64

/* Reads the load. */
MVS_API mvs_result mvs_get_load(const mvs_sim *sim, mvs_load_case *load);

/* Solvers. */
enum mvs_solver_e {
  MVS_SOLVER_NEWTON = 1,   /* static equilibrium: Newton's method in a trust region (mvs_settle) */
  MVS_SOLVER_IMPLICIT = 2, /* backward Euler, a bounded amount of work a step */
  MVS_SOLVER_EXPLICIT = 3  /* symplectic Euler with penalty contact: the founding paper's method */
};
typedef uint32_t mvs_solver;

/* Parts of a settle that may be left out; the valve at its end has the same bits. */
enum mvs_settle_flags_e {
  /* Leaves out the stability margins, which take a tenth of the time of a settle after an
   * operation. They are 0 in mvs_stats; mvs_snapshot_get_stability computes them. */
  MVS_SETTLE_NO_MARGINS = 1 << 0
};
typedef uint32_t mvs_settle_flags;

/* Options of mvs_settle. */
typedef struct mvs_settle_options {
  uint32_t struct_size;
  mvs_solver solver;       /* MVS_SOLVER_* [newton] */
  uint32_t max_iterations; /* [1000 for newton, 20000 implicit, 2000000 explicit] */
  mvs_settle_flags flags;  /* MVS_SETTLE_* */
  double residual;         /* N, largest out-of-balance force on a node at rest, 1e-12 to 1e3
                              [1e-5] */
  double dt; /* s, time step of the dynamic solvers [implicit 1e-3; explicit: stable on this valve,
                at most 8e-6]; 1e-9 to 1 */
  double damping; /* 1/s, mass-proportional, of the dynamic solvers, 1e-6 to 1e6 [explicit 500] */
} mvs_settle_options;

/* Accuracy that a step gave up, in this order: bits of mvs_stats.lowered.
 * The bounds against crossing and the bound on energy always hold. */
enum mvs_lowered_flags_e {
  MVS_LOWERED_LINEAR = 1 << 0, /* the linear system was solved less accurately, for the budget */
  MVS_LOWERED_STEP = 1 << 1    /* the nodes moved by a part of their step, or not at all: for the
                                  budget, or because contact held some of them back */
};
typedef uint32_t mvs_lowered_flags;

/* Outcome of a settle or step (fields: MVS_STRUCT_STATS). */
typedef struct mvs_stats {
  uint32_t struct_size;
  uint32_t converged;     /* 1: at rest, as the last settle, or a step that found nothing to move,
                             decided, and nothing has changed since */
  uint32_t iterations;    /* Newton iterations, or time steps */
  uint32_t contact_pairs; /* active contact pairs at the end */
  mvs_lowered_flags lowered; /* MVS_LOWERED_*: accuracy that a step gave up */
  uint32_t
      stable; /* 1: the last settle found a stable equilibrium, and nothing has changed since */
  double residual; /* N, largest out-of-balance force on a free node or tool point. An explicit step
                      finds its forces once, at its start: residual and energy are of that state */
  double energy;   /* J, potential energy at the end, of tissue with a node that moves. Without the
                      work of the pressure at the free edge, which has no potential: derivatives of
                      the energy differ from forces there */
  double kinetic;  /* J, kinetic energy at the end */
  double wall_s;   /* s, elapsed time */
  /* Margins of mvs_stability at the last equilibrium that a settle found; 0 where none was found,
   * and at a stable one with MVS_SETTLE_NO_MARGINS. */
  double stiffness_margin; /* N/m */
  double growth_rate;      /* 1/s */
} mvs_stats;

/* Moves the valve to stable static equilibrium under the load: an unstable one (mvs_stability) is
 * left along its mode; a valve that always returns to it (its free edge flutters) stays there.
 * Ending without convergence is not an error: stats->converged is 0, the valve is at the last
 * iterate, or at that equilibrium with growth_rate > 0. MVS_E_CANCELLED if the progress callback
 * cancelled, MVS_E_DIVERGED if numbers left their range, or if a leaflet grows to ten times its
 * area because its law cannot bear the pressure. `options` and `stats` are nullable. A chord that
 * an operation of the history attached and that carries no force at rest under pressure is logged
 * as MVS_LOG_WARNING: its rest length is too long to hold the leaflet. */
MVS_API mvs_result mvs_settle(mvs_sim *sim, const mvs_settle_options *options, mvs_stats *stats);

/* Begins a settle in slices, for a host whose only thread has to answer in between (the worker of a
 * browser, a window). The result has the same bits as that of mvs_settle. Until the end the valve
 * is as before: it may be read. A call that replaces the present snapshot cancels the settle: one
 * that changes valve, state, tools or history, also mvs_set_load with the same load,
 * mvs_begin_group, mvs_set_checkpoint, mvs_replay_plan and mvs_recover_journal. Replaces a settle
 * already begun. `options` is nullable. */
MVS_API mvs_result mvs_begin_settle(mvs_sim *sim, const mvs_settle_options *options);

/* Advances the settle for `seconds`, 0 to 3600, and at least one iteration of Newton's method or
 * one step in time. *share is the completed share in [0, 1]; 1: the settle has ended, the valve is
 * that of mvs_settle, and `stats` is written. MVS_E_STATE if no settle is under way. The codes of
 * mvs_settle, and the progress callback if it cancels, end the settle; the valve is as before.
 * `share` and `stats` are nullable. */
MVS_API mvs_result mvs_advance_settle(mvs_sim *sim, double seconds, double *share,
                                      mvs_stats *stats);

/* Cancels a settle in slices, if one is under way. */
MVS_API mvs_result mvs_cancel_settle(mvs_sim *sim);

/* Options of mvs_step. */
typedef struct mvs_step_options {
  uint32_t struct_size;
  mvs_solver solver; /* MVS_SOLVER_IMPLICIT [default] or MVS_SOLVER_EXPLICIT */
  double dt;         /* s [as for mvs_settle]; 1e-9 to 1 */
  double damping;    /* 1/s, mass-proportional [0 implicit, 500 explicit] */
  /* Largest amount of work of an implicit step, 4 to 10000 [64]: energy passes, assemblies,
   * iterations of conjugate gradients, factorisations or parts of one. A count, not a time, so that
   * the same calls give the same bits on any machine; mvs_stats.lowered reports the accuracy that a
   * short budget costs. Searches for contact are not counted: on thousands of vertices they may
   * take most of a step beside a tool that moves. */
  uint32_t budget;
  uint32_t reserved;
} mvs_step_options;

/* Advances by one time step: a bounded amount of work without progress callbacks. Once its buffers
 * hold the contact that the motion makes (up to 100 steps after a change) it makes no allocation
 * and no system call while no snapshot of the valve is held and no hand has moved. An operation,
 * mvs_end_group, undo, redo, mvs_restore_checkpoint, or adding or removing a tool prepares the next
 * step of a valve that is being stepped within its own call. MVS_E_DIVERGED if numbers left their
 * range: use a smaller dt; MVS_E_UNSUPPORTED for the explicit solver with a tool that pushes, as of
 * mvs_settle. `options` is nullable. */
MVS_API mvs_result mvs_step(mvs_sim *sim, const mvs_step_options *options);

/* Does now what the first mvs_step from here would do for the steps after it: memory, the search
 * for contact, an elimination order and a factor, several times the work of a step. For a valve
 * that is about to be stepped in real time, after mvs_settle, another load, a snapshot or a file.
 * Changes nothing but the time of the steps, whose options these are. The errors of mvs_step.
 * `options` is nullable. */
MVS_API mvs_result mvs_prepare_step(mvs_sim *sim, const mvs_step_options *options);

/* Reads the statistics of the last settle or step of this valve; MVS_E_STATE before the first.
 * `converged` is 1 while the valve is at rest: an operation, another load or a tool makes it 0
 * until the next settle, or a step that finds nothing to move; so does a step that moves it. */
MVS_API mvs_result mvs_get_stats(const mvs_sim *sim, mvs_stats *stats);

#ifdef __cplusplus
}
#endif
#endif
