// The boundaries of a triangle surface as loops of points.

/** Loops of the edges that belong to one triangle, each as its points in turn. */
export function rims(triangles: Uint32Array): number[][] {
  let points = 0;
  for (const point of triangles) points = Math.max(points, point + 1);
  // edges that were met once, as numbers
  const single = new Set<number>();
  for (let t = 0; t < triangles.length; ++t) {
    const [a, b] = [triangles[t], triangles[t % 3 === 2 ? t - 2 : t + 1]];
    const key = Math.min(a, b) * points + Math.max(a, b);
    if (!single.delete(key)) single.add(key);
  }
  const beside = new Map<number, number[]>();
  for (const key of single) {
    const [a, b] = [Math.floor(key / points), key % points];
    beside.set(a, [...(beside.get(a) ?? []), b]);
    beside.set(b, [...(beside.get(b) ?? []), a]);
  }
  const loops: number[][] = [];
  for (const start of beside.keys()) {
    const loop: number[] = [];
    // each edge is taken once: from the list of the point that is left
    for (let at: number | undefined = start; at !== undefined;) {
      const next: number | undefined = beside.get(at)!.pop();
      if (next === undefined) break;
      const back = beside.get(next)!;
      back.splice(back.indexOf(at), 1);
      loop.push(at);
      at = next;
    }
    if (loop.length > 2) loops.push(loop);
  }
  return loops;
}
