// Borders of scallops as smooth lines: iso-lines by marching triangles. A scallop is a set of triangles, so its border follows sides of
// the mesh in a zigzag. Its indicator, averaged at the nodes and smoothed over their neighbours, is a field on the leaflet; the border
// is where the fields of two scallops are equal and larger than all others. It stays within about one side of the mesh of the
// triangles' border.
import type { Topology } from '../protocol';

/** A point on a side of the mesh: `share` of the way from node `a` to node `b`. */
export interface OnSide {
  a: number;
  b: number;
  share: number;
}

/** A straight piece of a border across one triangle. */
export interface BorderLine {
  from: OnSide;
  to: OnSide;
}

/** Rounds of smoothing: after fewer the zigzag of an irregular mesh is still seen, after more short borders lean to their ends. */
const rounds = 4;

/** Sides of the triangles, `ends` in pairs, with cotangent weights: a linear function stays unchanged by smoothing on a flat irregular mesh. */
function weighted(
  { nodes, triangles }: Topology,
  x: Float32Array,
): { ends: Uint32Array; weights: Float32Array } {
  const found = new Map<number, number>();
  const apart = (p: number, q: number) => [0, 1, 2].map((c) => x[3 * p + c] - x[3 * q + c]);
  for (let t = 0; t < triangles.length; t += 3) {
    for (let k = 0; k < 3; ++k) {
      const [a, b, corner] = [0, 1, 2].map((step) => triangles[t + ((k + step) % 3)]);
      const [u, v] = [apart(a, corner), apart(b, corner)];
      const dot = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
      const cross = Math.hypot(
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
      );
      const key = Math.min(a, b) * nodes + Math.max(a, b);
      found.set(key, (found.get(key) ?? 0) + dot / Math.max(cross, 1e-9));
    }
  }
  const ends = Uint32Array.from([...found.keys()].flatMap((key) => [Math.floor(key / nodes), key % nodes]));
  // opposite obtuse angles give a negative weight, with which smoothing could diverge
  return { ends, weights: Float32Array.from(found.values(), (weight) => Math.max(weight, 0.01)) };
}

/** One round: the mean of a node's value and of the weighted mean of its neighbours. */
function smooth(row: Float32Array, { ends, weights }: ReturnType<typeof weighted>): Float32Array {
  const sum = new Float32Array(row.length);
  const total = new Float32Array(row.length);
  weights.forEach((weight, k) => {
    const [a, b] = [ends[2 * k], ends[2 * k + 1]];
    sum[a] += weight * row[b];
    sum[b] += weight * row[a];
    total[a] += weight;
    total[b] += weight;
  });
  return row.map((own, node) => (total[node] ? 0.5 * (own + sum[node] / total[node]) : own));
}

/** Share of each scallop at each node, smoothed: rows of nodes. */
function sharesOf(topology: Topology, x: Float32Array): Float32Array[] {
  const { nodes, triangles, triangleScallop, scallops } = topology;
  const count = new Float32Array(nodes);
  let shares = scallops.map(() => new Float32Array(nodes));
  triangles.forEach((node, i) => {
    shares[triangleScallop[Math.floor(i / 3)]][node] += 1;
    count[node] += 1;
  });
  for (const row of shares) row.forEach((sum, node) => (row[node] = count[node] ? sum / count[node] : 0));
  const sides = weighted(topology, x);
  for (let k = 0; k < rounds; ++k) shares = shares.map((row) => smooth(row, sides));
  return shares;
}

/** Pieces of the borders of all scallops, each within one triangle; `x`: positions of the nodes in any pose. */
export function bordersOf(topology: Topology, x: Float32Array): BorderLine[] {
  const shares = sharesOf(topology, x);
  const largest = new Uint32Array(topology.nodes);
  shares.forEach((row, s) =>
    row.forEach((share, node) => {
      if (share > shares[largest[node]][node]) largest[node] = s;
    }),
  );
  const lines: BorderLine[] = [];
  const { triangles } = topology;
  for (let t = 0; t < triangles.length; t += 3) {
    const crossed: OnSide[] = [];
    for (let k = 0; k < 3; ++k) {
      // in the same order from both triangles of the side, so that pieces of a line meet exactly
      const [a, b] = [triangles[t + k], triangles[t + ((k + 1) % 3)]].sort((m, n) => m - n);
      const [p, q] = [largest[a], largest[b]];
      if (p === q) continue;
      const [ahead, behind] = [shares[p][a] - shares[q][a], shares[q][b] - shares[p][b]];
      crossed.push({ a, b, share: ahead + behind > 0 ? ahead / (ahead + behind) : 0.5 });
    }
    // three scallops meet in a triangle: the third crossing joins the line between the others
    for (let k = 1; k < crossed.length; ++k) lines.push({ from: crossed[k - 1], to: crossed[k] });
  }
  return lines;
}
