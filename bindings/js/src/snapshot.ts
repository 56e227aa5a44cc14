// A snapshot: an immutable valve with its state and history, to read, measure, compare and save.
import { ArrayView, type ProgressCallback, type ReadonlyArrayOf, type TypedArray } from "./arrays.js";
import { Ensemble } from "./ensemble.js";
import { refuse } from "./error.js";
import { ArrayKind, MeasureGroupFlags, type ArrayTypes, type Format, type PartKind } from "./generated/enums.js";
import type {
  ChordInfo, Comparison, Cost, CostOptions, EnsembleOptions, HistoryEntry, LoadCase, LoadCaseInput, Measures, OrificePart,
  Part, PlanOptions, RegionMeasures, Rest, SettleOptions, Stability, ToolBody, ToolState,
} from "./generated/structs.js";
import { Owned } from "./handles.js";
import { enumNumber } from "./layout.js";
import type { Mvs } from "./library.js";
import { pick, type Picked, type Ray } from "./pick.js";

/** 120 mmHg in Pa: the default systolic load. */
export const SYSTOLE_PA = 15998.64;

/** A load whose fields are all given: in C, those that are left out are 0. */
export function loadWithDefaults(load: LoadCaseInput): LoadCaseInput {
  if (typeof load !== "object" || load === null) return load; // refused where it is written
  const { pressure = SYSTOLE_PA, boundary_fraction = 1 } = load;
  return { ...load, pressure, boundary_fraction };
}

/** Names of the arrays of a snapshot, "node_position". */
export type ArrayName = ArrayKind;

/** The history of a snapshot, for a list of operations. */
export interface History {
  /** Operations that can be undone, from the first to the last. */
  done: HistoryEntry[];
  /** Operations that can be redone, in that order. */
  undone: HistoryEntry[];
  /** Names of checkpoints. */
  checkpoints: string[];
}

export class Snapshot extends Owned {
  private readonly views = new Map<number, ArrayView>();

  /** Takes over a reference of the C interface. */
  constructor(readonly mvs: Mvs, handle: number) {
    const { c } = mvs;
    super("snapshot", handle, () => c.mvs_snapshot_release(handle));
  }

  /**
   * An array without a copy: a view of the module's memory, with its number of rows and columns. It
   * is valid while the snapshot is held.
   */
  view(which: ArrayName | number): ArrayView {
    const number = enumNumber("mvs_array_kind", which, "array");
    let view = this.views.get(number);
    if (!view) {
      view = this.mvs.c.mvs_snapshot_get_array(this.handle, number).ownedBy(this);
      this.views.set(number, view);
    }
    return view;
  }

  /**
   * The numbers of an array, without a copy, rows one after the other.
   *
   * Read-only: writing to it changes the valve of the simulator and of other snapshots, and may stop the module. Change
   * `array(name).slice()` or `copy(name)`. Ask again after any call that may allocate: a view dies when the memory grows, and
   * asking costs nothing. The array keeps the snapshot from the garbage collector, unlike its `buffer` and `subarray()`; after
   * dispose() it must not be used.
   */
  array<K extends ArrayName>(which: K): ReadonlyArrayOf<ArrayTypes[K]>;
  /** The same with the type that the caller states, for a number or a computed name. */
  array<T extends TypedArray = Float64Array>(which: ArrayName | number): T;
  array(which: ArrayName | number): unknown {
    void this.handle;
    return this.view(which).values;
  }

  /** A copy of an array, which may be changed, and transferred to another thread. */
  copy<K extends ArrayName>(which: K): ArrayTypes[K];
  copy<T extends TypedArray = Float64Array>(which: ArrayName | number): T;
  copy(which: ArrayName | number): unknown {
    void this.handle;
    return this.view(which).copy();
  }

  /** The name of the valve. */
  get name(): string {
    return this.mvs.c.mvs_snapshot_get_name(this.handle);
  }

  /** The 128-bit hash of model and state, 32 hexadecimal digits: that of the native library. */
  get hash(): string {
    return this.mvs.c.mvs_snapshot_get_hash(this.handle).map((word) => word.toString(16).padStart(16, "0")).join("");
  }

  /** Simulated time, s. */
  get time(): number {
    return this.array("state_time")[0]!;
  }

  get load(): LoadCase {
    return this.mvs.c.mvs_snapshot_get_load(this.handle);
  }

  get rest(): Rest {
    return this.mvs.c.mvs_snapshot_get_rest(this.handle);
  }

  /** Parts of a kind, in the order of their rows. */
  parts(kind: PartKind): Part[] {
    const { c } = this.mvs;
    const count = c.mvs_snapshot_get_part_count(this.handle, kind);
    return Array.from({ length: count }, (_, k) => c.mvs_snapshot_get_part(this.handle, kind, k));
  }

  /** The part of a kind with a name, or of an id. */
  part(kind: PartKind, name: string | bigint): Part {
    if (typeof name === "string") return this.mvs.c.mvs_snapshot_find_part(this.handle, kind, name);
    return this.parts(kind).find((part) => part.id === name) ?? refuse(kind, `the valve has no ${kind} of the id ${name}`);
  }

  /** All chord segments in words and figures. */
  chords(): ChordInfo[] {
    const count = this.view("chord_id").count;
    return Array.from({ length: count }, (_, k) => this.mvs.c.mvs_snapshot_get_chord(this.handle, k));
  }

