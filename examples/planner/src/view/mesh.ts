// A triangle mesh as both renderers take it, and shapes made of triangles: tubes, spheres, cones.

import { cross, minus, unit, type Vector } from '../vector';

export type Colour = readonly [number, number, number];

export interface Mesh {
  positions: Float32Array;
  normals: Float32Array;
  index: Uint32Array;
  /** RGB per vertex, 0 to 1 (sRGB), of the side that the normals point to. */
  front: Float32Array;
  /** The same of the other side; equal to `front` where a mesh has no back. */
  back: Float32Array;
  opacity: number;
  /** Drawn over everything else. */
  overlay: boolean;
  /** Cut by the section plane. */
  cut: boolean;
  /** No light: colour as it is. */
  flat: boolean;
  /** Left out where the eye is above the leaflets. */
  fromBelow?: boolean;
  /** The only side that is drawn; both where it is not given. */
  only?: 'front' | 'back';
}

/** The place of a node. */
export function point(x: Float32Array, node: number): [number, number, number] {
  return [x[3 * node], x[3 * node + 1], x[3 * node + 2]];
}

/** mm of a node above the origin of a frame, along its last axis. */
export function heightOf(x: Float32Array, node: number, frame: number[]): number {
  return [0, 1, 2].reduce((sum, c) => sum + (x[3 * node + c] - frame[c]) * frame[9 + c], 0);
}

/** Collects coloured triangles of many small shapes into one mesh. */
export class Shapes {
  private positions: number[] = [];
  private normals: number[] = [];
  private colours: number[] = [];
  private index: number[] = [];

  private vertex(x: number, y: number, z: number, nx: number, ny: number, nz: number, c: Colour): number {
    this.positions.push(x, y, z);
    this.normals.push(nx, ny, nz);
    this.colours.push(c[0], c[1], c[2]);
    return this.positions.length / 3 - 1;
  }

  /** A tube in bands of two colours, each about as long as `band`, of which the first is at both ends. */
  banded(
    a: ArrayLike<number>,
    b: ArrayLike<number>,
    radius: number,
    colours: [Colour, Colour],
    band: number,
    sides = 7,
  ): void {
    const along = (s: number) => [0, 1, 2].map((c) => a[c] + s * (b[c] - a[c]));
    const length = Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    const count = 2 * Math.max(1, Math.round(length / band / 2)) + 1;
    for (let k = 0; k < count; ++k)
      this.tube(along(k / count), along((k + 1) / count), radius, colours[k % 2], sides);
  }

  /** A tube between two points; its ends may have different radii and colours. */
  tube(
    a: ArrayLike<number>,
    b: ArrayLike<number>,
    radius: number,
    c: Colour,
    sides = 7,
    radiusB = radius,
  ): void {
    let [dx, dy, dz] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    const length = Math.hypot(dx, dy, dz);
    if (length < 1e-9) return;
    [dx, dy, dz] = [dx / length, dy / length, dz / length];
    // two directions across
    let [ux, uy, uz] = Math.abs(dx) < 0.7 ? [0, dz, -dy] : [-dz, 0, dx];
    const s = 1 / Math.hypot(ux, uy, uz);
    [ux, uy, uz] = [ux * s, uy * s, uz * s];
    const [vx, vy, vz] = [dy * uz - dz * uy, dz * ux - dx * uz, dx * uy - dy * ux];
    const slope = (radius - radiusB) / length;
    const lean = 1 / Math.hypot(1, slope);
    const first = this.positions.length / 3;
    for (let k = 0; k < sides; ++k) {
      const angle = (2 * Math.PI * k) / sides;
      const [p, q] = [Math.cos(angle), Math.sin(angle)];
      const [nx, ny, nz] = [ux * p + vx * q, uy * p + vy * q, uz * p + vz * q];
      // the normal of a cone leans towards its narrow end
      const normal = [(nx + slope * dx) * lean, (ny + slope * dy) * lean, (nz + slope * dz) * lean] as const;
      this.vertex(a[0] + nx * radius, a[1] + ny * radius, a[2] + nz * radius, ...normal, c);
      this.vertex(b[0] + nx * radiusB, b[1] + ny * radiusB, b[2] + nz * radiusB, ...normal, c);
    }
    for (let k = 0; k < sides; ++k) {
      const [i, j] = [first + 2 * k, first + 2 * ((k + 1) % sides)];
      this.index.push(i, j, j + 1, i, j + 1, i + 1);
    }
  }

