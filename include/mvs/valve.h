/* A valve described by arrays: nodes, leaflets, annulus, chordae, papillary heads and materials.
 * mvs_set_valve (sim.h) takes it; mvs_check_valve reports all its faults.
 *
 * All nodes are in one list: leaflet vertices, chord branch points and papillary heads, in any
 * order. Triangles are wound so that their normals point into the atrium: pressure pushes along the
 * normals. All leaflets form one sheet, joined along the annulus; the annulus is one closed loop of
 * the sheet's boundary. Names are UTF-8, have at most 63 bytes and no control characters, and are
 * unique among parts of their kind. */
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
  MVS_CHORD_KIND_SUTURE = 7       /* a surgical suture that joins two places of the leaflets */
};
typedef uint32_t mvs_chord_kind;

/* Constitutive laws of a leaflet sheet, and the meaning of `constants` for each. A constant of 0
 * takes the default; give -0.0 for a constant that is zero. */
enum mvs_leaflet_law_e {
  /* Mass-spring sheet, bilinear law, Van Gelder stiffness (Tenenholtz et al. 2011): constants are
   * Young's modulus below the kink, Pa [100e3]; above it, Pa [6e6]; strain at the kink [0.25]. */
  MVS_LEAFLET_LAW_SPRING = 1,
  /* The other laws are membranes: constant-strain triangles, plane stress, incompressible, energy
   * density W(I1, I4) in J/m3 with I1 = tr C and I4 = f . C f along the triangle's fibre f. Above
   * 100 kPa, where stresses are 5 to 11 MPa (more than leaflets bear), c exp(q) continues as a
   * parabola in sqrt(q) of the same slope, so that tissue which an operation tears or crushes still
   * comes to rest. Bilinear: the curve of the springs as an isotropic tissue, dW/dI1 =
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
  /* W = mu / 2 (I1 - 3): mu, Pa [200e3]; bending, Pa [112e3]. Young's modulus of the plane sheet is
   * 3 mu, that of the bending stiffness the lesser of 3 mu and `bending`: mu is a modulus of tissue
   * under load, which bends as softly as tissue at rest (the default of the bilinear membrane).
   * Give 1e12, or -0.0 (no limit), for a plate of 3 mu, and bending_scale or
   * MVS_VALVE_FLAG_NO_BENDING for a sheet without bending stiffness. */
  MVS_LEAFLET_LAW_NEO_HOOKEAN = 6
};
typedef uint32_t mvs_leaflet_law;

/* Constitutive laws of a chord: tension = area x nominal stress P at the strain e = (L - L0) / L0
 * where L > L0, else 0. A constant of 0 takes the default; give -0.0 for one that is zero. */
enum mvs_chord_law_e {
  MVS_CHORD_LAW_LINEAR = 1, /* P = young e */
  /* P = young e below the kink, then slope high: constants are kink [0.05]; high, Pa [100e6] */
  MVS_CHORD_LAW_BILINEAR = 2,
  /* Incompressible Ogden, W = sum of 2 mu_k / alpha_k^2 (l1^alpha_k + l2^alpha_k + l3^alpha_k - 3),
   * up to three terms: constants are mu_1, Pa; alpha_1; mu_2; alpha_2; mu_3; alpha_3. The first
   * term is required; the sum must stiffen the chord from zero strain. Above 100 MPa the curve
   * continues along its tangent. `young` is unused */
  MVS_CHORD_LAW_OGDEN = 3,
  /* Linear interpolation of a measured curve, beyond its end with the last slope: constants[0] is
   * its index in mvs_valve_desc.curves. `young` is unused */
  MVS_CHORD_LAW_TABLE = 4
};
typedef uint32_t mvs_chord_law;

/* A constant of a law, in the order of `constants`. */
typedef struct mvs_law_constant {
  const char *key;  /* its word in files: "c0" */
  const char *unit; /* "Pa", or "" for a pure number */
  double fallback;  /* the default, for 0 */
  double low, high; /* the accepted range */
} mvs_law_constant;

