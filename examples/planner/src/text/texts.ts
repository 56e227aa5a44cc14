// Every text that the page shows, in a surgeon's words. To translate the page, translate this file.
import type { Figures } from '../protocol';

const number = (value: number, digits = 1): string => (Number.isFinite(value) ? value.toFixed(digits) : '–');

/** Grade of a leak by its orifice, cm2: 0.20, 0.30, 0.40 (echocardiography, EROA). */
export function grade(orifice: number): { level: number; word: string } {
  if (orifice <= 0) return { level: 0, word: 'Sealed' };
  if (orifice < 20) return { level: 1, word: 'Mild leak' };
  if (orifice < 30) return { level: 2, word: 'Moderate leak' };
  if (orifice < 40) return { level: 3, word: 'Moderate–severe leak' };
  return { level: 4, word: 'Severe leak' };
}

/** Where a valve leaks, by scallops or commissures. */
export function where(figures: Figures): string {
  if (!figures.orificeParts.length) return '';
  const union = (get: (part: Figures['orificeParts'][number]) => string) =>
    [...new Set(figures.orificeParts.flatMap((part) => get(part).split('+')))]
      .filter(Boolean)
      .sort()
      .join(', ');
  const leaflets = [union((part) => part.anterior), union((part) => part.posterior)]
    .filter(Boolean)
    .join(' and ');
  const places = leaflets || `commissure ${union((part) => part.commissures)}`;
  const count = figures.orificeParts.length;
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
    fields: { factor: 'Length, of the present one', length: 'Length', name: 'Name' },
  },
  annulus_scale: {
    title: 'Annulus size',
    short: 'Make the annulus larger or smaller',
    fields: { factor: 'Overall size', ap: 'Front to back', cc: 'Side to side' },
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
    fields: { chord: 'Chord', length: 'Length without pull', factor: 'Length, of the present one' },
  },
  chord_remove: { title: 'Cut a chord', short: 'Remove a chord', fields: { chord: 'Chord' } },
  chord_add: {
    title: 'Native chord',
    short: 'Tie a chord of natural tissue',
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
    short: 'Join A2 and P2 edge to edge',
    fields: {
      anterior: 'Anterior scallop',
      posterior: 'Posterior scallop',
      position: 'Position along the edge',
      width: 'Width',
      reach: 'Depth of the grasp',
      name: 'Name',
    },
  },
  resect: {
    title: 'Resection',
    short: 'Take out a piece of a scallop and suture',
    fields: {
      scallop: 'Scallop',
      position: 'Position along the scallop',
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

/** Sentences of the library with its units turned into those of the page. */
export function say(sentence: string): string {
  return sentence
    .replace(
      /(-?\d+(?:\.\d+)?(?:e-?\d+)?) m\b(?![m²/])/g,
      (_, v: string) => `${+(1e3 * +v).toPrecision(4)} mm`,
    )
    .replace(/^mvs_\w+: /, '');
}

export const t = {
  product: 'Mitral repair planner',
  research: 'Research simulator. Not for decisions on treatment.',
  starting: 'Starting…',
  closing: 'Closing the valve…',
  previewing: 'Trying it…',
  applying: 'Applying…',
  undoing: 'Going back…',
  redoing: 'Repeating…',
  saving: 'Saving…',
  measuring: 'Measuring…',
  spreading: 'Closing it eight times…',
  replaying: 'Repeating the plan…',
  building: 'Building the valve…',
  reading: 'Reading the file…',
  cancel: 'Cancel',
  sessionOpened: 'Session opened. The plan was repeated and gives exactly the saved valve.',
  sessionDiffers:
    'Session opened, but the repeated plan differs from the saved valve: it was saved by another version.',
  unknownFile: (name: string) =>
    `${name} is not a file this page can open: it takes a session (.mvsplan), a valve (.obj), or a surface (.stl, .ply, .obj).`,
  importBegun: (triangles: number) =>
    `Surface with ${triangles} triangles. Mark both commissures, then build the valve.`,
  statusLine: (f: Figures) =>
    f.measures.orifice > 0
      ? `${grade(f.measures.orifice).word}: ${number(f.measures.orifice)} mm² at ${where(f)}. Coaptation ${number(f.measures.coaptationMean)} mm.`
      : f.measures.atRest
        ? `Sealed. Coaptation ${number(f.measures.coaptationMean)} mm.`
        : 'The valve did not come to rest.',
  previewLine: (f: Figures) =>
    `Preview: ${f.measures.orifice > 0 ? `${grade(f.measures.orifice).word}, ${number(f.measures.orifice)} mm²` : 'sealed'}.`,
};

export const kinds = ['Other', 'Marginal', 'Rough zone', 'Strut', 'Basal', 'Commissural', 'Trunk', 'Suture'];
export { number as figure };

export const tourTexts = {
  heading: 'Learn it on three leaking valves',
  intro: [
    'A surgeon in the study of 2011 learned this kind of program in ten minutes and sealed these three valves.',
    'Turn the valve with the left button (or one finger), zoom with the wheel (or two fingers). The red area is the leak.',
    'Open “Repair”, choose an operation, and watch the closed valve while you change it. Nothing is done until you press Apply, and everything can be undone.',
  ],
  valves: [
    {
      title: 'Valve 1: dilated, and a long strut chord',
      story:
        'The annulus is 15 % too large, and a strut chord of the anterior leaflet is 25 % too long. The leaflets do not meet.',
      hint: 'Make the annulus smaller first: a ring, or “Annulus size”. If a leak remains, hold the middle of A2 with artificial chordae.',
    },
    {
      title: 'Valve 2: a short chord',
      story:
        'A chord to A2 is 30 % too short. It holds the leaflet back, so that it cannot reach its partner.',
      hint: 'Look for the chord with the strongest pull under A2, turn the valve to see it from below, and lengthen it or cut it.',
    },
    {
      title: 'Valve 3: dilated, and a short chord',
      story: 'The annulus is 10 % too large, and a chord to A2 is 33 % too short.',
      hint: 'Two faults need two steps: free the leaflet from the short chord, then bring the annulus back to its size.',
    },
  ],
  goals: {
    sealed: 'No leak under 120 mmHg',
    chords: (healthy: number) =>
      healthy > 0
        ? `No more chordae beyond their limit than in the healthy valve (${healthy})`
        : 'No chord beyond its working limit',
    open: 'Opens to at least 90 % of the healthy area',
  },
  won: 'All goals reached.',
};

export const help = {
  picture: 'Arrow keys turn the valve, Shift and arrow keys move it, plus and minus zoom.',
  keys: [
    ['1 2 3 4', 'Views: surgeon, ventricle, commissure, section'],
    ['Arrows, + −', 'Turn, zoom (in the picture)'],
    ['V R P L', 'Panels: Valve, Repair, Plan, Learn'],
    ['O', 'Open and close the valve'],
    ['X', 'Cut the picture at the section plane'],
    ['C', 'Chordae on and off'],
    ['N', 'Names on and off'],
    ['M', 'Next colour map'],
    ['G, B', 'Grasp, push with a ball'],
    ['Enter, Esc', 'Apply, discard the operation'],
    ['Ctrl Z, Ctrl Y', 'Undo, redo'],
    ['Ctrl S', 'Save the session'],
    ['Ctrl O', 'Open a file'],
    ['?', 'This list'],
  ] as [string, string][],
};

export const mapWords: Record<string, { title: string; scale: string }> = {
  tissue: { title: 'Tissue', scale: '' },
  coaptation: { title: 'Contact', scale: 'Distance to the facing leaflet' },
  height: { title: 'Height', scale: 'Above (+) or below the annulus plane' },
  stretch: { title: 'Stretch', scale: 'Stretch of the leaflets' },
  load: { title: 'Chord load', scale: 'Chord load, of its limit' },
  distance: { title: 'Change', scale: 'Moved from the valve before' },
};

export const importTexts = {
  none: 'Drop a surface file (STL, PLY, OBJ) on the picture, or choose Open.',
  intro:
    'Mark what you know by clicking on the surface; the rest is guessed from its shape and listed afterwards. The two commissures help most.',
  unit: 'Unit of the file',
  size: (mm: number) => `The surface is ${mm.toFixed(1)} mm wide. An open valve is 30 to 60 mm wide.`,
  points: {
    commissures: 'Both commissures',
    anterior: 'A point of the anterior leaflet',
    annulus: 'Points along the annulus',
  },
  tips: 'Papillary tips and chordae are placed by normal anatomy.',
  found: 'What was found and what was guessed',
  sources: ['', 'given', 'measured', 'guessed', 'normal anatomy'],
};
