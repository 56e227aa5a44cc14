// Software rasteriser: z-buffer, Gouraud shading with two-sided light, for browsers without WebGL, and for
// pictures that have the same pixels on every machine. Triangles that cross the near plane are dropped; the
// camera keeps its distance.
import type { Camera } from './camera';
import { shade } from './light';
import type { Mesh } from './mesh';
import type { CutPlane, Renderer, Scene } from './renderer';

/** Milliseconds of a picture above which the resolution is lowered while something moves. */
const slow = 24;

export class Raster implements Renderer {
  readonly name = 'software';
  readonly canvas: HTMLCanvasElement;
  private context: CanvasRenderingContext2D;
  private width = 1;
  private height = 1;
  private ratio = 1;
  private image: ImageData | null = null;
  private depth = new Float32Array(0);
  private screen = new Float32Array(0);
  private lastTime = 0;

  constructor() {
    this.canvas = document.createElement('canvas');
    const context = this.canvas.getContext('2d', { alpha: false });
    if (!context) throw new Error('this browser draws no pictures: it has no canvas');
    this.context = context;
  }

  resize(width: number, height: number, ratio: number): void {
    this.width = width;
    this.height = height;
    this.ratio = Math.min(ratio, 2);
  }

  draw(scene: Scene, camera: Camera, fast: boolean): void {
    // smooth edges when still: at least three samples for two pixels
    const still = Math.max(this.ratio, 1.5);
    const factor = fast ? (this.lastTime > slow ? 0.5 : 1) : still;
    const w = Math.max(1, Math.round(this.width * factor));
    const h = Math.max(1, Math.round(this.height * factor));
    if (!this.image || this.image.width !== w || this.image.height !== h) {
      this.image = this.context.createImageData(w, h);
      this.depth = new Float32Array(w * h);
      this.canvas.width = w;
      this.canvas.height = h;
    }
    const begin = performance.now();
    render(scene, camera, this.image, this.depth, (n) => this.room(n));
    this.context.putImageData(this.image, 0, 0);
    if (fast) this.lastTime = (performance.now() - begin) / (factor === 1 ? 1 : 0.4);
  }

  private room(n: number): Float32Array {
    if (this.screen.length < n) this.screen = new Float32Array(n);
    return this.screen;
  }

  dispose(): void {
    this.canvas.remove();
  }
}

/** Numbers per vertex after the transformation: x, y, depth, 1/w, front rgb, back rgb, cut distance. */
const stride = 11;

/** Renders a scene into an image; `room` lends memory for the vertices. */
export function render(
  scene: Scene,
  camera: Camera,
  image: ImageData,
  depth: Float32Array,
  room: (n: number) => Float32Array,
): void {
  const pixels = new Uint32Array(image.data.buffer);
  const [r, g, b] = scene.background.map((v) => Math.round(255 * v));
  pixels.fill((255 << 24) | (b << 16) | (g << 8) | r);
  depth.fill(Infinity);
  const ordered = [...scene.meshes].sort((p, q) => rank(p) - rank(q));
  for (const mesh of ordered) {
    const vertices = room((mesh.positions.length / 3) * stride);
    transform(mesh, camera, image.width, image.height, mesh.cut ? scene.plane : null, vertices);
    if (mesh.overlay) depth.fill(Infinity);
    fill(mesh, vertices, image.width, image.height, pixels, depth, mesh.cut && scene.plane !== null);
  }
}

/** Opaque meshes first, then translucent ones, overlays last and in their order, as with WebGL. */
function rank(mesh: Mesh): number {
  return mesh.overlay ? 2 : mesh.opacity < 1 ? 1 : 0;
}

function transform(
  mesh: Mesh,
  camera: Camera,
  width: number,
  height: number,
  plane: CutPlane | null,
  out: Float32Array,
): void {
  const m = camera.viewProjection.elements;
  const v = camera.view.elements;
  const { positions: p, normals: n, front, back, flat } = mesh;
  const lit = [0, 0, 0];
  for (let i = 0, o = 0; i < p.length; i += 3, o += stride) {
    const x = p[i],
      y = p[i + 1],
      z = p[i + 2];
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    const s = w > 1e-3 ? 1 / w : 0;
    out[o] = ((m[0] * x + m[4] * y + m[8] * z + m[12]) * s + 1) * 0.5 * width;
    out[o + 1] = (1 - (m[1] * x + m[5] * y + m[9] * z + m[13]) * s) * 0.5 * height;
    out[o + 2] = (m[2] * x + m[6] * y + m[10] * z + m[14]) * s;
    out[o + 3] = s;
    // normal and direction to the eye in the axes of the camera
    const nx = v[0] * n[i] + v[4] * n[i + 1] + v[8] * n[i + 2];
    const ny = v[1] * n[i] + v[5] * n[i + 1] + v[9] * n[i + 2];
    const nz = v[2] * n[i] + v[6] * n[i + 1] + v[10] * n[i + 2];
    for (let side = 0; side < 2; ++side) {
      const colour = side === 0 ? front : back;
      const at = o + 4 + 3 * side;
      if (flat) {
        out[at] = 255 * colour[i];
        out[at + 1] = 255 * colour[i + 1];
        out[at + 2] = 255 * colour[i + 2];
        continue;
      }
      const sign = side === 0 ? 1 : -1;
      shade(colour[i], colour[i + 1], colour[i + 2], sign * nx, sign * ny, sign * nz, lit);
      out[at] = lit[0];
      out[at + 1] = lit[1];
      out[at + 2] = lit[2];
    }
    out[o + 10] = plane ? plane.normal[0] * x + plane.normal[1] * y + plane.normal[2] * z - plane.offset : -1;
  }
}

