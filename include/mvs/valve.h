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
enum mvs_chord_kind_e {
  MVS_CHORD_KIND_OTHER = 0,
  MVS_CHORD_KIND_MARGINAL = 1,    /* to the free edge */
  MVS_CHORD_KIND_ROUGH_ZONE = 2,  /* to the coapting zone behind the free edge */
  MVS_CHORD_KIND_STRUT = 3,       /* the two thick ones of the anterior leaflet */
  MVS_CHORD_KIND_BASAL = 4,       /* to the base of the posterior leaflet */
  MVS_CHORD_KIND_COMMISSURAL = 5, /* to a commissure */
  MVS_CHORD_KIND_TRUNK = 6,       /* between papillary head and branch point */
  MVS_CHORD_KIND_SUTURE = 7       /* a surgeon's: joins two places of the leaflets */
};
typedef uint32_t mvs_chord_kind;

/* The laws a leaflet sheet can follow, and what `constants` means for each. */
enum mvs_leaflet_law_e {
  /* Mass-spring sheet, bilinear law, Van Gelder stiffness (Tenenholtz et al. 2011): constants are
   * Young's modulus below the kink, Pa [100e3]; above it, Pa [6e6]; strain at the kink [0.25]. */
  MVS_LEAFLET_LAW_SPRING = 1,
  /* The others are membranes: constant-strain triangles, plane stress, incompressible, W(I1, I4) in
   * J/m3 with I1 = tr C and I4 = f . C f along the fibre f of the triangle. Past 100 kPa, where
   * stresses are 5 to 11 MPa (more than leaflets bear), c exp(q) goes on as a flat parabola in
   * sqrt(q) with the same slope: what an operation tears or crushes does not keep a valve from
   * rest. Bilinear: the curve of the springs as an isotropic tissue, dW/dI1 =
   * c + a (x + sqrt(x^2 + s^2)) / 2, x = I1 - Ic: c, Pa [18.49e3]; a, Pa [3146e3]; Ic [3.1611];
   * s [0.006]. */
  MVS_LEAFLET_LAW_BILINEAR = 2,
  /* Fung-type isotropic, W = c0 / 2 (I1 - 3) + c1 / 2 (exp(c2 (I1 - 3)^2) - 1) (Texas TriValve 1.1,
   * Mathur et al. 2022): c0, Pa [1e3]; c1, Pa [124]; c2 [4.568202], its anterior leaflet. */
  MVS_LEAFLET_LAW_FUNG = 3,
  /* W = c0 (exp(c1 (I1 - 3)^2 + c2 (sqrt(I4) - 1)^4) - 1) (May-Newman and Yin 1998): c0, Pa [399];
   * c1 [4.325]; c2 [1446.5], the anterior leaflet; posterior 414, 4.848, 305.4. */
  MVS_LEAFLET_LAW_MAY_NEWMAN_YIN = 4,
  /* W = c0 (exp(c1 (I1 - 3)^2 + c2 (I4 - 1)^2) - 1) (Prot et al. 2009): c0, Pa [52]; c1 [4.63]; c2
   * [22.6], the anterior leaflet; posterior 171, 5.28, 6.46. */
  MVS_LEAFLET_LAW_PROT = 5,
  /* W = mu / 2 (I1 - 3): mu, Pa [100e3 / 3]; Young's modulus is 3 mu. */
  MVS_LEAFLET_LAW_NEO_HOOKEAN = 6
};
typedef uint32_t mvs_leaflet_law;

/* A constant of a law, in the order of `constants`. */
typedef struct mvs_law_constant {
  const char *key;  /* its word in files: "c0" */
  const char *unit; /* "Pa", or "" for a pure number */
  double fallback;  /* what 0 means */
  double low, high; /* outside of them a valve is refused */
} mvs_law_constant;

/* What a law says of itself; texts live as long as the library. */
typedef struct mvs_law {
  uint32_t struct_size;
  uint32_t constant_count; /* 0 to 8 */
  const char *word;        /* in files and commands: "fung" */
  const char *name;        /* for people: "Fung-type membrane" */
  mvs_law_constant constants[8];
} mvs_law;

/* Describes the law MVS_LEAFLET_LAW_* or MVS_CHORD_LAW_* of that number; MVS_E_ARGUMENT for one
 * that there is not: count up from 1 to see all. */
