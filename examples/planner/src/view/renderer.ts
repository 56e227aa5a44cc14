// The interface of both renderers.
import type { Camera } from './camera';
import type { Mesh } from './mesh';

/** A plane: points with normal . x > offset are cut away. */
export interface CutPlane {
  normal: [number, number, number];
  offset: number;
}

export interface Scene {
  meshes: Mesh[];
  background: [number, number, number];
  plane: CutPlane | null;
}

export interface Renderer {
  readonly canvas: HTMLCanvasElement;
  readonly name: 'webgl' | 'software';
  /** Size in CSS pixels, and device pixels per CSS pixel. */
  resize(width: number, height: number, ratio: number): void;
  /** Draws; `fast` lowers the resolution while something moves. */
  draw(scene: Scene, camera: Camera, fast: boolean): void;
  dispose(): void;
}
