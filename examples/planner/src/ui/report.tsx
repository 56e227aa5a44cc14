// The report: pictures and figures before and after, and the plan. One HTML file without a script, or print.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { Download, Printer } from 'lucide-preact';
import { download, fileName } from '../store/keep';
import { ofMiddle } from '../store/names';
import * as state from '../store/state';
import { doubtNote, doubtOf, marked } from '../store/doubt';
import { attachedInVain, headline, relieved } from '../store/verdict';
import { reportTexts, sectionTexts, t, valveTexts, verdictTexts } from '../text/texts';
import type { Figures, SectionRequest, Shown } from '../protocol';
import { openingOf } from '../store/limits';
import { measureReport, toMeasure } from '../store/opening';
import { keptName, readPlans } from '../store/plans';
import { fail, request } from '../store/requests';
import { view } from './app';
import { areaText, gradientText, comparedRows, stepsOf } from './compared';
import { Modal } from './modal';
import { Button } from './parts';
import { cellOf, escape, notesBelow, otherPlans } from './report_plans';
import { boxOf, lines } from './section';

interface Pictures {
  before: string[];
  after: string[];
}

const views = ['surgeon', 'ventricle'] as const;

/** The plan that the picture shows: a kept one that is compared, where that is looked at, else the present one. */
interface Seen {
  shown: Shown;
  /** As the worker calls it. */
  which: 'main' | `checkpoint ${string}`;
}

function seenPlan(): Seen {
  const { compared, compareWith, inPast, other, main } = state;
  if (inPast.value && compared.value && other.value === compared.value)
    return { shown: compared.value, which: `checkpoint ${compareWith.value}` };
  return { shown: main.value!, which: 'main' };
}

/** Surgeon's view and ventricle of both valves at one scale; the page shows the valve that it showed again afterwards. */
function takePictures(seen: Shown): Pictures {
  const viewport = view()!;
  const { camera } = viewport;
  // a view that is on its way is there afterwards
  camera.finish();
  const kept = {
    target: camera.target.clone(),
    orientation: camera.orientation.clone(),
    distance: camera.distance,
  };
  const now = state.main.value!;
  const [section, choice, past] = [state.sectionOn.value, state.choice.value, state.past.value];
  state.sectionOn.value = false;
  state.choice.value = null;
  state.past.value = false;
  const valves = [state.first.value ?? now, seen];
  const distances = views.map((preset) =>
    Math.max(
      ...valves.map((shown) => {
        state.main.value = shown;
        viewport.go(preset, true);
        return camera.distance;
      }),
    ),
  );
  const [before, after] = valves.map((shown) => {
    state.main.value = shown;
    return views.map((preset, k) => {
      viewport.go(preset, true);
      camera.distance = distances[k];
      viewport.touchScene();
      return viewport.snapshot();
    });
  });
  state.main.value = now;
  state.sectionOn.value = section;
  state.choice.value = choice;
  state.past.value = past;
  camera.target.copy(kept.target);
  camera.orientation.copy(kept.orientation);
  camera.distance = kept.distance;
  viewport.touchScene();
  return { before, after };
}

const tableRow = (label: string, was: string, now: string): string =>
  `<tr><th>${escape(label)}</th>${cellOf(was)}${cellOf(now)}</tr>`;

/** How long both leaflets are where they do not touch. */
function lengthsText(valve: Figures): string {
  const cost = openingOf(valve.hash);
  if (!cost) return '';
  const { anteriorLength: anterior, posteriorLength: posterior } = cost;
  const known = Number.isFinite(anterior) || Number.isFinite(posterior);
  return known
    ? marked(valveTexts.lengthsOf(anterior, posterior), valve)
    : ofMiddle(valveTexts.lengthsUnknown);
}

/** Open areas, gradients and the lengths of the leaflets, if they were measured. */
function openingRows(then: Figures, now: Figures): string {
  if (!openingOf(now.hash)) return '';
  const row = (label: string, text: (valve: Figures) => string) => tableRow(label, text(then), text(now));
  return (
    row(valveTexts.openArea, areaText) +
    (state.flow.value ? row(reportTexts.gradient(state.flow.value), gradientText) : '') +
    row(ofMiddle(valveTexts.lengths), lengthsText)
  );
}