MVS_API mvs_result mvs_get_leaflet_law(uint32_t law, mvs_law *description);
MVS_API mvs_result mvs_get_chord_law(uint32_t law, mvs_law *description);

/* A leaflet and its tissue. Zero fields take the defaults in brackets. */
typedef struct mvs_leaflet_desc {
  const char *name; /* "A", "P", or free text; required, unique */
  mvs_id id;        /* 0: given by the library */
  uint32_t law;     /* MVS_LEAFLET_LAW_* [spring] */
  uint32_t reserved;
  double thickness;    /* m [1e-3] */
  double constants[8]; /* of the law */
} mvs_leaflet_desc;

/* The laws a chord can follow: tension = area x nominal stress P at strain e = (L - L0) / L0 when
 * longer than L0, else none. */
enum mvs_chord_law_e {
  MVS_CHORD_LAW_LINEAR = 1, /* P = young e */
  /* P = young e below the kink, then slope high: constants are kink [0.05]; high, Pa [100e6] */
  MVS_CHORD_LAW_BILINEAR = 2,
  /* Incompressible Ogden, W = sum of 2 mu_k / alpha_k^2 (l1^alpha_k + l2^alpha_k + l3^alpha_k - 3),
   * up to three terms: constants are mu_1, Pa; alpha_1; mu_2; alpha_2; mu_3; alpha_3. The first
   * term is required; the sum has to stiffen the chord from the start. Past 100 MPa the curve goes
   * on along its tangent. young is not used */
  MVS_CHORD_LAW_OGDEN = 3,
  /* Straight lines between the points of a curve of the valve, then on with the last slope:
   * constants[0] is its index in mvs_valve_desc.curves. young is not used */
  MVS_CHORD_LAW_TABLE = 4
};
typedef uint32_t mvs_chord_law;

/* A measured curve that chordae can follow. */
typedef struct mvs_curve_desc {
  const char *name; /* required, unique */
  mvs_id id;        /* 0: given by the library */
  mvs_array points; /* F64 or F32, k x 2, k >= 2: strain, rising; nominal stress in Pa, not falling,
                       0 at the first point, which says where the chord gets taut */
} mvs_curve_desc;

/* A chord segment between two nodes, tension only. */
typedef struct mvs_chord_desc {
  uint32_t node_a;     /* nearer the papillary head */
  uint32_t node_b;     /* nearer the leaflet */
  uint32_t kind;       /* MVS_CHORD_KIND_MARGINAL ... */
  uint32_t law;        /* MVS_CHORD_KIND_* [linear] */
  double rest_length;  /* m; 0: the distance of its nodes */
  double young;        /* Pa [40e6] */
  double area;         /* m2 [pi/4 * (1 mm)^2] */
  double constants[6]; /* of laws that have them; zeros take the defaults */
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
enum mvs_valve_flags_e {
  MVS_VALVE_FLAG_ORIENT = 1 /* turn triangles so that their normals point into the atrium */
};
typedef uint32_t mvs_valve_flags;

/* Kinds of rings. */
enum mvs_ring_kind_e {
  MVS_RING_KIND_RIGID = 1, /* closed and rigid: holds the whole annulus */
  MVS_RING_KIND_BAND = 2   /* posterior, from trigone to trigone, flexible */
};
typedef uint32_t mvs_ring_kind;

/* A ring or band that is sewn to the annulus. Where it holds the annulus is in nodes_open and
 * nodes_loaded; this is what to draw. */
typedef struct mvs_ring_desc {
  const char *name; /* required, unique */
  mvs_id id;        /* 0: given by the library */
  uint32_t kind;    /* MVS_RING_KIND_* [rigid] */
  uint32_t reserved;
  mvs_array curve; /* F64 or F32, k x 3, m: its points in order */
} mvs_ring_desc;

/* A whole valve. Optional arrays are left zero. Lengths in m. */
typedef struct mvs_valve_desc {
  uint32_t struct_size;
  uint32_t flags;               /* MVS_VALVE_FLAG_* */
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
  mvs_array
      node_origin; /* optional, U32, n: MVS_ARRAY_NODE_ORIGIN of a valve that was operated on */
  const mvs_ring_desc *rings;
  uint32_t ring_count;
  uint32_t curve_count;
  const mvs_curve_desc *curves; /* that chordae of MVS_CHORD_LAW_TABLE follow */
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
