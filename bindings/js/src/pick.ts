// Picking: the part that a ray from the eye meets first. Leaflets by the intersection of a ray with triangles
// (Moeller, Trumbore 1997); chordae and papillary heads, which are thin, by their distance from the ray.
import { knownOptions, refuse } from "./error.js";
import type { Snapshot } from "./snapshot.js";

export interface Ray {
  origin: ArrayLike<number>;
  /** Any length but 0. */
  direction: ArrayLike<number>;
  /** m, radius within which a chord or head is met, at the eye [1e-3]. */
  radius?: number;
  /** Growth of that radius per m from the eye, for perspective [0]. */
  spread?: number;
  /** Kinds that may be met [all]. */
  kinds?: readonly ("leaflet" | "chord" | "head")[];
}

export interface Picked {
  kind: "leaflet" | "chord" | "head";
  /** m, along the ray from its origin. */
  distance: number;
  /** m, the place met: on the triangle, the chord or at the head. */
  point: [number, number, number];
  /** Row in the arrays of its kind: triangle, chord segment or head. */
  index: number;
  /** Name and id of the chord or head; of the scallop where a leaflet is met. */
  name: string;
  id: bigint;
  /** Leaflet only: barycentric coordinates in the triangle, and its node nearest to the point. */
  u?: [number, number, number];
  node?: number;
  /** Chord only: 0 at its end nearer the head, 1 at that nearer the leaflet. */
  along?: number;
}

type Vector = [number, number, number];
type Reach = { radius: number; spread: number };
type Found = { distance: number; index: number; point: Vector; u?: Vector; along?: number };

const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const minus = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const plus = (a: Vector, b: Vector, t: number): Vector => [a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]];
const cross = (a: Vector, b: Vector): Vector => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const row = (x: ArrayLike<number>, k: number): Vector => [x[3 * k]!, x[3 * k + 1]!, x[3 * k + 2]!];

function meetTriangle(o: Vector, d: Vector, a: Vector, b: Vector, c: Vector): { t: number; u: Vector } | undefined {
  const ab = minus(b, a);
  const ac = minus(c, a);
  const p = cross(d, ac);
  const determinant = dot(ab, p);
  if (determinant === 0) return undefined;
  const s = minus(o, a);
  const v = dot(s, p) / determinant;
  const q = cross(s, ab);
  const w = dot(d, q) / determinant;
  const t = dot(ac, q) / determinant;
  if (!(v >= 0 && w >= 0 && v + w <= 1 && t >= 0)) return undefined;
  return { t, u: [1 - v - w, v, w] };
}

// The parameters of the nearest points of a ray (t >= 0, unit d) and a segment (0 <= s <= 1).
function nearest(o: Vector, d: Vector, a: Vector, b: Vector): { t: number; s: number; gap: number } {
  const e = minus(b, a);
  const r = minus(o, a);
  const ee = dot(e, e);
  const de = dot(d, e);
  const denominator = ee - de * de;
  const clamp = (x: number): number => Math.min(1, Math.max(0, x));
  let s = denominator > 1e-12 * ee ? clamp((dot(r, e) - dot(r, d) * de) / denominator) : 0;
  let t = dot(minus(plus(a, e, s), o), d);
  if (t < 0) {
    t = 0;
    s = ee > 0 ? clamp(dot(r, e) / ee) : 0;
  }
  const apart = minus(plus(a, e, s), plus(o, d, t));
  return { t, s, gap: Math.sqrt(dot(apart, apart)) };
}

function pickLeaflet(snapshot: Snapshot, o: Vector, d: Vector): Found | undefined {
  const x = snapshot.array("node_position");
  const triangles = snapshot.array("triangle_nodes");
  let best: Found | undefined;
  for (let k = 0; k < triangles.length / 3; ++k) {
    const [i, j, l] = [triangles[3 * k]!, triangles[3 * k + 1]!, triangles[3 * k + 2]!];
    const met = meetTriangle(o, d, row(x, i), row(x, j), row(x, l));
    if (met && (!best || met.t < best.distance)) best = { distance: met.t, index: k, point: plus(o, d, met.t), u: met.u };
  }
  return best;
}

