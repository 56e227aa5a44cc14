// The page: bar, picture, panels, dialogs.
import { useEffect, useLayoutEffect, useRef } from 'preact/hooks';
import { apply, discard, edit } from '../store/edit';
import { openFile } from '../store/files';
import { leftValves } from '../store/left';
import { planName } from '../store/plans';
import * as state from '../store/state';
import { appTexts, barTexts, help, t, tips, tipTexts } from '../text/texts';
import type { Preset } from '../view/camera';
import { Viewport } from '../view/viewport';
import { Dialogs } from './dialogs';
import { Notices } from './notice';
import { Button } from './parts';
import { ImportPanel } from './import';
import { onKey, showPanel, tabs } from './keys';
import { PlanPanel } from './plan';
import { RepairPanel } from './repair';
import { Scale } from './scale';
import { watchPresses } from './series';
import { Tip } from './tip';
import { TopBar, ViewBar } from './toolbar';
import { TourPanel } from './tour';
import { ValvePanel } from './valve';
import { Verdict } from './verdict';

let viewport: Viewport | null = null;
export const view = (): Viewport | null => viewport;
/** Turns the picture to a view: that of the section is cut, the others show the whole valve. */
function go(preset: Preset): void {
  state.sectionOn.value = preset === 'section';
  viewport?.go(preset);
}

function Panels() {
  const panel = state.panel.value;
  const body = useRef<HTMLDivElement>(null);
  // another panel, form or valve of the tour begins at its top
  const form = state.draft.value?.kind;
  const valve = state.tour.value?.number;
  const findings = state.imported.value?.findings;
  useEffect(() => body.current?.scrollTo(0, 0), [panel, form, valve, findings]);
  const steps = (by: number) => {
    const all = tabs();
    const k = all.findIndex(([name]) => name === panel);
    showPanel(all[(k + by + all.length) % all.length][0]);
  };
  return (
    <aside class="side">
      <Verdict />
      {state.draft.value && panel !== 'repair' && (
        <div class="pending" role="status">
          <span>{appTexts.notApplied}</span>
          <Button kind="main" disabled={!state.preview.value} onClick={() => void apply()}>
            {appTexts.apply}
          </Button>
          <Button onClick={discard}>{appTexts.discard}</Button>
        </div>
      )}
      <div
        class="tabs"
        role="tablist"
        aria-label={appTexts.panels}
        onKeyDown={(event) => {
          if (event.key === 'ArrowRight') steps(1);
          else if (event.key === 'ArrowLeft') steps(-1);
        }}
      >
        {tabs().map(([name, text, key]) => (
          <button
            type="button"
            role="tab"
            id={`tab-${name}`}
            aria-selected={panel === name}
            aria-controls="panel"
            tabIndex={panel === name ? 0 : -1}
            title={`${tips[text]} (${key})`}
            onClick={() => (state.panel.value = name)}
          >
            {text}
          </button>
        ))}
      </div>
      <div class="panel" ref={body} id="panel" role="tabpanel" aria-labelledby={`tab-${panel}`}>
        {panel === 'valve' && <ValvePanel />}
        {panel === 'repair' && <RepairPanel />}
        {panel === 'plan' && <PlanPanel />}
        {panel === 'tour' && <TourPanel />}
        {panel === 'import' && <ImportPanel />}
      </div>
    </aside>
  );
}

function Busy() {
  const busy = state.busy.value;
  if (!busy) return null;
  return (
    <div class="busy" data-testid="busy">
      <span>{busy.text}</span>
      <progress max="1" value={busy.share || undefined} />
      {busy.cancel && (
        <button type="button" class="link" title={tips[t.cancel]} onClick={busy.cancel}>
          {t.cancel}
        </button>
      )}
    </div>
  );
}

