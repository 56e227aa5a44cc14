// The verdict on a valve with its reservations, the same in the card, the report, the comparison of plans and the status line: a
// valve that is sealed may open too little, or hang on chordae beyond their limit.
import { beyondLimit, mostBillowing, percentOfLimit, shareOfLimit } from '../notable';
import type { Figures } from '../protocol';
import { apart, doubtTexts, grade, headlineOf, isSevere, stenosis, verdictTexts, where } from '../text/texts';
import { doubtOf, type Doubt } from './doubt';
import { missedGoals } from './goals';
import { ofLeakRange } from './leak_range';
import { ofMiddle, otherLeaflets } from './names';
import {
  faultyLoad,
  foldedShare,
  isPlausible,
  leastCentralCoaptation,
  leastOpening,
  narrowing,
  openingOf,
  smallAnnulus,
  undersizedFrom,
} from './limits';

export interface Verdict {
  /** 0 sealed to 4; null where the figures are not final. */
  level: number | null;
  word: string;
  /** Faults beside the leak, the opening first. */
  but: string[];
  /** An operation may have narrowed the valve, and how far it opens is not known. */
  unmeasured: boolean;
  /** Something beside the leak is as bad as a severe one. */
  severe: boolean;
  /** The annulus is so small that the leaflets lie in folds: the word is no grade of the leak. */
  folded: boolean;
  /** Why its figures do not count: the word is no grade. */
  doubt: Doubt | null;
}

/** Whether an operation of the plan narrows the open valve. */
export const isNarrowed = ({ history }: Figures): boolean =>
  history.some(({ kind, undone }) => !undone && narrowing.has(kind));

/** How far the valve opens, if that is known and too little. */
function ofOpening({ hash }: Figures): string[] {
  const cost = openingOf(hash);
  if (!cost) return [];
  const word = stenosis(cost.openArea);
  const least = leastOpening();
  const goal = least !== null && cost.openArea < least ? least : null;
  if (word) return [verdictTexts.openingIs(cost.openArea, word, smallAnnulus() !== null, goal)];
  return goal === null ? [] : [verdictTexts.openingBelow(cost.openArea, goal)];
}

/** Whether the opening is a severe stenosis; the limits are those of adults. */
function opensTooLittle({ hash }: Figures): boolean {
  const cost = openingOf(hash);
  return !!cost && smallAnnulus() === null && isSevere(cost.openArea);
}

/** How wide and how deep the annulus is, where the plan has made it much too small. */
function ofAnnulus({ measures }: Figures): string[] {
  const small = (['annulusCc', 'annulusAp'] as const).flatMap((extent) => {
    const from = undersizedFrom(extent, measures[extent]);
    return from === null ? [] : [{ extent, now: measures[extent], from }];
  });
  return small.length ? [verdictTexts.undersized(small)] : [];
}

/** How little the middles of the leaflets of a sealed valve meet: a leak is said first. */
function ofCentre({ measures: { orifice, coaptationHeight } }: Figures): string[] {
  const least = leastCentralCoaptation();
  return orifice === 0 && coaptationHeight < least
    ? [ofMiddle(verdictTexts.centreMeets(apart(coaptationHeight, least)))]
    : [];
}

/** mm above the surface of the annulus. In the long-axis view of echocardiography 2 mm count as prolapse, above a line that lies
 *  higher by up to half the height of the saddle (libmvs/measure/DEFINITIONS.md), about 1 mm in the middle: a judgement. */
const billowing = 3;

/** How much a sealed valve billows, if that is much: a leak is said first. */
function ofBillow({ regions, measures, known }: Figures): string[] {
  if (known !== 'all' || measures.orifice > 0 || !(measures.billowHeight > billowing)) return [];
  const most = mostBillowing(regions);
  return most ? [verdictTexts.billows(most.name, measures.billowHeight)] : [];
}

/** Whether the load of a chord is a fault, which the verdict names. */
export const isOverloaded = ({ measures }: Figures): boolean =>
  percentOfLimit(measures.chordLoad) > faultyLoad();

/** Chordae beyond their limit, if the load of one of them is a fault. */
function ofChordae(figures: Figures): string[] {
  if (!isOverloaded(figures)) return [];
  const beyond = beyondLimit(figures.chords);
  const [most] = beyond;
  return [verdictTexts.chordsBeyond(beyond.length, percentOfLimit(shareOfLimit(most)), most.artificial)];
}

export function verdictOf(figures: Figures): Verdict {
  const { known, measures } = figures;
  const none = { level: null, but: [], unmeasured: false, folded: false, severe: false, doubt: null };
  if (known === 'shape') return { ...none, word: verdictTexts.measuring };
  const doubt = doubtOf(figures);
  if (doubt) return { ...none, word: doubtTexts.words[doubt], doubt };
  const share = foldedShare(measures.annulusCc);
  const { level, word } = grade(measures.orifice);
  return {
    level,
    word: share === null ? word : verdictTexts.noRepair,
    folded: share !== null,
    doubt,
    severe: share !== null || opensTooLittle(figures),
    but: [
      ...(share === null ? [] : [verdictTexts.folded(share)]),
      ...ofKind(figures),
      ...ofLeakRange(figures),
      ...ofOpening(figures),
      ...(share === null ? ofAnnulus(figures) : []),
      ...ofCentre(figures),
      ...ofBillow(figures),
      ...missedGoals(figures),
      ...ofChordae(figures),
    ],
    unmeasured: isNarrowed(figures) && !openingOf(figures.hash),
  };
}

/** What makes a valve no mitral valve of a patient: its size, or its leaflets. */
function ofKind({ measures: { annulusCc } }: Figures): string[] {
  const others = otherLeaflets.value;
  return [
    ...(isPlausible(annulusCc) ? [] : [verdictTexts.implausible(annulusCc)]),
    ...(others ? [verdictTexts.notMitral(others)] : []),
  ];
}

/** The verdict in one sentence, with the place of a leak. `lasting`: it is kept, and does not say what is still to be measured. */
export function headline(figures: Figures, lasting = false): string {
  const { level, word, but, unmeasured, folded, doubt } = verdictOf(figures);
  if (doubt) return `${word}: ${doubtTexts.short[doubt]}`;
  const unknown = unmeasured && !lasting ? [verdictTexts.openingUnknown] : [];
  if (folded) return `${word}: ${[...but, ...unknown].join('; ')}`;
  return headlineOf(word, level ? where(figures) : '', [...unknown, ...but]);
}

/** Names of the chordae that operations of the plan attached and that carry nothing; stitches of a clip do not count. */
export function attachedInVain(figures: Figures): string[] {
  if (doubtOf(figures) || !figures.measures.underLoad) return [];
  const slack = new Map(figures.chords.filter(({ strain }) => strain <= 0).map(({ id, name }) => [id, name]));
  return figures.history
    .filter(({ kind, undone }) => !undone && (kind === 'neochord' || kind === 'chord_add'))
    .flatMap(({ made }) => slack.get(made) ?? []);
}

/** Chordae far beyond their limit before that carry nothing any more, with their load before in per cent. */
export function relieved(before: Figures | null, now: Figures): { name: string; percent: number }[] {
  if (!before || before.hash === now.hash || doubtOf(before) || doubtOf(now)) return [];
  const slack = new Set(now.chords.filter(({ strain }) => strain <= 0).map(({ id }) => id));
  return beyondLimit(before.chords)
    .filter(({ id }) => slack.has(id))
    .map((chord) => ({ name: chord.name, percent: percentOfLimit(shareOfLimit(chord)) }))
    .filter(({ percent }) => percent > faultyLoad());
}