/** The leaflets in the plane through the middle, before and after, as an SVG picture. */
async function sectionPlot({ shown, which }: Seen): Promise<string> {
  const { frame } = shown.figures;
  const ask = (which: SectionRequest['which']) => request('section', { which, frame, offset: 0 });
  const [before, after] = [await ask('first'), await ask(which)];
  const { x, y, width, height, text: size } = boxOf([before, after]);
  const [left, right, bottom] = [x + size / 2, x + width - size / 2, y + height];
  const word = (x: number, y: number, anchor: string, text: string, colour = '#5a6a79') =>
    `<text x="${x}" y="${y}" text-anchor="${anchor}" font-size="${size}" fill="${colour}">${escape(text)}</text>`;
  return `<svg class="cut" viewBox="${x} ${y} ${width} ${height + 2.7 * size}" role="img" aria-label="${sectionTexts.label}"><g fill="none" stroke-linecap="round">
<path d="M${left} 0H${right}" stroke="#c4ced6" stroke-width=".2"/><path d="M${left} ${bottom - 2 * size}h10" stroke="#1c2733" stroke-width=".3"/>
<path d="${lines(before)}" stroke="#8795a1" stroke-width=".35" stroke-dasharray="1 .8"/>
<path d="${lines(after)}" stroke="#b5493b" stroke-width=".45"/></g>
${word(left, y + 1.3 * size, 'start', sectionTexts.anterior)}${word(right, y + 1.3 * size, 'end', sectionTexts.posterior)}${word(x + width / 2, y + 1.3 * size, 'middle', sectionTexts.atrium)}
${word(x + width / 2, bottom - 0.7 * size, 'middle', sectionTexts.ventricle)}${word(left + 5, bottom - 0.7 * size, 'middle', sectionTexts.scale)}
${word(left, bottom + 0.9 * size, 'start', reportTexts.dashed)}${word(right, bottom + 0.9 * size, 'end', reportTexts.line, '#b5493b')}
${word(left, bottom + 2.2 * size, 'start', reportTexts.thin)}</svg>`;
}

/** Why the figures of a valve do not count, below its verdict. */
function doubt(valve: Figures): string {
  const note = doubtNote(valve);
  return note && `<p class="doubt-note" data-testid="report-doubt">${escape(note)}</p>`;
}

/** The report as the body of an HTML page. */
function reportHtml({ shown }: Seen, pictures: Pictures, plot: string): string {
  const now = shown.figures;
  const then = (state.first.value ?? shown).figures;
  const images = (list: string[]) =>
    list
      .map((source, k) => {
        const caption = reportTexts.views[views[k]];
        return `<figure><img src="${source}" alt="${caption}"><figcaption>${caption}</figcaption></figure>`;
      })
      .join('');
  const date = new Date().toLocaleString(undefined, { dateStyle: 'long', timeStyle: 'short' });
  const steps = stepsOf(now)
    .map((step) => `<li>${escape(step)}</li>`)
    .join('');
  const opening = openingRows(then, now);
  const slack = relieved(then, now);
  const vain = attachedInVain(now);
  const table = comparedRows(then, now)
    .map((row) => tableRow(...row))
    .join('');
  return `<h1>${escape(state.title.value || now.valve)}</h1><p data-testid="report-plan">${escape(reportTexts.closed(date, keptName(now.hash), !!doubtOf(now)))}</p>
<div class="pair"><section><h2>${reportTexts.before}</h2><p>${escape(headline(then))}</p>${doubt(then)}</section>
<section><h2>${reportTexts.after}</h2><p data-testid="report-verdict"><strong>${escape(headline(now))}</strong></p>${doubt(now)}${slack.length ? `<p>${escape(verdictTexts.relieved(slack))}.</p>` : ''}${vain.length ? `<p>${escape(verdictTexts.attachedInVain(vain))}.</p>` : ''}</section></div>
<div class="pair"><section>${images(pictures.before)}</section><section>${images(pictures.after)}</section></div>
<h2>${reportTexts.plan}</h2><ol>${steps || `<li>${reportTexts.nothing}</li>`}</ol>
<div class="pair figures-and-plot"><section><h2>${reportTexts.figures}</h2><table><tr><th></th><th>${reportTexts.before}</th><th>${reportTexts.after}</th></tr>${table}${opening}</table>${notesBelow([then, now])}</section><section><h2>${reportTexts.section}</h2>${plot}</section></div>
${otherPlans(now)}
${state.notes.value ? `<h2>${reportTexts.notes}</h2><p>${escape(state.notes.value)}</p>` : ''}
<p><small>${escape(valveTexts.outflow)} ${escape(reportTexts.foot(state.version.value, now.hash))}</small></p>`;
}

