/* Surgical operations: check, apply, undo, redo, groups, checkpoints.
 *
 * An operation is a struct that begins with mvs_op: its own size and kind. mvs_check_op and
 * mvs_apply_op give the same verdict and the same words. An operation may be applied to an open, a
 * closed or a moving valve; positions and velocities stay as they are (a clip opens the valve), and
 * the next settle or step brings the valve to where the operation leads. Lengths are in m.
 *
 * Every operation can be undone: the history of a valve is part of its snapshots, so that restoring
 * a snapshot brings its history back too, and a new valve starts a new one. */
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

/* What every operation begins with. */
typedef struct mvs_op {
  uint32_t struct_size; /* of the whole operation, sizeof(mvs_op_chord_length), ... */
  uint32_t kind;        /* MVS_OP_* */
} mvs_op;

/* A point in space that may be left out. */
typedef struct mvs_point {
  double at[3];   /* m */
  uint32_t given; /* 1; 0: left out */
  uint32_t reserved;
} mvs_point;

/* How a place on a leaflet is told. */
enum mvs_site_kind_e {
  MVS_SITE_NONE = 0,
  MVS_SITE_NODE = 1,      /* node `index` */
  MVS_SITE_TRIANGLE = 2,  /* in triangle `index`, barycentric coordinates u, sum 1 */
  MVS_SITE_ANATOMICAL = 3 /* in a scallop: u[0] along it, 0 at its end towards the negative CC axis
                             to 1 at the other; u[1] from annulus, 0, to free edge, 1 */
};
typedef uint32_t mvs_site_kind;

/* A place on a leaflet. */
typedef struct mvs_site {
  uint32_t how;   /* MVS_SITE_* */
  uint32_t index; /* node or triangle */
  mvs_id scallop; /* of an anatomical site */
  double u[3];
} mvs_site;

/* Sets the rest length of a chord: exactly one of length, factor, drag_to is given. */
typedef struct mvs_op_chord_length {
  mvs_op op;
  mvs_id chord;
  double length;     /* m */
  double factor;     /* times its present rest length */
  mvs_point drag_to; /* the leaflet end was dragged here: the length at which the chord, with its
                        present tension, ends there */
} mvs_op_chord_length;

/* Cuts a chord. Segments that hang on nothing afterwards go with it. */
typedef struct mvs_op_chord_remove {
  mvs_op op;
  mvs_id chord;
} mvs_op_chord_remove;

/* Ties a new chord from a papillary head to a leaflet; makes a chord. */
typedef struct mvs_op_chord_add {
  mvs_op op;
  mvs_id head;
  mvs_site site;
  double length; /* m [as taut as its neighbours: its distance in the rest shape times the median
                    ratio of rest length to distance of the five nearest chords of the head;
                    where it has none, its distance] */
  double young;  /* Pa [40e6] */
  double area;   /* m2 [pi/4 * (1 mm)^2] */
  uint32_t type; /* MVS_CHORD_KIND_* but trunk and suture [other] */
  uint32_t reserved;
  const char *name; /* null: made by the library, "P2/9" */
} mvs_op_chord_add;

/* Ends of a chord. */
enum mvs_chord_end_e { MVS_CHORD_END_LEAFLET = 1, MVS_CHORD_END_HEAD = 2 };
typedef uint32_t mvs_chord_end;

/* Moves one end of a chord to another place of a leaflet, or to another papillary head. At a
 * leaflet it is sewn on as long as it is. At a head it is cut off and tied anew, at a length that
 * lets the leaflet close: that of mvs_op_chord_add. */
typedef struct mvs_op_chord_transfer {
  mvs_op op;
  mvs_id chord;
  uint32_t end; /* MVS_CHORD_END_* [leaflet] */
  uint32_t reserved;
  mvs_site site; /* where to, for the leaflet end */
  mvs_id head;   /* where to, for the head end */
  double length; /* m [leaflet end: kept; head end: as taut as its neighbours, mvs_op_chord_add] */
} mvs_op_chord_transfer;

/* Scales the annulus about its centroid in its own frame, open and under load; for making
 * pathologies and for sizing. */
typedef struct mvs_op_annulus_scale {
  mvs_op op;
  double factor; /* in every direction [1] */
  double ap;     /* further along the anteroposterior axis [1] */
  double cc;     /* further along the intercommissural axis [1] */
} mvs_op_annulus_scale;

/* Sews a rigid ring to the annulus: the annulus nodes go onto the curve, at the same share of its
 * length as of their own, and stay there with and without load. Makes a ring. A ring or band that
 * is there already is replaced. */
