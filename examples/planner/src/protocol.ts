// Data in the messages (calls.ts) between the page and the worker that owns the library. Lengths are in mm, forces in N,
// pressures in mmHg, areas in mm2, strains as fractions: the worker converts, the page only shows.

/** A named part: a scallop, a chord, a papillary head, a ring. Ids are those of the library, as text. */
export interface Part {
  id: string;
  name: string;
}

/** Connectivity of a valve: constant until an operation changes it. */
export interface Topology {
  key: string;
  nodes: number;
  triangles: Uint32Array;
  triangleLeaflet: Uint32Array;
  triangleScallop: Uint32Array;
  annulus: Uint32Array;
  freeEdge: Uint32Array;
  chordNodes: Uint32Array;
  chordKind: Uint32Array;
  chordRadius: Float32Array;
  /** 1 for sutures and artificial chordae, by their modulus. */
  chordArtificial: Uint32Array;
  headNodes: Uint32Array;
  origin: Uint32Array;
  leaflets: Part[];
  scallops: Part[];
  chords: Part[];
  heads: Part[];
  rings: Part[];
}

/** Positions of one moment, and what colours need. Arrays are transferred. */
export interface Picture {
  topology: string;
  /** Sent with the first picture of a topology only. */
  connectivity?: Topology;
  positions: Float32Array;
  ringPoints: Float32Array;
  ringStart: Uint32Array;
  chordTaut: Float32Array;
  orificeVertices: Float32Array;
  orificeTriangles: Uint32Array;
  /** The hand of a tool, if there is one: position, then the held point. */
  hand?: Float32Array;
}

/** Names of the checkpoints in their order, hashes of their valves, and the one that was removed last and can be put back. */
export interface CheckpointList {
  names: string[];
  hashes: string[];
  removed: string | null;
}

/** Values per node for colour maps, computed on request of a full read-out. */
export interface Fields {
  coaptation: Float32Array;
  stretch: Float32Array;
}

export interface Chord {
  id: string;
  name: string;
  kind: number;
  heads: string;
  scallops: string;
  length: number;
  rest: number;
  strain: number;
  tension: number;
  strainLimit: number;
  tensionLimit: number;
  over: boolean;
  /** Whether its modulus is one that only sutures have. */
  artificial: boolean;
}

export interface Region {
  name: string;
  commissure: boolean;
  coaptationMean: number;
  coaptationMin: number;
  orifice: number;
  gap: number;
  billow: number;
  tenting: number;
}

export interface OrificePart {
  area: number;
  gap: number;
  centroid: [number, number, number];
  direction: [number, number, number];
  anterior: string;
  posterior: string;
  commissures: string;
}

export interface Measures {
  orifice: number;
  coaptationArea: number;
  coaptationMean: number;
  coaptationMin: number;
  coaptationMax: number;
  coaptationHeight: number;
  coaptationDepth: number;
  tentingHeight: number;
  tentingArea: number;
  tentingVolume: number;
  billowHeight: number;
  billowVolume: number;
  annulusAp: number;
  annulusCc: number;
  annulusPerimeter: number;
  annulusArea: number;
  annulusSaddle: number;
  annulusAngle: number;
  maxChordStrain: number;
  maxChordTension: number;
  maxLeafletStrain: number;
  leafletStrain95: number;
  leafletStress95: number;
  chordsOver: number;
  /** The largest share of its working limit that a chord carries; 1 is the limit. */
  chordLoad: number;
  crossings: number;
  atRest: boolean;
  underLoad: boolean;
}

export interface HistoryEntry {
  title: string;
  kind: string;
  group: string;
  undone: boolean;
}

/** How a clip was set by the plan, the operations before the repair included. */
export interface ClipSet {
  name: string;
  /** The title of its operation, in which its place is in words. */
  title: string;
  /** mm. */
  width: number;
  /** Degrees, against the clock as seen from the atrium. */
  angle: number;
}

/**
 * How much of a snapshot is known: its shape, also its orifice and coaptation, or all. The shape is calculated first
 * and the regions last; numbers that are still to come are NaN, their lists are empty and their fields null.
 */
export type Known = 'shape' | 'orifice' | 'all';

/** Figures of a snapshot. */
export interface Figures {
  known: Known;
  hash: string;
  valve: string;
  measures: Measures;
  regions: Region[];
  orificeParts: OrificePart[];
  chords: Chord[];
  /** Force on each papillary head, N. */
  heads: number[];
  /** Rows: origin, AP (towards anterior), CC, into the atrium; the origin in mm. */
  frame: number[];
  history: HistoryEntry[];
  clips: ClipSet[];
  fields: Fields | null;
}

/** A snapshot as the page shows it. */
export interface Shown {
  picture: Picture;
  figures: Figures;
}

