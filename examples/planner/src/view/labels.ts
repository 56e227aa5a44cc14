// Names over the picture: scallops, papillary heads, the chosen chord, as HTML text at projected places.
import * as state from '../store/state';
import { percentOfLimit, shareOfLimit } from '../notable';
import { markTexts } from '../text/texts';
import { cutScallops } from './cut';
import { boxAt, Callout, overlap, placesAround, type Box, type Line } from './callout';
import { clipPlace } from './clip';
import { headFlare, headLength, headRadius } from './heart';
import { point } from './mesh';
import { pickSurface } from './pick';
import type { Topology } from '../protocol';
import type { CutPlane } from './renderer';
import type { Viewport } from './viewport';
import { visiblePlaces } from './visible';

interface Label {
  text: string;
  /** Its place in the valve, mm; of a scallop the pixel. */
  at: number[];
  kind: 'scallop' | 'head' | 'chord' | 'handle';
  chosen?: boolean;
}

/** A label on the screen: its element, the pixel that it names, and the size of its words. */
interface Placed {
  label: Label;
  element: HTMLElement;
  at: [number, number];
  size: { width: number; height: number };
}

/** One label for all heads of a papillary muscle: AL1, AL2 and AL3 are AL; the chosen head has its own. */
function headLabels(topology: Topology, x: Float32Array): Label[] {
  const choice = state.choice.value;
  const muscles = new Map<string, number[][]>();
  let named = '';
  topology.headNodes.forEach((node, h) => {
    const { id, name: own } = topology.heads[h];
    const chosen = choice?.kind === 'head' && choice.id === id;
    if (chosen) named = own;
    const name = chosen ? own : own.replace(/\d+$/, '') || own;
    muscles.set(name, [...(muscles.get(name) ?? []), [0, 1, 2].map((c) => x[3 * node + c])]);
  });
  return [...muscles].map(([text, places]) => ({
    text,
    kind: 'head',
    chosen: text === named,
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

/** Pixels between the middle of a handle and its name, and across the ball of a handle. */
const besideHandle = 24;
const ball = 26;

/** How far a name may stand from its place to avoid other labels, in heights and half widths of its words. */
const reach = { chosen: 4, other: 2 };

const farOf = ({ chosen }: Label): number => (chosen ? reach.chosen : reach.other);

/** The order in which names take their places. */
const rank = ({ chosen, kind }: Label): number => (chosen ? 0 : kind === 'head' ? 1 : 2);

export class Labels {
  private layer: HTMLElement;
  private elements: HTMLElement[] = [];
  private readonly leader: HTMLElement;
  private readonly callout = new Callout();
  private readonly sizes = new Map<string, { width: number; height: number }>();

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
    return [...handleLabels(view, topology, x), ...names, ...chordLabel(topology, x)];
  }

  /** Whether a leaflet lies between the eye and a place, or a section cuts it away. */
  private hidden(view: Viewport, at: number[], px: number, py: number): boolean {
    const plane = view.plane();
    if (plane && isBefore(plane, at)) return true;
    const picture = state.picture.value!;
    const topology = state.topologyOf(picture)!;
    const { camera, width, height } = view;
    const hit = pickSurface(camera, topology, picture.positions, px, py, width, height, plane);
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

  /** The size of a label's words, which is measured once. */
  private sizeOf(element: HTMLElement): { width: number; height: number } {
    const key = `${element.className} ${element.textContent}`;
    let size = this.sizes.get(key);
    if (!size) {
      element.hidden = false;
      size = { width: element.offsetWidth, height: element.offsetHeight };
      if (this.sizes.size > 200) this.sizes.clear();
      this.sizes.set(key, size);
    }
    return size;
  }

  update(view: Viewport): void {
    const labels = this.wanted(view);
    this.leader.hidden = true;
    while (this.elements.length > labels.length) this.elements.pop()!.remove();
    const placed = labels.map((label, k): Placed => {
      const [x, y, z] = label.at;
      const [px, py] =
        label.kind === 'scallop' ? label.at : view.camera.project(x, y, z, view.width, view.height);
      const element = this.elementOf(k, label);
      return { label, element, at: [px, py], size: this.sizeOf(element) };
    });
    const of = (...kinds: Label['kind'][]) => placed.filter(({ label }) => kinds.includes(label.kind));
    const taken: Box[] = of('handle').map(({ at }) => boxAt(at, { width: ball, height: ball }));
    for (const { element, at } of of('handle')) this.besideHandle(view, element, at, taken);
    const names = of('head', 'scallop').filter(
      ({ label, at }) => label.kind === 'scallop' || !this.hidden(view, label.at, ...at),
    );
    for (const one of of('head')) one.element.hidden = !names.includes(one);
    const wished = [...taken, ...names.map(({ at, size }) => boxAt(at, size))];
    for (const one of of('chord')) taken.push(this.callOut(view, one.element, one.at, wished));
    // the label of the chosen part stays in its place; the others give way to it
    names.sort((a, b) => rank(a.label) - rank(b.label));
    const scallops = names.filter(({ label }) => label.kind === 'scallop');
    const muscles = this.musclesUnder(view, scallops);
    for (const one of names) this.putName(one, taken, scallops.includes(one) ? muscles : []);
  }

  /** The papillary muscles that are seen where a scallop's name may stand: it would be read as that of the muscle. */
  private musclesUnder(view: Viewport, names: Placed[]): Box[] {
    const picture = state.picture.value;
    const topology = picture && state.topologyOf(picture);
    if (!topology || !names.length) return [];
    const boxes = names.flatMap(({ label, at, size }) =>
      placesAround(at, size, farOf(label)).map((one) => boxAt(one, size)),
    );
    const { camera, width, height } = view;
    const up = view.frameOf().slice(9, 12);
    const half = (headRadius(topology) * headFlare) / camera.scale(height);
    return Array.from(topology.headNodes).flatMap((node) => {
      const at = point(picture.positions, node);
      const ends = [at, at.map((v, c) => v - headLength * up[c])].map(([x, y, z]) =>
        camera.project(x, y, z, width, height),
      );
      const [xs, ys] = [0, 1].map((axis) => ends.map((end) => end[axis]));
      const [x, y] = [Math.min(...xs) - half, Math.min(...ys) - half];
      const box = { x, y, width: Math.max(...xs) + half - x, height: Math.max(...ys) + half - y };
      const meets = boxes.some((other) => overlap(other, box));
      return meets && !this.hidden(view, at, ends[0][0], ends[0][1]) ? [box] : [];
    });
  }

  /** A name stands at its place, beside it where another label is there, or nowhere. */
  private putName({ label, element, at, size }: Placed, taken: Box[], muscles: Box[]): void {
    const place = placesAround(at, size, farOf(label)).find(
      (one) => ![...taken, ...muscles].some((other) => overlap(other, boxAt(one, size))),
    );
    element.hidden = !place && !label.chosen;
    const [x, y] = place ?? at;
    if (!element.hidden) taken.push(boxAt([x, y], size));
    element.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -50%)`;
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
  private callOut(view: Viewport, element: HTMLElement, at: [number, number], taken: Box[]): Box {
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
    return boxAt([x, y], size);
  }
}

/** Whether a place is on the side of a plane that is not drawn. */
const isBefore = ({ normal, offset }: CutPlane, at: number[]): boolean =>
  normal.reduce((sum, v, c) => sum + v * at[c], 0) > offset;

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