/* Description of a law. Texts are static. */
typedef struct mvs_law {
  uint32_t struct_size;
  uint32_t number;         /* MVS_LEAFLET_LAW_* or MVS_CHORD_LAW_* */
  uint32_t constant_count; /* 0 to 8 */
  uint32_t reserved;
  const char *word; /* in files and commands: "fung" */
  const char *name; /* for people: "Fung-type membrane" */
  mvs_law_constant constants[8];
} mvs_law;

/* The laws of leaflets and of chordae in the order of their numbers. MVS_E_ARGUMENT past the last.
 */
MVS_API uint32_t mvs_get_leaflet_law_count(void);
MVS_API mvs_result mvs_get_leaflet_law(uint32_t index, mvs_law *law);
MVS_API uint32_t mvs_get_chord_law_count(void);
MVS_API mvs_result mvs_get_chord_law(uint32_t index, mvs_law *law);

/* A leaflet and its tissue. */
typedef struct mvs_leaflet_desc {
  const char *name;    /* "A", "P", or free text; required, unique */
  mvs_id id;           /* [assigned by the library] */
  mvs_leaflet_law law; /* MVS_LEAFLET_LAW_* [spring, the founding model; bilinear is
                          recommended] */
  uint32_t reserved;
  double thickness;    /* m [1e-3] */
  double constants[8]; /* of the law; 0: its default, -0.0: zero */
} mvs_leaflet_desc;

/* A measured curve that chordae can follow. */
typedef struct mvs_curve_desc {
  const char *name; /* required, unique */
  mvs_id id;        /* [assigned by the library] */
  mvs_array points; /* F64 or F32, k x 2, k >= 2: strain, rising; nominal stress in Pa, not falling,
                       0 at the first point, the strain at which the chord becomes taut */
} mvs_curve_desc;

/* A chord segment between two nodes, tension only. */
typedef struct mvs_chord_desc {
  uint32_t node_a;     /* nearer the papillary head */
  uint32_t node_b;     /* nearer the leaflet */
  mvs_chord_kind kind; /* MVS_CHORD_KIND_* [other] */
  mvs_chord_law law;   /* MVS_CHORD_LAW_* [linear] */
  double rest_length;  /* m [the distance of its nodes] */
  double young;        /* Pa [40e6] */
  double area;         /* m2 [pi/4 * (1 mm)^2] */
  double constants[6]; /* of laws that have them; 0: the default, -0.0: zero */
  mvs_id id;           /* [assigned by the library] */
  const char *name;    /* nullable [made from its kind and scallop, "P2/3"] */
} mvs_chord_desc;

/* A papillary head: a prescribed node that holds chordae. */
typedef struct mvs_head_desc {
  uint32_t node;
  uint32_t reserved;
  mvs_id id;        /* [assigned by the library] */
  const char *name; /* nullable ["PM1", "PM2", ...] */
} mvs_head_desc;

/* Kinds of rings. */
enum mvs_ring_kind_e {
  MVS_RING_KIND_RIGID = 1, /* closed and rigid: holds the whole annulus */
  MVS_RING_KIND_BAND = 2   /* posterior, from trigone to trigone, flexible */
};
typedef uint32_t mvs_ring_kind;

/* A ring or band that is sewn to the annulus, as a curve to draw. nodes_open and nodes_loaded say
 * where it holds the annulus. */
typedef struct mvs_ring_desc {
  const char *name;   /* required, unique */
  mvs_id id;          /* [assigned by the library] */
  mvs_ring_kind kind; /* MVS_RING_KIND_* [rigid] */
  uint32_t reserved;
  mvs_array curve; /* F64 or F32, k x 3, m: its points in order */
} mvs_ring_desc;

/* mvs_valve_desc.flags */
enum mvs_valve_flags_e {
  MVS_VALVE_FLAG_ORIENT = 1 << 0, /* turn triangles so that their normals point into the atrium */
  MVS_VALVE_FLAG_NO_BENDING = 1 << 1 /* leaflets without bending stiffness; bending_scale is 0 */
};
typedef uint32_t mvs_valve_flags;

