// Where scallops are seen: a small z-buffer of the leaflets on the grid of the screen, in which each cell holds the scallop in
// front. The name of a scallop then stands on tissue that shows, and hidden or cut tissue has none.
import type { Topology } from '../protocol';
import type { CutPlane } from './renderer';
import type { Viewport } from './viewport';

/** Pixels of a cell. */
const cell = 8;
/** Cells that a scallop has to show for its name to have room. */
const least = 6;

/** Nodes on the screen in cells, with their distance from the eye plane, and their side of the section plane. */
function project(view: Viewport, x: Float32Array, plane: CutPlane | null): Float32Array {
  const out = new Float32Array((4 * x.length) / 3);
  for (let i = 0, o = 0; i < x.length; i += 3, o += 4) {
    const [px, py, z] = view.camera.project(x[i], x[i + 1], x[i + 2], view.width, view.height);
    out[o] = px / cell;
    out[o + 1] = py / cell;
    out[o + 2] = z;
    out[o + 3] = plane
      ? plane.normal[0] * x[i] + plane.normal[1] * x[i + 1] + plane.normal[2] * x[i + 2] - plane.offset
      : -1;
  }
  return out;
}

/** The scallop in each cell, -1 where there is none. */
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
    for (let row = first; row <= last; ++row) {
      for (let column = left; column <= right; ++column) {
        const [dx, dy] = [column + 0.5 - p[a], row + 0.5 - p[a + 1]];
        const u = (dx * (p[c + 1] - p[a + 1]) - dy * (p[c] - p[a])) / area;
        const v = (dy * (p[b] - p[a]) - dx * (p[b + 1] - p[a + 1])) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        const at = (k: number) => (1 - u - v) * p[a + k] + u * p[b + k] + v * p[c + k];
        const k = row * columns + column;
        if (at(2) >= depth[k] || at(3) > 0) continue;
        depth[k] = at(2);
        owner[k] = triangleScallop[t / 3];
      }
    }
  }
  return owner;
}

/** For each scallop the pixel in the middle of what is seen of it, or null. */
export function visiblePlaces(
  view: Viewport,
  topology: Topology,
  x: Float32Array,
): ([number, number] | null)[] {
  const [columns, rows] = [Math.ceil(view.width / cell), Math.ceil(view.height / cell)];
  const owner = scallopsInCells(topology, project(view, x, view.plane()), columns, rows);
  const cells: number[][] = topology.scallops.map(() => []);
  owner.forEach((scallop, k) => scallop >= 0 && cells[scallop].push(k));
  const middle = (k: number) => [(k % columns) + 0.5, Math.floor(k / columns) + 0.5];
  return cells.map((own) => {
    if (own.length < least) return null;
    let [cx, cy] = [0, 0];
    for (const [px, py] of own.map(middle)) [cx, cy] = [cx + px / own.length, cy + py / own.length];
    if (owner[Math.floor(cy) * columns + Math.floor(cx)] !== owner[own[0]]) {
      // a curved or divided region: its cell nearest to the centre
      const range = (k: number) => Math.hypot(middle(k)[0] - cx, middle(k)[1] - cy);
      [cx, cy] = middle(own.reduce((best, k) => (range(k) < range(best) ? k : best)));
    }
    return [cx * cell, cy * cell];
  });
}
