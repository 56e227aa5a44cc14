// Generated from include/mvs-api.json by tools/generate.mjs. Do not edit.
// Enumerations: the number of each word, and the words as a type.

/**
 * The result of a function that can fail: MVS_OK or a negative code; mvs_last_error() returns the
 * sentence. After a failure the simulator is bit for bit as before the call and outputs are
 * unchanged.
 */
export const Result = {
  ok: 0,
  /** a null pointer, or a value out of its range */
  e_argument: -1,
  /** the valve has no part of this kind with this id */
  e_id: -2,
  /** the simulator's state forbids the call, e.g. no valve is set */
  e_state: -3,
  /** an impossible surgical operation, or an invalid valve or tissue */
  e_op: -4,
  /** the solution diverged: numbers left their valid range */
  e_diverged: -5,
  /** a malformed file; mvs_error.line is the line */
  e_format: -6,
  /** a file, struct or driver of a version this library does not know */
  e_version: -7,
  /** the operating system refused to read or write */
  e_io: -8,
  /** a haptic device or its driver failed */
  e_device: -9,
  /** out of memory, or above a stated limit */
  e_memory: -10,
  /** this build, solver or file format lacks the requested part */
  e_unsupported: -11,
  /** a defect of the library: please report it */
  e_internal: -12,
  /** the progress callback cancelled the call */
  e_cancelled: -13,
} as const;
export type Result = keyof typeof Result;

/** Element types of arrays. */
export const Type = {
  f64: 1,
  f32: 2,
  u32: 3,
  u64: 4,
  u8: 5,
} as const;
export type Type = keyof typeof Type;

/** Types of described fields; those from CHORD on belong to operations (op.h). */
export const FieldType = {
  /** double */
  number: 1,
  /** uint32_t */
  count: 2,
  /** uint32_t, one of `choices` */
  choice: 3,
  /** mvs_id */
  chord: 4,
  /** mvs_id */
  head: 5,
  /** mvs_id */
  scallop: 6,
  /** mvs_site */
  site: 7,
  /** mvs_point */
  point: 8,
  /** double[3] */
  vector: 9,
  /** mvs_array, F64, k x 3 */
  points: 10,
  /** const char * */
  text: 11,
} as const;
export type FieldType = keyof typeof FieldType;

/** Structs of results whose fields the library describes. */
export const Struct = {
  /** mvs_measures */
  measures: 1,
  /** mvs_stats */
  stats: 2,
  /** mvs_profile; fields of its array phase_s are listed one by one */
  profile: 3,
  /** mvs_cost */
  cost: 4,
} as const;
export type Struct = keyof typeof Struct;

/** Kinds of chordae. */
export const ChordKind = {
  other: 0,
  /** to the free edge */
  marginal: 1,
  /** to the coapting zone behind the free edge */
  rough_zone: 2,
  /** the two thick ones of the anterior leaflet */
  strut: 3,
  /** to the base of the posterior leaflet */
  basal: 4,
  /** to a commissure */
  commissural: 5,
  /** between papillary head and branch point */
  trunk: 6,
  /** a surgical suture that joins two places of the leaflets */
  suture: 7,
} as const;
export type ChordKind = keyof typeof ChordKind;

/**
 * Constitutive laws of a leaflet sheet, and the meaning of `constants` for each. A constant of 0
 * takes the default; give -0.0 for a constant that is zero.
 */
export const LeafletLaw = {
  /**
   * Mass-spring sheet, bilinear law, Van Gelder stiffness (Tenenholtz et al. 2011): constants are
   * Young's modulus below the kink, Pa [100e3]; above it, Pa [6e6]; strain at the kink [0.25].
   */
  spring: 1,
  /**
   * The other laws are membranes: constant-strain triangles, plane stress, incompressible, energy
   * density W(I1, I4) in J/m3 with I1 = tr C and I4 = f . C f along the triangle's fibre f. Above
   * 100 kPa, where stresses are 5 to 11 MPa (more than leaflets bear), c exp(q) continues as a
   * parabola in sqrt(q) of the same slope, so that tissue which an operation tears or crushes still
   * comes to rest. Bilinear: the curve of the springs as an isotropic tissue, dW/dI1 = c + a (x +
   * sqrt(x^2 + s^2)) / 2, x = I1 - Ic: c, Pa [18.49e3]; a, Pa [3146e3]; Ic [3.1611]; s [0.006].
   */
  bilinear: 2,
  /**
   * Fung-type isotropic, W = c0 / 2 (I1 - 3) + c1 / 2 (exp(c2 (I1 - 3)^2) - 1) (Texas TriValve 1.1,
   * Mathur et al. 2022): c0, Pa [1e3]; c1, Pa [124]; c2 [4.568202], its anterior leaflet.
   */
  fung: 3,
  /**
   * W = c0 (exp(c1 (I1 - 3)^2 + c2 (sqrt(I4) - 1)^4) - 1) (May-Newman and Yin 1998): c0, Pa [399];
   * c1 [4.325]; c2 [1446.5], the anterior leaflet; posterior 414, 4.848, 305.4.
   */
  may_newman_yin: 4,
  /**
   * W = c0 (exp(c1 (I1 - 3)^2 + c2 (I4 - 1)^2) - 1) (Prot et al. 2009): c0, Pa [52]; c1 [4.63]; c2
   * [22.6], the anterior leaflet; posterior 171, 5.28, 6.46.
   */
  prot: 5,
  /**
   * W = mu / 2 (I1 - 3): mu, Pa [200e3]; bending, Pa [112e3]. Young's modulus of the plane sheet is
   * 3 mu, that of the bending stiffness the lesser of 3 mu and `bending`: mu is a modulus of tissue
   * under load, which bends as softly as tissue at rest (the default of the bilinear membrane).
   * Give 1e12, or -0.0 (no limit), for a plate of 3 mu, and bending_scale or
   * MVS_VALVE_FLAG_NO_BENDING for a sheet without bending stiffness.
   */
  neo_hookean: 6,
} as const;
export type LeafletLaw = keyof typeof LeafletLaw;