/* A whole valve. Arrays that are not required may be left zero. Lengths in m. */
typedef struct mvs_valve_desc {
  uint32_t struct_size;
  mvs_valve_flags flags; /* MVS_VALVE_FLAG_* */
  const char *name;      /* nullable ["valve"] */

  mvs_array nodes;        /* F64 or F32, n x 3, required: the open, unloaded valve (rest shape) */
  mvs_array nodes_open;   /* n x 3: unloaded positions of annulus and heads [nodes]; other rows are
                             ignored */
  mvs_array nodes_loaded; /* n x 3: positions of annulus and heads under load [nodes]; other rows
                             are ignored */
  mvs_array nodes_now;    /* n x 3: the initial state [nodes] */
  mvs_array node_origin;  /* U32, n: MVS_ARRAY_NODE_ORIGIN of a valve that was operated on */

  mvs_array triangles;          /* U32, m x 3, required */
  mvs_array triangle_leaflet;   /* U32, m, required: index into leaflets */
  mvs_array triangle_scallop;   /* U32, m: index into scallops [made from leaflets] */
  mvs_array triangle_thickness; /* F64, m: m [that of the leaflet] */
  mvs_array triangle_fibre;     /* F64, m x 3: fibre direction [circumferential] */
  mvs_array annulus;            /* U32, k, required: the boundary loop that the heart holds */

  /* Arrays of structs, each with its number of elements and the stride in bytes between two
   * elements, sizeof the struct; the stride is required where the number is not 0. */
  const mvs_leaflet_desc *leaflets;
  const mvs_chord_desc *chords;
  const mvs_head_desc *heads;
  const mvs_ring_desc *rings;
  const mvs_curve_desc *curves; /* followed by chordae of MVS_CHORD_LAW_TABLE */
  uint32_t leaflet_count, leaflet_stride;
  uint32_t chord_count, chord_stride;
  uint32_t head_count, head_stride;
  uint32_t ring_count, ring_stride;
  uint32_t curve_count, curve_stride;

  const char *const *scallops; /* names, "A1" .. "P3"; nullable [one per leaflet] */
  const mvs_id *scallop_ids;   /* one per scallop, nullable [assigned by the library] */
  uint32_t scallop_count;
  uint32_t reserved;

  double density;           /* kg/m3 [1060] */
  double contact_thickness; /* m, distance of mid-surfaces at which leaflets touch [1e-3, a leaflet
                               thickness] */
  double contact_stiffness; /* Pa, scale of the contact pressure [20e3] */
  double bending_scale;     /* factor on E t^3 / (12 (1 - nu^2)) [1] */
} mvs_valve_desc;

/* Shape of a parametric valve. Both have the dimensions below; defaults that differ are given as
 * [healthy; founding]. */
enum mvs_shape_e {
  /* Leaflets and chordae derived from one closed shape: seals with every tissue. The default. */
  MVS_SHAPE_HEALTHY = 1,
  /* The shape of the founding model (Tenenholtz et al. 2011), made for its springs. */
  MVS_SHAPE_FOUNDING = 2
};
typedef uint32_t mvs_shape;

/* mvs_parametric_desc.branching */
enum mvs_branching_e {
  MVS_BRANCHING_TREES = 1,   /* up to three chordae share a trunk from the papillary head */
  MVS_BRANCHING_STRAIGHT = 2 /* each chord is one segment */
};
typedef uint32_t mvs_branching;

/* A parametric mitral valve. Defaults are those of an adult human; sources in
 * PARAMETRIC.md (installed). The fibrous trigones lie at +-38 degrees from the A point. */
typedef struct mvs_parametric_desc {
  uint32_t struct_size;
  uint32_t vertices;           /* approximate number of leaflet vertices [425]; 200 to 100000 */
  uint32_t chords;             /* approximate number of chord segments, 20 to 400 [100; 80] */
  mvs_branching branching;     /* MVS_BRANCHING_* [trees; straight] */
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
  double annulus_scale;     /* factor on the loaded annulus, rest shape unchanged: dilation [1] */
  double chord_slack;       /* factor on all rest lengths [1] */
  double indentation_depth; /* m, of the clefts on either side of P2 */
  double coaptation_depth;  /* m, of the coaptation line below the annulus plane, closed */
  mvs_shape shape;          /* MVS_SHAPE_* [healthy] */
  mvs_leaflet_law leaflet_law; /* MVS_LEAFLET_LAW_*, default constants [bilinear; spring] */
} mvs_parametric_desc;

#ifdef __cplusplus
}
#endif
#endif
