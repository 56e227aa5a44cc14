/* Sensitivities: derivatives of quantities of a valve at rest with respect to its parameters.
 * Experimental (experimental.h).
 *
 * At rest the out-of-balance force g(x, p) of the free nodes is zero, so the positions x follow a
 * parameter p by K dx/dp = -dg/dp, K the exact tangent of all forces: contact, chordae and the
 * skew part of the follower pressure included. A quantity q(x, p) then changes by
 * dq/dp = q_p + q_x dx/dp. With few quantities each takes one solution with the transpose of K
 * (adjoint), with few parameters each parameter takes one with K (direct).
 *
 * A derivative holds in a neighbourhood that may be small: chordae become slack or taut, contact
 * changes from a face to an edge, folds snap. mvs_sensitivity_run tests the forces on both sides at
 * a distance `slack` and flags parameters and quantities whose derivative does not hold there. Near
 * chordae, springs and contact that are about to switch it also returns the derivatives of both
 * sides, and says which of them the forces confirm. */
#ifndef MVS_SENSITIVITY_H
#define MVS_SENSITIVITY_H

#include "base.h"
#include "snapshot.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Parameters of model and load. `index` and `component` are fields of mvs_parameter. */
enum mvs_parameter_kind_e {
  MVS_PARAMETER_CHORD_REST_LENGTH = 1, /* m; index: chord segment */
  MVS_PARAMETER_CHORD_YOUNG = 2,       /* Pa; index: chord segment with a law that has a modulus */
  MVS_PARAMETER_CHORD_AREA = 3,        /* m2; index: chord segment */
  MVS_PARAMETER_LEAFLET_CONSTANT = 4, /* its unit; index: leaflet; component: constant of its law */
  MVS_PARAMETER_LEAFLET_THICKNESS = 5, /* m, added to all its triangles; index: leaflet */
  MVS_PARAMETER_SCALLOP_CONSTANT = 6,  /* its unit; index: scallop; component: constant */
  MVS_PARAMETER_SCALLOP_THICKNESS = 7, /* m; index: scallop */
  MVS_PARAMETER_PRESTRAIN = 8,      /* e: the rest shape of the leaflets shrinks by 1 / (1 + e) */
  MVS_PARAMETER_PRESSURE = 9,       /* Pa */
  MVS_PARAMETER_NODE_POSITION = 10, /* m; index: prescribed node; component: axis 0 to 2 */
  MVS_PARAMETER_HEAD_POSITION = 11, /* m; index: papillary head; component: axis 0 to 2 */
  MVS_PARAMETER_ANNULUS_SCALE = 12, /* e: the annulus grows by 1 + e about its centroid; a ring
                                       changes its size by e times the size */
  MVS_PARAMETER_BOUNDARY_MODE = 13, /* factor of a displacement field of the prescribed nodes */
  MVS_PARAMETER_CHORD_SITE = 14     /* m of unloaded tissue by which the insertion of a chord moves
                                       along an edge; index: chord segment that ends on a leaflet;
                                       component: the node at the other end of the edge. Holds for
                                       motion to that node; away from it is another parameter */
};
typedef uint32_t mvs_parameter_kind;

/* One parameter. Positions are the present ones of prescribed nodes: their targets move alike, open
 * and loaded. */
typedef struct mvs_parameter {
  mvs_parameter_kind kind; /* MVS_PARAMETER_* */
  uint32_t index;
  uint32_t component;
  uint32_t reserved;
  mvs_array mode; /* F64 or F32, n x 3, m: of MVS_PARAMETER_BOUNDARY_MODE, zero at free nodes */
} mvs_parameter;

/* Quantities. */
enum mvs_quantity_kind_e {
  MVS_QUANTITY_NODE_POSITION = 1, /* m; index: node; component: axis 0 to 2 */
  MVS_QUANTITY_LINEAR = 2,        /* sum of weights times positions; also the first-order change of
                                     any function of the positions, by its gradient as weights */
  MVS_QUANTITY_NODE_DISTANCE = 3, /* m, of a node from `point`; index: node */
  MVS_QUANTITY_CHORD_LENGTH = 4,  /* m; index: chord segment */
  MVS_QUANTITY_CHORD_STRAIN = 5,  /* index: chord segment; negative when slack */
  MVS_QUANTITY_CHORD_TENSION = 6, /* N; index: chord segment */
  MVS_QUANTITY_HEAD_FORCE = 7,    /* N; index: papillary head; component: axis 0 to 2, or 3: its
                                     magnitude */
  MVS_QUANTITY_MEASURE = 8        /* a number of mvs_measures; `measure`: the name of the field */
};
typedef uint32_t mvs_quantity_kind;

