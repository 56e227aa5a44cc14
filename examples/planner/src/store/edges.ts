// How high the free edge of each scallop of the shown valve stands.
import { computed } from '@preact/signals';
import { edgeHeights } from '../flail';
import * as state from './state';

/** mm of the highest point of each scallop's free edge above the plane of the annulus, by its name. */
export const shownEdges = computed((): Map<string, number> => {
  const shown = state.shown.value;
  const topology = shown && state.topologyOf(shown.picture);
  return topology ? edgeHeights(topology, shown.picture, shown.figures.frame) : new Map();
});
