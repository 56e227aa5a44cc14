// The panel "Valve": the verdict in large letters, then the clinical figures, the physics behind a click.
import { Activity, Layers } from 'lucide-preact';
import { measureCost, measureSpread } from '../store/measure';
import * as state from '../store/state';
import { figure, grade, where } from '../text/texts';
import type { Figures } from '../protocol';
import { Button, Figure, Section } from './parts';
import { SectionPlot } from './section';
import { Chordae, Scallops } from './tables';

export function Verdict() {
  const figures = state.figures.value;
  if (!figures)
    return (
      <div class="verdict waiting">
        <strong>…</strong>
      </div>
    );
  const before = state.before.value;
  const m = figures.measures;
  const { level, word } = grade(m.orifice);
  const graded = m.atRest && m.underLoad;
  return (
    <div class={`verdict level-${graded ? level : 'none'}`} data-testid="verdict">
      <div class="verdict-word">
        <strong>{graded ? word : 'Not at rest'}</strong>
        {state.preview.value && <span class="tag">preview</span>}
      </div>
      <div class="verdict-figure">
        <span class="big" data-testid="orifice">
          {figure(m.orifice, m.orifice > 0 && m.orifice < 10 ? 1 : 0)}
        </span>{' '}
        mm² leak{m.orifice === 0 && graded && ' at 120 mmHg'}
        {before && Math.abs(before.measures.orifice - m.orifice) > 0.05 && (
          <span class="was"> was {figure(before.measures.orifice, 1)}</span>
        )}
      </div>
      {m.orifice > 0 && graded && <div class="verdict-where">at {where(figures)}</div>}
      {m.orifice === 0 && graded && (
        <div class="verdict-where">leaflets meet over {figure(m.coaptationMean)} mm</div>
      )}
      {!graded && <div class="verdict-where">The valve did not come to rest; its figures are not final.</div>}
      {m.chordsOver > 0 && (
        <div class="verdict-warn">
          {m.chordsOver} {m.chordsOver === 1 ? 'chord' : 'chordae'} beyond the working limit
        </div>
      )}
    </div>
  );
}

