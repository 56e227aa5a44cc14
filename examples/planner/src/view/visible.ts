// Where scallops are seen: a small z-buffer of the leaflets on the grid of the screen, in which each cell holds the scallop in
// front. The name of a scallop then stands on tissue that shows, and hidden or cut tissue has none.
import type { Topology } from '../protocol';
import type { CutPlane } from './renderer';
import type { Viewport } from './viewport';

/** Pixels of a cell. */
const cell = 12;
/** Cells that a scallop has to show for its name to have room. */
const least = 3;

/** Nodes on the screen in cells, with their depth and their side of the section plane. */
function project(view: Viewport, x: Float32Array, plane: CutPlane | null): Float32Array {
  const out = new Float32Array((4 * x.length) / 3);
  const m = view.camera.viewProjection.elements;
  for (let i = 0, o = 0; i < x.length; i += 3, o += 4) {
    const [a, b, c] = [x[i], x[i + 1], x[i + 2]];
    const w = 1 / (m[3] * a + m[7] * b + m[11] * c + m[15]);
    out[o] = (((m[0] * a + m[4] * b + m[8] * c + m[12]) * w + 1) * view.width) / (2 * cell);
    out[o + 1] = ((1 - (m[1] * a + m[5] * b + m[9] * c + m[13]) * w) * view.height) / (2 * cell);
    out[o + 2] = (m[2] * a + m[6] * b + m[10] * c + m[14]) * w;
    out[o + 3] = plane ? plane.normal[0] * a + plane.normal[1] * b + plane.normal[2] * c - plane.offset : -1;
  }
  return out;
}

/** The scallop in each cell, -1 beside the leaflets. */
function scallopsInCells(topology: Topology, p: Float32Array, columns: number, rows: number): Int16Array {
  const owner = new Int16Array(columns * rows).fill(-1);
  const depth = new Float32Array(columns * rows).fill(Infinity);
  const { triangles, triangleScallop } = topology;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [4 * triangles[t], 4 * triangles[t + 1], 4 * triangles[t + 2]];
    const area = (p[b] - p[a]) * (p[c + 1] - p[a + 1]) - (p[c] - p[a]) * (p[b + 1] - p[a + 1]);
    if (area === 0) continue;
    const first = Math.max(0, Math.ceil(Math.min(p[a + 1], p[b + 1], p[c + 1]) - 0.5));
    const last = Math.min(rows - 1, Math.floor(Math.max(p[a + 1], p[b + 1], p[c + 1]) - 0.5));
    const left = Math.max(0, Math.ceil(Math.min(p[a], p[b], p[c]) - 0.5));
    const right = Math.min(columns - 1, Math.floor(Math.max(p[a], p[b], p[c]) - 0.5));
    const [ux, uy] = [(p[c + 1] - p[a + 1]) / area, (p[a] - p[c]) / area];
    const [vx, vy] = [(p[a + 1] - p[b + 1]) / area, (p[b] - p[a]) / area];
    for (let row = first; row <= last; ++row) {
      const dy = row + 0.5 - p[a + 1];
      for (let column = left; column <= right; ++column) {
        const dx = column + 0.5 - p[a];
        const u = dx * ux + dy * uy;
        const v = dx * vx + dy * vy;
        if (u < 0 || v < 0 || u + v > 1) continue;
        const w = 1 - u - v;
        const k = row * columns + column;
        const z = w * p[a + 2] + u * p[b + 2] + v * p[c + 2];
        if (z >= depth[k] || w * p[a + 3] + u * p[b + 3] + v * p[c + 3] > 0) continue;
        depth[k] = z;
        owner[k] = triangleScallop[t / 3];
      }
    }
  }
  return owner;
}

/** For each scallop the pixel in the middle of its seen part, or null. */
export function visiblePlaces(
  view: Viewport,
  topology: Topology,
  x: Float32Array,
): ([number, number] | null)[] {
  const [columns, rows] = [Math.ceil(view.width / cell), Math.ceil(view.height / cell)];
  const owner = scallopsInCells(topology, project(view, x, view.plane()), columns, rows);
  const cells: number[][] = topology.scallops.map(() => []);
  owner.forEach((scallop, k) => scallop >= 0 && cells[scallop].push(k));
  return cells.map((own) => {
    if (own.length < least) return null;
    let [cx, cy] = [0, 0];
    for (const k of own) {
      cx += ((k % columns) + 0.5) / own.length;
      cy += (Math.floor(k / columns) + 0.5) / own.length;
    }
    if (owner[Math.floor(cy) * columns + Math.floor(cx)] !== owner[own[0]]) {
      // a curved or divided region: its cell nearest to the centre
      const range = (k: number) =>
        ((k % columns) + 0.5 - cx) ** 2 + (Math.floor(k / columns) + 0.5 - cy) ** 2;
      const nearest = own.reduce((best, k) => (range(k) < range(best) ? k : best));
      [cx, cy] = [(nearest % columns) + 0.5, Math.floor(nearest / columns) + 0.5];
    }
    return [cx * cell, cy * cell];
  });
}
