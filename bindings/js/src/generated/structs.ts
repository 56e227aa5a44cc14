// Generated from include/mvs-api.json by tools/generate.mjs. Do not edit.
// Structs: types of their fields (SI units), and their layouts on wasm32.

import type { ArrayInput, ArrayView, LogCallback, ProgressCallback } from "../arrays.js";
import type { Layout } from "../layout.js";
import type { PartRef, Site as Place } from "../operations.js";
import type {
  Axes,
  Backend,
  BodyKind,
  Branching,
  ChordEnd,
  ChordKind,
  ChordLaw,
  EnsembleOrder,
  EnsembleStart,
  FieldType,
  FindingSource,
  LeafletLaw,
  LengthUnit,
  OpKind,
  ParameterKind,
  PartKind,
  PatientFrame,
  QuantityKind,
  RegionKind,
  RingKind,
  SamRisk,
  Shape,
  SiteKind,
  Solver,
  SurfaceKind,
  SurfacePlace,
  ToolKind,
} from "./enums.js";

/** A failure in words. Texts are zero-terminated and truncated to fit. */
export interface Error {
  code: number;
  /** 1-based line of the file being read, 0 without a file */
  line: number;
  /** the part concerned ("triangle 17", "chord P2/3"), or "" */
  part: string;
  /** one sentence: the fault and the remedy */
  message: string;
}

/** Description of a field of a struct, for bindings, dialogs and scripts. Texts are static. */
export interface FieldInfo {
  /** MVS_FIELD_* */
  type: FieldType;
  /** bytes into the struct */
  offset: number;
  /** 1: it has no default */
  required: number;
  /** range of numbers and counts other than 0, in SI units */
  low: number;
  /** range of numbers and counts other than 0, in SI units */
  high: number;
  name: string;
  /** for people: "Coaptation area" */
  label: string;
  /** "m", "Pa", "m2", or "" */
  unit: string;
  help: string;
  /** "none=0 leaflet=1 head=2", or "" */
  choices: string;
  /**
   * The meaning of a zero or empty field of an operation: "40e6", "as taut as its neighbours"; ""
   * if it has none. The same as a number in SI units, or of a choice; NaN if it is not fixed.
   */
  default_text: string;
  default_value: number;
  /** of a measure: the word of its group, "coaptation"; "" without one */
  group_name: string;
  /** of a measure: MVS_MEASURE_GROUP_*; 0: not in a group */
  group: number;
}

/** A constant of a law, in the order of `constants`. */
export interface LawConstant {
  /** its word in files: "c0" */
  key: string;
  /** "Pa", or "" for a pure number */
  unit: string;
  /** the default, for 0 */
  fallback: number;
  /** the accepted range */
  low: number;
  /** the accepted range */
  high: number;
}

/** Description of a law. Texts are static. */
export interface Law {
  /** MVS_LEAFLET_LAW_* or MVS_CHORD_LAW_* */
  number: number;
  /** 0 to 8 */
  constant_count: number;
  /** in files and commands: "fung" */
  word: string;
  /** for people: "Fung-type membrane" */
  name: string;
  constants: LawConstant[];
}

/** A leaflet and its tissue. */
export interface LeafletDesc {
  /** "A", "P", or free text; required, unique */
  name?: string | null;
  /** [assigned by the library] */
  id?: bigint | number;
  /** MVS_LEAFLET_LAW_* [spring, the founding model; bilinear is recommended] */
  law?: LeafletLaw | number;
  /** m [1e-3] */
  thickness?: number;
  /** of the law; 0: its default, -0.0: zero */
  constants?: ArrayLike<number>;
}

/** A measured curve that chordae can follow. */
export interface CurveDesc {
  /** required, unique */
  name?: string | null;
  /** [assigned by the library] */
  id?: bigint | number;
  /**
   * F64 or F32, k x 2, k >= 2: strain, rising; nominal stress in Pa, not falling, 0 at the first
   * point, the strain at which the chord becomes taut
   */
  points?: ArrayInput;
}

/** A chord segment between two nodes, tension only. */
export interface ChordDesc {
  /** nearer the papillary head */
  node_a?: number;
  /** nearer the leaflet */
  node_b?: number;
  /** MVS_CHORD_KIND_* [other] */
  kind?: ChordKind | number;
  /** MVS_CHORD_LAW_* [linear] */
  law?: ChordLaw | number;
  /** m [the distance of its nodes] */
  rest_length?: number;
  /** Pa [40e6] */
  young?: number;
  /** m2 [pi/4 * (1 mm)^2] */
  area?: number;
  /** of laws that have them; 0: the default, -0.0: zero */
  constants?: ArrayLike<number>;
  /** [assigned by the library] */
  id?: bigint | number;
  /** nullable [made from its kind and scallop, "P2/3"] */
  name?: string | null;
}

/** A papillary head: a prescribed node that holds chordae. */
export interface HeadDesc {
  node?: number;
  /** [assigned by the library] */
  id?: bigint | number;
  /** nullable ["PM1", "PM2", ...] */
  name?: string | null;
}

/**
 * A ring or band that is sewn to the annulus, as a curve to draw. nodes_open and nodes_loaded say
 * where it holds the annulus.
 */
export interface RingDesc {
  /** required, unique */
  name?: string | null;
  /** [assigned by the library] */
  id?: bigint | number;
  /** MVS_RING_KIND_* [rigid] */
  kind?: RingKind | number;
  /** F64 or F32, k x 3, m: its points in order */
  curve?: ArrayInput;
}

/** A whole valve. Arrays that are not required may be left zero. Lengths in m. */
export interface ValveDesc {
  /** MVS_VALVE_FLAG_* */
  flags?: number;
  /** nullable ["valve"] */
  name?: string | null;
  /** F64 or F32, n x 3, required: the open, unloaded valve (rest shape) */
  nodes?: ArrayInput;
  /** n x 3: unloaded positions of annulus and heads [nodes]; other rows are ignored */
  nodes_open?: ArrayInput;
  /** n x 3: positions of annulus and heads under load [nodes]; other rows are ignored */
  nodes_loaded?: ArrayInput;
  /** n x 3: the initial state [nodes] */
  nodes_now?: ArrayInput;
  /** U32, n: MVS_ARRAY_NODE_ORIGIN of a valve that was operated on */
  node_origin?: ArrayInput;
  /** U32, m x 3, required */
  triangles?: ArrayInput;
  /** U32, m, required: index into leaflets */
  triangle_leaflet?: ArrayInput;
  /** U32, m: index into scallops [made from leaflets] */
  triangle_scallop?: ArrayInput;
  /** F64, m: m [that of the leaflet] */
  triangle_thickness?: ArrayInput;
  /** F64, m x 3: fibre direction [circumferential] */
  triangle_fibre?: ArrayInput;
  /** U32, k, required: the boundary loop that the heart holds */
  annulus?: ArrayInput;
  /**
   * Arrays of structs, each with its number of elements and the stride in bytes between two
   * elements, sizeof the struct; the stride is required where the number is not 0.
   */
  leaflets?: readonly LeafletDesc[];
  chords?: readonly ChordDesc[];
  heads?: readonly HeadDesc[];
  rings?: readonly RingDesc[];
  /** followed by chordae of MVS_CHORD_LAW_TABLE */
  curves?: readonly CurveDesc[];
  /** names, "A1" .. "P3"; nullable [one per leaflet] */
  scallops?: readonly string[];
  /** one per scallop, nullable [assigned by the library] */
  scallop_ids?: readonly (bigint | number)[];
  /** kg/m3 [1060] */
  density?: number;
  /** m, distance of mid-surfaces at which leaflets touch [1e-3, a leaflet thickness] */
  contact_thickness?: number;
  /** Pa, scale of the contact pressure [20e3] */
  contact_stiffness?: number;
  /** factor on E t^3 / (12 (1 - nu^2)) [1] */
  bending_scale?: number;
}

/**
 * A parametric mitral valve. Defaults are those of an adult human; sources in PARAMETRIC.md
 * (installed). The fibrous trigones lie at +-38 degrees from the A point.
 */
export interface ParametricDesc {
  /** approximate number of leaflet vertices [425]; 200 to 100000 */
  vertices?: number;
  /** approximate number of chord segments, 20 to 400 [100; 80] */
  chords?: number;
  /** MVS_BRANCHING_* [trees; straight] */
  branching?: Branching | number;
  /** m, septal-lateral diameter */
  annulus_ap?: number;
  /** m, intercommissural diameter */
  annulus_cc?: number;
  /** m */
  saddle_height?: number;
  /** m, leaflet height at A2 */
  anterior_height?: number;
  /** m, at P2 */
  posterior_height?: number;
  /** m */
  commissure_height?: number;
  /** m */
  thickness?: number;
  /** m, papillary tip to annulus plane */
  papillary_depth?: number;
  /** m, between the two tips */
  papillary_separation?: number;
  /** loaded / open annulus size */
  annulus_contraction?: number;
  /** factor on the loaded annulus, rest shape unchanged: dilation [1] */
  annulus_scale?: number;
  /** factor on all rest lengths [1] */
  chord_slack?: number;
  /** m, of the clefts on either side of P2 */
  indentation_depth?: number;
  /** m, of the coaptation line below the annulus plane, closed */
  coaptation_depth?: number;
  /** MVS_SHAPE_* [healthy] */
  shape?: Shape | number;
  /** MVS_LEAFLET_LAW_*, default constants [bilinear; spring] */
  leaflet_law?: LeafletLaw | number;
}

/** Options of a new simulator. */
export interface SimDesc {
  /** MVS_BACKEND_* */
  backend?: Backend | number;
  /** Receives one line of text without its end of line. Nullable: silent. */
  log?: LogCallback | null;
  /**
   * Receives, during long calls, the completed share in [0, 1] and the largest out-of-balance nodal
   * force in N; a non-zero return value cancels the call. Nullable.
   */
  progress?: ProgressCallback | null;
}

/** Load on the valve. */
export interface LoadCase {
  /** Pa, ventricle minus atrium, on every leaflet face, following it; at most 400 kPa either way */
  pressure: number;
  /** position of annulus and heads: 0 open .. 1 loaded */
  boundary_fraction: number;
}

/** Load on the valve. */
export interface LoadCaseInput {
  /** Pa, ventricle minus atrium, on every leaflet face, following it; at most 400 kPa either way */
  pressure?: number;
  /** position of annulus and heads: 0 open .. 1 loaded */
  boundary_fraction?: number;
}

/** Options of mvs_settle. */
export interface SettleOptions {
  /** MVS_SOLVER_* [newton] */
  solver?: Solver | number;
  /** [1000 for newton, 20000 implicit, 2000000 explicit] */
  max_iterations?: number;
  /** MVS_SETTLE_* */
  flags?: number;
  /** N, largest out-of-balance force on a node at rest, 1e-12 to 1e3 [1e-5] */
  residual?: number;
  /**
   * s, time step of the dynamic solvers [implicit 1e-3; explicit: stable on this valve, at most
   * 8e-6]; 1e-9 to 1
   */
  dt?: number;
  /** 1/s, mass-proportional, of the dynamic solvers, 1e-6 to 1e6 [explicit 500] */
  damping?: number;
}

/** Outcome of a settle or step (fields: MVS_STRUCT_STATS). */
export interface Stats {
  /**
   * 1: at rest, as the last settle, or a step that found nothing to move, decided, and nothing has
   * changed since
   */
  converged: number;
  /** Newton iterations, or time steps */
  iterations: number;
  /** active contact pairs at the end */
  contact_pairs: number;
  /** MVS_LOWERED_*: accuracy that a step gave up */
  lowered: number;
  /** 1: the last settle found a stable equilibrium, and nothing has changed since */
  stable: number;
  /**
   * N, largest out-of-balance force on a free node or tool point. An explicit step finds its forces
   * once, at its start: residual and energy are of that state
   */
  residual: number;
  /**
   * J, potential energy at the end, of tissue with a node that moves. Without the work of the
   * pressure at the free edge, which has no potential: derivatives of the energy differ from forces
   * there
   */
  energy: number;
  /** J, kinetic energy at the end */
  kinetic: number;
  /** s, elapsed time */
  wall_s: number;
  /** N/m */
  stiffness_margin: number;
  /** 1/s */
  growth_rate: number;
}

