// The mesh of an imported surface, lit as a leaflet, with both of its sides.
import { tissue } from './colours';
import { vertexNormals, type Colour, type Mesh } from './mesh';

export function surfaceMesh(positions: Float32Array, index: Uint32Array): Mesh {
  const shade = (colour: Colour) => {
    const out = new Float32Array(positions.length);
    for (let i = 0; i < out.length; i += 3) out.set(colour, i);
    return out;
  };
  return {
    positions,
    index,
    normals: vertexNormals(positions, index),
    front: shade(tissue.atrialAnterior),
    back: shade(tissue.ventricularAnterior),
    opacity: 1,
    overlay: false,
    cut: false,
    flat: false,
  };
}
