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

/** The radius of a jet's shaft, mm: its section is a twentieth of the part of the orifice, between a radius that is
 *  visible and one that would hide leaflets. */
const jetRadius = (area: number): number => Math.min(1.2, Math.max(0.3, Math.sqrt((0.05 * area) / Math.PI)));

/** An arrow along the jet of each part of the orifice, thicker and longer for larger parts. */
export function jets(parts: OrificePart[]): Mesh {
  const shapes = new Shapes();
  for (const part of parts) {
    const radius = jetRadius(part.area);
    const length = 3 + Math.min(8, 1.1 * Math.sqrt(part.area));
    const along = (s: number) => part.centroid.map((v, c) => v + s * part.direction[c]);
    shapes.tube(along(0.5), along(length), radius, tissue.orifice, 10);
    shapes.tube(
      along(length),
      along(length + 2.5 * radius + 1.2),
      2 * radius + 0.3,
      tissue.orifice,
      12,
      0.02,
    );
  }
  return shapes.mesh();
}
