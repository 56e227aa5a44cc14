// Rings, bands, clips and artificial chordae as a table: the twin of what the picture shows of them.
import { clipOf, suture } from '../notable';
import * as state from '../store/state';
import { deviceTexts, tipTexts } from '../text/texts';
import type { Figures, Picture, Topology } from '../protocol';
import { isClosed } from '../view/heart';
import { Section } from './parts';

interface Device {
  name: string;
  figures: string;
}

/** Largest extents along CC and AP and the length of a ring's curve; the length of a band. */
function ringFigures(picture: Picture, r: number, frame: number[]): string {
  const points: number[][] = [];
  for (let k = picture.ringStart[r]; k < picture.ringStart[r + 1]; ++k)
    points.push([0, 1, 2].map((c) => picture.ringPoints[3 * k + c]));
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

/** The stitches of each clip. */
function clips(figures: Figures): Device[] {
  const stitches = new Map<string, number[]>();
  for (const chord of figures.chords) {
    const name = clipOf(chord.name);
    if (chord.kind !== suture || !name) continue;
    stitches.set(name, [...(stitches.get(name) ?? []), chord.tension]);
  }
  return [...stitches].map(([name, pulls]) => ({
    name,
    figures: deviceTexts.clip(pulls.length, Math.max(...pulls)),
  }));
}

function devicesOf(topology: Topology, picture: Picture, figures: Figures): Device[] {
  const rings = topology.rings.map((part, r) => ({
    name: part.name,
    figures: ringFigures(picture, r, figures.frame),
  }));
  const neochordae = figures.chords
    .filter((chord) => chord.artificial && chord.kind !== suture)
    .map((chord) => ({ name: chord.name, figures: deviceTexts.neochord(chord) }));
  return [...rings, ...clips(figures), ...neochordae];
}

export function Devices({ figures }: { figures: Figures }) {
  const picture = state.shown.value?.picture;
  const topology = picture && state.topologyOf(picture);
  const devices = picture && topology ? devicesOf(topology, picture, figures) : [];
  if (!devices.length) return null;
  return (
    <Section title={deviceTexts.title(devices.length)} tip={tipTexts.devices} open>
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
