// Colours that meet in the picture stay apart for colour-blind people, and maps are ordered by their lightness.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { describe, it } from 'node:test';
import { fileURLToPath } from 'node:url';
import { transformWithEsbuild } from 'vite';
import { difference, labOf, visions } from './fixtures/vision.mjs';

const source = join(dirname(fileURLToPath(import.meta.url)), '../src');
const file = join(source, 'view/colours.ts');
// the module needs nothing else
const { code } = await transformWithEsbuild(readFileSync(file, 'utf8'), file);
const { tissue, maps, colourOf, unknown } = await import(`data:text/javascript,${encodeURIComponent(code)}`);
const style = readFileSync(join(source, 'style.css'), 'utf8');

/**
 * The smallest CIEDE2000 difference of colours that mean different things. 1 is just noticeable between large fields side by
 * side; parts of the picture are thin, apart from each other and in different light, which takes several units.
 */
const apart = 10;

/**
 * Parts that meet in the picture and are distinguished by colour. Not in the list, as colour does not distinguish them: both
 * leaflets (seams and names do), a white ring before the pale background, the annulus and the ring over it (size does).
 */
const neighbours = {
  atrialAnterior: ['ventricularAnterior', 'annulus', 'ring', 'orifice', 'cut', 'edge', 'hand'],
  atrialPosterior: ['ventricularPosterior', 'annulus', 'ring', 'orifice', 'cut', 'edge', 'hand'],
  ventricularAnterior: ['chord', 'strut', 'slack', 'over', 'suture', 'chosen', 'head', 'annulus', 'orifice'],
  ventricularPosterior: ['chord', 'strut', 'slack', 'over', 'suture', 'chosen', 'head', 'annulus', 'orifice'],
  over: ['chord', 'strut', 'slack', 'suture', 'chosen', 'orifice', 'head'],
  chord: ['slack', 'suture', 'chosen', 'head'],
  strut: ['slack', 'suture', 'chosen', 'head'],
  artificial: [
    'ring',
    'chord',
    'strut',
    'slack',
    'over',
    'suture',
    'chosen',
    'head',
    'orifice',
    'ventricularAnterior',
    'ventricularPosterior',
  ],
  suture: ['slack', 'chosen', 'head', 'ring', 'atrialAnterior', 'atrialPosterior'],
  chosen: ['slack', 'head', 'ring', 'hand', 'atrialAnterior', 'atrialPosterior'],
  slack: ['head'],
  orifice: ['head', 'cut', 'ring'],
  ring: ['annulus'],
};

/** Names of the visions in which two colours are nearer than `least`, with their difference. */
function near(a, b, least = apart) {
  return Object.keys(visions)
    .map((vision) => [vision, difference(labOf(a, vision), labOf(b, vision))])
    .filter(([, value]) => value < least)
    .map(([vision, value]) => `${vision} ${value.toFixed(1)}`);
}

/** Colours of a map at equal steps of its scale. */
function steps(map, count = 64) {
  const share = (k) => (map.root ? (k / count) ** 2 : k / count);
  return Array.from({ length: count + 1 }, (_, k) =>
    colourOf(map, map.low + share(k) * (map.high - map.low)),
  );
}

/** The colour of a rule of the style sheet. */
function styled(rule, property) {
  const found = new RegExp(
    `\\.${rule} \\{[^}]*?\\b${property}: (?:rgb\\((\\d+) (\\d+) (\\d+)\\)|#(\\w{6}))`,
  ).exec(style);
  assert.ok(found, rule);
  const [, r, g, b, hex] = found;
  const values = hex ? [0, 2, 4].map((k) => parseInt(hex.slice(k, k + 2), 16)) : [r, g, b].map(Number);
  return values.map((v) => v / 255);
}

