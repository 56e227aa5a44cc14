// The section plot: the leaflets in a plane from front to back, healthy, before, now and at a checkpoint, in mm.
import { useSignal, useSignalEffect } from '@preact/signals';
import { fail, request } from '../store/requests';
import * as state from '../store/state';
import { formTexts, sectionTexts, tips, tipTexts } from '../text/texts';
import type { Picture, Section, SectionRequest } from '../protocol';
import { crossings, cutScallops, cutsOf, placeOf, planeOf } from '../view/cut';
import { isClosed, ringCurves, ringRadius } from '../view/heart';
import { annulusOf } from '../view/shown';
import { Button, SliderEnds } from './parts';

interface Curve {
  points: Section;
  style: string;
  name: string;
}

/** Anterior to the left, as in the view of the section. */
export function lines(points: Section): string {
  const put = (i: number) => `${(-points[i]).toFixed(2)} ${(-points[i + 1]).toFixed(2)}`;
  let path = '';
  for (let i = 0; i < points.length; i += 4) path += `M${put(i)}L${put(i + 2)}`;
  return path;
}

/** The part of the plane that holds all curves with a margin for the words, at least as large as a common valve, mm; size of the words. */
export function boxOf(curves: Section[]): {
  x: number;
  y: number;
  width: number;
  height: number;
  text: number;
} {
  let [wide, high, low] = [18, 5, 13];
  for (const points of curves) {
    for (let i = 0; i < points.length; i += 2) {
      wide = Math.max(wide, Math.abs(points[i]) + 2);
      high = Math.max(high, points[i + 1] + 2);
      low = Math.max(low, 2 - points[i + 1]);
    }
  }
  const text = 0.09 * wide;
  return { x: -wide, y: -high - 1.5 * text, width: 2 * wide, height: high + low + 4 * text, text };
}

/** The scallops of the shown valve that the plane cuts. */
function through(): string[] {
  const { picture, figures } = state.shown.value!;
  const topology = state.topologyOf(picture);
  const plane = planeOf(figures.frame, state.sectionAt.value);
  return topology ? cutScallops(topology, picture.positions, plane) : [];
}

/** A place in the plane of a section: AP and height, mm. */
const inPlane = (at: number[], frame: number[]): [number, number] =>
  [1, 3].map((row) => at.reduce((sum, v, c) => sum + (v - frame[c]) * frame[3 * row + c], 0)) as [
    number,
    number,
  ];

/** Where the plane of the plot cuts curves of the shown valve, in the frame of all curves. */
function dots(curves: number[][][], frame: number[]): [number, number][] {
  const plane = planeOf(frame, state.sectionAt.value);
  return curves.flatMap((curve) =>
    crossings(curve, isClosed(curve), plane).map(({ middle }) => inPlane(middle, frame)),
  );
}

/** Where the plane cuts the valve that is being opened or moved by hand: rows as of the worker. */
function movingSection(picture: Picture, frame: number[], offset: number): Section {
  const topology = state.topologyOf(picture);
  const cuts = topology ? cutsOf(topology, picture.positions, planeOf(frame, offset)) : [];
  return Float32Array.from(cuts.flat().flatMap((end) => inPlane(placeOf(picture.positions, end), frame)));
}

/** The curves beside that of a moving valve, in which the resting one is the closed one. */
function beside(curves: Curve[], frame: number[]): Curve[] {
  const motion = state.motion.value;
  if (!motion) return curves;
  const others = curves.map((curve) =>
    curve.style === 'now' ? { ...curve, style: 'before', name: sectionTexts.closed } : curve,
  );
  const points = movingSection(motion.picture, frame, state.sectionAt.value);
  const rest = others.filter(({ name }) => name !== sectionTexts.before);
  return [...rest, { points, style: 'now', name: sectionTexts.now }];
}

/** The curves to draw, and a key that changes with the valves, the plane and the preview. */
function wanted(): { key: string; curves: (Omit<Curve, 'points'> & { which: SectionRequest['which'] })[] } {
  const preview = state.preview.value?.figures.hash;
  const first = state.first.value?.figures.hash;
  const main = state.main.value?.figures.hash;
  const other = state.compareWith.value;
  const curves: ReturnType<typeof wanted>['curves'] = [];
  if (state.tour.value?.founding)
    curves.push({ which: 'healthy', style: 'healthy', name: sectionTexts.healthy });
  curves.push(
    preview
      ? { which: 'main', style: 'before', name: sectionTexts.before }
      : { which: 'main', style: 'now', name: sectionTexts.now },
  );
  if (preview) curves.push({ which: 'preview', style: 'now', name: sectionTexts.preview });
  else if (first && first !== main)
    curves.unshift({ which: 'first', style: 'before', name: sectionTexts.before });
  if (other) curves.push({ which: `checkpoint ${other}`, style: 'other', name: other });
  const key = [main, first, preview, other, state.sectionAt.value, curves.length].join();
  return { key, curves };
}

