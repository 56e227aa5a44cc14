/* Snapshots: immutable pictures of a valve and its state, for looking, measuring and going back.
 *
 * A snapshot is reference counted and lives on when its simulator is gone. Every function here that
 * takes a const mvs_snapshot * may be called from any thread. */
#ifndef MVS_SNAPSHOT_H
#define MVS_SNAPSHOT_H

#include "base.h"
#include "sim.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mvs_snapshot mvs_snapshot;

/* The valve and state after the last finished call; release it with mvs_snapshot_release. From any
 * thread, also while the simulator is at work. Costs nothing: no array is copied. */
MVS_API mvs_result mvs_get_snapshot(mvs_sim *sim, const mvs_snapshot **snapshot);

/* Adds or drops a reference. Both accept null. */
MVS_API void mvs_snapshot_retain(const mvs_snapshot *snapshot);
MVS_API void mvs_snapshot_release(const mvs_snapshot *snapshot);

/* Puts a simulator back to a snapshot, of this simulator or of another one, bit for bit. */
MVS_API mvs_result mvs_restore(mvs_sim *sim, const mvs_snapshot *snapshot);

/* 128 bits over the meaning of model and state, names and numbers in order: equal for equal inputs
 * of the next step. The hash of one snapshot may differ between versions of the library. */
MVS_API mvs_result mvs_snapshot_get_hash(const mvs_snapshot *snapshot, uint64_t hash[2]);

/* The arrays of a snapshot: n nodes, m triangles, e edges, c chord segments, h heads.
 * With the parts they are all that mvs_set_valve takes: a valve can be edited and set again. */
enum mvs_array_kind_e {
  MVS_ARRAY_NODE_POSITION = 1, /* F64 n x 3, m */
  MVS_ARRAY_NODE_REST = 2,     /* F64 n x 3, m: the unloaded valve */
  MVS_ARRAY_NODE_LOADED = 3,   /* F64 n x 3, m: targets of prescribed nodes under load */
  MVS_ARRAY_NODE_VELOCITY = 4, /* F64 n x 3, m/s */
  MVS_ARRAY_NODE_KIND = 5,     /* U8 n: MVS_NODE_KIND_* */
  MVS_ARRAY_NODE_FORCE = 6,    /* F64 n x 3, N: out-of-balance force; reaction where prescribed */
  MVS_ARRAY_NODE_CONTACT_FORCE = 7,  /* F64 n x 3, N */
  MVS_ARRAY_NODE_COAPTATION = 8,     /* F64 n, m: distance to the facing leaflet; infinity: none */
  MVS_ARRAY_NODE_OPEN = 9,           /* F64 n x 3, m: where prescribed nodes are without load */
  MVS_ARRAY_NODE_ORIGIN = 10,        /* U32 n: the node's index before any operation, refinement or
                                  coarsening added or removed nodes; UINT32_MAX for a new one */
  MVS_ARRAY_TRIANGLE_NODES = 20,     /* U32 m x 3 */
  MVS_ARRAY_TRIANGLE_LEAFLET = 21,   /* U32 m */
  MVS_ARRAY_TRIANGLE_SCALLOP = 22,   /* U32 m */
  MVS_ARRAY_TRIANGLE_THICKNESS = 23, /* F64 m, m */
  MVS_ARRAY_TRIANGLE_FIBRE = 24,     /* F64 m x 3, unit */
  MVS_ARRAY_TRIANGLE_STRETCH = 25,   /* F64 m x 2: principal stretches, larger first */
  MVS_ARRAY_TRIANGLE_STRESS = 26,    /* F64 m x 2, Pa: principal Cauchy stresses, larger first */
  MVS_ARRAY_TRIANGLE_COAPTED = 27,   /* F64 m: share of the triangle that faces another leaflet */
  MVS_ARRAY_LEAFLET_LAW = 30,        /* U32 l, a row a leaflet: MVS_LEAFLET_LAW_* */
  MVS_ARRAY_LEAFLET_CONSTANTS = 31,  /* F64 l x 9: thickness in m, then the constants of the law */
  MVS_ARRAY_ANNULUS_NODES = 40,      /* U32 k, in order */
  MVS_ARRAY_FREE_EDGE_NODES = 41,    /* U32, in order */
  MVS_ARRAY_CHORD_NODES = 50,        /* U32 c x 2 */
  MVS_ARRAY_CHORD_REST_LENGTH = 51,  /* F64 c, m */
  MVS_ARRAY_CHORD_KIND = 52,         /* U32 c: MVS_CHORD_KIND_* */
  MVS_ARRAY_CHORD_STRAIN = 53,       /* F64 c: (L - L0) / L0, negative when slack */
  MVS_ARRAY_CHORD_TENSION = 54,      /* F64 c, N */
  MVS_ARRAY_CHORD_ID = 55,           /* U64 c */
  MVS_ARRAY_CHORD_YOUNG = 56,        /* F64 c, Pa */
  MVS_ARRAY_CHORD_AREA = 57,         /* F64 c, m2 */
  MVS_ARRAY_CHORD_FLAGS = 58,        /* U8 c: MVS_CHORD_FLAG_OVER_* */
  MVS_ARRAY_CHORD_LAW = 59,          /* U32 c: the laws MVS_CHORD_KIND_* */
  MVS_ARRAY_HEAD_NODES = 60,         /* U32 h */
  MVS_ARRAY_HEAD_FORCE = 61,         /* F64 h x 3, N: pull of the chordae on each head */
  MVS_ARRAY_CHORD_CONSTANTS = 62,    /* F64 c x 6: of the law */
  MVS_ARRAY_RING_POINTS = 65,        /* F64 x 3, m: the points of all rings, one after the other */
  MVS_ARRAY_RING_START = 66,   /* U32 r + 1: where each ring's points start, and their number */
  MVS_ARRAY_RING_KIND = 67,    /* U32 r: MVS_RING_KIND_* */
  MVS_ARRAY_RING_ID = 68,      /* U64 r */
  MVS_ARRAY_CURVE_POINTS = 75, /* F64 x 2: strain, nominal stress in Pa; of all curves in turn */
  MVS_ARRAY_CURVE_START = 76,  /* U32 k + 1: where each curve's points start, and their number */
  MVS_ARRAY_ORIFICE_VERTICES = 70,  /* F64 x 3, m: the smallest opening, as triangles */
  MVS_ARRAY_ORIFICE_TRIANGLES = 71, /* U32 x 3 into MVS_ARRAY_ORIFICE_VERTICES */
  MVS_ARRAY_VALVE_CONSTANTS = 80, /* F64 4: density, kg/m3; contact thickness, m; contact stiffness,
                               Pa; bending scale, 0 for none */
  MVS_ARRAY_STATE_TIME = 81       /* F64 1, s: simulated time since the valve was set */
};
typedef uint32_t mvs_array_kind;