describe('planner colours', () => {
  it('are_compared_by_the_published_formulas', () => {
    // pairs 1, 17 and 34 of Sharma, Wu and Dalal's table of test data
    const published = [
      [[50, 2.6772, -79.7751], [50, 0, -82.7485], 2.0425],
      [[50, 2.5, 0], [73, 25, -18], 27.1492],
      [[2.0776, 0.0795, -1.135], [0.9033, -0.0636, -0.5514], 0.9082],
    ];
    // four decimals are printed
    for (const [a, b, value] of published) assert.ok(Math.abs(difference(a, b) - value) < 1e-4, `${value}`);
    // white stays white for everybody, to the last of six printed digits of three weights
    for (const rows of Object.values(visions))
      for (const row of rows) assert.ok(Math.abs(row.reduce((sum, v) => sum + v, 0) - 1) < 2e-6);
    assert.ok(Math.abs(labOf([1, 1, 1])[0] - 100) < 1e-9);
    // red and green that have the same lightness are one colour to a deuteranope, and far apart to others
    const [red, green] = [
      [0.72, 0.42, 0.2],
      [0.53, 0.53, 0.2],
    ];
    assert.ok(
      difference(labOf(red), labOf(green)) >
        2 * difference(labOf(red, 'deuteranopia'), labOf(green, 'deuteranopia')),
    );
  });

  it('that_meet_in_the_picture_are_apart_for_everybody', () => {
    const wrong = [];
    for (const [name, others] of Object.entries(neighbours))
      for (const other of others)
        for (const vision of near(tissue[name], tissue[other])) wrong.push(`${name}, ${other}: ${vision}`);
    assert.deepEqual(wrong, []);
  });

  it('of_maps_rise_or_fall_in_lightness_for_everybody', () => {
    for (const [name, map] of Object.entries(maps))
      for (const vision of Object.keys(visions)) {
        const lightness = steps(map).map((colour) => labOf(colour, vision)[0]);
        const middle = lightness.length >> 1;
        // heights: light at the plane of the annulus, dark at both ends
        const parts =
          name === 'height' ? [lightness.slice(0, middle + 1), lightness.slice(middle)] : [lightness];
        for (const part of parts) {
          const rises = part.slice(1).map((value, k) => value - part[k]);
          assert.ok(rises.every((rise) => rise > 0) || rises.every((rise) => rise < 0), `${name}, ${vision}`);
          assert.ok(Math.abs(part.at(-1) - part[0]) > 40, `${name}, ${vision}: ${part[0]} to ${part.at(-1)}`);
        }
      }
  });

  it('of_maps_tell_their_parts_and_what_is_not_in_them', () => {
    const wrong = [];
    const tell = (what, a, b, least) =>
      wrong.push(...near(a, b, least).map((vision) => `${what}: ${vision}`));
    for (const [name, map] of Object.entries(maps)) {
      const colours = steps(map);
      // colours a quarter of the scale apart are distinct
      for (let k = 16; k <= 64; k += 16) tell(`${name}, a quarter at ${k}`, colours[k - 16], colours[k]);
      tell(`${name}, ends`, colours[0], colours.at(-1), 40);
      // above the plane is another colour than the same height below it, from a quarter of the scale on
      if (name === 'height')
        for (let k = 8; k <= 32; ++k) tell(`height ${k}`, colours[32 - k], colours[32 + k], 25);
      // tissue without a value, and in maps of the chordae those that are slack or beyond their limit
      const chordMap = ['load', 'pull', 'strain'].includes(name);
      const others = chordMap ? { slack: tissue.slack, over: tissue.over } : { unknown };
      for (const [other, colour] of Object.entries(others))
        colours.forEach((value, k) => tell(`${name} at ${k}, ${other}`, value, colour));
    }
    assert.deepEqual(wrong, []);
  });

  it('of_the_section_plot_are_apart_for_everybody', () => {
    const rules = ['plot-now', 'plot-before', 'plot-other', 'plot-healthy'];
    const lines = rules.map((rule) => styled(rule, 'stroke'));
    lines.forEach((a, i) =>
      lines
        .slice(i + 1)
        .forEach((b, j) => assert.deepEqual(near(a, b), [], `${rules[i]} ${rules[i + 1 + j]}`)),
    );
  });

  it('of_the_keys_are_those_of_the_picture', () => {
    const keys = {
      orifice: 'orifice',
      over: 'over',
      slack: 'slack',
      stitch: 'suture',
      artificial: 'artificial',
      'point-commissures': 'chosen',
      'point-anterior': 'over',
      'point-annulus': 'annulus',
      'point-tips': 'head',
    };
    // whole numbers of 255
    const same = (a, b) => a.every((v, c) => Math.abs(v - b[c]) < 0.6 / 255);
    for (const [key, name] of Object.entries(keys))
      assert.ok(same(styled(`key-${key}`, 'background'), tissue[name]), key);
    assert.ok(same(styled('key-none', 'background'), unknown));
    // one key for the sides of both leaflets: nearer to each than to any other side
    for (const [key, other] of [
      ['atrial', 'ventricular'],
      ['ventricular', 'atrial'],
    ])
      for (const leaflet of ['Anterior', 'Posterior']) {
        const to = (name) =>
          difference(labOf(styled(`key-${key}`, 'background')), labOf(tissue[name + leaflet]));
        assert.ok(to(key) < 0.3 * to(other), `${key} ${leaflet}`);
      }
  });
});