/* One quantity. */
typedef struct mvs_quantity {
  mvs_quantity_kind kind; /* MVS_QUANTITY_* */
  uint32_t index;
  uint32_t component;
  uint32_t reserved;
  const char *measure; /* "coaptation_area", ...; null for other kinds */
  double point[3];     /* m */
  mvs_array weights;   /* F64 or F32, n x 3 */
} mvs_quantity;

/* mvs_sensitivity_options.flags */
enum mvs_sensitivity_flags_e {
  MVS_SENSITIVITY_MOTION = 1 << 0,   /* also dx/dp of all nodes: MVS_SENSITIVITY_ARRAY_MOTION */
  MVS_SENSITIVITY_DIRECT = 1 << 1,   /* one solution for each parameter, with few quantities too */
  MVS_SENSITIVITY_NO_TEST = 1 << 2,  /* no test of both sides, and chordae alone are looked at for
                                        switches: faster, for fits */
  MVS_SENSITIVITY_NO_MARGIN = 1 << 3 /* no eigenvalue: stiffness_margin is NaN, and a fold that is
                                        about to snap is found only where Ks is not definite */
};
typedef uint32_t mvs_sensitivity_flags;

/* Options of mvs_sensitivity_run. */
typedef struct mvs_sensitivity_options {
  uint32_t struct_size;
  mvs_sensitivity_flags flags; /* MVS_SENSITIVITY_MOTION, ... */
  double slack; /* m [1e-7]: a derivative is tested where it moves the fastest node by
                   this much, and chordae this near to their rest length, springs
                   this near to the kink of their law and contact this near to
                   its begin or to another closest feature are about to switch;
                   1e-9 to 1e-3 */
  /* As in mvs_sim_desc; the force is that of the snapshot. Called after each parameter and each
   * quantity of each part of the work. Nullable. */
  int32_t (*progress)(void *user, double share, double residual);
  void *user;
} mvs_sensitivity_options;

/* Flags of a quantity or a parameter. CHORD, CONTACT and KINK are given where the step of the test
 * reaches a switch that matters; adjoint solutions do not know the motion by each parameter, and
 * give parameters those of every switch that may matter. */
enum mvs_sensitivity_notes_e {
  MVS_SENSITIVITY_NOTE_SWITCH = 1 << 0, /* the forces of both sides differ: contact, chordae or the
                                           law of a spring switch within `slack`. A parameter is
                                           tested along itself, a quantity along its gradient */
  MVS_SENSITIVITY_NOTE_CHORD = 1 << 1, /* a chord is about to switch: see the arrays ABOVE, BELOW */
  MVS_SENSITIVITY_NOTE_SNAP = 1 << 2,  /* the smallest eigenvalue of the tangent is near zero */
  MVS_SENSITIVITY_NOTE_DIFFERENCES = 1 << 3, /* the measure is differenced along dx/dp */
  MVS_SENSITIVITY_NOTE_RASTER = 1 << 4,      /* the same, of a measure on a raster: see
                                                libmvs/measure/DEFINITIONS.md */
  MVS_SENSITIVITY_NOTE_EXTREME = 1 << 5,     /* a largest or smallest value: its derivative changes
                                                where another place takes over; or of a place half
                                                way along the annulus: where it passes a node */
  MVS_SENSITIVITY_NOTE_ENVELOPE = 1 << 6, /* the orifice: its rim is taken as fixed in the tissue.
                                             An estimate: of a leak of a few mm2 it can be wrong by
                                             several times */
  MVS_SENSITIVITY_NOTE_CONTACT = 1 << 7, /* contact begins, ends or passes from a face to an edge or
                                            a corner: see ABOVE, BELOW. Contact that begins has the
                                            mean stiffness of its first `slack` */
  MVS_SENSITIVITY_NOTE_KINK = 1 << 8,    /* a spring or chord passes the kink of a bilinear law: see
                                            ABOVE, BELOW */
  MVS_SENSITIVITY_NOTE_SIDES = 1 << 9,   /* of a parameter with one of these notes that was solved
                                            directly: the forces confirm ABOVE and BELOW, each on its
                                            side, to 1 % */
  MVS_SENSITIVITY_NOTE_TIED = 1 << 10    /* of the largest strain or tension of chordae: another one
                                            reaches it within `slack`. DERIVATIVE, ABOVE and BELOW are
                                            of the first of them: differentiate each by
                                            MVS_QUANTITY_CHORD_STRAIN or _TENSION */
};
typedef uint32_t mvs_sensitivity_notes;

