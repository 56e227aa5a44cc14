// Warnings of the library while a valve is loaded, changed and closed, and the load of a file: they go to the page with the valve.
import { SYSTOLE_PA, type Mvs, type Simulator } from 'libmvs';
import { mmHg } from './units';

/** mmHg: the load of a closed valve in a file, where it is another one than systole; an open valve has none to be closed under. */
export function otherLoad({ loadCase: { pressure } }: Simulator): number | undefined {
  return pressure > 0 && Math.abs(pressure / SYSTOLE_PA - 1) > 0.01 ? pressure / mmHg : undefined;
}

/** That it did not come to rest, and chordae without force, are in the figures of a valve. */
const known = /^settle: |^chord .* carries no force/;

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