/* Values of MVS_ARRAY_NODE_KIND. */
enum mvs_node_kind_e {
  MVS_NODE_KIND_LEAFLET = 0, /* free vertex of the sheet */
  MVS_NODE_KIND_ANNULUS = 1, /* vertex of the sheet, prescribed */
  MVS_NODE_KIND_BRANCH = 2,  /* free branch point of chordae */
  MVS_NODE_KIND_HEAD = 3     /* papillary head, prescribed */
};
typedef uint32_t mvs_node_kind;

/* Bits of MVS_ARRAY_CHORD_FLAGS. */
enum mvs_chord_flags_e {
  MVS_CHORD_FLAG_OVER_STRAIN = 1, /* strained beyond the limit of its kind */
  MVS_CHORD_FLAG_OVER_TENSION = 2 /* carries more than the limit of its kind */
};
typedef uint32_t mvs_chord_flags;

/* Shows one array, zero-copy, valid while the snapshot is held. Forces, strains, coaptation and the
 * orifice are worked out at the first call that needs them. */
MVS_API mvs_result mvs_snapshot_get_array(const mvs_snapshot *snapshot, uint32_t which,
                                          mvs_view *view);

/* Kinds of named parts. */
enum mvs_part_kind_e {
  MVS_PART_LEAFLET = 1,
  MVS_PART_SCALLOP = 2,
  MVS_PART_CHORD = 3,
  MVS_PART_HEAD = 4,
  MVS_PART_RING = 5,
  MVS_PART_CURVE = 6
};
typedef uint32_t mvs_part_kind;

/* A named part of the valve. Names are unique within their kind, of at most 63 bytes. */
typedef struct mvs_part {
  mvs_id id;
  uint32_t kind;  /* MVS_PART_* */
  uint32_t index; /* row in the arrays of its kind */
  char name[64];
} mvs_part;

/* How many parts of a kind there are. */
MVS_API mvs_result mvs_snapshot_get_part_count(const mvs_snapshot *snapshot, uint32_t kind,
                                               uint32_t *count);

/* The index-th part of a kind. */
MVS_API mvs_result mvs_snapshot_get_part(const mvs_snapshot *snapshot, uint32_t kind,
                                         uint32_t index, mvs_part *part);

