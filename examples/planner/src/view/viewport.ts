// The picture: canvas, renderer, camera, labels, and the pointer. Draws only when something has changed; while
// something moves at a lower resolution, then once more in full.
import { effect, untracked } from '@preact/signals';
import * as state from '../store/state';
import { appTexts } from '../text/texts';
import { Camera, type Preset } from './camera';
import { hidesFromAtrium } from './click';
import { planeOf } from './cut';
import { Gestures } from './gestures';
import { overlayInputs, sameInputs, sceneInputs } from './inputs';
import { Labels } from './labels';
import { makeRenderer } from './make_renderer';
import type { CutPlane, Renderer, Scene } from './renderer';
import { marksMesh } from './marks';
import { lowestFree, outlineOf, topOf } from './room';
import { rimOf, sectionMeshes, shownFrame, shownRadius, valveMeshes } from './shown';
import type { Mesh } from './mesh';
import { surfaceFrame, surfaceMesh } from './surface';

/** ms without motion until the picture is drawn in full. */
const still = 140;
const background: [number, number, number] = [0.925, 0.937, 0.949];

export class Viewport {
  readonly camera = new Camera();
  renderer: Renderer;
  readonly labels: Labels;
  width = 1;
  height = 1;
  private meshes: Mesh[] = [];
  private sceneDirty = true;
  private dirty = true;
  private lastMotion = 0;
  private lastFrame = 0;
  private drawnFully = false;
  private begun = false;
  private framed = '';
  private builtFrom: unknown[] = [];
  private overlaid: unknown[] = [];
  /** The annulus that was drawn last at rest, mm, and of which valve. */
  private held: number[][] = [];
  private heldOf = '';
  /** ms of the last pictures, for the tests. */
  readonly times: number[] = [];
  /** A surface to show instead of a valve, during an import. */
  surface: Mesh | null = null;
  /** The view that was gone to last. */
  private preset: Preset = 'surgeon';
  /** The frame of its views, and its radius. */
  private found: { frame: number[]; radius: number } | null = null;

  constructor(
    readonly host: HTMLElement,
    wanted: 'webgl' | 'software' | '',
  ) {
    this.renderer = makeRenderer(
      wanted,
      () => (this.dirty = false),
      () => this.touchScene(),
    );
    host.prepend(this.renderer.canvas);
    this.describe();
    this.labels = new Labels(host);
    new Gestures(this);
    new ResizeObserver(() => this.resize()).observe(host);
    this.resize();
    effect(() => {
      const inputs = sceneInputs();
      if (sameInputs(inputs, this.builtFrom)) return;
      this.builtFrom = inputs;
      this.touchScene();
    });
    effect(() => {
      const inputs = overlayInputs();
      if (sameInputs(inputs, this.overlaid)) return;
      this.overlaid = inputs;
      this.moved();
    });
    effect(() => {
      const shown = state.surface.value;
      untracked(() => this.showSurface(shown));
    });
    // a view is gone to when it is asked for, not whenever the valve changes that gives it its frame
    effect(() => {
      const wanted = state.wantedView.value;
      if (wanted) untracked(() => this.go(wanted.preset));
    });
    // more lines of keys rise into the view
    effect(() => {
      if (state.keysHeight.value && !this.camera.byHand) untracked(() => this.keysGrew());
    });
    effect(() => {
      const field = state.picking.value;
      untracked(() => {
        if (field && hidesFromAtrium(field) && this.fromAtrium()) this.go('ventricle');
      });
    });
    requestAnimationFrame((now) => this.frame(now));
  }

  /** Whether the eye looks at the leaflets from above, where they hide chordae and papillary heads. */
  private fromAtrium(): boolean {
    return this.eyeHeight() > 0.5;
  }

  /** The sine of the height of the eye over the plane of the annulus. */
  private eyeHeight(): number {
    const { target } = this.camera;
    const back = this.camera.position().sub(target).normalize();
    const frame = this.frameOf();
    return back.x * frame[9] + back.y * frame[10] + back.z * frame[11];
  }

  /** Shows the surface of an import instead of the valve. */
  private showSurface(shown: state.Imported | null): void {
    const fresh = shown && this.surface?.positions !== shown.surface.points;
    if (!shown) [this.surface, this.found] = [null, null];
    else {
      const { surface, points } = shown;
      this.found = { frame: surfaceFrame(surface.shape, points), radius: surface.shape.radius };
      if (fresh) this.surface = surfaceMesh(surface);
    }
    this.touchScene();
    if (fresh && shown) this.go('surgeon', true);
  }

  private describe(): void {
    const { canvas } = this.renderer;
    canvas.tabIndex = 0;
    canvas.setAttribute('role', 'application');
    canvas.setAttribute('aria-label', appTexts.picture);
    canvas.setAttribute('aria-describedby', 'picture-help');
  }

  resize(): void {
    const box = this.host.getBoundingClientRect();
    this.width = Math.max(1, Math.round(box.width));
    this.height = Math.max(1, Math.round(box.height));
    this.camera.aspect = this.width / this.height;
    this.renderer.resize(this.width, this.height, window.devicePixelRatio || 1);
    this.moved();
  }

