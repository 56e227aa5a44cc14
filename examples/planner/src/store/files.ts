// Opening: shipped valves, valve files, sessions, and surfaces that become a valve.
import { batch } from '@preact/signals';
import { shippedVertices } from '../shipped';
import { leaveTexts, t } from '../text/texts';
import { millimetres } from '../units';
import type { FileUnit, Shown } from '../protocol';
import { mayReplace } from './ask';
import { discard } from './edit';
import { reachesAll } from './goals';
import { request, run, show } from './requests';
import * as state from './state';

/** A changed plan that gives way to another one, as a session. */
interface Left {
  title: string;
  bytes: Uint8Array;
  tour: typeof state.tour.value;
  /** A valve of the tour whose goals it reaches. */
  finished: boolean;
}

/** The last changed plan of each valve of the tour, by its number. */
const repairs = new Map<number, Left>();

/** The present plan if it has something that is not saved: operations, checkpoints, notes, or a valve that is in no file. */
export async function leave(): Promise<Left | null> {
  const { canUndo, checkpoints, notes, onlyHere } = state;
  const something = canUndo.value || checkpoints.value.length || notes.value || onlyHere.value;
  if (!state.changed.value || !something) return null;
  const title = state.title.value;
  try {
    return {
      title,
      tour: state.tour.value,
      finished: reachesAll(),
      bytes: await request('save_session', { title, notes: state.notes.value }),
    };
  } catch {
    return null;
  }
}

/** Offers the way back to a plan that was left, after what `said` the notice before. */
export function offerReturn(left: Left | null, said = state.notice.value): void {
  if (!left) return;
  state.notice.value = {
    kind: said?.kind ?? 'info',
    text: [said?.text, left.finished ? leaveTexts.finished(left.title) : leaveTexts.left(left.title)]
      .filter(Boolean)
      .join(' '),
    action: { text: leaveTexts.back, run: () => void comeBack(left) },
  };
}

/** Offers the repair of a valve of the tour that is opened again, or the way back to a plan of another kind. */
function offerRepair(number: number, left: Left | null): void {
  if (left?.tour) repairs.set(left.tour.number, left);
  const own = repairs.get(number);
  if (!own || (left && !left.tour)) return offerReturn(left, null);
  state.notice.value = {
    kind: 'info',
    text: leaveTexts.repaired,
    action: { text: leaveTexts.back, run: () => void comeBack(own) },
  };
}

async function comeBack(left: Left): Promise<void> {
  const present = await leave();
  if (present && !(await mayReplace(left.title, 'file'))) return offerReturn(left, null);
  if (!(await openSession(left.bytes, present))) return;
  batch(() => {
    state.tour.value = left.tour;
    state.changed.value = true;
    state.onlyHere.value = true;
  });
}

/** Leaves a surface, and its panel, for a valve. */
function leaveSurface(): void {
  state.imported.value = null;
  if (state.panel.value === 'import') state.panel.value = 'valve';
}

/** Shows a valve with which a plan begins; `onlyHere`: it is in no file. */
function begun(shown: Shown | null, title: string, left: Left | null, onlyHere = false): void {
  if (!shown) return;
  leaveSurface();
  batch(() => {
    state.title.value = title;
    state.notes.value = '';
    state.changed.value = onlyHere;
    state.onlyHere.value = onlyHere;
    show(shown, true);
  });
  offerReturn(left, null);
}

export async function openShipped(
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
    {
      motion: (motion) => {
        batch(() => {
          state.motion.value = motion;
          state.coming.value = true;
          state.choice.value = null;
        });
      },
    },
  );
  batch(() => {
    state.coming.value = false;
    if (!shown) {
      // the valve of the plan is shown again
      state.motion.value = null;
      state.tour.value = was;
      return;
    }
    begun(shown, title, left);
    state.tour.value = tour;
    if (tour) offerRepair(tour.number, left);
  });
}

export async function openFile(file: File): Promise<void> {
  // a notice about another file is over
  state.notice.value = null;
  const left = await leave();
  const bytes = new Uint8Array(await file.arrayBuffer());
  if (/\.mvsplan$|\.zip$/i.test(file.name)) return void (await openSession(bytes, left, file.name));
  const head = new TextDecoder().decode(bytes.subarray(0, 4000));
  if (/\.obj$/i.test(file.name) && /^#mvs|^# ?mvs|mvs:/m.test(head)) {
    const shown = await run(t.closing, 'open_file', { name: file.name, bytes });
    state.tour.value = null;
    return begun(shown, file.name.replace(/\.obj$/i, ''), left);
  }
  if (/\.(stl|ply|obj|off|vtp|vtk)$/i.test(file.name)) return void (await beginImport(file.name, bytes));
  state.notice.value = { kind: 'error', text: t.unknownFile(file.name) };
}

/** Shows a surface to build a valve from, with points that were clicked on it before; whether it could be read. */
export async function beginImport(
  name: string,
  bytes: Uint8Array,
  unit: FileUnit | null = null,
  clicked: Partial<Pick<state.Imported, 'kind' | 'points'>> = {},
): Promise<boolean> {
  const surface = await run(t.reading, 'read_surface', { name, bytes, unit });
  if (!surface) return false;
  discard();
  batch(() => {
    state.imported.value = {
      name,
      bytes,
      kind: clicked.kind ?? '',
      surface,
      points: clicked.points ?? { annulus: [], commissures: [], anterior: [], tips: [] },
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
  await beginImport(from.name, from.bytes, unit, {
    kind: from.kind,
    points: {
      annulus: scaled(annulus),
      commissures: scaled(commissures),
      anterior: scaled(anterior),
      tips: scaled(tips),
    },
  });
}

/** Builds a valve from the surface and closes it. */
export async function buildValve(): Promise<void> {
  const from = state.imported.value;
  if (!from) return;
  const title = from.name.replace(/\.\w+$/, '');
  const left = await leave();
  const built = await run(t.building, 'build', { ...from.points, kind: from.kind, name: title });
  if (!built) return;
  state.tour.value = null;
  begun(built.shown, title, left, true);
  state.imported.value = { ...from, findings: built.findings };
  state.panel.value = 'import';
}

/** Whether it was opened. */
export async function openSession(bytes: Uint8Array, left: Left | null = null, name = ''): Promise<boolean> {
  const opened = await run(t.replaying, 'open_session', { bytes });
  if (!opened) {
    const { value } = state.notice;
    if (value?.kind === 'error' && name)
      state.notice.value = { ...value, text: t.refusedFile(name, value.text) };
    return false;
  }
  leaveSurface();
  batch(() => {
    show(opened.shown, true);
    state.tour.value = null;
    state.first.value = opened.first;
    state.receiveCheckpoints(opened.checkpoints);
    state.title.value = opened.title;
    state.notes.value = opened.notes;
    state.changed.value = false;
    state.onlyHere.value = false;
    state.notice.value = opened.sameResult
      ? { kind: 'info', text: t.sessionOpened }
      : { kind: 'error', text: t.sessionDiffers };
  });
  offerReturn(left);
  return true;
}