/** Scan conversion with barycentric increments along each row, between the sides of the triangle: chordae are slender. */
function fill(
  mesh: Mesh,
  v: Float32Array,
  width: number,
  height: number,
  pixels: Uint32Array,
  depth: Float32Array,
  cut: boolean,
): void {
  const { index, opacity } = mesh;
  const skipped = mesh.only === 'front' ? 7 : mesh.only === 'back' ? 4 : 0;
  for (let t = 0; t < index.length; t += 3) {
    const a = index[t] * stride,
      b = index[t + 1] * stride,
      c = index[t + 2] * stride;
    if (v[a + 3] === 0 || v[b + 3] === 0 || v[c + 3] === 0) continue;
    if (cut && v[a + 10] > 0 && v[b + 10] > 0 && v[c + 10] > 0) continue;
    const area = (v[b] - v[a]) * (v[c + 1] - v[a + 1]) - (v[c] - v[a]) * (v[b + 1] - v[a + 1]);
    if (area === 0) continue;
    // y points down: a triangle seen from its front has a negative area
    const side = area < 0 ? 4 : 7;
    if (side === skipped) continue;
    const x0 = Math.max(0, Math.ceil(Math.min(v[a], v[b], v[c]) - 0.5));
    const x1 = Math.min(width - 1, Math.floor(Math.max(v[a], v[b], v[c]) - 0.5));
    const y0 = Math.max(0, Math.ceil(Math.min(v[a + 1], v[b + 1], v[c + 1]) - 0.5));
    const y1 = Math.min(height - 1, Math.floor(Math.max(v[a + 1], v[b + 1], v[c + 1]) - 0.5));
    const s = 1 / area;
    const bx = (v[c + 1] - v[a + 1]) * s,
      by = -(v[c] - v[a]) * s;
    const cx = -(v[b + 1] - v[a + 1]) * s,
      cy = (v[b] - v[a]) * s;
    for (let y = y0; y <= y1; ++y) {
      // inside are u, w and 1 - u - w not negative: linear in x, each bounds the row from one side
      const u0 = (x0 + 0.5 - v[a]) * bx + (y + 0.5 - v[a + 1]) * by;
      const w0 = (x0 + 0.5 - v[a]) * cx + (y + 0.5 - v[a + 1]) * cy;
      let [first, last] = [0, x1 - x0];
      for (let edge = 0; edge < 3; ++edge) {
        const value = edge === 0 ? u0 : edge === 1 ? w0 : 1 - u0 - w0;
        const slope = edge === 0 ? bx : edge === 1 ? cx : -bx - cx;
        // a pixel to spare on either side, as roundings may differ from those of the test below
        if (slope > 0) first = Math.max(first, Math.floor(-value / slope) - 1);
        else if (slope < 0) last = Math.min(last, Math.ceil(-value / slope) + 1);
      }
      let u = u0 + first * bx;
      let w = w0 + first * cx;
      const end = x0 + last;
      for (let x = x0 + first, at = y * width + x; x <= end; ++x, ++at, u += bx, w += cx) {
        const q = 1 - u - w;
        if (u < -1e-6 || w < -1e-6 || q < -1e-6) continue;
        const z = q * v[a + 2] + u * v[b + 2] + w * v[c + 2];
        if (z >= depth[at] || z < -1) continue;
        if (cut && q * v[a + 10] + u * v[b + 10] + w * v[c + 10] > 0) continue;
        const red = q * v[a + side] + u * v[b + side] + w * v[c + side];
        const green = q * v[a + side + 1] + u * v[b + side + 1] + w * v[c + side + 1];
        const blue = q * v[a + side + 2] + u * v[b + side + 2] + w * v[c + side + 2];
        if (opacity < 1) {
          const old = pixels[at];
          const k = 1 - opacity;
          pixels[at] =
            (255 << 24) |
            ((blue * opacity + ((old >> 16) & 255) * k) << 16) |
            ((green * opacity + ((old >> 8) & 255) * k) << 8) |
            (red * opacity + (old & 255) * k);
        } else {
          depth[at] = z;
          pixels[at] = (255 << 24) | (blue << 16) | (green << 8) | red;
        }
      }
    }
  }
}
