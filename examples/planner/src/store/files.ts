// Opening: shipped valves, valve files, sessions, and surfaces that become a valve.
import { batch } from '@preact/signals';
import { titlesOf } from '../notable';
import { shippedVertices } from '../shipped';
import { leaveTexts, say, startTexts, t } from '../text/texts';
import { millimetres } from '../units';
import type { FileUnit, Motion, Shown } from '../protocol';
import { mayReplace } from './ask';
import { discard } from './edit';
import { knownFounding, learnFounding } from './founding';
import { keepLeakRange, leakRange, rangeIn } from './leak_range';
import { forget, leave, remember, repairOf, type Left } from './left';
import { run, show, whole } from './requests';
import * as state from './state';
import { noteIn } from './valve_note';
import { warnOfFile, warnOfPlan } from './warnings';

type Said = typeof state.notice.value;

/** Shows a notice after what `said` another one. */
function tell(said: Said, text: string, action = said?.action): void {
  const all = [said?.text, text].filter(Boolean).join(' ');
  if (all) state.notice.value = { kind: said?.kind ?? 'info', text: all, action };
}

/** The words for valves that the list of earlier valves has no room for. */
const lost = (titles: string[]): string => (titles.length ? leaveTexts.dropped(titles) : '');

/** Keeps the valve that was left in the list, and offers the way back to a changed one after what `said` the notice before. */
export function offerReturn(left: Left | null, said: Said = state.notice.value): void {
  const dropped = lost(remember(left));
  if (!left?.changed) return tell(said, dropped);
  const words = left.finished ? leaveTexts.finished : leaveTexts.left;
  const text = [words(left.title, left.kept), dropped].filter(Boolean).join(' ');
  tell(said, text, { text: leaveTexts.back, run: () => void comeBack(left) });
}

/** On a valve of the tour: offers its own repair that was left before any other plan, which stays in the list. */
function offerRepair(number: number, left: Left | null): void {
  const own = repairOf(number);
  if (!own) return;
  const other = left?.changed && left !== own ? leaveTexts.listed(left.title, left.kept) : '';
  const text = [other, leaveTexts.repaired].filter(Boolean).join(' ');
  tell(null, text, { text: leaveTexts.back, run: () => void comeBack(own) });
}

/** Opens a valve that was left; the present one is kept in its place. */
export async function comeBack(left: Left): Promise<void> {
  const present = await leave();
  if (present?.changed && !(await mayReplace(left.title, 'file'))) {
    const back = { text: leaveTexts.back, run: () => void comeBack(left) };
    return tell(null, leaveTexts.left(left.title, left.kept), back);
  }
  if (!(await openSession(left.bytes, present))) return;
  batch(() => {
    forget(left);
    state.changed.value = left.changed;
    state.onlyHere.value = true;
  });
}

/** Leaves a surface, and its panel, for a valve. */
function leaveSurface(): void {
  state.imported.value = null;
  if (state.panel.value === 'import') state.panel.value = 'valve';
}

/** Puts the name of the file that could not be opened before the reason in the notice, and whether the file is at fault. */
function nameFile(name: string): void {
  const { value } = state.notice;
  if (value?.kind !== 'error') return;
  // some reasons begin with it and a line
  const why = value.text
    .replace(name, '')
    .replace(/^:(\d+)?:? */, (_, line?: string) => (line ? `line ${line}: ` : ''));
  const words = value.code === 'MVS_E_FORMAT' ? t.damagedFile : t.refusedFile;
  state.notice.value = { ...value, text: words(name, why) };
}

/** Shows a valve with which a plan begins; `onlyHere`: it is in no file. */
function begun(
  shown: Shown | null,
  title: string,
  left: Left | null,
  onlyHere = false,
  said: (shown: Shown) => Said = () => null,
): void {
  if (!shown) return;
  leaveSurface();
  batch(() => {
    state.title.value = title;
    state.notes.value = '';
    state.changed.value = onlyHere;
    state.onlyHere.value = onlyHere;
    show(shown, true);
  });
  // once it is the valve of the plan
  offerReturn(left, said(shown));
}

/** Shows the open valve that closes: the figures of the valve of the plan do not stand beside it. */
function showComing(motion: Motion): void {
  batch(() => {
    state.motion.value = motion;
    state.coming.value = true;
    state.choice.value = null;
  });
}

/** It is closed, or the valve of the plan is shown again: where the file was refused before, nothing has changed. */
function arrived(): void {
  if (!state.coming.value) return;
  state.coming.value = false;
  state.motion.value = null;
  state.openness.value = 1;
}

export const openShipped = (...shipped: Parameters<typeof leaveForShipped>): Promise<void> =>
  whole(() => leaveForShipped(...shipped));

async function leaveForShipped(
  name: string,
  title: string,
  tour: typeof state.tour.value = null,
): Promise<void> {
  const left = await leave();
  const was = state.tour.value;
  // goals are judged as soon as there is something to compare with: not on the valve that is still shown
  state.tour.value = tour && { ...tour, founding: null };
  const shown = await run(
    t.closing,
    'open_shipped',
    { name, vertices: shippedVertices },
    { motion: showComing },
  );
  batch(() => {
    arrived();
    if (!shown) {
      state.tour.value = was;
      return;
    }
    begun(shown, title, left);
    state.tour.value = tour;
    if (tour) offerRepair(tour.number, left);
  });
}

/** Begins another plan with the present valve, which is then the one before the repair; the plan that led to it is left. */
export const beginHere = (): Promise<void> => whole(leaveForItself);

