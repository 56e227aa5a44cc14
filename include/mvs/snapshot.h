/* Snapshots: immutable copies of a valve, its state and history, to read, measure and restore.
 *
 * A snapshot is reference counted and stays valid after its simulator is destroyed. Functions of a
 * const mvs_snapshot * may be called from any thread. */
#ifndef MVS_SNAPSHOT_H
#define MVS_SNAPSHOT_H

#include "base.h"
#include "sim.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mvs_snapshot mvs_snapshot;

/* Returns the valve and state after the last finished call; release it with mvs_snapshot_release.
 * From any thread, also during a call on the simulator. No array is copied. */
MVS_API mvs_result mvs_get_snapshot(mvs_sim *sim, const mvs_snapshot **snapshot);

/* Add and drop a reference. `snapshot` is nullable. */
MVS_API void mvs_snapshot_retain(const mvs_snapshot *snapshot);
MVS_API void mvs_snapshot_release(const mvs_snapshot *snapshot);

/* Restores a simulator to a snapshot of this or another simulator, bit for bit. */
MVS_API mvs_result mvs_restore(mvs_sim *sim, const mvs_snapshot *snapshot);

/* Returns a 128-bit hash of model and state: equal for equal inputs of the next step, but for a
 * move of a tool that no step or settle has used yet (mvs_move_tool): neither snapshots nor files
 * have it. The hash of a snapshot may differ between versions of the library. */
MVS_API mvs_result mvs_snapshot_get_hash(const mvs_snapshot *snapshot, uint64_t hash[2]);

/* Arrays of a snapshot: n nodes, m triangles, l leaflets, c chord segments, h heads, r rings, k
 * curves. Together with the parts they hold everything that mvs_set_valve takes. */
