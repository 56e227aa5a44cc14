// Data in the messages (calls.ts) between the page and the worker that owns the library. Lengths are in mm, forces in N,
// pressures in mmHg, areas in mm2, strains as fractions: the worker converts, the page only shows.
import type { Figures, Range } from './figures';

export type * from './figures';
export type * from './surfaces';

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

/** A snapshot as the page shows it. */
export interface Shown {
  picture: Picture;
  figures: Figures;
  /** What the library warned of on the way to it. */
  warnings?: string[];
  /** mmHg: the load of the valve file that was opened, where it is another one than the page closes with. */
  ownLoad?: number;
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

/** Contents of a session beside the plan. */
export interface SessionContents {
  title: string;
  notes: string;
  /** mm2, within which the leak of the starting valve is known; null where that was not built from an image. */
  leakRange?: Range | null;
  /** ml/s through the open valve, where it is known. */
  flow?: number | null;
  /** The valve of the tour that it is a repair of. */
  tour?: number | null;
}

export interface SessionOpened {
  shown: Shown;
  /** The closed valve before the first operation. */
  first: Shown;
  checkpoints: CheckpointList;
  notes: string;
  title: string;
  leakRange: Range | null;
  /** The range is that of the first valve, and not of one from which operations made it. */
  leakRangeOwn: boolean;
  flow: number | null;
  tour: number | null;
  sameResult: boolean;
}
