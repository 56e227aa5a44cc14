/* The simulator: create it, give it a valve and a load, settle or step it, ask how it went.
 *
 * Different simulators are independent. One simulator is used by one thread at a time: a second
 * call while one is at work, from another thread or from a callback, gives MVS_E_STATE. What takes
 * a const mvs_snapshot *, and mvs_get_snapshot, may be called from any thread at any time. */
#ifndef MVS_SIM_H
#define MVS_SIM_H

#include "base.h"
#include "valve.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mvs_sim mvs_sim;

/* Logging levels. Failures are not logged: they are returned. */
enum mvs_log_level_e {
  MVS_LOG_ERROR = 1,
  MVS_LOG_WARNING = 2,
  MVS_LOG_INFO = 3,
  MVS_LOG_DEBUG = 4
};
typedef uint32_t mvs_log_level;

/* Sparse factorisations. */
enum mvs_backend_e {
  MVS_BACKEND_DEFAULT = 0, /* MVS_BACKEND_BLOCK in single precision where conjugate gradients make
                              good what that rounds: the fastest */
  MVS_BACKEND_CHOLMOD = 1, /* SuiteSparse CHOLMOD, simplicial LDL^T */
  MVS_BACKEND_EIGEN = 2,   /* Eigen SimplicialLDLT */
  MVS_BACKEND_BLOCK = 3    /* the library's own Cholesky on 3x3 blocks, in double precision */
};
typedef uint32_t mvs_backend;

/* How a simulator is made. A null pointer or all zeros are the defaults. */
typedef struct mvs_sim_desc {
  uint32_t struct_size;
  uint32_t backend; /* MVS_BACKEND_* */
  /* Called with one line of text, without its end of line. Nullable: silent. */
  void (*log)(void *user, int32_t level, const char *text);
  /* Called during long work with the share done in [0, 1] and the largest out-of-balance nodal
   * force in N; a non-zero return cancels. Nullable. */
  int32_t (*progress)(void *user, double share, double residual);
  void *user; /* handed to both */
} mvs_sim_desc;

/* Makes an empty simulator in *sim; mvs_destroy frees it. `desc` is nullable. MVS_E_UNSUPPORTED if
 * this build lacks the backend. */
MVS_API mvs_result mvs_create(const mvs_sim_desc *desc, mvs_sim **sim);

/* Frees a simulator that is not at work; snapshots taken from it stay valid. `sim` is nullable. */
MVS_API void mvs_destroy(mvs_sim *sim);

/* Replaces the valve by one given as arrays, at rest and without load; nothing of the caller's is
 * kept. MVS_E_OP names the first fault of a valve that is none; mvs_check_valve lists all of them.
 * What can be but hardly is, of a valve from arrays or a file or of another tissue, goes to the log
 * as MVS_LOG_WARNING: triangles like needles, and numbers that look like those of another unit. */
MVS_API mvs_result mvs_set_valve(mvs_sim *sim, const mvs_valve_desc *valve);

/* Replaces the valve by a parametric mitral valve. `desc` is nullable: the shipped valve.
 * MVS_E_ARGUMENT names the dimension that no valve can have. */
MVS_API mvs_result mvs_generate_valve(mvs_sim *sim, const mvs_parametric_desc *desc);

/* Called once for each fault of a valve: the part ("triangle 17") and a sentence; both are valid
 * during the call only. */
typedef void (*mvs_fault_fn)(void *user, const char *part, const char *sentence);

/* Says whether arrays are a valve, without any simulator: returns what mvs_set_valve would, and
 * reports every fault, not only the first. Faults that keep others from being looked for (an index
 * out of range) come alone. `fault` and `user` are nullable. */
MVS_API mvs_result mvs_check_valve(const mvs_valve_desc *valve, mvs_fault_fn fault, void *user);

