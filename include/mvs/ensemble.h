/* Ensembles: the spread of equilibria of one closed valve. Experimental (experimental.h).
 *
 * A closed valve is not unique: slack tissue can fold in several ways, each of them at rest. The
 * fold that a closure finds depends on its loading path, so that a measure of one closure is one of
 * several equally valid values. mvs_ensemble_run closes a valve along several loading paths, which
 * differ in the order of pressure and boundary motion and in small perturbations of the initial
 * shape, and reports the distances between the resulting shapes and the statistics of their
 * measures. The result describes the model over these paths; it is neither a bound nor the error of
 * the model.
 *
 * Member 0 is the plain closure with the bits of mvs_settle under this load. The same snapshot,
 * load, options and seed give the same bits. No simulator is needed and none changes. An ensemble
 * is immutable and may be read from any thread. */
#ifndef MVS_ENSEMBLE_H
#define MVS_ENSEMBLE_H

#include "base.h"
#include "profile.h"
#include "sim.h"
#include "snapshot.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mvs_ensemble mvs_ensemble;

/* Initial shape of members 1, 2, ... */
enum mvs_ensemble_start_e {
  MVS_ENSEMBLE_START_REST = 1,    /* the rest shape, unloaded, boundary open: a full closure */
  MVS_ENSEMBLE_START_SNAPSHOT = 2 /* the shape of the snapshot: equilibria near it */
};
typedef uint32_t mvs_ensemble_start;

/* mvs_ensemble_options.flags */
enum mvs_ensemble_flags_e {
  MVS_ENSEMBLE_FLAG_UNPERTURBED = 1 << 0 /* initial shapes are not perturbed; perturbation is 0 */
};
typedef uint32_t mvs_ensemble_flags;

/* Options of mvs_ensemble_run. */
typedef struct mvs_ensemble_options {
  uint32_t struct_size;
  uint32_t members;         /* closures, the plain one included [8]; 1 to 1000 */
  mvs_ensemble_start start; /* MVS_ENSEMBLE_START_* [rest] */
  mvs_backend backend;      /* MVS_BACKEND_* */
  mvs_ensemble_flags flags; /* MVS_ENSEMBLE_FLAG_* */
  uint32_t reserved;
  uint64_t seed;       /* of the perturbations: any number */
  double perturbation; /* m, largest displacement of a node of the initial shape [0.5e-3]; at most
                          5e-3 */
  double wavelength;   /* m, shortest wavelength of a perturbation [5e-3]; 1e-4 to 1 */
  double tolerance;    /* m, shapes with no node farther apart are one equilibrium [0.1e-3] */
  /* As in mvs_sim_desc, over all members. Nullable. */
  int32_t (*progress)(void *user, double share, double residual);
  void *user;
} mvs_ensemble_options;

/* Closes the valve of a snapshot once per member and stores the results in *ensemble;
 * mvs_ensemble_release frees it. A member that does not converge or diverges is marked and excluded
 * from all statistics; divergence of member 0 is the failure MVS_E_DIVERGED. MVS_E_CANCELLED if the
 * progress callback cancelled. settle->max_iterations limits the last settle of a member, not those
 * on its way. `settle` and `options` are nullable. */
MVS_API mvs_result mvs_ensemble_run(const mvs_snapshot *start, const mvs_load_case *load,
                                    const mvs_settle_options *settle,
                                    const mvs_ensemble_options *options, mvs_ensemble **ensemble);

/* Frees an ensemble; snapshots taken from it stay valid. `ensemble` is nullable. */
MVS_API void mvs_ensemble_release(mvs_ensemble *ensemble);

/* Summary over the members at rest. Shapes are those of the leaflets without registration. Figures
 * without a pair are 0: fewer than two members at rest or, for distances from member 0, member 0
 * not at rest. */
typedef struct mvs_ensemble_summary {
  uint32_t struct_size;
  uint32_t members;
  uint32_t converged;  /* members at rest */
  uint32_t equilibria; /* distinct shapes among them; a shape and its mirror image, both equilibria
                          of a symmetric valve, are two */
  uint32_t lowest;     /* the member of lowest potential energy; UINT32_MAX without one at rest */
  uint32_t reserved;
  double node_rms;    /* m, node to node, RMS over all pairs of members */
  double node_max;    /* m, largest distance of one node between any two members */
  double surface_rms; /* m, surface distance from member 0, RMS over the other members */
  double surface_max; /* m, largest distance from the surface of member 0 */
} mvs_ensemble_summary;

