// The largest force out of balance of each valve that a settle led to: the library keeps that of the last settle only, and the page says it
// of a valve that did not come to rest, also after an undo.
import { MvsError, type Simulator } from 'libmvs';
import { Recent } from '../recent';

/** Valves that are remembered: more than the steps of a plan. */
const most = 500;

const residuals = new Recent<number>(most);

/** Remembers it for the valve as the last settle of a simulator left it. A repeated plan may have ended without one. */
export function keepResidual(sim: Simulator): void {
  try {
    const { residual } = sim.stats();
    residuals.set(
      sim.read(({ hash }) => hash),
      residual,
    );
  } catch (error) {
    if (!(error instanceof MvsError && error.code === 'MVS_E_STATE')) throw error;
  }
}

/** N; undefined where no settle is known. */
export const residualOf = (hash: string): number | undefined => residuals.get(hash);
