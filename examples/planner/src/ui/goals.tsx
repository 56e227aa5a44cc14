// The goals of a valve of the tour with what is reached, in the panels "Learn" and "Repair".
import { Check, CircleHelp, X } from 'lucide-preact';
import { allowedLoad, leastCoaptation } from '../store/limits';
import { flailHeight, flailOf, reached, startValve } from '../store/tour';
import * as state from '../store/state';
import { tipTexts, tourTexts } from '../text/texts';
import { Button } from './parts';

interface Check {
  text: string;
  short: string;
  /** null: not known yet. */
  done: boolean | null;
  /** When it becomes known. */
  later?: string;
}

function checks(number: number): Check[] {
  const { goals, shortGoals } = tourTexts;
  const { sealed, chords, open, edge, coaptation } = reached();
  const scallop = flailOf(number);
  return [
    { text: goals.sealed, short: shortGoals.sealed, done: sealed },
    ...(scallop
      ? [{ text: goals.edge(scallop, flailHeight()), short: shortGoals.edge(scallop), done: edge }]
      : []),
    { text: goals.coaptation(leastCoaptation()), short: shortGoals.coaptation, done: coaptation },
    { text: goals.chords(allowedLoad()), short: shortGoals.chords, done: chords },
    { text: goals.open, short: shortGoals.open, done: open, later: tourTexts.whenSealed },
  ];
}

/** `short`: in one line, without the heading. */
export function Goals({ number, short }: { number: number; short?: boolean }) {
  const found = checks(number);
  const count = state.finished.value.length;
  // in the order of the tour, and back to those that were passed over
  const valves = tourTexts.valves.map((_, k) => k + 1);
  const next = [...valves.slice(number), ...valves].find((k) => !state.finished.value.includes(k));
  const icon = ({ done }: Check) =>
    done === null ? <CircleHelp size={18} /> : done ? <Check size={18} /> : <X size={18} />;
  return (
    <>
      {!short && <h3>{tourTexts.goal(number)}</h3>}
      <ul class={`goals${short ? ' short' : ''}`} aria-label={tourTexts.goal(number)} data-testid="goals">
        {found.map((check) => (
          <li class={check.done === null ? 'open' : check.done ? 'done' : 'missed'}>
            {icon(check)}
            <span title={short ? check.text : undefined}>
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
          {next && (
            <Button kind="main" title={tipTexts.next} onClick={() => void startValve(next)}>
              {tourTexts.next(next)}
            </Button>
          )}
        </div>
      )}
    </>
  );
}
