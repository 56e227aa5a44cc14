// The valve that the page begins with: its size, and its picture as text for the page.
import type { Motion } from './protocol';

/** Vertices of the shipped valves. */
export const shippedVertices = 425;

const arrays = { Float32Array, Uint32Array };

/** Digits that keep a length in mm to 0.01 um. */
const digits = 1e5;

/** JSON in which arrays of numbers keep their type. */
export function encode(motion: Motion): string {
  return JSON.stringify(motion, (_, value) =>
    value instanceof Float32Array || value instanceof Uint32Array
      ? { array: value.constructor.name, values: Array.from(value, (v) => Math.round(v * digits) / digits) }
      : value,
  );
}

export function decode(text: string): Motion {
  return JSON.parse(text, (_, value) =>
    value?.array ? arrays[value.array as keyof typeof arrays].from(value.values) : value,
  );
}
