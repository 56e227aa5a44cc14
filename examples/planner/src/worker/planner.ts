// The valve of the page: one simulator that holds the plan, and a second one for everything that must not
// change it: previews, the opening slider, a hand in the valve.
import { DIASTOLE_PA, MvsError, SYSTOLE_PA, type Mvs, type Simulator, type Snapshot } from 'libmvs';
import type { Cost, FieldValue, Motion, Operation, OperationInfo, Shown, Spread } from '../protocol';
import { figuresOf, motionOf, pictureOf } from './picture';
import { mm, mm2, pageUnit } from './units';

/** Settles run in slices of this length, s, so that a cancel is heard. */
const slice = 0.03;
/** N, largest out-of-balance force at rest: that of the library's recommendation for closures. */
const settleOptions = { residual: 1e-4 };

export class Planner {
  readonly main: Simulator;
  private readonly second: Simulator;
  private preview: Snapshot | null = null;
  /** Bytes of the starting valve, an OBJ file. */
  start = new Uint8Array(0);
  readonly checkpoints = new Map<string, Snapshot>();

  constructor(readonly mvs: Mvs) {
    this.main = mvs.simulator();
    this.second = mvs.simulator();
  }

  operations(): OperationInfo[] {
    return this.mvs.operations.map((operation) => ({
      name: operation.name,
      help: operation.help,
      fields: operation.fields.map((field) => {
        const { factor, unit } = pageUnit(field.unit);
        return {
          name: field.name,
          type: String(field.type),
          required: field.required === 1,
          low: field.low * factor,
          high: field.high * factor,
          unit,
          label: field.label,
          help: field.help,
          choices: Object.entries(field.words).map(([name, value]) => ({ name, value })),
          fallback: field.default_text,
          fallbackValue: field.default_value * factor,
        };
      }),
    }));
  }

  /** Takes over a valve file as the start of a plan, closes it, and begins a history. */
  async openBytes(
    bytes: Uint8Array | string,
    signal: AbortSignal,
    report: (share: number) => void,
  ): Promise<Shown> {
    this.second.load(bytes, 'obj');
    const start = this.second.read((snapshot) => snapshot.save('obj'));
    this.main.load(start, 'obj');
    this.start = start;
    this.forget();
    return this.close(signal, report);
  }

  /** Takes over an opened session. */
  take(start: Uint8Array, snapshot: Snapshot, checkpoints: (readonly [string, Snapshot])[]): void {
    this.forget();
    this.main.restore(snapshot);
    this.start = start.slice();
    for (const [name, kept] of checkpoints) this.checkpoints.set(name, kept);
  }

  private forget(): void {
    for (const snapshot of this.checkpoints.values()) snapshot.dispose();
    this.checkpoints.clear();
    this.discard();
  }

  /** The picture of the valve as it is, without figures. */
  motion(share: number): Motion {
    return this.main.read((snapshot) => motionOf(snapshot, share));
  }

  private async close(signal: AbortSignal, report: (share: number) => void): Promise<Shown> {
    this.main.setLoad({ pressure: SYSTOLE_PA, boundary_fraction: 1 });
    await this.settle(this.main, signal, report);
    return this.shown();
  }

  private async settle(sim: Simulator, signal: AbortSignal, report: (share: number) => void): Promise<void> {
    await sim.settleInSlices({ ...settleOptions, slice, signal, onProgress: report });
  }

  shown(): Shown {
    return this.main.read((snapshot) => this.shownOf(snapshot));
  }

  shownOf(snapshot: Snapshot): Shown {
    return { picture: pictureOf(snapshot, true), figures: figuresOf(this.mvs, snapshot) };
  }

  check(operation: Operation): void {
    this.main.check(operation.kind, this.fieldsOf(operation));
  }

  /** The closed valve after an operation, beside the plan. */
  async previewOf(
    operation: Operation,
    signal: AbortSignal,
    report: (share: number) => void,
  ): Promise<Shown> {
    this.discard();
    const fields = this.fieldsOf(operation);
    this.main.check(operation.kind, fields);
    this.main.read((snapshot) => this.second.restore(snapshot));
    this.second.apply(operation.kind, fields);
    await this.settle(this.second, signal, report);
    this.preview = this.second.snapshot();
    return this.shownOf(this.preview);
  }

  discard(): void {
    this.preview?.dispose();
    this.preview = null;
  }

  /** The preview becomes the valve of the plan. */
  accept(): Shown {
    if (!this.preview)
      throw new MvsError('MVS_E_STATE', 'preview', 'there is no preview to apply: choose an operation');
    this.main.restore(this.preview);
    this.discard();
    return this.shown();
  }

  undo(): Shown {
    this.discard();
    this.main.undo();
    return this.shown();
  }

  async redo(signal: AbortSignal, report: (share: number) => void): Promise<Shown> {
    this.discard();
    this.main.redo();
    await this.settle(this.main, signal, report);
    return this.shown();
  }

