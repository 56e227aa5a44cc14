// The wheel over a number with the focus: browsers change the number, and a length of a plan would change unseen. Here the number is
// read-only while the browser looks at the wheel, which then scrolls the form. To prevent the default of the event would not do: once
// a scroll has begun the events cannot be cancelled any more, and would stop it.

function onWheel({ target }: WheelEvent): void {
  if (!(target instanceof HTMLInputElement) || target.type !== 'number' || target.readOnly) return;
  target.readOnly = true;
  setTimeout(() => (target.readOnly = false));
}

/** Keeps the wheel from numbers; returns what ends it. */
export function watchWheel(): () => void {
  window.addEventListener('wheel', onWheel, { capture: true, passive: true });
  return () => window.removeEventListener('wheel', onWheel, { capture: true });
}