/** A picture while something moves: a settle, the opening slider, a hand. */
export interface Motion {
  picture: Picture;
  share: number;
  /** As in `Figures`; of a picture that is shown before any figures. */
  frame?: number[];
}

/** A place on a leaflet, as operations take it. */
export type Site =
  { triangle: number; u: [number, number, number] } | { scallop: string; along: number; height: number };

/** The value of a field of an operation in the units of the page. */
export type FieldValue = number | string | Site | [number, number, number] | number[][];

/** An operation: its kind and the fields that are given. */
export interface Operation {
  kind: string;
  fields: Record<string, FieldValue>;
}

/** A field of an operation, from the library's table. */
export interface FieldInfo {
  name: string;
  type: string;
  required: boolean;
  low: number;
  high: number;
  unit: string;
  label: string;
  help: string;
  choices: { name: string; value: number }[];
  fallback: string;
  fallbackValue: number;
}

export interface OperationInfo {
  name: string;
  help: string;
  fields: FieldInfo[];
}

export interface Failure {
  code: string;
  part: string;
  message: string;
}

/** A cut across the CC axis at an offset from the middle, mm; in the frame of the healthy valve for that valve. */
export interface SectionRequest {
  which: 'main' | 'preview' | 'first' | 'healthy' | `checkpoint ${string}`;
  frame: number[];
  offset: number;
}

/** Segments of a cut: AP and height of their two ends, mm, rows of four. */
export type Section = Float32Array;

export interface Hand {
  tool: 'grasp' | 'ball';
  node: number;
  /** Where it begins, and where it goes at once. */
  position: number[];
  to: number[];
}

export interface Cost {
  /** Hash of the closed valve that was opened: it may have changed while the question was on its way. */
  hash: string;
  openArea: number;
  anteriorLength: number;
  posteriorLength: number;
  lengthRatio: number;
  annulusForce: number;
  /** mmHg of a mean flow of 1 ml/s: the gradient grows with the square of the flow. */
  resistance: number;
}

/** Contents of a session beside the plan. */
export interface SessionContents {
  title: string;
  notes: string;
  /** mm2, within which the leak of the starting valve is known; null where that was not built from an image. */
  leakRange?: Range | null;
  /** ml/s through the open valve, where it is known. */
  flow?: number | null;
}

export interface SessionOpened {
  shown: Shown;
  /** The closed valve before the first operation. */
  first: Shown;
  checkpoints: CheckpointList;
  notes: string;
  title: string;
  leakRange: Range | null;
  flow: number | null;
  sameResult: boolean;
}

/** Figures of the healthy valve and of the founding paper's repair, for the score of the tour. */
export interface FoundingResult {
  healthy: { measures: Measures; openArea: number };
  /** Calculated after the other. */
  repaired?: { measures: Measures; openArea: number; operations: string[] };
}

/** The least and the largest value. */
export type Range = [number, number];

/** Ranges of figures over closures that came to rest; those of measures without a number are left out. */
export interface Spread {
  /** Hash of the closed valve that was closed again. */
  hash: string;
  members: number;
  converged: number;
  equilibria: number;
  nodeMax: number;
  measures: Partial<Record<keyof Measures, Range>>;
  /** By name. */
  regions: Record<string, Record<'coaptationMean' | 'orifice' | 'billow', Range>>;
  /** Pulls by id, N. */
  chords: Record<string, Range>;
  /** As in `Figures`. */
  heads: Range[];
}

export type SurfaceKind = '' | 'mid' | 'atrial' | 'skin';

/** Units in which a file may have its lengths. */
export type FileUnit = 'mm' | 'cm' | 'm' | 'inch';

/** Findings on a surface before anything on it is clicked; lengths in mm. */
export interface SurfaceShape {
  /** The middle of the annulus, or of the whole surface without a boundary. */
  middle: [number, number, number];
  /** Into the atrium. */
  up: [number, number, number];
  /** Across `up`, along which the points spread least: front to back, or its opposite. */
  narrow: [number, number, number];
  /** Largest distance from the middle. */
  radius: number;
  /** The normals of the triangles point into the atrium. */
  outward: boolean;
}

export interface Surface {
  points: Float32Array;
  triangles: Uint32Array;
  /** Normals of the points, unit length. */
  normals: Float32Array;
  format: string;
  unit: FileUnit;
  /** Where the unit is from: the file states it, the user has chosen it, or it was guessed from the width. */
  unitFrom: 'file' | 'choice' | 'width';
  /** Distance of two points far from each other, mm. */
  width: number;
  shape: SurfaceShape;
}

export interface BuildRequest {
  /** Layer of the leaflets that the surface describes; '' leaves it to the library. */
  kind: SurfaceKind;
  annulus: number[][];
  tips: number[][];
  commissures: number[][];
  anterior: number[][];
  name: string;
}

export interface Finding {
  name: string;
  source: number;
  sentence: string;
  confidence: number;
  /** SI. */
  values: number[];
}
