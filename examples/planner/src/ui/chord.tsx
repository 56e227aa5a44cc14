// The card of a chosen chord, with its figures, also in a form that changes it.
import { chordLimit, chordValue, percentOfLimit, shareOfLimit } from '../notable';
import { figure, kindOf, repairTexts, verdictTexts } from '../text/texts';
import type { Chord } from '../protocol';

/** The limit of a chord beside its value; a suture has none. */
const limitIn = (limit: number, unit: string, digits: number): string =>
  Number.isFinite(limit) ? repairTexts.limitIn(`${figure(limit, digits)}\u00a0${unit}`) : '';

/** Name, value, unit and limit. */
const facts: [string, (chord: Chord) => string, string, ((chord: Chord) => string)?][] = [
  [repairTexts.rest, (chord) => figure(chord.rest), 'mm'],
  [
    repairTexts.pull,
    (chord) => figure(chordValue('pull', chord), 0),
    'mN',
    (chord) => limitIn(chordLimit('pull', chord), 'mN', 0),
  ],
  [
    repairTexts.stretch,
    (chord) => (chord.strain > 0 ? figure(chordValue('strain', chord)) : repairTexts.slack),
    '%',
    (chord) => limitIn(chordLimit('strain', chord), '%', 1),
  ],
  [
    repairTexts.limit,
    (chord) => String(percentOfLimit(shareOfLimit(chord))),
    '%',
    (chord) => repairTexts.far(percentOfLimit(shareOfLimit(chord)), chord.artificial),
  ],
];

/** The facts that a form has room for; the share says whether pull or stretch is beyond its limit. */
const briefFacts = facts.filter(([label]) => label === repairTexts.rest || label === repairTexts.limit);

/** `after`: the chord in the preview of a change; `brief`: in a form, whose fields stay in sight below. */
export function ChordFacts({ chord, after, brief }: { chord: Chord; after?: Chord; brief?: boolean }) {
  const fact = (of: (chord: Chord) => string, unit: string) => {
    const [was, now] = [of(chord), of(after ?? chord)];
    const value = was === now ? was : repairTexts.becomes(was, now);
    return now === repairTexts.slack ? value : `${value}\u00a0${unit}`;
  };
  const { over, artificial } = after ?? chord;
  const help = artificial ? verdictTexts.artificialHelp : verdictTexts.limitHelp;
  return (
    <>
      <h3>{repairTexts.chord(chord.name)}</h3>
      <p>{repairTexts.between(kindOf(chord), chord.heads, chord.scallops)}</p>
      <dl>
        {(brief ? briefFacts : facts).map(([label, of, unit, limit]) => (
          <>
            <dt>{artificial && label === repairTexts.limit ? repairTexts.nativeLimit : label}</dt>
            <dd
              class={label === repairTexts.limit && over ? 'over' : undefined}
              title={label === repairTexts.limit ? help : undefined}
            >
              {fact(of, unit)} {limit && !brief && <small>{limit(after ?? chord)}</small>}
            </dd>
          </>
        ))}
      </dl>
      {over && !brief && <p class="beyond">{help}</p>}
    </>
  );
}
