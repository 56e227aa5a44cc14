// The simulator: a valve with its load, settled and stepped, operated on, pushed and pulled.
import type { LogCallback, ProgressCallback } from "./arrays.js";
import { refuse } from "./error.js";
import type { Backend, Format } from "./generated/enums.js";
import type {
  BuildOptions, Coarsening, CoarsenOptions, LeafletDesc, LoadCase, LoadCaseInput, Finding as HeldFinding, ParametricDesc, Profile, Replay,
  SettleOptions, Stats, StepOptions, SurfaceDesc, ToolDesc, ToolState, ValveDesc,
} from "./generated/structs.js";
import { Owned } from "./handles.js";
import { whole } from "./layout.js";
import type { Mvs } from "./library.js";
import { OperationWriter, type FieldsOf, type NameOf, type PartRef } from "./operations.js";
import { Slices, type SliceOptions } from "./slices.js";
import { loadWithDefaults, Snapshot, snapshotHandle, SYSTOLE_PA } from "./snapshot.js";

export { SYSTOLE_PA };
/** 5 mmHg in Pa: the default pressure difference that opens the valve in diastole. */
export const DIASTOLE_PA = 666.61;

export interface SimulatorOptions {
  backend?: Backend;
  log?: LogCallback;
  /** Called during long calls; returning true cancels the call, which throws MVS_E_CANCELLED. */
  progress?: ProgressCallback;
}

/** A finding of a build: `values` is a copy. */
export type Finding = Omit<HeldFinding, "values"> & { values: Float64Array };

export class Simulator extends Owned {
  private readonly slices = new Slices();

  constructor(readonly mvs: Mvs, options: SimulatorOptions = {}) {
    const { c } = mvs;
    const handle = c.mvs_create(options);
    super("simulator", handle, () => c.mvs_destroy(handle));
  }

  /** Replaces the valve by a parametric one [the default valve]. */
  generateValve(desc?: ParametricDesc): void {
    this.mvs.c.mvs_generate_valve(this.handle, desc);
  }

  /** Replaces the valve by one described by arrays. */
  setValve(valve: ValveDesc): void {
    this.mvs.c.mvs_set_valve(this.handle, valve);
  }

  /** Replaces the valve by one built from a patient's surface; returns the findings and guesses. */
  buildValve(surface: SurfaceDesc, options?: BuildOptions): Finding[] {
    const { c } = this.mvs;
    const findings = c.mvs_build_valve(this.handle, surface, options);
    try {
      return Array.from({ length: c.mvs_findings_get_count(findings) }, (_, k) => {
        const finding = c.mvs_findings_get(findings, k);
        return { ...finding, values: finding.values.copy() as Float64Array };
      });
    } finally {
      c.mvs_findings_release(findings);
    }
  }

  /** Changes the tissue of a leaflet, of all where `leaflet` is null. */
  setLeaflet(leaflet: PartRef | null, tissue: Omit<LeafletDesc, "name" | "id">): void {
    if (leaflet === undefined) refuse("leaflet", "leaflet is missing: give its name or id, or null for all leaflets");
    const id = typeof leaflet === "string" ? this.findPart("leaflet", leaflet) : (leaflet ?? 0n);
    this.mvs.c.mvs_set_leaflet(this.handle, id, tissue);
  }

  /** Loads the bytes of a file: "obj" or "inp"; "auto" is "obj", as bytes have no name. */
  load(data: Uint8Array | string, format: Format = "auto"): void {
    this.mvs.c.mvs_load_memory(this.handle, data, format);
  }

  /**
   * Sets the load for the next settle or step: `pressure` [SYSTOLE_PA], and `boundary_fraction`, the position of annulus and heads
   * from 0, open, to 1, loaded [1]. Nothing moves yet.
   */
  setLoad(load: LoadCaseInput = {}): void {
    this.mvs.c.mvs_set_load(this.handle, loadWithDefaults(load));
  }

  get loadCase(): LoadCase {
    return this.mvs.c.mvs_get_load(this.handle);
  }

  /** Moves the valve to stable static equilibrium. `converged` is 0 where it did not come to rest. */
  settle(options?: SettleOptions): Stats {
    return this.mvs.c.mvs_settle(this.handle, options);
  }

  /** Begins a settle in slices; one that is under way is replaced: the promise of its settleInSlices() is rejected. */
  beginSettle(options?: SettleOptions): void {
    this.mvs.c.mvs_begin_settle(this.handle, options);
    this.slices.end("replaced by a new settle");
  }

  /** Advances it for `seconds`, and at least by one iteration; `share` is 1 at the end, and `stats` are those of the settle then. */
  advanceSettle(seconds: number): { share: number; stats: Stats } {
    return this.mvs.c.mvs_advance_settle(this.handle, seconds);
  }

  /** Cancels the settle in slices that is under way, if there is one: its promise is rejected with MVS_E_CANCELLED. */
  cancelSettle(): void {
    this.mvs.c.mvs_cancel_settle(this.handle);
    this.slices.end("by cancelSettle(); it has changed nothing");
  }

  /**
   * Settles in slices with the event loop running in between; the result has the same bits as that of
   * settle(). A slice lasts at least one iteration of Newton's method: hundreds of milliseconds with 3,000
   * vertices. The promise is rejected with MVS_E_CANCELLED if the signal aborts, after cancelSettle(), when
   * another settle begins, and when another call changes the valve in between.
   */
  settleInSlices(options: SliceOptions = {}): Promise<Stats> {
    return this.slices.settle(this, options);
  }

