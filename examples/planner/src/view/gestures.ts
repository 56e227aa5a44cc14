// The pointer in the picture: turn, pan, zoom with mouse or fingers; click to choose; drag a chosen chord to
// change its length; drag the handle of the section plane; grasp or push tissue.
import * as state from '../store/state';
import { edit, fail, request, tell } from '../store/actions';
import { fillField } from './answer';
import { pick, pickSurface, type Hit } from './pick';
import type { Viewport } from './viewport';

/** Pixels from a chord that still pick it: a mouse is more exact than a finger. */
const reachOf = (event: PointerEvent): number => (event.pointerType === 'touch' ? 24 : 9);
/** Pixels of motion below which a press is a click. */
const clickMotion = 5;

type Drag =
  | { kind: 'turn' }
  | { kind: 'pan' }
  | { kind: 'handle' }
  | { kind: 'chord'; id: string; rest: number; moved: number }
  | { kind: 'hand'; depth: number };

export class Gestures {
  private pointers = new Map<number, { x: number; y: number }>();
  private start = { x: 0, y: 0 };
  private travelled = 0;
  private drag: Drag = { kind: 'turn' };

  constructor(private readonly view: Viewport) {
    const { canvas } = view.renderer;
    canvas.addEventListener('pointerdown', (event) => this.down(event));
    canvas.addEventListener('pointermove', (event) => this.move(event));
    canvas.addEventListener('pointerup', (event) => this.up(event));
    canvas.addEventListener('pointercancel', (event) => this.up(event));
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    canvas.addEventListener('keydown', (event) => this.key(event));
  }

