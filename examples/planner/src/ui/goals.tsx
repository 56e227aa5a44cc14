// The goals of a valve of the tour with what is reached, in the panels "Learn" and "Repair".
import { Check, CircleHelp, X } from 'lucide-preact';
import { startValve } from '../store/tour';
import * as state from '../store/state';
import { tourTexts } from '../text/texts';
import { Button } from './parts';

interface Check {
  text: string;
  short: string;
  /** null: not known yet. */
  done: boolean | null;
}

/** Goals are judged on the applied valve, not on a preview. */
function checks(): Check[] {
  const { founding } = state.tour.value!;
  const { hash, measures } = state.main.value!.figures;
  const cost = state.cost.value?.hash === hash ? state.cost.value.value : null;
  const healthyOver = founding?.healthy.measures.chordsOver;
  return [
    {
      text: tourTexts.goals.sealed,
      short: tourTexts.shortGoals.sealed,
      done: measures.atRest && measures.orifice === 0,
    },
    {
      text: tourTexts.goals.chords(healthyOver),
      short: tourTexts.shortGoals.chords,
      done: healthyOver === undefined ? null : measures.chordsOver <= healthyOver,
    },
    {
      text: tourTexts.goals.open,
      short: tourTexts.shortGoals.open,
      done: cost && founding ? cost.openArea >= 0.9 * founding.healthy.openArea : null,
    },
  ];
}

/** Goes on with the next valve; the plan that has reached the goals needs no way back. */
function next(number: number): void {
  state.changed.value = false;
  void startValve(number + 1);
}

/** `short`: in one line, without the heading. */
export function Goals({ number, short }: { number: number; short?: boolean }) {
  const found = checks();
  const icon = ({ done }: Check) =>
    done === null ? <CircleHelp size={18} /> : done ? <Check size={18} /> : <X size={18} />;
  return (
    <>
      {!short && <h3>{tourTexts.goal(number)}</h3>}
      <ul class={`goals${short ? ' short' : ''}`} aria-label={tourTexts.goal(number)} data-testid="goals">
        {found.map((check) => (
          <li class={check.done === null ? 'open' : check.done ? 'done' : 'missed'}>
            {icon(check)}
            <span title={short ? check.text : undefined}>{short ? check.short : check.text}</span>
          </li>
        ))}
      </ul>
      {found.every((check) => check.done) && (
        <p class="won" role="status">
          {tourTexts.won}
          {number < 3 && (
            <>
              {' '}
              <Button kind="main" onClick={() => next(number)}>
                {tourTexts.next}
              </Button>
            </>
          )}
        </p>
      )}
    </>
  );
}