enum mvs_array_kind_e {
  MVS_ARRAY_NODE_POSITION = 1, /* F64 n x 3, m */
  MVS_ARRAY_NODE_REST = 2,     /* F64 n x 3, m: the unloaded valve */
  MVS_ARRAY_NODE_LOADED = 3,   /* F64 n x 3, m: targets of prescribed nodes under load */
  MVS_ARRAY_NODE_VELOCITY = 4, /* F64 n x 3, m/s */
  MVS_ARRAY_NODE_KIND = 5,     /* U8 n: MVS_NODE_KIND_* */
  /* F64 n x 3, N: out-of-balance force; where prescribed the force of the valve on what holds it,
   * the negative of a reaction force of FEBio or Abaqus */
  MVS_ARRAY_NODE_FORCE = 6,
  MVS_ARRAY_NODE_CONTACT_FORCE = 7,  /* F64 n x 3, N */
  MVS_ARRAY_NODE_COAPTATION = 8,     /* F64 n, m: distance to the facing leaflet, or infinity */
  MVS_ARRAY_NODE_OPEN = 9,           /* F64 n x 3, m: unloaded targets of prescribed nodes */
  MVS_ARRAY_NODE_ORIGIN = 10,        /* U32 n: the node's index before operations, refinement and
                                        coarsening; UINT32_MAX for a new node */
  MVS_ARRAY_NODE_STRAIN_FIBRE = 11,  /* F64 n x 3: means of the triangles at a node by rest area */
  MVS_ARRAY_NODE_STRESS_FIBRE = 12,  /* F64 n x 3, Pa: the same */
  MVS_ARRAY_NODE_MODE = 13,          /* F64 n x 3: mode of mvs_stability, the real part of the
                                        eigenvector; the longest displacement is 1 */
  MVS_ARRAY_TRIANGLE_NODES = 20,     /* U32 m x 3 */
  MVS_ARRAY_TRIANGLE_LEAFLET = 21,   /* U32 m */
  MVS_ARRAY_TRIANGLE_SCALLOP = 22,   /* U32 m */
  MVS_ARRAY_TRIANGLE_THICKNESS = 23, /* F64 m, m */
  MVS_ARRAY_TRIANGLE_FIBRE = 24,     /* F64 m x 3, unit */
  MVS_ARRAY_TRIANGLE_STRETCH = 25,   /* F64 m x 2: principal stretches, larger first */
  MVS_ARRAY_TRIANGLE_STRESS = 26,    /* F64 m x 2, Pa: principal Cauchy stresses, larger first */
  MVS_ARRAY_TRIANGLE_COAPTED = 27,   /* F64 m: share of the triangle that faces another leaflet */
  MVS_ARRAY_TRIANGLE_STRAIN_FIBRE = 28, /* F64 m x 3: Green-Lagrange strain along the fibre
                                           (circumferential), across it (radial), in shear */
  MVS_ARRAY_TRIANGLE_STRESS_FIBRE = 29, /* F64 m x 3, Pa: Cauchy stress, turned back by the
                                           rotation of the triangle, in the same order */
  MVS_ARRAY_TRIANGLE_DIRECTION = 32,    /* F64 m x 3: unit direction of the largest stretch */
  MVS_ARRAY_LEAFLET_LAW = 30,           /* U32 l, a row a leaflet: MVS_LEAFLET_LAW_* */
  MVS_ARRAY_LEAFLET_CONSTANTS = 31, /* F64 l x 9: thickness in m, then the constants of the law */
  MVS_ARRAY_ANNULUS_NODES = 40,     /* U32 k, in order */
  MVS_ARRAY_FREE_EDGE_NODES = 41,   /* U32, in order */
  MVS_ARRAY_ANNULUS_FORCE = 42,     /* F64 k x 3, N: pull of tissue and pressure on each of them,
                                       which the sutures of a ring bear */
  MVS_ARRAY_CHORD_NODES = 50,       /* U32 c x 2 */
  MVS_ARRAY_CHORD_REST_LENGTH = 51, /* F64 c, m */
  MVS_ARRAY_CHORD_KIND = 52,        /* U32 c: MVS_CHORD_KIND_* */
  MVS_ARRAY_CHORD_STRAIN = 53,      /* F64 c: (L - L0) / L0, negative when slack */
  MVS_ARRAY_CHORD_TENSION = 54,     /* F64 c, N */
  MVS_ARRAY_CHORD_ID = 55,          /* U64 c */
  MVS_ARRAY_CHORD_YOUNG = 56,       /* F64 c, Pa */
  MVS_ARRAY_CHORD_AREA = 57,        /* F64 c, m2 */
  MVS_ARRAY_CHORD_FLAGS = 58,       /* U8 c: MVS_CHORD_FLAG_OVER_* */
  MVS_ARRAY_CHORD_LAW = 59,         /* U32 c: MVS_CHORD_LAW_* */
  MVS_ARRAY_HEAD_NODES = 60,        /* U32 h */
  MVS_ARRAY_HEAD_FORCE = 61,        /* F64 h x 3, N: pull of the chordae on each head */
  MVS_ARRAY_CHORD_CONSTANTS = 62,   /* F64 c x 6: of the law */
  MVS_ARRAY_RING_POINTS = 65,       /* F64 x 3, m: the points of all rings, one after the other */
  MVS_ARRAY_RING_START = 66,   /* U32 r + 1: first row of each ring's points, then their number */
  MVS_ARRAY_RING_KIND = 67,    /* U32 r: MVS_RING_KIND_* */
  MVS_ARRAY_RING_ID = 68,      /* U64 r */
  MVS_ARRAY_CURVE_POINTS = 75, /* F64 x 2: strain, nominal stress in Pa; of all curves in turn */
  MVS_ARRAY_CURVE_START = 76,  /* U32 k + 1: first row of each curve's points, then their number */
  MVS_ARRAY_ORIFICE_VERTICES = 70,  /* F64 x 3, m: the smallest opening, as triangles */
  MVS_ARRAY_ORIFICE_TRIANGLES = 71, /* U32 x 3 into MVS_ARRAY_ORIFICE_VERTICES */
  MVS_ARRAY_ORIFICE_PART = 72,      /* U32 per triangle of the orifice: index of its part, see
                                       mvs_snapshot_get_orifice_part */
  MVS_ARRAY_VALVE_CONSTANTS = 80,   /* F64 4: density, kg/m3; contact thickness, m; contact
                                       stiffness, Pa; bending scale, 0: no bending */
  MVS_ARRAY_STATE_TIME = 81         /* F64 1, s: simulated time since the valve was set */
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

/* Returns a view of one array, zero-copy, valid while the snapshot is held. Forces, strains,
 * coaptation and orifice are computed at the first call that needs them. */
MVS_API mvs_result mvs_snapshot_get_array(const mvs_snapshot *snapshot, mvs_array_kind which,
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
  mvs_part_kind kind; /* MVS_PART_* */
  uint32_t index;     /* row in the arrays of its kind */
  char name[64];
} mvs_part;

/* Returns the number of parts of a kind. */
MVS_API mvs_result mvs_snapshot_get_part_count(const mvs_snapshot *snapshot, mvs_part_kind kind,
                                               uint32_t *count);

/* Returns part `index` of a kind. */
MVS_API mvs_result mvs_snapshot_get_part(const mvs_snapshot *snapshot, mvs_part_kind kind,
                                         uint32_t index, mvs_part *part);

/* Finds the part of a kind with this name; MVS_E_ID if the valve has no such part. */
MVS_API mvs_result mvs_snapshot_find_part(const mvs_snapshot *snapshot, mvs_part_kind kind,
                                          const char *name, mvs_part *part);

/* A chord segment in words and figures, for tables. Texts are valid while the snapshot is held. */
typedef struct mvs_chord_info {
  uint32_t struct_size;
  mvs_chord_kind kind; /* MVS_CHORD_KIND_* */
  mvs_id id;
  const char *name;
  const char *heads;     /* names of the papillary heads above it, joined by '+'; "" without one */
  const char *scallops;  /* of those in which it, or its branches, end, joined by '+' */
  double length;         /* m, now */
  double rest_length;    /* m */
  double strain;         /* engineering strain, negative when slack */
  double tension;        /* N */
  mvs_chord_flags flags; /* MVS_CHORD_FLAG_* */
  uint32_t reserved;
} mvs_chord_info;

/* Returns chord segment `index` of a snapshot. */
MVS_API mvs_result mvs_snapshot_get_chord(const mvs_snapshot *snapshot, uint32_t index,
                                          mvs_chord_info *chord);

/* Returns the name of the valve, valid while the snapshot is held. Never null; "" for a null
 * snapshot. */
MVS_API const char *mvs_snapshot_get_name(const mvs_snapshot *snapshot);

/* Reads the load of the snapshot. */
MVS_API mvs_result mvs_snapshot_get_load(const mvs_snapshot *snapshot, mvs_load_case *load);

/* Whether a snapshot is at rest. */
typedef struct mvs_rest {
  uint32_t struct_size;
  uint32_t at_rest; /* 1: at rest under its load, as a settle or step found it */
  double tolerance; /* N, out-of-balance force up to which it was found at rest; 0 if it is not */
} mvs_rest;

/* Reads whether the snapshot is at rest. A settle that converges and a step that moves nothing find
 * rest; a change of valve, load or tools, and a step that moves, end it. Undo and files restore it.
 * A valve from another program is not known to be at rest. */
MVS_API mvs_result mvs_snapshot_get_rest(const mvs_snapshot *snapshot, mvs_rest *rest);

/* Stability of the equilibrium that a snapshot at rest is in, under its load and tools.
 *
 * The tangent stiffness is K = Ks + N, Ks symmetric, N the skew part that the follower pressure has
 * at the free edge. In overdamped motion, D dx/dt = -K x with a damping D of 500 1/s times the
 * mass, a small disturbance grows or falls with the eigenvalues of -D^-1 K: the equilibrium is
 * stable where all their real parts are negative. That is so wherever Ks is positive definite.
 * Branch points with less stiffness than 1e-3 N/m, whose chordae are slack or carry next to
 * nothing, are eliminated: they follow the other nodes without force. */
typedef struct mvs_stability {
  uint32_t struct_size;
  uint32_t stable;         /* 1: growth_rate is at most 1e-3 1/s, or Ks is positive definite */
  double stiffness_margin; /* N/m, smallest eigenvalue of Ks: near 0 a fold is about to snap.
                              Below 0 beside a growth_rate below 0, damping and the follower
                              pressure hold the fold */
  double growth_rate;      /* 1/s, largest real part of an eigenvalue of -D^-1 K */
} mvs_stability;

/* Computes the stability at the positions of a snapshot, with a relative error of the margins below
 * 1 %. Away from rest it is that of the tangent there. The mode is MVS_ARRAY_NODE_MODE. The first
 * call for a snapshot takes the time of a few Newton iterations. */
MVS_API mvs_result mvs_snapshot_get_stability(const mvs_snapshot *snapshot,
                                              mvs_stability *stability);

/* Measures of a valve (fields: MVS_STRUCT_MEASURES). Definitions and sources:
 * libmvs/measure/DEFINITIONS.md. The annulus surface is the one that spans the annulus; the annulus
 * plane is the plane of least squares. Figures of leaflets that cross (intersections > 0) do not
 * count. */
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
  double tenting_height;           /* m, of a ball that rests on the leaflets below the plane */
  double tenting_area;             /* m2, below the annulus surface, central AP plane */
  double tenting_volume;           /* m3, below the annulus surface */
  double billow_height;            /* m, highest leaflet point above the annulus surface */
  double billow_volume;            /* m3, above the annulus surface */
  double annulus_ap;               /* m */
  double annulus_cc;               /* m */
  double annulus_perimeter;        /* m */
  double annulus_area_3d;          /* m2, of the surface that spans it */
  double annulus_area;             /* m2, projected on its plane */
  double annulus_saddle_height;    /* m */
  double annulus_nonplanar_angle;  /* rad */
  double max_chord_strain;         /* engineering strain, without sutures; 0 if slack */
  double max_chord_tension;        /* N, without sutures */
  double max_leaflet_strain;       /* largest principal engineering strain */
  double max_leaflet_stress;       /* Pa, largest principal Cauchy stress */
  double leaflet_area;             /* m2 */
  uint32_t chords_over_strain;     /* chordae strained beyond the limit of their kind */
  uint32_t chords_over_tension;    /* chordae that carry more than the limit of their kind */
  uint32_t at_rest;                /* 1: at rest under its load, as a settle or step found it */
  uint32_t under_load;             /* 1: the pressure closes the valve. A leak may be graded if
                                      both are 1: otherwise these are measures of a moving, an
                                      operated or an open valve */
  double leaflet_strain_p50; /* largest principal strain: half of the tissue has at most this */
  double leaflet_strain_p95; /* 95 % of the tissue, by rest area */
  double leaflet_strain_p99; /* 99 %; one bad triangle does not change it */
  double leaflet_stress_p50; /* Pa, largest principal Cauchy stress, in the same way */
  double leaflet_stress_p95; /* Pa */
  double leaflet_stress_p99; /* Pa */
} mvs_measures;

