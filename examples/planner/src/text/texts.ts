// Every text that the page shows, in a surgeon's words. To translate the page, translate this file.
import { farBeyond, leakPlaces, suture } from '../notable';
import type { Figures } from '../protocol';
import { flowRange, restResidual } from '../units';

const number = (value: number, digits = 1): string => (Number.isFinite(value) ? value.toFixed(digits) : '–');

/** Two numbers with as many digits as it takes to tell them apart, at least `digits` and at most three. */
export function apart(one: number, other: number, digits = 1): [string, string] {
  const texts: [string, string] = [number(one, digits), number(other, digits)];
  return texts[0] !== texts[1] || one === other || digits >= 3 ? texts : apart(one, other, digits + 1);
}

/** An open area in cm2 of one in mm2. One digit: of wide areas the figure is right to about 0.1 cm2 (libmvs/measure/DEFINITIONS.md). */
export const areaFigure = (area: number): string => number(area / 100);

/** The pull of one chord; pulls of many together are in N. */
export const millinewton = (newton: number): string => `${number(1000 * newton, 0)} mN`;

/** Grade of a leak by its orifice, cm2: 0.20, 0.30, 0.40 (echocardiography, EROA). */
export function grade(orifice: number): { level: number; word: string } {
  if (orifice <= 0) return { level: 0, word: 'Sealed' };
  if (orifice < 20) return { level: 1, word: 'Mild leak' };
  if (orifice < 30) return { level: 2, word: 'Moderate leak' };
  if (orifice < 40) return { level: 3, word: 'Moderate–severe leak' };
  return { level: 4, word: 'Severe leak' };
}

/** The stenosis of an open valve by its area in mm2, judged on cm2 with one digit as guidelines write it: 1.5 or less is severe, 1.0
 *  or less very severe (ACC/AHA 2014). Narrow is what loses more than 5 mmHg at a mean flow of 200 ml/s, by p = 4 v2: 1.8 cm2.
 *  Empty for a wide one. */
export function stenosis(area: number): string {
  const shown = Math.round(area / 10);
  if (shown <= 10) return 'very severe stenosis';
  if (isSevere(area)) return 'severe stenosis';
  return shown < 18 ? 'narrow' : '';
}

/** Whether an open area, mm2, is a severe stenosis. */
export const isSevere = (area: number): boolean => Math.round(area / 10) <= 15;

/** A share of a limit, in per cent or, far beyond it, in times. */
const shareWords = (percent: number): string =>
  percent < farBeyond ? `${percent} %` : `${number(percent / 100, percent < 1000 ? 1 : 0)} times`;

/** The load of a chord; an artificial one is compared with the limit of a native one. */
function loadWords(percent: number, artificial: boolean): string {
  const share = shareWords(percent);
  if (percent < farBeyond) return `${share} of ${artificial ? 'a native' : 'its'} limit`;
  return artificial ? `${share} a native limit` : `far beyond its limit (${share})`;
}

/** A verdict in one sentence: the grade of the leak, its place, the faults beside it. */
export function headlineOf(word: string, place: string, but: string[]): string {
  const begin = place ? `${word} at ${place}` : word;
  return but.length ? `${begin}${place ? '; ' : ', but '}${but.join('; ')}` : begin;
}

/** A list in words. */
export const listOf = (names: string[]): string =>
  [names.slice(0, -1).join(', '), ...names.slice(-1)].filter(Boolean).join(' and ');

/** Smallest share of a leak that is named. */
const leastShare = 0.1;

/** Where a valve leaks: the regions of the table, the largest share first; dots until they are known. */
export function where(figures: Figures): string {
  if (figures.known !== 'all') return '…';
  const leaking = figures.regions.filter((region) => region.orifice > 0);
  const total = leaking.reduce((sum, region) => sum + region.orifice, 0);
  const sorted = leaking
    .filter((region) => region.orifice >= leastShare * total)
    .sort((a, b) => b.orifice - a.orifice)
    .map((region) => (region.commissure ? `commissure ${region.name}` : region.name));
  // as many as the card has room for
  const places = sorted.length > 3 ? `${sorted.slice(0, 2).join(', ')} and others` : listOf(sorted);
  const count = leakPlaces(figures.orificeParts).length;
  return count > 1 ? `${places}, in ${count} places` : places;
}

export interface Words {
  title: string;
  short: string;
  fields?: Record<string, string>;
}

export const operationWords: Record<string, Words> = {
  ring: {
    title: 'Ring',
    short: 'Sew in a rigid ring; choose its size',
    fields: { size: 'Size', ap_ratio: 'Depth to width', saddle: 'Saddle height', name: 'Name' },
  },
  band: {
    title: 'Posterior band',
    short: 'Flexible band from trigone to trigone',
    fields: { factor: 'Length, in % of the present posterior annulus', length: 'Length', name: 'Name' },
  },
  annulus_scale: {
    title: 'Annulus size',
    short: 'Make the annulus larger or smaller, in all or in one direction',
    fields: {
      factor: 'Overall size',
      ap: 'Front to back, beside the overall size',
      cc: 'Side to side, beside the overall size',
    },
  },
  neochord: {
    title: 'Artificial chord',
    short: 'ePTFE from a papillary muscle to the leaflet',
    fields: {
      head: 'Papillary muscle',
      site: 'Place on the leaflet',
      length: 'Length',
      strands: 'Strands',
      diameter: 'Thickness of a strand',
      young: 'Stiffness',
      name: 'Name',
    },
  },
  chord_length: {
    title: 'Chord length',
    short: 'Shorten or lengthen a chord',
    fields: {
      chord: 'Chord',
      length: 'Rest length, without pull',
      factor: 'Length, in % of the present one',
    },
  },
  chord_remove: { title: 'Cut a chord', short: 'Remove a chord', fields: { chord: 'Chord' } },
  chord_add: {
    title: 'Tissue chord',
    short: 'Add a chord of the patient’s own kind of tissue',
    fields: {
      head: 'Papillary muscle',
      site: 'Place on the leaflet',
      length: 'Length',
      type: 'Kind',
      area: 'Cross-section',
      young: 'Stiffness',
      name: 'Name',
    },
  },
  chord_transfer: {
    title: 'Transfer a chord',
    short: 'Move one end of a chord elsewhere',
    fields: {
      chord: 'Chord',
      end: 'Which end',
      site: 'New place on the leaflet',
      head: 'New papillary muscle',
      length: 'Length',
    },
  },
  head_move: {
    title: 'Papillary muscle',
    short: 'Move the tip of a papillary muscle',
    fields: { head: 'Papillary muscle', by: 'Move by', frame: 'Along' },
  },
  clip: {
    title: 'Clip',
    short: 'Join A2 and P2 edge to edge; drag the ball “Clip” along the edge, and turn it by the ball “Turn”',
    fields: {
      anterior: 'Anterior scallop',
      posterior: 'Posterior scallop',
      position: 'Position along the edge (keys A, D)',
      angle: 'Turn against the clock, seen from the atrium (keys Q, E)',
      width: 'Width',
      reach: 'Depth of the grasp',
      name: 'Name',
    },
  },
  resect: {
    title: 'Resection',
    short: 'Take out a piece of a leaflet and suture',
    fields: {
      scallop: 'Scallop',
      position: 'Position along the edge',
      width: 'Width at the free edge',
      base_width: 'Width at the annulus',
      depth: 'Depth',
    },
  },
  patch: {
    title: 'Patch',
    short: 'Enlarge a leaflet with pericardium',
    fields: {
      site: 'Centre',
      width: 'Width',
      height: 'Height',
      area_factor: 'Patch over hole',
      thickness: 'Thickness',
    },
  },
};

/** Words for an operation that this page does not know yet: those of the library. */
export function wordsOf(kind: string, help: string): Words {
  return operationWords[kind] ?? { title: kind.replace(/_/g, ' '), short: help };
}

/** Left and right in the surgeon's view. */
const sides = ['anterolateral', 'posteromedial'] as const;

/** How the library ends the title of a clip: its stitches, the chosen width in mm, how far it is from the middle of its scallop,
 *  and its turn in degrees. */
const clipEnd =
  /, \d+ stitches over (\d+(?:\.\d+)?) mm(?:, (\d+(?:\.\d+)?) mm towards ([^,]+))?(?:, turned by (-?\d+) degrees)?$/;

/** How a clip was set: its width in mm, its place and its turn in degrees against the clock. */
export interface ClipWords {
  width: number;
  place: string;
  angle: number;
}

/** The side towards which a clip stands: "A1/P1 (anterolateral)" for "A1" in the title of a clip between A2 and P2. */
function towardsWords(title: string, towards: string): string {
  const [, anterior, posterior] = /^Join A(\d) and P(\d)/.exec(title) ?? [];
  const [, next] = /^A(\d)$/.exec(towards) ?? [];
  if (!next || !anterior || anterior !== posterior) return towards;
  return `A${next}/P${next} (${sides[next < anterior ? 0 : 1]})`;
}

function clipWords(title: string): ClipWords | null {
  const found = clipEnd.exec(title);
  if (!found) return null;
  const [, width, away, towards, angle] = found;
  const place =
    away === undefined ? 'in the middle' : `${number(+away)} mm towards ${towardsWords(title, towards)}`;
  return { width: +width, place, angle: +(angle ?? 0) };
}

/** How the clip with this name was set; null where that was before the plan. Its place in mm stands in its title alone. */
export function clipIn(name: string, clips: Figures['clips']): ClipWords | null {
  const clip = clips.find((one) => one.name === name);
  return clip ? { ...clip, place: clipPlaceIn(clip.title) ?? '' } : null;
}

/** How far a clip is from the middle, as the title of its operation says it; null of another title. */
export const clipPlaceIn = (title: string): string | null => clipWords(title)?.place ?? null;

const turned = (angle: number): string =>
  angle === 0
    ? 'across the edge'
    : `turned ${number(Math.abs(angle), 0)}° ${angle > 0 ? 'against the clock' : 'with the clock'}`;

const clipSaid = ({ width, place, angle }: ClipWords): string =>
  `${+number(width)} mm wide, ${place}, ${turned(angle)}`;

/** Sentences of the library with its units turned into those of the page, which has no metres to mistake. */
export function say(sentence: string): string {
  return sentence
    .replace(/\bneochord(ae|s)?\b/g, (_, many?: string) => (many ? 'artificial chordae' : 'artificial chord'))
    .replace(
      /(-?\d+(?:\.\d+)?(?:e-?\d+)?) m\b(?![m²/])/g,
      (_, v: string) => `${+(1e3 * +v).toPrecision(4)} mm`,
    )
    .replace(/: looks like mm given as m\b/, '')
    .replace(/; if it is the atrial side, say so: kind atrial/, importTexts.kindGuessed)
    .replace(/(?:divide|multiply) by \d+ or give --unit (\w+)/, (_, unit: string) =>
      importTexts.chooseUnit(unit),
    )
    .replace('; give the closed leaflets to fit the lengths to them', importTexts.giveClosed)
    .replace('; give it if it is known', importTexts.giveThickness)
    .replace('; give the open leaflets, and these as the closed ones', importTexts.giveOpen)
    .replace(clipEnd, () => `, ${clipSaid(clipWords(sentence)!)}`)
    .replace(/\bmm2\b/g, 'mm²')
    .replace(/(\d) x (?=\d)/g, '$1 × ')
    .replace(/(\d) (mm|mm²|%|N)(?![\w²])/g, '$1\u00a0$2')
    .replace(/^mvs_\w+: /, '');
}

