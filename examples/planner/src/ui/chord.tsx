// What is known of a chord: the card of a chosen chord, also in a form that changes it.
import { figure, kinds, repairTexts } from '../text/texts';
import type { Chord } from '../protocol';

/** The larger share of the working limit, of stretch or pull. */
export function shareOfLimit(chord: Chord): number {
  return Math.max(chord.strain / chord.strainLimit, chord.tension / chord.tensionLimit);
}

const pullOf = (chord: Chord): string => `${figure(chord.tension, 2)} N`;
const stretchOf = (chord: Chord): string =>
  chord.strain <= 0 ? repairTexts.slack : repairTexts.ofLimit(chord.strain, shareOfLimit(chord));

/** `after`: the chord in the preview of a change. */
export function ChordFacts({ chord, after }: { chord: Chord; after?: Chord }) {
  const fact = (of: (chord: Chord) => string) => {
    const [was, now] = [of(chord), of(after ?? chord)];
    return was === now ? was : repairTexts.becomes(was, now);
  };
  return (
    <>
      <h3>{repairTexts.chord(chord.name)}</h3>
      <p>{repairTexts.between(kinds[chord.kind], chord.heads, chord.scallops)}</p>
      <dl>
        <dt>{repairTexts.rest}</dt>
        <dd>{figure(chord.rest)} mm</dd>
        <dt>{repairTexts.pull}</dt>
        <dd>{fact(pullOf)}</dd>
        <dt>{repairTexts.stretch}</dt>
        <dd>{fact(stretchOf)}</dd>
      </dl>
    </>
  );
}
