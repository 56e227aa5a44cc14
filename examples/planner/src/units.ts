// Units of length of files.
import type { FileUnit } from './protocol';

/** mm of each unit, in the order in which they are offered and guessed. */
export const millimetres: Record<FileUnit, number> = { mm: 1, cm: 10, m: 1000, inch: 25.4 };
export const fileUnits = Object.keys(millimetres) as FileUnit[];