/** Options of mvs_step. */
export interface StepOptions {
  /** MVS_SOLVER_IMPLICIT [default] or MVS_SOLVER_EXPLICIT */
  solver?: Solver | number;
  /** s [as for mvs_settle]; 1e-9 to 1 */
  dt?: number;
  /** 1/s, mass-proportional [0 implicit, 500 explicit] */
  damping?: number;
  /**
   * Largest amount of work of an implicit step, 4 to 10000 [64]: energy passes, assemblies,
   * iterations of conjugate gradients, factorisations or parts of one. A count, not a time, so that
   * the same calls give the same bits on any machine; mvs_stats.lowered reports the accuracy that a
   * short budget costs. Searches for contact are not counted: on thousands of vertices they may
   * take most of a step beside a tool that moves.
   */
  budget?: number;
}

/** A named part of the valve. Names are unique within their kind, of at most 63 bytes. */
export interface Part {
  id: bigint;
  /** MVS_PART_* */
  kind: PartKind;
  /** row in the arrays of its kind */
  index: number;
  name: string;
}

/** A chord segment in words and figures, for tables. Texts are valid while the snapshot is held. */
export interface ChordInfo {
  /** MVS_CHORD_KIND_* */
  kind: ChordKind;
  id: bigint;
  name: string;
  /** names of the papillary heads above it, joined by '+'; "" without one */
  heads: string;
  /** of those in which it, or its branches, end, joined by '+' */
  scallops: string;
  /** m, now */
  length: number;
  /** m */
  rest_length: number;
  /** engineering strain, negative when slack */
  strain: number;
  /** N */
  tension: number;
  /** MVS_CHORD_FLAG_* */
  flags: number;
}

/** Whether a snapshot is at rest. */
export interface Rest {
  /** 1: at rest under its load, as a settle or step found it */
  at_rest: number;
  /** N, out-of-balance force up to which it was found at rest; 0 if it is not */
  tolerance: number;
}

/**
 * Stability of the equilibrium that a snapshot at rest is in, under its load and tools. The tangent
 * stiffness is K = Ks + N, Ks symmetric, N the skew part that the follower pressure has at the free
 * edge. In overdamped motion, D dx/dt = -K x with a damping D of 500 1/s times the mass, a small
 * disturbance grows or falls with the eigenvalues of -D^-1 K: the equilibrium is stable where all
 * their real parts are negative. That is so wherever Ks is positive definite. Branch points with
 * less stiffness than 1e-3 N/m, whose chordae are slack or carry next to nothing, are eliminated:
 * they follow the other nodes without force.
 */
export interface Stability {
  /** 1: growth_rate is at most 1e-3 1/s, or Ks is positive definite */
  stable: number;
  /**
   * N/m, smallest eigenvalue of Ks: near 0 a fold is about to snap. Below 0 beside a growth_rate
   * below 0, damping and the follower pressure hold the fold
   */
  stiffness_margin: number;
  /** 1/s, largest real part of an eigenvalue of -D^-1 K */
  growth_rate: number;
}

/**
 * Measures of a valve (fields: MVS_STRUCT_MEASURES). Definitions and sources:
 * libmvs/measure/DEFINITIONS.md. The annulus surface is the one that spans the annulus; the annulus
 * plane is the plane of least squares. Figures of leaflets that cross (intersections > 0) do not
 * count.
 */
export interface Measures {
  /** pairs of triangles that cross (exact test) */
  intersections: number;
  /** m2, 0 when sealed */
  regurgitant_orifice_area: number;
  /** m2, of one side */
  coaptation_area: number;
  /** m, along the coaptation line */
  coaptation_length_mean: number;
  /** m */
  coaptation_length_min: number;
  /** m */
  coaptation_length_max: number;
  /** m, extent along the valve axis, central AP plane */
  coaptation_height: number;
  /** m, annulus plane to its upper end, central AP plane */
  coaptation_depth: number;
  /** m, of a ball that rests on the leaflets below the plane */
  tenting_height: number;
  /** m2, below the annulus surface, central AP plane */
  tenting_area: number;
  /** m3, below the annulus surface */
  tenting_volume: number;
  /** m, highest leaflet point above the annulus surface */
  billow_height: number;
  /** m3, above the annulus surface */
  billow_volume: number;
  /** m */
  annulus_ap: number;
  /** m */
  annulus_cc: number;
  /** m */
  annulus_perimeter: number;
  /** m2, of the surface that spans it */
  annulus_area_3d: number;
  /** m2, projected on its plane */
  annulus_area: number;
  /** m */
  annulus_saddle_height: number;
  /** rad */
  annulus_nonplanar_angle: number;
  /** engineering strain, without sutures; 0 if slack */
  max_chord_strain: number;
  /** N, without sutures */
  max_chord_tension: number;
  /** largest principal engineering strain */
  max_leaflet_strain: number;
  /** Pa, largest principal Cauchy stress */
  max_leaflet_stress: number;
  /** m2 */
  leaflet_area: number;
  /** chordae strained beyond the limit of their kind */
  chords_over_strain: number;
  /** chordae that carry more than the limit of their kind */
  chords_over_tension: number;
  /** 1: at rest under its load, as a settle or step found it */
  at_rest: number;
  /**
   * 1: the pressure closes the valve. A leak may be graded if both are 1: otherwise these are
   * measures of a moving, an operated or an open valve
   */
  under_load: number;
  /** largest principal strain: half of the tissue has at most this */
  leaflet_strain_p50: number;
  /** 95 % of the tissue, by rest area */
  leaflet_strain_p95: number;
  /** 99 %; one bad triangle does not change it */
  leaflet_strain_p99: number;
  /** Pa, largest principal Cauchy stress, in the same way */
  leaflet_stress_p50: number;
  /** Pa */
  leaflet_stress_p95: number;
  /** Pa */
  leaflet_stress_p99: number;
}

/**
 * Measures of one region of the leaflets. Areas and volumes of the scallops add up to those of
 * mvs_measures. Definitions: libmvs/measure/DEFINITIONS.md. Texts are valid while the snapshot is
 * held.
 */
export interface RegionMeasures {
  /** MVS_REGION_* */
  kind: RegionKind;
  /** "A2"; of a commissure the scallops there, "A1-P1"; distinct */
  name: string;
  /** m2, of one side: half of the coapted tissue of the region */
  coaptation_area: number;
  /** m, along its part of the coaptation line; 0 without one */
  coaptation_length_mean: number;
  /** m, the same */
  coaptation_length_min: number;
  /** m2, the part of the orifice nearest to this tissue */
  orifice_area: number;
  /** m, widest ball in that part of the orifice; 0 when sealed */
  gap: number;
  /** m, highest node above the annulus surface */
  billow_height: number;
  /** m3 */
  billow_volume: number;
  /** m, deepest point on the atrial side below the annulus plane */
  tenting_height: number;
  /** m3 */
  tenting_volume: number;
}

/**
 * A part of the regurgitant orifice that is connected in itself. Texts are valid while the snapshot
 * is held.
 */
export interface OrificePart {
  /** of MVS_ARRAY_ORIFICE_TRIANGLES, see MVS_ARRAY_ORIFICE_PART */
  triangles: number;
  /** m2 */
  area: number;
  /** m, widest ball in it */
  gap: number;
  /** m */
  centroid: number[];
  /** unit, into the atrium: mean normal, the direction of the jet */
  direction: number[];
  /** scallops of the anterior leaflet beside it, joined by '+', or "" */
  anterior: string;
  /** scallops of the other leaflets beside it, joined by '+', or "" */
  posterior: string;
  /** commissures beside it, joined by '+', or "" */
  commissures: string;
}

/** Distances between two shapes, in m. Node figures are NaN where the meshes do not match. */
export interface Comparison {
  /** 1: node-to-node figures exist */
  same_mesh: number;
  /** node to node, as they lie */
  node_rms: number;
  /** node to node, as they lie */
  node_max: number;
  /** symmetric surface distance, as they lie */
  surface_rms: number;
  /** symmetric surface distance, as they lie */
  surface_max: number;
  /** after the best rigid motion */
  node_rms_registered: number;
  /** after the best rigid motion */
  node_max_registered: number;
  /** after the best rigid motion */
  surface_rms_registered: number;
  /** after the best rigid motion */
  surface_max_registered: number;
  /** rows of [R | t]: b ~ R a + t, t in m */
  registration: number[];
}

/** Options of mvs_snapshot_measure_cost. */
export interface CostOptions {
  /** MVS_BACKEND_* */
  backend?: Backend | number;
  /** Pa, atrium minus ventricle in diastole, 20 or more [MVS_DIASTOLE_PA] */
  pressure?: number;
  /** N, at rest, as in mvs_settle_options [1e-5] */
  residual?: number;
  /** m3/s through the open valve, MVS_FLOW_MIN to MVS_FLOW_MAX [not known: no gradient] */
  flow?: number;
  /** kg/m3, of blood [1060] */
  density?: number;
  /** discharge coefficient, 0.1 to 1 [0.85] */
  discharge?: number;
  /**
   * F64 or F32, k x 3, m: points of the septum where it faces the anterior leaflet in systole, in
   * front of the coaptation, within 0.1 m of it, and 1 mm or more apart [not known: no risk of SAM]
   */
  septum?: ArrayInput;
  /** As in mvs_sim_desc, of the opening. Nullable. */
  progress?: ProgressCallback | null;
}

/**
 * Cost of a repair (fields: MVS_STRUCT_COST). Definitions and sources:
 * libmvs/measure/DEFINITIONS.md. A figure that is not known is NaN.
 */
export interface Cost {
  /** 1: the open valve came to rest; otherwise open_area is NaN */
  opened: number;
  /** m2, smallest cross-section of the open valve */
  open_area: number;
  /** Pa, mean pressure drop of the flow through open_area */
  gradient: number;
  /**
   * m, tissue from annulus to free edge, unloaded, central AP plane or, with a seam there, beside
   * it
   */
  anterior_height: number;
  /** m, the same of the posterior leaflet */
  posterior_height: number;
  /** m, from annulus to coaptation, closed, in the same way */
  anterior_length: number;
  /** m, the same of the posterior leaflet */
  posterior_length: number;
  /** anterior_length / posterior_length */
  length_ratio: number;
  /** m, from coaptation in the central AP plane to the nearest point of the septum */
  septal_distance: number;
  /** N, largest pull on a node of the annulus */
  annulus_force_max: number;
  /** N, sum of the magnitudes over the nodes of the annulus */
  annulus_force_sum: number;
  /** MVS_SAM_* */
  sam_risk: SamRisk;
  /** rings and bands, whose sutures bear the pull of the annulus */
  rings: number;
  /** as in mvs_measures */
  chords_over_strain: number;
  /** as in mvs_measures */
  chords_over_tension: number;
}

/** An optional point in space. */
export interface Point {
  /** m */
  at?: ArrayLike<number>;
  /** 1: `at` is given; 0: left out */
  given?: number | boolean;
}

/** A place on a leaflet. */
export interface Site {
  /** MVS_SITE_* */
  how?: SiteKind | number;
  /** node or triangle */
  index?: number;
  /** of an anatomical site */
  scallop?: bigint | number;
  u?: ArrayLike<number>;
}

/** Sets the rest length of a chord; exactly one of length, factor and drag_to is given. */
export interface OpChordLength {
  chord?: bigint | number;
  /** m */
  length?: number;
  /** on its present rest length */
  factor?: number;
  /**
   * new position of the leaflet end: sets the length at which the chord reaches it under its
   * present tension
   */
  drag_to?: Point;
}

/** Cuts a chord. Segments that lose their support are removed with it. */
export interface OpChordRemove {
  chord?: bigint | number;
}