export const t = {
  product: 'Mitral repair planner',
  research: 'Research simulator. Not for decisions on treatment.',
  /** The same where there is less room. */
  researchShort: 'Research only, not for treatment',
  starting: 'Starting…',
  closing: 'Closing the valve…',
  previewing: 'Trying it…',
  undoing: 'Going back…',
  redoing: 'Repeating…',
  saving: 'Saving…',
  saved: (name: string) => `Saved as ${name} in your downloads.`,
  measuring: 'Measuring…',
  spreading: 'Closing it eight times…',
  replaying: 'Repeating the plan…',
  building: 'Building the valve…',
  fitting: 'Building the valve and fitting its chordae, which takes minutes…',
  closedRead: (name: string, triangles: number) =>
    `${name}: closed leaflets of ${triangles} triangles. Chordae will be fitted to them.`,
  reading: 'Reading the file…',
  cancel: 'Cancel',
  sessionFile: 'Repair session',
  sessionOpened: 'Session opened: exactly the valve that was saved, with its plan.',
  sessionDiffers:
    'Session opened, but the repeated plan differs from the saved valve: it was saved by another version, or the file was changed.',
  unknownFile: (name: string) =>
    `${name} is not a file this page can open: it takes a session (.mvsplan), a valve (.obj), or a surface (.stl, .ply, .obj, .off, .vtk, .vtp).`,
  landmarkFile: (name: string) =>
    `${name} has landmarks, which this page does not read from a file: open the surface, and click the points on it.`,
  refusedFile: (name: string, why: string) => `${name} was not opened: ${why}.`,
  damagedFile: (name: string, why: string) =>
    `${name} is damaged, cut short or no ${name.replace(/.*\./, '').toUpperCase()} file: ${why}.`,
  fileLeft: (name: string) => `${name} keeps the plan before; changes of this one are not saved to it.`,
  severalFiles: (name: string) => `One file at a time: ${name} was taken.`,
  importBegun: (triangles: number) =>
    `Surface with ${triangles} triangles. Mark both commissures, then build the valve.`,
  /** The result of an operation, for the status line: `done` names it; all figures are known. `f`: null where they do not count. */
  statusLine: (done: string, headline: string, f: Figures | null, more: string) =>
    [
      `${done ? `${done}: ` : ''}${headline}.`,
      f && f.measures.orifice > 0 ? `Leak ${number(f.measures.orifice)} mm².` : '',
      f ? `Coaptation ${number(f.measures.coaptationMean)} mm.` : '',
      more ? `${more}.` : '',
    ]
      .filter(Boolean)
      .join(' '),
  previewed: 'Preview',
  undone: 'Undone',
  repeated: 'Repeated',
  returned: 'Returned',
  notSeen: 'Not applied: its result is still to come. Apply it once it is shown.',
};

export const kinds = ['Other', 'Marginal', 'Rough zone', 'Strut', 'Basal', 'Commissural', 'Trunk', 'Suture'];

/** Kind of a chord, beside its name. */
export const kindOf = ({ kind, artificial }: { kind: number; artificial: boolean }): string =>
  artificial && kind !== suture ? 'Artificial' : kinds[kind];
export { number as figure };

/** The present value of a goal's figure, where it is known. */
const nowIs = (is: string): string => (is ? ` (now ${is})` : '');

export const tourTexts = {
  valveOf: (k: number) => `Valve ${k}`,
  hint: 'A hint',
  goal: (number: number) => `Goals of valve ${number}`,
  afterOperation: 'after this operation',
  /** Verdict on a goal, for those who do not see its sign; null: not known yet. */
  judged: (done: boolean | null) => (done === null ? 'not known yet' : done ? 'reached' : 'missed'),
  repair: 'Repair this valve',
  repairOn: 'Go on repairing it',
  reachedBefore:
    'All goals of this valve were reached before, by another plan; the present one does not reach them.',
  signs: { now: 'All goals reached', before: 'All goals were reached before', none: '' },
  after:
    'Next, a valve of your own: open the surface of its leaflets from an image (STL, PLY, OBJ) and mark the commissures, or a saved valve.',
  own: 'Open your own valve…',
  next: (number: number) => `On to valve ${number}`,
  present: (k: number) => `Valve ${k} of the tour`,
  finishedOf: (count: number) =>
    count < 4 ? `${count} of 4 valves sealed.` : 'All four valves are sealed: the tour is finished.',
  study: {
    title: 'What the study’s surgeon did',
    column: 'Study surgeon',
    help: 'Study surgeon: the repair in the study of Tenenholtz and others (2011), repeated here.',
  },
  example: {
    title: 'A way to repair it',
    column: 'Example',
    help: 'Example: two artificial chordae and a band.',
  },
  show: (chord: string) => `Show the chord ${chord}`,
  columnsHelp: (other: string) =>
    `Before illness: this same valve with its annulus and chordae as they were; the valve that the page begins with is another one. ${other} Coaptation: mean along the whole line of closure, in which a gap counts as 0.`,
  namesHelp:
    'AL1 to AL3 are heads of the anterolateral papillary muscle, PM1 to PM3 of the posteromedial one; A2/13 is chord 13 of the scallop A2.',
  whenSealed: '(measured once it is sealed)',
  columns: { yours: 'Yours', healthy: 'Before illness' },
  rows: {
    leak: 'Leak, mm²',
    coaptation: 'Coaptation, mean, mm',
    load: 'Highest chord load, % of limit',
    area: 'Open area, cm²',
    ap: 'Annulus AP, mm',
  },
  heading: 'Learn it on four leaking valves',
  intro: [
    'A surgeon in the study of Tenenholtz and others (2011) learned this kind of program in ten minutes and sealed the first three of these valves; the fourth has a flail leaflet.',
    'Turn the valve with the left button (or one finger), zoom with the wheel (or two fingers). The red area is the leak.',
    'Open “Repair”, choose an operation, and watch the closed valve while you change it. Nothing is done until you press Apply, and everything can be undone.',
  ],
  valves: [
    {
      title: 'Valve 1: dilated, and a long strut chord',
      story:
        'In systole the annulus is 15 % too large, and a strut chord of the anterior leaflet is 25 % too long. The leaflets do not meet.',
      chord: 'A1/11',
      hint: 'Make the annulus smaller first: a ring, a band, or “Annulus size”. If a leak remains, hold the middle of A2 with artificial chordae. To shorten the long strut chord alone does not seal this valve.',
    },
    {
      title: 'Valve 2: a short chord',
      story:
        'A chord to A2 is 30 % too short. It holds the leaflet back, so that it cannot reach its partner.',
      chord: 'A2/4',
      hint: 'Look for the chord with the strongest pull under A2, turn the valve to see it from below, and lengthen it or cut it.',
    },
    {
      title: 'Valve 3: dilated, and a short chord',
      story: 'In systole the annulus is 10 % too large, and a chord to A2 is 33 % too short.',
      chord: 'A2/4',
      hint: 'Two faults need two steps: free the leaflet from the short chord, then bring the annulus back to its size.',
    },
    {
      title: 'Valve 4: a flail P2',
      story:
        'The chordae of the free edge of P2 and those behind it are torn, and in systole the annulus is 5 % too large. The edge of P2 stands in the atrium.',
      hint: 'Hold the edge of P2 with two artificial chordae, one from each papillary muscle, then support the annulus with a band or a ring. A small ring alone can seal this valve, but P2 stays flail.',
    },
  ] as { title: string; story: string; hint: string; chord?: string }[],
  goals: {
    sealed: 'No leak under 120 mmHg',
    edge: (scallop: string, height: number | null) =>
      `The free edge of ${scallop} below the plane of the annulus${height === null ? '' : ` (now ${number(Math.abs(height))} mm ${height < 0 ? 'below' : 'above'})`}`,
    coaptation: (least: number | null, now: number) => {
      const [is, wanted] = least === null ? ['', '…'] : apart(now, least);
      return `Mean coaptation ${wanted} mm or more${nowIs(Number.isNaN(now) ? '' : is)}`;
    },
    chords: (percent: number | null, now: number) =>
      `No chord above ${percent ?? '…'} % of its working limit${nowIs(Number.isNaN(now) ? '' : shareWords(now))}`,
    open: (least: number | null, now: number | undefined) => {
      if (least === null || now === undefined)
        return `Open area ${least === null ? '…' : number(least / 100)} cm² or more`;
      const [is, wanted] = apart(now / 100, least / 100);
      return `Open area ${wanted} cm² or more${nowIs(is)}`;
    },
  },
  /** The reason for a goal's limit, and the limits of its meaning. */
  goalHelp: {
    coaptation:
      '90 % of the length before the illness. Surgeons aim at 8 mm at A2–P2, which this valve did not have when it was healthy.',
    chords:
      'Allowed are 10 % more than the limit or, where that is more, than the highest load before the illness.',
    open: '90 % of the area before the illness.',
  },
  shortGoals: {
    sealed: 'No leak',
    edge: (scallop: string) => `Edge of ${scallop}`,
    coaptation: 'Coaptation',
    chords: 'Chordae',
    open: 'Opens',
  },
  won: 'All goals reached.',
};

export const help = {
  picture: 'Arrow keys turn the valve, Shift and arrow keys move it, plus and minus zoom.',
  keys: [
    ['1 2 3 4', 'Views: surgeon, ventricle, from behind, section'],
    ['Arrows, + −', 'Turn, zoom (in the picture)'],
    ['V R P L I', 'Panels: Valve, Repair, Plan, Learn; Import, once a surface was opened'],
    ['O', 'Open and close the valve'],
    ['W', 'The valve before, and the present one again'],
    ['X', 'Cut plane in the picture on and off: nothing stands before it'],
    ['C', 'Chordae on and off'],
    ['N', 'Names on and off'],
    ['M', 'Next colour map'],
    ['G, B', 'Grasp, push with a ball'],
    ['A D, Q E', 'Slide, turn the clip of the form'],
    ['Arrows, Space', 'Move a cross and click with it, while a place in the picture is asked for'],
    [
      'Enter, Esc',
      'Apply, discard the operation; in a number, Enter takes it first. Esc also lets go of a chosen part',
    ],
    ['Ctrl Z, Ctrl Y', 'Undo, redo'],
    ['Ctrl S', 'Save the session'],
    ['Ctrl O', 'Open a file'],
    ['F', 'What the figures mean'],
    ['?', 'This list'],
  ] as [string, string][],
};

export const mapWords: Record<
  string,
  { title: string; scale: string; low?: string; high?: string; none?: string }
