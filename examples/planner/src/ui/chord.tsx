// The card of a chosen chord, with its figures, also in a form that changes it.
import { percentOfLimit, shareOfLimit } from '../notable';
import { figure, kinds, repairTexts, verdictTexts } from '../text/texts';
import type { Chord } from '../protocol';

const facts: [string, (chord: Chord) => string, string][] = [
  [repairTexts.rest, (chord) => figure(chord.rest), 'mm'],
  [repairTexts.pull, (chord) => figure(chord.tension, 2), 'N'],
  [repairTexts.stretch, (chord) => (chord.strain > 0 ? figure(100 * chord.strain) : repairTexts.slack), '%'],
  [repairTexts.limit, (chord) => String(percentOfLimit(shareOfLimit(chord))), '%'],
];

/** `after`: the chord in the preview of a change; `brief`: in a form, which has no room for an explanation. */
export function ChordFacts({ chord, after, brief }: { chord: Chord; after?: Chord; brief?: boolean }) {
  const fact = (of: (chord: Chord) => string, unit: string) => {
    const [was, now] = [of(chord), of(after ?? chord)];
    const value = was === now ? was : repairTexts.becomes(was, now);
    return now === repairTexts.slack ? value : `${value}\u00a0${unit}`;
  };
  const { over } = after ?? chord;
  return (
    <>
      <h3>{repairTexts.chord(chord.name)}</h3>
      <p>{repairTexts.between(kinds[chord.kind], chord.heads, chord.scallops)}</p>
      <dl>
        {facts.map(([label, of, unit]) => (
          <>
            <dt>{label}</dt>
            <dd
              class={label === repairTexts.limit && over ? 'over' : undefined}
              title={label === repairTexts.limit ? verdictTexts.limitHelp : undefined}
            >
              {fact(of, unit)}
            </dd>
          </>
        ))}
      </dl>
      {over && !brief && <p class="beyond">{verdictTexts.limitHelp}</p>}
    </>
  );
}