typedef struct mvs_op_ring {
  mvs_op op;
  mvs_array curve;     /* F64, k x 3, m, k >= 8: closed, in any frame; or leave it out and give
                          a size. Its winding and start do not matter. */
  double size;         /* m, intercommissural width of a parametric ring: 0.034 is labelled 34.
                          Proportions of the Physio II 34 as measured; not catalogue data */
  double ap_ratio;     /* AP over CC width [26.1 / 34.7] */
  double saddle;       /* m, height of the saddle [4.7 / 34.7 of the CC width] */
  mvs_array landmarks; /* F64, k x 3, m, k >= 3: points of the ring in the frame of `curve`, ... */
  mvs_array landmarks_at; /* ... and where they come to lie in the valve. Without: best rigid fit
                             to the annulus under load */
  const char *name;       /* null: "ring" */
} mvs_op_ring;

/* Sews a flexible band along the posterior annulus from trigone to trigone: it shortens that part
 * of the annulus to its length, towards the line between the trigones, which stay. Makes a ring. */
typedef struct mvs_op_band {
  mvs_op op;
  double length;    /* m; or give a factor */
  double factor;    /* times the present length of that part under load */
  const char *name; /* null: "band" */
} mvs_op_band;

/* Ties artificial chordae (ePTFE) to a leaflet; makes a chord. */
typedef struct mvs_op_neochord {
  mvs_op op;
  mvs_id head;
  mvs_site site;
  double length;    /* m [as of mvs_op_chord_add] */
  uint32_t strands; /* side by side [2] */
  uint32_t reserved;
  double young;     /* Pa [ePTFE, libmvs/surgery/README.md] */
  double diameter;  /* m, of one strand [0.3e-3] */
  const char *name; /* null: made by the library */
} mvs_op_neochord;

/* Moves a papillary head, open and under load. */
typedef struct mvs_op_head_move {
  mvs_op op;
  mvs_id head;
  double by[3]; /* m, along x, y, z; or along AP, CC and the axis into the atrium */
  uint32_t
      frame; /* 0: the axes of the coordinates; 1: those of the valve (mvs_snapshot_get_frame) */
  uint32_t reserved;
} mvs_op_head_move;

/* Joins two free edges (edge to edge: a clip or an Alfieri stitch) by sutures one contact thickness
 * long; makes a chord, the middle one. It is set on the open valve: positions go back to the rest
 * shape, at rest. */
typedef struct mvs_op_clip {
  mvs_op op;
  mvs_id anterior;  /* scallop [A2] */
  mvs_id posterior; /* scallop [P2] */
  double position;  /* along the scallops, -1 to 1 [0: the middle] */
  double width;     /* m, of the free edge that is joined [5e-3] */
  double reach;     /* m, from the free edge into the leaflets [4e-3] */
  const char *name; /* null: "clip" */
} mvs_op_clip;

/* Cuts a piece out of a scallop from its free edge on, and sews the sides of the gap together: a
 * triangle, a quadrangle, or an outline of one's own. A quadrangle also shortens the annulus below
 * by the width of its base. */
typedef struct mvs_op_resect {
  mvs_op op;
  mvs_id scallop;    /* [P2] */
  double position;   /* of its middle along the scallop, -1 to 1 [0] */
  double width;      /* m, at the free edge [8e-3] */
  double base_width; /* m, towards the annulus; 0: a triangle */
  double depth;      /* m, from the free edge [0.8 of the scallop's height there] */
  mvs_array outline; /* F64, k x 3, m, k >= 3: points on the present leaflet, in order, the first
                        and the last beyond or on the free edge; instead of all the above */
} mvs_op_resect;

/* Enlarges a leaflet by a pericardial patch: within an ellipse the tissue is replaced by a larger
 * piece, which bulges at rest. */
typedef struct mvs_op_patch {
  mvs_op op;
  mvs_site site;      /* the middle */
  double width;       /* m, circumferential [12e-3] */
  double height;      /* m, radial [8e-3] */
  double area_factor; /* area of the patch over that of the hole [1.3] */
  double thickness;   /* m [0.4e-3] */
} mvs_op_patch;

/* Says whether an operation could be applied now; nothing changes. MVS_E_OP for what cannot be
 * done, MVS_E_ID for a part that is not there or is of another kind, MVS_E_ARGUMENT for a value out
 * of range; the sentence names the operation, the part and what to do. */
MVS_API mvs_result mvs_check_op(const mvs_sim *sim, const mvs_op *op);

/* Applies an operation, and tells the id of what it made in *made (nullable; 0: nothing). What was
 * undone before cannot be redone any more. */
MVS_API mvs_result mvs_apply_op(mvs_sim *sim, const mvs_op *op, mvs_id *made);

