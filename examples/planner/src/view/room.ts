// The room that a view leaves at the edges of the picture: keys of the colours stand at its foot, notices at its top.
import * as state from '../store/state';
import type { Picture } from '../protocol';
import { headLength } from './heart';
import { point } from './mesh';
import { rimOf } from './shown';

/** Pixels between the valve and what stands below it. */
const belowValve = 4;
/** Pixels at the top of the picture that a valve does not rise into. */
export const topOf = (height: number): number => Math.min(64, 0.1 * height);

/** The lowest pixel at x that is free of the keys of the colours in the picture of an element. */
export function lowestFree(host: HTMLElement): (x: number) => number {
  const [picture, keys] = [host, document.querySelector('.scale')].map((one) => one?.getBoundingClientRect());
  const { left, top, height } = picture!;
  return (x) => {
    const above = keys?.height && x >= keys.left - left && x <= keys.right - left;
    return Math.min(height, above ? keys.top - top : height) - belowValve;
  };
}

/** The outline of the parts in a view: the annulus, and a box around each papillary head as it is drawn, mm. */
export function outlineOf(picture: Picture, frame: number[]): number[][] {
  const topology = state.topologyOf(picture);
  const up = frame.slice(9, 12);
  const heads = Array.from(topology?.headNodes ?? [], (node) => {
    const middle = point(picture.positions, node).map((v, c) => v - headLength * up[c]);
    return [0, 1, 2].flatMap((axis) =>
      [-headLength, headLength].map((by) => middle.map((v, c) => (c === axis ? v + by : v))),
    );
  });
  return [...rimOf(picture), ...heads.flat()];
}