/**
 * Constitutive laws of a chord: tension = area x nominal stress P at the strain e = (L - L0) / L0
 * where L > L0, else 0. A constant of 0 takes the default; give -0.0 for one that is zero.
 */
export const ChordLaw = {
  /** P = young e */
  linear: 1,
  /** P = young e below the kink, then slope high: constants are kink [0.05]; high, Pa [100e6] */
  bilinear: 2,
  /**
   * Incompressible Ogden, W = sum of 2 mu_k / alpha_k^2 (l1^alpha_k + l2^alpha_k + l3^alpha_k - 3),
   * up to three terms: constants are mu_1, Pa; alpha_1; mu_2; alpha_2; mu_3; alpha_3. The first
   * term is required; the sum must stiffen the chord from zero strain. Above 100 MPa the curve
   * continues along its tangent. `young` is unused
   */
  ogden: 3,
  /**
   * Linear interpolation of a measured curve, beyond its end with the last slope: constants[0] is
   * its index in mvs_valve_desc.curves. `young` is unused
   */
  table: 4,
} as const;
export type ChordLaw = keyof typeof ChordLaw;

/** Kinds of rings. */
export const RingKind = {
  /** closed and rigid: holds the whole annulus */
  rigid: 1,
  /** posterior, from trigone to trigone, flexible */
  band: 2,
} as const;
export type RingKind = keyof typeof RingKind;

/** mvs_valve_desc.flags */
export const ValveFlags = {
  /** turn triangles so that their normals point into the atrium */
  flag_orient: 1,
  /** leaflets without bending stiffness; bending_scale is 0 */
  flag_no_bending: 2,
} as const;
export type ValveFlags = keyof typeof ValveFlags;

/**
 * Shape of a parametric valve. Both have the dimensions below; defaults that differ are given as
 * [healthy; founding].
 */
export const Shape = {
  /** Leaflets and chordae derived from one closed shape: seals with every tissue. The default. */
  healthy: 1,
  /** The shape of the founding model (Tenenholtz et al. 2011), made for its springs. */
  founding: 2,
} as const;
export type Shape = keyof typeof Shape;

/** mvs_parametric_desc.branching */
export const Branching = {
  /** up to three chordae share a trunk from the papillary head */
  trees: 1,
  /** each chord is one segment */
  straight: 2,
} as const;
export type Branching = keyof typeof Branching;

/** Logging levels. Failures are returned, not logged. */
export const LogLevel = {
  error: 1,
  warning: 2,
  info: 3,
  debug: 4,
} as const;
export type LogLevel = keyof typeof LogLevel;

/** Sparse factorisations. */
export const Backend = {
  /**
   * the fastest: block Cholesky in single precision as preconditioner of conjugate gradients in
   * double precision
   */
  default: 0,
  /** SuiteSparse CHOLMOD, simplicial LDL^T */
  cholmod: 1,
  /** Eigen SimplicialLDLT */
  eigen: 2,
  /** the library's own Cholesky on 3x3 blocks, in double precision */
  block: 3,
} as const;
export type Backend = keyof typeof Backend;

/** Solvers. */
export const Solver = {
  /** static equilibrium: Newton's method in a trust region (mvs_settle) */
  newton: 1,
  /** backward Euler, a bounded amount of work a step */
  implicit: 2,
  /** symplectic Euler with penalty contact: the founding paper's method */
  explicit: 3,
} as const;
export type Solver = keyof typeof Solver;

/** Parts of a settle that may be left out; the valve at its end has the same bits. */
export const SettleFlags = {
  /**
   * Leaves out the stability margins, which take a tenth of the time of a settle after an
   * operation. They are 0 in mvs_stats; mvs_snapshot_get_stability computes them.
   */
  no_margins: 1,
} as const;
export type SettleFlags = keyof typeof SettleFlags;

