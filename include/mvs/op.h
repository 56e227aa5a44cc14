/* Surgical operations: check, apply, undo, redo, groups, checkpoints.
 *
 * An operation is a struct that begins with mvs_op: its size and kind. mvs_check_op and
 * mvs_apply_op return the same result and sentence. An operation may be applied to an open, a
 * closed or a moving valve; positions and velocities do not change (except that a clip and a
 * resection open the valve), and the next settle or step moves the valve to its new equilibrium.
 * Lengths are in m. Names are UTF-8, as those of parts (valve.h).
 *
 * Every operation can be undone. The history belongs to snapshots, so that restoring a snapshot
 * restores its history; a new valve starts a new history. */
#ifndef MVS_OP_H
#define MVS_OP_H

#include "base.h"
#include "sim.h"
#include "snapshot.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Kinds of operations. Numbers are never reused. */
enum mvs_op_kind_e {
  MVS_OP_CHORD_LENGTH = 1,
  MVS_OP_CHORD_REMOVE = 2,
  MVS_OP_CHORD_ADD = 3,
  MVS_OP_CHORD_TRANSFER = 4,
  MVS_OP_ANNULUS_SCALE = 5,
  MVS_OP_RING = 6,
  MVS_OP_BAND = 7,
  MVS_OP_NEOCHORD = 8,
  MVS_OP_HEAD_MOVE = 9,
  MVS_OP_CLIP = 10,
  MVS_OP_RESECT = 11,
  MVS_OP_PATCH = 12
};
typedef uint32_t mvs_op_kind;

/* The first field of every operation. */
typedef struct mvs_op {
  uint32_t struct_size; /* of the whole operation, sizeof(mvs_op_chord_length), ... */
  mvs_op_kind kind;     /* MVS_OP_* */
} mvs_op;

/* An optional point in space. */
typedef struct mvs_point {
  double at[3];   /* m */
  uint32_t given; /* 1: `at` is given; 0: left out */
  uint32_t reserved;
} mvs_point;

/* Representations of a place on a leaflet. */
enum mvs_site_kind_e {
  MVS_SITE_NONE = 0,
  MVS_SITE_NODE = 1,      /* node `index` */
  MVS_SITE_TRIANGLE = 2,  /* in triangle `index`, barycentric coordinates u, sum 1 */
  MVS_SITE_ANATOMICAL = 3 /* in a scallop: u[0] along it, 0 at its end towards the negative CC axis,
                             1 at the other end; u[1] 0 at the annulus, 1 at the free edge */
};
typedef uint32_t mvs_site_kind;

/* A place on a leaflet. */
typedef struct mvs_site {
  mvs_site_kind how; /* MVS_SITE_* */
  uint32_t index;    /* node or triangle */
  mvs_id scallop;    /* of an anatomical site */
  double u[3];
} mvs_site;

/* Sets the rest length of a chord; exactly one of length, factor and drag_to is given. */
typedef struct mvs_op_chord_length {
  mvs_op op;
  mvs_id chord;
  double length;     /* m */
  double factor;     /* on its present rest length */
  mvs_point drag_to; /* new position of the leaflet end: sets the length at which the chord reaches
                        it under its present tension */
} mvs_op_chord_length;

/* Cuts a chord. Segments that lose their support are removed with it. */
typedef struct mvs_op_chord_remove {
  mvs_op op;
  mvs_id chord;
} mvs_op_chord_remove;

/* Attaches a new chord from a papillary head to a leaflet; makes a chord. */
typedef struct mvs_op_chord_add {
  mvs_op op;
  mvs_id head;
  mvs_site site;
  double length; /* m [as taut as its neighbours: its distance in the rest shape times the median
                    ratio of rest length to distance of the five nearest chords of the head; its
                    distance if the head has no chords. Slack where these lie far from the site or
                    on the other leaflet: give a length there] */
  double young;  /* Pa [40e6] */
  double area;   /* m2 [pi/4 * (1 mm)^2] */
  mvs_chord_kind type; /* MVS_CHORD_KIND_* except trunk and suture [other] */
  uint32_t reserved;
  const char *name; /* nullable [made by the library, "P2/9"] */
} mvs_op_chord_add;

/* Ends of a chord. */
enum mvs_chord_end_e { MVS_CHORD_END_LEAFLET = 1, MVS_CHORD_END_HEAD = 2 };
typedef uint32_t mvs_chord_end;

/* Moves one end of a chord to another place of a leaflet, or to another papillary head. The leaflet
 * end keeps the length of the chord. At a head the chord is attached anew with the default length
 * of mvs_op_chord_add, at which the leaflet can close. */
typedef struct mvs_op_chord_transfer {
  mvs_op op;
  mvs_id chord;
  mvs_chord_end end; /* MVS_CHORD_END_* [leaflet] */
  uint32_t reserved;
  mvs_site site; /* new place of the leaflet end */
  mvs_id head;   /* new head of the head end */
  double length; /* m [leaflet end: unchanged; head end: that of mvs_op_chord_add] */
} mvs_op_chord_transfer;

