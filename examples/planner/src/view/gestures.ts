// The pointer in the picture: turn, pan, zoom with mouse or fingers, keys; presses that hit a part are drags and
// clicks of their own (drags.ts, click.ts).
import { percentOfLimit, shareOfLimit } from '../notable';
import * as state from '../store/state';
import { gestureTexts, repairTexts } from '../text/texts';
import { click } from './click';
import {
  dragAt,
  dragChord,
  dragClip,
  dragHand,
  dragHandle,
  dropHand,
  turnClip,
  type Drag,
  type Place,
} from './drags';
import { KeyPointer } from './keypointer';
import { atrialSide } from './leaflets';
import { pick, type Hit } from './pick';
import { shownFields } from './shown';
import type { Viewport } from './viewport';

/** Pixels from a chord that still pick it: a mouse is more exact than a finger. */
const reachOf = (event: PointerEvent): number => (event.pointerType === 'touch' ? 24 : 9);
/** Pixels of motion below which a press is a click. */
const clickMotion = 5;

export class Gestures {
  private pointers = new Map<number, Place>();
  private start = { x: 0, y: 0 };
  private travelled = 0;
  private drag: Drag = { kind: 'turn' };
  private readonly cross: KeyPointer;

  constructor(private readonly view: Viewport) {
    const { canvas } = view.renderer;
    canvas.addEventListener('pointerdown', (event) => this.down(event));
    canvas.addEventListener('pointermove', (event) => this.move(event));
    canvas.addEventListener('pointerup', (event) => this.up(event));
    canvas.addEventListener('pointercancel', (event) => this.up(event));
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    canvas.addEventListener('keydown', (event) => this.key(event));
    this.cross = new KeyPointer(view, (p) => this.hit(p, 9));
  }

