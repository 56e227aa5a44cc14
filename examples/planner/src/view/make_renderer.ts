// The renderer of a browser: WebGL, or the rasteriser where that is slow, missing or not wanted.
import { Raster } from './raster';
import type { Renderer } from './renderer';
import { WebGl } from './webgl';

/** `lost` and `restored`: called when the browser takes the context of WebGL away, and gives it back. */
export function makeRenderer(
  wanted: 'webgl' | 'software' | '',
  lost: () => void,
  restored: () => void,
): Renderer {
  if (wanted === 'software') return new Raster();
  try {
    // a browser without WebGL, or one that emulates it more slowly than the rasteriser; it is asked without an
    // exception, for whose place the whole script would be parsed once more
    return WebGl.make(wanted === 'webgl', lost, restored) ?? new Raster();
  } catch {
    return new Raster();
  }
}