typedef struct mvs_sensitivity mvs_sensitivity;

/* Differentiates quantities of a snapshot at rest with respect to parameters; lists with strides as
 * in mvs_valve_desc. The snapshot does not change. `options` is nullable. `sensitivity`: release it
 * with mvs_sensitivity_release. From any thread. MVS_E_STATE if the snapshot is not at rest, or its
 * equilibrium is unstable; MVS_E_ARGUMENT for a quantity or parameter that the valve does not have,
 * or that has no derivative; MVS_E_CANCELLED if the progress callback cancelled. */
MVS_API mvs_result mvs_sensitivity_run(const mvs_snapshot *snapshot, const mvs_quantity *quantities,
                                       uint32_t quantity_count, uint32_t quantity_stride,
                                       const mvs_parameter *parameters, uint32_t parameter_count,
                                       uint32_t parameter_stride,
                                       const mvs_sensitivity_options *options,
                                       mvs_sensitivity **sensitivity);

/* Releases a result. `sensitivity` is nullable. */
MVS_API void mvs_sensitivity_release(mvs_sensitivity *sensitivity);

/* Summary of a result. */
typedef struct mvs_sensitivity_summary {
  uint32_t struct_size;
  uint32_t quantities;
  uint32_t parameters;
  uint32_t smooth;         /* 1: no NOTE_SWITCH, NOTE_CHORD, NOTE_CONTACT, NOTE_KINK, NOTE_SNAP */
  uint32_t adjoint_solves; /* solutions with the transpose of K */
  uint32_t direct_solves;  /* solutions with K, those of tests included */
  uint32_t weak_chords;    /* chordae within `slack` of their rest length */
  uint32_t weak_contacts;  /* switches of contact and kinks of laws within `slack` */
  double residual;         /* N, out-of-balance force of the snapshot */
  double linear_error;     /* largest |K y - b| / |b| of all solutions */
  double stiffness_margin; /* N/m, smallest eigenvalue of the symmetric part of K over the
                              leaflets, with branch points in equilibrium: another number than
                              that of mvs_stability, where branch points move by themselves */
} mvs_sensitivity_summary;

/* Reads the summary. */
MVS_API mvs_result mvs_sensitivity_get_summary(const mvs_sensitivity *sensitivity,
                                               mvs_sensitivity_summary *summary);

/* Arrays of a result: q quantities, p parameters, n nodes. */
enum mvs_sensitivity_array_e {
  MVS_SENSITIVITY_ARRAY_VALUE = 1,      /* F64 q */
  MVS_SENSITIVITY_ARRAY_DERIVATIVE = 2, /* F64 q x p, a row a quantity */
  MVS_SENSITIVITY_ARRAY_ABOVE = 3,      /* F64 q x p: derivatives for a growing parameter; equal to
                                           DERIVATIVE where nothing is about to switch, NaN where
                                           more than 64 places are */
  MVS_SENSITIVITY_ARRAY_BELOW = 4,      /* F64 q x p: the same for a falling one */
  MVS_SENSITIVITY_ARRAY_QUANTITY_NOTES = 5,  /* U32 q: MVS_SENSITIVITY_NOTE_* */
  MVS_SENSITIVITY_ARRAY_PARAMETER_NOTES = 6, /* U32 p: MVS_SENSITIVITY_NOTE_* */
  MVS_SENSITIVITY_ARRAY_WEAK_CHORDS = 7,     /* U32: indices of chord segments */
  MVS_SENSITIVITY_ARRAY_MOTION = 8,          /* F64 (p n) x 3: dx/dp of all nodes for each parameter
                                                in turn; empty unless asked for */
  MVS_SENSITIVITY_ARRAY_WEAK_CONTACTS = 9    /* U32: vertices whose contact is about to switch, in
                                                the order of its search; may repeat */
};
typedef uint32_t mvs_sensitivity_array;

/* Returns a view of one array, zero-copy, valid until the result is released. */
MVS_API mvs_result mvs_sensitivity_get_array(const mvs_sensitivity *sensitivity,
                                             mvs_sensitivity_array which, mvs_view *view);

#ifdef __cplusplus
}
#endif
#endif