/* Groups of measures. The figures of a group are computed together; mvs_field_info has the group of
 * each field of mvs_measures. at_rest and under_load are in no group: they are always set. */
enum mvs_measure_group_flags_e {
  MVS_MEASURE_GROUP_CROSSINGS = 1,  /* intersections */
  MVS_MEASURE_GROUP_ORIFICE = 2,    /* regurgitant_orifice_area: the longest */
  MVS_MEASURE_GROUP_COAPTATION = 4, /* coaptation_* */
  MVS_MEASURE_GROUP_TENTING = 8,    /* tenting_*, billow_* */
  MVS_MEASURE_GROUP_ANNULUS = 16,   /* annulus_* */
  MVS_MEASURE_GROUP_CHORDS = 32,    /* max_chord_*, chords_over_* */
  MVS_MEASURE_GROUP_LEAFLETS = 64   /* max_leaflet_*, leaflet_*: strain, stress, area */
};
typedef uint32_t mvs_measure_group_flags;

/* Kinds of regions. */
enum mvs_region_kind_e {
  MVS_REGION_SCALLOP = 1,   /* each triangle belongs to one scallop */
  MVS_REGION_COMMISSURE = 2 /* the tissue of both leaflets near a commissure; overlaps scallops */
};
typedef uint32_t mvs_region_kind;

