// Surfaces and landmarks of other programs, read from bytes.
import type { ArrayView, TypedArray } from "./arrays.js";
import { refuse } from "./error.js";
import type { LengthUnit, PatientFrame, SurfacePlace } from "./generated/enums.js";
import type { SurfaceFileOptions } from "./generated/structs.js";
import { toBytes } from "./heap.js";
import type { Mvs } from "./library.js";

export interface Surface {
  format: string;
  frame: PatientFrame;
  file_frame: PatientFrame;
  unit: LengthUnit;
  /** m, rows of three. */
  points: Float64Array;
  /** Rows of three; empty for landmarks and curves. */
  triangles: Uint32Array;
  arrays: { place: SurfacePlace; name: string; components: number; values: Float64Array }[];
  /** Names of points: none, or one for each. */
  names: string[];
}

/**
 * Reads the bytes of a file; the ending of its name selects the format. The arrays of the result are
 * copies. The sentence of a failure begins with the name.
 */
export function readSurface(mvs: Mvs, data: Uint8Array | string, name: string, options?: SurfaceFileOptions): Surface {
  const { c } = mvs;
  // the file system of the module is in memory; its present folder is empty (Mvs)
  const path = name.replace(/^.*[\\/]/, "");
  if (/^\.*$/.test(path) || path.includes("\0")) refuse("name", `${JSON.stringify(name)} is no name of a file`);
  c.module.FS.writeFile(path, toBytes(data, "data"));
  let file: number;
  try {
    file = c.mvs_surface_file_open(path, options);
  } finally {
    c.module.FS.unlink(path);
  }
  try {
    const info = c.mvs_surface_file_get_info(file);
    const copy = <T extends TypedArray>(view: ArrayView): T => view.copy() as T;
    return {
      format: info.format,
      frame: info.frame,
      file_frame: info.file_frame,
      unit: info.unit,
      points: copy<Float64Array>(info.points),
      triangles: info.triangles.count > 0 ? copy<Uint32Array>(info.triangles) : new Uint32Array(0),
      arrays: Array.from({ length: c.mvs_surface_file_get_array_count(file) }, (_, k) => {
        const { place, name: title, values } = c.mvs_surface_file_get_array(file, k);
        return { place, name: title, components: values.components, values: copy<Float64Array>(values) };
      }),
      names: Array.from({ length: c.mvs_surface_file_get_name_count(file) }, (_, k) => c.mvs_surface_file_get_name(file, k)),
    };
  } finally {
    c.mvs_surface_file_release(file);
  }
}
