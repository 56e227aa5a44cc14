// The panel "Valve": the clinical figures first, the physics behind a click.
import { Activity, Layers } from 'lucide-preact';
import { measureCost, measureSpread } from '../store/measure';
import { gradientOf, isTooMuch } from '../store/gradient';
import { isWide, openingOf } from '../store/limits';
import { mostBillowing } from '../notable';
import { ofMiddle } from '../store/names';
import * as state from '../store/state';
import { appTexts, valveTexts } from '../text/texts';
import type { Figures, Measures } from '../protocol';
import { Devices } from './devices';
import { Flow } from './flow';
import { Button, DoubtNote, Figure, FigureHelpButton, Section, times } from './parts';
import { SectionPlot } from './section';
import { Chordae, Scallops } from './tables';

export function ValvePanel() {
  const figures = state.figures.value;
  if (!figures) return <p class="hint">{appTexts.closing}</p>;
  const before = state.before.value?.measures;
  const m = figures.measures;
  const spread = state.shownSpread.value;
  const range = (name: keyof Measures, factor = 1) => times(spread?.measures[name], factor);
  return (
    <div class="panel-body">
      <DoubtNote />
      <div class="figures">
        <Figure
          label={valveTexts.coaptationMean}
          value={m.coaptationMean}
          before={before?.coaptationMean}
          unit="mm"
          good="high"
          spread={range('coaptationMean')}
          help={valveTexts.coaptationMeanHelp}
          note={valveTexts.alongLeaflets}
        />
        <Figure
          label={ofMiddle(valveTexts.coaptationHeight)}
          value={m.coaptationHeight}
          before={before?.coaptationHeight}
          unit="mm"
          good="high"
          spread={range('coaptationHeight')}
          help={valveTexts.coaptationHeightHelp}
          note={valveTexts.alongAxis}
        />
        <Figure
          label={valveTexts.tenting}
          value={m.tentingHeight}
          before={before?.tentingHeight}
          unit="mm"
          good="low"
          spread={range('tentingHeight')}
          help={valveTexts.tentingHelp}
        />
        <Figure
          label={valveTexts.billow}
          value={m.billowHeight}
          before={before?.billowHeight}
          unit="mm"
          good="low"
          spread={range('billowHeight')}
          warn={m.billowHeight > 2}
          help={valveTexts.billowHelp}
          note={billowing(figures)}
        />
      </div>
      <FigureHelpButton />
      <Scallops figures={figures} />
      <Section title={valveTexts.annulus} open>
        <div class="figures">
          <Figure label={valveTexts.ap} value={m.annulusAp} before={before?.annulusAp} unit="mm" />
          <Figure label={valveTexts.cc} value={m.annulusCc} before={before?.annulusCc} unit="mm" />
          <Figure
            label={valveTexts.circumference}
            value={m.annulusPerimeter}
            before={before?.annulusPerimeter}
            unit="mm"
            digits={0}
          />
          <Figure
            label={valveTexts.area}
            value={m.annulusArea / 100}
            before={before && before.annulusArea / 100}
            unit="cm²"
          />
        </div>
      </Section>
      <Devices figures={figures} />
      <Chordae figures={figures} />
      <OpenArea figures={figures} />
      <Certainty />
      <Section title={valveTexts.section} id="section">
        <SectionPlot />
      </Section>
      <Section title={valveTexts.physics}>
        <div class="figures">
          <Figure
            label={valveTexts.coaptationArea}
            value={m.coaptationArea}
            before={before?.coaptationArea}
            unit="mm²"
            digits={0}
            spread={range('coaptationArea')}
          />
          <Figure
            label={valveTexts.coaptationLeast}
            value={m.coaptationMin}
            before={before?.coaptationMin}
            unit="mm"
            spread={range('coaptationMin')}
          />
          <Figure
            label={valveTexts.tentingVolume}
            value={m.tentingVolume}
            before={before?.tentingVolume}
            unit="ml"
            digits={2}
            spread={range('tentingVolume')}
          />
          <Figure
            label={valveTexts.billowVolume}
            value={m.billowVolume}
            before={before?.billowVolume}
            unit="ml"
            digits={2}
            spread={range('billowVolume')}
          />
          <Figure
            label={valveTexts.saddle}
            value={m.annulusSaddle}
            before={before?.annulusSaddle}
            unit="mm"
          />
          <Figure
            label={valveTexts.angle}
            value={m.annulusAngle}
            before={before?.annulusAngle}
            unit="°"
            digits={0}
          />
          <Figure
            label={valveTexts.stretch95}
            value={100 * m.leafletStrain95}
            before={before && 100 * before.leafletStrain95}
            unit="%"
            digits={0}
            spread={range('leafletStrain95', 100)}
          />
          <Figure
            label={valveTexts.stress95}
            value={m.leafletStress95 / 1000}
            before={before && before.leafletStress95 / 1000}
            unit="kPa"
            digits={0}
            spread={range('leafletStress95', 1e-3)}
          />
          <Figure
            label={valveTexts.strongestPull}
            value={1000 * m.maxChordTension}
            before={before && 1000 * before.maxChordTension}
            unit="mN"
            digits={0}
            spread={range('maxChordTension', 1000)}
          />
          {figures.heads.map((force, h) => (
            <Figure
              label={valveTexts.pullOn(headName(h))}
              value={force}
              before={state.before.value?.heads[h]}
              unit="N"
              digits={2}
              spread={spread?.heads[h]}
            />
          ))}
        </div>
        <p class="hint">
          {valveTexts.closedAt} <code>{figures.hash}</code>
        </p>
        <p class="hint" data-testid="chords-cross">
          {valveTexts.chordsCross}
        </p>
      </Section>
    </div>
  );
}