> = {
  tissue: { title: 'Tissue', scale: '' },
  coaptation: {
    title: 'Contact',
    scale: 'Distance to the facing leaflet',
    low: 'touching',
    high: 'apart',
    none: 'no leaflet faces it',
  },
  height: {
    title: 'Height',
    scale: 'Height over (+) or under (−) the mean plane of the annulus',
  },
  stretch: {
    title: 'Leaflet stretch',
    scale: 'Largest stretch of the leaflets, from their size without load',
  },
  load: { title: 'Chord load', scale: 'Load of the chordae, of their working limit' },
  pull: { title: 'Chord pull', scale: 'Pull of the chordae' },
  strain: { title: 'Chord stretch', scale: 'Stretch of the chordae' },
  distance: { title: 'Change', scale: 'Moved by the repair, or from the plan that it is compared with' },
};

/** Scales of the colour maps. */
export const scaleTexts = {
  title: (text: string, unit: string) => `${text}, ${unit}`,
  tick: (value: number) => String(value).replace('-', '−'),
  /** A limit, and those of other kinds of chordae. */
  limit: (most: string, others: [string, string][]) =>
    [most, ...others.map(([names, value]) => `${value} for ${names.toLowerCase()}`)].join(', '),
  limitIs: (limits: string) => `Limit: ${limits}`,
  full: (pull: string, strain: string) => `100 % is a pull of ${pull}, or a stretch of ${strain}`,
};

export const importTexts = {
  set: (count: number) => `${count} set`,
  guessed: 'guessed',
  undo: (of: string) => `Undo point: ${of}`,
  clear: (of: string) => `Clear: ${of}`,
  undoTip: 'Takes the point back that was set last',
  clearTip: 'Forgets these points; they are guessed again',
  /** Parts of the valve that points belong to, on the buttons that take them back. */
  of: { commissures: 'commissures', anterior: 'anterior leaflet', annulus: 'annulus', tips: 'tips' },
  beside: 'That click was beside the surface: nothing was marked.',
  build: 'Build the valve',
  leave: 'Leave',
  none: 'Drop a surface file (STL, PLY, OBJ) on the picture, or choose Open.',
  intro:
    'Mark what you know by clicking on the surface; the rest is guessed from its shape and listed afterwards. The two commissures help most.',
  unit: 'Unit of the file',
  tab: 'Import',
  kind: 'What the surface is',
  kinds: {
    '': 'Not known',
    atrial: 'Atrial side of the leaflets',
    mid: 'Middle of the leaflets',
    skin: 'Both sides, closed',
  },
  unitOption: (unit: string, mm: number) => `${unit}: ${number(mm, mm < 10 ? 1 : 0)} mm at most`,
  unitFrom: {
    file: 'The file states its unit.',
    size: 'The file does not state its unit: it was guessed from the size. Choose another one if it is wrong.',
    choice: '',
  },
  /** Extents along the axes of the file. */
  size: (extents: number[]) =>
    `The surface measures ${extents.map((mm) => number(mm)).join(' × ')} mm along the axes of the file. The largest extent of an adult’s open valve is 30 to 60 mm.`,
  points: {
    commissures: 'Both commissures',
    anterior: 'A point of the anterior leaflet',
    annulus: 'Points along the annulus',
    tips: 'Papillary tips',
  },
  tips: 'Chordae are placed by normal anatomy, and so are papillary tips that you do not mark. Tips below the surface can be clicked beside it, in the view from the side: such a point takes the depth of the middle of the surface.',
  again: 'Change and build again',
  closed: 'Closed leaflets',
  notGiven: 'not given',
  forgetClosed: 'Forget the closed leaflets',
  forgetClosedTip: 'Chordae are then placed by normal anatomy alone',
  closedHint:
    'A surface of the same leaflets in systole, from the same scan and with the same axes. Chordae then get the lengths with which the valve closes to it, which takes minutes.',
  thickness: 'Thickness of the leaflets',
  thicknessOutside: (given: number, low: number, high: number) =>
    `${String(given).replace('-', '−')} mm is out of range; it has to be ${low} to ${high} mm.`,
  /** What the library asks for, in the words of the fields. */
  giveClosed: '; choose the file of the “Closed leaflets” to fit the lengths to them',
  giveThickness: '; enter it as the “Thickness of the leaflets” if it is known',
  giveOpen: '; open the open leaflets, and choose these as their “Closed leaflets”',
  kindGuessed: '; if it is not, choose what it is by “Change and build again”',
  chooseUnit: (unit: string) => `choose ${unit} as the unit of the file`,
  found: 'What was found and what was guessed',
  groups: {
    leak: 'Its leak',
    unsure: 'Please check: not certain',
    sure: 'Known well enough',
    mesh: 'The mesh',
  },
  sources: ['', 'given', 'measured', 'guessed', 'normal anatomy'],
};

/** Refusals of the worker and of the page; those of the library come in its own words. */
export const refusals = {
  notArchive: 'this file is not a session: it is not a zip archive, or it is damaged',
  notSession: 'this archive is not a session: session.json is missing',
  notJson: 'session.json is damaged: it is not JSON',
  otherKind: 'session.json describes another kind of file',
  otherVersion: (given: unknown, known: number) =>
    typeof given === 'number' && given > known
      ? `it was saved by a newer planner, as a session of version ${given}, and this page reads ${known}: open it with the newer one`
      : `its version is ${JSON.stringify(given)}, and this page reads ${known}`,
  missing: (file: string) => `${file} is missing from the session`,
  noPreview: 'there is no preview to apply: choose an operation',
  noCheckpoint: (name: string) => `there is no kept plan ${name}`,
  sameCheckpoint: (name: string) => `there is already a plan “${name}”: choose another name`,
  nothingRemoved: 'no kept plan was deleted',
  noOperation: (kind: string) => `there is no operation ${kind}`,
  noField: (kind: string, name: string) => `${kind} has no field ${name}`,
  noRoom: 'There is no room for the ball here: turn the valve and press from another side.',
  cancelled: 'cancelled',
  noTriangles: (file: string) => `${file} has no triangles: it is no surface`,
  noWorker: 'the worker did not start',
};

/** Figures of the middle section in a valve whose scallops are not called A2 and P2. */
export const middleWords = (text: string): string =>
  text
    .replace(/,? A2[–-]P2/g, ' in the middle')
    .replace('Length of A2 and P2 that is free', 'Free length of both leaflets in the middle')
    .replace(/A2 and P2 (do not touch|meet) in the middle/, 'the leaflets $1 in the middle')
    .replace('A2 and P2 meet', 'the leaflets meet in the middle')
    .replace('Join A2 and P2', 'Join both leaflets');

/** What is doubtful about a valve file. */
export const warningTexts = {
  /** A warning of the library as a sentence of the page, without its commands and fields. */
  library: (text: string) =>
    `${say(text)
      .replace(/; for contact there too: .*$/, '')
      .replace(/: (thickness|rest_length) is in m\b(, not a share of the distance)?/, '')
      .replace(/^./, (letter) => letter.toUpperCase())}.`,
  size: (cc: number) =>
    `The annulus of this valve is ${number(cc)} mm wide; those of patients are 8 to 80 mm. If the file is in another unit than mm, none of the figures holds.`,
  notMitral: (leaflets: string[]) =>
    `This valve has ${leaflets.length === 1 ? 'one leaflet' : 'the leaflets'} ${listOf(leaflets)}, not an anterior and a posterior one: the grades, limits and views of this page are those of the mitral valve and do not apply.`,
  /** mmHg. */
  otherLoad: (own: number) =>
    `The file has this valve under ${number(own)} mmHg. It is closed under 120 mmHg here: the figures are not those of the file’s own load.`,
};

function outOfBalance(residual: number): string {
  const forces = `forces of up to ${number(1000 * residual, residual < 1e-3 ? 2 : 1)} mN are out of balance`;
  return residual < restResidual
    ? `${forces}: it nearly balances, but in no stable shape`
    : `${forces}; at rest it is less than 0.1 mN`;
}

/** Of valves whose figures do not count. */
export const doubtTexts = {
  /** Beside each figure of such a valve. */
  mark: '†',
  words: { cross: 'Leaflets cross', notAtRest: 'Not at rest' },
  /** After these words, in one line. */
  short: { cross: 'its figures do not count', notAtRest: 'its figures are not final' },
  /** The mark, explained below figures and tables. */
  marks: {
    cross: '† not valid: the leaflets of this valve cross.',
    notAtRest: '† not final: this valve did not come to rest.',
  },
  crossNote: (pairs: number) =>
    `Leaflets pass through each other (${pairs} ${pairs === 1 ? 'pair' : 'pairs'} of triangles): leak, coaptation and forces of this valve are wrong. Undo the last operation; where the file has crossing leaflets, mend its mesh.`,
  /** `residual`: N, where it is known. */
  restNote: (residual: number | undefined) =>
    `The valve did not come to rest${residual === undefined ? '' : ` (${outOfBalance(residual)})`}. Do not judge it by these figures: undo the last operation, or change its size or place a little.`,
};

