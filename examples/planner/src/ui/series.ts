// A series of presses at one place is for the control under the first of them, not for one that has come into its place
// since: the list of operations lies under Apply, and a form under its card.

const control = (target: EventTarget | null): Element | null => {
  const element = target as Element | null;
  return (
    element?.closest?.('label') ?? element?.closest?.('button, a, summary, input, select') ?? element ?? null
  );
};

/** Controls that give way to others: operation cards and the buttons of a form. */
const givesWay = '[data-operation], .form button, .pending button';

/** ms after a press within which another one at its place belongs to the same series. Two clicks are a double click within 0.5 s; an
 *  impatient person, who takes the first one for lost, waits longer. */
const pause = 1000;
/** Pixels within which presses are at one place: a hand that goes on to something else moves farther. */
const reach = { mouse: 8, touch: 24 };

interface Series {
  control: Element | null;
  x: number;
  y: number;
  /** When its last press was. */
  at: number;
  gone: boolean;
}
let series: Series = { control: null, x: 0, y: 0, at: -Infinity, gone: false };

const isNear = (event: MouseEvent, pixels: number): boolean =>
  Math.hypot(event.clientX - series.x, event.clientY - series.y) <= pixels;

/** Whether a press goes on with the series, whose control may be gone. */
function goesOn(event: MouseEvent): boolean {
  if (event.detail > 1) return true;
  const late = event.timeStamp - series.at > pause;
  // only where the control makes room for another one a slow press is taken for one too many
  return series.gone && !late && isNear(event, reach.touch);
}

function onPress(event: MouseEvent): void {
  // keys and programs press buttons too, without a pointer
  if (event.type === 'click' && event.detail === 0) return;
  const on = control(event.target);
  if (goesOn(event) && on !== series.control) {
    series.at = event.timeStamp;
    event.preventDefault();
    event.stopPropagation();
    return;
  }
  const { clientX: x, clientY: y, timeStamp: at } = event;
  series = { control: on, x, y, at, gone: !!on?.matches(givesWay) };
}

/** A pointer that leaves the place of a series ends it. */
function onMove(event: PointerEvent): void {
  if (series.gone && event.pointerType !== 'touch' && !isNear(event, reach.mouse)) series.gone = false;
}

/** Watches presses on the page; returns what ends it. */
export function watchPresses(): () => void {
  const all: [string, (event: never) => void][] = [
    ['mousedown', onPress],
    ['click', onPress],
    ['pointermove', onMove],
  ];
  for (const [name, take] of all) window.addEventListener(name, take as EventListener, true);
  return () => {
    for (const [name, take] of all) window.removeEventListener(name, take as EventListener, true);
  };
}
