/* The spread: how much of what a closed valve measures is fold.
 *
 * A closed valve is not unique: slack tissue can pleat in several ways, all of them at rest. Which
 * one is found depends on the way there, so a figure of one closure is one of several that are as
 * right. mvs_ensemble_run closes a valve along several paths, which differ in how pressure and
 * boundary arrive and in small disturbances of the start, and tells how far their shapes and
 * figures lie apart. It is the spread of the model as it is, over these paths: neither a bound nor
 * the error of the model.
 *
 * Path 0 is the plain closure: the bits that mvs_settle gives under this load. The same snapshot,
 * load, options and seed give the same bits. No simulator is needed and none changes; a spread
 * never changes once made, so that it may be read from any thread. */
#ifndef MVS_ENSEMBLE_H
#define MVS_ENSEMBLE_H

#include "base.h"
#include "sim.h"
#include "snapshot.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mvs_ensemble mvs_ensemble;

/* Where the paths after the first begin. */
enum mvs_ensemble_start_e {
  MVS_ENSEMBLE_START_REST = 1,    /* the rest shape, unloaded, boundary open: how a valve closes */
  MVS_ENSEMBLE_START_SNAPSHOT = 2 /* the snapshot as it lies: what is near it */
};
typedef uint32_t mvs_ensemble_start;

/* How to spread. A null pointer or zero fields take the defaults in brackets. */
typedef struct mvs_ensemble_options {
  uint32_t struct_size;
  uint32_t paths;      /* closures, the plain one included [8]; 1 to 1000 */
  uint32_t from;       /* MVS_ENSEMBLE_START_* [rest] */
  uint32_t backend;    /* MVS_BACKEND_* */
  uint64_t seed;       /* of the disturbances: any number */
  double perturbation; /* m, the longest way a node of the start is moved [0.5e-3]; at most 5e-3;
                          negative: not at all */
  double wavelength;   /* m, the shortest wave of a disturbance [5e-3]; 1e-4 to 1 */
  double same;         /* m, two shapes no node of which is farther apart are one equilibrium
                          [0.1e-3] */
  /* As in mvs_sim_desc, over all paths. Nullable. */
  int32_t (*progress)(void *user, double share, double residual);
  void *user;
} mvs_ensemble_options;

/* Closes the valve of a snapshot along several paths and keeps all that came out in *spread;
 * mvs_ensemble_release frees it. A path that does not come to rest, or leaves the range of numbers,
 * is told by its path and counts nowhere else; for path 0 leaving the range of numbers is the
 * failure MVS_E_DIVERGED. MVS_E_CANCELLED if the progress callback asked to stop. `settle` and
 * `options` are nullable. */
MVS_API mvs_result mvs_ensemble_run(const mvs_snapshot *start, const mvs_load_case *load,
                                    const mvs_settle_options *settle,
                                    const mvs_ensemble_options *options, mvs_ensemble **spread);

/* Frees a spread; snapshots taken from it stay valid. Accepts null. */
MVS_API void mvs_ensemble_release(mvs_ensemble *spread);

/* What all paths show together. Shapes are those of the leaflets, as they lie. */
typedef struct mvs_ensemble_summary {
  uint32_t struct_size;
  uint32_t paths;
  uint32_t converged;  /* paths at rest: all that follows is over these */
  uint32_t equilibria; /* distinct shapes among them */
  uint32_t lowest;     /* the path whose potential is the lowest; UINT32_MAX: none is at rest */
  uint32_t reserved;
  double node_rms;    /* m, node to node, RMS over all pairs of paths */
  double node_max;    /* m, the farthest that any node is apart in any two paths */
  double surface_rms; /* m, surface distance from path 0, RMS over the other paths */
  double surface_max; /* m, the largest distance from the surface of path 0 */
} mvs_ensemble_summary;

/* Figures without a pair are 0: fewer than two paths at rest, or, for those from path 0, path 0
 * itself not at rest. */
