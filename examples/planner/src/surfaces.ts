// Surfaces of an import, the request to build a valve from one, and its findings. Lengths in mm.

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
  /** Where the unit is from: the file states it, the user has chosen it, or it was guessed from the size. */
  unitFrom: 'file' | 'choice' | 'size';
  /** Extents along the axes of the file, mm. */
  size: number[];
  shape: SurfaceShape;
}

/** A file that is read beside the surface. */
export interface SideFile {
  name: string;
  bytes: Uint8Array;
}

export interface BuildRequest {
  /** Layer of the leaflets that the surface describes; '' leaves it to the library. */
  kind: SurfaceKind;
  annulus: number[][];
  tips: number[][];
  commissures: number[][];
  anterior: number[][];
  /** The same leaflets closed, in the same frame; in `unit` where the file states none. */
  closed: SideFile | null;
  unit: FileUnit;
  /** Of the leaflets, mm; null where it is not known. */
  thickness: number | null;
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