  private place(event: PointerEvent): Place {
    const box = this.view.renderer.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  private hit(p: Place, reach: number): Hit | null {
    if (this.view.surface || state.inPast.value) return null;
    const picture = state.picture.value;
    const topology = picture && state.topologyOf(picture);
    if (!picture || !topology) return null;
    const { camera, width, height } = this.view;
    camera.update();
    const frame = this.view.frameOf();
    const { value: chordsOn } = state.chordsOn;
    const plane = this.view.plane();
    const drawn = atrialSide(topology, picture, shownFields()).positions;
    return pick({ camera, topology, picture, drawn, frame, width, height, chordsOn, plane }, p.x, p.y, reach);
  }

  private down(event: PointerEvent): void {
    const p = this.place(event);
    this.view.renderer.canvas.setPointerCapture(event.pointerId);
    this.view.renderer.canvas.focus({ preventScroll: true, focusVisible: false } as FocusOptions);
    this.pointers.set(event.pointerId, p);
    if (this.pointers.size > 1) {
      this.drag = { kind: 'pan' };
      return;
    }
    this.start = p;
    this.travelled = 0;
    this.drag =
      event.button === 2 || event.button === 1 || event.shiftKey
        ? { kind: 'pan' }
        : dragAt(this.view, p, reachOf(event), this.hit(p, reachOf(event)));
  }

  private move(event: PointerEvent): void {
    const p = this.place(event);
    const old = this.pointers.get(event.pointerId);
    if (!old) {
      this.hover(p, event);
      return;
    }
    if (this.pointers.size === 2) this.pinch(event.pointerId, p);
    this.pointers.set(event.pointerId, p);
    if (this.pointers.size > 1) return;
    const [dx, dy] = [p.x - old.x, p.y - old.y];
    this.travelled = Math.max(this.travelled, Math.hypot(p.x - this.start.x, p.y - this.start.y));
    if (this.travelled < clickMotion && this.drag.kind !== 'hand') return;
    const { camera } = this.view;
    if (this.drag.kind === 'turn') camera.rotate((dx / this.view.height) * 4, (dy / this.view.height) * 4);
    else if (this.drag.kind === 'pan') camera.pan(dx, dy, this.view.height);
    else if (this.drag.kind === 'handle') dragHandle(this.view, dx, dy);
    else if (this.drag.kind === 'clip') dragClip(this.view, this.drag, dx, dy);
    else if (this.drag.kind === 'turn-clip') turnClip(this.view, p);
    else if (this.drag.kind === 'chord') dragChord(this.view, this.drag, this.start, p);
    else if (this.drag.kind === 'hand') dragHand(this.view, this.drag.depth, p);
    this.view.moved();
  }

  private hover(p: Place, event: PointerEvent): void {
    if (event.buttons || state.motion.value) return;
    const hit = this.hit(p, reachOf(event));
    const canvas = this.view.renderer.canvas;
    const picture = state.picture.value;
    const figures = (state.preview.value ?? state.main.value)?.figures;
    canvas.style.cursor =
      hit?.part === 'chord' || hit?.part === 'head'
        ? 'pointer'
        : state.tool.value === 'look'
          ? 'grab'
          : 'crosshair';
    if (!hit || !picture || !figures) return;
    const chord = hit.part === 'chord' ? figures.chords[hit.chord] : null;
    const limited = chord && Number.isFinite(chord.tensionLimit);
    const percent = limited ? percentOfLimit(shareOfLimit(chord)) : null;
    const head = hit.part === 'head' ? state.topologyOf(picture)?.heads[hit.head].name : '';
    canvas.title = chord ? gestureTexts.chord({ ...chord, percent }) : head ? repairTexts.head(head) : '';
  }

  private pinch(id: number, p: Place): void {
    const [other] = [...this.pointers].filter(([key]) => key !== id).map(([, value]) => value);
    const old = this.pointers.get(id)!;
    const distance = (a: Place) => Math.hypot(a.x - other.x, a.y - other.y) || 1;
    this.view.camera.zoom(distance(old) / distance(p));
    this.view.camera.pan((p.x - old.x) / 2, (p.y - old.y) / 2, this.view.height);
    const angle = Math.atan2(p.y - other.y, p.x - other.x) - Math.atan2(old.y - other.y, old.x - other.x);
    this.view.camera.roll(Math.abs(angle) < 1 ? angle : 0);
    this.travelled = 100;
    this.view.moved();
  }

  private up(event: PointerEvent): void {
    const p = this.place(event);
    if (!this.pointers.delete(event.pointerId)) return;
    const { drag } = this;
    if (drag.kind === 'hand') {
      this.drag = { kind: 'turn' };
      return dropHand();
    }
    if (
      this.pointers.size === 0 &&
      this.travelled < clickMotion &&
      event.type === 'pointerup' &&
      event.button === 0
    )
      click(this.view, p, this.hit(p, reachOf(event)));
    this.drag = { kind: 'turn' };
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    this.view.camera.zoom(Math.exp(Math.max(-60, Math.min(60, event.deltaY)) * 0.002));
    this.view.moved();
  }

  private key(event: KeyboardEvent): void {
    const turns: Record<string, [number, number]> = {
      ArrowLeft: [-0.1, 0],
      ArrowRight: [0.1, 0],
      ArrowUp: [0, -0.1],
      ArrowDown: [0, 0.1],
    };
    const turn = turns[event.key];
    if (this.cross.key(event)) {
      event.preventDefault();
      event.stopPropagation();
      return;
    }
    // with Control the valve turns even while the arrows move the cross
    if (event.metaKey || event.altKey || (event.ctrlKey && !turn)) return;
    if (turn && event.shiftKey) this.view.camera.pan(turn[0] * 200, turn[1] * 200, this.view.height);
    else if (turn) this.view.camera.rotate(...turn);
    else if (event.key === '+' || event.key === '=') this.view.camera.zoom(0.9);
    else if (event.key === '-') this.view.camera.zoom(1.1);
    else return;
    event.preventDefault();
    event.stopPropagation();
    this.view.moved();
  }
}