MVS_API mvs_result mvs_ensemble_get_summary(const mvs_ensemble *spread,
                                            mvs_ensemble_summary *summary);

/* When the boundary (annulus and heads) goes to where the load wants it. */
enum mvs_ensemble_order_e {
  MVS_ENSEMBLE_ORDER_TOGETHER = 1,       /* in step with the pressure */
  MVS_ENSEMBLE_ORDER_BOUNDARY_FIRST = 2, /* before the pressure */
  MVS_ENSEMBLE_ORDER_PRESSURE_FIRST = 3  /* after the pressure */
};
typedef uint32_t mvs_ensemble_order;

/* One path. */
typedef struct mvs_ensemble_member {
  uint32_t struct_size;
  uint32_t converged;   /* 1: at rest */
  uint32_t increments;  /* equal steps in which the pressure came */
  uint32_t order;       /* MVS_ENSEMBLE_ORDER_TOGETHER ... */
  uint32_t equilibrium; /* number of its shape, 0 is that of the first path at rest; UINT32_MAX: not
                           at rest */
  uint32_t diverged;    /* 1: it left the range of numbers; its snapshot is where it began */
  double perturbation;  /* m, the longest way a node of its start was moved */
  double node_rms, node_max;       /* m, node to node from path 0 */
  double surface_rms, surface_max; /* m, symmetric surface distance from path 0 */
  double ramp; /* s, the time in which the pressure came, with inertia, before the valve settled;
                  0: it settled after each increment */
} mvs_ensemble_member;

MVS_API mvs_result mvs_ensemble_get_member(const mvs_ensemble *spread, uint32_t path,
                                           mvs_ensemble_member *found);

/* How a path was settled: counts and times over all its increments, the rest at its end. */
MVS_API mvs_result mvs_ensemble_get_member_stats(const mvs_ensemble *spread, uint32_t path,
                                                 mvs_stats *stats);

/* The closed valve of a path, for measures, arrays, files; release it. That of path 0 goes on with
 * the history of the start; the others begin a history of their own. */
MVS_API mvs_result mvs_ensemble_get_member_snapshot(const mvs_ensemble *spread, uint32_t path,
                                                    const mvs_snapshot **snapshot);

/* Statistics over the paths at rest. */
enum mvs_ensemble_statistic_e {
  MVS_ENSEMBLE_STATISTIC_MEAN = 1,
  MVS_ENSEMBLE_STATISTIC_MIN = 2,
  MVS_ENSEMBLE_STATISTIC_MAX = 3,
  MVS_ENSEMBLE_STATISTIC_DEVIATION =
      4,                           /* standard, of the paths as a sample: sqrt(sum / (n - 1)) */
  MVS_ENSEMBLE_STATISTIC_COUNT = 5 /* n: how many paths have this figure */
};
typedef uint32_t mvs_ensemble_statistic;

/* A statistic of every figure of mvs_measures, in the units of that struct. A figure that no path
 * has, a mean of none, a deviation of fewer than two are NaN. Figures that are counts are rounded
 * to whole numbers, and 0 instead of NaN. */
MVS_API mvs_result mvs_ensemble_measure(const mvs_ensemble *spread, uint32_t statistic,
                                        mvs_measures *measures);

/* The arrays of a spread: n nodes, p paths. */
enum mvs_ensemble_array_e {
  MVS_ENSEMBLE_ARRAY_NODE_DEVIATION =
      1, /* F64 n, m: RMS distance of each node from its mean place */
  MVS_ENSEMBLE_ARRAY_PAIR_DISTANCE =
      2 /* F64 p x p, m: node RMS between every two paths, at rest or not */
};
typedef uint32_t mvs_ensemble_array;

/* Shows one array, zero-copy, valid until the spread is released. */
MVS_API mvs_result mvs_ensemble_get_array(const mvs_ensemble *spread, uint32_t which,
                                          mvs_view *view);

#ifdef __cplusplus
}
#endif
#endif