  /** The valve between open (0, 5 mmHg the other way) and closed (1, systole), beside the plan. */
  async openTo(share: number, fresh: boolean, signal: AbortSignal): Promise<Motion> {
    if (fresh) this.main.read((snapshot) => this.second.restore(snapshot));
    // most of the motion happens at low pressures
    const pressure = share >= 1 ? SYSTOLE_PA : SYSTOLE_PA * share ** 4 - DIASTOLE_PA * (1 - share) ** 2;
    this.second.setLoad({ pressure, boundary_fraction: share });
    await this.second.settleInSlices({ residual: 1e-3, slice, signal });
    return this.second.read((snapshot) => motionOf(snapshot, share));
  }

  /** The simulator beside the plan, at the valve of the plan. */
  beside(): Simulator {
    this.discard();
    this.main.read((snapshot) => this.second.restore(snapshot));
    return this.second;
  }

  cost(which: 'main' | 'preview'): Cost {
    const held = which === 'preview' && this.preview ? null : this.main.snapshot();
    try {
      const { cost, opened } = (held ?? this.preview!).cost({ residual: 1e-4 });
      opened.dispose();
      return {
        openArea: cost.open_area * mm2,
        anteriorLength: cost.anterior_length * mm,
        posteriorLength: cost.posterior_length * mm,
        lengthRatio: cost.length_ratio,
        annulusForce: cost.annulus_force_sum,
      };
    } finally {
      held?.dispose();
    }
  }

  section(which: string, point: number[], normal: number[]): Float32Array {
    const cut = (snapshot: Snapshot) =>
      Float32Array.from(
        snapshot.section(
          point.map((v) => v / mm),
          normal,
        ),
        (v) => v * mm,
      );
    if (which === 'preview' && this.preview) return cut(this.preview);
    const kept = this.checkpoints.get(which);
    return kept ? cut(kept) : this.main.read(cut);
  }

  checkpoint(name: string): string[] {
    this.checkpoints.get(name)?.dispose();
    this.checkpoints.set(name, this.main.snapshot());
    return [...this.checkpoints.keys()];
  }

  private checkpointOf(name: string): Snapshot {
    const kept = this.checkpoints.get(name);
    if (!kept) throw new MvsError('MVS_E_ID', name, `there is no checkpoint ${name}`);
    return kept;
  }

  restore(name: string): Shown {
    this.discard();
    this.main.restore(this.checkpointOf(name));
    return this.shown();
  }

  readCheckpoint(name: string): Shown {
    return this.shownOf(this.checkpointOf(name));
  }

  /** Figures of several closures along different loading paths. */
  spread(members: number, report: (share: number) => void): Spread {
    return this.main.read((snapshot) => {
      const ensemble = snapshot.ensemble(
        { pressure: SYSTOLE_PA, boundary_fraction: 1 },
        { members, progress: (share: number) => (report(share), false) },
        settleOptions,
      );
      try {
        const { summary } = ensemble;
        const low = ensemble.measure('min');
        const high = ensemble.measure('max');
        const row = (name: string, field: keyof typeof low, factor: number) => ({
          name,
          min: (low[field] as number) * factor,
          max: (high[field] as number) * factor,
        });
        return {
          members: summary.members,
          converged: summary.converged,
          equilibria: summary.equilibria,
          nodeMax: summary.node_max * mm,
          rows: [
            row('orifice', 'regurgitant_orifice_area', mm2),
            row('coaptationMean', 'coaptation_length_mean', mm),
            row('coaptationHeight', 'coaptation_height', mm),
            row('tentingHeight', 'tenting_height', mm),
            row('billowHeight', 'billow_height', mm),
            row('maxChordTension', 'max_chord_tension', 1),
          ],
        };
      } finally {
        ensemble.dispose();
      }
    });
  }

  /** Fields of an operation in SI units, parts by their ids. */
  private fieldsOf(operation: Operation): Record<string, never> {
    const info = this.mvs.operations.find((candidate) => candidate.name === operation.kind);
    if (!info) throw new MvsError('MVS_E_OP', operation.kind, `there is no operation ${operation.kind}`);
    const out: Record<string, unknown> = {};
    for (const [name, value] of Object.entries(operation.fields)) {
      const field = info.fields.find((candidate) => candidate.name === name);
      if (!field) throw new MvsError('MVS_E_OP', name, `${operation.kind} has no field ${name}`);
      out[name] = toLibrary(String(field.type), pageUnit(field.unit).factor, value);
    }
    return out as Record<string, never>;
  }
}

function toLibrary(type: string, factor: number, value: FieldValue): unknown {
  if (type === 'chord' || type === 'head' || type === 'scallop') return BigInt(value as string);
  if (type === 'site') {
    const site = value as
      { triangle: number; u: number[] } | { scallop: string; along: number; height: number };
    return 'triangle' in site ? site : { scallop: BigInt(site.scallop), u: [site.along, site.height] };
  }
  if (typeof value === 'number') return type === 'number' ? value / factor : value;
  if (Array.isArray(value))
    return value.map((v) => (Array.isArray(v) ? v.map((w) => w / factor) : v / factor));
  return value;
}
