// Units of the page and of the library: mm, mm2, MPa, degrees, % outside; SI inside.
export const mm = 1e3;
export const mm2 = 1e6;
export const ml = 1e6;
export const mmHg = 133.322;

/** Factor from SI to the unit of the page, and the name of that unit. */
export function pageUnit(unit: string): { factor: number; unit: string } {
  if (unit === 'm') return { factor: 1e3, unit: 'mm' };
  if (unit === 'm2') return { factor: 1e6, unit: 'mm²' };
  if (unit === 'rad') return { factor: 180 / Math.PI, unit: '°' };
  if (unit === 'Pa') return { factor: 1e-6, unit: 'MPa' };
  return { factor: 1, unit };
}

/** An array times a factor, as floats. */
export function scaled(values: ArrayLike<number>, factor: number): Float32Array {
  const out = new Float32Array(values.length);
  for (let i = 0; i < values.length; ++i) out[i] = values[i] * factor;
  return out;
}