/**
 * Accuracy that a step gave up, in this order: bits of mvs_stats.lowered. The bounds against
 * crossing and the bound on energy always hold.
 */
export const LoweredFlags = {
  /** the linear system was solved less accurately, for the budget */
  linear: 1,
  /**
   * the nodes moved by a part of their step, or not at all: for the budget, or because contact held
   * some of them back
   */
  step: 2,
} as const;
export type LoweredFlags = keyof typeof LoweredFlags;

/**
 * Arrays of a snapshot: n nodes, m triangles, l leaflets, c chord segments, h heads, r rings, k
 * curves. Together with the parts they hold everything that mvs_set_valve takes.
 */
export const ArrayKind = {
  /** F64 n x 3, m */
  node_position: 1,
  /** F64 n x 3, m: the unloaded valve */
  node_rest: 2,
  /** F64 n x 3, m: targets of prescribed nodes under load */
  node_loaded: 3,
  /** F64 n x 3, m/s */
  node_velocity: 4,
  /** U8 n: MVS_NODE_KIND_* */
  node_kind: 5,
  /**
   * F64 n x 3, N: out-of-balance force; where prescribed the force of the valve on what holds it,
   * the negative of a reaction force of FEBio or Abaqus
   */
  node_force: 6,
  /** F64 n x 3, N */
  node_contact_force: 7,
  /** F64 n, m: distance to the facing leaflet, or infinity */
  node_coaptation: 8,
  /** F64 n x 3, m: unloaded targets of prescribed nodes */
  node_open: 9,
  /** U32 n: the node's index before operations, refinement and coarsening; UINT32_MAX for a new node */
  node_origin: 10,
  /** F64 n x 3: means of the triangles at a node by rest area */
  node_strain_fibre: 11,
  /** F64 n x 3, Pa: the same */
  node_stress_fibre: 12,
  /**
   * F64 n x 3: mode of mvs_stability, the real part of the eigenvector; the longest displacement is
   * 1
   */
  node_mode: 13,
  /** U32 m x 3 */
  triangle_nodes: 20,
  /** U32 m */
  triangle_leaflet: 21,
  /** U32 m */
  triangle_scallop: 22,
  /** F64 m, m */
  triangle_thickness: 23,
  /** F64 m x 3, unit */
  triangle_fibre: 24,
  /** F64 m x 2: principal stretches, larger first */
  triangle_stretch: 25,
  /** F64 m x 2, Pa: principal Cauchy stresses, larger first */
  triangle_stress: 26,
  /** F64 m: share of the triangle that faces another leaflet */
  triangle_coapted: 27,
  /**
   * F64 m x 3: Green-Lagrange strain along the fibre (circumferential), across it (radial), in
   * shear
   */
  triangle_strain_fibre: 28,
  /** F64 m x 3, Pa: Cauchy stress, turned back by the rotation of the triangle, in the same order */
  triangle_stress_fibre: 29,
  /** F64 m x 3: unit direction of the largest stretch */
  triangle_direction: 32,
  /** U32 l, a row a leaflet: MVS_LEAFLET_LAW_* */
  leaflet_law: 30,
  /** F64 l x 9: thickness in m, then the constants of the law */
  leaflet_constants: 31,
  /** U32 k, in order */
  annulus_nodes: 40,
  /** U32, in order */
  free_edge_nodes: 41,
  /** F64 k x 3, N: pull of tissue and pressure on each of them, which the sutures of a ring bear */
  annulus_force: 42,
  /** U32 c x 2 */
  chord_nodes: 50,
  /** F64 c, m */
  chord_rest_length: 51,
  /** U32 c: MVS_CHORD_KIND_* */
  chord_kind: 52,
  /** F64 c: (L - L0) / L0, negative when slack */
  chord_strain: 53,
  /** F64 c, N */
  chord_tension: 54,
  /** U64 c */
  chord_id: 55,
  /** F64 c, Pa */
  chord_young: 56,
  /** F64 c, m2 */
  chord_area: 57,
  /** U8 c: MVS_CHORD_FLAG_OVER_* */
  chord_flags: 58,
  /** U32 c: MVS_CHORD_LAW_* */
  chord_law: 59,
  /** U32 h */
  head_nodes: 60,
  /** F64 h x 3, N: pull of the chordae on each head */
  head_force: 61,
  /** F64 c x 6: of the law */
  chord_constants: 62,
  /** F64 x 3, m: the points of all rings, one after the other */
  ring_points: 65,
  /** U32 r + 1: first row of each ring's points, then their number */
  ring_start: 66,
  /** U32 r: MVS_RING_KIND_* */
  ring_kind: 67,
  /** U64 r */
  ring_id: 68,
  /** F64 x 2: strain, nominal stress in Pa; of all curves in turn */
  curve_points: 75,
  /** U32 k + 1: first row of each curve's points, then their number */
  curve_start: 76,
  /** F64 x 3, m: the smallest opening, as triangles */
  orifice_vertices: 70,
  /** U32 x 3 into MVS_ARRAY_ORIFICE_VERTICES */
  orifice_triangles: 71,
  /** U32 per triangle of the orifice: index of its part, see mvs_snapshot_get_orifice_part */
  orifice_part: 72,
  /**
   * F64 4: density, kg/m3; contact thickness, m; contact stiffness, Pa; bending scale, 0: no
   * bending
   */
  valve_constants: 80,
  /** F64 1, s: simulated time since the valve was set */
  state_time: 81,
} as const;
export type ArrayKind = keyof typeof ArrayKind;

