// Parts of a valve's figures that are named one by one: chordae beyond their working limit, places of a leak, operations.
import type { Chord, Figures, OrificePart, Region } from './protocol';

/** The kind of the stitches of a suture or a clip. */
export const suture = 7;

/** The larger share of the working limit, of stretch or pull; 1 is the limit. */
export function shareOfLimit(chord: Chord): number {
  return Math.max(0, chord.strain / chord.strainLimit, chord.tension / chord.tensionLimit);
}

/** Value of a chord in a colour map: % of its limit, mN, % of its length without pull. */
export function chordValue(map: 'load' | 'pull' | 'strain', chord: Chord): number {
  if (map === 'load') return 100 * shareOfLimit(chord);
  return map === 'pull' ? 1000 * chord.tension : 100 * chord.strain;
}

/** The working limit of a chord in the same unit; infinite for stitches. */
export function chordLimit(map: 'pull' | 'strain', chord: Chord): number {
  return map === 'pull' ? 1000 * chord.tensionLimit : 100 * chord.strainLimit;
}

/** Kinds of chordae by their limit in a colour map, the limit of most chordae first; stitches have none. */
export function limitsOf(map: 'pull' | 'strain', chords: Chord[]): { limit: number; kinds: number[] }[] {
  const found = new Map<number, { count: number; kinds: Set<number> }>();
  for (const chord of chords) {
    const limit = chordLimit(map, chord);
    if (!Number.isFinite(limit)) continue;
    const one = found.get(limit) ?? { count: 0, kinds: new Set() };
    found.set(limit, one);
    ++one.count;
    one.kinds.add(chord.kind);
  }
  return [...found]
    .sort(([, a], [, b]) => b.count - a.count)
    .map(([limit, { kinds }]) => ({ limit, kinds: [...kinds].sort() }));
}

/** The share in whole per cent, as it is shown and judged; a share above the limit never reads 100. */
export function percentOfLimit(share: number): number {
  const percent = Math.round(100 * share);
  return share > 1 ? Math.max(101, percent) : percent;
}

/** Titles of the operations of a plan, in the library's words. */
export const titlesOf = ({ history }: Pick<Figures, 'history'>): string[] =>
  history.filter((entry) => !entry.undone).map((entry) => entry.title);

/** Per cent of the working limit from which a chord is far beyond it. No strength of chordae is known here: the limits are those of
 *  work (libmvs/measure/DEFINITIONS.md: “not rupture limits”). The limit of the pull is twice the working pull, so that a pull
 *  of this share is four times that of a healthy valve. */
export const farBeyond = 200;

/** Chordae beyond their limit, the most loaded first; segments of a branched chord have one name and count once. */
export function beyondLimit(chords: Chord[]): Chord[] {
  const named = new Map<string, Chord>();
  for (const chord of chords) {
    const other = named.get(chord.name);
    if (chord.over && (!other || shareOfLimit(chord) > shareOfLimit(other))) named.set(chord.name, chord);
  }
  return [...named.values()].sort((a, b) => shareOfLimit(b) - shareOfLimit(a));
}

/** mm2 below which a part of a leak is neither counted nor drawn with an arrow, unless it is the largest. */
const smallLeak = 1;

/** The parts of a leak that are counted and get an arrow. */
export function leakPlaces(parts: OrificePart[]): OrificePart[] {
  const largest = Math.max(0, ...parts.map((part) => part.area));
  return parts.filter((part) => part.area >= Math.min(smallLeak, largest));
}

/** The cut that a stitch closes, "P2 suture" of "P2 suture 3"; empty for stitches of a clip. */
export const cutOf = (name: string): string =>
  / suture(?= \d+$)/.test(name) ? name.replace(/ \d+$/, '') : '';

/** The clip that a stitch belongs to, which may have any name: its stitches are "clip", "clip/2", "clip/3"; empty for those of a cut. */
export const clipOf = (name: string): string => (cutOf(name) ? '' : name.replace(/\/\d+$/, ''));

/** The scallop whose leaflet stands highest above the annulus. */
export const mostBillowing = (regions: Region[]): Region | undefined =>
  regions.filter(({ commissure }) => !commissure).sort((a, b) => b.billow - a.billow)[0];
