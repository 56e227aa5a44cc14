// Cuts through a valve across its CC axis, in the coordinates of a frame: AP to the right, into the atrium upwards.
import type { Snapshot } from 'libmvs';
import type { Section } from '../protocol';
import { mm } from './units';

export function sectionOf(snapshot: Snapshot, frame: number[], offset: number): Section {
  const row = (k: number) => frame.slice(3 * k, 3 * k + 3);
  const [origin, ap, cc, up] = [row(0), row(1), row(2), row(3)];
  const point = origin.map((v, c) => (v + offset * cc[c]) / mm);
  const ends = snapshot.section(point, cc);
  const out = new Float32Array((2 * ends.length) / 3);
  for (let i = 0; i < ends.length; i += 3) {
    for (let c = 0; c < 3; ++c) {
      const away = ends[i + c] * mm - origin[c];
      out[(2 * i) / 3] += away * ap[c];
      out[(2 * i) / 3 + 1] += away * up[c];
    }
  }
  return out;
}