// The segment nearest to the ray, by the share of its radius, of those within reach.
function pickThin(count: number, ends: (k: number) => [Vector, Vector], o: Vector, d: Vector, reach: Reach, behind: number): Found | undefined {
  let best: (Found & { share: number }) | undefined;
  for (let k = 0; k < count; ++k) {
    const [a, b] = ends(k);
    const { t, s, gap } = nearest(o, d, a, b);
    const radius = reach.radius + t * reach.spread;
    const share = radius > 0 ? gap / radius : gap === 0 ? 0 : Infinity;
    if (share > 1 || t - radius > behind || (best && share >= best.share)) continue;
    best = { distance: t, index: k, point: plus(a, minus(b, a), s), along: s, share };
  }
  return best;
}

const kinds = ["leaflet", "chord", "head"] as const;

function vector(value: unknown, what: string): Vector {
  const list = value as ArrayLike<number>;
  if (typeof value !== "object" || value === null || list.length !== 3) return refuse(what, `${what} has to be an array of 3 numbers`);
  const read: Vector = [list[0]!, list[1]!, list[2]!];
  for (const x of read) if (!Number.isFinite(x)) refuse(what, `${what} has the element ${String(x)}: finite numbers are needed`);
  return read;
}

function positive(value: unknown, fallback: number, what: string): number {
  if (value === undefined) return fallback;
  if (typeof value !== "number" || !(value >= 0 && value < Infinity)) refuse(what, `${what} is ${String(value)}: it has to be a number from 0`);
  return value as number;
}

// The ray with its defaults, and a direction of length 1.
function checked(ray: Ray): { o: Vector; d: Vector; reach: Reach; allowed: readonly string[] } {
  knownOptions(ray, ["origin", "direction", "radius", "spread", "kinds"], "ray");
  const direction = vector(ray.direction, "ray.direction");
  const length = Math.hypot(...direction);
  if (!(length > 0 && length < Infinity)) refuse("ray.direction", `ray.direction has the length ${length}: it needs one above 0`);
  const allowed = ray.kinds ?? kinds;
  if (!Array.isArray(allowed)) refuse("ray.kinds", `ray.kinds is not an array of ${kinds.join(", ")}`);
  for (const kind of allowed) {
    if (!kinds.includes(kind)) refuse("ray.kinds", `ray.kinds has ${JSON.stringify(kind)}: it has to be one of ${kinds.join(", ")}`);
  }
  const reach = { radius: positive(ray.radius, 1e-3, "ray.radius"), spread: positive(ray.spread, 0, "ray.spread") };
  const d = direction.map((x) => x / length) as Vector;
  return { o: vector(ray.origin, "ray.origin"), d, reach, allowed };
}

/** The part that a ray meets: a chord or head within its radius and not behind a leaflet, else the leaflet. */
export function pick(snapshot: Snapshot, ray: Ray): Picked | undefined {
  const { o, d, reach, allowed } = checked(ray);
  // leaflets that may be met hide chordae and heads behind them
  const leaflet = pickLeaflet(snapshot, o, d);
  const behind = leaflet && allowed.includes("leaflet") ? leaflet.distance : Infinity;
  const x = snapshot.array("node_position");
  const heads = snapshot.array("head_nodes");
  const chords = snapshot.array("chord_nodes");
  const head = allowed.includes("head") ? pickThin(heads.length, (k) => [row(x, heads[k]!), row(x, heads[k]!)], o, d, reach, behind) : undefined;
  if (head) return named(snapshot, "head", head);
  const chord = allowed.includes("chord")
    ? pickThin(chords.length / 2, (k) => [row(x, chords[2 * k]!), row(x, chords[2 * k + 1]!)], o, d, reach, behind) : undefined;
  if (chord) return named(snapshot, "chord", chord);
  return leaflet && allowed.includes("leaflet") ? onLeaflet(snapshot, leaflet) : undefined;
}

function named(snapshot: Snapshot, kind: "head" | "chord", found: Found): Picked {
  const part = snapshot.mvs.c.mvs_snapshot_get_part(snapshot.handle, kind, found.index);
  const { distance, index, point, along } = found;
  return { kind, distance, index, point, name: part.name, id: part.id, ...(kind === "chord" ? { along } : {}) } as Picked;
}

function onLeaflet(snapshot: Snapshot, found: Found): Picked {
  const { distance, index, point, u } = found;
  const scallop = snapshot.array("triangle_scallop")[index]!;
  const part = snapshot.mvs.c.mvs_snapshot_get_part(snapshot.handle, "scallop", scallop);
  const corner = u!.indexOf(Math.max(...u!));
  const node = snapshot.array("triangle_nodes")[3 * index + corner]!;
  return { kind: "leaflet", distance, index, point, name: part.name, id: part.id, u: u!, node };
}
