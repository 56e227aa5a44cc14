// Valves that were left, which can be opened again, and the present valve as the one before the repair.
import { Flag, RotateCcw } from 'lucide-preact';
import { doubtOf } from '../store/doubt';
import { beginHere, comeBack } from '../store/files';
import { leftValves, repairOf, type Left } from '../store/left';
import * as state from '../store/state';
import { leaveTexts, startTexts } from '../text/texts';
import { Button, Section } from './parts';

function Row({ left, title }: { left: Left; title: string }) {
  return (
    <div class="row earlier-valve">
      <span>
        {title} <small>{leaveTexts.contents(left.verdict, left.steps, left.kept, left.at)}</small>
      </span>
      <Button icon={<RotateCcw size={16} />} title={leaveTexts.againTip} onClick={() => void comeBack(left)}>
        {leaveTexts.again}
      </Button>
    </div>
  );
}

/** In the panel "Plan": all valves that were left, the newest first. */
export function EarlierValves() {
  const all = leftValves.value;
  if (!all.length) return null;
  return (
    <Section title={leaveTexts.heading(all.length)} name="earlier valves" tip={leaveTexts.headingTip} open>
      <div data-testid="earlier-valves">
        {all.map((left) => (
          <Row key={left.content} left={left} title={left.title} />
        ))}
      </div>
      <p class="hint">{leaveTexts.hint}</p>
    </Section>
  );
}

/** On a valve of the tour: its repair that was left. */
export function OwnRepair({ number }: { number: number }) {
  const left = repairOf(number);
  return left ? (
    <div data-testid="own-repair">
      <Row left={left} title={leaveTexts.own} />
    </div>
  ) : null;
}

/** The button that makes the present valve the one before the repair. */
export function BeginHere() {
  return state.canUndo.value ? (
    <div class="row begin-here">
      <Button icon={<Flag size={16} />} title={startTexts.tip} onClick={() => void beginHere()}>
        {startTexts.begin}
      </Button>
    </div>
  ) : null;
}

/** The same beside the operations, after one that made a sealed valve leak. */
export function MadeLeak() {
  const [first, main] = [state.first.value?.figures, state.main.value?.figures];
  const made =
    first?.measures.orifice === 0 &&
    main?.known === 'all' &&
    main.measures.orifice > 0 &&
    !doubtOf(main) &&
    !state.tour.value;
  return made ? (
    <div data-testid="made-leak">
      <p class="hint">{startTexts.leaks}</p>
      <BeginHere />
    </div>
  ) : null;
}