/* Measures of one region of the leaflets. Areas and volumes of the scallops add up to those of
 * mvs_measures. Definitions: libmvs/measure/DEFINITIONS.md. Texts are valid while the snapshot is
 * held. */
typedef struct mvs_region_measures {
  uint32_t struct_size;
  mvs_region_kind kind;          /* MVS_REGION_* */
  const char *name;              /* "A2"; of a commissure the scallops there, "A1-P1"; distinct */
  double coaptation_area;        /* m2, of one side: half of the coapted tissue of the region */
  double coaptation_length_mean; /* m, along its part of the coaptation line; 0 without one */
  double coaptation_length_min;  /* m, the same */
  double orifice_area;           /* m2, the part of the orifice nearest to this tissue */
  double gap;                    /* m, widest ball in that part of the orifice; 0 when sealed */
  double billow_height;          /* m, highest node above the annulus surface */
  double billow_volume;          /* m3 */
  double tenting_height;         /* m, deepest point on the atrial side below the annulus plane */
  double tenting_volume;         /* m3 */
} mvs_region_measures;

/* Returns the number of regions: the scallops in their order, then the commissures, one where the
 * attachments of two leaflets meet: two of a mitral valve. */
MVS_API mvs_result mvs_snapshot_get_region_count(const mvs_snapshot *snapshot, uint32_t *count);