/* The part of a kind with this name; MVS_E_ID if there is none. */
MVS_API mvs_result mvs_snapshot_find_part(const mvs_snapshot *snapshot, uint32_t kind,
                                          const char *name, mvs_part *part);

/* The name of the valve; valid while the snapshot is held. Never null; "" for a null snapshot. */
MVS_API const char *mvs_snapshot_get_name(const mvs_snapshot *snapshot);

/* The load of the snapshot. */
MVS_API mvs_result mvs_snapshot_get_load(const mvs_snapshot *snapshot, mvs_load_case *load);

/* What the valve measures. Definitions and sources: libmvs/measure/README.md. SI units. */
typedef struct mvs_measures {
  uint32_t struct_size;
  uint32_t intersections;          /* pairs of triangles that cross (exact test) */
  double regurgitant_orifice_area; /* m2, 0 when sealed */
  double coaptation_area;          /* m2, of one side */
  double coaptation_length_mean;   /* m, along the coaptation line */
  double coaptation_length_min;    /* m */
  double coaptation_length_max;    /* m */
  double coaptation_height;        /* m, extent along the valve axis, central AP plane */
  double coaptation_depth;         /* m, annulus plane to its upper end, central AP plane */
  double tenting_height;           /* m, deepest leaflet point on the atrial side below the plane */
  double tenting_area;             /* m2, in the central AP plane */
  double tenting_volume;           /* m3 */
  double billow_height;            /* m, highest leaflet point above the annulus surface */
  double billow_volume;            /* m3 */
  double annulus_ap;               /* m */
  double annulus_cc;               /* m */
  double annulus_perimeter;        /* m */
  double annulus_area_3d;          /* m2, of the surface spanning it */
  double annulus_area;             /* m2, projected on its plane */
  double annulus_saddle_height;    /* m */
  double annulus_nonplanar_angle;  /* rad */
  double max_chord_strain;         /* engineering, 0 when all are slack */
  double max_chord_tension;        /* N */
  double max_leaflet_strain;       /* largest principal engineering strain */
  double max_leaflet_stress;       /* Pa, largest principal Cauchy stress */
  double leaflet_area;             /* m2 */
  uint32_t chords_over_strain;     /* chordae strained beyond the limit of their kind */
  uint32_t chords_over_tension;    /* chordae that carry more than the limit of their kind */
} mvs_measures;

/* The range in which chordae of a kind work (MVS_CHORD_KIND_*): strain and tension in N; infinite
 * for sutures. Not where they rupture: a chord beyond it asks for a look. Sources:
 * libmvs/measure/README.md. */
MVS_API mvs_result mvs_get_chord_limits(uint32_t kind, double *strain, double *tension);

/* Measures a snapshot. The first call on a snapshot does the work, later ones return what it
 * found. */
MVS_API mvs_result mvs_snapshot_measure(const mvs_snapshot *snapshot, mvs_measures *measures);

/* How far two shapes are apart, in m. Node figures are NaN where the meshes do not match. */
typedef struct mvs_comparison {
  uint32_t struct_size;
  uint32_t same_mesh;                              /* 1: node-to-node figures exist */
  double node_rms, node_max;                       /* node to node, as they lie */
  double surface_rms, surface_max;                 /* symmetric surface distance, as they lie */
  double node_rms_registered, node_max_registered; /* after the best rigid motion */
  double surface_rms_registered, surface_max_registered; /* after the best rigid motion */
  double registration[12];                               /* rows of [R | t]: b ~ R a + t, t in m */
} mvs_comparison;

/* Compares the leaflet surfaces of two snapshots. */
MVS_API mvs_result mvs_snapshot_compare(const mvs_snapshot *a, const mvs_snapshot *b,
                                        mvs_comparison *comparison);

/* A planar cut of the leaflets: segments as F64 pairs of points (count = 2 x segments), in m.
 * Writes at most `capacity` points, and their true number to *count; `points` is nullable if
 * `capacity` is 0. The normal may have any length but 0. */
MVS_API mvs_result mvs_snapshot_section(const mvs_snapshot *snapshot, const double point[3],
                                        const double normal[3], double *points, uint64_t capacity,
                                        uint64_t *count);

/* The valve's own frame in m: rows are origin (annulus centroid), AP axis (towards the anterior
 * leaflet), CC axis, and the axis into the atrium; right-handed, unit vectors. */
MVS_API mvs_result mvs_snapshot_get_frame(const mvs_snapshot *snapshot, double frame[12]);

#ifdef __cplusplus
}
#endif
#endif