async function leaveForItself(): Promise<void> {
  const figures = state.main.value?.figures;
  if (!figures) return;
  discard();
  const range = leakRange();
  const title = state.title.value || figures.valve;
  const steps = titlesOf(figures).map(say);
  const notes = [state.notes.value, startTexts.steps(title, steps)].filter(Boolean).join('\n');
  const left = await leave();
  const shown = await run(t.saving, 'begin_here', null);
  if (!shown) return;
  keepLeakRange(shown.figures.hash, range, false);
  batch(() => {
    state.tour.value = null;
    begun(shown, startTexts.title(title), left, true, () => ({ kind: 'info', text: startTexts.done }));
    state.notes.value = notes;
  });
}

export const openFile = (file: File): Promise<void> => whole(() => leaveForFile(file));

async function leaveForFile(file: File): Promise<void> {
  // a notice about another file is over
  state.notice.value = null;
  const left = await leave();
  const bytes = new Uint8Array(await file.arrayBuffer());
  if (/\.mvsplan$|\.zip$/i.test(file.name)) return void (await openSession(bytes, left, file.name));
  const head = new TextDecoder().decode(bytes.subarray(0, 4000));
  if (/\.obj$/i.test(file.name) && /^#mvs|^# ?mvs|mvs:/m.test(head)) {
    return openValve(file.name, bytes, left);
  }
  if (/\.(stl|ply|obj|off|vtp|vtk)$/i.test(file.name)) return void (await beginImport(file.name, bytes));
  const words = /\.(mrk\.json|fcsv|csv)$/i.test(file.name) ? t.landmarkFile : t.unknownFile;
  state.notice.value = { kind: 'error', text: words(file.name) };
}

/** Opens a valve in a file of the library. */
async function openValve(name: string, bytes: Uint8Array, left: Left | null): Promise<void> {
  const shown = await run(t.closing, 'open_file', { name, bytes }, { motion: showComing });
  batch(() => {
    arrived();
    if (!shown) return nameFile(name);
    state.tour.value = null;
    const note = noteIn(bytes);
    if (note) keepLeakRange(shown.figures.hash, note.range, note.own);
    begun(shown, name.replace(/\.obj$/i, ''), left, false, warnOfFile);
  });
}

/** Shows a surface to build a valve from, with what was given beside it before; whether it could be read. */
export async function beginImport(
  name: string,
  bytes: Uint8Array,
  unit: FileUnit | null = null,
  given: Partial<Pick<state.Imported, state.Given>> = {},
): Promise<boolean> {
  const surface = await run(t.reading, 'read_surface', { name, bytes, unit });
  if (!surface) {
    nameFile(name);
    return false;
  }
  discard();
  batch(() => {
    state.imported.value = {
      name,
      bytes,
      kind: given.kind ?? '',
      surface,
      points: given.points ?? { annulus: [], commissures: [], anterior: [], tips: [] },
      closed: given.closed ?? null,
      thickness: given.thickness ?? null,
      findings: [],
    };
    state.panel.value = 'import';
    state.status.value = t.importBegun(surface.triangles.length / 3);
  });
  return true;
}

/** Reads the surface in another unit; the clicked points stay at their places on it. */
export async function chooseUnit(unit: FileUnit): Promise<void> {
  const from = state.imported.value;
  if (!from) return;
  const factor = millimetres[unit] / millimetres[from.surface.unit];
  const scaled = (rows: number[][]) => rows.map((row) => row.map((v) => v * factor));
  const { annulus, commissures, anterior, tips } = from.points;
  const points = {
    annulus: scaled(annulus),
    commissures: scaled(commissures),
    anterior: scaled(anterior),
    tips: scaled(tips),
  };
  await beginImport(from.name, from.bytes, unit, { ...from, points });
}

/** Builds a valve from the surface and closes it. */
export const buildValve = (): Promise<void> => whole(leaveForSurface);

async function leaveForSurface(): Promise<void> {
  const from = state.imported.value;
  if (!from) return;
  const title = from.name.replace(/\.\w+$/, '');
  const left = await leave();
  const { kind, points, closed, thickness, surface } = from;
  const asked = { ...points, kind, closed, thickness, unit: surface.unit, name: title };
  const built = await run(closed ? t.fitting : t.building, 'build', asked);
  if (!built) return;
  state.tour.value = null;
  keepLeakRange(built.shown.figures.hash, rangeIn(built.findings));
  begun(built.shown, title, left, true);
  state.imported.value = { ...from, findings: built.findings };
  state.panel.value = 'import';
}

/** Whether it was opened. */
export async function openSession(bytes: Uint8Array, left: Left | null = null, name = ''): Promise<boolean> {
  // figures of the valve before do not stand as those of the one that comes
  state.coming.value = true;
  const opened = await run(t.replaying, 'open_session', { bytes });
  if (!opened) {
    state.coming.value = false;
    const { value } = state.notice;
    if (value?.kind === 'error' && name)
      state.notice.value = { ...value, text: t.refusedFile(name, value.text) };
    return false;
  }
  leaveSurface();
  batch(() => {
    state.coming.value = false;
    keepLeakRange(opened.first.figures.hash, opened.leakRange, opened.leakRangeOwn);
    show(opened.shown, true);
    state.tour.value = opened.tour === null ? null : { number: opened.tour, founding: knownFounding() };
    state.first.value = opened.first;
    state.receiveCheckpoints(opened.checkpoints);
    state.title.value = opened.title;
    state.notes.value = opened.notes;
    state.flow.value = opened.flow ?? state.flow.value;
    state.changed.value = false;
    state.onlyHere.value = false;
    state.notice.value = opened.sameResult
      ? { kind: 'info', text: t.sessionOpened }
      : { kind: 'error', text: t.sessionDiffers };
    warnOfPlan(opened.shown);
  });
  offerReturn(left);
  // its goals are those of the tour again
  if (opened.tour !== null) void learnFounding(opened.tour);
  return true;
}
