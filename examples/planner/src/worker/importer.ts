// A patient's surface from a file: points and triangles to show and to click, then the valve built from it.
import { MvsError, type Mvs } from 'libmvs';
import type { BuildRequest, FileUnit, Finding, SideFile, Surface } from '../protocol';
import { refusals } from '../text/texts';
import { fileUnits, millimetres } from '../units';
import { vertexNormals } from '../view/mesh';
import { shapeOf, sizeOf } from './surface_shape';
import { mm, scaled } from './units';

const sources: Record<string, number> = { given: 1, measured: 2, guessed: 3, assumed: 4 };

/** mm: largest extents of most open valves of adults, then of all surfaces of valves, from an infant's annulus to a ventricle around
 *  a dilated one. */
const sizes = [
  [30, 60],
  [10, 200],
];

/** The unit in which an extent that was read as mm is that of a valve, the first that fits; mm where none does. */
function guessedUnit(size: number): FileUnit {
  const fits = ([low, high]: number[]) =>
    fileUnits.find((unit) => size * millimetres[unit] >= low && size * millimetres[unit] <= high);
  return fits(sizes[0]) ?? fits(sizes[1]) ?? 'mm';
}

type Found = ReturnType<Mvs['readSurface']> & Pick<Surface, 'unitFrom'> & { inUnit: FileUnit };

export class Importer {
  private points: Float64Array = new Float64Array(0);
  private triangles: Uint32Array = new Uint32Array(0);

  constructor(private readonly mvs: Mvs) {}

  /** Reads a file; without a unit in that which it states, else in the one that its size suggests. */
  read(name: string, bytes: Uint8Array, asked: FileUnit | null): Surface {
    const { inUnit, unitFrom, ...found } = asked
      ? this.inChosen(name, bytes, asked)
      : (this.inStated(name, bytes) ?? this.inGuessed(name, bytes));
    hasTriangles(name, found);
    this.points = Float64Array.from(found.points);
    this.triangles = Uint32Array.from(found.triangles);
    const points = scaled(this.points, mm);
    return {
      points,
      triangles: this.triangles.slice(),
      normals: vertexNormals(points, this.triangles),
      format: found.format,
      unit: inUnit,
      unitFrom,
      size: sizeOf(points),
      shape: shapeOf(points, this.triangles),
    };
  }

  /** Closed leaflets: a file that states no unit has that of the open ones. */
  closed({ name, bytes }: SideFile, unit: FileUnit): Found {
    const found = this.inStated(name, bytes) ?? this.inChosen(name, bytes, unit);
    hasTriangles(name, found);
    return found;
  }

  /** The library knows no inches. */
  private inChosen(name: string, bytes: Uint8Array, inUnit: FileUnit): Found {
    const found = this.mvs.readSurface(bytes, name, { unit: inUnit === 'inch' ? 'mm' : inUnit });
    const points = inUnit === 'inch' ? found.points.map((v) => v * millimetres.inch) : found.points;
    return { ...found, points, inUnit, unitFrom: 'choice' };
  }

  /** In the unit of the file; null where it states none. */
  private inStated(name: string, bytes: Uint8Array): Found | null {
    try {
      const found = this.mvs.readSurface(bytes, name);
      return { ...found, inUnit: found.unit as FileUnit, unitFrom: 'file' };
    } catch (error) {
      if (error instanceof MvsError && error.part === 'options.unit') return null;
      throw error;
    }
  }

  private inGuessed(name: string, bytes: Uint8Array): Found {
    const found = this.inChosen(name, bytes, 'mm');
    const inUnit = guessedUnit(Math.max(...sizeOf(found.points)) * mm);
    return { ...(inUnit === 'mm' ? found : this.inChosen(name, bytes, inUnit)), unitFrom: 'size' };
  }

  /** The OBJ file of a valve that is built from the surface read last. */
  build(request: BuildRequest, report: (share: number) => void): { valve: Uint8Array; findings: Finding[] } {
    const metres = (rows: number[][]) =>
      rows.length ? rows.map((row) => row.map((v) => v / mm)) : undefined;
    const sim = this.mvs.simulator({ progress: (share) => (report(share), false) });
    try {
      const closed = request.closed && this.closed(request.closed, request.unit);
      const surface = {
        name: request.name,
        ...(request.kind ? { kind: request.kind } : {}),
        points: this.points,
        triangles: this.triangles,
        ...given('annulus', metres(request.annulus)),
        ...given('papillary_tips', metres(request.tips)),
        ...given('commissures', metres(request.commissures)),
        ...given('anterior', metres(request.anterior)),
        ...(closed ? { closed_points: closed.points, closed_triangles: closed.triangles } : {}),
      };
      // a skin has a thickness of its own
      const known = request.thickness !== null && request.kind !== 'skin';
      const findings = sim.buildValve(surface, known ? { thickness: request.thickness! / mm } : {});
      return {
        valve: sim.read((snapshot) => snapshot.save('obj')),
        findings: findings.map(({ name, source, sentence, confidence, values }) => ({
          name,
          source: sources[String(source)] ?? 0,
          sentence,
          confidence,
          values: [...values],
        })),
      };
    } finally {
      sim.dispose();
    }
  }
}

/** Refuses a file without triangles. */
function hasTriangles(name: string, { triangles }: Pick<Found, 'triangles'>): void {
  if (!triangles.length) throw new MvsError('MVS_E_FORMAT', name, refusals.noTriangles(name));
}

function given(name: string, rows: number[][] | undefined): Record<string, number[][]> {
  return rows ? { [name]: rows } : {};
}
