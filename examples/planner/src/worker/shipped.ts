// The shipped valves, and the picture of the first of them, which the build puts into the page (build/shipped.ts): a
// page shows it before the library is ready.
import type { Mvs } from 'libmvs';
import type { Motion } from '../protocol';
import { foundingValve } from './founding';
import { frameOf, motionOf } from './picture';

/** The OBJ file of a shipped valve. */
export function shippedValve(mvs: Mvs, name: string, vertices: number): Uint8Array {
  const number = /^founding([0-4])$/.exec(name);
  if (number) return foundingValve(mvs, Number(number[1]), vertices);
  const sim = mvs.simulator();
  try {
    sim.generateValve({ vertices });
    return sim.read((snapshot) => snapshot.save('obj'));
  } finally {
    sim.dispose();
  }
}

/** The open valve that the page begins with. */
export function firstPicture(mvs: Mvs, vertices: number): Motion {
  const sim = mvs.simulator();
  try {
    sim.load(shippedValve(mvs, 'healthy', vertices), 'obj');
    return sim.read((snapshot) => ({ ...motionOf(snapshot, 0), frame: frameOf(snapshot) }));
  } finally {
    sim.dispose();
  }
}
