// The section plot: the leaflets in a plane from front to back, now, before, and at a checkpoint, in mm.
import { useSignal, useSignalEffect } from '@preact/signals';
import { fail, request } from '../store/actions';
import * as state from '../store/state';

interface Curve {
  points: Float32Array;
  style: string;
  name: string;
}

/** Segments in the plane of the section: AP to the right, into the atrium upwards. */
function lines(points: Float32Array, f: number[]): string {
  let path = '';
  const put = (i: number) => {
    const d = [points[i] - f[0], points[i + 1] - f[1], points[i + 2] - f[2]];
    const ap = d[0] * f[3] + d[1] * f[4] + d[2] * f[5];
    const up = d[0] * f[9] + d[1] * f[10] + d[2] * f[11];
    return `${ap.toFixed(2)} ${(-up).toFixed(2)}`;
  };
  for (let i = 0; i < points.length; i += 6) path += `M${put(i)}L${put(i + 3)}`;
  return path;
}

export function SectionPlot() {
  const curves = useSignal<Curve[]>([]);
  useSignalEffect(() => {
    const f = state.main.value?.figures.frame;
    const at = state.sectionAt.value;
    const preview = state.preview.value;
    const other = state.compareWith.value;
    if (!f || !state.main.value) return;
    const point = [0, 1, 2].map((c) => f[c] + at * f[6 + c]);
    const normal = [f[6], f[7], f[8]];
    const ask = async (which: string, style: string, name: string): Promise<Curve> => ({
      points: await request('section', { which, point, normal }),
      style,
      name,
    });
    const turn = ++lastTurn;
    const wanted = [ask('main', preview ? 'before' : 'now', preview ? 'before' : 'now')];
    if (preview) wanted.push(ask('preview', 'now', 'preview'));
    if (other) wanted.push(ask(other, 'other', other));
    Promise.all(wanted).then((found) => {
      if (turn === lastTurn) curves.value = found;
    }, fail);
  });
  const f = state.main.value?.figures.frame;
  const limit = 0.5 * (state.figures.value?.measures.annulusCc ?? 40);
  if (!f) return null;
  return (
    <div>
      <svg class="plot" viewBox="-26 -12 52 36" role="img" aria-label="Section through the leaflets">
        <line x1="-24" y1="0" x2="24" y2="0" class="plot-axis" />
        <text x="-25" y="-1" class="plot-text">
          posterior
        </text>
        <text x="25" y="-1" text-anchor="end" class="plot-text">
          anterior
        </text>
        {curves.value.map((curve) => (
          <path d={lines(curve.points, f)} class={`plot-${curve.style}`} />
        ))}
        <line x1="-24" y1="21" x2="-14" y2="21" class="plot-scale" />
        <text x="-19" y="23.5" text-anchor="middle" class="plot-text">
          10 mm
        </text>
      </svg>
      <div class="legend">
        {curves.value.map((curve) => (
          <span>
            <i class={`key key-${curve.style}`} />
            {curve.name}
          </span>
        ))}
      </div>
      <label class="slider">
        <span>Plane, from the middle: {state.sectionAt.value.toFixed(1)} mm</span>
        <input
          type="range"
          min={-limit}
          max={limit}
          step="0.5"
          value={state.sectionAt.value}
          onInput={(event) => (state.sectionAt.value = +event.currentTarget.value)}
        />
      </label>
      <label class="check">
        <input
          type="checkbox"
          checked={state.sectionOn.value}
          onChange={(event) => (state.sectionOn.value = event.currentTarget.checked)}
        />{' '}
        Cut the picture at this plane
      </label>
    </div>
  );
}

let lastTurn = 0;