/** Values of MVS_ARRAY_NODE_KIND. */
export const NodeKind = {
  /** free vertex of the sheet */
  leaflet: 0,
  /** vertex of the sheet, prescribed */
  annulus: 1,
  /** free branch point of chordae */
  branch: 2,
  /** papillary head, prescribed */
  head: 3,
} as const;
export type NodeKind = keyof typeof NodeKind;

/** Bits of MVS_ARRAY_CHORD_FLAGS. */
export const ChordFlags = {
  /** strained beyond the limit of its kind */
  flag_over_strain: 1,
  /** carries more than the limit of its kind */
  flag_over_tension: 2,
} as const;
export type ChordFlags = keyof typeof ChordFlags;

/** Kinds of named parts. */
export const PartKind = {
  leaflet: 1,
  scallop: 2,
  chord: 3,
  head: 4,
  ring: 5,
  curve: 6,
} as const;
export type PartKind = keyof typeof PartKind;

/**
 * Groups of measures. The figures of a group are computed together; mvs_field_info has the group of
 * each field of mvs_measures. at_rest and under_load are in no group: they are always set.
 */
export const MeasureGroupFlags = {
  /** intersections */
  crossings: 1,
  /** regurgitant_orifice_area: the longest */
  orifice: 2,
  /** coaptation_* */
  coaptation: 4,
  /** tenting_*, billow_* */
  tenting: 8,
  /** annulus_* */
  annulus: 16,
  /** max_chord_*, chords_over_* */
  chords: 32,
  /** max_leaflet_*, leaflet_*: strain, stress, area */
  leaflets: 64,
} as const;
export type MeasureGroupFlags = keyof typeof MeasureGroupFlags;

/** Kinds of regions. */
export const RegionKind = {
  /** each triangle belongs to one scallop */
  scallop: 1,
  /** the tissue of both leaflets near a commissure; overlaps scallops */
  commissure: 2,
} as const;
export type RegionKind = keyof typeof RegionKind;

/** Risk of systolic anterior motion (SAM) of the anterior leaflet into the outflow tract. */
export const SamRisk = {
  /** no septal points, or not closed at rest under load */
  not_determined: 0,
  /** neither of the two conditions below */
  low: 1,
  /** length_ratio at most 1.3, or septal_distance at most 25 mm */
  raised: 2,
} as const;
export type SamRisk = keyof typeof SamRisk;

/** Kinds of operations. Numbers are never reused. */
export const OpKind = {
  chord_length: 1,
  chord_remove: 2,
  chord_add: 3,
  chord_transfer: 4,
  annulus_scale: 5,
  ring: 6,
  band: 7,
  neochord: 8,
  head_move: 9,
  clip: 10,
  resect: 11,
  patch: 12,
} as const;
export type OpKind = keyof typeof OpKind;

/** Representations of a place on a leaflet. */
export const SiteKind = {
  none: 0,
  /** node `index` */
  node: 1,
  /** in triangle `index`, barycentric coordinates u, sum 1 */
  triangle: 2,
  /**
   * in a scallop: u[0] along it, 0 at its end towards the negative CC axis, 1 at the other end;
   * u[1] 0 at the annulus, 1 at the free edge
   */
  anatomical: 3,
} as const;
export type SiteKind = keyof typeof SiteKind;

/** Ends of a chord. */
export const ChordEnd = {
  leaflet: 1,
  head: 2,
} as const;
export type ChordEnd = keyof typeof ChordEnd;

/** Axes of a vector. */
export const Axes = {
  /** x, y, z of the coordinates */
  scene: 0,
  /** AP, CC and the axis into the atrium (mvs_snapshot_get_frame) */
  valve: 1,
} as const;
export type Axes = keyof typeof Axes;

/** Kinds of tools. */
export const ToolKind = {
  /** holds a node */
  grasp: 1,
  /** pushes with a ball */
  ball: 2,
  /** pushes with a rod with round ends, from its tip along its axis */
  rod: 3,
  /** pushes with rounded convex bodies */
  convex: 4,
} as const;
export type ToolKind = keyof typeof ToolKind;

/** Kinds of bodies of a convex tool. */
export const BodyKind = {
  /** the convex hull of vertices */
  hull: 1,
  /** around `position` */
  ball: 2,
  /** around the segment from `position` to `end` */
  capsule: 3,
  /** around `position`, turned by `orientation` */
  box: 4,
  /** from `position` to `end` */
  cylinder: 5,
  /** with its base around `position` and its apex at `end` */
  cone: 6,
} as const;
export type BodyKind = keyof typeof BodyKind;

