/* Builds a mitral valve from a patient's surface: from a segmentation or a mesh to a valve that
 * closes. Experimental (experimental.h). */
#ifndef MVS_BUILD_H
#define MVS_BUILD_H

#include "base.h"
#include "sim.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Kinds of surfaces. */
enum mvs_surface_kind_e {
  MVS_SURFACE_KIND_MID = 1,    /* the mid-surface of the leaflets: one open sheet */
  MVS_SURFACE_KIND_ATRIAL = 2, /* their atrial side, half a thickness above the mid-surface: one
                                  open sheet, as SlicerHeart's leaflet models are */
  MVS_SURFACE_KIND_SKIN = 3    /* both sides and the rims: a closed surface */
};
typedef uint32_t mvs_surface_kind;

/* Values of mvs_surface_desc.triangle_leaflet. */
enum mvs_leaflet_label_e {
  MVS_LEAFLET_LABEL_UNKNOWN = 0,
  MVS_LEAFLET_LABEL_ANTERIOR = 1,
  MVS_LEAFLET_LABEL_POSTERIOR = 2
};
typedef uint32_t mvs_leaflet_label;

/* The open, unloaded leaflets of a mitral valve as a triangle surface of any orientation and
 * numbering, with the landmarks that are known. Lengths in m, all in one frame. */
typedef struct mvs_surface_desc {
  uint32_t struct_size;
  mvs_surface_kind kind;      /* MVS_SURFACE_KIND_* [skin if it is closed, else mid] */
  const char *name;           /* nullable ["valve"] */
  mvs_array points;           /* F64 or F32, n x 3, required */
  mvs_array triangles;        /* U32, m x 3 [each three points in turn are a triangle] */
  mvs_array triangle_leaflet; /* U32, m: MVS_LEAFLET_LABEL_* [split between the commissures] */
  mvs_array point_thickness;  /* F64, n, m: of the tissue, 1e-4 to 5e-3 [of a skin its own, else the
                                 option] */
  mvs_array annulus;          /* k x 3, points along the annulus in any order; tissue beyond a curve
                                 through six or more of them all around it is cut off as wall of
                                 the atrium [guessed: the boundary that is farther from the
                                 papillary tips, or longer] */
  mvs_array commissures;      /* 2 x 3, near the surface [guessed from heights, annulus and tips] */
  mvs_array anterior;         /* 1 x 3, a point near the anterior leaflet [guessed: the leaflet that
                                 is more like a normal anterior one] */
  mvs_array papillary_tips;   /* k x 3, k <= 64 [assumed: two, from normal anatomy] */
  mvs_array closed_points;    /* F64 or F32: the same leaflets closed, in the same frame; chords get
                                 the lengths with which the valve closes to it. Of closed bodies
                                 (both sides of the tissue, as segmentations are) the middle is
                                 taken; other pieces count as mid-surface */
  mvs_array closed_triangles; /* U32 [as triangles] */
  mvs_array closed_annulus;   /* k x 3, k >= 6, points along the loaded annulus in any order
                                 [measured: an affine motion of the annulus onto rims of the closed
                                 surface; without a closed surface, or if it has no rims near the
                                 annulus, the annulus stays] */
  mvs_array closed_tips;      /* k x 3, each of papillary_tips in their order, under load [all
                                 follow the rigid part of the annulus' motion] */
} mvs_surface_desc;

/* How to build. */
typedef struct mvs_build_options {
  uint32_t struct_size;
  mvs_leaflet_law leaflet_law; /* MVS_LEAFLET_LAW_*, default constants [bilinear; if a closed
                                  surface is given, that of bilinear, PROT and May-Newman and Yin
                                  with which a fitted valve closes nearest to it: finding
                                  "tissue", whose value is the law] */
  double edge;                 /* m, length of the triangles' sides, 2e-4 to 5e-3 [as for 1,000
                                  vertices] */
  double thickness;            /* m, where it is not known per point, 1e-4 to 5e-3 [0.8e-3] */
  double chord_factor;         /* on all rest lengths, 0.5 to 2 [1] */
  double coaptation_length;    /* m, overlap of both leaflets in the middle for which rest lengths
                                  are chosen if no closed surface is given, 1e-3 to 20e-3 [8e-3] */
  uint32_t chords;             /* about this number of chord segments, 20 to 400 [100] */
  uint32_t reserved;
  double edge_error;      /* m, 1e-6 to 5e-3: how far the free edge may lie farther out or in than
                             in the surface; widens the interval of leaks [0] */
  double edge_lost;       /* m, 1e-6 to 5e-3: of tissue that may be missing at the free edge; widens
                             the interval of leaks; 1e-6 adds nothing [half of the mean depth of the
                             notches that were filled] */
  double thickness_error; /* m, 1e-6 to 2e-3: by how much the leaflets may be thicker or thinner
                             than the thickness says; widens the interval of leaks [0] */
  uint32_t without_leak;  /* 1: no closures and no findings on the leak, for a caller who replaces
                             the chordae; mvs_find_leak_interval gives them later [0] */
  uint32_t reserved2;
  double closed_error; /* m, 1e-6 to 5e-3: standard deviation of places of the closed surface; gaps
                          of it widen the interval of leaks from 3.6 times as much of width on,
                          of tissue thicker than twice as much, or 1e-3, from as much more [0.5e-3,
                          as of labels of segmentation networks] */
} mvs_build_options;