/* Scales the annulus about its centroid in its own frame, open and under load: to model pathologies
 * and to size rings. At least one of its fields is given. MVS_E_OP if a ring or band holds the
 * annulus, or if its perimeter under load would be below 25 % or above 300 % of that at rest, the
 * limits of a ring. */
typedef struct mvs_op_annulus_scale {
  mvs_op op;
  double factor; /* in every direction [1] */
  double ap;     /* additional factor along the anteroposterior axis [1] */
  double cc;     /* additional factor along the intercommissural axis [1] */
} mvs_op_annulus_scale;

/* Sews a rigid ring to the annulus: the annulus nodes move onto the curve at equal fractions of the
 * arc length, with and without load. Makes a ring, which replaces an existing ring or band. */
typedef struct mvs_op_ring {
  mvs_op op;
  mvs_array curve;     /* F64, k x 3, m, k >= 8: closed, in any frame, of any winding and start, its
                          first point repeated at its end or not; or left out with a size */
  double size;         /* m, intercommissural width of a parametric ring: 0.034 is labelled 34.
                          Measured proportions of the Physio II 34, not catalogue data */
  double ap_ratio;     /* AP over CC width [26.1 / 34.7] */
  double saddle;       /* m, height of the saddle [4.7 / 34.7 of the CC width] */
  mvs_array landmarks; /* F64, k x 3, m, k >= 3: points of the ring in the frame of `curve` */
  mvs_array landmarks_at; /* F64, k x 3, m: their positions in the valve [best rigid fit to the
                             annulus under load] */
  const char *name;       /* nullable ["ring"] */
} mvs_op_ring;

/* Sews a flexible band along the posterior annulus from trigone to trigone: it shortens that part
 * of the annulus to its length, towards the line between the fixed trigones. Makes a ring. */
typedef struct mvs_op_band {
  mvs_op op;
  double length;    /* m; or give a factor */
  double factor;    /* on the present length of that part under load */
  const char *name; /* nullable ["band"] */
} mvs_op_band;

/* Attaches artificial chordae (ePTFE) to a leaflet; makes a chord. */
typedef struct mvs_op_neochord {
  mvs_op op;
  mvs_id head;
  mvs_site site;
  double length;    /* m [that of mvs_op_chord_add] */
  uint32_t strands; /* parallel strands [2] */
  uint32_t reserved;
  double young;     /* Pa [ePTFE, libmvs/surgery/README.md] */
  double diameter;  /* m, of one strand [0.3e-3] */
  const char *name; /* nullable [made by the library] */
} mvs_op_neochord;

/* Axes of a vector. */
enum mvs_axes_e {
  MVS_AXES_SCENE = 0, /* x, y, z of the coordinates */
  MVS_AXES_VALVE = 1  /* AP, CC and the axis into the atrium (mvs_snapshot_get_frame) */
};
typedef uint32_t mvs_axes;

/* Moves a papillary head, open and under load. */
typedef struct mvs_op_head_move {
  mvs_op op;
  mvs_id head;
  double by[3];   /* m, along the axes of `frame` */
  mvs_axes frame; /* MVS_AXES_* [scene] */
  uint32_t reserved;
} mvs_op_head_move;

/* Joins two free edges (edge to edge: a clip or an Alfieri stitch) by sutures one contact thickness
 * long; makes a chord, the middle one, about which `angle` turns it in the plane of the leaflets.
 * It is placed on the open valve: positions return to the rest shape with zero velocity. */
typedef struct mvs_op_clip {
  mvs_op op;
  mvs_id anterior;  /* scallop [A2] */
  mvs_id posterior; /* scallop [P2] */
  double position;  /* along the scallops, -1 to 1 [0: the middle] */
  double width;     /* m, of the free edge that is joined [5e-3] */
  double reach;     /* m, from the free edge into the leaflets [4e-3] */
  const char *name; /* nullable ["clip"] */
  double angle;     /* rad, anticlockwise as seen from the atrium [0: across the free edge] */
} mvs_op_clip;

/* Resects a part of a scallop from its free edge and sews the sides of the gap together: a
 * triangle, a quadrangle, or a given outline. A quadrangle also shortens the annulus below by the
 * width of its base. It is made on the open valve: positions return to the rest shape with zero
 * velocity. */
typedef struct mvs_op_resect {
  mvs_op op;
  mvs_id scallop;    /* [P2] */
  double position;   /* of its centre along the scallop, -1 to 1 [0] */
  double width;      /* m, at the free edge [8e-3] */
  double base_width; /* m, towards the annulus; 0: a triangle */
  double depth;      /* m, from the free edge [0.8 of the scallop's height there] */
  mvs_array outline; /* F64, k x 3, m, k >= 3: points on the present leaflet, in order, the first
                        and the last on or beyond the free edge; replaces all fields above */
} mvs_op_resect;

