// The goals of a valve of the tour with what is reached, in the panels "Learn" and "Repair" and in the form of an operation.
import { Check, CircleHelp, FolderOpen, X } from 'lucide-preact';
import { doubtOf } from '../store/doubt';
import { allowedLoad, leastCoaptation, leastOpening, openingOf } from '../store/limits';
import { percentOfLimit } from '../notable';
import { flailHeight, flailOf, reached } from '../store/goals';
import { startValve } from '../store/tour';
import * as state from '../store/state';
import { tipTexts, tourTexts } from '../text/texts';
import type { Shown } from '../protocol';
import { Button } from './parts';
import { chooseFile } from './toolbar';

interface Check {
  text: string;
  short: string;
  /** null: not known yet. */
  done: boolean | null;
  /** When it becomes known. */
  later?: string;
  /** Why it asks for so much. */
  help?: string;
}

function checks(number: number, shown: Shown | null): Check[] {
  const { goals, goalHelp, shortGoals } = tourTexts;
  const { sealed, chords, open, edge, coaptation } = reached(shown);
  const scallop = flailOf(number);
  // figures that do not count stand beside no goal
  const measures = shown && !doubtOf(shown.figures) ? shown.figures.measures : null;
  const load = percentOfLimit(measures?.chordLoad ?? NaN);
  return [
    { text: goals.sealed, short: shortGoals.sealed, done: sealed },
    ...(scallop
      ? [
          {
            text: goals.edge(scallop, measures && flailHeight(shown)),
            short: shortGoals.edge(scallop),
            done: edge,
          },
        ]
      : []),
    {
      text: goals.coaptation(leastCoaptation(), measures?.coaptationMean ?? NaN),
      short: shortGoals.coaptation,
      done: coaptation,
      help: goalHelp.coaptation,
    },
    {
      text: goals.chords(allowedLoad(), load),
      short: shortGoals.chords,
      done: chords,
      help: goalHelp.chords,
    },
    {
      text: goals.open(leastOpening(), measures ? openingOf(shown?.figures.hash)?.openArea : undefined),
      short: shortGoals.open,
      done: open,
      help: goalHelp.open,
      later: tourTexts.whenSealed,
    },
  ];
}

const sign = ({ done }: Check, size: number) =>
  done === null ? <CircleHelp size={size} /> : done ? <Check size={size} /> : <X size={size} />;

/** The tooltip; `whole`: with the goal itself, where a word stands for it. */
const hintOf = ({ text, help }: Check, whole?: boolean): string =>
  [whole && text, help].filter(Boolean).join('. ');

const classOf = ({ done }: Check): string => (done === null ? 'open' : done ? 'done' : 'missed');

/** In the foot of a form: the goals as the valve of its preview reaches them, in one line. */
export function GoalLine({ number }: { number: number }) {
  const name = `${tourTexts.goal(number)}, ${tourTexts.afterOperation}`;
  return (
    <ul class="goals line" aria-label={name} data-testid="goal-line">
      {checks(number, state.preview.value ?? state.main.value).map((check) => (
        <li class={classOf(check)} title={hintOf(check, true)}>
          {sign(check, 14)}
          <span>{check.short}</span>
          <span class="hidden">{tourTexts.judged(check.done)}</span>
        </li>
      ))}
    </ul>
  );
}

/** `short`: in few lines, without the heading. */
export function Goals({ number, short }: { number: number; short?: boolean }) {
  const found = checks(number, state.main.value);
  const count = state.finished.value.length;
  // in the order of the tour, and back to those that were passed over
  const valves = tourTexts.valves.map((_, k) => k + 1);
  const next = [...valves.slice(number), ...valves].find((k) => !state.finished.value.includes(k));
  return (
    <>
      {!short && <h3>{tourTexts.goal(number)}</h3>}
      <ul class={`goals${short ? ' short' : ''}`} aria-label={tourTexts.goal(number)} data-testid="goals">
        {found.map((check) => (
          <li class={classOf(check)}>
            {sign(check, 18)}
            <span title={hintOf(check, short)}>
              {short ? check.short : check.text}
              {!short && check.later && check.done === null && <small> {check.later}</small>}
            </span>
          </li>
        ))}
      </ul>
      {found.every((check) => check.done) && (
        <div class="won" role="status">
          <p>
            {tourTexts.won} {count > 0 && tourTexts.finishedOf(count)}
          </p>
          {next ? (
            <Button kind="main" title={tipTexts.next} onClick={() => void startValve(next)}>
              {tourTexts.next(next)}
            </Button>
          ) : (
            <>
              <p>{tourTexts.after}</p>
              <Button kind="main" icon={<FolderOpen size={16} />} onClick={chooseFile}>
                {tourTexts.own}
              </Button>
            </>
          )}
        </div>
      )}
    </>
  );
}
