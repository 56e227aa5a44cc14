// Names over the picture: scallops, papillary heads, the chosen chord, as HTML text at projected places.
import * as state from '../store/state';
import { percentOfLimit, shareOfLimit } from '../notable';
import { markTexts } from '../text/texts';
import { cutScallops } from './cut';
import { Callout, overlap, type Box, type Line } from './callout';
import { clipPlace } from './clip';
import { pickSurface } from './pick';
import type { Topology } from '../protocol';
import type { Viewport } from './viewport';
import { visiblePlaces } from './visible';

interface Label {
  text: string;
  /** Its place in the valve, mm; of a scallop the pixel. */
  at: number[];
  kind: 'scallop' | 'head' | 'chord' | 'handle';
  chosen?: boolean;
}

/** One label for all heads of a papillary muscle: AL1, AL2 and AL3 are AL; the chosen head has its own. */
function headLabels(topology: Topology, x: Float32Array): Label[] {
  const choice = state.choice.value;
  const muscles = new Map<string, number[][]>();
  topology.headNodes.forEach((node, h) => {
    const { id, name: own } = topology.heads[h];
    const name = choice?.kind === 'head' && choice.id === id ? own : own.replace(/\d+$/, '') || own;
    muscles.set(name, [...(muscles.get(name) ?? []), [0, 1, 2].map((c) => x[3 * node + c])]);
  });
  return [...muscles].map(([text, places]) => ({
    text,
    kind: 'head',
    at: [0, 1, 2].map((c) => places.reduce((sum, place) => sum + place[c], 0) / places.length),
  }));
}

/** Names of the handles: the section plane, the clip of the form and its turn. */
function handleLabels(view: Viewport, topology: Topology, x: Float32Array): Label[] {
  const labels: Label[] = [];
  const plane = view.plane();
  if (plane) {
    const through = cutScallops(topology, x, plane);
    labels.push({ text: markTexts.plane(through, state.sectionAt.value), at: view.handle(), kind: 'handle' });
  }
  const clip = clipPlace();
  if (clip)
    labels.push(
      { text: markTexts.clip, at: clip.at, kind: 'handle' },
      { text: markTexts.turn(clip.angle), at: clip.handle, kind: 'handle' },
    );
  return labels;
}

/** Names of the scallops where they are seen. */
function scallopLabels(view: Viewport, topology: Topology, x: Float32Array): Label[] {
  const choice = state.choice.value;
  const places = visiblePlaces(view, topology, x);
  return topology.scallops.flatMap((part, s) => {
    const at = places[s];
    const chosen = choice?.kind === 'scallop' && choice.id === part.id;
    return at ? [{ text: part.name, at, kind: 'scallop', chosen }] : [];
  });
}

/** The name of the chosen or added chord with its length, and its load where that is beyond the limit. */
function chordLabel(topology: Topology, x: Float32Array): Label[] {
  const choice = state.choice.value;
  const named = state.added.value?.id ?? (choice?.kind === 'chord' ? choice.id : '');
  const k = topology.chords.findIndex((part) => part.id === named);
  if (k < 0) return [];
  const [a, b] = [topology.chordNodes[2 * k], topology.chordNodes[2 * k + 1]];
  const at = [0, 1, 2].map((c) => 0.5 * (x[3 * a + c] + x[3 * b + c]));
  const chord = state.figures.value?.chords[k];
  const load = chord?.over ? percentOfLimit(shareOfLimit(chord)) : null;
  const text = chord
    ? markTexts.chord(chord.name, chord.rest, load, chord.artificial)
    : topology.chords[k].name;
  return [{ text, at, kind: 'chord' }];
}

/** mm behind the leaflets at which the name of a papillary muscle is still shown. */
const tolerance = 4;

/** Pixels between the middle of a handle and its name. */
const besideHandle = 24;

export class Labels {
  private layer: HTMLElement;
  private elements: HTMLElement[] = [];
  private readonly leader: HTMLElement;
  private readonly callout = new Callout();

  constructor(host: HTMLElement) {
    this.layer = document.createElement('div');
    this.layer.className = 'labels';
    this.layer.setAttribute('aria-hidden', 'true');
    this.leader = document.createElement('div');
    this.leader.className = 'leader';
    this.layer.append(this.leader);
    host.append(this.layer);
  }

  private wanted(view: Viewport): Label[] {
    const picture = state.picture.value;
    const topology = picture && state.topologyOf(picture);
    if (!picture || !topology || state.surface.value) return [];
    const x = picture.positions;
    const names = state.labelsOn.value
      ? [...headLabels(topology, x), ...scallopLabels(view, topology, x)]
      : [];
    // names of handles first: those of tissue give way to them
    return [...handleLabels(view, topology, x), ...names, ...chordLabel(topology, x)];
  }