export function ValvePanel() {
  const figures = state.figures.value;
  if (!figures) return <p class="hint">The valve is being closed…</p>;
  const before = state.before.value?.measures;
  const m = figures.measures;
  const spread = state.spread.value?.hash === figures.hash ? state.spread.value.value : null;
  const range = (name: string): [number, number] | null => {
    const row = spread?.rows.find((candidate) => candidate.name === name);
    return row ? [row.min, row.max] : null;
  };
  return (
    <div class="panel-body">
      <div class="figures">
        <Figure
          label="Coaptation length, mean"
          value={m.coaptationMean}
          before={before?.coaptationMean}
          unit="mm"
          good="high"
          spread={range('coaptationMean')}
          help="Length over which the leaflets lie against each other. Surgeons aim at 8 mm or more at A2-P2."
        />
        <Figure
          label="Coaptation height, A2–P2"
          value={m.coaptationHeight}
          before={before?.coaptationHeight}
          unit="mm"
          good="high"
          spread={range('coaptationHeight')}
        />
        <Figure
          label="Tenting height"
          value={m.tentingHeight}
          before={before?.tentingHeight}
          unit="mm"
          good="low"
          spread={range('tentingHeight')}
          help="Deepest point of the closed leaflets below the plane of the annulus"
        />
        <Figure
          label="Prolapse above annulus"
          value={m.billowHeight}
          before={before?.billowHeight}
          unit="mm"
          good="low"
          spread={range('billowHeight')}
          warn={m.billowHeight > 2}
          help="Highest point above the surface of the annulus; more than 2 mm is prolapse"
        />
      </div>
      <Scallops figures={figures} />
      <Section title="Annulus" open>
        <div class="figures">
          <Figure label="Front to back (AP)" value={m.annulusAp} before={before?.annulusAp} unit="mm" />
          <Figure label="Side to side (CC)" value={m.annulusCc} before={before?.annulusCc} unit="mm" />
          <Figure
            label="Circumference"
            value={m.annulusPerimeter}
            before={before?.annulusPerimeter}
            unit="mm"
            digits={0}
          />
          <Figure
            label="Area"
            value={m.annulusArea / 100}
            before={before && before.annulusArea / 100}
            unit="cm²"
          />
        </div>
      </Section>
      <Chordae figures={figures} />
      <OpenArea figures={figures} />
      <Section title="Section through the valve" id="section">
        <SectionPlot />
      </Section>
      <Section title="Physics">
        <div class="figures">
          <Figure
            label="Coaptation area"
            value={m.coaptationArea}
            before={before?.coaptationArea}
            unit="mm²"
            digits={0}
          />
          <Figure
            label="Coaptation, least"
            value={m.coaptationMin}
            before={before?.coaptationMin}
            unit="mm"
          />
          <Figure
            label="Tenting volume"
            value={m.tentingVolume}
            before={before?.tentingVolume}
            unit="ml"
            digits={2}
          />
          <Figure
            label="Prolapse volume"
            value={m.billowVolume}
            before={before?.billowVolume}
            unit="ml"
            digits={2}
          />
          <Figure label="Saddle height" value={m.annulusSaddle} before={before?.annulusSaddle} unit="mm" />
          <Figure
            label="Non-planar angle"
            value={m.annulusAngle}
            before={before?.annulusAngle}
            unit="°"
            digits={0}
          />
          <Figure
            label="Leaflet stretch, 95 % below"
            value={100 * m.leafletStrain95}
            before={before && 100 * before.leafletStrain95}
            unit="%"
            digits={0}
          />
          <Figure
            label="Leaflet stress, 95 % below"
            value={m.leafletStress95 / 1000}
            before={before && before.leafletStress95 / 1000}
            unit="kPa"
            digits={0}
          />
          <Figure
            label="Strongest chord pull"
            value={m.maxChordTension}
            before={before?.maxChordTension}
            unit="N"
            digits={2}
            spread={range('maxChordTension')}
          />
          {figures.heads.map((force, h) => (
            <Figure
              label={`Pull on ${headName(h)}`}
              value={force}
              before={state.before.value?.heads[h]}
              unit="N"
              digits={2}
            />
          ))}
        </div>
        <p class="hint">
          Closed at 120 mmHg. Fingerprint of this valve: <code>{figures.hash}</code>
        </p>
        <Button
          icon={<Layers size={16} />}
          onClick={() => void measureSpread()}
          disabled={!!state.preview.value}
        >
          How certain? Close it 8 times
        </Button>
        {spread && (
          <p class="hint" role="status">
            {spread.converged} of {spread.members} closures at rest, {spread.equilibria}{' '}
            {spread.equilibria === 1 ? 'shape' : 'different folds'}, at most {figure(spread.nodeMax)} mm
            apart. Leak {figure(range('orifice')?.[0] ?? 0)} to {figure(range('orifice')?.[1] ?? 0)} mm².
          </p>
        )}
      </Section>
    </div>
  );
}

function headName(h: number): string {
  const picture = state.picture.value;
  return (picture && state.topologyOf(picture)?.heads[h]?.name) ?? `head ${h + 1}`;
}

function OpenArea({ figures }: { figures: Figures }) {
  const cost = state.cost.value?.hash === figures.hash ? state.cost.value.value : null;
  return (
    <Section title="How far it opens">
      {cost ? (
        <div class="figures">
          <Figure
            label="Open area in diastole"
            value={cost.openArea / 100}
            unit="cm²"
            digits={2}
            help="Smallest opening at 5 mmHg"
          />
          <Figure label="Pull on the annulus" value={cost.annulusForce} unit="N" />
        </div>
      ) : (
        <Button icon={<Activity size={16} />} onClick={() => void measureCost()}>
          Measure the open area
        </Button>
      )}
    </Section>
  );
}
