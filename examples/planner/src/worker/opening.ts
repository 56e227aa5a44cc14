// How far a closed valve opens in diastole.
import type { Snapshot } from 'libmvs';
import type { Cost } from '../protocol';
import { ml, mm, mm2, mmHg } from './units';

/** The valve opened beside the plan; the gradient of a flow in ml/s, if one is given. */
export function openingOf(snapshot: Snapshot, flow: number): Cost {
  const asked = flow > 0 ? { residual: 1e-4, flow: flow / ml } : { residual: 1e-4 };
  const { cost, opened } = snapshot.cost(asked);
  opened.dispose();
  return {
    hash: snapshot.hash,
    openArea: cost.open_area * mm2,
    anteriorLength: cost.anterior_length * mm,
    posteriorLength: cost.posterior_length * mm,
    lengthRatio: cost.length_ratio,
    annulusForce: cost.annulus_force_sum,
    gradient: cost.gradient / mmHg,
  };
}
