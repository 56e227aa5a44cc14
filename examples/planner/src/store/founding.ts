// Valves that a valve of the tour is compared with: its healthy original, and a repair of it.
import { shippedVertices } from '../shipped';
import type { FoundingResult } from '../protocol';
import { fail, request } from './requests';
import * as state from './state';

/** The healthy valve of the tour, the same for all its valves: known from the first moment of the second one. */
let healthyValve: FoundingResult['healthy'] | null = null;

/** The part of the founding study that is known without a computation. */
export const knownFounding = (): FoundingResult | null => (healthyValve ? { healthy: healthyValve } : null);

function learn(number: number, founding: FoundingResult): void {
  if (state.tour.value?.number === number) state.tour.value = { ...state.tour.value, founding };
}

/** Calculates what the valve of the tour that is open is compared with: two requests, between which a preview has its turn. */
export async function learnFounding(number: number): Promise<void> {
  const known = state.tour.value?.founding?.repaired;
  try {
    const healthy = await request('founding_healthy', { vertices: shippedVertices });
    healthyValve = healthy;
    learn(number, { healthy, repaired: known });
    if (known) return;
    learn(number, {
      healthy,
      repaired: await request('founding_repair', { number, vertices: shippedVertices }),
    });
  } catch (error) {
    fail(error);
  }
}