/* How far a valve may be from the one of its patient. */
typedef struct mvs_leak_errors {
  uint32_t struct_size;
  uint32_t reserved;
  double lengths;   /* 1e-3 to 0.5: share of the rest lengths, of all chordae and of a group
                       together [0.1] */
  double single;    /* 1e-3 to 0.5: share, of a chord beside its group [0.03] */
  double thickness; /* m, 1e-6 to 2e-3: of the leaflets, thicker or thinner [0] */
} mvs_leak_errors;

/* Where a finding comes from. */
enum mvs_finding_source_e {
  MVS_FINDING_SOURCE_GIVEN = 1,    /* by the caller */
  MVS_FINDING_SOURCE_MEASURED = 2, /* on the surface */
  MVS_FINDING_SOURCE_GUESSED = 3,  /* from the shape, by a rule that may be wrong */
  MVS_FINDING_SOURCE_ASSUMED = 4   /* from a table of normal anatomy */
};
typedef uint32_t mvs_finding_source;

/* A finding: a value that a build found, guessed or assumed. Texts and values are
 * valid while the findings are held. */
typedef struct mvs_finding {
  uint32_t struct_size;
  mvs_finding_source source; /* MVS_FINDING_SOURCE_* */
  const char *name;          /* "annulus", "commissures", "thickness" */
  const char *sentence;      /* the observation, and the input to give if it is wrong */
  const char *unit;          /* of the values: "m", "m2", or "" */
  double confidence;         /* 0 to 1 */
  mvs_view values;           /* F64, k x 1: points as x, y, z in turn */
  uint32_t doubtful;         /* 1: it contradicts the surface or normal anatomy so far that an input
                                is probably wrong (landmarks of another frame, swapped leaflets,
                                atrial wall): show it to whoever builds */
  uint32_t reserved;
} mvs_finding;

/* Findings in the order in which they were made. */
typedef struct mvs_findings mvs_findings;

/* Replaces the valve of a simulator by one that is built from a surface, open and without load, and
 * begins a history, like mvs_generate_valve. `options` is nullable. `findings` is nullable, else
 * release it with mvs_findings_release. Faults of the surface that no rule mends give MVS_E_OP
 * and a sentence; the simulator is unchanged then. Closures of variants, of a fit and for the leak,
 * run at the same time on the workers of the simulator (mvs_sim_desc), with the same bits.
 * MVS_E_CANCELLED if the progress callback of the simulator cancelled. */
MVS_API mvs_result mvs_build_valve(mvs_sim *sim, const mvs_surface_desc *surface,
                                   const mvs_build_options *options, mvs_findings **findings);

/* Closes the valve of a simulator from its open shape under 120 mmHg with chordae of other lengths
 * and leaflets of other thicknesses, up to `errors`: up to 11 closures; 3, or 5 with an error
 * of the thickness, if all of these are sealed. `errors` is nullable. `findings` gets "leak",
 * "leak_interval", without values if too few came to rest, and "leak_limits", m2, as those of a
 * build; release it with mvs_findings_release. The simulator is unchanged. MVS_E_CANCELLED if the
 * progress callback of the simulator cancelled. */
MVS_API mvs_result mvs_find_leak_interval(mvs_sim *sim, const mvs_leak_errors *errors,
                                          mvs_findings **findings);

MVS_API mvs_result mvs_findings_get_count(const mvs_findings *findings, uint32_t *count);
MVS_API mvs_result mvs_findings_get(const mvs_findings *findings, uint32_t index,
                                    mvs_finding *finding);

/* Releases findings. `findings` is nullable. */
MVS_API void mvs_findings_release(mvs_findings *findings);

#ifdef __cplusplus
}
#endif
#endif
