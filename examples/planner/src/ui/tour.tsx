// The tour: the three leaking valves of the founding study, a goal, and a score beside the healthy valve and the
// founding surgeon's repair.
import { Check, CircleHelp, X } from 'lucide-preact';
import { openShipped, request } from '../store/actions';
import { measureCost } from '../store/measure';
import * as state from '../store/state';
import { figure, say, tourTexts } from '../text/texts';
import { Button } from './parts';

export async function startValve(number: number): Promise<void> {
  state.tour.value = { number, founding: null, startArea: 0 };
  await openShipped(`founding${number}`, tourTexts.valves[number - 1].title);
  state.panel.value = 'tour';
  const founding = await request('founding', { number, vertices: 425 }).catch(() => null);
  if (state.tour.value?.number === number) state.tour.value = { ...state.tour.value, founding };
}

export function TourPanel() {
  const tour = state.tour.value;
  return (
    <div class="panel-body">
      {!tour && (
        <>
          <h2>{tourTexts.heading}</h2>
          {tourTexts.intro.map((line) => (
            <p>{line}</p>
          ))}
        </>
      )}
      <div class="row">
        {tourTexts.valves.map((_, k) => (
          <Button
            kind={tour?.number === k + 1 ? 'main' : 'plain'}
            pressed={tour?.number === k + 1}
            onClick={() => void startValve(k + 1)}
          >
            Valve {k + 1}
          </Button>
        ))}
      </div>
      {tour && <Goal />}
    </div>
  );
}

function Goal() {
  const tour = state.tour.value!;
  const figures = state.main.value?.figures;
  const texts = tourTexts.valves[tour.number - 1];
  if (!figures) return null;
  const cost = state.cost.value?.hash === figures.hash ? state.cost.value.value : null;
  const healthyOver = tour.founding?.healthy.measures.chordsOver ?? 0;
  const healthyArea = tour.founding?.healthy.openArea;
  const checks: { text: string; done: boolean | null }[] = [
    { text: tourTexts.goals.sealed, done: figures.measures.atRest && figures.measures.orifice === 0 },
    { text: tourTexts.goals.chords(healthyOver), done: figures.measures.chordsOver <= healthyOver },
    { text: tourTexts.goals.open, done: cost && healthyArea ? cost.openArea >= 0.9 * healthyArea : null },
  ];
  const won = checks.every((check) => check.done);
  return (
    <>
      <h2>{texts.title}</h2>
      <p>{texts.story}</p>
      <details class="section">
        <summary>A hint</summary>
        <div class="section-body">
          <p>{texts.hint}</p>
        </div>
      </details>
      <h3>Goal</h3>
      <ul class="goals" data-testid="goals">
        {checks.map((check) => (
          <li class={check.done === null ? 'open' : check.done ? 'done' : 'missed'}>
            {check.done === null ? (
              <CircleHelp size={18} />
            ) : check.done ? (
              <Check size={18} />
            ) : (
              <X size={18} />
            )}
            <span>{check.text}</span>
          </li>
        ))}
      </ul>
      {!cost && (
        <Button onClick={() => void measureCost()} disabled={!!state.preview.value}>
          Measure how far it opens
        </Button>
      )}
      {won && (
        <p class="won" role="status">
          {tourTexts.won}
          {tour.number < 3 && (
            <>
              {' '}
              <Button kind="main" onClick={() => void startValve(tour.number + 1)}>
                Next valve
              </Button>
            </>
          )}
        </p>
      )}
      <Score />
    </>
  );
}

function Score() {
  const tour = state.tour.value!;
  const figures = state.main.value!.figures;
  const founding = tour.founding;
  const cost = state.cost.value?.hash === figures.hash ? state.cost.value.value : null;
  const columns = [
    { name: 'Yours', m: figures.measures, area: cost?.openArea },
    ...(founding
      ? [
          { name: 'Study surgeon', m: founding.repaired.measures, area: founding.repaired.openArea },
          { name: 'Healthy', m: founding.healthy.measures, area: founding.healthy.openArea },
        ]
      : []),
  ];
  const row = (label: string, get: (column: (typeof columns)[number]) => string) => (
    <tr>
      <th scope="row">{label}</th>
      {columns.map((column) => (
        <td>{get(column)}</td>
      ))}
    </tr>
  );
  return (
    <>
      <table class="table" data-testid="score">
        <thead>
          <tr>
            <th></th>
            {columns.map((column) => (
              <th>{column.name}</th>
            ))}
          </tr>
        </thead>
        <tbody>
          {row('Leak, mm²', (c) => figure(c.m.orifice, 1))}
          {row('Coaptation, mm', (c) => figure(c.m.coaptationMean, 1))}
          {row('Chordae beyond limit', (c) => String(c.m.chordsOver))}
          {row('Open area, cm²', (c) => (c.area === undefined ? '?' : figure(c.area / 100, 2)))}
          {row('Annulus AP, mm', (c) => figure(c.m.annulusAp, 1))}
        </tbody>
      </table>
      {founding && (
        <details class="section">
          <summary>What the study’s surgeon did</summary>
          <div class="section-body">
            <ol>
              {founding.repaired.operations.map((line) => (
                <li>{say(line)}</li>
              ))}
            </ol>
          </div>
        </details>
      )}
    </>
  );
}
