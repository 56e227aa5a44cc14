// Names over the picture: scallops, papillary heads, the chosen chord, as HTML text at projected places.
import * as state from '../store/state';
import { figure } from '../text/texts';
import { Shapes, type Mesh } from './mesh';
import type { Mark } from './scene';
import { tissue } from './colours';
import type { Viewport } from './viewport';

interface Label {
  text: string;
  at: number[];
  kind: string;
}

export class Labels {
  private layer: HTMLElement;
  private elements: HTMLElement[] = [];

  constructor(host: HTMLElement) {
    this.layer = document.createElement('div');
    this.layer.className = 'labels';
    this.layer.setAttribute('aria-hidden', 'true');
    host.append(this.layer);
  }

  markMesh(marks: Mark[], handle: number[] | null): Mesh {
    const shapes = new Shapes();
    for (const mark of marks) shapes.sphere(mark.at, mark.radius, mark.colour);
    if (handle) shapes.sphere(handle, 1.6, tissue.chosen);
    return shapes.mesh({ overlay: true });
  }

  private wanted(): Label[] {
    const picture = state.picture.value;
    const topology = picture && state.topologyOf(picture);
    if (!picture || !topology) return [];
    const x = picture.positions;
    const labels: Label[] = [];
    if (state.labelsOn.value) {
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
      topology.headNodes.forEach((node, h) =>
        labels.push({ text: topology.heads[h].name, at: [0, 1, 2].map((c) => x[3 * node + c]), kind: 'head' }),
      );
    }
    const choice = state.choice.value;
    const k = choice?.kind === 'chord' ? topology.chords.findIndex((part) => part.id === choice.id) : -1;
    if (k >= 0) {
      const [a, b] = [topology.chordNodes[2 * k], topology.chordNodes[2 * k + 1]];
      const at = [0, 1, 2].map((c) => 0.5 * (x[3 * a + c] + x[3 * b + c]));
      const chord = (state.preview.value ?? state.main.value)?.figures.chords[k];
      const text = chord ? `${chord.name}  ${figure(chord.rest)} mm` : topology.chords[k].name;
      labels.push({ text, at, kind: 'chord' });
    }
    return labels;
  }

  update(view: Viewport): void {
    const labels = this.wanted();
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
      element.style.transform = `translate(${px.toFixed(1)}px, ${py.toFixed(1)}px) translate(-50%, -50%)`;
    });
  }
}