/* Returns region `index` of a snapshot. The first call computes all regions. */
MVS_API mvs_result mvs_snapshot_get_region(const mvs_snapshot *snapshot, uint32_t index,
                                           mvs_region_measures *region);

/* A part of the regurgitant orifice that is connected in itself. Texts are valid while the snapshot
 * is held. */
typedef struct mvs_orifice_part {
  uint32_t struct_size;
  uint32_t triangles;      /* of MVS_ARRAY_ORIFICE_TRIANGLES, see MVS_ARRAY_ORIFICE_PART */
  double area;             /* m2 */
  double gap;              /* m, widest ball in it */
  double centroid[3];      /* m */
  double direction[3];     /* unit, into the atrium: mean normal, the direction of the jet */
  const char *anterior;    /* scallops of the anterior leaflet beside it, joined by '+', or "" */
  const char *posterior;   /* scallops of the other leaflets beside it, joined by '+', or "" */
  const char *commissures; /* commissures beside it, joined by '+', or "" */
} mvs_orifice_part;

/* Returns the number of parts of the orifice; 0 for a sealed valve. */
MVS_API mvs_result mvs_snapshot_get_orifice_part_count(const mvs_snapshot *snapshot,
                                                       uint32_t *count);

/* Returns part `index` of the orifice, the largest first. */
MVS_API mvs_result mvs_snapshot_get_orifice_part(const mvs_snapshot *snapshot, uint32_t index,
                                                 mvs_orifice_part *part);

/* Returns the working range of chordae of a kind: largest strain and tension in N; infinite for
 * sutures. It is no limit of strength: a chord outside it deserves inspection. Sources:
 * libmvs/measure/DEFINITIONS.md. */
MVS_API mvs_result mvs_get_chord_limits(mvs_chord_kind kind, double *strain, double *tension);

/* Measures a snapshot. The first call computes the measures, later calls return the same ones. */
MVS_API mvs_result mvs_snapshot_measure(const mvs_snapshot *snapshot, mvs_measures *measures);

/* Measures some groups, MVS_MEASURE_GROUP_* joined by |, with the same bits as
 * mvs_snapshot_measure. Numbers of the other groups are NaN, their counts are 0, and computing them
 * takes no time. Later calls return what an earlier call has computed. */
MVS_API mvs_result mvs_snapshot_measure_groups(const mvs_snapshot *snapshot,
                                               mvs_measure_group_flags groups,
                                               mvs_measures *measures);

/* Distances between two shapes, in m. Node figures are NaN where the meshes do not match. */
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

/* Intersects the leaflets with a plane: segments as pairs of points, 3 doubles each, in m. Writes
 * at most `capacity` points and stores their number, 2 x segments, in *count. The normal may have
 * any length but 0. */
MVS_API mvs_result mvs_snapshot_section(const mvs_snapshot *snapshot, const double point[3],
                                        const double normal[3], double *points, uint64_t capacity,
                                        uint64_t *count);

/* Returns the anatomical frame of the valve: rows are the origin in m (annulus centroid), the AP
 * axis (towards the anterior leaflet), the CC axis and the axis into the atrium; right-handed, unit
 * vectors. */
MVS_API mvs_result mvs_snapshot_get_frame(const mvs_snapshot *snapshot, double frame[12]);

#ifdef __cplusplus
}
#endif
#endif
