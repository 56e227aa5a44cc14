// The leak: its orifice and an arrow along each of its jets, seen and, faintly, through the leaflets.
import type { OrificePart, Picture } from '../protocol';
import { tissue } from './colours';
import { Shapes, vertexNormals, type Mesh } from './mesh';

/** Opacity of a leak that leaflets hide: it is still found, and reads as behind them. */
const behind = 0.22;

/** A mesh where it is seen, and faintly where something hides it. */
export function throughTissue(mesh: Mesh, opacity = behind): Mesh[] {
  return [
    { ...mesh, overlay: true, opacity },
    { ...mesh, overlay: false },
  ];
}

export function orifice(picture: Picture): Mesh {
  const count = picture.orificeVertices.length;
  const colours = new Float32Array(count);
  for (let i = 0; i < count; i += 3) colours.set(tissue.orifice, i);
  return {
    positions: picture.orificeVertices,
    normals: vertexNormals(picture.orificeVertices, picture.orificeTriangles),
    index: picture.orificeTriangles,
    front: colours,
    back: colours,
    opacity: 0.85,
    overlay: false,
    cut: false,
    flat: true,
  };
}

/** An arrow along the jet of each part of the orifice, longer for larger parts. */
export function jets(parts: OrificePart[]): Mesh {
  const shapes = new Shapes();
  for (const part of parts) {
    const length = 4 + Math.min(8, Math.sqrt(part.area));
    const along = (s: number) => part.centroid.map((v, c) => v + s * part.direction[c]);
    shapes.tube(along(0.5), along(length), 0.45, tissue.orifice, 10);
    shapes.tube(along(length), along(length + 2.5), 1.2, tissue.orifice, 12, 0.02);
  }
  return shapes.mesh();
}
