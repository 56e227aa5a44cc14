/* A valve from arrays: its nodes, leaflets, annulus, chordae, papillary heads and materials.
 * mvs_set_valve (sim.h) takes it; mvs_check_valve says all that is wrong with one.
 *
 * Nodes are one list: leaflet vertices, chord branch points and papillary heads in any order.
 * Triangles are wound so that their normals point into the atrium: pressure pushes along them. All
 * leaflets are one sheet, joined along the annulus; the annulus is one closed loop of its boundary.
 * Names have at most 63 bytes, no control characters, and are unique among parts of their kind. */
#ifndef MVS_VALVE_H
#define MVS_VALVE_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Kinds of chordae. */
enum {
  MVS_CHORD_OTHER = 0,
  MVS_CHORD_MARGINAL = 1,    /* to the free edge */
  MVS_CHORD_ROUGH_ZONE = 2,  /* to the coapting zone behind the free edge */
  MVS_CHORD_STRUT = 3,       /* the two thick ones of the anterior leaflet */
  MVS_CHORD_BASAL = 4,       /* to the base of the posterior leaflet */
  MVS_CHORD_COMMISSURAL = 5, /* to a commissure */
  MVS_CHORD_TRUNK = 6,       /* between papillary head and branch point */
  MVS_CHORD_SUTURE = 7       /* a surgeon's: joins two places of the leaflets */
};

/* The laws a leaflet sheet can follow, and what `constants` means for each. */
enum {
  /* Mass-spring sheet, bilinear law, Van Gelder stiffness (Tenenholtz et al. 2011): constants are
   * Young's modulus below the kink, Pa [100e3]; above it, Pa [6e6]; strain at the kink [0.25]. */
  MVS_LEAFLET_SPRING = 1
};

/* A leaflet and its tissue. Zero fields take the defaults in brackets. */
typedef struct mvs_leaflet_desc {
  const char *name; /* "A", "P", or free text; required, unique */
  mvs_id id;        /* 0: given by the library */
  uint32_t law;     /* MVS_LEAFLET_* [spring] */
  uint32_t reserved;
  double thickness;    /* m [1e-3] */
  double constants[8]; /* of the law */
} mvs_leaflet_desc;

/* The laws a chord can follow. */
enum {
  MVS_CHORD_LINEAR = 1 /* tension = E A (L - L0) / L0 when longer than L0, else 0 */
};

/* A chord segment between two nodes, tension only. */
typedef struct mvs_chord_desc {
  uint32_t node_a;     /* nearer the papillary head */
  uint32_t node_b;     /* nearer the leaflet */
  uint32_t kind;       /* MVS_CHORD_MARGINAL ... */
  uint32_t law;        /* MVS_CHORD_LINEAR [linear] */
  double rest_length;  /* m; 0: the distance of its nodes */
  double young;        /* Pa [40e6] */
  double area;         /* m2 [pi/4 * (1 mm)^2] */
  double constants[6]; /* of laws that need more; zero */
  mvs_id id;           /* 0: given by the library */
  const char *name;    /* null: made by the library from its kind and scallop, "P2/3" */
} mvs_chord_desc;

/* A papillary head: a prescribed node that holds chordae. */
typedef struct mvs_head_desc {
  uint32_t node;
  uint32_t reserved;
  mvs_id id;        /* 0: given by the library */
  const char *name; /* null: "PM1", "PM2", ... */
} mvs_head_desc;

/* mvs_valve_desc.flags */
enum {
  MVS_VALVE_ORIENT = 1 /* turn triangles so that their normals point into the atrium */
};

/* Kinds of rings. */
enum {
  MVS_RING_RIGID = 1, /* closed and rigid: holds the whole annulus */
  MVS_RING_BAND = 2   /* posterior, from trigone to trigone, flexible */
};

/* A ring or band that is sewn to the annulus. Where it holds the annulus is in nodes_open and
 * nodes_loaded; this is what to draw. */
