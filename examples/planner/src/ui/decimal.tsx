// The box of a decimal number. Browsers' own boxes for numbers drop a decimal comma, so that 8,5 becomes 85: this one reads it, and
// refuses what it cannot read, in a sentence.
import { useSignal } from '@preact/signals';
import { decimalOf } from '../decimal';
import { formTexts } from '../text/texts';

/** ms without a key after which a typed number is tried. */
const pause = 700;
let timer = 0;
/** Whether a number was typed that no Enter has taken yet, also where its preview came by itself. */
let typed = false;

interface DecimalProps {
  id: string;
  /** The number as it stands in the box. */
  text: string;
  placeholder?: string;
  title?: string;
  /** What an arrow key adds. */
  step?: number;
  range?: readonly [number, number];
  /** A number that was typed to its end is tried without Enter. */
  eager?: boolean;
  /** Receives the number, or undefined of an empty box. */
  onTake: (value: number | undefined) => void;
  /** Receives the sentence on a text that is no number; empty as soon as it is changed. */
  onRefuse: (sentence: string) => void;
}

export function DecimalBox(props: DecimalProps) {
  const { text, step = 1, range, onTake, onRefuse } = props;
  // what is typed stays in the box while the page is drawn anew
  const typing = useSignal<string | null>(null);
  const take = (box: HTMLInputElement) => {
    const value = decimalOf(box.value);
    typing.value = null;
    if (value === null) {
      onRefuse(formTexts.noNumber(box.value, text));
      box.value = text;
      return;
    }
    // as it was read
    if (value !== undefined) box.value = String(value);
    onTake(value);
  };
  const onKeyDown = (event: KeyboardEvent & { currentTarget: HTMLInputElement }) => {
    const { key, currentTarget: box } = event;
    const way = { ArrowUp: 1, ArrowDown: -1 }[key];
    if (way) {
      event.preventDefault();
      const from = decimalOf(box.value || (props.placeholder ?? '')) ?? 0;
      const to = +(from + way * step).toPrecision(12);
      box.value = String(range ? Math.min(range[1], Math.max(range[0], to)) : to);
      return take(box);
    }
    // Enter takes a number that was typed; once more, with its preview in sight, it applies
    if (key !== 'Enter' || (!typed && box.value === text)) return;
    event.preventDefault();
    typed = false;
    if (box.value !== text) take(box);
  };
  return (
    <input
      id={props.id}
      class="decimal"
      type="text"
      inputMode="decimal"
      autocomplete="off"
      role="spinbutton"
      aria-valuenow={decimalOf(text) ?? undefined}
      aria-valuemin={range?.[0]}
      aria-valuemax={range?.[1]}
      title={props.title}
      value={typing.value ?? text}
      placeholder={props.placeholder}
      onInput={({ currentTarget: box }) => {
        // "19." goes on
        const now = box.value;
        typed = true;
        typing.value = now;
        onRefuse('');
        window.clearTimeout(timer);
        if (!props.eager || now === text || String(decimalOf(now)) !== now.replace(',', '.')) return;
        timer = window.setTimeout(() => box.isConnected && box.value === now && take(box), pause);
      }}
      onChange={({ currentTarget: box }) => box.value !== text && take(box)}
      onKeyDown={onKeyDown}
      onBlur={() => {
        typed = false;
        typing.value = null;
      }}
    />
  );
}