  /** Whether a leaflet lies between the eye and a place. */
  private hidden(view: Viewport, { at }: Label, px: number, py: number): boolean {
    const picture = state.picture.value!;
    const topology = state.topologyOf(picture)!;
    const { camera, width, height } = view;
    const hit = pickSurface(camera, topology, picture.positions, px, py, width, height, view.plane());
    const eye = camera.position();
    return !!hit && Math.hypot(at[0] - eye.x, at[1] - eye.y, at[2] - eye.z) > hit.distance + tolerance;
  }

  private elementOf(k: number, label: Label): HTMLElement {
    let element = this.elements[k];
    if (!element) {
      element = document.createElement('span');
      this.layer.append(element);
      this.elements[k] = element;
    }
    if (element.textContent !== label.text) element.textContent = label.text;
    element.className = `label label-${label.kind}${label.chosen ? ' label-chosen' : ''}`;
    return element;
  }

  update(view: Viewport): void {
    const labels = this.wanted(view);
    const taken: Box[] = [];
    this.leader.hidden = true;
    while (this.elements.length > labels.length) this.elements.pop()!.remove();
    labels.forEach((label, k) => {
      const element = this.elementOf(k, label);
      const tissue = label.kind === 'scallop';
      const [px, py] = tissue
        ? label.at
        : view.camera.project(label.at[0], label.at[1], label.at[2], view.width, view.height);
      if (label.kind === 'chord') return this.callOut(view, element, [px, py], taken);
      // a scallop gives way to labels in front of it
      const covered =
        tissue &&
        taken.some(({ x, y, width, height }) => Math.hypot(x + width / 2 - px, y + height / 2 - py) < 32);
      element.hidden = covered || (label.kind === 'head' && this.hidden(view, label, px, py));
      if (label.kind === 'handle') return this.besideHandle(view, element, [px, py], taken);
      if (!element.hidden) taken.push({ x: px - 12, y: py - 9, width: 24, height: 18 });
      element.style.transform = `translate(${px.toFixed(1)}px, ${py.toFixed(1)}px) translate(-50%, -50%)`;
    });
  }

  /** The name of a handle stands on its right, or on its left where the picture ends or another name is there. */
  private besideHandle(view: Viewport, element: HTMLElement, [px, py]: [number, number], taken: Box[]): void {
    element.hidden = false;
    const [width, height] = [element.offsetWidth, element.offsetHeight];
    const box = (left: boolean): Box => ({
      x: left ? px - besideHandle - width : px + besideHandle,
      y: py - height / 2,
      width,
      height,
    });
    const isFree = (left: boolean) =>
      !taken.some((other) => overlap(other, box(left))) &&
      box(left).x >= 0 &&
      box(left).x + width <= view.width;
    const left = px + besideHandle + width > view.width || (!isFree(false) && isFree(true));
    taken.push(box(left));
    const beside = left ? `calc(-100% - ${besideHandle}px)` : `${besideHandle}px`;
    element.style.transform = `translate(${px.toFixed(1)}px, ${py.toFixed(1)}px) translate(${beside}, -50%)`;
  }

  /** The label of a chord stands beside all chordae, at the end of a line. */
  private callOut(view: Viewport, element: HTMLElement, at: [number, number], taken: Box[]): void {
    element.hidden = false;
    const size = { x: 0, y: 0, width: element.offsetWidth, height: element.offsetHeight };
    const picture = { x: 0, y: 0, width: view.width, height: view.height };
    const [x, y] = this.callout.place(at, size, chordLines(view), taken, picture);
    element.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -50%)`;
    const [dx, dy] = [x - at[0], y - at[1]];
    // the line ends at the border of the label
    const inside = Math.min(
      size.width / 2 / (Math.abs(dx) || 1e-9),
      size.height / 2 / (Math.abs(dy) || 1e-9),
    );
    const length = Math.hypot(dx, dy) * Math.max(0, 1 - inside);
    this.leader.hidden = false;
    this.leader.style.width = `${length.toFixed(1)}px`;
    this.leader.style.transform = `translate(${at[0].toFixed(1)}px, ${at[1].toFixed(1)}px) rotate(${Math.atan2(dy, dx).toFixed(4)}rad)`;
  }
}

/** All chordae on the screen. */
function chordLines(view: Viewport): Line[] {
  const picture = state.picture.value!;
  const { chordNodes } = state.topologyOf(picture)!;
  const place = (node: number) => {
    const x = picture.positions;
    return view.camera.project(x[3 * node], x[3 * node + 1], x[3 * node + 2], view.width, view.height);
  };
  const lines: Line[] = [];
  for (let k = 0; k < chordNodes.length; k += 2) {
    const [a, b] = [place(chordNodes[k]), place(chordNodes[k + 1])];
    lines.push([a[0], a[1], b[0], b[1]]);
  }
  return lines;
}