export function SectionPlot() {
  const curves = useSignal<Curve[]>([]);
  const shown = useSignal('');
  useSignalEffect(() => {
    const frame = state.main.value?.figures.frame;
    const offset = state.sectionAt.value;
    const asked = wanted();
    if (!frame) return;
    const ask = async ({ which, ...curve }: (typeof asked.curves)[number]): Promise<Curve> => ({
      ...curve,
      points: await request('section', { which, frame, offset }),
    });
    const turn = ++lastTurn;
    Promise.all(asked.curves.map(ask)).then((found) => {
      if (turn === lastTurn)
        [curves.value, shown.value] = [found.filter(({ points }) => points.length), asked.key];
    }, fail);
  });
  const outdated = state.outdated.value || shown.value !== wanted().key;
  const limit = 0.5 * (state.figures.value?.measures.annulusCc ?? 40);
  if (!state.main.value) return null;
  const { frame } = state.main.value.figures;
  const drawn = beside(curves.value, frame);
  const seen = state.motion.value ? null : state.shown.value?.picture;
  const hinges = seen ? dots([annulusOf(seen)], frame) : [];
  const box = boxOf(drawn.map(({ points }) => points));
  const text = { class: 'plot-text', style: { fontSize: `${box.text}px` } };
  const [left, right] = [box.x + box.text / 2, box.x + box.width - box.text / 2];
  const bottom = box.y + box.height;
  return (
    <div class={outdated ? 'outdated' : ''} aria-busy={outdated}>
      <svg
        class="plot"
        viewBox={`${box.x} ${box.y} ${box.width} ${box.height}`}
        role="img"
        aria-label={sectionTexts.label}
      >
        <line x1={left} y1="0" x2={right} y2="0" class="plot-axis" />
        <text x={left} y={box.y + 1.3 * box.text} {...text}>
          {sectionTexts.anterior}
        </text>
        <text x={box.x + box.width / 2} y={box.y + 1.3 * box.text} text-anchor="middle" {...text}>
          {sectionTexts.atrium}
        </text>
        <text x={right} y={box.y + 1.3 * box.text} text-anchor="end" {...text}>
          {sectionTexts.posterior}
        </text>
        {hinges.length === 2 && (
          <path
            d={`M${hinges.map(([ap, height]) => `${-ap} ${-height}`).join('L')}`}
            class="plot-hinges"
            data-testid="hinges"
          />
        )}
        {seen &&
          dots(ringCurves(seen), frame).map(([ap, height]) => (
            <circle cx={-ap} cy={-height} r={ringRadius} class="plot-ring" />
          ))}
        {drawn.map((curve) => (
          <path d={lines(curve.points)} class={`plot-${curve.style}`} />
        ))}
        <line
          x1={left}
          y1={bottom - 2 * box.text}
          x2={left + 10}
          y2={bottom - 2 * box.text}
          class="plot-scale"
        />
        <text x={left + 5} y={bottom - 0.7 * box.text} text-anchor="middle" {...text}>
          {sectionTexts.scale}
        </text>
        <text x={box.x + box.width / 2} y={bottom - 0.7 * box.text} text-anchor="middle" {...text}>
          {sectionTexts.ventricle}
        </text>
      </svg>
      <div class="legend">
        {drawn.map((curve) => (
          <span>
            <i class={`key key-${curve.style}`} />
            {curve.name}
          </span>
        ))}
        <span>
          <i class="key key-axis" />
          {sectionTexts.annulus}
        </span>
        <span>
          <i class="key key-hinges" />
          {sectionTexts.hinges}
        </span>
      </div>
      <label class="slider" title={tipTexts.plane}>
        <span>{sectionTexts.plane(state.sectionAt.value, through())}</span>
        {/* offsets grow to the left of the surgeon's view, so it runs from the largest to the least */}
        <input
          type="range"
          min={-limit}
          max={limit}
          step="0.5"
          value={0 - state.sectionAt.value}
          aria-valuetext={sectionTexts.plane(state.sectionAt.value, through())}
          onInput={(event) => (state.sectionAt.value = 0 - +event.currentTarget.value)}
        />
        <SliderEnds ends={formTexts.sides} />
      </label>
      <Button disabled={state.sectionAt.value === 0} onClick={() => (state.sectionAt.value = 0)}>
        {sectionTexts.middle}
      </Button>
      <label class="check" title={tips[sectionTexts.cut]}>
        <input
          type="checkbox"
          checked={state.sectionOn.value}
          onChange={(event) => (state.sectionOn.value = event.currentTarget.checked)}
        />{' '}
        {sectionTexts.cut}
      </label>
    </div>
  );
}

let lastTurn = 0;