/** Attaches a new chord from a papillary head to a leaflet; makes a chord. */
export interface OpChordAdd {
  head?: bigint | number;
  site?: Site;
  /**
   * m [as taut as its neighbours: its distance in the rest shape times the median ratio of rest
   * length to distance of the five nearest chords of the head; its distance if the head has no
   * chords. Slack where these lie far from the site or on the other leaflet: give a length there]
   */
  length?: number;
  /** Pa [40e6] */
  young?: number;
  /** m2 [pi/4 * (1 mm)^2] */
  area?: number;
  /** MVS_CHORD_KIND_* except trunk and suture [other] */
  type?: ChordKind | number;
  /** nullable [made by the library, "P2/9"] */
  name?: string | null;
}

/**
 * Moves one end of a chord to another place of a leaflet, or to another papillary head. The leaflet
 * end keeps the length of the chord. At a head the chord is attached anew with the default length
 * of mvs_op_chord_add, at which the leaflet can close.
 */
export interface OpChordTransfer {
  chord?: bigint | number;
  /** MVS_CHORD_END_* [leaflet] */
  end?: ChordEnd | number;
  /** new place of the leaflet end */
  site?: Site;
  /** new head of the head end */
  head?: bigint | number;
  /** m [leaflet end: unchanged; head end: that of mvs_op_chord_add] */
  length?: number;
}

/**
 * Scales the annulus about its centroid in its own frame, open and under load: to model pathologies
 * and to size rings. At least one of its fields is given. MVS_E_OP if a ring or band holds the
 * annulus, or if its perimeter under load would be below 25 % or above 300 % of that at rest, the
 * limits of a ring.
 */
export interface OpAnnulusScale {
  /** in every direction [1] */
  factor?: number;
  /** additional factor along the anteroposterior axis [1] */
  ap?: number;
  /** additional factor along the intercommissural axis [1] */
  cc?: number;
}

/**
 * Sews a rigid ring to the annulus: the annulus nodes move onto the curve at equal fractions of the
 * arc length, with and without load. Makes a ring, which replaces an existing ring or band.
 */
export interface OpRing {
  /**
   * F64, k x 3, m, k >= 8: closed, in any frame, of any winding and start, its first point repeated
   * at its end or not; or left out with a size
   */
  curve?: ArrayInput;
  /**
   * m, intercommissural width of a parametric ring: 0.034 is labelled 34. Measured proportions of
   * the Physio II 34, not catalogue data
   */
  size?: number;
  /** AP over CC width [26.1 / 34.7] */
  ap_ratio?: number;
  /** m, height of the saddle [4.7 / 34.7 of the CC width] */
  saddle?: number;
  /** F64, k x 3, m, k >= 3: points of the ring in the frame of `curve` */
  landmarks?: ArrayInput;
  /** F64, k x 3, m: their positions in the valve [best rigid fit to the annulus under load] */
  landmarks_at?: ArrayInput;
  /** nullable ["ring"] */
  name?: string | null;
}

/**
 * Sews a flexible band along the posterior annulus from trigone to trigone: it shortens that part
 * of the annulus to its length, towards the line between the fixed trigones. Makes a ring.
 */
export interface OpBand {
  /** m; or give a factor */
  length?: number;
  /** on the present length of that part under load */
  factor?: number;
  /** nullable ["band"] */
  name?: string | null;
}

/** Attaches artificial chordae (ePTFE) to a leaflet; makes a chord. */
export interface OpNeochord {
  head?: bigint | number;
  site?: Site;
  /** m [that of mvs_op_chord_add] */
  length?: number;
  /** parallel strands [2] */
  strands?: number;
  /** Pa [ePTFE, libmvs/surgery/README.md] */
  young?: number;
  /** m, of one strand [0.3e-3] */
  diameter?: number;
  /** nullable [made by the library] */
  name?: string | null;
}

/** Moves a papillary head, open and under load. */
export interface OpHeadMove {
  head?: bigint | number;
  /** m, along the axes of `frame` */
  by?: ArrayLike<number>;
  /** MVS_AXES_* [scene] */
  frame?: Axes | number;
}

/**
 * Joins two free edges (edge to edge: a clip or an Alfieri stitch) by sutures one contact thickness
 * long; makes a chord, the middle one, about which `angle` turns it in the plane of the leaflets.
 * It is placed on the open valve: positions return to the rest shape with zero velocity.
 */
export interface OpClip {
  /** scallop [A2] */
  anterior?: bigint | number;
  /** scallop [P2] */
  posterior?: bigint | number;
  /** along the scallops, -1 to 1 [0: the middle] */
  position?: number;
  /** m, of the free edge that is joined [5e-3] */
  width?: number;
  /** m, from the free edge into the leaflets [4e-3] */
  reach?: number;
  /** nullable ["clip"] */
  name?: string | null;
  /** rad, anticlockwise as seen from the atrium [0: across the free edge] */
  angle?: number;
}

/**
 * Resects a part of a scallop from its free edge and sews the sides of the gap together: a
 * triangle, a quadrangle, or a given outline. A quadrangle also shortens the annulus below by the
 * width of its base. It is made on the open valve: positions return to the rest shape with zero
 * velocity.
 */
export interface OpResect {
  /** [P2] */
  scallop?: bigint | number;
  /** of its centre along the scallop, -1 to 1 [0] */
  position?: number;
  /** m, at the free edge [8e-3] */
  width?: number;
  /** m, towards the annulus; 0: a triangle */
  base_width?: number;
  /** m, from the free edge [0.8 of the scallop's height there] */
  depth?: number;
  /**
   * F64, k x 3, m, k >= 3: points on the present leaflet, in order, the first and the last on or
   * beyond the free edge; replaces all fields above
   */
  outline?: ArrayInput;
}

/**
 * Enlarges a leaflet by a pericardial patch: replaces the tissue within an ellipse by a larger
 * piece, which bulges at rest.
 */
export interface OpPatch {
  /** the centre */
  site?: Site;
  /** m, circumferential [12e-3] */
  width?: number;
  /** m, radial [8e-3] */
  height?: number;
  /** area of the patch over that of the hole [1.3] */
  area_factor?: number;
  /** m [0.4e-3] */
  thickness?: number;
}

/** Size of a history. */
export interface History {
  /** operations that can be undone */
  done: number;
  /** operations that can be redone */
  undone: number;
  checkpoints: number;
}

/** One operation of a history. */
export interface HistoryEntry {
  /** MVS_OP_* */
  kind: OpKind;
  /** equal for operations of one group; 0: ungrouped */
  group: bigint;
  /** id of the part that it made; 0: it made no part */
  made: bigint;
  /** "shorten chord P2/3 to 75 %" */
  title: string;
  /** the name of its group, or "" */
  in_group: string;
}

/** A kind of operation, for dialogs, bindings and scripts. All texts are static. */
export interface OpInfo {
  /** MVS_OP_* */
  kind: OpKind;
  /** sizeof its struct */
  size: number;
  /** number of fields after mvs_op */
  fields: number;
  /** "chord_length" */
  name: string;
  /** one sentence */
  help: string;
}

/** Optional contents of a plan besides the operations. */
export interface PlanOptions {
  /** 1: the measures before and after each operation */
  measures?: number | boolean;
  /** UTF-8, nullable */
  author?: string | null;
  /** UTF-8, nullable */
  notes?: string | null;
}

/** Outcome of a replay. */
export interface Replay {
  /** operations applied */
  operations: number;
  /** 1: the plan was made on this valve */
  same_valve: number;
  /** 1: the final hash equals that of the plan; of a journal: its last record was whole */
  same_result: number;
}

/**
 * A body of a convex tool, in the frame of the hand: the origin is the hand's `position`, the axes
 * turn with its `orientation`. Every coordinate is within 0.3 m.
 */
export interface BodyDesc {
  /** MVS_BODY_KIND_* */
  kind?: BodyKind | number;
  /** n x 3: m, of a hull, at least 4, not all near one plane */
  vertices?: ArrayInput;
  /** m */
  position?: ArrayLike<number>;
  /** m */
  end?: ArrayLike<number>;
  /** m, edges of a box; size[0]: radius of the circles of a cylinder or cone; 1e-4 to 0.3 */
  size?: ArrayLike<number>;
  /** of a box, w x y z of a quaternion of any length; all 0: the hand's */
  orientation?: ArrayLike<number>;
  /**
   * m, of a ball or capsule 1e-4 to 0.02 [2e-3]; of others, by which they are rounded outwards, 0
   * to 0.02
   */
  radius?: number;
}

/** A new tool; kind and position are required. */
export interface ToolDesc {
  /** MVS_TOOL_KIND_* */
  kind?: ToolKind | number;
  /** m, of the hand: centre of the ball, of the tip's round end, of the grip, origin of the bodies */
  position?: ArrayLike<number>;
  /** of a rod, from its tip to its handle, any length [0, 0, 1] */
  axis?: ArrayLike<number>;
  /** m, of a ball or rod; 1e-4 to 0.02 [2e-3] */
  radius?: number;
  /** m, of a rod between the centres of its ends; 1e-3 to 0.3 [40e-3] */
  length?: number;
  /**
   * N/m, of the spring between hand and tool; 1 to 1e5 [200]; a rod has half of it at each end, a
   * convex tool a quarter at each point of its frame
   */
  stiffness?: number;
  /**
   * N, of that spring; 1e-3 to 100 [5]; a rod has half of it at each end, a convex tool a quarter
   * at each point of its frame
   */
  max_force?: number;
  /** m; a grasp takes the nearest free vertex of a leaflet within it [2e-3] */
  reach?: number;
  /** 1: a grasp takes `node`, a leaflet vertex or branch point, at any distance */
  by_node?: number | boolean;
  /** with by_node */
  node?: number;
  /** of a convex tool, 1 to MVS_MAX_BODIES */
  bodies?: readonly BodyDesc[];
  /** of a convex tool, w x y z of a quaternion of any length [1 0 0 0] */
  orientation?: ArrayLike<number>;
  /** 1: refuses a hull with vertices that are no corners of it; 0: drops them and logs a warning */
  strict_hulls?: number | boolean;
}

/** A tool in a snapshot. */
export interface ToolState {
  kind: ToolKind;
  id: bigint;
  /** m, of the hand */
  position: number[];
  /** of the hand's rod, of length 1; 0 for others */
  axis: number[];
  /** m, of the tool: the held node, the centre of ball or tip */
  proxy: number[];
  /** of the rod, of length 1; 0 for others */
  proxy_axis: number[];
  /** N, on the hand */
  force: number[];
  /** N m, on the hand about `position`, of a rod or convex tool */
  torque: number[];
  /**
   * m, from the surface of a tool that pushes to the mid-surface of the nearest leaflet, of a
   * convex tool also to the surface of a chord; infinity without leaflets, 0 for a grasp
   */
  distance: number;
  /** m; length of a convex tool: the arm of its frame */
  radius: number;
  /** m; length of a convex tool: the arm of its frame */
  length: number;
  /** N/m, N: of the spring between hand and tool */
  stiffness: number;
  /** N/m, N: of the spring between hand and tool */
  max_force: number;
  /** held by a grasp; UINT32_MAX for others */
  node: number;
  /** 1: tissue acts on it; always 1 for a grasp */
  touching: number;
  /** of the hand of a convex tool, w x y z of length 1; 0 for others */
  orientation: number[];
  /** of the convex tool, whose origin is `proxy` */
  proxy_orientation: number[];
  /** of a convex tool */
  body_count: number;
  /** of all its bodies */
  vertex_count: number;
}

/** A body of a convex tool: the hull of `vertices`, rounded by `radius`. */
export interface ToolBody {
  /** as it was given */
  kind: BodyKind;
  /** m */
  radius: number;
  /** m, 3 x MVS_TYPE_F64, in the frame of the hand */
  vertices: ArrayView;
  /** 3 x MVS_TYPE_U32, of the surface of the hull with outward normals; none for a ball or capsule */
  triangles: ArrayView;
}

