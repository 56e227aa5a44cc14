// The place of a label beside its part: on a circle around it, where it covers the fewest lines and other labels.

/** A line on the screen: x and y of both ends. */
export type Line = readonly [number, number, number, number];

export interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

/** Places that are tried, at each distance. */
const directions = 16;
/** Pixels between the middle of the label and the named point. */
const distances = [48, 72, 100];
/** A covered label counts as much as this many lines. */
const labelWeight = 4;
/** How much better another place must be before the label moves to it: it rests while the camera turns. */
const patience = 0.75;

/** Whether a line meets a box: Liang and Barsky's clipping. */
export function meets([ax, ay, bx, by]: Line, box: Box): boolean {
  let [enter, leave] = [0, 1];
  for (const [from, way, low, size] of [
    [ax, bx - ax, box.x, box.width],
    [ay, by - ay, box.y, box.height],
  ]) {
    if (way === 0) {
      if (from < low || from > low + size) return false;
      continue;
    }
    const [s, t] = [(low - from) / way, (low + size - from) / way];
    enter = Math.max(enter, Math.min(s, t));
    leave = Math.min(leave, Math.max(s, t));
  }
  return enter <= leave;
}

export const overlap = (a: Box, b: Box): boolean =>
  a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;

/** The box of a label whose middle is at a place. */
export const boxAt = ([x, y]: [number, number], { width, height }: Pick<Box, 'width' | 'height'>): Box => ({
  x: x - width / 2,
  y: y - height / 2,
  width,
  height,
});

/** The place of a label and others around it, the nearest first, up to `far` heights or half widths of its words away. */
export function placesAround(
  [x, y]: [number, number],
  { width, height }: Pick<Box, 'width' | 'height'>,
  far: number,
): [number, number][] {
  const places: [number, number][] = [[x, y]];
  for (let away = 0.5; away <= far; away += 0.5)
    for (const [right, down] of [
      [0, -1],
      [0, 1],
      [-1, 0],
      [1, 0],
      [-1, -1],
      [1, -1],
      [-1, 1],
      [1, 1],
    ])
      places.push([x + (right * away * width) / 2, y + down * away * height]);
  return places;
}

export class Callout {
  /** The place that was taken last. */
  private last = 0;

  /** The middle of a label of a size beside a point, within a picture of a width and height. */
  place(at: [number, number], size: Box, lines: Line[], labels: Box[], picture: Box): [number, number] {
    const count = directions * distances.length;
    const boxAt = (k: number): Box => {
      const angle = (2 * Math.PI * (k % directions)) / directions;
      const distance = distances[Math.floor(k / directions)];
      // farther to the sides: labels are wide
      const x = at[0] + (distance + size.width / 2 - 24) * Math.cos(angle) - size.width / 2;
      return { ...size, x, y: at[1] + distance * Math.sin(angle) - size.height / 2 };
    };
    const cost = (k: number): number => {
      const box = boxAt(k);
      const outside =
        box.x < picture.x ||
        box.y < picture.y ||
        box.x + box.width > picture.width ||
        box.y + box.height > picture.height;
      return (
        lines.filter((line) => meets(line, box)).length +
        labelWeight * labels.filter((label) => overlap(label, box)).length +
        (outside ? 1000 : 0) +
        0.5 * Math.floor(k / directions)
      );
    };
    let [best, least] = [this.last, cost(this.last) - patience];
    for (let k = 0; k < count; ++k) {
      const value = cost(k);
      if (value < least) [best, least] = [k, value];
    }
    this.last = best;
    const box = boxAt(best);
    return [box.x + box.width / 2, box.y + box.height / 2];
  }
}
