// A map that keeps the entries that were used last. The worker sends the connectivity of a valve once and the page keeps
// it: every preview of a cut or of a new chord has one of its own, of some 100 kB.
/** Topologies that the worker takes for known to the page. */
export const mostSent = 32;
/** Those that the page keeps: more, as both may have used them in another order. */
export const mostKept = 2 * mostSent;

export class Recent<Value> {
  private readonly entries = new Map<string, Value>();

  constructor(private readonly most: number) {}

  get size(): number {
    return this.entries.size;
  }

  /** The entry, which is then the one that was used last. */
  get(key: string): Value | undefined {
    const value = this.entries.get(key);
    if (value !== undefined) this.set(key, value);
    return value;
  }

  set(key: string, value: Value): void {
    this.entries.delete(key);
    this.entries.set(key, value);
    for (const oldest of this.entries.keys()) {
      if (this.entries.size <= this.most) return;
      this.entries.delete(oldest);
    }
  }
}
