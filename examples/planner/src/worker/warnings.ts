// Warnings of the library while a valve is loaded, changed and closed: they go to the page with the valve.
import type { Mvs, Simulator } from 'libmvs';

/** That it did not come to rest is in the figures of a valve. */
const known = /^settle: /;

export class Warnings {
  private readonly said = new Set<string>();

  /** A simulator whose warnings are noted. */
  simulator(mvs: Mvs): Simulator {
    return mvs.simulator({
      log: (level, text) => {
        if (level === 'warning' && !known.test(text)) this.said.add(text);
      },
    });
  }

  /** Those since the last call, each once. */
  take(): string[] {
    const all = [...this.said];
    this.said.clear();
    return all;
  }
}
