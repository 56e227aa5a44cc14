// The file of the closed leaflets beside the surface of an import: read once as it is chosen, so that a file that is none of a
// surface is refused at once.
import { t } from '../text/texts';
import { run } from './requests';
import * as state from './state';

/** Takes a file for the closed leaflets of the surface that is shown; one that cannot be read leaves those before. */
export async function takeClosed(file: File): Promise<void> {
  const { value: before } = state.imported;
  if (!before) return;
  const closed = { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) };
  const triangles = await run(t.reading, 'read_closed', { ...closed, unit: before.surface.unit });
  const { value: now } = state.imported;
  // another surface may have come meanwhile
  if (triangles === null || now?.bytes !== before.bytes) return;
  state.imported.value = { ...now, closed };
  state.status.value = t.closedRead(file.name, triangles);
}