/* Gives a leaflet, or all of them where `leaflet` is 0, another tissue: law, thickness and
 * constants of `tissue`, its name null and its id 0. A thickness of 0 leaves it, another one scales
 * that of each triangle. Constants of 0 take the law's defaults; MVS_LEAFLET_LAW_BILINEAR without
 * constants, on a leaflet of springs, becomes the membrane that follows the curve of those springs.
 * Shape, chordae and load stay; the history is emptied, as no operation can be undone into another
 * tissue. */
MVS_API mvs_result mvs_set_leaflet(mvs_sim *sim, mvs_id leaflet, const mvs_leaflet_desc *tissue);

/* The load on the valve. */
typedef struct mvs_load_case {
  uint32_t struct_size;
  uint32_t reserved;
  double pressure;          /* Pa, ventricle minus atrium, on every leaflet face, following it;
                               at most 400 kPa either way */
  double boundary_fraction; /* where annulus and heads are: 0 open .. 1 loaded position */
} mvs_load_case;

/* Sets the load that settle and step work towards; nothing moves yet. A new valve starts with
 * pressure and fraction 0. A pressure that looks like one in mmHg is warned of in the log. */
MVS_API mvs_result mvs_set_load(mvs_sim *sim, const mvs_load_case *load);

/* 120 mmHg in Pa (1 mmHg = 133.322 Pa): the default systolic load. */
#define MVS_SYSTOLE_PA 15998.64

/* Reads the load. */
MVS_API mvs_result mvs_get_load(const mvs_sim *sim, mvs_load_case *load);

/* Solvers. */
enum mvs_solver_e {
  MVS_SOLVER_NEWTON = 1,   /* static equilibrium: projected Newton on the potential (mvs_settle) */
  MVS_SOLVER_IMPLICIT = 2, /* backward Euler, a bounded amount of work a step */
  MVS_SOLVER_EXPLICIT = 3  /* symplectic Euler with penalty contact: the founding paper's method */
};
typedef uint32_t mvs_solver;

/* How to settle. Zero fields take the defaults in brackets. */
typedef struct mvs_settle_options {
  uint32_t struct_size;
  uint32_t solver;         /* MVS_SOLVER_* [newton] */
  uint32_t max_iterations; /* [1000 for newton, 20000 implicit, 2000000 explicit] */
  uint32_t reserved;
  double residual; /* N, largest out-of-balance force on a node at rest [1e-5] */
  double dt;       /* s, for the solvers that step in time [explicit 8e-6, implicit 1e-3] */
  double damping;  /* 1/s, mass-proportional, for the solvers in time [explicit 500] */
} mvs_settle_options;

/* Phases of the work, as indices of mvs_stats.phase_s. */
enum mvs_phase_e {
  MVS_PHASE_TERMS = 0,    /* energy, gradient and Hessian blocks of the terms */
  MVS_PHASE_BROAD = 1,    /* candidate pairs, and how they bound a step */
  MVS_PHASE_NARROW = 2,   /* distances */
  MVS_PHASE_ASSEMBLY = 3, /* blocks into the sparse matrix */
  MVS_PHASE_ORDERING = 4, /* symbolic analysis */
  MVS_PHASE_FACTOR = 5,
  MVS_PHASE_SOLVE = 6,
  MVS_PHASE_LINE_SEARCH = 7, /* trial energies, with their distances; those of an implicit step
                                count as terms, as forces come with them */
  MVS_PHASE_COUNT = 8
};
typedef uint32_t mvs_phase;

/* What a settle or step did not compute, because nothing needed it: bits of mvs_stats.skipped. None
 * of it changes a result. */
enum mvs_skipped_flags_e {
  MVS_SKIPPED_SPRINGS = 1 << 0, /* the first seven: the scene has none, or no load on it */
  MVS_SKIPPED_MEMBRANE = 1 << 1,
  MVS_SKIPPED_BENDING = 1 << 2,
  MVS_SKIPPED_CHORDAE = 1 << 3,
  MVS_SKIPPED_PRESSURE = 1 << 4,
  MVS_SKIPPED_CONTACT = 1 << 5, /* nothing came near enough to look for distances */
  MVS_SKIPPED_TOOLS = 1 << 6,
  MVS_SKIPPED_BROAD = 1 << 7,    /* the candidate pairs known before were still all */
  MVS_SKIPPED_ORDERING = 1 << 8, /* the pattern of the matrix was known */
  MVS_SKIPPED_FACTOR = 1 << 9,   /* an earlier factorisation served as preconditioner */
  MVS_SKIPPED_STEP = 1 << 10     /* at rest, and nothing changed: only time went on */
};
typedef uint32_t mvs_skipped_flags;