/* Reads the summary. */
MVS_API mvs_result mvs_ensemble_get_summary(const mvs_ensemble *ensemble,
                                            mvs_ensemble_summary *summary);

/* Motion of the boundary (annulus and heads) relative to the pressure. */
enum mvs_ensemble_order_e {
  MVS_ENSEMBLE_ORDER_TOGETHER = 1,       /* in proportion to the pressure */
  MVS_ENSEMBLE_ORDER_BOUNDARY_FIRST = 2, /* before the pressure */
  MVS_ENSEMBLE_ORDER_PRESSURE_FIRST = 3  /* after the pressure */
};
typedef uint32_t mvs_ensemble_order;

/* One member. */
typedef struct mvs_ensemble_member {
  uint32_t struct_size;
  uint32_t converged;       /* 1: at rest */
  uint32_t increments;      /* equal pressure increments */
  mvs_ensemble_order order; /* MVS_ENSEMBLE_ORDER_* */
  uint32_t equilibrium; /* number of its shape, 0 for the first member at rest; UINT32_MAX: not at
                           rest */
  uint32_t diverged;    /* 1: numbers left their range; its snapshot is the initial one */
  double perturbation;  /* m, largest displacement of a node of its initial shape */
  double node_rms, node_max;       /* m, node to node from member 0 */
  double surface_rms, surface_max; /* m, symmetric surface distance from member 0 */
  double ramp; /* s, duration of a dynamic pressure ramp before settling; 0: settled after each
                  increment */
} mvs_ensemble_member;

/* Read one member, 0 to members - 1: its outcome, and its statistics and profile summed over all
 * increments with the residual at its end. */
MVS_API mvs_result mvs_ensemble_get_member(const mvs_ensemble *ensemble, uint32_t index,
                                           mvs_ensemble_member *member);
MVS_API mvs_result mvs_ensemble_get_member_stats(const mvs_ensemble *ensemble, uint32_t index,
                                                 mvs_stats *stats);
MVS_API mvs_result mvs_ensemble_get_member_profile(const mvs_ensemble *ensemble, uint32_t index,
                                                   mvs_profile *profile);

/* Returns the closed valve of a member; release it with mvs_snapshot_release. Member 0 continues
 * the history of the start; the others begin a new history. */
MVS_API mvs_result mvs_ensemble_get_member_snapshot(const mvs_ensemble *ensemble, uint32_t index,
                                                    const mvs_snapshot **snapshot);

/* Statistics over the members at rest. */
enum mvs_ensemble_statistic_e {
  MVS_ENSEMBLE_STATISTIC_MEAN = 1,
  MVS_ENSEMBLE_STATISTIC_MIN = 2,
  MVS_ENSEMBLE_STATISTIC_MAX = 3,
  MVS_ENSEMBLE_STATISTIC_DEVIATION = 4, /* standard deviation of the sample: sqrt(sum / (n - 1)) */
  MVS_ENSEMBLE_STATISTIC_COUNT = 5      /* n: members that have this figure */
};
typedef uint32_t mvs_ensemble_statistic;

/* Returns a statistic of every figure of mvs_measures, in the units of that struct. NaN: no member
 * has the figure, or fewer than two have it for a deviation. Figures that are counts are rounded to
 * whole numbers, with 0 instead of NaN. */
MVS_API mvs_result mvs_ensemble_measure(const mvs_ensemble *ensemble,
                                        mvs_ensemble_statistic statistic, mvs_measures *measures);

/* Arrays of an ensemble: n nodes, p members. */
enum mvs_ensemble_array_e {
  MVS_ENSEMBLE_ARRAY_NODE_DEVIATION = 1, /* F64 n, m: RMS distance of each node from its mean */
  MVS_ENSEMBLE_ARRAY_PAIR_DISTANCE = 2   /* F64 p x p, m: node RMS between every two members, also
                                            those not at rest */
};
typedef uint32_t mvs_ensemble_array;

/* Returns a view of one array, zero-copy, valid until the ensemble is released. */
MVS_API mvs_result mvs_ensemble_get_array(const mvs_ensemble *ensemble, mvs_ensemble_array which,
                                          mvs_view *view);

#ifdef __cplusplus
}
#endif
#endif
