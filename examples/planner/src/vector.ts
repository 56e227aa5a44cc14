// Vectors of three numbers.
export type Vector = [number, number, number];

export const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const minus = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a: Vector, s: number): Vector => [a[0] * s, a[1] * s, a[2] * s];
/** The place a share of the way from one place to another. */
export const between = (a: readonly number[], b: readonly number[], share: number): Vector =>
  [0, 1, 2].map((c) => a[c] + share * (b[c] - a[c])) as Vector;
export const unit = (a: Vector): Vector => scale(a, 1 / (Math.hypot(...a) || 1));
