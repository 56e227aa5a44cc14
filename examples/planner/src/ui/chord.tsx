// The card of a chosen chord, with its figures, also in a form that changes it.
import { figure, kinds, repairTexts } from '../text/texts';
import type { Chord } from '../protocol';

/** The larger share of the working limit, of stretch or pull. */
export function shareOfLimit(chord: Chord): number {
  return Math.max(chord.strain / chord.strainLimit, chord.tension / chord.tensionLimit);
}

const facts: [string, (chord: Chord) => string, string][] = [
  [repairTexts.rest, (chord) => figure(chord.rest), 'mm'],
  [repairTexts.pull, (chord) => figure(chord.tension, 2), 'N'],
  [repairTexts.stretch, (chord) => (chord.strain > 0 ? figure(100 * chord.strain) : repairTexts.slack), '%'],
  [repairTexts.limit, (chord) => figure(100 * Math.max(0, shareOfLimit(chord)), 0), '%'],
];

/** `after`: the chord in the preview of a change. */
export function ChordFacts({ chord, after }: { chord: Chord; after?: Chord }) {
  const fact = (of: (chord: Chord) => string, unit: string) => {
    const [was, now] = [of(chord), of(after ?? chord)];
    const value = was === now ? was : repairTexts.becomes(was, now);
    return now === repairTexts.slack ? value : `${value}\u00a0${unit}`;
  };
  return (
    <>
      <h3>{repairTexts.chord(chord.name)}</h3>
      <p>{repairTexts.between(kinds[chord.kind], chord.heads, chord.scallops)}</p>
      <dl>
        {facts.map(([label, of, unit]) => (
          <>
            <dt>{label}</dt>
            <dd>{fact(of, unit)}</dd>
          </>
        ))}
      </dl>
    </>
  );
}