export const verdictTexts = {
  surface: 'A surface, not a valve yet',
  preview: 'preview',
  past: 'before',
  trying: 'trying…',
  measuring: 'Measuring…',
  leak: 'mm² leak',
  /** Reservations on a valve whose size or leaflets are not those of a mitral valve. */
  implausible: (cc: number) => `annulus ${number(cc)} mm wide: is its file in mm?`,
  notMitral: (leaflets: string[]) => `leaflets ${listOf(leaflets)}: grades of a mitral valve do not apply`,
  atPressure: ' at 120 mmHg',
  was: (orifice: string) => ` was ${orifice}`,
  at: (place: string) => `at ${place}`,
  meet: (length: string, middle: number | null) =>
    `leaflets meet over ${length} mm${middle === null ? ' (mean)' : `, A2–P2 ${number(middle)}`}`,
  meetLittle: 'Surgeons aim at 8 mm at A2–P2. ',
  ofClosed: 'when closed',
  held: (what: 'pull' | 'push') => `at rest, before the ${what}`,
  notWhileHeld: 'Leak and coaptation of moved tissue are not measured.',
  /** Chordae a little beyond their limit, which is no fault up to a load of `allowed` per cent, `goal` where that is the tour's. */
  chordsOver: (count: number, allowed: number, goal: boolean) =>
    `${count} ${count === 1 ? 'chord' : 'chordae'} over limit; ${goal ? `goal allows ${allowed} %` : `up to ${allowed} % is no fault`}`,
  but: ', but',
  /** Beside the leak of a valve from an image. */
  leakKnown: (low: number, high: number) =>
    `chordae are guessed: a leak of ${number(low)} to ${number(high)} mm² is possible`,
  /** Beside the leak of such a valve after operations. */
  leakBefore: (low: number, high: number) =>
    `chordae are guessed: the leak before the repair is known as ${number(low)} to ${number(high)} mm² only, and the result is no better known`,
  butHelp:
    'A sealed valve may still hang on guessed chordae, open too little, have an annulus that is much too small, hardly meet in the middle, miss another goal, or hang on chordae that may tear.',
  /** `adult`: the annulus is smaller than an adult's, for whom the limits hold. */
  openingIs: (area: number, word: string, adult: boolean, goal: number | null) =>
    `opens to ${number(area / 100)} cm²: ${word}${adult ? ' for an adult' : ''}${goal === null ? '' : `, goal ${number(goal / 100)}`}`,
  openingBelow: (area: number, goal: number) => {
    const [is, wanted] = apart(area / 100, goal / 100);
    return `opening ${is} cm² is below the goal ${wanted}`;
  },
  /** In place of the grade where the plan has made the annulus far too small. */
  noRepair: 'No real repair',
  folded: (percent: number) =>
    `the annulus is ${percent} % of its width before; leaflets lie in folds: do not trust the figures`,
  billows: (scallop: string, height: number) => `${scallop} billows ${number(height)} mm above the annulus`,
  /** One line of the card: of both extents, the width first, it does not say what they were. */
  undersized: (small: { extent: 'annulusCc' | 'annulusAp'; now: number; from: number }[]) => {
    const of = { annulusCc: 'wide', annulusAp: 'front to back' };
    const now = small.map((one) => number(one.now, 0)).join(' × ');
    const [{ extent, from }] = small;
    const more = small.length === 1 ? ` ${of[extent]} (was ${number(from, 0)})` : '';
    return `annulus ${now} mm${more}: much undersized`;
  },
  centreMeets: ([height, least]: [string, string]) =>
    `A2 and P2 meet over ${height} mm only, less than ${least}`,
  edgeAbove: (scallop: string, height: number) => `edge of ${scallop} ${number(height)} mm above the annulus`,
  coaptationBelow: ([length, goal]: [string, string]) => `coaptation ${length} mm is below the goal ${goal}`,
  smallAnnulus: (cc: number) =>
    `Limits of stenosis are those of adults. This annulus is smaller, ${number(cc, 0)} mm side to side: a child’s valve needs less, in proportion to the body, which is not known here.`,
  openingUnknown: 'its opening is not measured yet',
  /** `artificial`: the most loaded one is; its limit is that of a native chord. */
  chordsBeyond: (count: number, percent: number, artificial: boolean) => {
    const far = percent >= farBeyond;
    if (count > 1) {
      const most = artificial ? ' (artificial, of a native limit)' : far ? ' the limit: may tear' : '';
      return `${count} chordae over limit, up to ${shareWords(percent)}${most}`;
    }
    const words = loadWords(percent, artificial);
    if (artificial) return `artificial chord at ${words}`;
    return far ? `1 chord ${words}: may tear` : `1 chord at ${words}`;
  },
  relieved: (chords: { name: string; percent: number }[]) =>
    `${listOf(chords.map(({ name, percent }) => `${name} (before ${percent} %)`))} ${chords.length === 1 ? 'is' : 'are'} slack`,
  relievedHelp:
    'It was far beyond its working limit before and carries nothing any more: its leaflet is held by its neighbours alone.',
  attachedInVain: (names: string[]) =>
    names.length === 1
      ? `The new chord ${names[0]} is slack: it carries nothing`
      : `The new chordae ${listOf(names)} are slack: they carry nothing`,
  attachedInVainHelp:
    'In the closed valve its two ends are nearer to each other than it is long, so that it holds no leaflet: give it a shorter length.',
  chordOver: (name: string, percent: number) => `${name} ${shareWords(percent)}`,
  limitHelp:
    'Working limit: the largest stretch and pull at which chordae of this kind work; 100 % is the limit. Far beyond it, from 200 % on, a chord may tear; at which load it does is not known here. A healthy valve may have one just at its limit.',
  artificialHelp:
    'No limit of ePTFE is known here. An artificial chord is compared with the limit of a native chord of the free edge, as a measure of how much more it pulls than what it replaces; whether thread and stitches hold is not calculated.',
};

const keptPlans = (count: number): string => `${count} kept ${count === 1 ? 'plan' : 'plans'}`;
const withKept = (count: number): string => (count ? `, with its ${keptPlans(count)}` : '');

/** The present valve as the one before the repair. */
export const startTexts = {
  begin: 'Take this valve as the one before the repair',
  tip: 'Comparison, section and report then begin with this valve; the plan that led to it stays among the earlier valves',
  leaks: 'The valve leaks after this. Was that the disease, and the repair comes now?',
  title: (title: string) => (/, changed$/.test(title) ? title : `${title}, changed`),
  steps: (title: string, steps: string[]) =>
    steps.length ? `Before the repair, from “${title}”: ${steps.join('; ')}.` : '',
  done: 'This valve is the one before the repair.',
};

export const leaveTexts = {
  finished: (title: string, kept: number) =>
    `The plan “${title}” was put aside${withKept(kept)}; it reaches all goals.`,
  left: (title: string, kept: number) =>
    `The changed plan “${title || 'without a name'}” was put aside${withKept(kept)}: Plan > Earlier valves.`,
  listed: (title: string, kept: number) =>
    `“${title || 'without a name'}” was put aside${withKept(kept)}: Plan > Earlier valves.`,
  dropped: (titles: string[]) =>
    `There is no room for so many earlier valves: ${listOf(titles.map((title) => `“${title}”`))} left the list.`,
  heading: (count: number) => `Earlier valves (${count})`,
  headingTip: 'Valves that were left since the page was opened, with their plans',
  hint: 'They stay until this page is closed. What must last longer: “Save session”.',
  contents: (verdict: string, steps: number, kept: number, at: number): string =>
    [
      verdict,
      steps ? `${steps} ${steps === 1 ? 'step' : 'steps'}` : '',
      kept ? keptPlans(kept) : '',
      leaveTexts.leftAt(at),
    ]
      .filter(Boolean)
      .join(' · '),
  leftAt: (at: number): string =>
    `left at ${new Date(at).toLocaleTimeString(undefined, { hour: '2-digit', minute: '2-digit' })}`,
  again: 'Open it again',
  againTip: 'Opens this valve with its plan and kept plans; the present valve takes its place in the list',
  own: 'Your earlier repair of this valve:',
  repaired: 'Your repair of this valve can be opened again.',
  back: 'Return to it',
};

/** The question before a plan that is kept nowhere gives way to another one. */
export const askTexts = {
  title: 'The present plan gives way to another one',
  lost: (title: string, to: string, keep: 'name' | 'file') =>
    `“${to || 'Another plan'}” takes the place of your changed plan${title ? ` of “${title}”` : ''}, which ${keep === 'file' ? 'is in no file' : 'has no name'} yet. It stays among the earlier valves of the panel Plan, but only until this page is closed.`,
  keep: (name: string) => `Keep it as “${name}” first`,
  save: 'Save it to a file first',
  replace: 'Go on',
  stay: 'Stay with the present plan',
};

export const partTexts = {
  before: (value: string) => `before ${value}`,
  /** `closures`: over which the range is; 0 in a table, which says it below. */
  range: (low: string, high: string, closures: number) =>
    `${low} to ${high}${closures ? ` over ${closures} closures` : ''}`,
  spreadHelp: 'Range of this figure over closures from different folds of the leaflets',
  /** Below a table with ranges. */
  ranges: (closures: number) =>
    `“a to b” below a figure: its range over ${closures} closures from different folds of the leaflets.`,
};

export const appTexts = {
  panels: 'Panels',
  valve: 'Valve',
  repair: 'Repair',
  plan: 'Plan',
  tour: 'Learn',
  notApplied: 'Not applied yet',
  apply: 'Apply',
  discard: 'Discard',
  close: 'Close',
  closing: 'The valve is being closed…',
  stopped: 'The page stopped',
  again: 'Load it again',
  picture: 'Picture of the valve',
  compare: 'Before or now',
  drop: 'Drop a session, a valve, or a surface here',
  before: 'Before',
  now: 'Now',
  preview: 'Preview',
};

export const barTexts = {
  open: 'Open',
  save: 'Save',
  undo: 'Undo',
  redo: 'Redo',
  healthy: 'Healthy valve',
  startHealthy: 'Start from a healthy valve',
  present: 'Present valve',
  help: 'Keys and help',
  view: 'View',
  viewOf: (name: string) => `View: ${name}`,
  presets: { surgeon: 'Surgeon', ventricle: 'Ventricle', commissure: 'Behind', section: 'Section' },
  opened: 'Open',
  closed: 'Closed',
  opening: 'Open or closed',
  show: 'Show',
  cut: 'Cut plane in the picture',
  // short words below the icons; each begins the name of its button
  length: (mm: number) => `${mm} mm`,
  lengthHelp: 'In the plane through the middle of what you look at; nearer tissue is drawn larger',
  words: { cut: 'Plane', chordae: 'Chordae', names: 'Names', look: 'Turn', grasp: 'Grasp', push: 'Push' },
  chordae: 'Chordae',
  names: 'Names',
  pointer: 'Pointer',
  look: 'Turn and choose',
  grasp: 'Grasp and pull tissue',
  push: 'Push tissue with a ball',
  tools: {
    grasp: 'Drag the tissue. The living valve follows, and springs back when you let go.',
    push: 'Press on the tissue: a ball pushes it. It springs back when you let go.',
  },
  colours: 'Colours',
  atrial: 'atrial side',
  ventricular: 'ventricular side',
  leak: 'leak; arrow: its jet',
  over: 'chord beyond its limit',
  slack: 'slack chord',
  artificial: 'artificial chord',
  stitch: 'clip, suture',
};

export const valveTexts = {
  coaptationMean: 'Coaptation length, mean',
  coaptationMeanHelp:
    'Length over which the leaflets lie against each other. Surgeons aim at 8 mm or more at A2-P2.',
  coaptationHeight: 'Coaptation height, A2–P2',
  coaptationHeightHelp:
    'How high the leaflets touch in the middle section, along the axis of the valve. The table gives the coaptation of A2 and P2 along the leaflets, which is longer where they lie at a slant.',
  alongLeaflets: 'along the leaflets',
  alongAxis: 'along the axis',
  tenting: 'Tenting height',
  tentingHelp: 'Deepest point of the closed leaflets below the plane of the annulus',
  billow: 'Billow above annulus',
  billowHelp:
    'Highest point of all leaflets above the surface of the annulus, mostly in the middle of a scallop; more than 2 mm counts as prolapse. The table gives it by scallop, and how high each free edge stands.',
  /** Where a largest value of the whole valve is. */
  at: (scallop: string) => `at ${scallop}`,
  annulus: 'Annulus',
  ap: 'Front to back (AP)',
  cc: 'Side to side (CC)',
  circumference: 'Circumference',
  area: 'Area',
  section: 'Section through the valve',
  physics: 'Physics',
  coaptationArea: 'Coaptation area',
  coaptationLeast: 'Coaptation, least',
  tentingVolume: 'Tenting volume',
  billowVolume: 'Billow volume',
  saddle: 'Saddle height',
  angle: 'Non-planar angle',
  stretch95: 'Leaflet stretch, 95th percentile',
  stress95: 'Leaflet stress, 95th percentile',
  strongestPull: 'Strongest chord pull',
  pullOn: (head: string) => `Pull on ${head}`,
  head: (h: number) => `head ${h}`,
  closedAt:
    'Closed at 120 mmHg. Identity of this valve, to tell whether two files or reports are of the very same one:',
  chordsCross:
    'Chordae are straight lines between their ends, and leaflets do not push them aside: in the picture of an open valve a chord may pass through a leaflet. Its pull and its length are those of the straight line.',
  howCertain: 'Close it 8 times',
  spread: (converged: number, members: number, shapes: number, apart: number) =>
    `${converged} of ${members} closures came to rest, ${shapes === 1 ? `with the same result whichever way it closes${apart < 0.05 ? '' : `, at most ${number(apart)} mm apart`}` : `in ${shapes} shapes of the folds, which differ by at most ${number(apart)} mm`}. This says nothing of errors of the image or of the chordae.`,
  spreadLeak: (low: number, high: number) =>
    number(low) === number(high)
      ? ` Leak ${number(low)} mm² each time.`
      : ` Leak ${number(low)} to ${number(high)} mm².`,
  certainty: 'How certain it is',
  /** Uncertainties that the eight closures test, and those that they do not. */
  certaintyHint:
    'The leaflets can fold in more than one way: closed from eight different folds, the figures show how much that changes them.',
  outflow:
    'Risk of an obstructed outflow tract (SAM): not determined, because the septum is not known here. A small ring and long leaflets raise it.',
  opens: 'How far it opens',
  openArea: 'Open area in diastole',
  /** Beside an open area that is wider than in life. */
  wideMark: '*',
  openAreaWide:
    '* More than the 4 to 6 cm² of healthy adults: the wall of the ventricle, which would stop the leaflets, is missing here.',
  openAreaHelp: 'Smallest opening at 5 mmHg. In adults 1.5 cm² or less is a severe stenosis (ACC/AHA 2014).',
  annulusPull: 'Pull on the annulus',
  lengths: 'Length of A2 and P2 that is free',
  lengthsUnknown: 'none: A2 and P2 do not touch in the middle',
  lengthsOf: (anterior: number, posterior: number) => `${number(anterior)} and ${number(posterior)} mm`,
  measureOpen: 'Measure the open area',
  flow: 'Flow through the open valve',
  flowUnit: 'ml/s',
  flowHint: (low: number, high: number) =>
    `Mean flow while the ventricle fills, about 200 ml/s at rest; from ${low} ml/s to ${high} ml/s. Without it there is no gradient.`,
  flowOutside: (given: number, low: number, high: number) =>
    `${String(given).replace('-', '−')} ml/s is out of range; it has to be ${low} to ${high} ml/s. No gradient is shown.`,
  gradient: 'Mean pressure gradient',
  gradientHelp:
    'Pressure lost by the flow through the open area; more than 5 mmHg is too much after a repair',
};

