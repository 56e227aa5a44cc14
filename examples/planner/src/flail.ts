// Free edges of scallops; that of a flail leaflet stands in the atrium.
import type { Picture, Topology } from './protocol';
import { heightOf } from './view/mesh';
import { linesOf } from './view/seams';

/** mm of the highest point of each scallop's free edge above the plane of the annulus, by its name; seams are not free. */
export function edgeHeights(
  topology: Topology,
  { positions }: Picture,
  frame: number[],
): Map<string, number> {
  const free = new Set(linesOf(topology).free.flat());
  const heights = new Map<string, number>();
  topology.triangles.forEach((node, k) => {
    const scallop = topology.scallops[topology.triangleScallop[Math.floor(k / 3)]];
    if (!scallop || !free.has(node)) return;
    const height = heightOf(positions, node, frame);
    heights.set(scallop.name, Math.max(height, heights.get(scallop.name) ?? height));
  });
  return heights;
}
