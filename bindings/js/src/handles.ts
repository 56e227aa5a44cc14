/// <reference lib="esnext.disposable" />
// Objects of the library that JavaScript holds: released by dispose(), by `using`, or when the
// garbage collector finds them unreachable.
import { MvsError } from "./error.js";

// Node 18 has no Symbol.dispose: `using` in compiled code looks for this one.
(Symbol as { dispose?: symbol }).dispose ??= Symbol("Symbol.dispose");

type Release = () => void;
const forgotten = new FinalizationRegistry<Release>((release) => {
  try {
    release();
  } catch {
    // the module has stopped: its memory goes with it
  }
});

export abstract class Owned {
  private release: Release | undefined;

  /** `release` must not refer to this object, or it is never collected. */
  protected constructor(
    /** "snapshot" */
    private readonly what: string,
    private readonly address: number,
    release: Release,
  ) {
    this.release = release;
    forgotten.register(this, release, this);
  }

  /** The address in the module, for the functions of the C interface (`Mvs.c`). */
  get handle(): number {
    if (!this.release) throw new MvsError("MVS_E_STATE", this.what, `this ${this.what} was disposed of`);
    return this.address;
  }

  /** Words for an object in a sentence: "a snapshot of another module". */
  static describe(value: unknown): string {
    if (value instanceof Owned) return `a ${value.what}`;
    return typeof value === "object" && value !== null ? "another object" : String(value);
  }

  get isDisposed(): boolean {
    return !this.release;
  }

  /** Releases the memory now. Safe to repeat. */
  dispose(): void {
    if (!this.release) return;
    this.release();
    this.release = undefined;
    forgotten.unregister(this);
  }

  [Symbol.dispose](): void {
    this.dispose();
  }
}