export const tableTexts = {
  scallops: 'Scallop by scallop',
  scallop: 'Scallop',
  coaptation: 'Coaptation, mm',
  leak: 'Leak, mm²',
  billow: 'Billow, mm',
  billowHelp: 'Highest point above the surface of the annulus; – where there is none',
  edge: 'Edge, mm',
  edgeHelp:
    'Highest point of the free edge above (+) or below (−) the plane of the annulus. An edge above it prolapses; flail, it stands in the atrium.',
  signed: (value: number) =>
    number(value)
      .replace('-', '−')
      .replace(/^(?=\d)/, '+'),
  commissure: (name: string) => `Commissure ${name.replace('-', '–')}`,
  was: (value: string) => ` was ${value}`,
  leakHint: 'A leak between two leaflets counts by half for the scallop on either side.',
  chordae: (count: number) => `Chordae (${count})`,
  chordaeHint: 'The most loaded first. Choose one to shorten, lengthen or cut it.',
  artificialHint: 'Artificial chordae: % of the limit of a native one.',
  chord: 'Chord',
  length: 'Rest length, mm',
  pull: 'Pull, mN',
  ofLimit: '% of limit',
  slack: 'slack',
};

/** Fewest points of a ring from a file. */
export const fewestPoints = 8;

export const deviceTexts = {
  title: (count: number) => `Implants and sutures (${count})`,
  device: 'Device',
  figures: 'Figures',
  ring: (cc: number, ap: number, round: number) =>
    `${number(cc)} mm wide, ${number(ap)} mm front to back, ${number(round, 0)} mm around`,
  band: (length: number) => `${number(length, 0)} mm long`,
  names: {
    ring: 'Ring',
    band: 'Posterior band',
    clip: 'Clip',
    neochord: 'Artificial chord',
    suture: 'Suture',
  },
  /** Its kind, and its name unless the library gave it: "clip" and "clip2" are Clip and Clip 2. */
  named: (kind: string, name: string) => {
    const given = /^(?:ring|band|clip)(\d*)$/.exec(name);
    return given ? `${kind} ${given[1]}`.trimEnd() : `${kind} ${name}`;
  },
  /** `set`: as it was chosen; `apart`: its outermost stitches in the closed valve. */
  clip: (clip: { between: string[]; set: ClipWords | null; apart: number; pull: number; arm: number }) =>
    `joins ${listOf(clip.between)}, ${clip.set === null ? `outermost stitches ${number(clip.apart, 0)} mm apart` : clipSaid(clip.set)}, strongest pull ${millinewton(clip.pull)}; drawn with arms that reach ${number(clip.arm)} mm to either side, which the model does not know`,
  suture: (of: string[]) => `closes the cut in ${listOf(of)}`,
  neochord: (chord: { rest: number; tension: number; heads: string; scallops: string }) =>
    `${chord.heads} to ${chord.scallops}, ${number(chord.rest)} mm without pull, ${chord.tension > 0 ? `pull ${millinewton(chord.tension)}` : 'slack'}`,
};

export const formTexts = {
  leave: 'Leave without a change',
  more: 'More',
  enter: '(Enter)',
  questions: {
    site: 'Click the place on the leaflet; or the arrow keys move a cross, and Space clicks.',
    head: 'Click a papillary head, or choose it below.',
    chord: 'Click a chord, or choose it below.',
    scallop: 'Click a scallop, or choose it below.',
    points: 'Click along the cut on the leaflet, from free edge to free edge.',
  } as Record<string, string>,
  slack: 'Slack in the preview: it carries nothing.',
  change: (was: number, now: number) =>
    Math.abs(now - was) < 0.06
      ? 'as at present'
      : `was ${number(was)} mm, ${now < was ? 'shorter' : 'longer'} by ${number(Math.abs(now - was))} mm`,
  annulus: (was: { ap: number; cc: number }, now: { ap: number; cc: number }) =>
    `Annulus front to back ${number(was.ap)} → ${number(now.ap)} mm, side to side ${number(was.cc)} → ${number(now.cc)} mm.`,
  sizeFrom: (cc: number) =>
    `Width from commissure to commissure. The annulus of the closed valve measures ${number(cc)} mm.`,
  leftEmpty: (fallback: string) => `Left empty: ${fallback}.`,
  /** `largest`: there is no larger ring. */
  narrower: (size: number, annulus: number, largest: boolean) =>
    `${largest ? `The largest ring, ${number(size, 0)} mm,` : `A ring of ${number(size, 0)} mm`} is ${number(annulus - size)} mm (${number((100 * (annulus - size)) / annulus, 0)} %) narrower than this annulus.`,
  ringSizes: (low: number, high: number) => `Rings are made in sizes of ${low} to ${high} mm. `,
  /** Sentence about a number that its slider does not reach. */
  beyond: (value: number, low: number, high: number, unit: string) => {
    const [all, from, to] = [value, low, high].map((one) => +one.toPrecision(4));
    return `${all} ${unit} is beyond the slider, which goes from ${from} to ${to} ${unit}.`;
  },
  /** Refusal of a text that is no number; `kept` stays in its box. */
  noNumber: (text: string, kept: string) =>
    `“${text}” is no number here: write 8.5 or 8,5, and no sign between thousands. ${kept ? `It stays ${kept}.` : 'The field stays empty.'}`,
  /** Refusal of a number that no operation takes. */
  outside: (label: string, value: number, low: number, high: number, unit: string) => {
    const [is, from, to] = [value, low, high].map((one) => String(+one.toPrecision(4)).replace('-', '−'));
    const of = unit && ` ${unit}`;
    return `${label}: ${is}${of} is out of range; it has to be ${from} to ${to}${of}.`;
  },
  oversized: (more: number) =>
    `Oversized: ${number(more)} mm wider than the annulus. It spreads the leaflets instead of bringing them nearer.`,
  bandLength: (mm: number | null) =>
    `In the preview: ${mm === null ? '…' : number(mm)} mm along its curve, from trigone to trigone.`,
  /** The place of a clip in its preview. */
  placed: (place: string | null) => `In the preview: ${place ?? '…'}`,
  auto: 'auto',
  choose: 'choose…',
  none: 'none',
  default: 'default',
  pick: (label: string) => `Pick in the picture: ${label}`,
  picked: (scallop: string) => `picked on ${scallop}`,
  along: (percent: number) => `Along the scallop: ${percent} % from its posteromedial end`,
  height: (percent: number) => `From annulus to free edge: ${percent} %`,
  alongTip: 'Along the scallop',
  sides,
  /** The direction of a position, beside its number, which has no sign. */
  towards: sides.map((side) => `towards ${side}`),
  side: 'Side of the middle',
  towardsTip: 'To which side of the middle; anterolateral is left in the surgeon’s view',
  /** A position between the ends of a scallop, from -1, posteromedial, to 1. */
  position: (value: number) =>
    value === 0
      ? 'in the middle of the scallop'
      : `${number(100 * Math.abs(value), 0)} % of the way to the ${sides[value > 0 ? 0 : 1]} end`,
  heightTip: 'From annulus to free edge',
  /** Meaning of the left and the right end of the sliders of a shift. */
  axisEnds: [
    ['posterior', 'anterior'],
    ['anterolateral', 'posteromedial'],
    ['ventricle', 'atrium'],
  ],
  /** A shift along the front, the anterolateral side or the atrium. */
  shift: (axis: number, value: number) => {
    const to = [
      ['Backwards', 'Front to back', 'Forwards'],
      ['Towards the posteromedial side', 'Side to side', 'Towards the anterolateral side'],
      ['Towards the ventricle', 'Up and down', 'Towards the atrium'],
    ][axis][1 + Math.sign(value)];
    return `${to}: ${number(Math.abs(value))} mm`;
  },
  fileAxis: (axis: number, value: number) => `${'xyz'[axis]} of the file: ${number(value)} mm`,
};

/** Where the cut plane is, mm from the middle. */
const awayWords = (mm: number): string =>
  `${number(Math.abs(mm))} mm from the middle towards the ${formTexts.sides[mm > 0 ? 0 : 1]} commissure`;

/** Names in the picture, of handles too. */
export const markTexts = {
  plane: (through: string[], mm: number) =>
    `Cut plane through ${listOf(through)}${mm === 0 ? '' : `, ${number(Math.abs(mm))} mm towards ${formTexts.sides[mm > 0 ? 0 : 1]}`}: drag`,
  chord: (name: string, length: number, percent: number | null, artificial: boolean) =>
    `${name}  ${number(length)} mm${percent === null ? '' : `, ${loadWords(percent, artificial)}`}`,
  clip: 'Clip: drag',
  turn: (angle: number) => (angle ? `Turn: ${number(angle, 0)}°` : 'Turn: drag'),
};

