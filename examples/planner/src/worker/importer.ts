// A patient's surface from a file: points and triangles to show and to click, then the valve built from it.
import type { Mvs } from 'libmvs';
import type { BuildRequest, Finding, Surface } from '../protocol';
import { mm, scaled } from './units';

const sources: Record<string, number> = { given: 1, measured: 2, guessed: 3, assumed: 4 };

export class Importer {
  private points: Float64Array = new Float64Array(0);
  private triangles: Uint32Array = new Uint32Array(0);

  constructor(private readonly mvs: Mvs) {}

  read(name: string, bytes: Uint8Array, unit: string): Surface {
    const surface = this.mvs.readSurface(bytes, name, { unit: unit as 'mm' });
    this.points = Float64Array.from(surface.points);
    this.triangles = Uint32Array.from(surface.triangles);
    return { points: scaled(this.points, mm), triangles: this.triangles.slice(), format: surface.format };
  }

  /** The OBJ file of a valve that is built from the surface read last. */
  build(request: BuildRequest, report: (share: number) => void): { valve: Uint8Array; findings: Finding[] } {
    const metres = (rows: number[][]) =>
      rows.length ? rows.map((row) => row.map((v) => v / mm)) : undefined;
    const sim = this.mvs.simulator({ progress: (share) => (report(share), false) });
    try {
      const findings = sim.buildValve({
        name: request.name,
        ...(request.kind ? { kind: request.kind } : {}),
        points: this.points,
        triangles: this.triangles,
        ...given('annulus', metres(request.annulus)),
        ...given('papillary_tips', metres(request.tips)),
        ...given('commissures', metres(request.commissures)),
        ...given('anterior', metres(request.anterior)),
      });
      return {
        valve: sim.read((snapshot) => snapshot.save('obj')),
        findings: findings.map(({ name, source, sentence, confidence }) => ({
          name,
          source: sources[String(source)] ?? 0,
          sentence,
          confidence,
        })),
      };
    } finally {
      sim.dispose();
    }
  }
}

function given(name: string, rows: number[][] | undefined): Record<string, number[][]> {
  return rows ? { [name]: rows } : {};
}