/** File formats. */
export const Format = {
  auto: 0,
  /**
   * extended OBJ (formats/FORMAT.md), read and write, exact round trip of valve and state without
   * tools and history. A state that the file says is at rest, but whose largest out-of-balance
   * force is above twice its tolerance, is not at rest: MVS_LOG_WARNING
   */
  obj: 1,
  /** VTK XML PolyData, write only: for ParaView and Slicer */
  vtp: 2,
  /**
   * HDF5, read and write, with the history for undo and redo; ParaView and h5py can open it.
   * MVS_E_UNSUPPORTED in a build without HDF5
   */
  h5: 3,
  /**
   * Abaqus input, read only: shells, trusses, materials, prescribed nodes and pressure. Ignored
   * keywords and assumptions are logged, MVS_LOG_WARNING. The valve is at rest; its load is that of
   * the file
   */
  inp: 4,
  /**
   * FEBio 4.0 model, write only: the valve at rest with the load of the snapshot. MVS_E_UNSUPPORTED
   * where FEBio lacks the law
   */
  feb: 5,
  /**
   * VTK XML multiblock dataset, write only, to a path: an index and the files of its blocks in a
   * folder of the same name: valve, orifice if there is one, coaptation_line if leaflets touch
   */
  vtm: 6,
} as const;
export type Format = keyof typeof Format;

/** Phases of the work, as indices of mvs_profile.phase_s. */
export const Phase = {
  /** energy, gradient and Hessian blocks of the terms */
  terms: 0,
  /** broad phase and step limiter */
  broad: 1,
  /** narrow phase: distances */
  narrow: 2,
  /** blocks into the sparse matrix */
  assembly: 3,
  /** symbolic analysis */
  ordering: 4,
  /** numeric factorisation */
  factor: 5,
  /** solutions with the factor */
  solve: 6,
  /**
   * trial energies with their distances; those of an implicit step count as terms, because they
   * include forces
   */
  line_search: 7,
  count: 8,
} as const;
export type Phase = keyof typeof Phase;

/** Work that a settle or step did not need: bits of mvs_profile.skipped. No bit changes a result. */
export const SkippedFlags = {
  /** the first seven: the scene has no such term, or no load on it */
  springs: 1,
  membrane: 2,
  bending: 4,
  chordae: 8,
  pressure: 16,
  /** no pair came near enough for a distance computation */
  contact: 32,
  tools: 64,
  /** the previous candidate pairs were still valid */
  broad: 128,
  /** the sparsity pattern was known */
  ordering: 256,
  /** an earlier factorisation served as preconditioner */
  factor: 512,
  /** at rest without any change: only the time advanced */
  step: 1024,
} as const;
export type SkippedFlags = keyof typeof SkippedFlags;

/** Initial shape of members 1, 2, ... */
export const EnsembleStart = {
  /** the rest shape, unloaded, boundary open: a full closure */
  rest: 1,
  /** the shape of the snapshot: equilibria near it */
  snapshot: 2,
} as const;
export type EnsembleStart = keyof typeof EnsembleStart;

/** mvs_ensemble_options.flags */
export const EnsembleFlags = {
  /** initial shapes are not perturbed; perturbation is 0 */
  flag_unperturbed: 1,
} as const;
export type EnsembleFlags = keyof typeof EnsembleFlags;

/** Motion of the boundary (annulus and heads) relative to the pressure. */
export const EnsembleOrder = {
  /** in proportion to the pressure */
  together: 1,
  /** before the pressure */
  boundary_first: 2,
  /** after the pressure */
  pressure_first: 3,
} as const;
export type EnsembleOrder = keyof typeof EnsembleOrder;

/** Statistics over the members at rest. */
export const EnsembleStatistic = {
  mean: 1,
  min: 2,
  max: 3,
  /** standard deviation of the sample: sqrt(sum / (n - 1)) */
  deviation: 4,
  /** n: members that have this figure */
  count: 5,
} as const;
export type EnsembleStatistic = keyof typeof EnsembleStatistic;

/** Arrays of an ensemble: n nodes, p members. */
export const EnsembleArray = {
  /** F64 n, m: RMS distance of each node from its mean */
  node_deviation: 1,
  /** F64 p x p, m: node RMS between every two members, also those not at rest */
  pair_distance: 2,
} as const;
export type EnsembleArray = keyof typeof EnsembleArray;