/* Takes back the last operation, or the whole last group: everything is bit for bit as before it.
 * MVS_E_STATE if there is none. */
MVS_API mvs_result mvs_undo(mvs_sim *sim);

/* Applies again what was undone last: everything is bit for bit as right after it. MVS_E_STATE if
 * there is nothing. */
MVS_API mvs_result mvs_redo(mvs_sim *sim);

/* Operations until mvs_end_group are undone and redone together, as `name` in a menu. Groups do not
 * nest; an empty group leaves no trace. */
MVS_API mvs_result mvs_begin_group(mvs_sim *sim, const char *name);
MVS_API mvs_result mvs_end_group(mvs_sim *sim);

/* Keeps valve, state and history under a name, in place of an older checkpoint of that name. */
MVS_API mvs_result mvs_set_checkpoint(mvs_sim *sim, const char *name);

/* Goes back to a checkpoint, bit for bit; the checkpoints stay. MVS_E_ID if there is none of this
 * name. */
MVS_API mvs_result mvs_restore_checkpoint(mvs_sim *sim, const char *name);

/* The history of a snapshot. */
typedef struct mvs_history {
  uint32_t struct_size;
  uint32_t done;   /* operations that can be undone */
  uint32_t undone; /* operations that can be redone */
  uint32_t checkpoints;
} mvs_history;

MVS_API mvs_result mvs_snapshot_get_history(const mvs_snapshot *snapshot, mvs_history *history);

/* One operation of a history. */
typedef struct mvs_history_entry {
  uint32_t struct_size;
  uint32_t kind;     /* MVS_OP_* */
  uint64_t group;    /* equal for operations of one group; 0: none */
  mvs_id made;       /* id of what it made; 0: nothing */
  char title[128];   /* "shorten chord P2/3 to 75 %" */
  char in_group[64]; /* the name of its group, or "" */
} mvs_history_entry;

/* Entry `index` of a history: 0 to done - 1 from the first to the last operation, then those undone
 * in the order in which they would be redone. */
MVS_API mvs_result mvs_snapshot_get_history_entry(const mvs_snapshot *snapshot, uint32_t index,
                                                  mvs_history_entry *entry);

/* The name of a checkpoint; valid while the snapshot is held. Null past the last one. */
MVS_API const char *mvs_snapshot_get_checkpoint(const mvs_snapshot *snapshot, uint32_t index);

/* Types of the fields of operations. */
enum mvs_field_type_e {
  MVS_FIELD_NUMBER = 1,  /* double */
  MVS_FIELD_COUNT = 2,   /* uint32_t */
  MVS_FIELD_CHOICE = 3,  /* uint32_t, one of `choices` */
  MVS_FIELD_CHORD = 4,   /* mvs_id */
  MVS_FIELD_HEAD = 5,    /* mvs_id */
  MVS_FIELD_SCALLOP = 6, /* mvs_id */
  MVS_FIELD_SITE = 7,    /* mvs_site */
  MVS_FIELD_POINT = 8,   /* mvs_point */
  MVS_FIELD_VECTOR = 9,  /* double[3] */
  MVS_FIELD_POINTS = 10, /* mvs_array, F64, k x 3 */
  MVS_FIELD_TEXT = 11    /* const char * */
};
typedef uint32_t mvs_field_type;

/* A kind of operation, for dialogs, bindings and scripts. All texts are static. */
typedef struct mvs_op_info {
  uint32_t struct_size;
  uint32_t kind;    /* MVS_OP_* */
  uint32_t size;    /* sizeof its struct */
  uint32_t fields;  /* how many it has after mvs_op */
  const char *name; /* "chord_length" */
  const char *help; /* one sentence */
} mvs_op_info;

/* A field of an operation. */
typedef struct mvs_field_info {
  uint32_t struct_size;
  uint32_t type;     /* MVS_FIELD_* */
  uint32_t offset;   /* bytes into the struct */
  uint32_t required; /* 1: it has no default */
  double low, high;  /* of numbers and counts that are given, in SI units */
  const char *name;
  const char *unit; /* "m", "Pa", "m2", or "" */
  const char *help;
  const char *choices; /* "none=0 leaflet=1 head=2", or "" */
} mvs_field_info;

/* How many kinds of operations this library has. */
MVS_API uint32_t mvs_get_op_count(void);

/* The index-th kind, in the order of their numbers. */
MVS_API mvs_result mvs_get_op_info(uint32_t index, mvs_op_info *info);

/* Field `field` of the index-th kind. */
MVS_API mvs_result mvs_get_op_field(uint32_t index, uint32_t field, mvs_field_info *info);

#ifdef __cplusplus
}
#endif
#endif