  /** A tube along points, with round joints and, where it is open, round ends. */
  path(points: number[][], radius: number, c: Colour, closed: boolean, sides = 8): void {
    for (let k = 0; k + (closed ? 0 : 1) < points.length; ++k) {
      this.tube(points[k], points[(k + 1) % points.length], radius, c, sides);
      this.sphere(points[k], radius, c, 4, sides);
    }
    if (!closed) for (const end of [points[0], points[points.length - 1]]) this.sphere(end, radius, c, 8, 12);
  }

  sphere(at: ArrayLike<number>, radius: number, c: Colour, rings = 8, sides = 12): void {
    const first = this.positions.length / 3;
    for (let r = 0; r <= rings; ++r) {
      const polar = (Math.PI * r) / rings;
      for (let k = 0; k < sides; ++k) {
        const angle = (2 * Math.PI * k) / sides;
        const n = [Math.sin(polar) * Math.cos(angle), Math.sin(polar) * Math.sin(angle), Math.cos(polar)];
        this.vertex(at[0] + radius * n[0], at[1] + radius * n[1], at[2] + radius * n[2], n[0], n[1], n[2], c);
      }
    }
    for (let r = 0; r < rings; ++r) {
      for (let k = 0; k < sides; ++k) {
        const [i, j] = [first + r * sides + k, first + r * sides + ((k + 1) % sides)];
        this.index.push(i, i + sides, j + sides, i, j + sides, j);
      }
    }
  }

  /** A flat polygon whose corners are listed anticlockwise as seen from its front; convex. */
  polygon(corners: number[][], c: Colour): void {
    const [a, b, d] = corners as Vector[];
    const normal = unit(cross(minus(b, a), minus(d, a)));
    const [first] = corners.map(([x, y, z]) => this.vertex(x, y, z, normal[0], normal[1], normal[2], c));
    for (let k = 2; k < corners.length; ++k) this.index.push(first, first + k - 1, first + k);
  }

  isEmpty(): boolean {
    return !this.index.length;
  }

  /** Takes the shapes of another collection as well. */
  add(other: Shapes): void {
    const first = this.positions.length / 3;
    this.positions.push(...other.positions);
    this.normals.push(...other.normals);
    this.colours.push(...other.colours);
    this.index.push(...other.index.map((vertex) => first + vertex));
  }

  mesh(options: Partial<Pick<Mesh, 'opacity' | 'overlay' | 'cut' | 'flat'>> = {}): Mesh {
    const front = Float32Array.from(this.colours);
    return {
      positions: Float32Array.from(this.positions),
      normals: Float32Array.from(this.normals),
      index: Uint32Array.from(this.index),
      front,
      back: front,
      opacity: 1,
      overlay: false,
      cut: false,
      flat: false,
      ...options,
    };
  }
}

/** Vertex normals: sums of the normals of the triangles by area. */
export function vertexNormals(positions: Float32Array, index: Uint32Array): Float32Array {
  const normals = new Float32Array(positions.length);
  for (let t = 0; t < index.length; t += 3) {
    const [a, b, c] = [3 * index[t], 3 * index[t + 1], 3 * index[t + 2]];
    const ux = positions[b] - positions[a],
      uy = positions[b + 1] - positions[a + 1],
      uz = positions[b + 2] - positions[a + 2];
    const vx = positions[c] - positions[a],
      vy = positions[c + 1] - positions[a + 1],
      vz = positions[c + 2] - positions[a + 2];
    const nx = uy * vz - uz * vy,
      ny = uz * vx - ux * vz,
      nz = ux * vy - uy * vx;
    for (const i of [a, b, c]) {
      normals[i] += nx;
      normals[i + 1] += ny;
      normals[i + 2] += nz;
    }
  }
  for (let i = 0; i < normals.length; i += 3) {
    const s = 1 / (Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1);
    normals[i] *= s;
    normals[i + 1] *= s;
    normals[i + 2] *= s;
  }
  return normals;
}