const style = `body{font:15px/1.45 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color:#1c2733}
.pair{display:grid;grid-template-columns:repeat(2,minmax(0,1fr));gap:1rem}img{width:100%;border:1px solid #ccd5de;border-radius:6px}figure{margin:.4rem 0}figcaption{font-size:.85em;color:#5a6a79}
table{border-collapse:collapse;width:100%}th,td{text-align:left;padding:.25rem .8rem .25rem 0;border-bottom:1px solid #dde4ea;font-weight:400}td{white-space:nowrap}.wrap{white-space:normal}.plans th,.plans td{padding-right:.6rem;vertical-align:top}
.figures-and-plot{grid-template-columns:minmax(0,4fr) minmax(0,3fr)}.figures-and-plot th:first-child{width:48%}svg.cut{width:100%}td.doubtful{color:#5a6a79;font-style:italic}.doubt-note{border-left:4px dashed #b3261e;background:#f3f0f4;padding:.3rem .6rem}.marks{font-size:.9em;color:#5a6a79}
@page{margin:15mm}@media print{body{font-size:10pt;line-height:1.3;margin:0;padding:0}h1{margin:0}h2{margin:.8rem 0 0}p,ol{margin:.2rem 0}th,td{padding:.12rem .6rem .12rem 0}figure,tr{break-inside:avoid}img{max-height:40mm;object-fit:contain}svg.cut{max-height:60mm}}`;

export function ReportDialog() {
  const html = useSignal('');
  useEffect(() => {
    const seen = seenPlan();
    const pictures = takePictures(seen.shown);
    let plot = '';
    const write = () => (html.value = reportHtml(seen, pictures, plot));
    write();
    sectionPlot(seen).then((drawn) => ((plot = drawn), write()), fail);
    let open = true;
    const measured = () => (open && write(), open);
    void readPlans()
      .catch(fail)
      .then(() => {
        const all = measureReport(seen.shown.figures.hash, seen.which, measured);
        measured();
        return all;
      })
      .then(measured);
    return () => void (open = false);
  }, []);
  const saved = useSignal('');
  const save = () => {
    const name = reportTexts.fileName(fileName());
    download(
      `<!doctype html><html lang="en"><meta charset="utf-8"><title>${reportTexts.fileTitle}</title><style>${style}</style><body>${html.value}</body></html>`,
      name,
      'text/html',
    );
    // the notice of the page is behind the dialog
    saved.value = t.saved(name);
  };
  // the markup is made above; texts of the user are escaped there
  const body = { __html: html.value };
  return (
    <>
      <Modal title={reportTexts.title} wide>
        <div class="row">
          <Button kind="main" icon={<Download size={16} />} onClick={save}>
            {reportTexts.save}
          </Button>
          <Button icon={<Printer size={16} />} onClick={() => window.print()}>
            {reportTexts.print}
          </Button>
          {saved.value && <span class="hint">{saved.value}</span>}
          {toMeasure.value > 0 && (
            <span class="hint" role="status" data-testid="measuring">
              {reportTexts.measuring(toMeasure.value)}
            </span>
          )}
        </div>
        <div class="report" data-testid="report" dangerouslySetInnerHTML={body} />
      </Modal>
      <div class="report paper" dangerouslySetInnerHTML={body} />
    </>
  );
}