export const openingTexts = {
  opens: (area: number | undefined) =>
    `Opens to ${area === undefined ? '…' : areaFigure(area)} cm² in diastole`,
  gradient: (now: number, flow: number, before: number | null) =>
    `Mean gradient at ${number(flow, 0)} ml/s ${number(now)} mmHg${before === null ? '' : `, without it ${number(before)}`}.`,
  narrow: (word: string) =>
    word === 'narrow'
      ? 'Narrow: a mean flow of 200 ml/s loses more than 5 mmHg.'
      : `${word[0].toUpperCase()}${word.slice(1)}: in adults 1.5 cm² or less is severe, 1.0 cm² or less very severe (ACC/AHA 2014).`,
  /** Question beside the figure; a press shows the answer. */
  why: (word: string, less: boolean) =>
    [word && `${word[0].toUpperCase()}${word.slice(1)}`, less ? 'Why so much less?' : 'Why?']
      .filter(Boolean)
      .join('. '),
  whyTip: 'What narrows the valve here, and what to compare the figure with',
  clip: 'The clip holds both leaflets together over its width and as deep as its arms grasp, with stitches that hardly give; beside it, too, the edges cannot part to their full distance. Blood passes on both sides of it: the figure is both openings together. A narrower clip, or one nearer to a commissure, leaves a little more.',
  measured:
    '“Without it” is the present valve before this operation, measured in the same way: its smallest opening at 5 mmHg. To compare: 4 to 6 cm² in healthy adults, 1.5 cm² or less in severe stenosis.',
  elsewhere:
    'The annulus is not its narrowest place: that is between the tips of the leaflets, which the chordae hold. A much smaller ring would narrow it.',
  /** `same`: the opening does not differ from that before by more than is known of it. */
  beside: (before: number | undefined, least: number | null, same: boolean) =>
    [
      before === undefined
        ? ''
        : `${same ? 'about the same as without it' : 'without it'} ${areaFigure(before)} cm²`,
      least === null ? '' : `goal ${areaFigure(least)} cm² or more`,
    ]
      .filter(Boolean)
      .join(', '),
  help: 'Smallest opening of the valve at 5 mmHg after this operation; a ring or clip can narrow it.',
};

/** Where a drawn cut is: its leaflet, and the scallop of each of its points. */
interface CutPlace {
  leaflet: string;
  scallops: string[];
}

/** "posterior leaflet" for the name that the library gives it. */
const leafletWords = (name: string): string =>
  `${({ A: 'anterior', P: 'posterior' } as Record<string, string>)[name] ?? name} leaflet`;

const cutWords = ({ leaflet, scallops }: CutPlace): string =>
  `in the ${leafletWords(leaflet)}, ${listOf([...new Set(scallops)].sort())}`;

export const pointTexts = {
  keys: 'Keyboard: arrows move a cross (Shift: finely), Space sets a point, Backspace removes it, Enter uses the cut. Control and arrows turn the valve.',
  under: (what: string, count: number | null) =>
    [what ? `On ${what}.` : 'Beside the valve.', count === null ? '' : `${count} points.`]
      .filter(Boolean)
      .join(' '),
  draw: 'Draw the cut in the picture',
  drawAgain: 'Draw it again',
  outlined: (on: CutPlace) => (on.leaflet ? `The cut as drawn is ${cutWords(on)}.` : 'Cut as drawn.'),
  otherLeaflet: (scallop: string, leaflet: string) =>
    `That click was on ${scallop}: no point was set. The cut is in the ${leafletWords(leaflet)}, where it began; to cut the other one, remove its points first.`,
  use: 'Use this cut',
  back: 'Remove last point',
  count: (count: number, on: CutPlace) =>
    [
      count ? `The cut is ${cutWords(on)}.` : '',
      count < 2
        ? 'Click two or more points on the leaflet, around the piece to take out.'
        : `${count} points; the ends lead to the free edge.`,
    ]
      .filter(Boolean)
      .join(' '),
  curve: 'Or a measured ring, from a file',
  curveHint: 'One point of the ring in each line: x, y, z in mm or m (text, CSV, OBJ).',
  curveRead: (count: number) => `${count} points read; the ring is laid on the annulus.`,
  fewPoints: (name: string, count: number) =>
    `${name} has ${count} lines with x, y and z: a ring needs at least ${fewestPoints}.`,
  remove: 'Remove',
};

export const repairTexts = {
  more: 'More operations',
  hint: 'Click a chord, a papillary head or a leaflet in the picture, or choose an operation.',
  chord: (name: string) => `Chord ${name}`,
  between: (kind: string, heads: string, scallops: string) =>
    `${kind} chord, from ${heads ? `head ${heads}` : 'a branch'} to ${scallops || 'a branch'}`,
  rest: 'Rest length',
  pull: 'Pull',
  stretch: 'Stretch',
  slack: 'slack',
  limit: 'Share of its limit',
  nativeLimit: 'Share of a native limit',
  limitIn: (limit: string) => `limit ${limit}`,
  /** Beside a share of a limit in per cent. */
  far: (percent: number, artificial: boolean) =>
    percent < farBeyond || artificial ? '' : `far beyond it: ${shareWords(percent)}`,
  becomes: (was: string, now: string) => `${was} → ${now}`,
  letGo: 'Let go of this part',
  changeLength: 'Change length',
  cut: 'Cut',
  transfer: 'Transfer',
  drag: 'Or drag the blue chord in the picture: towards the muscle shortens it.',
  head: (name: string) => `Papillary head ${name}`,
  pullOfChordae: 'Pull of its chordae',
  neochordFrom: 'Artificial chord from here',
  move: 'Move',
  scallop: (name: string) => `Scallop ${name}`,
  coaptation: 'Coaptation',
  leak: 'Leak',
  billow: 'Billow above the annulus',
  edge: 'Free edge',
  edgeAt: (mm: number) => `${number(Math.abs(mm))} mm ${mm > 0 ? 'above' : 'below'} the annulus`,
  none: 'none',
  neochord: 'Artificial chord',
  resect: 'Resect',
  clip: 'Clip',
};

export const planTexts = {
  nothing: 'Nothing has been done yet. Operations appear here one by one.',
  allUndone: 'All steps are undone. Redo brings them back one by one.',
  checkpoints: 'Kept plans',
  checkpointName: 'Name of the plan',
  planOf: (k: number) => `Plan ${k}`,
  rename: (name: string) => `Rename “${name}”`,
  newName: (name: string) => `New name of “${name}”`,
  remove: (name: string) => `Delete “${name}”`,
  removed: (name: string) => `“${name}” was deleted.`,
  replaced: (name: string) => `The earlier “${name}” was replaced.`,
  putBack: 'Put it back',
  copyOf: (name: string, k: number) => `${name} (${k})`,
  keep: 'Keep this plan',
  files: 'Save and report',
  returnTo: 'Return to it',
  compare: 'Compare',
  endCompare: 'End the comparison',
  present: 'Present plan',
  result: 'Result:',
  steps: 'Steps',
  none: 'none',
  notes: 'Notes',
  save: 'Save session',
  obj: 'Valve as OBJ',
  report: 'Report',
  autosave: 'Keep a copy in this browser, to recover after a crash',
  autosaveHint:
    'Any page opened from this computer’s disk in this browser could read that copy, and the browser may remove it. Nothing is sent anywhere.',
  keepFile: 'Save every change to a file…',
  keptFile: (name: string) => `Every change is saved to ${name}.`,
  stopFile: 'Stop',
  noFile: 'This browser cannot save changes to a file by itself: use “Save session”.',
  noStorage: 'This browser refuses storage to pages from disk: save the session to a file.',
};

/** Names of figures in the comparison and in the report. */
export const figureNames = {
  plan: 'Plan',
  verdict: 'Verdict',
  orifice: 'Leak',
  coaptationMean: 'Coaptation length, mean',
  coaptationHeight: 'Coaptation height A2–P2',
  tentingHeight: 'Tenting height',
  billowHeight: 'Billow above annulus',
  annulusAp: 'Annulus front to back (AP)',
  annulusCc: 'Annulus side to side',
  chordsOver: 'Chordae beyond their limit',
  maxChordTension: 'Strongest chord pull',
};

export const reportTexts = {
  title: 'Report',
  fileTitle: 'Valve report',
  fileName: (title: string) => `${title || 'valve'} report.html`,
  /** `name`: under which the plan is kept; `doubtful`: its figures do not count. */
  closed: (when: string, name: string, doubtful: boolean) =>
    `${when}. ${name ? `The plan “${name}”` : 'The present plan, which is not kept under a name'}, ${doubtful ? 'under 120 mmHg, but without a valid closed state' : 'closed at 120 mmHg'}.`,
  otherPlans: 'This plan and the other kept plans',
  notMeasured: 'not measured',
  coming: '…',
  /** `left`: open areas that are still to be measured. */
  measuring: (left: number) => `Open areas are being measured: ${left} to come.`,
  before: 'Before',
  after: 'After',
  section: 'Section through the middle',
  thin: 'grey line: annulus',
  dashed: 'dashed: before',
  line: 'line: after',
  views: { surgeon: 'From the atrium', ventricle: 'From the ventricle' },
  plan: 'Plan',
  nothing: 'Nothing was done.',
  figures: 'Figures',
  notes: 'Notes',
  foot: (version: string, hash: string) =>
    `libmvs ${version}, identity of the repaired valve ${hash} (equal only for the very same valve). Research simulator: not for decisions on treatment.`,
  gradient: (flow: number) => `Mean pressure gradient at ${number(flow, 0)} ml/s`,
  save: 'Save as HTML',
  print: 'Print',
};

export const dialogTexts = {
  pointer:
    'Left button or one finger turns; right button or two fingers move; wheel or pinch zooms. Click chooses.',
  licences: 'Licences',
  about: (version: string) =>
    `${t.research} libmvs ${version}. The page calculates in your browser and cannot connect to anything.`,
  left: (title: string, saved: string, surface: boolean) =>
    `${surface ? 'A surface with marked points' : 'A session'} was left here: ${title || 'without a name'}, ${saved}.`,
  recover: 'Recover it',
  forget: 'Delete it',
};

export const sectionTexts = {
  label: 'Section through the leaflets',
  posterior: 'posterior →',
  atrium: 'atrium',
  ventricle: 'ventricle',
  annulus: 'plane of the annulus, in the mean',
  hinges: 'from hinge to hinge',
  anterior: '← anterior',
  scale: '10 mm',
  healthy: 'before its illness',
  now: 'now',
  closed: 'closed',
  before: 'before',
  preview: 'preview',
  plane: (mm: number, through: string[]) =>
    `Cut plane through ${listOf(through)}, ${mm === 0 ? 'in the middle' : awayWords(mm)}`,
  middle: 'To the middle',
  cut: 'Cut plane in the picture',
};

interface Meaning {
  /** As the page labels it, in all places. */
  names: string[];
  unit: string;
  meaning: string;
  measured: string;
}

