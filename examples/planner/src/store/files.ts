// Opening: shipped valves, valve files, sessions, and surfaces that become a valve.
import { batch } from '@preact/signals';
import { shippedVertices } from '../shipped';
import { leaveTexts, t } from '../text/texts';
import type { Shown } from '../protocol';
import { discard } from './edit';
import { request, run, show } from './requests';
import * as state from './state';

/** A changed plan that gives way to another one, as a session. */
interface Left {
  title: string;
  bytes: Uint8Array;
  tour: typeof state.tour.value;
  /** A valve of the tour whose goals were reached. */
  finished: boolean;
}

/** The last changed plan of each valve of the tour, by its number. */
const repairs = new Map<number, Left>();

/** The present plan if it has changes that are not saved: operations, checkpoints or notes. */
export async function leave(): Promise<Left | null> {
  const { canUndo, checkpoints, notes } = state;
  if (!state.changed.value || !(canUndo.value || checkpoints.value.length || notes.value)) return null;
  const title = state.title.value;
  try {
    return {
      title,
      tour: state.tour.value,
      finished: state.finished.value.includes(state.tour.value?.number ?? 0),
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
  await openSession(left.bytes);
  state.tour.value = left.tour;
  state.changed.value = true;
}

/** Leaves a surface, and its panel, for a valve. */
function leaveSurface(): void {
  state.imported.value = null;
  if (state.panel.value === 'import') state.panel.value = 'valve';
}

function begun(shown: Shown | null, title: string, left: Left | null): void {
  if (!shown) return;
  leaveSurface();
  show(shown, true);
  state.title.value = title;
  state.notes.value = '';
  state.changed.value = false;
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
        state.receive(motion.picture);
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
  if (/\.(stl|ply|obj|off|vtp|vtk)$/i.test(file.name)) return beginImport(file.name, bytes);
  state.notice.value = { kind: 'error', text: t.unknownFile(file.name) };
}

/** Width of a surface in mm: the distance of two points far from each other, in whatever way it lies. */
export function widthOf(points: Float32Array): number {
  const farthest = ([x, y, z]: number[]): [number, number[]] => {
    let [range, at] = [0, [x, y, z]];
    for (let i = 0; i < points.length; i += 3) {
      const far = Math.hypot(points[i] - x, points[i + 1] - y, points[i + 2] - z);
      if (far > range) [range, at] = [far, [...points.subarray(i, i + 3)]];
    }
    return [range, at];
  };
  const [, end] = farthest([...points.subarray(0, 3)]);
  return farthest(end)[0];
}

/** mm: widths of surfaces that are taken for valves, from an infant's annulus to a ventricle around a dilated one. */
const plausible = [10, 200];

/** The unit in which a surface that was read as mm has the width of a valve; mm where none has. */
function guessedUnit(points: Float32Array): string {
  const width = widthOf(points);
  const fits = ([, mm]: [string, number]) => width * mm >= plausible[0] && width * mm <= plausible[1];
  return (Object.entries({ mm: 1, cm: 10, m: 1000 }).find(fits) ?? ['mm'])[0];
}

/** Shows a surface to build a valve from. Most files do not state their unit: it is guessed, and can be chosen. */
export async function beginImport(name: string, bytes: Uint8Array, unit?: string): Promise<void> {
  const read = (as: string) => run(t.reading, 'read_surface', { name, bytes: bytes.slice(), unit: as });
  const asMm = unit ? null : await read('mm');
  if (!unit && !asMm) return;
  unit ??= guessedUnit(asMm!.points);
  const surface = unit === 'mm' && asMm ? asMm : await read(unit);
  if (!surface) return;
  discard();
  batch(() => {
    state.imported.value = {
      name,
      bytes,
      unit,
      kind: '',
      surface,
      points: { annulus: [], commissures: [], anterior: [], tips: [] },
      findings: [],
    };
    state.panel.value = 'import';
    state.status.value = t.importBegun(surface.triangles.length / 3);
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
  begun(built.shown, title, left);
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
  show(opened.shown, true);
  state.tour.value = null;
  state.receive(opened.first.picture);
  state.first.value = opened.first;
  state.receiveCheckpoints(opened.checkpoints);
  state.title.value = opened.title;
  state.notes.value = opened.notes;
  state.changed.value = false;
  state.notice.value = opened.sameResult
    ? { kind: 'info', text: t.sessionOpened }
    : { kind: 'error', text: t.sessionDiffers };
  offerReturn(left);
  return true;
}
