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

/** Neighbours of each node along sides of the triangles. */
function neighboursOf({ nodes, triangles }: Topology): Set<number>[] {
  const neighbours = Array.from({ length: nodes }, () => new Set<number>());
  triangles.forEach((node, i) => {
    const next = triangles[i % 3 === 2 ? i - 2 : i + 1];
    neighbours[node].add(next);
    neighbours[next].add(node);
  });
  return neighbours;
}

/** Share of each scallop at each node, smoothed: rows of nodes. */
function sharesOf(topology: Topology): Float32Array[] {
  const { nodes, triangles, triangleScallop, scallops } = topology;
  const count = new Float32Array(nodes);
  let shares = scallops.map(() => new Float32Array(nodes));
  triangles.forEach((node, i) => {
    shares[triangleScallop[Math.floor(i / 3)]][node] += 1;
    count[node] += 1;
  });
  for (const row of shares) row.forEach((sum, node) => (row[node] = count[node] ? sum / count[node] : 0));
  const neighbours = neighboursOf(topology);
  for (let k = 0; k < rounds; ++k) {
    shares = shares.map((row) =>
      row.map((own, node) => {
        let sum = 0;
        for (const other of neighbours[node]) sum += row[other];
        return neighbours[node].size ? 0.5 * own + (0.5 * sum) / neighbours[node].size : own;
      }),
    );
  }
  return shares;
}

/** Pieces of the borders of all scallops, each within one triangle. */
export function bordersOf(topology: Topology): BorderLine[] {
  const shares = sharesOf(topology);
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