  /** Measures by their names in SI units; of some groups only, the others NaN. */
  measure(...groups: (MeasureGroupFlags | number)[]): Measures {
    const { c } = this.mvs;
    if (groups.length === 0) return c.mvs_snapshot_measure(this.handle);
    const bits = groups.reduce((sum: number, group) => sum | enumNumber("mvs_measure_group_flags", group, "group"), 0);
    return c.mvs_snapshot_measure_groups(this.handle, bits);
  }

  /** Measures of the scallops and commissures. */
  regions(): RegionMeasures[] {
    const { c } = this.mvs;
    return Array.from({ length: c.mvs_snapshot_get_region_count(this.handle) }, (_, k) => c.mvs_snapshot_get_region(this.handle, k));
  }

  /** Parts of the regurgitant orifice, the largest first; none for a sealed valve. */
  orificeParts(): OrificePart[] {
    const { c } = this.mvs;
    return Array.from({ length: c.mvs_snapshot_get_orifice_part_count(this.handle) }, (_, k) => c.mvs_snapshot_get_orifice_part(this.handle, k));
  }

  stability(): Stability {
    return this.mvs.c.mvs_snapshot_get_stability(this.handle);
  }

  /** Origin, AP axis, CC axis and axis into the atrium: rows of three. */
  frame(): { origin: number[]; ap: number[]; cc: number[]; atrium: number[] } {
    const f = this.mvs.c.mvs_snapshot_get_frame(this.handle);
    return { origin: f.slice(0, 3), ap: f.slice(3, 6), cc: f.slice(6, 9), atrium: f.slice(9, 12) };
  }

  /** Cost of a repair, and the valve opened in diastole, which the caller disposes of. */
  cost(options?: CostOptions & { progress?: ProgressCallback | null }): { cost: Cost; opened: Snapshot } {
    const { cost, opened } = this.mvs.c.mvs_snapshot_measure_cost(this.handle, options);
    return { cost, opened: new Snapshot(this.mvs, opened) };
  }

  compare(other: Snapshot): Comparison {
    return this.mvs.c.mvs_snapshot_compare(this.handle, snapshotHandle(this.mvs, other, "other"));
  }

  /** Intersection with a plane: segments as pairs of points, 6 numbers each, m. */
  section(point: ArrayLike<number>, normal: ArrayLike<number>): Float64Array {
    return this.mvs.c.mvs_snapshot_section(this.handle, point, normal);
  }

  history(): History {
    const { c } = this.mvs;
    const size = c.mvs_snapshot_get_history(this.handle);
    const entry = (k: number): HistoryEntry => c.mvs_snapshot_get_history_entry(this.handle, k);
    return {
      done: Array.from({ length: size.done }, (_, k) => entry(k)),
      undone: Array.from({ length: size.undone }, (_, k) => entry(size.done + k)),
      checkpoints: Array.from({ length: size.checkpoints }, (_, k) => c.mvs_snapshot_get_checkpoint(this.handle, k)),
    };
  }

  /** Instruments in the valve. */
  tools(): ToolState[] {
    const { c } = this.mvs;
    return Array.from({ length: c.mvs_snapshot_get_tool_count(this.handle) }, (_, k) => c.mvs_snapshot_get_tool(this.handle, k));
  }

  /** The bodies of the convex tool at an index of tools(); empty for others. Their views are valid while the snapshot is. */
  toolBodies(index: number): ToolBody[] {
    const { c } = this.mvs;
    const count = c.mvs_snapshot_get_tool(this.handle, index).body_count;
    return Array.from({ length: count }, (_, k) => {
      const body = c.mvs_snapshot_get_tool_body(this.handle, index, k);
      for (const value of Object.values(body)) if (value instanceof ArrayView) value.ownedBy(this);
      return body;
    });
  }

  /** The bytes of a file with this valve: "obj" is read back exactly; "vtp" and "feb" are for others. */
  save(format: Format = "obj"): Uint8Array {
    return this.mvs.c.mvs_save_memory(this.handle, format);
  }

  /** The text of its OBJ file. */
  toObj(): string {
    return new TextDecoder().decode(this.save("obj"));
  }

  /** The text of the plan, from the valve that was set or loaded to this snapshot. */
  plan(options?: PlanOptions): string {
    return new TextDecoder().decode(this.mvs.c.mvs_write_plan(this.handle, options));
  }

  /** Closes the valve along several loading paths: the spread of the results. `load` as in Simulator.setLoad(). */
  ensemble(load: LoadCaseInput = {}, options?: EnsembleOptions, settle?: SettleOptions): Ensemble {
    return new Ensemble(this.mvs, this.mvs.c.mvs_ensemble_run(this.handle, loadWithDefaults(load), settle, options));
  }

  /** The nearest leaflet, chord or papillary head that a ray meets; undefined where it meets none. */
  pick(ray: Ray): Picked | undefined {
    return pick(this, ray);
  }
}

/** The handle of a snapshot that was passed as an argument; another object, or one of another module, is refused. */
export function snapshotHandle(mvs: Mvs, value: Snapshot, what: string): number {
  if (!(value instanceof Snapshot)) return refuse(what, `${what} is ${Owned.describe(value)}: it has to be a Snapshot`);
  if (value.mvs !== mvs) return refuse(what, `${what} belongs to another module: save() it there and load() the bytes here`);
  return value.handle;
}