/** Profile of a settle or step (fields: MVS_STRUCT_PROFILE). */
export interface Profile {
  /** MVS_SKIPPED_*: work not done in the whole settle or step */
  skipped: number;
  /** a factorisation spread over several steps counts in the last one */
  factorisations: number;
  /** iterations with a diagonal shift for positive definiteness */
  shifted: number;
  /** broad phases run */
  broad_phases: number;
  /** new sparsity patterns with their symbolic analysis */
  orderings: number;
  /** iterations of iterative linear solvers */
  linear_iterations: number;
  /** evaluations of energy, gradient or Hessian over all terms */
  passes: number;
  /**
   * Coarser meshes, over which large valves close: crossings removed after interpolation, and
   * shapes that were given up because crossings remained.
   */
  untangled: number;
  discarded_levels: number;
  /** s, wall time of each phase */
  phase_s: number[];
}

/** Target of coarsening: exactly one field is given. */
export interface CoarsenOptions {
  /** exact number of leaflet vertices */
  vertices?: number;
  /** m, approximate mean length of edges */
  edge?: number;
}

/** Result of coarsening. */
export interface Coarsening {
  /** of the leaflets */
  vertices_before: number;
  vertices: number;
  /** chordae that end at another vertex, merged ones included */
  chords_moved: number;
  /** chordae merged with another one between the same nodes */
  chords_merged: number;
  /** m, largest displacement of the end of a chord */
  chord_move: number;
  /** m, largest distance of a removed vertex from the coarse surface */
  surface_max: number;
  /** m, root mean square of that over all vertices of the fine level */
  surface_rms: number;
  /** of a triangle: 1 equilateral, 0 flat */
  worst_quality: number;
}

/** Options of mvs_ensemble_run. */
export interface EnsembleOptions {
  /** closures, the plain one included [8]; 1 to 1000 */
  members?: number;
  /** MVS_ENSEMBLE_START_* [rest] */
  start?: EnsembleStart | number;
  /** MVS_BACKEND_* */
  backend?: Backend | number;
  /** MVS_ENSEMBLE_FLAG_* */
  flags?: number;
  /** of the perturbations: any number */
  seed?: bigint | number;
  /** m, largest displacement of a node of the initial shape [0.5e-3]; at most 5e-3 */
  perturbation?: number;
  /** m, shortest wavelength of a perturbation [5e-3]; 1e-4 to 1 */
  wavelength?: number;
  /** m, shapes with no node farther apart are one equilibrium [0.1e-3] */
  tolerance?: number;
  /** As in mvs_sim_desc, over all members. Nullable. */
  progress?: ProgressCallback | null;
}

/**
 * Summary over the members at rest. Shapes are those of the leaflets without registration. Figures
 * without a pair are 0: fewer than two members at rest or, for distances from member 0, member 0
 * not at rest.
 */
export interface EnsembleSummary {
  members: number;
  /** members at rest */
  converged: number;
  /**
   * distinct shapes among them; a shape and its mirror image, both equilibria of a symmetric valve,
   * are two
   */
  equilibria: number;
  /** the member of lowest potential energy; UINT32_MAX without one at rest */
  lowest: number;
  /** m, node to node, RMS over all pairs of members */
  node_rms: number;
  /** m, largest distance of one node between any two members */
  node_max: number;
  /** m, surface distance from member 0, RMS over the other members */
  surface_rms: number;
  /** m, largest distance from the surface of member 0 */
  surface_max: number;
}

/** One member. */
export interface EnsembleMember {
  /** 1: at rest */
  converged: number;
  /** equal pressure increments */
  increments: number;
  /** MVS_ENSEMBLE_ORDER_* */
  order: EnsembleOrder;
  /** number of its shape, 0 for the first member at rest; UINT32_MAX: not at rest */
  equilibrium: number;
  /** 1: numbers left their range; its snapshot is the initial one */
  diverged: number;
  /** m, largest displacement of a node of its initial shape */
  perturbation: number;
  /** m, node to node from member 0 */
  node_rms: number;
  /** m, node to node from member 0 */
  node_max: number;
  /** m, symmetric surface distance from member 0 */
  surface_rms: number;
  /** m, symmetric surface distance from member 0 */
  surface_max: number;
  /** s, duration of a dynamic pressure ramp before settling; 0: settled after each increment */
  ramp: number;
}

/**
 * One parameter. Positions are the present ones of prescribed nodes: their targets move alike, open
 * and loaded.
 */
export interface Parameter {
  /** MVS_PARAMETER_* */
  kind?: ParameterKind | number;
  index?: number;
  component?: number;
  /** F64 or F32, n x 3, m: of MVS_PARAMETER_BOUNDARY_MODE, zero at free nodes */
  mode?: ArrayInput;
}

/** One quantity. */
export interface Quantity {
  /** MVS_QUANTITY_* */
  kind?: QuantityKind | number;
  index?: number;
  component?: number;
  /** "coaptation_area", ...; null for other kinds */
  measure?: string | null;
  /** m */
  point?: ArrayLike<number>;
  /** F64 or F32, n x 3 */
  weights?: ArrayInput;
}

/** Options of mvs_sensitivity_run. */
export interface SensitivityOptions {
  /** MVS_SENSITIVITY_MOTION, ... */
  flags?: number;
  /**
   * m [1e-7]: a derivative is tested where it moves the fastest node by this much, and chordae this
   * near to their rest length, springs this near to the kink of their law and contact this near to
   * its begin or to another closest feature are about to switch; 1e-9 to 1e-3
   */
  slack?: number;
  /**
   * As in mvs_sim_desc; the force is that of the snapshot. Called after each parameter and each
   * quantity of each part of the work. Nullable.
   */
  progress?: ProgressCallback | null;
}

/** Summary of a result. */
export interface SensitivitySummary {
  quantities: number;
  parameters: number;
  /** 1: no NOTE_SWITCH, NOTE_CHORD, NOTE_CONTACT, NOTE_KINK, NOTE_SNAP */
  smooth: number;
  /** solutions with the transpose of K */
  adjoint_solves: number;
  /** solutions with K, those of tests included */
  direct_solves: number;
  /** chordae within `slack` of their rest length */
  weak_chords: number;
  /** switches of contact and kinks of laws within `slack` */
  weak_contacts: number;
  /** N, out-of-balance force of the snapshot */
  residual: number;
  /** largest |K y - b| / |b| of all solutions */
  linear_error: number;
  /**
   * N/m, smallest eigenvalue of the symmetric part of K over the leaflets, with branch points in
   * equilibrium: another number than that of mvs_stability, where branch points move by themselves
   */
  stiffness_margin: number;
}

/** How to read a file. */
export interface SurfaceFileOptions {
  /**
   * MVS_LENGTH_UNIT_* of the file [that which the file states: required unless it does, and if both
   * are there they have to be equal]
   */
  unit?: LengthUnit | number;
  /**
   * MVS_PATIENT_FRAME_* wanted [that of the file]. Points of a file without a stated frame are
   * never turned
   */
  frame?: PatientFrame | number;
}

/** The content of a file. Texts and views are valid until the file is released. */
export interface SurfaceFileInfo {
  /** MVS_PATIENT_FRAME_* of `points` */
  frame: PatientFrame;
  /** MVS_PATIENT_FRAME_* that the file states */
  file_frame: PatientFrame;
  /** MVS_LENGTH_UNIT_* of the file */
  unit: LengthUnit;
  /** "STL", "PLY", "OBJ", "OFF", "VTK", "VTP", "markups", "FCSV", "CSV" */
  format: string;
  /** F64, n x 3, m */
  points: ArrayView;
  /** U32, m x 3; of landmarks or a curve empty */
  triangles: ArrayView;
}

/**
 * A named array of a file: labels, radii, colours, normals. Its values are those of the file, of
 * any type there, neither scaled nor turned.
 */
export interface SurfaceArray {
  /** MVS_SURFACE_PLACE_* */
  place: SurfacePlace;
  name: string;
  /** F64, NaN where the file has no number */
  values: ArrayView;
}

/**
 * The open, unloaded leaflets of a mitral valve as a triangle surface of any orientation and
 * numbering, with the landmarks that are known. Lengths in m, all in one frame.
 */
export interface SurfaceDesc {
  /** MVS_SURFACE_KIND_* [skin if it is closed, else mid] */
  kind?: SurfaceKind | number;
  /** nullable ["valve"] */
  name?: string | null;
  /** F64 or F32, n x 3, required */
  points?: ArrayInput;
  /** U32, m x 3 [each three points in turn are a triangle] */
  triangles?: ArrayInput;
  /** U32, m: MVS_LEAFLET_LABEL_* [split between the commissures] */
  triangle_leaflet?: ArrayInput;
  /** F64, n, m: of the tissue, 1e-4 to 5e-3 [of a skin its own, else the option] */
  point_thickness?: ArrayInput;
  /**
   * k x 3, points along the annulus in any order; tissue beyond a curve through six or more of them
   * all around it is cut off as wall of the atrium [guessed: the boundary that is farther from the
   * papillary tips, or longer]
   */
  annulus?: ArrayInput;
  /** 2 x 3, near the surface [guessed from heights, annulus and tips] */
  commissures?: ArrayInput;
  /**
   * 1 x 3, a point near the anterior leaflet [guessed: the leaflet that is more like a normal
   * anterior one]
   */
  anterior?: ArrayInput;
  /** k x 3, k <= 64 [assumed: two, from normal anatomy] */
  papillary_tips?: ArrayInput;
  /**
   * F64 or F32: the same leaflets closed, in the same frame; chords get the lengths with which the
   * valve closes to it. Of closed bodies (both sides of the tissue, as segmentations are) the
   * middle is taken; other pieces count as mid-surface
   */
  closed_points?: ArrayInput;
  /** U32 [as triangles] */
  closed_triangles?: ArrayInput;
  /**
   * k x 3, k >= 6, points along the loaded annulus in any order [measured: an affine motion of the
   * annulus onto rims of the closed surface; without a closed surface, or if it has no rims near
   * the annulus, the annulus stays]
   */
  closed_annulus?: ArrayInput;
  /**
   * k x 3, each of papillary_tips in their order, under load [all follow the rigid part of the
   * annulus' motion]
   */
  closed_tips?: ArrayInput;
}

/** How to build. */
export interface BuildOptions {
  /**
   * MVS_LEAFLET_LAW_*, default constants [bilinear; if a closed surface is given, that of bilinear,
   * PROT and May-Newman and Yin with which a fitted valve closes nearest to it: finding "tissue",
   * whose value is the law]
   */
  leaflet_law?: LeafletLaw | number;
  /** m, length of the triangles' sides, 2e-4 to 5e-3 [as for 1,000 vertices] */
  edge?: number;
  /** m, where it is not known per point, 1e-4 to 5e-3 [0.8e-3] */
  thickness?: number;
  /** on all rest lengths, 0.5 to 2 [1] */
  chord_factor?: number;
  /**
   * m, overlap of both leaflets in the middle for which rest lengths are chosen if no closed
   * surface is given, 1e-3 to 20e-3 [8e-3]
   */
  coaptation_length?: number;
  /** about this number of chord segments, 20 to 400 [100] */
  chords?: number;
  /**
   * m, 1e-6 to 5e-3: how far the free edge may lie farther out or in than in the surface; widens
   * the interval of leaks [0]
   */
  edge_error?: number;
  /**
   * m, 1e-6 to 5e-3: of tissue that may be missing at the free edge; widens the interval of leaks;
   * 1e-6 adds nothing [half of the mean depth of the notches that were filled]
   */
  edge_lost?: number;
  /**
   * m, 1e-6 to 2e-3: by how much the leaflets may be thicker or thinner than the thickness says;
   * widens the interval of leaks [0]
   */
  thickness_error?: number;
  /**
   * 1: no closures and no findings on the leak, for a caller who replaces the chordae;
   * mvs_find_leak_interval gives them later [0]
   */
  without_leak?: number | boolean;
  reserved2?: number;
  /**
   * m, 1e-6 to 5e-3: standard deviation of places of the closed surface; gaps of it widen the
   * interval of leaks from 3.6 times as much of width on, of tissue thicker than twice as much, or
   * 1e-3, from as much more [0.5e-3, as of labels of segmentation networks]
   */
  closed_error?: number;
}

