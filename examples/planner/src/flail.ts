// A flail leaflet: a free edge that stands in the atrium.
import type { Picture, Topology } from './protocol';
import { heightOf } from './view/mesh';
import { linesOf } from './view/seams';

/** mm of the highest point of a scallop's free edge above the plane of the annulus; seams are not free. */
export function edgeHeight(
  topology: Topology,
  { positions }: Picture,
  frame: number[],
  scallop: string,
): number {
  const free = new Set(linesOf(topology).free.flat());
  const which = topology.scallops.findIndex((part) => part.name === scallop);
  let highest = -Infinity;
  topology.triangles.forEach((node, k) => {
    if (topology.triangleScallop[Math.floor(k / 3)] !== which || !free.has(node)) return;
    highest = Math.max(highest, heightOf(positions, node, frame));
  });
  return highest;
}
