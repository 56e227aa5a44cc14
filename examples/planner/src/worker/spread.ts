// The spread of the figures over the closures of an ensemble: their ranges over the members at rest.
import { SYSTOLE_PA, type Ensemble, type Mvs, type Snapshot } from 'libmvs';
import type { Figures, Measures, Range, Spread } from '../protocol';
import { figuresOf } from './picture';
import { mm } from './units';

/** The figures of each closure that came to rest. */
function figuresOfMembers(mvs: Mvs, ensemble: Ensemble): Figures[] {
  return ensemble.members().flatMap(({ converged }, k) => {
    if (!converged) return [];
    const snapshot = ensemble.snapshot(k);
    try {
      return [figuresOf(mvs, snapshot)];
    } finally {
      snapshot.dispose();
    }
  });
}

const rangeOf = (values: number[]): Range => [Math.min(...values), Math.max(...values)];

/** Ranges by key: `rows` are the values of one closure by key; a key counts where every closure has a number. */
function rangesBy(rows: [string, number][][]): Record<string, Range> {
  const found = new Map<string, number[]>();
  for (const [key, value] of rows.flat())
    if (Number.isFinite(value)) found.set(key, [...(found.get(key) ?? []), value]);
  return Object.fromEntries(
    [...found]
      .filter(([, values]) => values.length === rows.length)
      .map(([key, values]) => [key, rangeOf(values)]),
  );
}

function regionRanges(all: Figures[]): Spread['regions'] {
  const names = all[0]?.regions.map(({ name }) => name) ?? [];
  return Object.fromEntries(
    names.map((name, k) => {
      const of = (field: 'coaptationMean' | 'orifice' | 'billow') =>
        rangeOf(all.map(({ regions }) => regions[k][field]));
      return [name, { coaptationMean: of('coaptationMean'), orifice: of('orifice'), billow: of('billow') }];
    }),
  );
}

function spreadOf(mvs: Mvs, ensemble: Ensemble): Omit<Spread, 'hash'> {
  const all = figuresOfMembers(mvs, ensemble);
  const { members, converged, equilibria, node_max } = ensemble.summary;
  const numbers = ({ measures }: Figures) =>
    Object.entries(measures).filter(
      (entry): entry is [keyof Measures, number] => typeof entry[1] === 'number',
    );
  return {
    members,
    converged,
    equilibria,
    nodeMax: node_max * mm,
    measures: rangesBy(all.map(numbers)),
    regions: regionRanges(all),
    chords: rangesBy(all.map(({ chords }) => chords.map(({ id, tension }) => [id, tension]))),
    heads: all[0]?.heads.map((_, h) => rangeOf(all.map(({ heads }) => heads[h]))) ?? [],
  };
}

/** The spread over several closures of a valve along different loading paths. */
export function closedOften(
  mvs: Mvs,
  snapshot: Snapshot,
  members: number,
  settle: Parameters<Snapshot['ensemble']>[2],
  report: (share: number) => void,
): Spread {
  const ensemble = snapshot.ensemble(
    { pressure: SYSTOLE_PA, boundary_fraction: 1 },
    { members, progress: (share: number) => (report(share), false) },
    settle,
  );
  try {
    return { hash: snapshot.hash, ...spreadOf(mvs, ensemble) };
  } finally {
    ensemble.dispose();
  }
}
