/* Profile of the solver: work done and work avoided in a settle or step. Experimental.
 *
 * Counts are the same on every machine; times are wall times of this run. */
#ifndef MVS_PROFILE_H
#define MVS_PROFILE_H

#include "base.h"
#include "sim.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Phases of the work, as indices of mvs_profile.phase_s. */
enum mvs_phase_e {
  MVS_PHASE_TERMS = 0,       /* energy, gradient and Hessian blocks of the terms */
  MVS_PHASE_BROAD = 1,       /* broad phase and step limiter */
  MVS_PHASE_NARROW = 2,      /* narrow phase: distances */
  MVS_PHASE_ASSEMBLY = 3,    /* blocks into the sparse matrix */
  MVS_PHASE_ORDERING = 4,    /* symbolic analysis */
  MVS_PHASE_FACTOR = 5,      /* numeric factorisation */
  MVS_PHASE_SOLVE = 6,       /* solutions with the factor */
  MVS_PHASE_LINE_SEARCH = 7, /* trial energies with their distances; those of an implicit step count
                                as terms, because they include forces */
  MVS_PHASE_COUNT = 8
};
typedef uint32_t mvs_phase;

/* Work that a settle or step did not need: bits of mvs_profile.skipped. No bit changes a result. */
enum mvs_skipped_flags_e {
  MVS_SKIPPED_SPRINGS = 1 << 0, /* the first seven: the scene has no such term, or no load on it */
  MVS_SKIPPED_MEMBRANE = 1 << 1,
  MVS_SKIPPED_BENDING = 1 << 2,
  MVS_SKIPPED_CHORDAE = 1 << 3,
  MVS_SKIPPED_PRESSURE = 1 << 4,
  MVS_SKIPPED_CONTACT = 1 << 5, /* no pair came near enough for a distance computation */
  MVS_SKIPPED_TOOLS = 1 << 6,
  MVS_SKIPPED_BROAD = 1 << 7,    /* the previous candidate pairs were still valid */
  MVS_SKIPPED_ORDERING = 1 << 8, /* the sparsity pattern was known */
  MVS_SKIPPED_FACTOR = 1 << 9,   /* an earlier factorisation served as preconditioner */
  MVS_SKIPPED_STEP = 1 << 10     /* at rest without any change: only the time advanced */
};
typedef uint32_t mvs_skipped_flags;

/* Profile of a settle or step (fields: MVS_STRUCT_PROFILE). */
typedef struct mvs_profile {
  uint32_t struct_size;
  mvs_skipped_flags skipped;  /* MVS_SKIPPED_*: work not done in the whole settle or step */
  uint32_t factorisations;    /* a factorisation spread over several steps counts in the last one */
  uint32_t shifted;           /* iterations with a diagonal shift for positive definiteness */
  uint32_t broad_phases;      /* broad phases run */
  uint32_t orderings;         /* new sparsity patterns with their symbolic analysis */
  uint32_t linear_iterations; /* iterations of iterative linear solvers */
  uint32_t passes;            /* evaluations of energy, gradient or Hessian over all terms */
  /* Coarser meshes, over which large valves close: crossings removed after interpolation, and
   * shapes that were given up because crossings remained. */
  uint32_t untangled;
  uint32_t discarded_levels;
  double phase_s[MVS_PHASE_COUNT]; /* s, wall time of each phase */
} mvs_profile;

/* Reads the profile of the last settle or step of this valve; MVS_E_STATE before the first. */
MVS_API mvs_result mvs_get_profile(const mvs_sim *sim, mvs_profile *profile);

#ifdef __cplusplus
}
#endif
#endif