/** Parameters of model and load. `index` and `component` are fields of mvs_parameter. */
export const ParameterKind = {
  /** m; index: chord segment */
  chord_rest_length: 1,
  /** Pa; index: chord segment with a law that has a modulus */
  chord_young: 2,
  /** m2; index: chord segment */
  chord_area: 3,
  /** its unit; index: leaflet; component: constant of its law */
  leaflet_constant: 4,
  /** m, added to all its triangles; index: leaflet */
  leaflet_thickness: 5,
  /** its unit; index: scallop; component: constant */
  scallop_constant: 6,
  /** m; index: scallop */
  scallop_thickness: 7,
  /** e: the rest shape of the leaflets shrinks by 1 / (1 + e) */
  prestrain: 8,
  /** Pa */
  pressure: 9,
  /** m; index: prescribed node; component: axis 0 to 2 */
  node_position: 10,
  /** m; index: papillary head; component: axis 0 to 2 */
  head_position: 11,
  /** e: the annulus grows by 1 + e about its centroid; a ring changes its size by e times the size */
  annulus_scale: 12,
  /** factor of a displacement field of the prescribed nodes */
  boundary_mode: 13,
  /**
   * m of unloaded tissue by which the insertion of a chord moves along an edge; index: chord
   * segment that ends on a leaflet; component: the node at the other end of the edge. Holds for
   * motion to that node; away from it is another parameter
   */
  chord_site: 14,
} as const;
export type ParameterKind = keyof typeof ParameterKind;

/** Quantities. */
export const QuantityKind = {
  /** m; index: node; component: axis 0 to 2 */
  node_position: 1,
  /**
   * sum of weights times positions; also the first-order change of any function of the positions,
   * by its gradient as weights
   */
  linear: 2,
  /** m, of a node from `point`; index: node */
  node_distance: 3,
  /** m; index: chord segment */
  chord_length: 4,
  /** index: chord segment; negative when slack */
  chord_strain: 5,
  /** N; index: chord segment */
  chord_tension: 6,
  /** N; index: papillary head; component: axis 0 to 2, or 3: its magnitude */
  head_force: 7,
  /** a number of mvs_measures; `measure`: the name of the field */
  measure: 8,
} as const;
export type QuantityKind = keyof typeof QuantityKind;

/** mvs_sensitivity_options.flags */
export const SensitivityFlags = {
  /** also dx/dp of all nodes: MVS_SENSITIVITY_ARRAY_MOTION */
  motion: 1,
  /** one solution for each parameter, with few quantities too */
  direct: 2,
  /** no test of both sides, and chordae alone are looked at for switches: faster, for fits */
  no_test: 4,
  /**
   * no eigenvalue: stiffness_margin is NaN, and a fold that is about to snap is found only where Ks
   * is not definite
   */
  no_margin: 8,
} as const;
export type SensitivityFlags = keyof typeof SensitivityFlags;

/**
 * Flags of a quantity or a parameter. CHORD, CONTACT and KINK are given where the step of the test
 * reaches a switch that matters; adjoint solutions do not know the motion by each parameter, and
 * give parameters those of every switch that may matter.
 */
export const SensitivityNotes = {
  /**
   * the forces of both sides differ: contact, chordae or the law of a spring switch within `slack`.
   * A parameter is tested along itself, a quantity along its gradient
   */
  note_switch: 1,
  /** a chord is about to switch: see the arrays ABOVE, BELOW */
  note_chord: 2,
  /** the smallest eigenvalue of the tangent is near zero */
  note_snap: 4,
  /** the measure is differenced along dx/dp */
  note_differences: 8,
  /** the same, of a measure on a raster: see libmvs/measure/DEFINITIONS.md */
  note_raster: 16,
  /**
   * a largest or smallest value: its derivative changes where another place takes over; or of a
   * place half way along the annulus: where it passes a node
   */
  note_extreme: 32,
  /**
   * the orifice: its rim is taken as fixed in the tissue. An estimate: of a leak of a few mm2 it
   * can be wrong by several times
   */
  note_envelope: 64,
  /**
   * contact begins, ends or passes from a face to an edge or a corner: see ABOVE, BELOW. Contact
   * that begins has the mean stiffness of its first `slack`
   */
  note_contact: 128,
  /** a spring or chord passes the kink of a bilinear law: see ABOVE, BELOW */
  note_kink: 256,
  /**
   * of a parameter with one of these notes that was solved directly: the forces confirm ABOVE and
   * BELOW, each on its side, to 1 %
   */
  note_sides: 512,
  /**
   * of the largest strain or tension of chordae: another one reaches it within `slack`. DERIVATIVE,
   * ABOVE and BELOW are of the first of them: differentiate each by MVS_QUANTITY_CHORD_STRAIN or
   * _TENSION
   */
  note_tied: 1024,
} as const;
export type SensitivityNotes = keyof typeof SensitivityNotes;

