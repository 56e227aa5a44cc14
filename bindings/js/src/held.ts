// Registry of the handles of the C interface that are not released yet, in which handles that are passed are looked up.
import { refuse } from "./error.js";

export class HeldHandles {
  /** Their number, by the function that releases them. */
  readonly counts = new Map<string, number>();
  private readonly byAddress = new Map<number, { of: string; count: number }>();

  /** A reference to an object of the type `of` in C. */
  add(of: string, freedBy: string, handle: number): number {
    this.counts.set(freedBy, (this.counts.get(freedBy) ?? 0) + 1);
    const known = this.byAddress.get(handle);
    if (known) ++known.count;
    else this.byAddress.set(handle, { of, count: 1 });
    return handle;
  }

  remove(freedBy: string, handle: number): void {
    this.counts.set(freedBy, (this.counts.get(freedBy) ?? 0) - 1);
    const known = this.byAddress.get(handle);
    if (known && --known.count === 0) this.byAddress.delete(handle);
  }

  /** Refuses a value that is no handle of the type `of`, or one that was released. */
  check(of: string, value: unknown, what: string): number {
    if (typeof value !== "number" || this.byAddress.get(value)?.of !== of) {
      const kind = of.replace("mvs_", "").replace(/_/g, " ");
      const found = typeof value === "object" ? "an object" : String(value);
      return refuse(what, `${what} is ${found}: it has to be the handle of a ${kind} that this module still holds`);
    }
    return value;
  }
}
