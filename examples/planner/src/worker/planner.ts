// The valve of the page: one simulator that holds the plan, and a second one for everything that must not
// change it: previews, the opening slider, a hand in the valve.
import {
  DIASTOLE_PA,
  MvsError,
  SettleFlags,
  SYSTOLE_PA,
  type Mvs,
  type Simulator,
  type Snapshot,
} from 'libmvs';
import type { CostRequest } from '../calls';
import type {
  CheckpointList,
  Cost,
  Known,
  Motion,
  Operation,
  Section,
  SectionRequest,
  Shown,
  Spread,
} from '../protocol';
import { refusals } from '../text/texts';
import { restResidual } from '../units';
import { breathe } from './breathe';
import { checkpointIn, Checkpoints } from './checkpoints';
import { libraryFields } from './operations';
import { ofRepair } from './history';
import { costOf } from './opening';
import { figuresOf, frameOf, motionOf, pictureOf } from './picture';
import { keepResidual } from './residuals';
import { sectionOf } from './section';
import { closedOften } from './spread';
import { otherLoad, Warnings } from './warnings';

/** Settles run in slices of this length, s, so that a cancel is heard. */
const slice = 0.03;
/** N, largest out-of-balance force at rest: that of the library's recommendation for closures. The
 * page shows no margins of stability. */
const settleOptions = { residual: restResidual, flags: SettleFlags.no_margins };

export class Planner {
  readonly main: Simulator;
  readonly warnings = new Warnings();
  private readonly second: Simulator;
  private preview: Snapshot | null = null;
  /** Bytes of the starting valve, an OBJ file. */
  start = new Uint8Array(0);
  readonly checkpoints = new Checkpoints();
  /** The healthy original of a valve of the tour; it belongs to the tour. */
  healthy: Snapshot | null = null;
  /** The closed valve before the first operation. */
  private first: Snapshot | null = null;
  /** Number of operations that made the diseased valve; the page neither lists nor undoes them. */
  before = 0;
  /** Operations that had been undone before the repair, while they could be repeated: until the first of the repair. */
  private forgotten = false;

  constructor(readonly mvs: Mvs) {
    this.main = this.warnings.simulator(mvs);
    this.second = this.warnings.simulator(mvs);
  }

  /** Closes a valve file beside the plan, of which nothing changes where that fails or is cancelled; then begins a plan with it.
   *  `loaded`: the file is read, and closing begins. */
  async openBytes(
    bytes: Uint8Array | string,
    signal: AbortSignal,
    report: (share: number) => void,
    loaded = () => {},
  ): Promise<Shown> {
    this.discard();
    this.warnings.take();
    this.second.load(bytes, 'obj');
    const ownLoad = otherLoad(this.second);
    const start = this.second.read((snapshot) => snapshot.save('obj'));
    this.second.load(start, 'obj');
    loaded();
    this.second.setLoad({ pressure: SYSTOLE_PA, boundary_fraction: 1 });
    await this.settle(this.second, signal, report);
    this.forget();
    this.first = this.second.snapshot();
    this.main.restore(this.first);
    this.start = start;
    return { ...this.shown(), warnings: this.warnings.take(), ownLoad };
  }

  /**
   * The present valve becomes the one before the repair, in its very state: the plan goes on from the starting valve, so that a session
   * repeats it to the same bits. A valve that is saved as a file and closed again has others.
   */
  beginHere(): Shown {
    const first = this.main.snapshot();
    this.forget();
    this.first = first;
    this.before = first.history().done.length;
    this.forgotten = true;
    return this.shown();
  }

  /** Takes over an opened session. */
  take(
    start: Uint8Array,
    snapshot: Snapshot,
    first: Snapshot,
    checkpoints: (readonly [string, Snapshot])[],
    before: number,
  ): void {
    this.forget();
    this.before = before;
    this.main.restore(snapshot);
    this.first = first;
    this.start = start.slice();
    for (const [name, kept] of checkpoints) this.checkpoints.set(name, kept);
  }

  private forget(): void {
    this.checkpoints.forget();
    this.healthy = null;
    this.before = 0;
    this.forgotten = false;
    this.first?.dispose();
    this.first = null;
    this.discard();
  }

  /** The picture of the valve that is being opened, as it is, without figures. */
  motion(share: number): Motion {
    return this.second.read((snapshot) => motionOf(snapshot, share));
  }

  private async settle(sim: Simulator, signal: AbortSignal, report: (share: number) => void): Promise<void> {
    await sim.settleInSlices({ ...settleOptions, slice, signal, onProgress: report });
    keepResidual(sim);
  }

  shown(): Shown {
    return this.main.read((snapshot) => this.shownOf(snapshot));
  }

  /** The closed valve before the first operation. */
  shownFirst(): Shown {
    return this.first ? this.shownOf(this.first) : this.shown();
  }

  shownOf(snapshot: Snapshot, known: Known = 'all'): Shown {
    const figures = figuresOf(this.mvs, snapshot, known);
    return {
      picture: pictureOf(snapshot, known !== 'shape'),
      figures: { ...figures, history: ofRepair(figures.history, this.before, this.forgotten) },
    };
  }

