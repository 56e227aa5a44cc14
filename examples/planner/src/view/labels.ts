// Names over the picture: scallops, papillary heads, the chosen chord, as HTML text at projected places.
import * as state from '../store/state';
import { figure, markTexts } from '../text/texts';
import { clipPlace } from './clip';
import { pickSurface } from './pick';
import type { Topology } from '../protocol';
import type { Viewport } from './viewport';

interface Label {
  text: string;
  at: number[];
  kind: string;
}

/** One label for all heads of a papillary muscle: AL1, AL2 and AL3 are AL. */
function headLabels(topology: Topology, x: Float32Array): Label[] {
  const muscles = new Map<string, number[][]>();
  topology.headNodes.forEach((node, h) => {
    const name = topology.heads[h].name.replace(/\d+$/, '') || topology.heads[h].name;
    muscles.set(name, [...(muscles.get(name) ?? []), [0, 1, 2].map((c) => x[3 * node + c])]);
  });
  return [...muscles].map(([text, places]) => ({
    text,
    kind: 'head',
    at: [0, 1, 2].map((c) => places.reduce((sum, place) => sum + place[c], 0) / places.length),
  }));
}

/** Names of what is dragged: the section plane, the clip of the form and its turn. */
function handleLabels(view: Viewport): Label[] {
  const labels: Label[] = [];
  if (state.sectionOn.value) labels.push({ text: markTexts.plane, at: view.handle(), kind: 'handle' });
  const clip = clipPlace();
  if (clip)
    labels.push(
      { text: markTexts.clip, at: clip.at, kind: 'handle' },
      { text: markTexts.turn(clip.angle), at: clip.handle, kind: 'handle' },
    );
  return labels;
}

/** mm behind the leaflets at which a label is still shown: its place is the mean of a curved scallop. */
const tolerance = 4;

export class Labels {
  private layer: HTMLElement;
  private elements: HTMLElement[] = [];

  constructor(host: HTMLElement) {
    this.layer = document.createElement('div');
    this.layer.className = 'labels';
    this.layer.setAttribute('aria-hidden', 'true');
    host.append(this.layer);
  }

  private wanted(view: Viewport): Label[] {
    const picture = state.picture.value;
    const topology = picture && state.topologyOf(picture);
    const importing = state.imported.value && !state.imported.value.findings.length;
    if (!picture || !topology || importing) return [];
    const x = picture.positions;
    const labels: Label[] = [];
    if (state.labelsOn.value) {
      labels.push(...headLabels(topology, x));
      const sums = topology.scallops.map(() => [0, 0, 0, 0]);
      for (let i = 0; i < topology.triangles.length; ++i) {
        const sum = sums[topology.triangleScallop[Math.floor(i / 3)]];
        for (let c = 0; c < 3; ++c) sum[c] += x[3 * topology.triangles[i] + c];
        sum[3] += 1;
      }
      topology.scallops.forEach((part, s) => {
        const [a, b, c, n] = sums[s];
        if (n) labels.push({ text: part.name, at: [a / n, b / n, c / n], kind: 'scallop' });
      });
    }
    const choice = state.choice.value;
    const named = state.added.value?.id ?? (choice?.kind === 'chord' ? choice.id : '');
    const k = topology.chords.findIndex((part) => part.id === named);
    if (k >= 0) {
      const [a, b] = [topology.chordNodes[2 * k], topology.chordNodes[2 * k + 1]];
      const at = [0, 1, 2].map((c) => 0.5 * (x[3 * a + c] + x[3 * b + c]));
      const chord = (state.preview.value ?? state.main.value)?.figures.chords[k];
      const text = chord ? `${chord.name}  ${figure(chord.rest)} mm` : topology.chords[k].name;
      labels.push({ text, at, kind: 'chord' });
    }
    return [...labels, ...handleLabels(view)];
  }

  /** Whether a leaflet lies between the eye and a place. */
  private hidden(view: Viewport, at: number[], px: number, py: number): boolean {
    const picture = state.picture.value!;
    const topology = state.topologyOf(picture)!;
    const hit = pickSurface(
      view.camera,
      topology,
      picture.positions,
      px,
      py,
      view.width,
      view.height,
      view.plane(),
    );
    const eye = view.camera.position();
    return !!hit && Math.hypot(at[0] - eye.x, at[1] - eye.y, at[2] - eye.z) > hit.distance + tolerance;
  }

  update(view: Viewport): void {
    const labels = this.wanted(view);
    const taken: [number, number][] = [];
    while (this.elements.length > labels.length) this.elements.pop()!.remove();
    labels.forEach((label, k) => {
      let element = this.elements[k];
      if (!element) {
        element = document.createElement('span');
        this.layer.append(element);
        this.elements[k] = element;
      }
      if (element.textContent !== label.text) element.textContent = label.text;
      element.className = `label label-${label.kind}`;
      const [px, py] = view.camera.project(label.at[0], label.at[1], label.at[2], view.width, view.height);
      // a scallop gives way to labels in front of it
      const covered = label.kind === 'scallop' && taken.some(([x, y]) => Math.hypot(x - px, y - py) < 24);
      const always = label.kind === 'chord' || label.kind === 'handle';
      element.hidden = !always && (covered || this.hidden(view, label.at, px, py));
      if (!element.hidden) taken.push([px, py]);
      element.style.transform = `translate(${px.toFixed(1)}px, ${py.toFixed(1)}px) translate(${label.kind === 'handle' ? '24px' : '-50%'}, -50%)`;
    });
  }
}
