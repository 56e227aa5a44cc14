// Scallops and chordae as tables: the twin of the picture for keyboard and screen reader.
import * as state from '../store/state';
import { figure, kindOf, partTexts, tableTexts, tipTexts } from '../text/texts';
import type { Figures } from '../protocol';
import { shownEdges } from '../store/edges';
import { chordValue, percentOfLimit, shareOfLimit, suture } from '../notable';
import { shownDoubt } from '../store/doubt';
import { DoubtNote, Section, Spread, times } from './parts';

/** mm2: less is shown as 0.0. */
const shownLeak = 0.05;

export function Scallops({ figures }: { figures: Figures }) {
  const before = state.before.value;
  // the regions of a preview are known last: their rows wait with dots
  const waiting = figures.known !== 'all';
  const regions = waiting ? (before?.regions ?? []) : figures.regions;
  const dots = (text: string) => (waiting ? '…' : text);
  const edges = shownEdges.value;
  const ranges = waiting ? undefined : state.shownSpread.value?.regions;
  return (
    <Section title={tableTexts.scallops} open>
      <DoubtNote />
      <table class={`table scallops${shownDoubt.value ? ' doubtful' : ''}`} data-testid="scallops">
        <thead>
          <tr>
            <th>{tableTexts.scallop}</th>
            <th>{tableTexts.coaptation}</th>
            <th>{tableTexts.leak}</th>
            <th title={tableTexts.billowHelp}>{tableTexts.billow}</th>
            <th title={tableTexts.edgeHelp}>{tableTexts.edge}</th>
          </tr>
        </thead>
        <tbody>
          {regions.map((region) => {
            const was = before?.regions.find((candidate) => candidate.name === region.name);
            return (
              <tr class={!waiting && region.orifice >= shownLeak ? 'leaking' : ''}>
                <th scope="row">{region.commissure ? tableTexts.commissure(region.name) : region.name}</th>
                <td>
                  {dots(figure(region.coaptationMean))}
                  {was && !waiting && Math.abs(was.coaptationMean - region.coaptationMean) >= 0.05 && (
                    <small>{tableTexts.was(figure(was.coaptationMean))}</small>
                  )}
                  <Spread range={ranges?.[region.name]?.coaptationMean} digits={1} bare />
                </td>
                <td class="leak">
                  {dots(region.orifice > 0 ? figure(region.orifice) : '–')}
                  <Spread range={ranges?.[region.name]?.orifice} digits={1} bare />
                </td>
                <td>
                  {dots(region.billow > 0 ? figure(region.billow) : '–')}
                  <Spread range={ranges?.[region.name]?.billow} digits={1} bare />
                </td>
                <td class={edges.get(region.name)! > 0 ? 'edge high' : 'edge'}>
                  {edges.has(region.name) ? tableTexts.signed(edges.get(region.name)!) : ''}
                </td>
              </tr>
            );
          })}
        </tbody>
      </table>
      {ranges && <Ranges />}
      {!waiting && regions.some((region) => region.orifice > 0) && <p class="hint">{tableTexts.leakHint}</p>}
    </Section>
  );
}

/** What the ranges of a table are. */
function Ranges() {
  const { value } = state.shownSpread;
  return value && <p class="hint">{partTexts.ranges(value.converged)}</p>;
}

export function Chordae({ figures }: { figures: Figures }) {
  const chosen = state.choice.value;
  const pulls = state.shownSpread.value?.chords;
  // the stitches of a clip or a suture are no chordae
  const chordae = figures.chords.filter((chord) => chord.kind !== suture);
  const rows = chordae
    .map((chord) => ({ chord, share: shareOfLimit(chord) }))
    .sort((a, b) => b.share - a.share);
  return (
    <Section title={tableTexts.chordae(chordae.length)} tip={tipTexts.chordae} name="chordae">
      <p class="hint">
        {tableTexts.chordaeHint} {chordae.some((chord) => chord.artificial) && tableTexts.artificialHint}
      </p>
      <DoubtNote />
      {pulls && <Ranges />}
      <div class="scroll">
        <table class={`table${shownDoubt.value ? ' doubtful' : ''}`} data-testid="chords">
          <thead>
            <tr>
              <th>{tableTexts.chord}</th>
              <th>{tableTexts.ofLimit}</th>
              <th>{tableTexts.pull}</th>
              <th>{tableTexts.length}</th>
            </tr>
          </thead>
          <tbody>
            {rows.map(({ chord, share }) => {
              return (
                <tr class={`${chord.over ? 'over' : ''} ${chosen?.id === chord.id ? 'chosen' : ''}`}>
                  <th scope="row">
                    <button
                      type="button"
                      class="link"
                      title={tipTexts.chordInTable(chord.name)}
                      onClick={() => (
                        (state.choice.value = { kind: 'chord', id: chord.id }),
                        (state.panel.value = 'repair')
                      )}
                    >
                      {chord.name}
                    </button>{' '}
                    <small>{kindOf(chord)}</small>
                  </th>
                  <td>{chord.strain <= 0 ? tableTexts.slack : `${percentOfLimit(share)} %`}</td>
                  <td>
                    {figure(chordValue('pull', chord), 0)}
                    <Spread range={times(pulls?.[chord.id], 1000)} digits={0} bare />
                  </td>
                  <td>{figure(chord.rest)}</td>
                </tr>
              );
            })}
          </tbody>
        </table>
      </div>
    </Section>
  );
}