  /**
   * A snapshot in stages: its shape, its orifice and coaptation, all; those that the page `has` are left out. Figures
   * take longer than the shape. A cancel is heard between two stages.
   */
  private async inStages(
    snapshot: Snapshot,
    stage: (shown: Shown) => void,
    has: Known | null = null,
    signal?: AbortSignal,
  ): Promise<Shown> {
    const stages = ['shape', 'orifice'] as const;
    for (const known of stages.slice(has ? stages.indexOf(has as 'shape') + 1 : 0)) {
      stage(this.shownOf(snapshot, known));
      await breathe();
      if (signal?.aborted) throw new MvsError('MVS_E_CANCELLED', 'preview', refusals.cancelled);
    }
    return this.shownOf(snapshot);
  }

  /** The valve of the plan, in stages. */
  private async mainInStages(stage: (shown: Shown) => void): Promise<Shown> {
    const snapshot = this.main.snapshot();
    try {
      return await this.inStages(snapshot, stage);
    } finally {
      snapshot.dispose();
    }
  }

  check(operation: Operation): void {
    this.main.check(operation.kind, libraryFields(this.mvs, operation));
  }

  /** The closed valve after an operation, beside the plan, in stages. */
  async previewOf(
    operation: Operation,
    signal: AbortSignal,
    report: (share: number) => void,
    stage: (shown: Shown) => void,
  ): Promise<Shown> {
    this.discard();
    const fields = libraryFields(this.mvs, operation);
    this.main.check(operation.kind, fields);
    this.main.read((snapshot) => this.second.restore(snapshot));
    this.warnings.take();
    this.second.apply(operation.kind, fields);
    await this.settle(this.second, signal, report);
    const warnings = this.warnings.take();
    const preview = this.second.snapshot();
    this.preview = preview;
    const last = await this.inStages(preview, (shown) => stage({ ...shown, warnings }), null, signal);
    return { ...last, warnings };
  }

  discard(): void {
    this.preview?.dispose();
    this.preview = null;
  }

  /** The preview becomes the valve of the plan; the stages that the page does not have follow. */
  async accept(has: Known, stage: (shown: Shown) => void): Promise<Shown | null> {
    const accepted = this.preview;
    if (!accepted) throw new MvsError('MVS_E_STATE', 'preview', refusals.noPreview);
    this.preview = null;
    this.forgotten = false;
    try {
      this.main.restore(accepted);
      return has === 'all' ? null : await this.inStages(accepted, stage, has);
    } finally {
      accepted.dispose();
    }
  }

  undo(stage: (shown: Shown) => void): Promise<Shown> {
    this.discard();
    this.main.undo();
    return this.mainInStages(stage);
  }

  async redo(
    signal: AbortSignal,
    report: (share: number) => void,
    stage: (shown: Shown) => void,
  ): Promise<Shown> {
    this.discard();
    this.main.redo();
    await this.settle(this.main, signal, report);
    return this.mainInStages(stage);
  }

  /** The valve between open (0, 5 mmHg the other way) and closed (1, systole), beside the plan. */
  async openTo(share: number, fresh: boolean, signal: AbortSignal): Promise<Motion> {
    if (fresh) this.main.read((snapshot) => this.second.restore(snapshot));
    // most of the motion happens at low pressures
    const pressure = share >= 1 ? SYSTOLE_PA : SYSTOLE_PA * share ** 4 - DIASTOLE_PA * (1 - share) ** 2;
    this.second.setLoad({ pressure, boundary_fraction: share });
    await this.second.settleInSlices({ ...settleOptions, residual: 1e-3, slice, signal });
    return this.second.read((snapshot) => motionOf(snapshot, share));
  }

  /** The simulator beside the plan, at the valve of the plan. */
  beside(): Simulator {
    this.discard();
    this.main.read((snapshot) => this.second.restore(snapshot));
    return this.second;
  }

  /** The valve opened in diastole. */
  cost({ which }: CostRequest): Cost {
    if (which === 'preview' && this.preview) return costOf(this.preview);
    if (which === 'first' && this.first) return costOf(this.first);
    const name = checkpointIn(which);
    return name === null ? this.main.read(costOf) : costOf(this.checkpoints.of(name));
  }

  section({ which, frame, offset }: SectionRequest): Section {
    if (which === 'preview' && this.preview) return sectionOf(this.preview, frame, offset);
    if (which === 'first' && this.first) return sectionOf(this.first, frame, offset);
    if (which === 'healthy')
      return this.healthy ? sectionOf(this.healthy, frameOf(this.healthy), offset) : new Float32Array(0);
    const name = checkpointIn(which);
    const kept = name === null ? null : this.checkpoints.get(name);
    if (kept) return sectionOf(kept, frame, offset);
    return this.main.read((snapshot) => sectionOf(snapshot, frame, offset));
  }

  checkpoint(name: string): CheckpointList {
    return this.checkpoints.keep(name, this.main.snapshot());
  }

  restore(name: string, stage: (shown: Shown) => void): Promise<Shown> {
    this.discard();
    this.main.restore(this.checkpoints.of(name));
    return this.mainInStages(stage);
  }

  readCheckpoint(name: string): Shown {
    return this.shownOf(this.checkpoints.of(name));
  }

  /** Figures of several closures along different loading paths. */
  spread(members: number, report: (share: number) => void): Spread {
    return this.main.read((snapshot) => closedOften(this.mvs, snapshot, members, settleOptions, report));
  }
}
