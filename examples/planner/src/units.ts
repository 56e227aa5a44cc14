// Units of length of files, and numbers that the page and its worker share.
import type { FileUnit } from './protocol';

/** mm of each unit, in the order in which they are offered and guessed. */
export const millimetres: Record<FileUnit, number> = { mm: 1, cm: 10, m: 1000, inch: 25.4 };
export const fileUnits = Object.keys(millimetres) as FileUnit[];

/** ml/s through an open valve, in the mean while the ventricle fills: from far below that of an infant to twice that of an adult under
 *  great strain. */
export const flowRange = [10, 1000] as const;
export const isFlow = (flow: number): boolean => flow >= flowRange[0] && flow <= flowRange[1];

/** mm: thicknesses of leaflets that the library takes, and that which it takes where none is given. */
export const thicknessRange = [0.1, 5] as const;
export const usualThickness = 0.8;
export const isThickness = (mm: number): boolean => mm >= thicknessRange[0] && mm <= thicknessRange[1];

/** N: forces of a valve at rest are smaller; one that is not at rest with such forces leaves its shape again. */
export const restResidual = 1e-4;
