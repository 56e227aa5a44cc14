// Marks over the picture: points that were clicked on an imported surface, the outline of a resection, the clip of
// the form, the handle of the section plane.
import * as state from '../store/state';
import { armLength, clipPlace, type ClipPlace } from './clip';
import { tissue } from './colours';
import { Shapes, type Colour, type Mesh } from './mesh';
import { wholeOutline } from './outline';

const colours: Record<keyof state.Imported['points'], Colour> = {
  annulus: tissue.annulus,
  commissures: tissue.chosen,
  anterior: tissue.over,
  tips: tissue.head,
};

function importMarks(shapes: Shapes, imported: state.Imported): void {
  for (const [kind, points] of Object.entries(imported.points))
    for (const at of points) shapes.sphere(at, kind === 'tips' ? 1.4 : 0.9, colours[kind as 'annulus']);
}

function outlineMarks(shapes: Shapes): void {
  const points = wholeOutline();
  for (const at of state.outline.value) shapes.sphere(at, 0.45, tissue.chosen);
  for (let k = 1; k < points.length; ++k) shapes.tube(points[k - 1], points[k], 0.2, tissue.chosen);
}

/** The place on the leaflet of the chord that the preview adds. */
function addedEnd(): Float32Array | null {
  const picture = state.preview.value?.picture;
  const topology = picture && state.topologyOf(picture);
  const k = topology?.chords.findIndex((part) => part.id === state.added.value?.id) ?? -1;
  if (!topology || k < 0) return null;
  const node = topology.chordNodes[2 * k + 1];
  return picture.positions.subarray(3 * node, 3 * node + 3);
}

/** The handles of the clip of the form: the ball that slides it, the one that turns it; its arms, where the picture has no body of it. */
function clipMarks(shapes: Shapes, { at, arm, handle, drawn }: ClipPlace): void {
  const end = (by: number) => at.map((v, c) => v + by * arm[c]);
  if (!drawn) shapes.tube(end(-armLength), end(armLength), 0.55, tissue.suture);
  shapes.tube(drawn ? at : end(armLength), handle, 0.15, tissue.chosen);
  shapes.sphere(at, 1.1, tissue.chosen);
  shapes.sphere(handle, 0.9, tissue.chosen);
}

/** All marks of the moment as one mesh, or null. */
export function marksMesh(handle: number[] | null): Mesh | null {
  const shapes = new Shapes();
  if (state.surface.value) importMarks(shapes, state.surface.value);
  if (state.picking.value === 'outline') outlineMarks(shapes);
  const end = addedEnd();
  if (end) shapes.sphere(end, 0.8, tissue.chosen);
  const clip = clipPlace();
  if (clip) clipMarks(shapes, clip);
  if (handle) shapes.sphere(handle, 1.6, tissue.chosen);
  const mesh = shapes.mesh({ overlay: true });
  return mesh.index.length ? mesh : null;
}
