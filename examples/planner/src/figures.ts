// Figures of a snapshot: measures, regions, chordae, the opening, the spread over closures. Units as in protocol.ts.

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
  /** Pairs of triangles that cross: figures of leaflets that cross do not count. */
  crossings: number;
  atRest: boolean;
  /** N, the largest force out of balance after the settle; left out where no settle of the page led to the valve. */
  residual?: number;
  underLoad: boolean;
}

export interface HistoryEntry {
  title: string;
  kind: string;
  group: string;
  /** Id of the part that it made. */
  made: string;
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
