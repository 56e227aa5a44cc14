// The mean gradient of the flow that the user gives; without a flow no gradient is shown, for the flow of a patient is not known here.
import type { Cost } from '../protocol';
import * as state from './state';

/** mmHg above which a gradient after a repair is too much. */
const most = 5;

/** mmHg of an opening that was measured; null without one or without a flow. */
export function gradientOf(cost: Cost | null): number | null {
  const flow = state.flow.value;
  return cost && flow ? cost.resistance * flow ** 2 : null;
}

export const isTooMuch = (gradient: number | null): boolean => gradient !== null && gradient > most;