/** Meaning of each figure of the page and of the names of the scallops. */
export const figureHelp: {
  title: string;
  intro: string;
  unit: string;
  measured: string;
  sketch: string;
  sides: string[];
  front: string;
  back: string;
  scallops: string[];
  groups: { title: string; figures: Meaning[] }[];
} = {
  title: 'What the figures mean',
  intro:
    'All figures are of the valve closed under 120 mmHg, unless they say otherwise. “before” is the valve before the first operation of the plan; with a form open, before this operation.',
  unit: 'Unit',
  measured: 'Measured',
  sketch:
    'The valve as the surgeon sees it from the atrium: A1, A2, A3 of the anterior leaflet above from left to right, P1, P2, P3 of the posterior leaflet below, the anterolateral commissure on the left, the posteromedial one on the right.',
  sides: ['AL', 'PM'],
  front: 'front: aorta',
  back: 'back',
  scallops: [
    'A1, A2, A3 are parts of the anterior leaflet and P1, P2, P3 scallops of the posterior leaflet (Carpentier). 1 is beside the anterolateral commissure, 3 beside the posteromedial one, 2 in the middle.',
    'A1–P1 and A3–P3 are the commissures. AL and PM are the anterolateral and the posteromedial papillary muscle, AL1 to AL3 heads of it. A2/13 is chord 13 of A2.',
  ],
  groups: [
    {
      title: 'Leak',
      figures: [
        {
          names: ['Leak', 'Orifice'],
          unit: 'mm²',
          meaning: 'How large the hole is that stays open in systole; 0 is sealed.',
          measured:
            'The smallest cross-section through which blood gets between the leaflets back into the atrium. Beside a scallop, half of it counts for either side.',
        },
        {
          names: ['Grade'],
          unit: 'in words',
          meaning:
            'Sealed, mild, moderate, moderate–severe, severe. “Sealed, but” names what is wrong beside: guessed chordae, a narrow opening, a much undersized annulus, leaflets that hardly meet in the middle, an unmet goal, chordae that may tear.',
          measured:
            'By the leak: below 20, 30, 40 mm², and more, as an effective orifice in echocardiography.',
        },
      ],
    },
    {
      title: 'How the leaflets meet',
      figures: [
        {
          names: [valveTexts.coaptationMean, valveTexts.coaptationLeast, 'Coaptation'],
          unit: 'mm',
          meaning:
            'How much leaflet lies against the other one. More is a reserve; surgeons aim at 8 mm at A2–P2.',
          measured:
            'Along the tissue, from the free edge towards the annulus: the mean and the least of the whole line of closure, in which a gap counts as 0.',
        },
        {
          names: [valveTexts.coaptationHeight],
          unit: 'mm',
          meaning: 'The height of contact that a long-axis view of echocardiography shows.',
          measured: 'Straight along the axis of the valve, in the section through the middle of A2 and P2.',
        },
        {
          names: [valveTexts.coaptationArea],
          unit: 'mm²',
          meaning: 'How much tissue of one leaflet touches the other one.',
          measured: 'One side of the contact.',
        },
      ],
    },
    {
      title: 'The shape of the leaflets',
      figures: [
        {
          names: [valveTexts.billow, valveTexts.billowVolume, 'Billow'],
          unit: 'mm, ml',
          meaning: 'How far the leaflets bulge into the atrium; more than 2 mm counts as prolapse.',
          measured: 'The highest point, and the volume, above a surface that spans the annulus.',
        },
        {
          names: ['Edge', 'Free edge'],
          unit: 'mm',
          meaning:
            'How high the free edge of a scallop stands. Above the annulus it prolapses; flail, it stands in the atrium.',
          measured: 'Its highest point above (+) or below (−) the plane of the annulus.',
        },
        {
          names: [valveTexts.tenting, valveTexts.tentingVolume],
          unit: 'mm, ml',
          meaning: 'How deep chordae and papillary muscles hold the closed leaflets in the ventricle.',
          measured: 'The deepest point below the plane of the annulus, and the volume between the two.',
        },
        {
          names: [valveTexts.stretch95, valveTexts.stress95],
          unit: '%, kPa',
          meaning:
            'How much the tissue of the leaflets is stretched and loaded. Compare them before and after, not with another patient.',
          measured: 'The value that 95 % of the tissue stays below.',
        },
      ],
    },
    {
      title: 'Annulus',
      figures: [
        {
          names: [valveTexts.ap, valveTexts.cc],
          unit: 'mm',
          meaning: 'Depth and width of the annulus; 24 to 29 and 35 to 39 mm in healthy adults.',
          measured:
            'In systole, from the middle of the anterior annulus to the middle of the posterior one, and between the commissures.',
        },
        {
          names: [valveTexts.circumference, valveTexts.area],
          unit: 'mm, cm²',
          meaning: 'The length of the annulus, and the area that it surrounds.',
          measured: 'Along the annulus; the area as seen from the atrium.',
        },
        {
          names: [valveTexts.saddle, valveTexts.angle],
          unit: 'mm, °',
          meaning: 'How much the annulus is a saddle and not flat.',
          measured:
            'From its lowest to its highest point; the angle at the middle between front and back, 180° if it is flat.',
        },
        {
          names: [valveTexts.annulusPull],
          unit: 'N',
          meaning: 'How strongly the closed leaflets pull at annulus, ring or band.',
          measured: 'The sum of all forces of the leaflets on the annulus.',
        },
      ],
    },
    {
      title: 'How it opens',
      figures: [
        {
          names: [valveTexts.openArea],
          unit: 'cm²',
          meaning:
            'The smallest opening for the inflow. 1.5 cm² or less is a severe stenosis in adults (ACC/AHA 2014).',
          measured:
            'On a copy of the valve that is opened by 5 mmHg, between the leaflets or at the annulus, whichever is smaller.',
        },
        {
          names: [valveTexts.gradient],
          unit: 'mmHg',
          meaning:
            'The pressure that the inflow loses at the valve; more than 5 mmHg is too much after a repair.',
          measured: 'From the open area and the flow that you give (Gorlin).',
        },
      ],
    },
    {
      title: 'Chordae',
      figures: [
        {
          names: [tableTexts.pull, repairTexts.pull, valveTexts.strongestPull],
          unit: 'mN',
          meaning: 'How strongly a chord is pulled; 1,000 mN are 1 N, about the weight of 100 g.',
          measured: 'From its stretch, stiffness and thickness; a slack chord has no pull.',
        },
        {
          names: [valveTexts.pullOn('a papillary head')],
          unit: 'N',
          meaning: 'How strongly its chordae pull at a head of a papillary muscle.',
          measured: 'The sum of the pulls of its chordae, each in its direction.',
        },
        {
          names: [tableTexts.length, repairTexts.stretch],
          unit: 'mm, %',
          meaning:
            'The length of a chord before it becomes taut, and how much longer than that it is under load.',
          measured: 'Along the straight line between its ends.',
        },
        {
          names: [tableTexts.ofLimit, repairTexts.limit],
          unit: '%, or times',
          meaning:
            'The load of a chord beside the load at which such chordae work. Beyond 100 % look at it; from 200 % on it is far beyond and may tear. At which load it tears is not known here.',
          measured:
            'The larger share of two limits: a stretch of 11.1 %, and a pull of 2 N for strut chordae and trunks, 0.8 N for others. Artificial chordae are compared with the limit of native ones.',
        },
      ],
    },
    {
      title: 'How certain it is',
      figures: [
        {
          names: ['“a to b over 8 closures”'],
          unit: 'of its figure',
          meaning:
            'The leaflets can fold in more than one way, and a figure differs a little from one way to another.',
          measured:
            'The least and the largest value, when the valve is closed eight times from different folds.',
        },
      ],
    },
  ],
};

export const gestureTexts = {
  chord: (chord: {
    name: string;
    rest: number;
    tension: number;
    strain: number;
    percent: number | null;
    artificial: boolean;
  }) =>
    `${chord.name}: ${number(chord.rest)} mm without pull, ${chord.strain > 0 ? `pull ${millinewton(chord.tension)}, stretch ${number(100 * chord.strain)} %` : 'slack'}${chord.percent === null ? '' : `, ${loadWords(chord.percent, chord.artificial)}`}`,
};

/** Words for the values of a choice, where those of the library are not a surgeon's. */
export const choiceWords: Record<string, string> = {
  scene: 'the axes of the file',
  valve: 'the valve: front, side, atrium',
  rough_zone: 'rough zone',
  head: 'at the papillary muscle',
  leaflet: 'at the leaflet',
};

/** Purpose of an operation, on its card. */
export const operationTips: Record<string, string> = {
  ring: 'A rigid ring brings the annulus to a chosen width and form, so that the leaflets meet over a greater height.',
  band: 'A flexible band shortens the posterior annulus; the anterior annulus and its movement stay free.',
  annulus_scale: 'Tries out how large the annulus should be, before a ring or a band is chosen.',
  neochord: 'Holds a prolapsing edge: click its place on the leaflet, then a papillary muscle.',
  chord_length: 'Shortens a chord that lets its leaflet prolapse, or lengthens one that holds it too deep.',
  chord_remove: 'Cuts a chord, as before a transfer, or to see what a rupture does.',
  chord_transfer: 'Moves one end of a chord to another place of a leaflet, or to another papillary muscle.',
  head_move: 'Moves the tip of a papillary muscle, as a displaced ventricle does or as its relocation does.',
  clip: 'Holds both edges together where they prolapse or leak; the valve then opens through two smaller orifices.',
  resect: 'Takes a prolapsing piece out of a leaflet and sutures the gap.',
  patch: 'Enlarges a leaflet that is too small to reach the other one.',
  chord_add: 'Ties a chord with the stiffness of natural tissue, as in a transplantation of chordae.',
};

const newLength = 'Rest length, without pull. Left empty, the chord becomes as taut as its neighbours.';
const nameTip = 'Its name in lists, in the history and in the report';
const fromMuscle = 'The papillary muscle from which it comes; or click it in the picture';
const onLeaflet = 'Where it is tied to the leaflet; or click the place in the picture';