/** The scallop in which the leaflets billow most. */
function billowing({ regions, measures }: Figures): string {
  const most = mostBillowing(regions);
  return most && measures.billowHeight > 0 ? valveTexts.at(most.name) : '';
}

function headName(h: number): string {
  const picture = state.picture.value;
  return (picture && state.topologyOf(picture)?.heads[h]?.name) ?? valveTexts.head(h + 1);
}

/** How far the figures depend on the folds from which the valve closes. */
function Certainty() {
  const spread = state.shownSpread.value;
  const leak = spread?.measures.orifice ?? [0, 0];
  return (
    <Section title={valveTexts.certainty}>
      <p class="hint">{valveTexts.certaintyHint}</p>
      <Button
        icon={<Layers size={16} />}
        onClick={() => void measureSpread()}
        disabled={!!state.preview.value}
      >
        {valveTexts.howCertain}
      </Button>
      {spread && (
        <p class="hint" role="status">
          {valveTexts.spread(spread.converged, spread.members, spread.equilibria, spread.nodeMax)}
          {valveTexts.spreadLeak(leak[0], leak[1])}
        </p>
      )}
    </Section>
  );
}

function OpenArea({ figures }: { figures: Figures }) {
  const cost = openingOf(figures.hash);
  const gradient = gradientOf(cost);
  const wide = !!cost && isWide(cost);
  return (
    <Section title={valveTexts.opens}>
      <Flow known={!!cost} />
      {cost ? (
        <div class="figures">
          <Figure
            label={valveTexts.openArea}
            value={cost.openArea / 100}
            unit="cm²"
            help={valveTexts.openAreaHelp}
            note={wide ? valveTexts.wideMark : ''}
          />
          {gradient !== null && (
            <Figure
              label={valveTexts.gradient}
              value={gradient}
              unit="mmHg"
              help={valveTexts.gradientHelp}
              warn={isTooMuch(gradient)}
            />
          )}
          <Figure label={valveTexts.annulusPull} value={cost.annulusForce} unit="N" />
        </div>
      ) : (
        <Button icon={<Activity size={16} />} onClick={() => void measureCost()}>
          {valveTexts.measureOpen}
        </Button>
      )}
      {wide && <p class="hint">{valveTexts.openAreaWide}</p>}
      <p class="hint" data-testid="outflow">
        {valveTexts.outflow}
      </p>
    </Section>
  );
}