/** How far a valve may be from the one of its patient. */
export interface LeakErrors {
  /** 1e-3 to 0.5: share of the rest lengths, of all chordae and of a group together [0.1] */
  lengths?: number;
  /** 1e-3 to 0.5: share, of a chord beside its group [0.03] */
  single?: number;
  /** m, 1e-6 to 2e-3: of the leaflets, thicker or thinner [0] */
  thickness?: number;
}

/**
 * A finding: a value that a build found, guessed or assumed. Texts and values are valid while the
 * findings are held.
 */
export interface Finding {
  /** MVS_FINDING_SOURCE_* */
  source: FindingSource;
  /** "annulus", "commissures", "thickness" */
  name: string;
  /** the observation, and the input to give if it is wrong */
  sentence: string;
  /** of the values: "m", "m2", or "" */
  unit: string;
  /** 0 to 1 */
  confidence: number;
  /** F64, k x 1: points as x, y, z in turn */
  values: ArrayView;
  /**
   * 1: it contradicts the surface or normal anatomy so far that an input is probably wrong
   * (landmarks of another frame, swapped leaflets, atrial wall): show it to whoever builds
   */
  doubtful: number;
}

/** Fields of each operation, by its name, as check() and apply() take them: SI units; those left out take their defaults. */
export interface OperationValues {
  /** Sets the rest length of a chord; exactly one of length, factor and drag_to is given. */
  chord_length: {
    chord?: PartRef | null;
    /** m */
    length?: number | null;
    /** on its present rest length */
    factor?: number | null;
    /**
     * new position of the leaflet end: sets the length at which the chord reaches it under its
     * present tension
     */
    drag_to?: ArrayLike<number> | null;
  };
  /** Cuts a chord. Segments that lose their support are removed with it. */
  chord_remove: {
    chord?: PartRef | null;
  };
  /** Attaches a new chord from a papillary head to a leaflet; makes a chord. */
  chord_add: {
    head?: PartRef | null;
    site?: Place | null;
    /**
     * m [as taut as its neighbours: its distance in the rest shape times the median ratio of rest
     * length to distance of the five nearest chords of the head; its distance if the head has no
     * chords. Slack where these lie far from the site or on the other leaflet: give a length there]
     */
    length?: number | null;
    /** Pa [40e6] */
    young?: number | null;
    /** m2 [pi/4 * (1 mm)^2] */
    area?: number | null;
    /** MVS_CHORD_KIND_* except trunk and suture [other] */
    type?: ChordKind | number | null;
    /** nullable [made by the library, "P2/9"] */
    name?: string | null;
  };
  /**
   * Moves one end of a chord to another place of a leaflet, or to another papillary head. The
   * leaflet end keeps the length of the chord. At a head the chord is attached anew with the
   * default length of mvs_op_chord_add, at which the leaflet can close.
   */
  chord_transfer: {
    chord?: PartRef | null;
    /** MVS_CHORD_END_* [leaflet] */
    end?: ChordEnd | number | null;
    /** new place of the leaflet end */
    site?: Place | null;
    /** new head of the head end */
    head?: PartRef | null;
    /** m [leaflet end: unchanged; head end: that of mvs_op_chord_add] */
    length?: number | null;
  };
  /**
   * Scales the annulus about its centroid in its own frame, open and under load: to model
   * pathologies and to size rings. At least one of its fields is given. MVS_E_OP if a ring or band
   * holds the annulus, or if its perimeter under load would be below 25 % or above 300 % of that at
   * rest, the limits of a ring.
   */
  annulus_scale: {
    /** in every direction [1] */
    factor?: number | null;
    /** additional factor along the anteroposterior axis [1] */
    ap?: number | null;
    /** additional factor along the intercommissural axis [1] */
    cc?: number | null;
  };
  /**
   * Sews a rigid ring to the annulus: the annulus nodes move onto the curve at equal fractions of
   * the arc length, with and without load. Makes a ring, which replaces an existing ring or band.
   */
  ring: {
    /**
     * F64, k x 3, m, k >= 8: closed, in any frame, of any winding and start, its first point
     * repeated at its end or not; or left out with a size
     */
    curve?: ArrayInput | null;
    /**
     * m, intercommissural width of a parametric ring: 0.034 is labelled 34. Measured proportions of
     * the Physio II 34, not catalogue data
     */
    size?: number | null;
    /** AP over CC width [26.1 / 34.7] */
    ap_ratio?: number | null;
    /** m, height of the saddle [4.7 / 34.7 of the CC width] */
    saddle?: number | null;
    /** F64, k x 3, m, k >= 3: points of the ring in the frame of `curve` */
    landmarks?: ArrayInput | null;
    /** F64, k x 3, m: their positions in the valve [best rigid fit to the annulus under load] */
    landmarks_at?: ArrayInput | null;
    /** nullable ["ring"] */
    name?: string | null;
  };
  /**
   * Sews a flexible band along the posterior annulus from trigone to trigone: it shortens that part
   * of the annulus to its length, towards the line between the fixed trigones. Makes a ring.
   */
  band: {
    /** m; or give a factor */
    length?: number | null;
    /** on the present length of that part under load */
    factor?: number | null;
    /** nullable ["band"] */
    name?: string | null;
  };
  /** Attaches artificial chordae (ePTFE) to a leaflet; makes a chord. */
  neochord: {
    head?: PartRef | null;
    site?: Place | null;
    /** m [that of mvs_op_chord_add] */
    length?: number | null;
    /** parallel strands [2] */
    strands?: number | null;
    /** Pa [ePTFE, libmvs/surgery/README.md] */
    young?: number | null;
    /** m, of one strand [0.3e-3] */
    diameter?: number | null;
    /** nullable [made by the library] */
    name?: string | null;
  };
  /** Moves a papillary head, open and under load. */
  head_move: {
    head?: PartRef | null;
    /** m, along the axes of `frame` */
    by?: ArrayLike<number> | null;
    /** MVS_AXES_* [scene] */
    frame?: Axes | number | null;
  };
  /**
   * Joins two free edges (edge to edge: a clip or an Alfieri stitch) by sutures one contact
   * thickness long; makes a chord, the middle one, about which `angle` turns it in the plane of the
   * leaflets. It is placed on the open valve: positions return to the rest shape with zero
   * velocity.
   */
  clip: {
    /** scallop [A2] */
    anterior?: PartRef | null;
    /** scallop [P2] */
    posterior?: PartRef | null;
    /** along the scallops, -1 to 1 [0: the middle] */
    position?: number | null;
    /** m, of the free edge that is joined [5e-3] */
    width?: number | null;
    /** m, from the free edge into the leaflets [4e-3] */
    reach?: number | null;
    /** nullable ["clip"] */
    name?: string | null;
    /** rad, anticlockwise as seen from the atrium [0: across the free edge] */
    angle?: number | null;
  };
  /**
   * Resects a part of a scallop from its free edge and sews the sides of the gap together: a
   * triangle, a quadrangle, or a given outline. A quadrangle also shortens the annulus below by the
   * width of its base. It is made on the open valve: positions return to the rest shape with zero
   * velocity.
   */
  resect: {
    /** [P2] */
    scallop?: PartRef | null;
    /** of its centre along the scallop, -1 to 1 [0] */
    position?: number | null;
    /** m, at the free edge [8e-3] */
    width?: number | null;
    /** m, towards the annulus; 0: a triangle */
    base_width?: number | null;
    /** m, from the free edge [0.8 of the scallop's height there] */
    depth?: number | null;
    /**
     * F64, k x 3, m, k >= 3: points on the present leaflet, in order, the first and the last on or
     * beyond the free edge; replaces all fields above
     */
    outline?: ArrayInput | null;
  };
  /**
   * Enlarges a leaflet by a pericardial patch: replaces the tissue within an ellipse by a larger
   * piece, which bulges at rest.
   */
  patch: {
    /** the centre */
    site?: Place | null;
    /** m, circumferential [12e-3] */
    width?: number | null;
    /** m, radial [8e-3] */
    height?: number | null;
    /** area of the patch over that of the hole [1.3] */
    area_factor?: number | null;
    /** m [0.4e-3] */
    thickness?: number | null;
  };
}

