// A place that is clicked in the preview of an operation, in the valve before it: the operation may have divided triangles.
import * as state from '../store/state';
import type { Picture, Site, Topology } from '../protocol';
import { point } from './mesh';
import { placeIn, type SurfaceHit } from './pick';

type Vector = [number, number, number];

/** Origin of a node that the operation has made. */
const made = 0xffffffff;

/** Places of the preview's nodes in the valve before: by their origin, that of the made node is the place in the form. */
function placesBefore(shown: Topology, old: Topology, x: Float32Array, at: Vector | null): (Vector | null)[] {
  const rows = new Map(Array.from(old.origin, (origin, row) => [origin, row]));
  return Array.from(shown.origin, (origin) => {
    const row = origin === made ? undefined : rows.get(origin);
    return row === undefined ? at : point(x, row);
  });
}

/** Barycentric weights of the foot of a point on the plane of a triangle, and its distance; null if the foot is outside. */
function footOn([a, b, c]: Vector[], p: Vector): { u: Vector; off: number } | null {
  const minus = (v: Vector, w: Vector): Vector => [v[0] - w[0], v[1] - w[1], v[2] - w[2]];
  const dot = (v: Vector, w: Vector) => v[0] * w[0] + v[1] * w[1] + v[2] * w[2];
  const [e, f, g] = [minus(b, a), minus(c, a), minus(p, a)];
  const [ee, ef, ff, ge, gf] = [dot(e, e), dot(e, f), dot(f, f), dot(g, e), dot(g, f)];
  const area = ee * ff - ef * ef;
  if (area <= 0) return null;
  const [v, w] = [(ff * ge - ef * gf) / area, (ee * gf - ef * ge) / area];
  // places on a side of two triangles belong to one of them
  if (Math.min(v, w, 1 - v - w) < -1e-4) return null;
  const off = Math.sqrt(
    Math.max(0, dot(g, g) - 2 * (v * ge + w * gf) + v * v * ee + 2 * v * w * ef + w * w * ff),
  );
  const within = (value: number) => Math.min(1, Math.max(0, value));
  return { u: [within(1 - v - w), within(v), within(w)], off };
}

/** mm within which a place in a divided triangle lies in the plane of the whole one, in single precision. */
const flat = 0.01;

/** The same place in the valve before the preview; null where the operation has made or moved tissue that was not there. */
export function beforePreview(hit: SurfaceHit): SurfaceHit | null {
  const [picture, main] = [state.picture.value, state.main.value?.picture];
  const [shown, old] = [picture, main].map((one: Picture | null | undefined) => one && state.topologyOf(one));
  if (!main || !shown || !old) return null;
  if (shown === old) return hit;
  const x = main.positions;
  const site = Object.values(state.draft.value?.fields ?? {}).find(
    (value): value is Extract<Site, { triangle: number }> =>
      typeof value === 'object' && 'triangle' in (value as object),
  );
  const places = placesBefore(shown, old, x, site ? placeIn(old, x, site) : null);
  const corners = Array.from(
    shown.triangles.subarray(3 * hit.triangle, 3 * hit.triangle + 3),
    (node) => places[node],
  );
  if (corners.some((corner) => !corner)) return null;
  const at = [0, 1, 2].map((c) =>
    corners.reduce((sum, corner, k) => sum + hit.u[k] * corner![c], 0),
  ) as Vector;
  let best: SurfaceHit | null = null;
  let nearest = flat;
  for (let t = 0; t < old.triangles.length / 3; ++t) {
    const own = Array.from(old.triangles.subarray(3 * t, 3 * t + 3), (node) => point(x, node));
    const foot = footOn(own, at);
    if (!foot || foot.off >= nearest) continue;
    nearest = foot.off;
    const node = old.triangles[3 * t + foot.u.indexOf(Math.max(...foot.u))];
    best = { ...hit, triangle: t, u: foot.u, node, at };
  }
  return best;
}
