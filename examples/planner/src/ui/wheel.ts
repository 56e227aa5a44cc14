// The wheel over a number with the focus: browsers change the number, and a length of a plan would change unseen. Here it scrolls
// what the number stands in, as everywhere else.

/** Pixels of a line, and of a page, in which some mice count. */
const line = 16;
const pageShare = 0.9;

function scrollerOf(element: Element): Element {
  for (let at = element.parentElement; at; at = at.parentElement) {
    const scrolls = /auto|scroll/.test(getComputedStyle(at).overflowY);
    if (scrolls && at.scrollHeight > at.clientHeight) return at;
  }
  return document.scrollingElement ?? document.documentElement;
}

function onWheel(event: WheelEvent): void {
  const { target } = event;
  // with Control the browser zooms
  if (event.ctrlKey || !(target instanceof HTMLInputElement) || target.type !== 'number') return;
  event.preventDefault();
  const scroller = scrollerOf(target);
  const unit = [1, line, pageShare * scroller.clientHeight][event.deltaMode];
  scroller.scrollBy(unit * event.deltaX, unit * event.deltaY);
}

/** Keeps the wheel from numbers; returns what ends it. */
export function watchWheel(): () => void {
  window.addEventListener('wheel', onWheel, { capture: true, passive: false });
  return () => window.removeEventListener('wheel', onWheel, { capture: true });
}