export const layouts: Record<string, Layout> = {
  mvs_error: {
    size: 504,
    sized: false,
    fields: [
      { name: "code", kind: "i32", at: 0 },
      { name: "line", kind: "i32", at: 4 },
      { name: "part", kind: "chars", at: 8, length: 64 },
      { name: "message", kind: "chars", at: 72, length: 432 },
    ],
  },
  mvs_array: {
    size: 32,
    sized: false,
    fields: [
      { name: "data", kind: "address", at: 0 },
      { name: "count", kind: "u64", at: 8 },
      { name: "components", kind: "u32", at: 16 },
      { name: "type", kind: "enum", of: "mvs_type", at: 20 },
      { name: "stride", kind: "u64", at: 24 },
    ],
  },
  mvs_view: {
    size: 32,
    sized: false,
    fields: [
      { name: "data", kind: "address", at: 0 },
      { name: "count", kind: "u64", at: 8 },
      { name: "components", kind: "u32", at: 16 },
      { name: "type", kind: "enum", of: "mvs_type", at: 20 },
      { name: "stride", kind: "u64", at: 24 },
    ],
  },
  mvs_field_info: {
    size: 80,
    sized: true,
    fields: [
      { name: "type", kind: "enum", of: "mvs_field_type", at: 4 },
      { name: "offset", kind: "u32", at: 8 },
      { name: "required", kind: "u32", at: 12, flag: true },
      { name: "low", kind: "f64", at: 16 },
      { name: "high", kind: "f64", at: 24 },
      { name: "name", kind: "text", at: 32 },
      { name: "label", kind: "text", at: 36 },
      { name: "unit", kind: "text", at: 40 },
      { name: "help", kind: "text", at: 44 },
      { name: "choices", kind: "text", at: 48 },
      { name: "default_text", kind: "text", at: 52 },
      { name: "default_value", kind: "f64", at: 56 },
      { name: "group_name", kind: "text", at: 64 },
      { name: "group", kind: "u32", at: 68 },
    ],
  },
  mvs_law_constant: {
    size: 32,
    sized: false,
    fields: [
      { name: "key", kind: "text", at: 0 },
      { name: "unit", kind: "text", at: 4 },
      { name: "fallback", kind: "f64", at: 8 },
      { name: "low", kind: "f64", at: 16 },
      { name: "high", kind: "f64", at: 24 },
    ],
  },
  mvs_law: {
    size: 280,
    sized: true,
    fields: [
      { name: "number", kind: "u32", at: 4 },
      { name: "constant_count", kind: "u32", at: 8 },
      { name: "word", kind: "text", at: 16 },
      { name: "name", kind: "text", at: 20 },
      { name: "constants", kind: "struct", of: "mvs_law_constant", at: 24, length: 8 },
    ],
  },
  mvs_leaflet_desc: {
    size: 96,
    sized: false,
    fields: [
      { name: "name", kind: "text", at: 0 },
      { name: "id", kind: "u64", at: 8 },
      { name: "law", kind: "enum", of: "mvs_leaflet_law", at: 16 },
      { name: "thickness", kind: "f64", at: 24, zero: "default" },
      { name: "constants", kind: "f64", at: 32, length: 8 },
    ],
  },
  mvs_curve_desc: {
    size: 48,
    sized: false,
    fields: [
      { name: "name", kind: "text", at: 0 },
      { name: "id", kind: "u64", at: 8 },
      { name: "points", kind: "array", at: 16, components: 2, element: "F64" },
    ],
  },
  mvs_chord_desc: {
    size: 104,
    sized: false,
    fields: [
      { name: "node_a", kind: "u32", at: 0 },
      { name: "node_b", kind: "u32", at: 4 },
      { name: "kind", kind: "enum", of: "mvs_chord_kind", at: 8 },
      { name: "law", kind: "enum", of: "mvs_chord_law", at: 12 },
      { name: "rest_length", kind: "f64", at: 16, zero: "default" },
      { name: "young", kind: "f64", at: 24, zero: "default" },
      { name: "area", kind: "f64", at: 32, zero: "default" },
      { name: "constants", kind: "f64", at: 40, length: 6 },
      { name: "id", kind: "u64", at: 88 },
      { name: "name", kind: "text", at: 96 },
    ],
  },
  mvs_head_desc: {
    size: 24,
    sized: false,
    fields: [
      { name: "node", kind: "u32", at: 0 },
      { name: "id", kind: "u64", at: 8 },
      { name: "name", kind: "text", at: 16 },
    ],
  },
  mvs_ring_desc: {
    size: 56,
    sized: false,
    fields: [
      { name: "name", kind: "text", at: 0 },
      { name: "id", kind: "u64", at: 8 },
      { name: "kind", kind: "enum", of: "mvs_ring_kind", at: 16 },
      { name: "curve", kind: "array", at: 24, components: 3, element: "F64" },
    ],
  },
  mvs_valve_desc: {
    size: 480,
    sized: true,
    fields: [
      { name: "flags", kind: "u32", of: "mvs_valve_flags", at: 4 },
      { name: "name", kind: "text", at: 8 },
      { name: "nodes", kind: "array", at: 16, components: 3, element: "F64" },
      { name: "nodes_open", kind: "array", at: 48, components: 3, element: "F64" },
      { name: "nodes_loaded", kind: "array", at: 80, components: 3, element: "F64" },
      { name: "nodes_now", kind: "array", at: 112, components: 3, element: "F64" },
      { name: "node_origin", kind: "array", at: 144, components: 1, element: "U32" },
      { name: "triangles", kind: "array", at: 176, components: 3, element: "U32" },
      { name: "triangle_leaflet", kind: "array", at: 208, components: 1, element: "U32" },
      { name: "triangle_scallop", kind: "array", at: 240, components: 1, element: "U32" },
      { name: "triangle_thickness", kind: "array", at: 272, components: 1, element: "F64" },
      { name: "triangle_fibre", kind: "array", at: 304, components: 3, element: "F64" },
      { name: "annulus", kind: "array", at: 336, components: 1, element: "U32" },
      { name: "leaflets", kind: "structs", of: "mvs_leaflet_desc", at: 368, count: 388, stride: 392 },
      { name: "chords", kind: "structs", of: "mvs_chord_desc", at: 372, count: 396, stride: 400 },
      { name: "heads", kind: "structs", of: "mvs_head_desc", at: 376, count: 404, stride: 408 },
      { name: "rings", kind: "structs", of: "mvs_ring_desc", at: 380, count: 412, stride: 416 },
      { name: "curves", kind: "structs", of: "mvs_curve_desc", at: 384, count: 420, stride: 424 },
      { name: "scallops", kind: "texts", at: 428, count: 436 },
      { name: "scallop_ids", kind: "ids", at: 432 },
      { name: "density", kind: "f64", at: 448, zero: "default" },
      { name: "contact_thickness", kind: "f64", at: 456, zero: "default" },
      { name: "contact_stiffness", kind: "f64", at: 464, zero: "default" },
      { name: "bending_scale", kind: "f64", at: 472, zero: "default" },
    ],
  },
  mvs_parametric_desc: {
    size: 136,
    sized: true,
    fields: [
      { name: "vertices", kind: "u32", at: 4, zero: "default" },
      { name: "chords", kind: "u32", at: 8, zero: "default" },
      { name: "branching", kind: "enum", of: "mvs_branching", at: 12 },
      { name: "annulus_ap", kind: "f64", at: 16, zero: "default" },
      { name: "annulus_cc", kind: "f64", at: 24, zero: "default" },
      { name: "saddle_height", kind: "f64", at: 32, zero: "default" },
      { name: "anterior_height", kind: "f64", at: 40, zero: "default" },
      { name: "posterior_height", kind: "f64", at: 48, zero: "default" },
      { name: "commissure_height", kind: "f64", at: 56, zero: "default" },
      { name: "thickness", kind: "f64", at: 64, zero: "default" },
      { name: "papillary_depth", kind: "f64", at: 72, zero: "default" },
      { name: "papillary_separation", kind: "f64", at: 80, zero: "default" },
      { name: "annulus_contraction", kind: "f64", at: 88, zero: "default" },
      { name: "annulus_scale", kind: "f64", at: 96, zero: "default" },
      { name: "chord_slack", kind: "f64", at: 104, zero: "default" },
      { name: "indentation_depth", kind: "f64", at: 112, zero: "default" },
      { name: "coaptation_depth", kind: "f64", at: 120, zero: "default" },
      { name: "shape", kind: "enum", of: "mvs_shape", at: 128 },
      { name: "leaflet_law", kind: "enum", of: "mvs_leaflet_law", at: 132 },
    ],
  },
  mvs_sim_desc: {
    size: 36,
    sized: true,
    fields: [
      { name: "backend", kind: "enum", of: "mvs_backend", at: 4 },
      { name: "log", kind: "callback", of: "log", at: 8, user: 16 },
      { name: "progress", kind: "callback", of: "progress", at: 12, user: 16 },
    ],
  },
  mvs_load_case: {
    size: 24,
    sized: true,
    fields: [
      { name: "pressure", kind: "f64", at: 8 },
      { name: "boundary_fraction", kind: "f64", at: 16 },
    ],
  },
  mvs_settle_options: {
    size: 40,
    sized: true,
    fields: [
      { name: "solver", kind: "enum", of: "mvs_solver", at: 4 },
      { name: "max_iterations", kind: "u32", at: 8, zero: "default" },
      { name: "flags", kind: "u32", of: "mvs_settle_flags", at: 12 },
      { name: "residual", kind: "f64", at: 16, zero: "default" },
      { name: "dt", kind: "f64", at: 24, zero: "default" },
      { name: "damping", kind: "f64", at: 32, zero: "explicit" },
    ],
  },
  mvs_stats: {
    size: 72,
    sized: true,
    fields: [
      { name: "converged", kind: "u32", at: 4, flag: true },
      { name: "iterations", kind: "u32", at: 8 },
      { name: "contact_pairs", kind: "u32", at: 12 },
      { name: "lowered", kind: "u32", of: "mvs_lowered_flags", at: 16 },
      { name: "stable", kind: "u32", at: 20, flag: true },
      { name: "residual", kind: "f64", at: 24 },
      { name: "energy", kind: "f64", at: 32 },
      { name: "kinetic", kind: "f64", at: 40 },
      { name: "wall_s", kind: "f64", at: 48 },
      { name: "stiffness_margin", kind: "f64", at: 56 },
      { name: "growth_rate", kind: "f64", at: 64 },
    ],
  },
  mvs_step_options: {
    size: 32,
    sized: true,
    fields: [
      { name: "solver", kind: "enum", of: "mvs_solver", at: 4 },
      { name: "dt", kind: "f64", at: 8, zero: "default" },
      { name: "damping", kind: "f64", at: 16, zero: "explicit" },
      { name: "budget", kind: "u32", at: 24, zero: "default" },
    ],
  },
  mvs_part: {
    size: 80,
    sized: false,
    fields: [
      { name: "id", kind: "u64", at: 0 },
      { name: "kind", kind: "enum", of: "mvs_part_kind", at: 8 },
      { name: "index", kind: "u32", at: 12 },
      { name: "name", kind: "chars", at: 16, length: 64 },
    ],
  },
  mvs_chord_info: {
    size: 72,
    sized: true,
    fields: [
      { name: "kind", kind: "enum", of: "mvs_chord_kind", at: 4 },
      { name: "id", kind: "u64", at: 8 },
      { name: "name", kind: "text", at: 16 },
      { name: "heads", kind: "text", at: 20 },
      { name: "scallops", kind: "text", at: 24 },
      { name: "length", kind: "f64", at: 32 },
      { name: "rest_length", kind: "f64", at: 40 },
      { name: "strain", kind: "f64", at: 48 },
      { name: "tension", kind: "f64", at: 56 },
      { name: "flags", kind: "u32", of: "mvs_chord_flags", at: 64 },
    ],
  },
  mvs_rest: {
    size: 16,
    sized: true,
    fields: [
      { name: "at_rest", kind: "u32", at: 4, flag: true },
      { name: "tolerance", kind: "f64", at: 8 },
    ],
  },
  mvs_stability: {
    size: 24,
    sized: true,
    fields: [
      { name: "stable", kind: "u32", at: 4, flag: true },
      { name: "stiffness_margin", kind: "f64", at: 8 },
      { name: "growth_rate", kind: "f64", at: 16 },
    ],
  },
  mvs_measures: {
    size: 264,
    sized: true,
    fields: [
      { name: "intersections", kind: "u32", at: 4 },
      { name: "regurgitant_orifice_area", kind: "f64", at: 8 },
      { name: "coaptation_area", kind: "f64", at: 16 },
      { name: "coaptation_length_mean", kind: "f64", at: 24 },
      { name: "coaptation_length_min", kind: "f64", at: 32 },
      { name: "coaptation_length_max", kind: "f64", at: 40 },
      { name: "coaptation_height", kind: "f64", at: 48 },
      { name: "coaptation_depth", kind: "f64", at: 56 },
      { name: "tenting_height", kind: "f64", at: 64 },
      { name: "tenting_area", kind: "f64", at: 72 },
      { name: "tenting_volume", kind: "f64", at: 80 },
      { name: "billow_height", kind: "f64", at: 88 },
      { name: "billow_volume", kind: "f64", at: 96 },
      { name: "annulus_ap", kind: "f64", at: 104 },
      { name: "annulus_cc", kind: "f64", at: 112 },
      { name: "annulus_perimeter", kind: "f64", at: 120 },
      { name: "annulus_area_3d", kind: "f64", at: 128 },
      { name: "annulus_area", kind: "f64", at: 136 },
      { name: "annulus_saddle_height", kind: "f64", at: 144 },
      { name: "annulus_nonplanar_angle", kind: "f64", at: 152 },
      { name: "max_chord_strain", kind: "f64", at: 160 },
      { name: "max_chord_tension", kind: "f64", at: 168 },
      { name: "max_leaflet_strain", kind: "f64", at: 176 },
      { name: "max_leaflet_stress", kind: "f64", at: 184 },
      { name: "leaflet_area", kind: "f64", at: 192 },
      { name: "chords_over_strain", kind: "u32", at: 200 },
      { name: "chords_over_tension", kind: "u32", at: 204 },
      { name: "at_rest", kind: "u32", at: 208, flag: true },
      { name: "under_load", kind: "u32", at: 212, flag: true },
      { name: "leaflet_strain_p50", kind: "f64", at: 216 },
      { name: "leaflet_strain_p95", kind: "f64", at: 224 },
      { name: "leaflet_strain_p99", kind: "f64", at: 232 },
      { name: "leaflet_stress_p50", kind: "f64", at: 240 },
      { name: "leaflet_stress_p95", kind: "f64", at: 248 },
      { name: "leaflet_stress_p99", kind: "f64", at: 256 },
    ],
  },
  mvs_region_measures: {
    size: 88,
    sized: true,
    fields: [
      { name: "kind", kind: "enum", of: "mvs_region_kind", at: 4 },
      { name: "name", kind: "text", at: 8 },
      { name: "coaptation_area", kind: "f64", at: 16 },
      { name: "coaptation_length_mean", kind: "f64", at: 24 },
      { name: "coaptation_length_min", kind: "f64", at: 32 },
      { name: "orifice_area", kind: "f64", at: 40 },
      { name: "gap", kind: "f64", at: 48 },
      { name: "billow_height", kind: "f64", at: 56 },
      { name: "billow_volume", kind: "f64", at: 64 },
      { name: "tenting_height", kind: "f64", at: 72 },
      { name: "tenting_volume", kind: "f64", at: 80 },
    ],
  },
  mvs_orifice_part: {
    size: 88,
    sized: true,
    fields: [
      { name: "triangles", kind: "u32", at: 4 },
      { name: "area", kind: "f64", at: 8 },
      { name: "gap", kind: "f64", at: 16 },
      { name: "centroid", kind: "f64", at: 24, length: 3 },
      { name: "direction", kind: "f64", at: 48, length: 3 },
      { name: "anterior", kind: "text", at: 72 },
      { name: "posterior", kind: "text", at: 76 },
      { name: "commissures", kind: "text", at: 80 },
    ],
  },
  mvs_comparison: {
    size: 168,
    sized: true,
    fields: [
      { name: "same_mesh", kind: "u32", at: 4, flag: true },
      { name: "node_rms", kind: "f64", at: 8 },
      { name: "node_max", kind: "f64", at: 16 },
      { name: "surface_rms", kind: "f64", at: 24 },
      { name: "surface_max", kind: "f64", at: 32 },
      { name: "node_rms_registered", kind: "f64", at: 40 },
      { name: "node_max_registered", kind: "f64", at: 48 },
      { name: "surface_rms_registered", kind: "f64", at: 56 },
      { name: "surface_max_registered", kind: "f64", at: 64 },
      { name: "registration", kind: "f64", at: 72, length: 12 },
    ],
  },
  mvs_cost_options: {
    size: 88,
    sized: true,
    fields: [
      { name: "backend", kind: "enum", of: "mvs_backend", at: 4 },
      { name: "pressure", kind: "f64", at: 8, zero: "default" },
      { name: "residual", kind: "f64", at: 16, zero: "default" },
      { name: "flow", kind: "f64", at: 24, zero: "default" },
      { name: "density", kind: "f64", at: 32, zero: "default" },
      { name: "discharge", kind: "f64", at: 40, zero: "default" },
      { name: "septum", kind: "array", at: 48, components: 3, element: "F64" },
      { name: "progress", kind: "callback", of: "progress", at: 80, user: 84 },
    ],
  },
  mvs_cost: {
    size: 104,
    sized: true,
    fields: [
      { name: "opened", kind: "u32", at: 4, flag: true },
      { name: "open_area", kind: "f64", at: 8 },
      { name: "gradient", kind: "f64", at: 16 },
      { name: "anterior_height", kind: "f64", at: 24 },
      { name: "posterior_height", kind: "f64", at: 32 },
      { name: "anterior_length", kind: "f64", at: 40 },
      { name: "posterior_length", kind: "f64", at: 48 },
      { name: "length_ratio", kind: "f64", at: 56 },
      { name: "septal_distance", kind: "f64", at: 64 },
      { name: "annulus_force_max", kind: "f64", at: 72 },
      { name: "annulus_force_sum", kind: "f64", at: 80 },
      { name: "sam_risk", kind: "enum", of: "mvs_sam_risk", at: 88 },
      { name: "rings", kind: "u32", at: 92 },
      { name: "chords_over_strain", kind: "u32", at: 96 },
      { name: "chords_over_tension", kind: "u32", at: 100 },
    ],
  },
  mvs_op: {
    size: 8,
    sized: true,
    fields: [
      { name: "kind", kind: "enum", of: "mvs_op_kind", at: 4 },
    ],
  },
  mvs_point: {
    size: 32,
    sized: false,
    fields: [
      { name: "at", kind: "f64", at: 0, length: 3 },
      { name: "given", kind: "u32", at: 24, flag: true },
    ],
  },
  mvs_site: {
    size: 40,
    sized: false,
    fields: [
      { name: "how", kind: "enum", of: "mvs_site_kind", at: 0 },
      { name: "index", kind: "u32", at: 4 },
      { name: "scallop", kind: "u64", at: 8 },
      { name: "u", kind: "f64", at: 16, length: 3 },
    ],
  },
  mvs_op_chord_length: {
    size: 64,
    sized: false,
    fields: [
      { name: "op", kind: "struct", of: "mvs_op", at: 0 },
      { name: "chord", kind: "u64", at: 8 },
      { name: "length", kind: "f64", at: 16 },
      { name: "factor", kind: "f64", at: 24 },
      { name: "drag_to", kind: "struct", of: "mvs_point", at: 32 },
    ],
  },
  mvs_op_chord_remove: {
    size: 16,
    sized: false,
    fields: [
      { name: "op", kind: "struct", of: "mvs_op", at: 0 },
      { name: "chord", kind: "u64", at: 8 },
    ],
  },
  mvs_op_chord_add: {
    size: 96,
    sized: false,
    fields: [
      { name: "op", kind: "struct", of: "mvs_op", at: 0 },
      { name: "head", kind: "u64", at: 8 },
      { name: "site", kind: "struct", of: "mvs_site", at: 16 },
      { name: "length", kind: "f64", at: 56, zero: "default" },
      { name: "young", kind: "f64", at: 64, zero: "default" },
      { name: "area", kind: "f64", at: 72, zero: "default" },
      { name: "type", kind: "enum", of: "mvs_chord_kind", at: 80 },
      { name: "name", kind: "text", at: 88 },
    ],
  },
  mvs_op_chord_transfer: {
    size: 80,
    sized: false,
    fields: [
      { name: "op", kind: "struct", of: "mvs_op", at: 0 },
      { name: "chord", kind: "u64", at: 8 },
      { name: "end", kind: "enum", of: "mvs_chord_end", at: 16 },
      { name: "site", kind: "struct", of: "mvs_site", at: 24 },
      { name: "head", kind: "u64", at: 64 },
      { name: "length", kind: "f64", at: 72, zero: "default" },
    ],
  },
  mvs_op_annulus_scale: {
    size: 32,
    sized: false,
    fields: [
      { name: "op", kind: "struct", of: "mvs_op", at: 0 },
      { name: "factor", kind: "f64", at: 8, zero: "default" },
      { name: "ap", kind: "f64", at: 16, zero: "default" },
      { name: "cc", kind: "f64", at: 24, zero: "default" },
    ],
  },
  mvs_op_ring: {
    size: 136,
    sized: false,
    fields: [
      { name: "op", kind: "struct", of: "mvs_op", at: 0 },
      { name: "curve", kind: "array", at: 8, components: 3, element: "F64" },
      { name: "size", kind: "f64", at: 40 },
      { name: "ap_ratio", kind: "f64", at: 48, zero: "default" },
      { name: "saddle", kind: "f64", at: 56, zero: "default" },
      { name: "landmarks", kind: "array", at: 64, components: 3, element: "F64" },
      { name: "landmarks_at", kind: "array", at: 96, components: 3, element: "F64" },
      { name: "name", kind: "text", at: 128 },
    ],
  },
  mvs_op_band: {
    size: 32,
    sized: false,
    fields: [
      { name: "op", kind: "struct", of: "mvs_op", at: 0 },
      { name: "length", kind: "f64", at: 8 },
      { name: "factor", kind: "f64", at: 16 },
      { name: "name", kind: "text", at: 24 },
    ],
  },
  mvs_op_neochord: {
    size: 96,
    sized: false,
    fields: [
      { name: "op", kind: "struct", of: "mvs_op", at: 0 },
      { name: "head", kind: "u64", at: 8 },
      { name: "site", kind: "struct", of: "mvs_site", at: 16 },
      { name: "length", kind: "f64", at: 56, zero: "default" },
      { name: "strands", kind: "u32", at: 64, zero: "default" },
      { name: "young", kind: "f64", at: 72, zero: "default" },
      { name: "diameter", kind: "f64", at: 80, zero: "default" },
      { name: "name", kind: "text", at: 88 },
    ],
  },
  mvs_op_head_move: {
    size: 48,
    sized: false,
    fields: [
      { name: "op", kind: "struct", of: "mvs_op", at: 0 },
      { name: "head", kind: "u64", at: 8 },
      { name: "by", kind: "f64", at: 16, length: 3 },
      { name: "frame", kind: "enum", of: "mvs_axes", at: 40 },
    ],
  },
  mvs_op_clip: {
    size: 64,
    sized: false,
    fields: [
      { name: "op", kind: "struct", of: "mvs_op", at: 0 },
      { name: "anterior", kind: "u64", at: 8 },
      { name: "posterior", kind: "u64", at: 16 },
      { name: "position", kind: "f64", at: 24 },
      { name: "width", kind: "f64", at: 32, zero: "default" },
      { name: "reach", kind: "f64", at: 40, zero: "default" },
      { name: "name", kind: "text", at: 48 },
      { name: "angle", kind: "f64", at: 56 },
    ],
  },
  mvs_op_resect: {
    size: 80,
    sized: false,
    fields: [
      { name: "op", kind: "struct", of: "mvs_op", at: 0 },
      { name: "scallop", kind: "u64", at: 8 },
      { name: "position", kind: "f64", at: 16 },
      { name: "width", kind: "f64", at: 24, zero: "default" },
      { name: "base_width", kind: "f64", at: 32 },
      { name: "depth", kind: "f64", at: 40, zero: "default" },
      { name: "outline", kind: "array", at: 48, components: 3, element: "F64" },
    ],
  },
  mvs_op_patch: {
    size: 80,
    sized: false,
    fields: [
      { name: "op", kind: "struct", of: "mvs_op", at: 0 },
      { name: "site", kind: "struct", of: "mvs_site", at: 8 },
      { name: "width", kind: "f64", at: 48, zero: "default" },
      { name: "height", kind: "f64", at: 56, zero: "default" },
      { name: "area_factor", kind: "f64", at: 64, zero: "default" },
      { name: "thickness", kind: "f64", at: 72, zero: "default" },
    ],
  },
  mvs_history: {
    size: 16,
    sized: true,
    fields: [
      { name: "done", kind: "u32", at: 4 },
      { name: "undone", kind: "u32", at: 8 },
      { name: "checkpoints", kind: "u32", at: 12 },
    ],
  },
  mvs_history_entry: {
    size: 216,
    sized: true,
    fields: [
      { name: "kind", kind: "enum", of: "mvs_op_kind", at: 4 },
      { name: "group", kind: "u64", at: 8 },
      { name: "made", kind: "u64", at: 16 },
      { name: "title", kind: "chars", at: 24, length: 128 },
      { name: "in_group", kind: "chars", at: 152, length: 64 },
    ],
  },
  mvs_op_info: {
    size: 24,
    sized: true,
    fields: [
      { name: "kind", kind: "enum", of: "mvs_op_kind", at: 4 },
      { name: "size", kind: "u32", at: 8 },
      { name: "fields", kind: "u32", at: 12 },
      { name: "name", kind: "text", at: 16 },
      { name: "help", kind: "text", at: 20 },
    ],
  },
  mvs_plan_options: {
    size: 16,
    sized: true,
    fields: [
      { name: "measures", kind: "u32", at: 4, flag: true },
      { name: "author", kind: "text", at: 8 },
      { name: "notes", kind: "text", at: 12 },
    ],
  },
  mvs_replay: {
    size: 16,
    sized: true,
    fields: [
      { name: "operations", kind: "u32", at: 4 },
      { name: "same_valve", kind: "u32", at: 8, flag: true },
      { name: "same_result", kind: "u32", at: 12, flag: true },
    ],
  },
  mvs_body_desc: {
    size: 152,
    sized: false,
    fields: [
      { name: "kind", kind: "enum", of: "mvs_body_kind", at: 0 },
      { name: "vertices", kind: "array", at: 8, components: 3, element: "F64" },
      { name: "position", kind: "f64", at: 40, length: 3 },
      { name: "end", kind: "f64", at: 64, length: 3 },
      { name: "size", kind: "f64", at: 88, length: 3 },
      { name: "orientation", kind: "f64", at: 112, length: 4 },
      { name: "radius", kind: "f64", at: 144 },
    ],
  },
  mvs_tool_desc: {
    size: 160,
    sized: true,
    fields: [
      { name: "kind", kind: "enum", of: "mvs_tool_kind", at: 4 },
      { name: "position", kind: "f64", at: 8, length: 3 },
      { name: "axis", kind: "f64", at: 32, length: 3 },
      { name: "radius", kind: "f64", at: 56, zero: "default" },
      { name: "length", kind: "f64", at: 64, zero: "default" },
      { name: "stiffness", kind: "f64", at: 72, zero: "default" },
      { name: "max_force", kind: "f64", at: 80, zero: "default" },
      { name: "reach", kind: "f64", at: 88, zero: "default" },
      { name: "by_node", kind: "u32", at: 96, flag: true },
      { name: "node", kind: "u32", at: 100 },
      { name: "bodies", kind: "structs", of: "mvs_body_desc", at: 104, count: 108, stride: 112 },
      { name: "orientation", kind: "f64", at: 120, length: 4 },
      { name: "strict_hulls", kind: "u32", at: 152, flag: true },
    ],
  },
  mvs_tool_state: {
    size: 280,
    sized: true,
    fields: [
      { name: "kind", kind: "enum", of: "mvs_tool_kind", at: 4 },
      { name: "id", kind: "u64", at: 8 },
      { name: "position", kind: "f64", at: 16, length: 3 },
      { name: "axis", kind: "f64", at: 40, length: 3 },
      { name: "proxy", kind: "f64", at: 64, length: 3 },
      { name: "proxy_axis", kind: "f64", at: 88, length: 3 },
      { name: "force", kind: "f64", at: 112, length: 3 },
      { name: "torque", kind: "f64", at: 136, length: 3 },
      { name: "distance", kind: "f64", at: 160 },
      { name: "radius", kind: "f64", at: 168 },
      { name: "length", kind: "f64", at: 176 },
      { name: "stiffness", kind: "f64", at: 184 },
      { name: "max_force", kind: "f64", at: 192 },
      { name: "node", kind: "u32", at: 200 },
      { name: "touching", kind: "u32", at: 204, flag: true },
      { name: "orientation", kind: "f64", at: 208, length: 4 },
      { name: "proxy_orientation", kind: "f64", at: 240, length: 4 },
      { name: "body_count", kind: "u32", at: 272 },
      { name: "vertex_count", kind: "u32", at: 276 },
    ],
  },
  mvs_tool_body: {
    size: 80,
    sized: true,
    fields: [
      { name: "kind", kind: "enum", of: "mvs_body_kind", at: 4 },
      { name: "radius", kind: "f64", at: 8 },
      { name: "vertices", kind: "view", at: 16 },
      { name: "triangles", kind: "view", at: 48 },
    ],
  },
  mvs_profile: {
    size: 104,
    sized: true,
    fields: [
      { name: "skipped", kind: "u32", of: "mvs_skipped_flags", at: 4 },
      { name: "factorisations", kind: "u32", at: 8 },
      { name: "shifted", kind: "u32", at: 12 },
      { name: "broad_phases", kind: "u32", at: 16 },
      { name: "orderings", kind: "u32", at: 20 },
      { name: "linear_iterations", kind: "u32", at: 24 },
      { name: "passes", kind: "u32", at: 28 },
      { name: "untangled", kind: "u32", at: 32 },
      { name: "discarded_levels", kind: "u32", at: 36 },
      { name: "phase_s", kind: "f64", at: 40, length: 8 },
    ],
  },
  mvs_coarsen_options: {
    size: 16,
    sized: true,
    fields: [
      { name: "vertices", kind: "u32", at: 4 },
      { name: "edge", kind: "f64", at: 8 },
    ],
  },
  mvs_coarsening: {
    size: 56,
    sized: true,
    fields: [
      { name: "vertices_before", kind: "u32", at: 4 },
      { name: "vertices", kind: "u32", at: 8 },
      { name: "chords_moved", kind: "u32", at: 12 },
      { name: "chords_merged", kind: "u32", at: 16 },
      { name: "chord_move", kind: "f64", at: 24 },
      { name: "surface_max", kind: "f64", at: 32 },
      { name: "surface_rms", kind: "f64", at: 40 },
      { name: "worst_quality", kind: "f64", at: 48 },
    ],
  },
  mvs_ensemble_options: {
    size: 64,
    sized: true,
    fields: [
      { name: "members", kind: "u32", at: 4, zero: "default" },
      { name: "start", kind: "enum", of: "mvs_ensemble_start", at: 8 },
      { name: "backend", kind: "enum", of: "mvs_backend", at: 12 },
      { name: "flags", kind: "u32", of: "mvs_ensemble_flags", at: 16 },
      { name: "seed", kind: "u64", at: 24 },
      { name: "perturbation", kind: "f64", at: 32, zero: "default" },
      { name: "wavelength", kind: "f64", at: 40, zero: "default" },
      { name: "tolerance", kind: "f64", at: 48, zero: "default" },
      { name: "progress", kind: "callback", of: "progress", at: 56, user: 60 },
    ],
  },
  mvs_ensemble_summary: {
    size: 56,
    sized: true,
    fields: [
      { name: "members", kind: "u32", at: 4 },
      { name: "converged", kind: "u32", at: 8 },
      { name: "equilibria", kind: "u32", at: 12 },
      { name: "lowest", kind: "u32", at: 16 },
      { name: "node_rms", kind: "f64", at: 24 },
      { name: "node_max", kind: "f64", at: 32 },
      { name: "surface_rms", kind: "f64", at: 40 },
      { name: "surface_max", kind: "f64", at: 48 },
    ],
  },
  mvs_ensemble_member: {
    size: 72,
    sized: true,
    fields: [
      { name: "converged", kind: "u32", at: 4, flag: true },
      { name: "increments", kind: "u32", at: 8 },
      { name: "order", kind: "enum", of: "mvs_ensemble_order", at: 12 },
      { name: "equilibrium", kind: "u32", at: 16 },
      { name: "diverged", kind: "u32", at: 20, flag: true },
      { name: "perturbation", kind: "f64", at: 24 },
      { name: "node_rms", kind: "f64", at: 32 },
      { name: "node_max", kind: "f64", at: 40 },
      { name: "surface_rms", kind: "f64", at: 48 },
      { name: "surface_max", kind: "f64", at: 56 },
      { name: "ramp", kind: "f64", at: 64 },
    ],
  },
  mvs_parameter: {
    size: 48,
    sized: false,
    fields: [
      { name: "kind", kind: "enum", of: "mvs_parameter_kind", at: 0 },
      { name: "index", kind: "u32", at: 4 },
      { name: "component", kind: "u32", at: 8 },
      { name: "mode", kind: "array", at: 16, components: 3, element: "F64" },
    ],
  },
  mvs_quantity: {
    size: 80,
    sized: false,
    fields: [
      { name: "kind", kind: "enum", of: "mvs_quantity_kind", at: 0 },
      { name: "index", kind: "u32", at: 4 },
      { name: "component", kind: "u32", at: 8 },
      { name: "measure", kind: "text", at: 16 },
      { name: "point", kind: "f64", at: 24, length: 3 },
      { name: "weights", kind: "array", at: 48, components: 3, element: "F64" },
    ],
  },
  mvs_sensitivity_options: {
    size: 24,
    sized: true,
    fields: [
      { name: "flags", kind: "u32", of: "mvs_sensitivity_flags", at: 4 },
      { name: "slack", kind: "f64", at: 8, zero: "default" },
      { name: "progress", kind: "callback", of: "progress", at: 16, user: 20 },
    ],
  },
  mvs_sensitivity_summary: {
    size: 56,
    sized: true,
    fields: [
      { name: "quantities", kind: "u32", at: 4 },
      { name: "parameters", kind: "u32", at: 8 },
      { name: "smooth", kind: "u32", at: 12, flag: true },
      { name: "adjoint_solves", kind: "u32", at: 16 },
      { name: "direct_solves", kind: "u32", at: 20 },
      { name: "weak_chords", kind: "u32", at: 24 },
      { name: "weak_contacts", kind: "u32", at: 28 },
      { name: "residual", kind: "f64", at: 32 },
      { name: "linear_error", kind: "f64", at: 40 },
      { name: "stiffness_margin", kind: "f64", at: 48 },
    ],
  },
  mvs_surface_file_options: {
    size: 16,
    sized: true,
    fields: [
      { name: "unit", kind: "enum", of: "mvs_length_unit", at: 4 },
      { name: "frame", kind: "enum", of: "mvs_patient_frame", at: 8 },
    ],
  },
  mvs_surface_file_info: {
    size: 88,
    sized: true,
    fields: [
      { name: "frame", kind: "enum", of: "mvs_patient_frame", at: 4 },
      { name: "file_frame", kind: "enum", of: "mvs_patient_frame", at: 8 },
      { name: "unit", kind: "enum", of: "mvs_length_unit", at: 12 },
      { name: "format", kind: "text", at: 16 },
      { name: "points", kind: "view", at: 24 },
      { name: "triangles", kind: "view", at: 56 },
    ],
  },
  mvs_surface_array: {
    size: 48,
    sized: true,
    fields: [
      { name: "place", kind: "enum", of: "mvs_surface_place", at: 4 },
      { name: "name", kind: "text", at: 8 },
      { name: "values", kind: "view", at: 16 },
    ],
  },
  mvs_surface_desc: {
    size: 400,
    sized: true,
    fields: [
      { name: "kind", kind: "enum", of: "mvs_surface_kind", at: 4 },
      { name: "name", kind: "text", at: 8 },
      { name: "points", kind: "array", at: 16, components: 3, element: "F64" },
      { name: "triangles", kind: "array", at: 48, components: 3, element: "U32" },
      { name: "triangle_leaflet", kind: "array", at: 80, components: 1, element: "U32" },
      { name: "point_thickness", kind: "array", at: 112, components: 1, element: "F64" },
      { name: "annulus", kind: "array", at: 144, components: 3, element: "F64" },
      { name: "commissures", kind: "array", at: 176, components: 3, element: "F64" },
      { name: "anterior", kind: "array", at: 208, components: 3, element: "F64" },
      { name: "papillary_tips", kind: "array", at: 240, components: 3, element: "F64" },
      { name: "closed_points", kind: "array", at: 272, components: 3, element: "F64" },
      { name: "closed_triangles", kind: "array", at: 304, components: 3, element: "U32" },
      { name: "closed_annulus", kind: "array", at: 336, components: 3, element: "F64" },
      { name: "closed_tips", kind: "array", at: 368, components: 3, element: "F64" },
    ],
  },
  mvs_build_options: {
    size: 88,
    sized: true,
    fields: [
      { name: "leaflet_law", kind: "enum", of: "mvs_leaflet_law", at: 4 },
      { name: "edge", kind: "f64", at: 8, zero: "default" },
      { name: "thickness", kind: "f64", at: 16, zero: "default" },
      { name: "chord_factor", kind: "f64", at: 24, zero: "default" },
      { name: "coaptation_length", kind: "f64", at: 32, zero: "default" },
      { name: "chords", kind: "u32", at: 40, zero: "default" },
      { name: "edge_error", kind: "f64", at: 48 },
      { name: "edge_lost", kind: "f64", at: 56, zero: "default" },
      { name: "thickness_error", kind: "f64", at: 64 },
      { name: "without_leak", kind: "u32", at: 72, flag: true },
      { name: "reserved2", kind: "u32", at: 76 },
      { name: "closed_error", kind: "f64", at: 80, zero: "default" },
    ],
  },
  mvs_leak_errors: {
    size: 32,
    sized: true,
    fields: [
      { name: "lengths", kind: "f64", at: 8, zero: "default" },
      { name: "single", kind: "f64", at: 16, zero: "default" },
      { name: "thickness", kind: "f64", at: 24 },
    ],
  },
  mvs_finding: {
    size: 72,
    sized: true,
    fields: [
      { name: "source", kind: "enum", of: "mvs_finding_source", at: 4 },
      { name: "name", kind: "text", at: 8 },
      { name: "sentence", kind: "text", at: 12 },
      { name: "unit", kind: "text", at: 16 },
      { name: "confidence", kind: "f64", at: 24 },
      { name: "values", kind: "view", at: 32 },
      { name: "doubtful", kind: "u32", at: 64, flag: true },
    ],
  },
};