/** Arrays of a result: q quantities, p parameters, n nodes. */
export const SensitivityArray = {
  /** F64 q */
  value: 1,
  /** F64 q x p, a row a quantity */
  derivative: 2,
  /**
   * F64 q x p: derivatives for a growing parameter; equal to DERIVATIVE where nothing is about to
   * switch, NaN where more than 64 places are
   */
  above: 3,
  /** F64 q x p: the same for a falling one */
  below: 4,
  /** U32 q: MVS_SENSITIVITY_NOTE_* */
  quantity_notes: 5,
  /** U32 p: MVS_SENSITIVITY_NOTE_* */
  parameter_notes: 6,
  /** U32: indices of chord segments */
  weak_chords: 7,
  /** F64 (p n) x 3: dx/dp of all nodes for each parameter in turn; empty unless asked for */
  motion: 8,
  /** U32: vertices whose contact is about to switch, in the order of its search; may repeat */
  weak_contacts: 9,
} as const;
export type SensitivityArray = keyof typeof SensitivityArray;

/** Frames of patients in medical images. They differ in the signs of x and y. */
export const PatientFrame = {
  /** the file does not state it */
  unknown: 0,
  /** x to the left, y to the back, z to the head: DICOM */
  lps: 1,
  /** x to the right, y to the front, z to the head */
  ras: 2,
} as const;
export type PatientFrame = keyof typeof PatientFrame;

/** Units of length in files. */
export const LengthUnit = {
  m: 1,
  mm: 2,
  cm: 3,
} as const;
export type LengthUnit = keyof typeof LengthUnit;

/** Places of arrays. */
export const SurfacePlace = {
  /** a row for each point */
  point: 1,
  /** a row for each triangle */
  triangle: 2,
} as const;
export type SurfacePlace = keyof typeof SurfacePlace;

/** Kinds of surfaces. */
export const SurfaceKind = {
  /** the mid-surface of the leaflets: one open sheet */
  mid: 1,
  /**
   * their atrial side, half a thickness above the mid-surface: one open sheet, as SlicerHeart's
   * leaflet models are
   */
  atrial: 2,
  /** both sides and the rims: a closed surface */
  skin: 3,
} as const;
export type SurfaceKind = keyof typeof SurfaceKind;

/** Values of mvs_surface_desc.triangle_leaflet. */
export const LeafletLabel = {
  unknown: 0,
  anterior: 1,
  posterior: 2,
} as const;
export type LeafletLabel = keyof typeof LeafletLabel;

/** Where a finding comes from. */
export const FindingSource = {
  /** by the caller */
  given: 1,
  /** on the surface */
  measured: 2,
  /** from the shape, by a rule that may be wrong */
  guessed: 3,
  /** from a table of normal anatomy */
  assumed: 4,
} as const;
export type FindingSource = keyof typeof FindingSource;

