// Room above the foot of a form, which stays at the lower end of the panel and grows with its text: the first field of a form
// that opens, and the field that has the focus, are wholly above it.
import type { RefObject } from 'preact';
import { useEffect, useRef } from 'preact/hooks';

/** The field with the focus in a form. */
function fieldWithFocus(form: Element): Element | null {
  const { activeElement } = document;
  return form.contains(activeElement) ? activeElement!.closest('.field') : null;
}

/** For the foot of a form. */
export function useRoomAboveFoot(): RefObject<HTMLDivElement> {
  const foot = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const form = foot.current?.closest('form');
    if (!foot.current || !form) return;
    let opens = true;
    const size = new ResizeObserver(() => {
      const { position } = getComputedStyle(foot.current!);
      if (position !== 'sticky') return;
      document.documentElement.style.setProperty('--foot', `${foot.current!.offsetHeight}px`);
      const first = opens ? form.querySelector('.field') : null;
      opens = false;
      (fieldWithFocus(form) ?? first)?.scrollIntoView({ block: 'nearest' });
    });
    size.observe(foot.current);
    return () => {
      size.disconnect();
      document.documentElement.style.removeProperty('--foot');
    };
  }, []);
  return foot;
}