typedef struct mvs_ring_desc {
  const char *name; /* required, unique */
  mvs_id id;        /* 0: given by the library */
  uint32_t kind;    /* MVS_RING_* [rigid] */
  uint32_t reserved;
  mvs_array curve; /* F64 or F32, k x 3, m: its points in order */
} mvs_ring_desc;

/* A whole valve. Optional arrays are left zero. Lengths in m. */
typedef struct mvs_valve_desc {
  uint32_t struct_size;
  uint32_t flags;               /* MVS_VALVE_* */
  const char *name;             /* null: "valve" */
  mvs_array nodes;              /* F64 or F32, n x 3: the open, unloaded valve (rest shape) */
  mvs_array nodes_loaded;       /* optional, n x 3: where annulus and heads are under load;
                                   other rows are ignored */
  mvs_array nodes_now;          /* optional, n x 3: the state to start from [nodes] */
  mvs_array triangles;          /* U32, m x 3 */
  mvs_array triangle_leaflet;   /* U32, m: index into leaflets */
  mvs_array triangle_scallop;   /* optional, U32, m: index into scallops [made from leaflets] */
  mvs_array triangle_thickness; /* optional, F64, m: m [the leaflet's] */
  mvs_array triangle_fibre;     /* optional, F64, m x 3: fibre direction [circumferential] */
  mvs_array annulus;            /* U32, k: the boundary loop held by the heart, in order */
  const mvs_leaflet_desc *leaflets;
  const char *const *scallops; /* names, "A1" .. "P3"; null: one per leaflet */
  const mvs_chord_desc *chords;
  const mvs_head_desc *heads;
  uint32_t leaflet_count;
  uint32_t scallop_count;
  uint32_t chord_count;
  uint32_t head_count;
  double density;            /* kg/m3 [1060] */
  double contact_thickness;  /* m, mid-surface distance at which leaflets touch [1e-3, a leaflet
                                thickness] */
  double contact_stiffness;  /* Pa, scale of the contact pressure [20e3] */
  double bending_scale;      /* factor on E t^3 / (12 (1 - nu^2)) [1]; negative: no bending */
  const mvs_id *scallop_ids; /* one a scallop, 0: given by the library; null: all are */
  mvs_array nodes_open;      /* optional, n x 3: where annulus and heads are without load [nodes];
                                other rows are ignored */
  mvs_array node_origin;     /* optional, U32, n: MVS_NODE_ORIGIN of a valve that was operated on */
  const mvs_ring_desc *rings;
  uint32_t ring_count;
  uint32_t reserved;
} mvs_valve_desc;

/* A parametric mitral valve. Zero fields take the defaults in brackets (adult human; sources in
 * libmvs/anatomy/README.md). The fibrous trigones lie at +-38 degrees from the A point. */
typedef struct mvs_parametric_desc {
  uint32_t struct_size;
  uint32_t vertices;           /* leaflet vertices wanted, about [425]; 200 to 100000 */
  uint32_t chords;             /* chord segments wanted, about [80] */
  uint32_t branching;          /* 1: chordae branch at free nodes; 0: straight [0] */
  double annulus_ap;           /* m, septal-lateral diameter */
  double annulus_cc;           /* m, intercommissural diameter */
  double saddle_height;        /* m */
  double anterior_height;      /* m, leaflet height at A2 */
  double posterior_height;     /* m, at P2 */
  double commissure_height;    /* m */
  double thickness;            /* m */
  double papillary_depth;      /* m, papillary tip to annulus plane */
  double papillary_separation; /* m, between the two tips */
  double annulus_contraction;  /* loaded / open annulus size */
  double annulus_scale;        /* factor on the loaded annulus, rest shape kept: dilation [1] */
  double chord_slack;          /* factor on all rest lengths [1] */
  double indentation_depth;    /* m, of the clefts on either side of P2 */
  double coaptation_depth;     /* m, of the coaptation line below the annulus plane, closed */
} mvs_parametric_desc;

#ifdef __cplusplus
}
#endif
#endif
