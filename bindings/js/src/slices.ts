// Settles in slices: one at a time, with the event loop running in between.
import { knownOptions, MvsError, refuse } from "./error.js";
import type { SettleOptions, Stats } from "./generated/structs.js";
import { layoutOf } from "./layout.js";

/** A settle in slices, for a thread that has to answer in between. */
export interface SliceOptions extends SettleOptions {
  /** s, length of a slice, which lasts at least one iteration [0.02]. */
  slice?: number;
  /** Receives the completed share after every slice. */
  onProgress?: (share: number) => void;
  /** Cancels the settle between two slices. */
  signal?: AbortSignal;
}

const sliceOptions = ["slice", "onProgress", "signal", ...layoutOf("mvs_settle_options").fields.map((field) => field.name)];

/** A settle in slices that is under way. */
interface Settle {
  /** Why it ended before its time. */
  ended?: string;
}

/** The part of a simulator that settles in slices. */
interface Sliced {
  readonly handle: number;
  readonly isDisposed: boolean;
  beginSettle(options?: SettleOptions): void;
  advanceSettle(seconds: number): { share: number; stats: Stats };
  cancelSettle(): void;
}

/** Lets the event loop run: messages and timers that wait are served. */
function breathe(): Promise<void> {
  return new Promise((resolve) => {
    if (typeof setImmediate === "function") {
      setImmediate(resolve);
      return;
    }
    const channel = new MessageChannel();
    channel.port1.onmessage = () => {
      channel.port1.close();
      resolve();
    };
    channel.port2.postMessage(0);
  });
}

const cancelled = (why: string): MvsError => new MvsError("MVS_E_CANCELLED", "settle", `the settle was cancelled: ${why}`);

function mustBeOptions(options: SliceOptions): void {
  knownOptions(options, sliceOptions, "options");
  const { slice = 0.02, onProgress, signal } = options;
  if (typeof slice !== "number" || !(slice >= 0 && slice <= 3600)) refuse("options.slice", `options.slice is ${String(slice)}: it has to be 0 to 3600 s`);
  if (onProgress !== undefined && typeof onProgress !== "function") refuse("options.onProgress", "options.onProgress is not a function");
  if (signal !== undefined && typeof (signal as AbortSignal | null)?.aborted !== "boolean") refuse("options.signal", "options.signal is not an AbortSignal");
}

// One slice: without a settle under way, another call has changed the valve.
function advance(sim: Sliced, seconds: number): { share: number; stats: Stats } {
  void sim.handle; // throws after dispose()
  try {
    return sim.advanceSettle(seconds);
  } catch (error) {
    if (error instanceof MvsError && error.code === "MVS_E_STATE") throw cancelled("another call has changed the valve");
    throw error;
  }
}

/** The settle in slices of one simulator: the promise of each ends with its own result, or with the reason of its end. */
export class Slices {
  private current: Settle | undefined;

  /** Ends the settle that is under way: its promise is rejected when its loop resumes. */
  end(why: string): void {
    if (this.current) this.current.ended = why;
    this.current = undefined;
  }

  async settle(sim: Sliced, options: SliceOptions): Promise<Stats> {
    mustBeOptions(options);
    const { slice = 0.02, onProgress, signal, ...settle } = options;
    const aborted = "by its signal; it has changed nothing";
    if (signal?.aborted) throw cancelled(aborted);
    sim.beginSettle(settle);
    const mine: Settle = {};
    this.current = mine;
    try {
      for (;;) {
        const { share, stats } = advance(sim, slice);
        if (share >= 1) this.current = undefined;
        onProgress?.(share);
        if (share >= 1) return stats;
        await breathe();
        if (signal?.aborted) throw cancelled(mine.ended ?? aborted);
        if (mine.ended) throw cancelled(mine.ended);
      }
    } catch (error) {
      // another settle may be under way by now: it is not this one's to cancel
      if (this.current === mine && !sim.isDisposed) sim.cancelSettle();
      throw error;
    }
  }
}
