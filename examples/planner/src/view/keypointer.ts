// A cross that the arrow keys move over the picture while a place in it is asked for: by the form, by the outline of a
// resection, or by an import. Space clicks there.
import * as state from '../store/state';
import type { Topology } from '../protocol';
import { pointTexts } from '../text/texts';
import { click } from './click';
import type { Place } from './drags';
import { removeOutlinePoint, useOutline } from './outline';
import type { Hit } from './pick';
import type { Viewport } from './viewport';

/** Pixels of a step, and with Shift. */
const step = 12;
const fine = 2;

const arrows: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

/** Whether a click in the picture answers a question. */
function asked(): boolean {
  return !!state.picking.value || !!state.surface.value;
}

/** The type of the field that a click fills; an outline is made of places on the leaflet. */
function askedType(): string {
  if (state.picking.value === 'outline') return 'site';
  const info = state.operationOf(state.draft.value?.kind);
  return info?.fields.find((field) => field.name === state.picking.value)?.type ?? '';
}

/** The name of the part that a click would take, or of another part there. */
function nameUnder(hit: Hit, topology: Topology, type: string): string {
  const chord = hit.chord >= 0 ? topology.chords[hit.chord].name : '';
  const head = hit.head >= 0 ? topology.heads[hit.head].name : '';
  const scallop = hit.surface ? topology.scallops[topology.triangleScallop[hit.surface.triangle]].name : '';
  const wanted = type === 'head' ? head : type === 'chord' ? chord : scallop;
  return wanted || (hit.part === 'head' ? head : chord) || scallop;
}

export class KeyPointer {
  private at: Place | null = null;
  private readonly cross = document.createElement('span');

  constructor(
    private readonly view: Viewport,
    private readonly hit: (p: Place) => Hit | null,
  ) {
    this.cross.className = 'cross';
    this.cross.hidden = true;
    this.cross.setAttribute('aria-hidden', 'true');
    view.host.append(this.cross);
    const hide = (): void => {
      if (!asked()) this.hide();
    };
    state.picking.subscribe((field) => {
      hide();
      // the card that opened the form is gone: its keys go to the picture
      if (field) requestAnimationFrame(() => this.takeFocus());
    });
    state.imported.subscribe(hide);
  }

  private takeFocus(): void {
    if (!state.picking.value || (document.activeElement ?? document.body) !== document.body) return;
    this.view.renderer.canvas.focus({ preventScroll: true, focusVisible: false } as FocusOptions);
  }

  private hide(): void {
    this.at = null;
    this.cross.hidden = true;
  }

  /** Takes a key; false if it is not for the cross. */
  key(event: KeyboardEvent): boolean {
    if (!asked() || event.ctrlKey || event.metaKey || event.altKey) return false;
    const arrow = arrows[event.key];
    const drawing = state.picking.value === 'outline';
    if (arrow) this.move(arrow, event.shiftKey ? fine : step);
    else if (event.key === ' ' && this.at) this.press();
    else if (event.key === 'Backspace' && drawing) removeOutlinePoint();
    else if (event.key === 'Enter' && drawing && state.outline.value.length > 1) useOutline();
    else return false;
    return true;
  }

  private move([x, y]: [number, number], by: number): void {
    const { width, height } = this.view;
    const from = this.at ?? this.start();
    const within = (value: number, size: number) => Math.min(size - 1, Math.max(0, value));
    this.at = { x: within(from.x + by * x, width), y: within(from.y + by * y, height) };
    this.cross.hidden = false;
    // in a narrow window the form stands below the picture
    this.view.renderer.canvas.scrollIntoView({ block: 'nearest' });
    this.cross.style.transform = `translate(${this.at.x}px, ${this.at.y}px) translate(-50%, -50%)`;
    this.say();
  }

  /** P2 where it is seen, else the middle of the picture. */
  private start(): Place {
    const { width, height, camera } = this.view;
    const picture = state.picture.value;
    const topology = picture && state.topologyOf(picture);
    const s = topology?.scallops.findIndex((part) => part.name === 'P2') ?? -1;
    if (this.view.surface || !topology || s < 0) return { x: width / 2, y: height / 2 };
    const sum = [0, 0, 0];
    let count = 0;
    topology.triangles.forEach((node, i) => {
      if (topology.triangleScallop[Math.floor(i / 3)] !== s) return;
      for (let c = 0; c < 3; ++c) sum[c] += picture.positions[3 * node + c];
      ++count;
    });
    const [x, y] = camera.project(sum[0] / count, sum[1] / count, sum[2] / count, width, height);
    return { x, y };
  }

  private press(): void {
    click(this.view, this.at!, this.hit(this.at!));
    this.say();
    this.view.moved();
  }

  /** Names the part under the cross, for those who cannot see it. */
  private say(): void {
    const picture = state.picture.value;
    const topology = picture && state.topologyOf(picture);
    if (!this.at || !topology || !state.picking.value) return;
    const hit = this.hit(this.at);
    const what = hit ? nameUnder(hit, topology, askedType()) : '';
    const count = state.picking.value === 'outline' ? state.outline.value.length : null;
    state.status.value = pointTexts.under(what, count);
  }
}