  /** Advances by time steps of bounded work. */
  step(options?: StepOptions, count = 1): void {
    whole(count, "count");
    for (let k = 0; k < count; ++k) this.mvs.c.mvs_step(this.handle, options);
  }

  /** Does now what the first step from here would do for the steps after it, and changes nothing else. */
  prepareStep(options?: StepOptions): void {
    this.mvs.c.mvs_prepare_step(this.handle, options);
  }

  /** Statistics of the last settle or step. */
  stats(): Stats {
    return this.mvs.c.mvs_get_stats(this.handle);
  }

  profile(): Profile {
    return this.mvs.c.mvs_get_profile(this.handle);
  }

  /** The valve and state after the last finished call, without copying arrays. Dispose of it. */
  snapshot(): Snapshot {
    return new Snapshot(this.mvs, this.mvs.c.mvs_get_snapshot(this.handle));
  }

  /**
   * Calls `read` with a snapshot, which is disposed of afterwards. Arrays of it are valid within the call only: return copies.
   * The function has to end without waiting for a promise.
   */
  read<T>(read: (snapshot: Snapshot) => T): T {
    const snapshot = this.snapshot();
    try {
      return read(snapshot);
    } finally {
      snapshot.dispose();
    }
  }

  restore(snapshot: Snapshot): void {
    this.mvs.c.mvs_restore(this.handle, snapshotHandle(this.mvs, snapshot, "snapshot"));
  }

  /** Throws what apply() would throw; nothing changes. */
  check<N extends string>(operation: NameOf<N>, fields: FieldsOf<N> = {} as FieldsOf<N>): void {
    this.mvs.c.mvs_check_op(this.handle, this.operation(operation, fields));
  }

  /** Applies an operation by its name; returns the id of the part that it made, or 0n. */
  apply<N extends string>(operation: NameOf<N>, fields: FieldsOf<N> = {} as FieldsOf<N>): bigint {
    return this.mvs.c.mvs_apply_op(this.handle, this.operation(operation, fields));
  }

  undo(): void {
    this.mvs.c.mvs_undo(this.handle);
  }

  redo(): void {
    this.mvs.c.mvs_redo(this.handle);
  }

  /** Operations of `work`, which must not be async, are undone and redone together; a failure in it undoes them. */
  group<T>(name: string, work: () => T): T {
    const { c } = this.mvs;
    const before = this.snapshot();
    try {
      c.mvs_begin_group(this.handle, name);
      let result: T;
      try {
        result = work();
        if (typeof (result as { then?: unknown } | undefined | null)?.then === "function") {
          refuse("work", "work returns a promise: a group has the operations of a function that does not wait");
        }
      } catch (error) {
        c.mvs_end_group(this.handle);
        this.restore(before);
        throw error;
      }
      c.mvs_end_group(this.handle);
      return result;
    } finally {
      before.dispose();
    }
  }

  setCheckpoint(name: string): void {
    this.mvs.c.mvs_set_checkpoint(this.handle, name);
  }

  restoreCheckpoint(name: string): void {
    this.mvs.c.mvs_restore_checkpoint(this.handle, name);
  }

  /** Adds an instrument; returns its id. */
  addTool(tool: ToolDesc): bigint {
    return this.mvs.c.mvs_add_tool(this.handle, tool);
  }

  /** Grasps a node, with the hand at its place or at `position`. */
  grasp(node: number, options: Omit<ToolDesc, "kind" | "by_node" | "node"> = {}): bigint {
    const position = options.position ?? this.read((snapshot) => Array.from(snapshot.array("node_position").slice(3 * node, 3 * node + 3)));
    return this.addTool({ ...options, kind: "grasp", by_node: 1, node, position });
  }

  /** Moves the hand of a tool; the next settle or step takes it there. */
  moveTool(tool: bigint, position: ArrayLike<number>, axis?: ArrayLike<number>): void {
    this.mvs.c.mvs_move_tool(this.handle, tool, position, axis);
  }

  /** The same with an orientation, w x y z of a quaternion, which a convex tool or rod takes. */
  moveToolPose(tool: bigint, position: ArrayLike<number>, orientation?: ArrayLike<number>): void {
    this.mvs.c.mvs_move_tool_pose(this.handle, tool, position, orientation);
  }

  removeTool(tool: bigint): void {
    this.mvs.c.mvs_remove_tool(this.handle, tool);
  }

  tool(tool: bigint): ToolState {
    return this.mvs.c.mvs_get_tool(this.handle, tool);
  }

  /** Replays the text of a plan: completely, or not at all. */
  replayPlan(plan: string | Uint8Array): Replay {
    return this.mvs.c.mvs_replay_plan(this.handle, plan);
  }

  /** Checks whether replayPlan would apply every operation. */
  checkPlan(plan: string | Uint8Array): Replay {
    return this.mvs.c.mvs_check_plan(this.handle, plan);
  }

  refine(): void {
    this.mvs.c.mvs_refine_valve(this.handle);
  }

  coarsen(options: CoarsenOptions): Coarsening {
    return this.mvs.c.mvs_coarsen_valve(this.handle, options);
  }

  transferState(from: Snapshot): void {
    this.mvs.c.mvs_transfer_state(this.handle, snapshotHandle(this.mvs, from, "from"));
  }

  private operation(name: string, fields: object): ReturnType<OperationWriter["make"]> {
    const writer = new OperationWriter(this.mvs.operations, (kind, part) => this.findPart(kind, part));
    return writer.make(name, fields);
  }

  private findPart(kind: "leaflet" | "chord" | "head" | "scallop", name: string): bigint {
    return this.read((snapshot) => snapshot.part(kind, name).id);
  }
}
