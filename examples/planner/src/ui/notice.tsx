// Notices over the picture: an event of the plan or of a file, the offer to recover a session.
import type { ComponentChildren } from 'preact';
import { useEffect, useLayoutEffect, useRef } from 'preact/hooks';
import { fail } from '../store/requests';
import { forgetCopy, recover, recoverable } from '../store/recovery';
import * as state from '../store/state';
import { appTexts, dialogTexts } from '../text/texts';
import { Button } from './parts';

function overlap(a: DOMRect, b: DOMRect): boolean {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

/** Whether a box over the page covers the control that has the focus. What fills half of the window cannot be avoided. */
function coversFocus(box: HTMLElement): boolean {
  const { activeElement } = document;
  if (!activeElement || activeElement === document.body || box.contains(activeElement)) return false;
  const control = activeElement.getBoundingClientRect();
  return control.height < innerHeight / 2 && overlap(control, box.getBoundingClientRect());
}

/** Lets what stands at the top of the picture, the keys of its colours, begin below the notices. */
function makeRoom(box: HTMLElement): void {
  const stage = document.querySelector<HTMLElement>('.stage');
  if (!stage) return;
  const [at, of] = [box.getBoundingClientRect(), stage.getBoundingClientRect()];
  const above = at.height > 0 && at.top < of.top + of.height / 2;
  stage.style.setProperty('--notices', above ? `${Math.max(0, at.bottom - of.top)}px` : '0px');
}

/** Notices at the top of the picture, or, where they would cover the control that has the focus, further down. */
export function Notices() {
  const box = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    const makeWay = () => {
      if (!box.current) return;
      const { classList } = box.current;
      classList.remove('low');
      classList.toggle('low', coversFocus(box.current));
      if (coversFocus(box.current)) classList.remove('low');
      makeRoom(box.current);
    };
    // the browser scrolls to the control after it has got the focus
    const later = () => requestAnimationFrame(makeWay);
    const size = new ResizeObserver(makeWay);
    size.observe(box.current!);
    makeWay();
    window.addEventListener('focusin', later);
    window.addEventListener('resize', later);
    document.addEventListener('scroll', later, true);
    return () => {
      size.disconnect();
      window.removeEventListener('focusin', later);
      window.removeEventListener('resize', later);
      document.removeEventListener('scroll', later, true);
    };
  }, []);
  return (
    <div ref={box} class="notices">
      <Notice />
      <Recovery />
    </div>
  );
}

function Floating(props: {
  kind: string;
  role: 'alert' | 'status';
  id: string;
  children: ComponentChildren;
}) {
  return (
    <div class={`notice ${props.kind}`} role={props.role} data-testid={props.id}>
      {props.children}
    </div>
  );
}

function Notice() {
  const notice = state.notice.value;
  useEffect(() => {
    if (notice?.kind !== 'info') return;
    const timer = setTimeout(() => (state.notice.value = null), notice.action ? 30_000 : 8000);
    return () => clearTimeout(timer);
  }, [notice]);
  if (!notice) return null;
  return (
    <Floating kind={notice.kind} role={notice.kind === 'info' ? 'status' : 'alert'} id="notice">
      <span>{notice.text}</span>
      {notice.action && (
        <Button kind="main" onClick={() => ((state.notice.value = null), notice.action!.run())}>
          {notice.action.text}
        </Button>
      )}
      <Button kind="quiet" onClick={() => (state.notice.value = null)}>
        {appTexts.close}
      </Button>
    </Floating>
  );
}

function Recovery() {
  const [kept] = recoverable.value;
  if (!kept || !state.ready.value) return null;
  return (
    <Floating kind="info" role="status" id="recovery">
      <span>{dialogTexts.left(kept.title, new Date(kept.saved).toLocaleString(), kept.surface)}</span>
      <Button kind="main" onClick={() => void recover().catch(fail)}>
        {dialogTexts.recover}
      </Button>
      <Button onClick={() => void forgetCopy().catch(fail)}>{dialogTexts.forget}</Button>
    </Floating>
  );
}