/** The valve before in picture and figures, to compare. */
function Compare() {
  if (!state.other.value || state.motion.value || state.surface.value) return null;
  const past = state.inPast.value;
  const compared = !state.preview.value && state.compared.value ? state.compareWith.value : null;
  return (
    <div class="compare group" role="group" aria-label={appTexts.compare}>
      <Button
        keys="W"
        title={compared ? tipTexts.checkpoint : undefined}
        pressed={past}
        onClick={() => (state.past.value = true)}
      >
        {compared ?? appTexts.before}
      </Button>
      <Button
        keys="W"
        title={tips[state.preview.value ? appTexts.preview : appTexts.now]}
        pressed={!past}
        onClick={() => (state.past.value = false)}
      >
        {state.preview.value
          ? appTexts.preview
          : compared
            ? planName(state.main.value?.figures.hash)
            : appTexts.now}
      </Button>
    </div>
  );
}

/** A sentence on the tool that moves tissue. */
function ToolHint() {
  const tool = state.tool.value;
  return tool === 'look' ? null : <p class="tool-hint">{barTexts.tools[tool]}</p>;
}

function Picture() {
  const host = useRef<HTMLDivElement>(null);
  // before the page is painted for the first time: the valve is in that picture
  useLayoutEffect(() => {
    const wanted = /#(webgl|software)/.exec(location.hash)?.[1] ?? '';
    viewport = new Viewport(host.current!, wanted as 'webgl' | 'software' | '');
    Object.assign(window, { planner: { state, viewport, edit, leftValves } });
  }, []);
  return (
    <main class="picture">
      <div class="stage">
        <div class="canvas" ref={host} />
        {state.dropping.value && <p class="drop-here">{appTexts.drop}</p>}
        <p id="picture-help" class="hidden">
          {help.picture}
        </p>
        <Scale />
        <Compare />
        <ToolHint />
        <Busy />
      </div>
      <ViewBar go={go} />
    </main>
  );
}

/** A file may be dropped anywhere: where the page does not take it, the browser leaves the page for the file. */
function onDrag(event: DragEvent): void {
  event.preventDefault();
  state.dropping.value = true;
}

function onDragEnd(event: DragEvent): void {
  if (!event.relatedTarget) state.dropping.value = false;
}

function onDrop(event: DragEvent): void {
  event.preventDefault();
  state.dropping.value = false;
  const files = event.dataTransfer?.files;
  if (!files?.length || state.dialog.value) return;
  void openFile(files[0]).then(() => {
    if (files.length === 1) return;
    const said = state.notice.value;
    state.notice.value = {
      kind: said?.kind ?? 'info',
      text: [said?.text, t.severalFiles(files[0].name)].filter(Boolean).join(' '),
      action: said?.action,
    };
  });
}

export function App() {
  useEffect(() => {
    const onKeyDown = (event: KeyboardEvent) => onKey(event, go);
    window.addEventListener('keydown', onKeyDown);
    window.addEventListener('dragover', onDrag);
    window.addEventListener('dragleave', onDragEnd);
    window.addEventListener('drop', onDrop);
    const endPresses = watchPresses();
    return () => {
      window.removeEventListener('keydown', onKeyDown);
      window.removeEventListener('dragover', onDrag);
      window.removeEventListener('dragleave', onDragEnd);
      window.removeEventListener('drop', onDrop);
      endPresses();
    };
  }, []);
  if (state.broken.value) {
    return (
      <div class="broken" role="alert">
        <h1>{appTexts.stopped}</h1>
        <p>{state.broken.value}</p>
        <button
          type="button"
          class="button main"
          title={tips[appTexts.again]}
          onClick={() => location.reload()}
        >
          {appTexts.again}
        </button>
      </div>
    );
  }
  return (
    <div class="app">
      <TopBar />
      <Picture />
      <Panels />
      <div class="hidden" role="status" aria-live="polite" data-testid="status">
        {state.status.value}
      </div>
      <Tip />
      <Notices />
      <Dialogs />
    </div>
  );
}
