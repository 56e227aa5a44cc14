// Small parts that all panels use.
import type { ComponentChildren, JSX } from 'preact';
import * as state from '../store/state';
import { figure, partTexts } from '../text/texts';

export function Figure(props: {
  label: string;
  value: number;
  unit: string;
  digits?: number;
  before?: number;
  good?: 'low' | 'high';
  help?: string;
  spread?: [number, number] | null;
  warn?: boolean;
}) {
  const digits = props.digits ?? 1;
  const waiting = Number.isNaN(props.value) && state.figures.value?.known !== 'all';
  const differs = props.before !== undefined && Math.abs(props.before - props.value) >= 0.5 * 10 ** -digits;
  const better = differs && props.good ? (props.good === 'low') === props.value < props.before! : null;
  return (
    <div class={`figure${props.warn ? ' warn' : ''}`} title={props.help}>
      <span class="figure-label">{props.label}</span>
      <span class="figure-value">
        {waiting ? '…' : figure(props.value, digits)} <small>{props.unit}</small>
      </span>
      {differs && (
        <span class={`figure-before ${better === null ? '' : better ? 'better' : 'worse'}`}>
          {partTexts.before(figure(props.before!, digits))}
        </span>
      )}
      {props.spread && props.spread[1] - props.spread[0] >= 0.5 * 10 ** -digits && (
        <span class="figure-before" title={partTexts.spreadHelp}>
          {partTexts.range(figure(props.spread[0], digits), figure(props.spread[1], digits))}
        </span>
      )}
    </div>
  );
}

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
  const hint = [title ?? label, keys ? `(${keys})` : ''].filter(Boolean).join(' ');
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

export function Section(props: { title: string; open?: boolean; children: ComponentChildren; id?: string }) {
  return (
    <details class="section" open={props.open} id={props.id}>
      <summary>{props.title}</summary>
      <div class="section-body">{props.children}</div>
    </details>
  );
}