  private place(event: PointerEvent): { x: number; y: number } {
    const box = this.view.renderer.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  private hit(p: { x: number; y: number }, reach: number): Hit | null {
    if (this.view.surface) return null;
    const picture = state.picture.value;
    const topology = picture && state.topologyOf(picture);
    if (!picture || !topology) return null;
    const { camera, width, height } = this.view;
    camera.update();
    return pick(
      camera,
      topology,
      picture,
      p.x,
      p.y,
      width,
      height,
      reach,
      state.chordsOn.value,
      this.view.plane(),
    );
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
        : this.dragAt(p, reachOf(event));
  }

  private dragAt(p: { x: number; y: number }, reach: number): Drag {
    if (state.sectionOn.value) {
      const [hx, hy] = this.view.camera.project(
        ...(this.view.handle() as [number, number, number]),
        this.view.width,
        this.view.height,
      );
      if (Math.hypot(hx - p.x, hy - p.y) < 16 + reach / 2) return { kind: 'handle' };
    }
    const hit = this.hit(p, reach);
    if (!hit) return { kind: 'turn' };
    if (state.tool.value !== 'look' && hit.surface) return this.grasp(hit);
    const picture = state.picture.value!;
    const topology = state.topologyOf(picture)!;
    const choice = state.choice.value;
    if (
      hit.chord >= 0 &&
      choice?.kind === 'chord' &&
      topology.chords[hit.chord].id === choice.id &&
      !state.motion.value
    ) {
      const chord = state.main.value?.figures.chords.find((item) => item.id === choice.id);
      if (chord) return { kind: 'chord', id: choice.id, rest: this.presentLength(chord.rest), moved: 0 };
    }
    return { kind: 'turn' };
  }

  /** The length in the form, or that of the valve. */
  private presentLength(rest: number): number {
    const draft = state.draft.value;
    if (draft?.kind !== 'chord_length') return rest;
    if (typeof draft.fields.length === 'number') return draft.fields.length;
    return typeof draft.fields.factor === 'number' ? rest * draft.fields.factor : rest;
  }

  private grasp(hit: Hit): Drag {
    const surface = hit.surface!;
    const position = [...surface.at];
    if (state.tool.value === 'push') {
      // outside of the tissue, on the side of the viewer
      const eye = this.view.camera.position();
      const towards = [eye.x - surface.at[0], eye.y - surface.at[1], eye.z - surface.at[2]];
      const length = Math.hypot(...towards);
      for (let c = 0; c < 3; ++c) position[c] += (4.5 * towards[c]) / length;
    }
    request(
      'hand_begin',
      { tool: state.tool.value === 'push' ? 'ball' : 'grasp', node: surface.node, position },
      {
        motion: (motion) => {
          state.receive(motion.picture);
          if (this.drag.kind === 'hand') state.motion.value = motion;
        },
      },
    ).catch(fail);
    return { kind: 'hand', depth: surface.distance - (state.tool.value === 'push' ? 4.5 : 0) };
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
    else if (this.drag.kind === 'handle') this.dragHandle(dx, dy);
    else if (this.drag.kind === 'chord') this.dragChord(this.drag, p);
    else if (this.drag.kind === 'hand') this.moveHand(this.drag.depth, p);
    this.view.moved();
  }

  private hover(p: { x: number; y: number }, event: PointerEvent): void {
    if (event.buttons || state.motion.value) return;
    const hit = this.hit(p, reachOf(event));
    const canvas = this.view.renderer.canvas;
    const picture = state.picture.value;
    const figures = (state.preview.value ?? state.main.value)?.figures;
    canvas.style.cursor =
      hit && (hit.chord >= 0 || hit.head >= 0)
        ? 'pointer'
        : state.tool.value === 'look'
          ? 'grab'
          : 'crosshair';
    if (!hit || !picture || !figures) return;
    const chord = hit.chord >= 0 ? figures.chords[hit.chord] : null;
    canvas.title = chord
      ? `${chord.name}: ${chord.length.toFixed(1)} mm, pull ${chord.tension.toFixed(2)} N`
      : '';
  }

  private pinch(id: number, p: { x: number; y: number }): void {
    const [other] = [...this.pointers].filter(([key]) => key !== id).map(([, value]) => value);
    const old = this.pointers.get(id)!;
    const distance = (a: { x: number; y: number }) => Math.hypot(a.x - other.x, a.y - other.y) || 1;
    this.view.camera.zoom(distance(old) / distance(p));
    this.view.camera.pan((p.x - old.x) / 2, (p.y - old.y) / 2, this.view.height);
    const angle = Math.atan2(p.y - other.y, p.x - other.x) - Math.atan2(old.y - other.y, old.x - other.x);
    this.view.camera.roll(Math.abs(angle) < 1 ? angle : 0);
    this.travelled = 100;
    this.view.moved();
  }

  private dragHandle(dx: number, dy: number): void {
    const f = this.view.frameOf();
    const at = this.view.handle();
    const project = (s: number) =>
      this.view.camera.project(
        at[0] + s * f[6],
        at[1] + s * f[7],
        at[2] + s * f[8],
        this.view.width,
        this.view.height,
      );
    const [a, b] = [project(0), project(1)];
    const [ux, uy] = [b[0] - a[0], b[1] - a[1]];
    const length = ux * ux + uy * uy;
    // seen along its normal the plane follows the pointer to the left and right
    const step = length > 1 ? (dx * ux + dy * uy) / length : dx * this.view.camera.scale(this.view.height);
    const limit = 0.9 * this.view.radius();
    state.sectionAt.value = Math.min(limit, Math.max(-limit, state.sectionAt.value + step));
  }

  /** Pulling towards the papillary head shortens, in mm of the picture. */
  private dragChord(drag: Extract<Drag, { kind: 'chord' }>, p: { x: number; y: number }): void {
    const picture = state.main.value!.picture;
    const topology = state.topologyOf(picture)!;
    const k = topology.chords.findIndex((part) => part.id === drag.id);
    const x = picture.positions;
    const [a, b] = [topology.chordNodes[2 * k], topology.chordNodes[2 * k + 1]];
    const project = (node: number) =>
      this.view.camera.project(
        x[3 * node],
        x[3 * node + 1],
        x[3 * node + 2],
        this.view.width,
        this.view.height,
      );
    const [head, leaf] = [project(a), project(b)];
    const [ux, uy] = [head[0] - leaf[0], head[1] - leaf[1]];
    const length = Math.hypot(ux, uy);
    const along =
      length > 20 ? ((p.x - this.start.x) * ux + (p.y - this.start.y) * uy) / length : p.y - this.start.y;
    const millimetres = along * this.view.camera.scale(this.view.height);
    const wanted = Math.min(2 * drag.rest, Math.max(0.3 * drag.rest, drag.rest - millimetres));
    edit('chord_length', { chord: drag.id, length: Math.round(10 * wanted) / 10 });
  }

  private moveHand(depth: number, p: { x: number; y: number }): void {
    const { origin, direction } = this.view.camera.ray(p.x, p.y, this.view.width, this.view.height);
    const at = origin.addScaledVector(direction, depth);
    tell('hand_move', { position: [at.x, at.y, at.z] });
  }

  private up(event: PointerEvent): void {
    const p = this.place(event);
    if (!this.pointers.delete(event.pointerId)) return;
    const { drag } = this;
    if (drag.kind === 'hand') {
      this.drag = { kind: 'turn' };
      request('hand_end', null).then(() => (state.motion.value = null), fail);
      return;
    }
    if (
      this.pointers.size === 0 &&
      this.travelled < clickMotion &&
      event.type === 'pointerup' &&
      event.button === 0
    )
      this.click(p, reachOf(event));
    this.drag = { kind: 'turn' };
  }

  private click(p: { x: number; y: number }, reach: number): void {
    const imported = state.imported.value;
    if (imported && this.view.surface) {
      const { camera, width, height } = this.view;
      camera.update();
      const { positions, index } = this.view.surface;
      const hit = pickSurface(camera, { triangles: index }, positions, p.x, p.y, width, height, null);
      const kind = state.importing.value;
      const most = { annulus: 200, commissures: 2, anterior: 1 }[kind];
      if (!hit) return;
      const points = [...imported.points[kind], hit.at].slice(-most);
      state.imported.value = { ...imported, points: { ...imported.points, [kind]: points } };
      return;
    }
    const hit = this.hit(p, reach);
    const picture = state.picture.value;
    const topology = picture && state.topologyOf(picture);
    if (!hit || !topology || state.motion.value) return;
    if (state.picking.value) return fillField(hit, state.picking.value);
    if (hit.head >= 0) state.choice.value = { kind: 'head', id: topology.heads[hit.head].id };
    else if (hit.chord >= 0) state.choice.value = { kind: 'chord', id: topology.chords[hit.chord].id };
    else if (hit.surface)
      state.choice.value = {
        kind: 'scallop',
        id: topology.scallops[topology.triangleScallop[hit.surface.triangle]].id,
      };
    else state.choice.value = null;
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
    if (event.ctrlKey || event.metaKey || event.altKey) return;
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