/** Effect of a field of an operation, in a surgeon's words. */
export const fieldTips: Record<string, Record<string, string>> = {
  ring: {
    size: 'Width of the ring from commissure to commissure. A smaller ring brings the leaflets nearer, and the valve opens less.',
    ap_ratio: 'Depth of the ring from front to back, as a share of its width',
    saddle: 'How far the ring rises in front and behind over its sides',
    curve: 'A measured ring: a file with one point in each line',
    name: nameTip,
  },
  band: {
    factor: 'How far the posterior annulus is gathered: the share of its present length that remains',
    length: 'Length of the band from trigone to trigone',
    name: nameTip,
  },
  annulus_scale: {
    factor: 'The share of its present size that the annulus gets in all directions',
    ap: 'A further change from the anterior to the posterior leaflet only',
    cc: 'A further change from commissure to commissure only',
  },
  neochord: {
    head: fromMuscle,
    site: onLeaflet,
    length: newLength,
    strands: 'How many threads run side by side; they share the pull',
    diameter: 'How thick each thread is',
    young: 'How stiff the thread is; the stiffness of ePTFE is usual',
    name: nameTip,
  },
  chord_add: {
    head: fromMuscle,
    site: onLeaflet,
    length: newLength,
    type: 'The kind of chord, on which its working limit depends',
    area: 'How much tissue carries the pull',
    young: 'How stiff the tissue of the chord is',
    name: nameTip,
  },
  chord_length: {
    chord: 'The chord that is changed; or click it in the picture',
    length: 'The new rest length, without pull. Shorter holds the leaflet deeper in the ventricle.',
    factor: 'The new length as a share of the present one; less than all of it shortens',
  },
  chord_remove: { chord: 'The chord that is cut; or click it in the picture' },
  chord_transfer: {
    chord: 'The chord whose end is moved; or click it in the picture',
    end: 'Which end is moved: at the leaflet or at the papillary muscle',
    site: 'The new place on a leaflet; or click it in the picture',
    head: 'The new papillary muscle; or click it in the picture',
    length:
      'Rest length, without pull. Left empty, it stays for another leaflet, and is made as taut as its neighbours for another muscle.',
  },
  head_move: {
    head: 'The papillary muscle whose tip is moved; or click it in the picture',
    by: 'How far the tip is moved in each direction',
    frame: 'Whether the directions are those of the valve or those of the file',
  },
  clip: {
    anterior: 'The scallop of the anterior leaflet that is grasped',
    posterior: 'The scallop of the posterior leaflet that is grasped',
    position:
      'Where the clip stands along the edge, from the posteromedial to the anterolateral end of the scallop',
    angle:
      'The turn of the arms, against the clock as seen from the atrium; without it they stand across the edge',
    width: 'How much of the edge the clip joins',
    reach: 'How much tissue of each leaflet the arms grasp, from the edge',
    name: nameTip,
  },
  resect: {
    scallop: 'The scallop from which the piece is taken; or click it in the picture',
    position:
      'Where the middle of the piece is, from the posteromedial to the anterolateral end of the scallop',
    width: 'How much of the free edge is taken out',
    base_width: 'How wide the piece is at the annulus. Left empty, it is a triangle.',
    depth: 'How far the piece reaches from the free edge towards the annulus',
    outline: 'A cut of any form, drawn on the leaflet',
  },
  patch: {
    site: 'Where the middle of the patch is; or click the place in the picture',
    width: 'Size of the patch along the leaflet, side to side',
    height: 'Size of the patch from the annulus towards the free edge',
    area_factor: 'How much larger the patch is than the hole that it closes',
    thickness: 'How thick the pericardium is',
  },
};

/** The tooltip of a field; of an operation that the page does not know, the library's words without its numbers. */
export function fieldTip(kind: string, name: string, help: string, usual: string): string {
  const words = fieldTips[kind]?.[name] ?? help.replace(/\s*\[.*\]/, '');
  return usual ? `${words.replace(/\.$/, '')}. Left empty: ${usual}.` : words;
}

/** Tooltips of controls by their visible words: what happens when they are used. */
export const tips: Record<string, string> = {
  [barTexts.open]: 'Opens a saved session, a valve, or the surface of a patient’s valve (STL, PLY, OBJ)',
  [barTexts.save]: 'Saves the valve with its plan, kept plans and notes as one file on this computer',
  [barTexts.undo]: 'Takes the last operation back',
  [barTexts.redo]: 'Does the operation again that was taken back last',
  [barTexts.startHealthy]: 'Leaves this plan for a healthy valve; you can return to a changed plan',
  [barTexts.help]: 'All keys and gestures, what the figures mean, and the licences',
  [barTexts.presets.surgeon]: 'View from the atrium with P2 below, as in the operation',
  [barTexts.presets.ventricle]: 'View from the ventricle on chordae and papillary muscles',
  [barTexts.presets.commissure]: 'View from behind the posterior leaflet, with the atrium above',
  [barTexts.presets.section]:
    'View along the valve with a cut from front to back through both leaflets; drag the blue ball to move it',
  [barTexts.opening]: 'Lets the pressure on the valve fall and rise again, so that it opens and closes',
  [barTexts.cut]: 'Takes away what lies before the cut plane; the other views show the whole valve again',
  [barTexts.chordae]: 'Shows or hides the chordae',
  [barTexts.names]: 'Shows or hides the names of scallops and papillary muscles',
  [barTexts.look]: 'Drag to turn the valve, click to choose a chord, a muscle or a scallop',
  [barTexts.grasp]: barTexts.tools.grasp,
  [barTexts.push]: barTexts.tools.push,
  [barTexts.colours]: 'What the colours of leaflets and chordae show',
  [appTexts.valve]: 'Figures of the valve: leak, coaptation, annulus, chordae',
  [appTexts.repair]: 'Operations, and what can be done with a chosen part',
  [appTexts.plan]: 'What was done, kept plans, notes, saving and the report',
  [appTexts.tour]: 'Four leaking valves to learn on, with goals',
  [importTexts.tab]: 'Makes a valve of the surface that was opened',
  [appTexts.apply]: 'Does the operation; it can be undone',
  [appTexts.discard]: 'Leaves the form; the valve stays as it is',
  [appTexts.close]: 'Closes this',
  [appTexts.again]: 'Begins anew; what was saved can be opened again',
  [appTexts.before]: 'Picture and figures of the valve before',
  [appTexts.preview]: 'Picture and figures of the valve after the operation of the form',
  [appTexts.now]: 'Picture and figures of the present valve',
  [t.cancel]: 'Stops this calculation; the valve stays as it is',
  [tableTexts.scallops]: 'Coaptation, leak, billow and free edge of each scallop',
  [valveTexts.annulus]: 'Size of the annulus',
  [valveTexts.section]: 'The leaflets in a plane from front to back, before and now',
  [valveTexts.physics]: 'Further figures for those who know the mechanics of the valve',
  [valveTexts.certainty]:
    'Closes the valve from eight different folds, and shows how much the figures change',
  [valveTexts.opens]: 'Open area in diastole, and the gradient of a flow',
  [valveTexts.flow]: valveTexts.flowHint(...flowRange),
  [valveTexts.measureOpen]: 'Opens a copy of the valve as in diastole and measures its smallest opening',
  [valveTexts.howCertain]:
    'Closes the valve from several folds of the leaflets, and writes the range beside each figure',
  [sectionTexts.middle]: 'Moves the plane back to the middle of A2 and P2',
  [repairTexts.more]: 'Operations that are done less often',
  [repairTexts.letGo]: 'Nothing is chosen any more',
  [repairTexts.changeLength]: operationTips.chord_length,
  [repairTexts.cut]: operationTips.chord_remove,
  [repairTexts.transfer]: operationTips.chord_transfer,
  [repairTexts.neochordFrom]: 'Then click its place on the leaflet',
  [repairTexts.move]: operationTips.head_move,
  [repairTexts.neochord]: operationTips.neochord,
  [repairTexts.resect]: operationTips.resect,
  [repairTexts.clip]: operationTips.clip,
  [formTexts.leave]: 'Leaves the form; the valve stays as it is',
  [formTexts.more]: 'Fields that are rarely changed',
  [formTexts.alongTip]: 'Moves the place along the scallop',
  [formTexts.heightTip]: 'Moves the place between annulus and free edge',
  [pointTexts.draw]: 'Then click along the cut on the leaflet',
  [pointTexts.drawAgain]: 'Forgets the drawn cut and begins a new one',
  [pointTexts.use]: 'Ends the drawing and shows the valve after this cut',
  [pointTexts.back]: 'Takes the last point of the cut away',
  [pointTexts.remove]: 'Forgets the measured ring',
  [figureHelp.title]: 'Each figure in words, its unit, how it is measured; the names of the scallops',
  [planTexts.checkpoints]: 'Plans of this valve that were kept under a name',
  [planTexts.checkpointName]: 'The name under which the present plan is kept',
  [planTexts.keep]: 'Keeps the present plan, to return to it or to compare with it',
  [planTexts.returnTo]: 'Makes this plan the present one',
  [planTexts.endCompare]: 'Takes the table of both plans away',
  [planTexts.compare]: 'Shows figures and pictures of both plans side by side',
  [planTexts.putBack]: 'Brings the kept plan back',
  [planTexts.notes]: 'What you write here stands in the session and in the report',
  [planTexts.files]: 'Files on this computer; nothing is sent anywhere',
  [planTexts.save]: 'Saves the valve with its plan, kept plans and notes as one file on this computer',
  [planTexts.obj]: 'Saves the present valve alone, for other programs',
  [planTexts.report]: 'One page with pictures, plan and figures, to print or to save',
  [planTexts.keepFile]: 'Choose a file; from then on every change is written to it',
  [planTexts.stopFile]: 'Changes are no longer written to the file',
  [planTexts.autosave]: planTexts.autosaveHint,
  [tourTexts.hint]: 'What may help with this valve',
  [tourTexts.repair]: 'Opens the panel with the operations',
  [tourTexts.repairOn]: 'Opens the panel with the operations; the goals stay in sight',
  [tourTexts.own]: 'Opens a surface, a valve or a session from this computer',
  [tourTexts.study.title]: 'The repair of the study, step by step',
  [tourTexts.example.title]: 'One repair that reaches the goals, step by step',
  [leaveTexts.back]: 'Opens that plan again; the present one can be returned to as well',
  [askTexts.save]: 'Keeps the present plan, then opens the other one',
  [askTexts.replace]: 'Opens the other plan; the present one is listed among the earlier valves',
  [askTexts.stay]: 'Leaves the present plan as it is',
  [importTexts.unit]: 'The length that the number one stands for in the file',
  [importTexts.kind]: 'Which side of the leaflets the surface is, from which their middle follows',
  [importTexts.points.commissures]:
    'Then click both corners on the surface, where the leaflets meet at the annulus',
  [importTexts.points.anterior]: 'Then click the leaflet that lies towards the aorta',
  [importTexts.points.annulus]:
    'Then click along the rim where the leaflets are attached; six points or more all around cut off what is beyond it',
  [importTexts.points.tips]: 'Then click where the papillary muscles end, in any order',
  [importTexts.closed]: 'Chooses the file of the same leaflets in systole (STL, PLY, OBJ, OFF, VTK, VTP)',
  [importTexts.thickness]:
    'Of the tissue, from annulus to free edge in the mean; 0.8 mm where it is not known',
  [importTexts.build]: 'Makes a valve of the surface, adds chordae by normal anatomy and closes it',
  [importTexts.leave]: 'Leaves the surface; the valve before is shown again',
  [importTexts.again]: 'Back to the surface with its marked points',
  [reportTexts.save]: 'Saves the page with its pictures on this computer',
  [reportTexts.print]: 'Prints the page, or makes a PDF of it',
  [dialogTexts.recover]: 'Opens what was left here',
  [dialogTexts.forget]: 'Removes the copy from this browser',
  [dialogTexts.licences]: 'Licences of the parts of this page',
};

/** Tooltips of controls whose words hold a name. */
export const tipTexts = {
  chordInTable: (name: string) =>
    `Shows chord ${name} in the picture; it can then be shortened, lengthened or cut`,
  beyond: (name: string) => `Shows chord ${name} in the picture. ${verdictTexts.limitHelp}`,
  chordae: 'All chordae with their share of the working limit, pull and length',
  devices: 'Everything that was implanted',
  valve: 'Opens this leaking valve with its goals; a changed plan can be returned to',
  next: 'Opens the next valve of the tour',
  plane: 'Moves the cut plane from one commissure towards the other',
  checkpoint: 'Picture and figures of the plan that is compared',
  rename: 'Gives the plan another name',
  remove: 'Deletes the kept plan; it can be put back',
  newName: 'Enter takes the name, Escape leaves the old one',
  pick: 'The next click in the picture chooses it',
  picture: help.picture,
  chordHint: 'Turns the picture so that the chord is seen, and marks it',
};
