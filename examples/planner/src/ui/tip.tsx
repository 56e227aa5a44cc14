// The tooltip of the control to which the keyboard goes: the browser shows titles to a mouse only.
import { useEffect, useLayoutEffect, useRef } from 'preact/hooks';
import { signal } from '@preact/signals';

/** The control whose tooltip is shown. */
const shown = signal<HTMLElement | null>(null);
/** Whether the last action was a key that moves from control to control: a press, and a key of the page, needs no tooltip. */
let byKeys = false;

/** The words of a control: its own, those of its field, or its description. */
function wordsOf(control: HTMLElement): string {
  const titled = control.closest<HTMLElement>('[title]:not([title=""])')?.title;
  return titled ?? document.getElementById(control.getAttribute('aria-describedby') ?? '')?.textContent ?? '';
}

function onFocus(event: FocusEvent): void {
  const control = event.target instanceof HTMLElement ? event.target : null;
  shown.value = byKeys && control && wordsOf(control) ? control : null;
}

function onKey(event: KeyboardEvent): void {
  byKeys = event.key === 'Tab' || event.key.startsWith('Arrow');
  if (event.key !== 'Tab') shown.value = null;
}

function onPress(): void {
  byKeys = false;
  shown.value = null;
}

const hide = (): void => void (shown.value = null);

/** px between a control and its tooltip. */
const gap = 6;

/** Puts a box beside the panel of a control, where it covers nothing of it; else below the control, or above it where there is no
 *  room, within the window. */
function put(box: HTMLElement, control: HTMLElement): void {
  const [of, own] = [control.getBoundingClientRect(), box.getBoundingClientRect()];
  const panel = control.closest('.side')?.getBoundingClientRect();
  if (panel && panel.left >= own.width + 2 * gap) {
    const top = Math.max(gap, Math.min(of.top, innerHeight - own.height - gap));
    box.style.transform = `translate(${panel.left - own.width - gap}px, ${top}px)`;
    return;
  }
  const below = of.bottom + gap + own.height <= innerHeight;
  const left = Math.max(gap, Math.min(of.left, innerWidth - own.width - gap));
  const top = below ? of.bottom + gap : Math.max(gap, of.top - gap - own.height);
  box.style.transform = `translate(${left}px, ${top}px)`;
}

export function Tip() {
  const box = useRef<HTMLDivElement>(null);
  // the browser scrolls to the control after it has got the focus
  const follow = () => box.current && shown.value && put(box.current, shown.value);
  useEffect(() => {
    window.addEventListener('focusin', onFocus);
    window.addEventListener('focusout', hide);
    window.addEventListener('keydown', onKey, true);
    window.addEventListener('pointerdown', onPress, true);
    window.addEventListener('resize', follow);
    document.addEventListener('scroll', follow, true);
    return () => {
      window.removeEventListener('focusin', onFocus);
      window.removeEventListener('focusout', hide);
      window.removeEventListener('keydown', onKey, true);
      window.removeEventListener('pointerdown', onPress, true);
      window.removeEventListener('resize', follow);
      document.removeEventListener('scroll', follow, true);
    };
  }, []);
  const control = shown.value;
  useLayoutEffect(() => {
    if (!box.current || !control) return;
    // above an open dialog, where the browser can
    box.current.showPopover?.();
    put(box.current, control);
    return () => box.current?.hidePopover?.();
  }, [control]);
  // screen readers know the title of the control itself
  return (
    <div class="tip" ref={box} popover="manual" hidden={!control} aria-hidden="true" data-testid="tip">
      {control && wordsOf(control)}
    </div>
  );
}