/* Enlarges a leaflet by a pericardial patch: replaces the tissue within an ellipse by a larger
 * piece, which bulges at rest. */
typedef struct mvs_op_patch {
  mvs_op op;
  mvs_site site;      /* the centre */
  double width;       /* m, circumferential [12e-3] */
  double height;      /* m, radial [8e-3] */
  double area_factor; /* area of the patch over that of the hole [1.3] */
  double thickness;   /* m [0.4e-3] */
} mvs_op_patch;

/* Checks whether an operation can be applied now; nothing changes. MVS_E_OP for an impossible
 * operation, MVS_E_ID for a missing part or a part of another kind, MVS_E_ARGUMENT for a value out
 * of its range or left out; the sentence names the operation, the part and the remedy. It reads the
 * present snapshot, so that it may be called from any thread at any time. */
MVS_API mvs_result mvs_check_op(const mvs_sim *sim, const mvs_op *op);

/* Applies an operation and stores the id of the part that it made in *made (0: it made no part).
 * Operations undone before can no longer be redone. `made` is nullable. */
MVS_API mvs_result mvs_apply_op(mvs_sim *sim, const mvs_op *op, mvs_id *made);

/* Reverts the last operation, or the whole last group, bit for bit: the state is that directly
 * before it. MVS_E_STATE without an operation to undo. */
MVS_API mvs_result mvs_undo(mvs_sim *sim);

/* Repeats the operation or group undone last, bit for bit: the state is that directly after it, of
 * a group directly after its last operation, so that the settles and steps which followed are to be
 * made again. MVS_E_STATE without an operation to redo. */
MVS_API mvs_result mvs_redo(mvs_sim *sim);

/* Begin and end a group: its operations are undone and redone together, shown as `name` in a menu.
 * Groups do not nest; an empty group is discarded. While one is open, undo, redo and
 * restoring give MVS_E_STATE. A new valve or a file ends it. A checkpoint that is set in a group
 * keeps the operations before it as a group of their own. */
MVS_API mvs_result mvs_begin_group(mvs_sim *sim, const char *name);
MVS_API mvs_result mvs_end_group(mvs_sim *sim);

/* Stores valve, state and history under a name; replaces a checkpoint of the same name. */
MVS_API mvs_result mvs_set_checkpoint(mvs_sim *sim, const char *name);

/* Restores a checkpoint, bit for bit; all checkpoints remain. MVS_E_ID for an unknown name. */
MVS_API mvs_result mvs_restore_checkpoint(mvs_sim *sim, const char *name);

/* Size of a history. */
typedef struct mvs_history {
  uint32_t struct_size;
  uint32_t done;   /* operations that can be undone */
  uint32_t undone; /* operations that can be redone */
  uint32_t checkpoints;
} mvs_history;

/* Reads the size of the history of a snapshot. */
MVS_API mvs_result mvs_snapshot_get_history(const mvs_snapshot *snapshot, mvs_history *history);

/* One operation of a history. */
typedef struct mvs_history_entry {
  uint32_t struct_size;
  mvs_op_kind kind;  /* MVS_OP_* */
  uint64_t group;    /* equal for operations of one group; 0: ungrouped */
  mvs_id made;       /* id of the part that it made; 0: it made no part */
  char title[128];   /* "shorten chord P2/3 to 75 %" */
  char in_group[64]; /* the name of its group, or "" */
} mvs_history_entry;

/* Reads entry `index` of a history: 0 to done - 1 are the operations from the first to the last,
 * then follow `undone` entries in the order in which they would be redone. */
MVS_API mvs_result mvs_snapshot_get_history_entry(const mvs_snapshot *snapshot, uint32_t index,
                                                  mvs_history_entry *entry);

/* Returns the name of checkpoint `index`, 0 to checkpoints - 1; valid while the snapshot is held.
 */
MVS_API mvs_result mvs_snapshot_get_checkpoint(const mvs_snapshot *snapshot, uint32_t index,
                                               const char **name);

/* A kind of operation, for dialogs, bindings and scripts. All texts are static. */
typedef struct mvs_op_info {
  uint32_t struct_size;
  mvs_op_kind kind; /* MVS_OP_* */
  uint32_t size;    /* sizeof its struct */
  uint32_t fields;  /* number of fields after mvs_op */
  const char *name; /* "chord_length" */
  const char *help; /* one sentence */
} mvs_op_info;

/* Returns the number of kinds of operations. */
MVS_API uint32_t mvs_get_op_count(void);

/* Describes kind `index`, in the order of their numbers. */
MVS_API mvs_result mvs_get_op_info(uint32_t index, mvs_op_info *info);

/* Describes field `field` of kind `index`. */
MVS_API mvs_result mvs_get_op_field(uint32_t index, uint32_t field, mvs_field_info *info);

#ifdef __cplusplus
}
#endif
#endif
