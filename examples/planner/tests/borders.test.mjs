// Borders of scallops are smooth lines from rim to rim, whatever the mesh: marching triangles on smoothed indicators.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { describe, it } from 'node:test';
import { transformWithEsbuild } from 'vite';

/** A module of the page that imports nothing but types. */
async function moduleOf(path) {
  const file = new URL(`../src/${path}`, import.meta.url);
  const { code } = await transformWithEsbuild(readFileSync(file, 'utf8'), 'module.ts');
  return import(`data:text/javascript;base64,${Buffer.from(code).toString('base64')}`);
}

/** Park and Miller's generator. */
function generator(start) {
  let state = start;
  return () => (state = (state * 48271) % 2147483647) / 2147483647;
}

const side = 20;

/** An irregular mesh of a square with sides of 20, whose sides are about 1 long; `scallopOf` divides it by middles of triangles. */
function square(seed, scallopOf, names) {
  const random = generator(seed);
  const x = [];
  for (let j = 0; j <= side; ++j)
    for (let i = 0; i <= side; ++i) {
      const inside = i > 0 && j > 0 && i < side && j < side;
      x.push([i + (inside ? 0.6 * (random() - 0.5) : 0), j + (inside ? 0.6 * (random() - 0.5) : 0)]);
    }
  const triangles = [];
  for (let j = 0; j < side; ++j)
    for (let i = 0; i < side; ++i) {
      const [a, b, c, d] = [0, 1, side + 2, side + 1].map((k) => j * (side + 1) + i + k);
      triangles.push(...(random() < 0.5 ? [a, b, c, a, c, d] : [a, b, d, b, c, d]));
    }
  const triangleScallop = [];
  for (let t = 0; t < triangles.length; t += 3) {
    const nodes = triangles.slice(t, t + 3);
    triangleScallop.push(scallopOf(...[0, 1].map((k) => nodes.reduce((sum, n) => sum + x[n][k] / 3, 0))));
  }
  const topology = {
    nodes: x.length,
    triangles: Uint32Array.from(triangles),
    triangleScallop: Uint32Array.from(triangleScallop),
    scallops: names.map((name) => ({ id: name, name })),
  };
  return { x, topology };
}

const keyOf = ({ a, b }) => `${Math.min(a, b)} ${Math.max(a, b)}`;

/** Pieces joined at sides that they share: lines of points, each from one end to the other. */
function chains(lines, at) {
  const pieces = new Map();
  for (const { from, to } of lines)
    for (const [p, q] of [
      [from, to],
      [to, from],
    ])
      pieces.set(keyOf(p), [...(pieces.get(keyOf(p)) ?? []), q]);
  const place = new Map(lines.flatMap(({ from, to }) => [from, to].map((p) => [keyOf(p), at(p)])));
  const begins = [...pieces].filter(([, next]) => next.length === 1).map(([key]) => key);
  const seen = new Set();
  const found = [];
  for (const begin of begins) {
    if (seen.has(begin)) continue;
    const line = [];
    for (let key = begin; key !== undefined;) {
      seen.add(key);
      line.push(place.get(key));
      key = pieces
        .get(key)
        .map(keyOf)
        .find((next) => !seen.has(next));
    }
    found.push(line);
  }
  return found;
}

/** Length of a line over the distance of its ends: 1 is straight. */
function windingOf(line) {
  const distance = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1]);
  let length = 0;
  for (let k = 1; k < line.length; ++k) length += distance(line[k - 1], line[k]);
  return length / distance(line[0], line.at(-1));
}

describe('borders of scallops', async () => {
  const { bordersOf } = await moduleOf('view/borders.ts');
  const on =
    (x) =>
    ({ a, b, share }) =>
      [0, 1].map((c) => x[a][c] + share * (x[b][c] - x[a][c]));

  const flat = (x) => Float32Array.from(x.flatMap(([p, q]) => [p, q, 0]));

  it('are_nearly_straight_where_triangles_are_divided_along_a_straight_line', () => {
    let sum = 0;
    for (let seed = 1; seed <= 20; ++seed) {
      const slope = 0.4 - 0.04 * seed;
      const lineAt = (y) => 9 + slope * (y - 10);
      const { x, topology } = square(seed, (cx, cy) => (cx < lineAt(cy) ? 0 : 1), ['P1', 'P2']);
      const found = chains(bordersOf(topology, flat(x)), on(x));
      assert.equal(found.length, 1, `seed ${seed}`);
      const [line] = found;
      // from rim to rim
      for (const end of [line[0], line.at(-1)])
        assert.ok(end[1] === 0 || end[1] === side, `seed ${seed}: an end at ${end}`);
      sum += windingOf(line);
      // within one side of the mesh of the line that divides the triangles
      for (const [px, py] of line) assert.ok(Math.abs(px - lineAt(py)) < 1, `seed ${seed}: ${px}, ${py}`);
    }
    // without smoothing 1.06, with equal weights 1.065; along sides of the triangles more
    assert.ok(sum / 20 < 1.02, `winding ${sum / 20}`);
  });

  it('meet_where_three_scallops_do', () => {
    const scallopOf = (cx, cy) => (cy < 10 ? 0 : cx < 10 ? 1 : 2);
    const { x, topology } = square(5, scallopOf, ['A1', 'P1', 'P2']);
    const lines = bordersOf(topology, flat(x));
    const ends = new Map();
    for (const { from, to } of lines)
      for (const p of [from, to])
        ends.set(keyOf(p), { count: (ends.get(keyOf(p))?.count ?? 0) + 1, at: on(x)(p) });
    const loose = [...ends.values()].filter(({ count }) => count === 1).map(({ at }) => at);
    const atRim = loose.filter((p) => p.some((v) => v === 0 || v === side));
    assert.equal(atRim.length, 3);
    // no other end but in the triangle where they meet
    for (const [px, py] of loose.filter((p) => !atRim.includes(p)))
      assert.ok(Math.hypot(px - 10, py - 10) < 2, `an end at ${px}, ${py}`);
  });

  it('are_none_within_one_scallop', () => {
    const { x, topology } = square(3, () => 0, ['A2']);
    assert.deepEqual(bordersOf(topology, flat(x)), []);
  });
});
