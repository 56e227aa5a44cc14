// How far a closed valve opens in diastole.
import type { Snapshot } from 'libmvs';
import type { Cost } from '../protocol';
import { restResidual } from '../units';
import { ml, mm, mm2, mmHg } from './units';

/** ml/s; any flow tells the gradient of all others. */
const someFlow = 100;

/** The valve opened beside the plan. */
export function costOf(snapshot: Snapshot): Cost {
  const { cost, opened } = snapshot.cost({ residual: restResidual, flow: someFlow / ml });
  opened.dispose();
  return {
    hash: snapshot.hash,
    openArea: cost.open_area * mm2,
    anteriorLength: cost.anterior_length * mm,
    posteriorLength: cost.posterior_length * mm,
    lengthRatio: cost.length_ratio,
    annulusForce: cost.annulus_force_sum,
    resistance: cost.gradient / mmHg / someFlow ** 2,
  };
}
