// Perspective camera that turns about a target: free rotation, pan, zoom, and smooth moves to presets.
// Coordinates in mm.
import { Matrix4, Quaternion, Vector3 } from 'three';

/** A view: rows of `frame` are origin, AP, CC and the axis into the atrium (Figures.frame). */
export type Preset = 'surgeon' | 'ventricle' | 'commissure' | 'section';

/** Largest distance to the target, mm. */
const farthest = 400;
/** Factor by which the camera goes back until all is seen. */
const fitStep = 1.02;

export class Camera {
  readonly target = new Vector3();
  readonly orientation = new Quaternion();
  distance = 120;
  /** Vertical field of view, rad. */
  readonly fov = (30 * Math.PI) / 180;
  aspect = 1;
  readonly view = new Matrix4();
  readonly projection = new Matrix4();
  readonly viewProjection = new Matrix4();
  /** Turned, moved or drawn nearer by hand since the last preset. */
  byHand = false;
  private goal: { orientation: Quaternion; target: Vector3; distance: number } | null = null;

  position(): Vector3 {
    return new Vector3(0, 0, this.distance).applyQuaternion(this.orientation).add(this.target);
  }

  /** Recomputes the matrices; call after a change. */
  update(): void {
    const world = new Matrix4().compose(this.position(), this.orientation, new Vector3(1, 1, 1));
    this.view.copy(world).invert();
    const near = Math.max(1, this.distance - 120);
    const top = near * Math.tan(this.fov / 2);
    const right = top * this.aspect;
    this.projection.makePerspective(-right, right, top, -top, near, this.distance + 160);
    this.viewProjection.multiplyMatrices(this.projection, this.view);
  }

  private letGo(): void {
    this.goal = null;
    this.byHand = true;
  }

