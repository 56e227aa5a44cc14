// The worker: answers the requests of the page one after the other. A request that is under way can be cancelled;
// long ones report their progress.
import { loadMvs, MvsError, SYSTOLE_PA, type Mvs } from 'libmvs';
import type { CallName, Calls } from '../calls';
import type { Failure, Motion, Shown } from '../protocol';
import { refusals } from '../text/texts';
import { foundingRepair, HealthyValve } from './founding';
import { HandLoop } from './hand';
import { Importer } from './importer';
import { operationsOf } from './operations';
import { buffersOf } from './picture';
import { Planner } from './planner';
import { openSession, saveSession } from './session';
import { shippedValve } from './shipped';

declare const self: DedicatedWorkerGlobalScope;

interface Under {
  id: number;
  signal: AbortSignal;
  report: (share: number) => void;
  /** Sends a valve of which not all figures are known yet. */
  stage: (shown: Shown) => void;
}

let mvs: Mvs;
let planner: Planner;
let importer: Importer;
let healthy: HealthyValve | null = null;
let hand: HandLoop | null = null;
/** True while the slider of the opening moves the second simulator. */
let opening = false;

/** Ends a hand in the valve: it moves the simulator that works beside the plan. */
function letGo(): void {
  hand?.end();
  hand = null;
}

function post(message: unknown): void {
  self.postMessage(message, [...buffersOf(message)]);
}

/** gzip in base64 to bytes, without a request. */
async function unpack(text: string): Promise<ArrayBuffer> {
  const packed = atob(text);
  const bytes = new Uint8Array(packed.length);
  for (let i = 0; i < packed.length; ++i) bytes[i] = packed.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}

async function start(library: string): Promise<Calls['start']['result']> {
  mvs = await loadMvs({ wasm: await unpack(library) });
  planner = new Planner(mvs);
  importer = new Importer(mvs);
  return { version: mvs.version, operations: operationsOf(mvs) };
}

/** The open valve is shown while it closes. */
const showOpen = (id: number): void => post({ id, motion: planner.motion(0) });

type Handlers = {
  [Name in CallName]: (
    argument: Calls[Name]['argument'],
    under: Under,
  ) => Promise<Calls[Name]['result']> | Calls[Name]['result'];
};

const handlers: Handlers = {
  start: ({ library }) => start(library),
  open_shipped: ({ name, vertices }, { id, signal, report }) => {
    letGo();
    return planner.openBytes(shippedValve(mvs, name, vertices), signal, report, () => showOpen(id));
  },
  begin_here: () => (letGo(), planner.beginHere()),
  open_file: ({ bytes }, { id, signal, report }) => {
    letGo();
    return planner.openBytes(bytes, signal, report, () => showOpen(id));
  },
  preview: (operation, { signal, report, stage }) => planner.previewOf(operation, signal, report, stage),
  accept: ({ has }, { stage }) => planner.accept(has, stage),
  discard: () => (planner.discard(), null),
  check: (operation) => (planner.check(operation), null),
  undo: (_, { stage }) => planner.undo(stage),
  redo: (_, { signal, report, stage }) => planner.redo(signal, report, stage),
  open_to: async ({ share }, { signal }) => {
    const fresh = !opening;
    opening = true;
    return planner.openTo(share, fresh, signal);
  },
  cost: (request) => planner.cost(request),
  section: (request) => planner.section(request),
  hand_begin: (argument, { id }) => {
    const sim = planner.beside();
    sim.setLoad({ pressure: SYSTOLE_PA, boundary_fraction: 1 });
    letGo();
    hand = new HandLoop(
      sim,
      argument,
      (motion: Motion) => post({ id, motion }),
      (error) => post({ id, failure: failureOf(error) }),
    );
    return null;
  },
  hand_move: ({ position }) => (hand?.move(position), null),
  hand_end: () => {
    letGo();
    return planner.shown();
  },
  checkpoint: ({ name }) => planner.checkpoint(name),
  rename_checkpoint: ({ name, to }) => planner.checkpoints.rename(name, to),
  remove_checkpoint: ({ name }) => planner.checkpoints.remove(name),
  put_back_checkpoint: () => planner.checkpoints.putBack(),
  restore: ({ name }, { stage }) => planner.restore(name, stage),
  read_checkpoint: ({ name }) => planner.readCheckpoint(name),
  save_obj: () => planner.main.read((snapshot) => snapshot.save('obj')),
  save_session: (contents) => saveSession(planner, contents),
  open_session: ({ bytes }) => openSession(planner, bytes),
  founding_healthy: ({ vertices }) => {
    healthy ??= new HealthyValve(mvs, vertices);
    planner.healthy = healthy.snapshot;
    return healthy.figures;
  },
  founding_repair: ({ number, vertices }) => foundingRepair(mvs, number, vertices),
  spread: ({ members }, { report }) => planner.spread(members, report),
  read_surface: ({ name, bytes, unit }) => importer.read(name, bytes, unit),
  read_closed: ({ name, bytes, unit }) => importer.closed({ name, bytes }, unit).triangles.length / 3,
  build: async (request, { signal, report }) => {
    letGo();
    // closing it takes about a third of the time
    const { valve, findings } = importer.build(request, (share) => report(0.7 * share));
    const closing = (share: number) => report(0.7 + 0.3 * share);
    return { shown: await planner.openBytes(valve, signal, closing), findings };
  },
};

function failureOf(error: unknown): Failure {
  if (error instanceof MvsError) return { code: error.code, part: error.part, message: error.message };
  return { code: 'MVS_E_INTERNAL', part: 'page', message: String((error as Error)?.message ?? error) };
}

interface Request {
  id: number;
  call: CallName;
  argument: never;
}

const queue: Request[] = [];
const cancelled = new Set<number>();
let running: { id: number; abort: AbortController } | null = null;

async function work(): Promise<void> {
  while (!running) {
    const request = queue.shift();
    if (!request) return;
    const { id, call, argument } = request;
    const abort = new AbortController();
    if (cancelled.delete(id)) {
      post({ id, failure: { code: 'MVS_E_CANCELLED', part: call, message: refusals.cancelled } });
      continue;
    }
    running = { id, abort };
    if (call !== 'open_to') opening = false;
    try {
      const report = (share: number) => post({ id, share });
      const stage = (shown: Shown) => post({ id, stage: shown });
      post({ id, result: await handlers[call](argument, { id, signal: abort.signal, report, stage }) });
    } catch (error) {
      post({ id, failure: failureOf(error) });
    }
    running = null;
  }
}

self.onmessage = ({ data }: MessageEvent<Request | { cancel: number }>) => {
  if ('cancel' in data) {
    if (running?.id === data.cancel) running.abort.abort();
    else if (queue.some((request) => request.id === data.cancel)) cancelled.add(data.cancel);
    return;
  }
  if (data.call === 'hand_move') {
    // at once, not behind a long request
    hand?.move((data.argument as { position: number[] }).position);
    return;
  }
  queue.push(data);
  void work();
};
