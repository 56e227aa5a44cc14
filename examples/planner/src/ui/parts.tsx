// Small parts that all panels use.
import type { ComponentChildren, JSX } from 'preact';
import { BookOpen } from 'lucide-preact';
import { beforeDoubt, doubtNotes, shownDoubt } from '../store/doubt';
import * as state from '../store/state';
import { doubtTexts, figure, figureHelp, partTexts, tips } from '../text/texts';
import type { Range } from '../protocol';

export function Figure(props: {
  label: string;
  value: number;
  unit: string;
  digits?: number;
  before?: number;
  good?: 'low' | 'high';
  help?: string;
  spread?: Range | null;
  warn?: boolean;
  /** A word beside the value. */
  note?: string;
}) {
  const digits = props.digits ?? 1;
  const waiting = Number.isNaN(props.value) && state.figures.value?.known !== 'all';
  const differs = props.before !== undefined && Math.abs(props.before - props.value) >= 0.5 * 10 ** -digits;
  // figures that do not count are no improvement
  const counts = !shownDoubt.value && !beforeDoubt.value;
  const better =
    differs && counts && props.good ? (props.good === 'low') === props.value < props.before! : null;
  return (
    <div
      class={`figure${props.warn ? ' warn' : ''}${shownDoubt.value ? ' doubtful' : ''}`}
      title={props.help}
    >
      <span class="figure-label">{props.label}</span>
      <span class="figure-value">
        {waiting ? '…' : figure(props.value, digits)} <small>{props.unit}</small>
        {shownDoubt.value && <small> {doubtTexts.mark}</small>}
        {props.note && <small class="figure-note"> {props.note}</small>}
      </span>
      {differs && (
        <span class={`figure-before ${better === null ? '' : better ? 'better' : 'worse'}`}>
          {partTexts.before(figure(props.before!, digits))}
          {beforeDoubt.value && ` ${doubtTexts.mark}`}
        </span>
      )}
      <Spread range={props.spread} digits={digits} />
    </div>
  );
}

/** What the mark of figures that do not count means, where the shown valve or the one before has it. */
export function DoubtNote() {
  const { figures, before } = state;
  const notes = doubtNotes([figures.value, before.value].filter((valve) => valve !== null));
  return notes.length ? (
    <p class="doubt-note" data-testid="doubt-note">
      {notes.join(' ')}
    </p>
  ) : null;
}

/** The range of a figure over the ways in which the leaflets can fold; nothing where its digits do not show it. `bare`: in a table,
 *  which says below what its ranges are. */
export function Spread(props: { range?: Range | null; digits: number; bare?: boolean }) {
  const { range, digits, bare } = props;
  if (!range || !(range[1] - range[0] >= 0.5 * 10 ** -digits)) return null;
  const closures = bare ? 0 : (state.shownSpread.value?.converged ?? 0);
  return (
    <span class="figure-before spread" title={partTexts.spreadHelp}>
      {partTexts.range(figure(range[0], digits), figure(range[1], digits), closures)}
    </span>
  );
}

/** A range in another unit. */
export const times = (range: Range | undefined, factor: number): Range | null =>
  range ? [factor * range[0], factor * range[1]] : null;

export function Button(
  props: {
    icon?: JSX.Element;
    children?: ComponentChildren;
    kind?: 'main' | 'plain' | 'quiet';
    keys?: string;
  } & Omit<JSX.HTMLAttributes<HTMLButtonElement>, 'icon'> & {
      disabled?: boolean;
      title?: string;
      onClick?: () => void;
      pressed?: boolean;
      label?: string;
    },
) {
  const { icon, children, kind = 'plain', keys, pressed, label, title, disabled, onClick } = props;
  const words = label ?? (typeof children === 'string' ? children : '');
  const hint = [title ?? tips[words] ?? label, keys ? `(${keys})` : ''].filter(Boolean).join(' ');
  return (
    <button
      type="button"
      class={`button ${kind}`}
      disabled={disabled}
      title={hint || undefined}
      aria-label={label}
      aria-pressed={pressed === undefined ? undefined : pressed}
      aria-keyshortcuts={keys}
      onClick={onClick}
    >
      {icon}
      {children !== undefined && <span>{children}</span>}
    </button>
  );
}

/** Opens the words on the figures. */
export function FigureHelpButton() {
  return (
    <Button icon={<BookOpen size={16} />} keys="F" onClick={() => (state.dialog.value = 'figures')}>
      {figureHelp.title}
    </Button>
  );
}

/** A part of a panel that is opened and closed. `name`: by which the page remembers that, where the title changes. */
export function Section(props: {
  title: string;
  open?: boolean;
  children: ComponentChildren;
  id?: string;
  tip?: string;
  name?: string;
}) {
  const name = props.name ?? props.title;
  const open = state.sections.value.get(name) ?? !!props.open;
  return (
    <details
      class="section"
      open={open}
      id={props.id}
      onToggle={({ currentTarget }) => {
        if (currentTarget.open !== open)
          state.sections.value = new Map(state.sections.value).set(name, currentTarget.open);
      }}
    >
      <summary title={props.tip ?? tips[props.title]}>{props.title}</summary>
      <div class="section-body">{props.children}</div>
    </details>
  );
}

/** What the left and the right end of a slider stand for, below it. */
export function SliderEnds({ ends }: { ends: readonly (string | number)[] }) {
  return (
    <span class="ends" aria-hidden="true">
      {ends.map((end) => (
        <i>{end}</i>
      ))}
    </span>
  );
}
