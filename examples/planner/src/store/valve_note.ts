// What the page knows of a valve beside its OBJ file, in a comment at the end of that file, which the library and other programs skip: that
// its chordae are guessed. Opened again, such a valve keeps the reservation.
import type { Known } from './leak_range';

const begin = '# mvs-planner chordae=guessed';
const number = '(\\d+(?:\\.\\d+)?)';
const line = new RegExp(`^${begin} leak_range_mm2=${number},${number} of=(built|before)`, 'm');

/** Bytes at the end of a file in which the comment stands. */
const longest = 200;

/** The file with the note; as it is without one. */
export function withNote(bytes: Uint8Array, note: Known | null): Blob {
  if (!note) return new Blob([bytes.slice()]);
  const of = note.own ? 'built' : 'before';
  return new Blob([bytes.slice(), `${begin} leak_range_mm2=${note.range.join()} of=${of}\n`]);
}

/** The note in a file; null where it has none. */
export function noteIn(bytes: Uint8Array): Known | null {
  const found = line.exec(new TextDecoder().decode(bytes.subarray(-longest)));
  if (!found) return null;
  const [low, high] = [+found[1], +found[2]];
  return low <= high ? { range: [low, high], own: found[3] === 'built' } : null;
}
