// An imported surface: its mesh, lit as a leaflet with both sides told apart, and the frame of its views, from the shape that
// the worker guessed and from the points that were clicked.
import type { Surface, SurfaceShape } from '../protocol';
import { cross, dot, minus, scale, unit, type Vector } from '../vector';
import { tissue } from './colours';
import type { Colour, Mesh } from './mesh';
import type { Imported } from '../store/state';

/** The direction to the front, across the axis: as the clicked points say, else the narrow one or its opposite. */
function forward({ middle, up, narrow }: SurfaceShape, marks: Imported['points']): Vector {
  const across = (v: Vector) => minus(v, scale(up, dot(v, up)));
  const [one, other] = marks.commissures as Vector[];
  const ap = other ? cross(up, unit(across(minus(other, one)))) : narrow;
  const anterior = marks.anterior[0] as Vector | undefined;
  return anterior && dot(minus(anterior, middle), ap) < 0 ? scale(ap, -1) : ap;
}

/** The frame of a surface as in `Figures`. */
export function surfaceFrame(shape: SurfaceShape, marks: Imported['points']): number[] {
  const ap = forward(shape, marks);
  return [...shape.middle, ...ap, ...cross(ap, shape.up), ...shape.up];
}

export function surfaceMesh({ points, triangles, normals, shape }: Surface): Mesh {
  const shade = (colour: Colour) => {
    const out = new Float32Array(points.length);
    for (let i = 0; i < out.length; i += 3) out.set(colour, i);
    return out;
  };
  const [atrial, ventricular] = [shade(tissue.atrialAnterior), shade(tissue.ventricularAnterior)];
  return {
    positions: points,
    index: triangles,
    normals,
    front: shape.outward ? atrial : ventricular,
    back: shape.outward ? ventricular : atrial,
    opacity: 1,
    overlay: false,
    cut: false,
    flat: false,
  };
}