/* What a step gave up to stay within its budget, in this order: bits of mvs_stats.lowered. Bounds
 * against crossing and the bound on energy are never given up. */
enum mvs_lowered_flags_e {
  MVS_LOWERED_LINEAR = 1 << 0, /* the linear system was solved less accurately */
  MVS_LOWERED_STEP = 1 << 1    /* the nodes went a part of their way, or none of it */
};
typedef uint32_t mvs_lowered_flags;

/* How the last settle or step went. */
typedef struct mvs_stats {
  uint32_t struct_size;
  uint32_t converged;      /* 1: residual reached */
  uint32_t iterations;     /* Newton iterations, or steps in time */
  uint32_t factorisations; /* those done in parts, over several steps, count in the last one */
  uint32_t contact_pairs;  /* active at the end */
  uint32_t shifted;        /* iterations whose matrix needed a shift to be positive definite */
  double residual;         /* N, largest out-of-balance force on a free node or point of a tool */
  double energy;           /* J, total potential at the end */
  double kinetic;          /* J */
  double wall_s;
  double phase_s[MVS_PHASE_COUNT];
  uint32_t skipped;      /* MVS_SKIPPED_*: what was never computed in the whole settle or step */
  uint32_t lowered;      /* MVS_LOWERED_* */
  uint32_t broad_phases; /* how often candidate pairs were looked for */
  uint32_t orderings;    /* new patterns of the matrix, and symbolic analyses */
  uint32_t linear_iterations; /* of iterative solutions on top of a factorisation */
  uint32_t passes;            /* energies, gradients and matrices over all the terms */
} mvs_stats;

/* Brings the valve to static equilibrium under the load. Not converged is not an error: the valve
 * is then where the work ended, and stats->converged is 0. MVS_E_CANCELLED if the progress callback
 * asked to stop, MVS_E_DIVERGED if numbers left their range. `options` and `stats` are nullable. */
MVS_API mvs_result mvs_settle(mvs_sim *sim, const mvs_settle_options *options, mvs_stats *stats);

/* How to step. Zero fields take the defaults in brackets. */
typedef struct mvs_step_options {
  uint32_t struct_size;
  uint32_t solver; /* MVS_SOLVER_IMPLICIT [default] or MVS_SOLVER_EXPLICIT */
  double dt;       /* s [implicit 1e-3, explicit 8e-6]; 1e-9 to 1 */
  double damping;  /* 1/s, mass-proportional [0 implicit, 500 explicit] */
  /* The most passes over the terms and solutions with the factor in an implicit step, 4 to 10000
   * [64]. Counted, not timed, so that the same calls give the same bits on any machine; what a
   * short budget lowers is in mvs_stats.lowered. */
  uint32_t budget;
  uint32_t reserved;
} mvs_step_options;

/* Advances by one time step: one bounded amount of work, without progress callbacks, and, once a
 * valve has been stepped a few times, without allocation or system call while nobody holds a
 * snapshot of it. What an operation, a group that ends or a tool that comes or goes changes for the
 * next step is done in that call if the valve is stepped. MVS_E_DIVERGED if numbers left their
 * range: take a smaller dt. `options` is nullable. */
MVS_API mvs_result mvs_step(mvs_sim *sim, const mvs_step_options *options);

/* Reads the statistics of the last settle or step of this valve; MVS_E_STATE if there was none. */
MVS_API mvs_result mvs_get_stats(const mvs_sim *sim, mvs_stats *stats);

#ifdef __cplusplus
}
#endif
#endif
