// How high the free edge of each scallop of the shown valve stands.
import { edgeHeight } from '../flail';
import * as state from './state';

/** mm of the highest point of each scallop's free edge above the plane of the annulus, by its name. */
export function shownEdges(): Map<string, number> {
  const shown = state.shown.value;
  const topology = shown && state.topologyOf(shown.picture);
  if (!shown || !topology) return new Map();
  const { picture, figures } = shown;
  return new Map(
    topology.scallops
      .map(({ name }): [string, number] => [name, edgeHeight(topology, picture, figures.frame, name)])
      .filter(([, height]) => Number.isFinite(height)),
  );
}