  /** Turns by angles in rad about the axes of the screen. */
  rotate(right: number, down: number): void {
    this.letGo();
    const turn = new Quaternion()
      .setFromAxisAngle(new Vector3(0, 1, 0), -right)
      .multiply(new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), -down));
    this.orientation.multiply(turn).normalize();
  }

  roll(angle: number): void {
    this.letGo();
    this.orientation.multiply(new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), angle)).normalize();
  }

  /** Millimetres per pixel in the plane of the target. */
  scale(height: number): number {
    return (2 * this.distance * Math.tan(this.fov / 2)) / height;
  }

  pan(dx: number, dy: number, height: number): void {
    this.letGo();
    const s = this.scale(height);
    this.target.add(new Vector3(-dx * s, dy * s, 0).applyQuaternion(this.orientation));
  }

  zoom(factor: number): void {
    this.letGo();
    this.distance = Math.min(farthest, Math.max(15, this.distance * factor));
  }

  /** Begins to move to a preset; `advance` carries it out. */
  go(preset: Preset, frame: number[], radius: number, at?: Vector3): void {
    const row = (k: number) => new Vector3(frame[3 * k], frame[3 * k + 1], frame[3 * k + 2]);
    const [origin, ap, cc, up] = [row(0), row(1), row(2), row(3)];
    // the direction from the target to the eye, and the direction that is up on the screen
    const eyes: Record<Preset, [Vector3, Vector3]> = {
      surgeon: [up.clone(), ap.clone()],
      ventricle: [up.clone().negate(), ap.clone()],
      commissure: [ap.clone().negate().addScaledVector(up, 0.12), up.clone()],
      section: [cc.clone(), up.clone()],
    };
    const [back, top] = eyes[preset];
    const z = back.normalize();
    const x = new Vector3().crossVectors(top, z).normalize();
    const y = new Vector3().crossVectors(z, x);
    const orientation = new Quaternion().setFromRotationMatrix(new Matrix4().makeBasis(x, y, z));
    const depth = preset === 'surgeon' ? 0.1 : preset === 'ventricle' ? 0.3 : 0.48;
    const target = at ?? origin.clone().addScaledVector(up, -depth * radius);
    const room = preset === 'surgeon' ? 1.02 : 1.2;
    const narrow = Math.min(1, this.aspect);
    this.byHand = false;
    this.goal = { orientation, target, distance: (room * radius) / Math.tan(this.fov / 2) / narrow };
  }

  /** Whether points are in the picture, which is `width` by `height` pixels, `foot` pixels above its lower border. */
  shows(points: number[][], width: number, height: number, foot = 0): boolean {
    this.update();
    return points.every(([x, y, z]) => {
      const [px, py] = this.project(x, y, z, width, height);
      return px >= 0 && py >= 0 && px <= width && py <= height - foot;
    });
  }

  /**
   * Moves the goal of a preset so that points lie above what stands at the foot of the picture, by as little as it takes: they rise
   * into the room below `top`, and where that is too little the camera goes back. `lowest`: the pixel above which a point at x lies.
   */
  clear(points: number[][], lowest: (x: number) => number, top: number, width: number, height: number): void {
    const { goal } = this;
    if (!goal || !points.length) return;
    const { distance } = this;
    const [orientation, target] = [this.orientation.clone(), this.target.clone()];
    this.orientation.copy(goal.orientation);
    this.target.copy(goal.target);
    this.distance = goal.distance;
    while (this.distance < farthest) {
      this.update();
      const places = points.map(([x, y, z]) => this.project(x, y, z, width, height));
      const over = Math.max(...places.map(([x, y]) => y - lowest(x)));
      if (over <= 0) break;
      const room = Math.min(...places.map(([, y]) => y)) - top;
      if (over > room) this.distance *= fitStep;
      const up = new Vector3(0, 1, 0).applyQuaternion(this.orientation);
      this.target.addScaledVector(up, -Math.max(0, Math.min(over, room) + 1) * this.scale(height));
    }
    this.goal = { orientation: goal.orientation, target: this.target.clone(), distance: this.distance };
    this.orientation.copy(orientation);
    this.target.copy(target);
    this.distance = distance;
    this.update();
  }

  /** Begins to go back until points are in the picture. */
  fit(points: number[][], width: number, height: number, foot = 0): void {
    const { distance, orientation, target } = this;
    this.distance = this.goal?.distance ?? distance;
    while (!this.shows(points, width, height, foot) && this.distance < farthest) this.distance *= fitStep;
    this.goal ??= { orientation: orientation.clone(), target: target.clone(), distance };
    this.goal.distance = this.distance;
    this.distance = distance;
    this.update();
  }

  /** Moves towards the goal by the time that has passed, s; false when there is nothing to do. */
  advance(seconds: number): boolean {
    if (!this.goal) return false;
    const share = 1 - Math.exp(-seconds * 9);
    this.orientation.slerp(this.goal.orientation, share);
    this.target.lerp(this.goal.target, share);
    this.distance += (this.goal.distance - this.distance) * share;
    const far = this.target.distanceTo(this.goal.target) + Math.abs(this.distance - this.goal.distance);
    if (far < 0.05 && this.orientation.angleTo(this.goal.orientation) < 0.002) this.finish();
    return true;
  }

  /** Jumps to the goal, if there is one. */
  finish(): void {
    if (!this.goal) return;
    this.orientation.copy(this.goal.orientation);
    this.target.copy(this.goal.target);
    this.distance = this.goal.distance;
    this.goal = null;
  }

  /** Pixel of a point and its depth: [x, y, z], z in [-1, 1] within the view. */
  project(x: number, y: number, z: number, width: number, height: number): [number, number, number] {
    const p = new Vector3(x, y, z).applyMatrix4(this.viewProjection);
    return [((p.x + 1) * width) / 2, ((1 - p.y) * height) / 2, p.z];
  }

  /** The ray through a pixel. */
  ray(px: number, py: number, width: number, height: number): { origin: Vector3; direction: Vector3 } {
    const t = Math.tan(this.fov / 2);
    const direction = new Vector3(((2 * px) / width - 1) * t * this.aspect, (1 - (2 * py) / height) * t, -1)
      .applyQuaternion(this.orientation)
      .normalize();
    return { origin: this.position(), direction };
  }
}
