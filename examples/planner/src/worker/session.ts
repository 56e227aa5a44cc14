// The session file: a zip archive of valve.obj (the starting valve), plan.json (every load, operation and settle
// from it to the present valve), checkpoints/N.json (plans) and session.json (names, notes, the hash). Nothing else
// is needed to repeat it: `mvs repair valve.obj --plan plan.json`.
import { MvsError } from 'libmvs';
import { strFromU8, strToU8, unzipSync, zipSync } from 'fflate';
import type { Range, SessionContents, SessionOpened } from '../protocol';
import { refusals } from '../text/texts';
import { isFlow } from '../units';
import type { Planner } from './planner';
import { keepResidual } from './residuals';

const format = 'mvs-planner-session';
const version = 1;
/** Bytes: files above are not sessions of a valve. */
const largest = 256 << 20;

interface Description {
  format: string;
  version: number;
  title: string;
  notes: string;
  hash: string;
  saved: string;
  checkpoints: { name: string; plan: string }[];
  /** Number of operations at the start of the plan that made the diseased valve; 0 if left out. */
  before?: number;
  leak_range_mm2?: Range;
  flow_ml_s?: number;
  /** The valve of the tour, from 1. */
  tour?: number;
}

/** Valves of the tour. */
const tourValves = new Set([1, 2, 3, 4]);

/** Two numbers of a file, in their order; null for anything else. */
function rangeOf(value: unknown): Range | null {
  if (!Array.isArray(value) || value.length !== 2) return null;
  const [low, high] = value.map(Number);
  return low <= high ? [low, high] : null;
}

export function saveSession(
  planner: Planner,
  { title, notes, leakRange, flow, tour }: SessionContents,
): Uint8Array {
  const files: Record<string, Uint8Array> = { 'valve.obj': planner.start };
  const checkpoints = [...planner.checkpoints].map(([name, snapshot], k) => {
    const plan = `checkpoints/${k + 1}.json`;
    files[plan] = strToU8(snapshot.plan());
    return { name, plan };
  });
  const [plan, hash] = planner.main.read((snapshot) => [snapshot.plan({ notes }), snapshot.hash]);
  files['plan.json'] = strToU8(plan);
  const description: Description = {
    format,
    version,
    title,
    notes,
    hash,
    saved: new Date().toISOString(),
    checkpoints,
    before: planner.before || undefined,
    leak_range_mm2: leakRange ?? undefined,
    flow_ml_s: flow || undefined,
    tour: tour || undefined,
  };
  files['session.json'] = strToU8(JSON.stringify(description, null, 2));
  return zipSync(files, { level: 6 });
}

function refuse(sentence: string): never {
  throw new MvsError('MVS_E_FORMAT', 'session', sentence);
}

/** Files of an archive of bounded size. */
function unpack(bytes: Uint8Array): Record<string, Uint8Array> {
  let total = 0;
  try {
    return unzipSync(bytes, {
      filter: (file) => {
        total += file.originalSize;
        return total <= largest;
      },
    });
  } catch {
    return refuse(refusals.notArchive);
  }
}

function describe(files: Record<string, Uint8Array>): Description {
  const text = files['session.json'];
  if (!text) refuse(refusals.notSession);
  let description: Description;
  try {
    description = JSON.parse(strFromU8(text)) as Description;
  } catch {
    return refuse(refusals.notJson);
  }
  if (description?.format !== format) refuse(refusals.otherKind);
  if (description.version !== version) refuse(refusals.otherVersion(description.version, version));
  return description;
}

/** Opens a session: the plan is repeated from the starting valve, and the hash compared. */
export function openSession(planner: Planner, bytes: Uint8Array): SessionOpened {
  const files = unpack(bytes);
  const description = describe(files);
  const text = (name: string): string =>
    files[name] ? strFromU8(files[name]) : refuse(refusals.missing(name));
  planner.warnings.take();
  const trial = planner.warnings.simulator(planner.mvs);
  try {
    const valve = files['valve.obj'] ?? refuse(refusals.missing('valve.obj'));
    const checkpoints = (Array.isArray(description.checkpoints) ? description.checkpoints : []).map(
      ({ name, plan }) => {
        trial.load(valve, 'obj');
        trial.replayPlan(text(String(plan)));
        keepResidual(trial);
        return [String(name), trial.snapshot()] as const;
      },
    );
    trial.load(valve, 'obj');
    trial.replayPlan(text('plan.json'));
    keepResidual(trial);
    const repaired = trial.snapshot();
    const done = () => trial.read((snapshot) => snapshot.history().done.length);
    const before = Math.min(done(), Math.max(0, Math.floor(Number(description.before) || 0)));
    // undo gives the closed valve before the repair back, without a settle
    while (done() > before) trial.undo();
    planner.take(valve, repaired, trial.snapshot(), checkpoints, before);
    repaired.dispose();
  } finally {
    trial.dispose();
  }
  const shown = { ...planner.shown(), warnings: planner.warnings.take() };
  return {
    shown,
    first: planner.shownFirst(),
    checkpoints: planner.checkpoints.list(),
    notes: String(description.notes ?? ''),
    title: String(description.title ?? ''),
    leakRange: rangeOf(description.leak_range_mm2),
    leakRangeOwn: !planner.before,
    flow: isFlow(Number(description.flow_ml_s)) ? Number(description.flow_ml_s) : null,
    tour: tourValves.has(Number(description.tour)) ? Number(description.tour) : null,
    sameResult: shown.figures.hash === description.hash,
  };
}
