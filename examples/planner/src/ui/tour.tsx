// The tour: three leaking valves of the founding study and one with a flail leaflet, a goal, and a score beside the healthy
// valve and the repair of the founding surgeon, or an example.
import { Check, Eye, Wrench } from 'lucide-preact';
import { percentOfLimit } from '../notable';
import * as state from '../store/state';
import { marked } from '../store/doubt';
import { reachesAll } from '../store/goals';
import { openingOf } from '../store/limits';
import { showChord, startValve } from '../store/tour';
import { areaFigure, figure, say, tipTexts, tourTexts } from '../text/texts';
import { OwnRepair } from './earlier';
import { Goals } from './goals';
import { Button, DoubtNote, Section } from './parts';

/** Whether the present plan reaches all goals of a valve, or another one did since the page was opened. */
function signOf(number: number): 'now' | 'before' | 'none' {
  if (state.tour.value?.number === number && reachesAll.value) return 'now';
  return state.finished.value.includes(number) ? 'before' : 'none';
}

const signs = { now: <Check size={16} />, before: <Check class="soft" size={16} />, none: undefined };

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
      <div class="row valves">
        {tourTexts.valves.map((_, k) => (
          <Button
            kind={tour?.number === k + 1 ? 'main' : 'plain'}
            pressed={tour?.number === k + 1}
            icon={signs[signOf(k + 1)]}
            title={[tipTexts.valve, tourTexts.signs[signOf(k + 1)]].filter(Boolean).join('. ')}
            onClick={() => void startValve(k + 1)}
          >
            {tourTexts.valveOf(k + 1)}
          </Button>
        ))}
      </div>
      {tour && <Goal />}
    </div>
  );
}

function Goal() {
  const tour = state.tour.value!;
  const texts = tourTexts.valves[tour.number - 1];
  if (!state.main.value) return null;
  return (
    <>
      <h2>{texts.title}</h2>
      <p>{texts.story}</p>
      <Section key={tour.number} title={tourTexts.hint} name={`hint ${tour.number}`}>
        <p>{texts.hint}</p>
        {texts.chord && (
          <Button icon={<Eye size={16} />} title={tipTexts.chordHint} onClick={() => showChord(texts.chord!)}>
            {tourTexts.show(texts.chord)}
          </Button>
        )}
      </Section>
      {signOf(tour.number) === 'before' && (
        <p class="hint" data-testid="reached-before">
          {tourTexts.reachedBefore}
        </p>
      )}
      <OwnRepair number={tour.number} />
      <Goals number={tour.number} />
      <Button
        kind={reachesAll.value ? 'plain' : 'main'}
        icon={<Wrench size={16} />}
        onClick={() => (state.panel.value = 'repair')}
      >
        {reachesAll.value ? tourTexts.repairOn : tourTexts.repair}
      </Button>
      {!state.coming.value && <Score />}
    </>
  );
}

function Score() {
  const tour = state.tour.value!;
  const figures = state.main.value!.figures;
  const founding = tour.founding;
  const cost = openingOf(figures.hash);
  const other = tour.number > 3 ? tourTexts.example : tourTexts.study;
  const columns = [
    { name: tourTexts.columns.yours, m: figures.measures, area: cost?.openArea },
    ...(founding?.repaired
      ? [
          { name: other.column, m: founding.repaired.measures, area: founding.repaired.openArea },
          { name: tourTexts.columns.healthy, m: founding.healthy.measures, area: founding.healthy.openArea },
        ]
      : []),
  ];
  const row = (label: string, get: (column: (typeof columns)[number]) => string) => (
    <tr>
      <th scope="row">{label}</th>
      {columns.map((column, k) => (
        <td>{k === 0 ? marked(get(column), figures) : get(column)}</td>
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
          {row(tourTexts.rows.leak, (c) => figure(c.m.orifice, 1))}
          {row(tourTexts.rows.coaptation, (c) => figure(c.m.coaptationMean, 1))}
          {row(tourTexts.rows.load, (c) => String(percentOfLimit(c.m.chordLoad)))}
          {row(tourTexts.rows.area, (c) => (c.area === undefined ? '?' : areaFigure(c.area)))}
          {row(tourTexts.rows.ap, (c) => figure(c.m.annulusAp, 1))}
        </tbody>
      </table>
      <DoubtNote />
      {founding?.repaired && <p class="hint">{tourTexts.columnsHelp(other.help)}</p>}
      {founding?.repaired && (
        <Section title={other.title} name={`${other.title} ${tour.number}`}>
          <ol>
            {founding.repaired.operations.map((line) => (
              <li>{say(line)}</li>
            ))}
          </ol>
          <p class="hint">{tourTexts.namesHelp}</p>
        </Section>
      )}
    </>
  );
}
