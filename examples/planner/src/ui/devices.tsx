// Rings, bands, clips, artificial chordae and sutures as a table: the twin of what the picture shows of them.
import { clipOf, cutOf, suture } from '../notable';
import * as state from '../store/state';
import { clipIn, deviceTexts, tipTexts } from '../text/texts';
import type { Chord, Figures, Picture, Topology } from '../protocol';
import { armReach, clipBodies } from '../view/clips';
import { isClosed, ringCurves } from '../view/heart';
import { Section } from './parts';

interface Device {
  name: string;
  figures: string;
}

/** Largest extents along CC and AP and the length of a ring's curve; the length of a band. */
function ringFigures(points: number[][], frame: number[]): string {
  if (points.length < 2) return '';
  const extent = (row: number) => {
    const places = points.map((p) => p.reduce((sum, v, c) => sum + v * frame[3 * row + c], 0));
    return Math.max(...places) - Math.min(...places);
  };
  const distance = (a: number[], b: number[]) => Math.hypot(...a.map((v, c) => v - b[c]));
  let length = 0;
  for (let k = 1; k < points.length; ++k) length += distance(points[k - 1], points[k]);
  const gap = distance(points[0], points[points.length - 1]);
  if (!isClosed(points)) return deviceTexts.band(length);
  return deviceTexts.ring(extent(2), extent(1), length + gap);
}

/** Stitches by the clip or the cut that they belong to. */
function stitchesBy(figures: Figures, of: (name: string) => string): [string, Chord[]][] {
  const found = new Map<string, Chord[]>();
  for (const chord of figures.chords) {
    const name = chord.kind === suture ? of(chord.name) : '';
    if (name) found.set(name, [...(found.get(name) ?? []), chord]);
  }
  return [...found];
}

/** Scallops at the ends of stitches, each once. */
const scallopsOf = (stitches: Chord[]): string[] => [
  ...new Set(stitches.flatMap(({ scallops }) => scallops.split('+'))),
];

function devicesOf(topology: Topology, picture: Picture, figures: Figures): Device[] {
  const { names, named } = deviceTexts;
  const rings = ringCurves(picture).map((curve, r) => ({
    name: named(isClosed(curve) ? names.ring : names.band, topology.rings[r].name),
    figures: ringFigures(curve, figures.frame),
  }));
  const bodies = clipBodies(topology, picture, figures.frame);
  const clips = stitchesBy(figures, clipOf).map(([name, stitches]) => ({
    name: named(names.clip, name),
    figures: deviceTexts.clip({
      between: scallopsOf(stitches),
      set: clipIn(name, figures.clips),
      apart: 2 * (bodies.get(name)?.half ?? 0),
      pull: Math.max(...stitches.map(({ tension }) => tension)),
      arm: armReach,
    }),
  }));
  const neochordae = figures.chords
    .filter((chord) => chord.artificial && chord.kind !== suture)
    .map((chord) => ({ name: named(names.neochord, chord.name), figures: deviceTexts.neochord(chord) }));
  const cuts = stitchesBy(figures, cutOf).map(([, stitches]) => ({
    name: names.suture,
    figures: deviceTexts.suture(scallopsOf(stitches)),
  }));
  return [...rings, ...clips, ...neochordae, ...cuts];
}

export function Devices({ figures }: { figures: Figures }) {
  const picture = state.shown.value?.picture;
  const topology = picture && state.topologyOf(picture);
  const devices = picture && topology ? devicesOf(topology, picture, figures) : [];
  if (!devices.length) return null;
  return (
    <Section title={deviceTexts.title(devices.length)} tip={tipTexts.devices} name="devices" open>
      <table class="table" data-testid="devices">
        <thead>
          <tr>
            <th>{deviceTexts.device}</th>
            <th>{deviceTexts.figures}</th>
          </tr>
        </thead>
        <tbody>
          {devices.map((device) => (
            <tr class="wrap">
              <th scope="row">{device.name}</th>
              <td>{device.figures}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </Section>
  );
}