/** Types of the arrays of a snapshot, by their names. */
export interface ArrayTypes {
  /** F64 n x 3, m */
  node_position: Float64Array;
  /** F64 n x 3, m: the unloaded valve */
  node_rest: Float64Array;
  /** F64 n x 3, m: targets of prescribed nodes under load */
  node_loaded: Float64Array;
  /** F64 n x 3, m/s */
  node_velocity: Float64Array;
  /** U8 n: MVS_NODE_KIND_* */
  node_kind: Uint8Array;
  /**
   * F64 n x 3, N: out-of-balance force; where prescribed the force of the valve on what holds it,
   * the negative of a reaction force of FEBio or Abaqus
   */
  node_force: Float64Array;
  /** F64 n x 3, N */
  node_contact_force: Float64Array;
  /** F64 n, m: distance to the facing leaflet, or infinity */
  node_coaptation: Float64Array;
  /** F64 n x 3, m: unloaded targets of prescribed nodes */
  node_open: Float64Array;
  /** U32 n: the node's index before operations, refinement and coarsening; UINT32_MAX for a new node */
  node_origin: Uint32Array;
  /** F64 n x 3: means of the triangles at a node by rest area */
  node_strain_fibre: Float64Array;
  /** F64 n x 3, Pa: the same */
  node_stress_fibre: Float64Array;
  /**
   * F64 n x 3: mode of mvs_stability, the real part of the eigenvector; the longest displacement is
   * 1
   */
  node_mode: Float64Array;
  /** U32 m x 3 */
  triangle_nodes: Uint32Array;
  /** U32 m */
  triangle_leaflet: Uint32Array;
  /** U32 m */
  triangle_scallop: Uint32Array;
  /** F64 m, m */
  triangle_thickness: Float64Array;
  /** F64 m x 3, unit */
  triangle_fibre: Float64Array;
  /** F64 m x 2: principal stretches, larger first */
  triangle_stretch: Float64Array;
  /** F64 m x 2, Pa: principal Cauchy stresses, larger first */
  triangle_stress: Float64Array;
  /** F64 m: share of the triangle that faces another leaflet */
  triangle_coapted: Float64Array;
  /**
   * F64 m x 3: Green-Lagrange strain along the fibre (circumferential), across it (radial), in
   * shear
   */
  triangle_strain_fibre: Float64Array;
  /** F64 m x 3, Pa: Cauchy stress, turned back by the rotation of the triangle, in the same order */
  triangle_stress_fibre: Float64Array;
  /** F64 m x 3: unit direction of the largest stretch */
  triangle_direction: Float64Array;
  /** U32 l, a row a leaflet: MVS_LEAFLET_LAW_* */
  leaflet_law: Uint32Array;
  /** F64 l x 9: thickness in m, then the constants of the law */
  leaflet_constants: Float64Array;
  /** U32 k, in order */
  annulus_nodes: Uint32Array;
  /** U32, in order */
  free_edge_nodes: Uint32Array;
  /** F64 k x 3, N: pull of tissue and pressure on each of them, which the sutures of a ring bear */
  annulus_force: Float64Array;
  /** U32 c x 2 */
  chord_nodes: Uint32Array;
  /** F64 c, m */
  chord_rest_length: Float64Array;
  /** U32 c: MVS_CHORD_KIND_* */
  chord_kind: Uint32Array;
  /** F64 c: (L - L0) / L0, negative when slack */
  chord_strain: Float64Array;
  /** F64 c, N */
  chord_tension: Float64Array;
  /** U64 c */
  chord_id: BigUint64Array;
  /** F64 c, Pa */
  chord_young: Float64Array;
  /** F64 c, m2 */
  chord_area: Float64Array;
  /** U8 c: MVS_CHORD_FLAG_OVER_* */
  chord_flags: Uint8Array;
  /** U32 c: MVS_CHORD_LAW_* */
  chord_law: Uint32Array;
  /** U32 h */
  head_nodes: Uint32Array;
  /** F64 h x 3, N: pull of the chordae on each head */
  head_force: Float64Array;
  /** F64 c x 6: of the law */
  chord_constants: Float64Array;
  /** F64 x 3, m: the points of all rings, one after the other */
  ring_points: Float64Array;
  /** U32 r + 1: first row of each ring's points, then their number */
  ring_start: Uint32Array;
  /** U32 r: MVS_RING_KIND_* */
  ring_kind: Uint32Array;
  /** U64 r */
  ring_id: BigUint64Array;
  /** F64 x 2: strain, nominal stress in Pa; of all curves in turn */
  curve_points: Float64Array;
  /** U32 k + 1: first row of each curve's points, then their number */
  curve_start: Uint32Array;
  /** F64 x 3, m: the smallest opening, as triangles */
  orifice_vertices: Float64Array;
  /** U32 x 3 into MVS_ARRAY_ORIFICE_VERTICES */
  orifice_triangles: Uint32Array;
  /** U32 per triangle of the orifice: index of its part, see mvs_snapshot_get_orifice_part */
  orifice_part: Uint32Array;
  /**
   * F64 4: density, kg/m3; contact thickness, m; contact stiffness, Pa; bending scale, 0: no
   * bending
   */
  valve_constants: Float64Array;
  /** F64 1, s: simulated time since the valve was set */
  state_time: Float64Array;
}

/** All of them by their names in C. */
export const enums: Record<string, Record<string, number>> = {
  mvs_result: Result,
  mvs_type: Type,
  mvs_field_type: FieldType,
  mvs_struct: Struct,
  mvs_chord_kind: ChordKind,
  mvs_leaflet_law: LeafletLaw,
  mvs_chord_law: ChordLaw,
  mvs_ring_kind: RingKind,
  mvs_valve_flags: ValveFlags,
  mvs_shape: Shape,
  mvs_branching: Branching,
  mvs_log_level: LogLevel,
  mvs_backend: Backend,
  mvs_solver: Solver,
  mvs_settle_flags: SettleFlags,
  mvs_lowered_flags: LoweredFlags,
  mvs_array_kind: ArrayKind,
  mvs_node_kind: NodeKind,
  mvs_chord_flags: ChordFlags,
  mvs_part_kind: PartKind,
  mvs_measure_group_flags: MeasureGroupFlags,
  mvs_region_kind: RegionKind,
  mvs_sam_risk: SamRisk,
  mvs_op_kind: OpKind,
  mvs_site_kind: SiteKind,
  mvs_chord_end: ChordEnd,
  mvs_axes: Axes,
  mvs_tool_kind: ToolKind,
  mvs_body_kind: BodyKind,
  mvs_format: Format,
  mvs_phase: Phase,
  mvs_skipped_flags: SkippedFlags,
  mvs_ensemble_start: EnsembleStart,
  mvs_ensemble_flags: EnsembleFlags,
  mvs_ensemble_order: EnsembleOrder,
  mvs_ensemble_statistic: EnsembleStatistic,
  mvs_ensemble_array: EnsembleArray,
  mvs_parameter_kind: ParameterKind,
  mvs_quantity_kind: QuantityKind,
  mvs_sensitivity_flags: SensitivityFlags,
  mvs_sensitivity_notes: SensitivityNotes,
  mvs_sensitivity_array: SensitivityArray,
  mvs_patient_frame: PatientFrame,
  mvs_length_unit: LengthUnit,
  mvs_surface_place: SurfacePlace,
  mvs_surface_kind: SurfaceKind,
  mvs_leaflet_label: LeafletLabel,
  mvs_finding_source: FindingSource,
};
