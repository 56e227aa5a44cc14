// Room above the foot of a form, which stays at the lower end of the panel and grows with what it says: the first field of a form
// that opens, and the field that has the focus, are wholly above it.
import type { RefObject } from 'preact';
import { useEffect, useRef } from 'preact/hooks';

/** What is kept in sight: the field with the focus, else the first one while the panel has not been scrolled. */
function fieldInSight(form: Element, panel: Element): Element | null {
  const { activeElement } = document;
  const focused = form.contains(activeElement) ? activeElement!.closest('.field') : null;
  return focused ?? (panel.scrollTop === 0 ? form.querySelector('.field') : null);
}

/** For the foot of a form. */
export function useRoomAboveFoot(): RefObject<HTMLDivElement> {
  const foot = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const [form, panel] = [foot.current?.closest('form'), foot.current?.closest('.panel')];
    if (!foot.current || !form || !panel) return;
    const size = new ResizeObserver(() => {
      const { position } = getComputedStyle(foot.current!);
      if (position !== 'sticky') return;
      document.documentElement.style.setProperty('--foot', `${foot.current!.offsetHeight}px`);
      // the next picture has the new padding
      fieldInSight(form, panel)?.scrollIntoView({ block: 'nearest' });
    });
    size.observe(foot.current);
    return () => {
      size.disconnect();
      document.documentElement.style.removeProperty('--foot');
    };
  }, []);
  return foot;
}