  /** The scene has to be built anew; a valve at rest is drawn in full at once. */
  touchScene(): void {
    this.sceneDirty = true;
    if (state.motion.value) this.moved();
    else [this.dirty, this.drawnFully] = [true, false];
  }

  /** The camera has moved, or something that needs no new meshes. */
  moved(): void {
    this.dirty = true;
    this.drawnFully = false;
    this.lastMotion = performance.now();
  }

  go(preset: Preset, atOnce = false): void {
    const frame = this.frameOf();
    this.preset = preset;
    this.camera.go(preset, frame, this.radius());
    this.clearKeys();
    if (atOnce) this.camera.finish();
    this.moved();
  }

  /** Keeps annulus and papillary muscles above the keys of the colours in the view that is gone to. */
  private clearKeys(): void {
    const picture = state.picture.value;
    if (!picture || this.surface) return;
    const { width, height } = this;
    this.camera.clear(
      outlineOf(picture, this.frameOf()),
      lowestFree(this.host),
      topOf(height),
      width,
      height,
    );
  }

  private keysGrew(): void {
    if (this.framed && state.main.peek() && !this.surface) this.go(this.preset);
  }

  frameOf(): number[] {
    return this.found?.frame ?? shownFrame();
  }

  /** Radius of the annulus or of a surface, mm. */
  radius(): number {
    return this.found?.radius ?? shownRadius(this.frameOf());
  }

  plane(): CutPlane | null {
    if (!state.sectionOn.value || this.surface) return null;
    return planeOf(this.frameOf(), state.sectionAt.value);
  }

  /** The place of the handle of the section plane. */
  handle(): number[] {
    const f = this.frameOf();
    const up = 0.3 * this.radius();
    return [0, 1, 2].map((c) => f[c] + state.sectionAt.value * f[6 + c] + up * f[9 + c]);
  }

  private buildScene(): void {
    this.sceneDirty = false;
    this.meshes = this.surface ? [this.surface] : valveMeshes(this.frameOf());
  }

  /** The first picture of a valve sets the camera. */
  private frameNewValve(): void {
    const key = state.main.value
      ? `figures ${state.first.value?.figures.hash ?? ''}`
      : state.motion.value
        ? 'motion'
        : '';
    if (!key || key === this.framed || (key === 'motion' && this.framed)) return;
    this.framed = key;
    // another valve has not grown out of the picture of the one before
    this.held = [];
    this.go('surgeon', true);
  }

  /** Goes back where a valve grows out of a picture that held the whole annulus of the one before. */
  private followGrowth(): void {
    const { main, preview, motion, surface, picture } = state;
    if (!main.value || motion.value || surface.value || !picture.value) return;
    const rim = rimOf(picture.value);
    const [before, key] = [this.held, `${main.value.figures.hash} ${preview.value?.figures.hash ?? ''}`];
    if (this.heldOf === key) return;
    const whole = before.length > 0 && this.camera.shows(before, this.width, this.height);
    const foot = this.height - lowestFree(this.host)(0.5 * this.width);
    if (whole && !this.camera.shows(rim, this.width, this.height, foot))
      this.camera.fit(rim, this.width, this.height, foot);
    [this.held, this.heldOf] = [rim, key];
  }

  scene(): Scene {
    const picture = state.picture.value;
    const topology = picture && state.topologyOf(picture);
    const plane = this.plane();
    // behind the plane of a section devices do not shine through the cut leaflets
    const above = this.eyeHeight() > 0.2;
    const meshes = this.meshes.filter(
      (mesh) => !(plane && mesh.cut && mesh.overlay) && !(above && mesh.fromBelow),
    );
    if (plane && topology && !this.surface) {
      meshes.push(...sectionMeshes(topology, picture, plane, this.frameOf(), this.radius()));
    }
    const marks = marksMesh(state.sectionOn.value && !this.surface ? this.handle() : null);
    if (marks) meshes.push(marks);
    return { meshes, background, plane };
  }

  private frame(now: number): void {
    requestAnimationFrame((next) => this.frame(next));
    const seconds = Math.min(0.1, (now - this.lastFrame) / 1000);
    this.lastFrame = now;
    if (this.camera.advance(seconds)) this.moved();
    const resting = performance.now() - this.lastMotion > still;
    if (!this.dirty && (this.drawnFully || !resting)) return;
    this.draw(!resting);
  }

  draw(fast: boolean): void {
    const begin = performance.now();
    this.frameNewValve();
    if (this.sceneDirty) {
      this.buildScene();
      this.followGrowth();
    }
    this.camera.update();
    this.renderer.draw(this.scene(), this.camera, fast);
    this.labels.update(this);
    state.perPixel.value = this.camera.scale(this.height);
    this.dirty = false;
    this.drawnFully = !fast;
    this.markFirst();
    this.times.push(performance.now() - begin);
    if (this.times.length > 400) this.times.shift();
  }

  /** A mark of performance measurements: the first picture with a valve. */
  private markFirst(): void {
    if (this.begun || !this.meshes.length) return;
    this.begun = true;
    performance.mark('first picture');
  }

  /** A PNG picture of the present view, as a data URL. */
  snapshot(): string {
    this.draw(false);
    return this.renderer.canvas.toDataURL('image/png');
  }
}
