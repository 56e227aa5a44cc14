// Scallops and chordae as tables: the twin of the picture for keyboard and screen reader.
import * as state from '../store/state';
import { figure, kinds, tableTexts } from '../text/texts';
import type { Figures } from '../protocol';
import { chordValue, percentOfLimit, shareOfLimit, suture } from '../notable';
import { Section } from './parts';

export function Scallops({ figures }: { figures: Figures }) {
  const before = state.before.value;
  // the regions of a preview are known last: their rows wait with dots
  const waiting = figures.known !== 'all';
  const regions = waiting ? (before?.regions ?? []) : figures.regions;
  const dots = (text: string) => (waiting ? '…' : text);
  return (
    <Section title={tableTexts.scallops} open>
      <table class="table" data-testid="scallops">
        <thead>
          <tr>
            <th>{tableTexts.scallop}</th>
            <th>{tableTexts.coaptation}</th>
            <th>{tableTexts.leak}</th>
            <th>{tableTexts.prolapse}</th>
          </tr>
        </thead>
        <tbody>
          {regions.map((region) => {
            const was = before?.regions.find((candidate) => candidate.name === region.name);
            return (
              <tr class={!waiting && region.orifice > 0 ? 'leaking' : ''}>
                <th scope="row">{region.commissure ? tableTexts.commissure(region.name) : region.name}</th>
                <td>
                  {dots(figure(region.coaptationMean))}
                  {was && !waiting && Math.abs(was.coaptationMean - region.coaptationMean) >= 0.05 && (
                    <small>{tableTexts.was(figure(was.coaptationMean))}</small>
                  )}
                </td>
                <td>{dots(region.orifice > 0 ? figure(region.orifice) : '–')}</td>
                <td>{dots(region.billow > 0 ? figure(region.billow) : '–')}</td>
              </tr>
            );
          })}
        </tbody>
      </table>
      {!waiting && regions.some((region) => region.orifice > 0) && <p class="hint">{tableTexts.leakHint}</p>}
    </Section>
  );
}

export function Chordae({ figures }: { figures: Figures }) {
  const chosen = state.choice.value;
  // the stitches of a clip or a suture are no chordae
  const chordae = figures.chords.filter((chord) => chord.kind !== suture);
  const rows = chordae
    .map((chord) => ({ chord, share: shareOfLimit(chord) }))
    .sort((a, b) => b.share - a.share);
  return (
    <Section title={tableTexts.chordae(chordae.length)}>
      <p class="hint">{tableTexts.chordaeHint}</p>
      <div class="scroll">
        <table class="table" data-testid="chords">
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
                      onClick={() => (
                        (state.choice.value = { kind: 'chord', id: chord.id }),
                        (state.panel.value = 'repair')
                      )}
                    >
                      {chord.name}
                    </button>{' '}
                    <small>{kinds[chord.kind]}</small>
                  </th>
                  <td>{chord.strain <= 0 ? tableTexts.slack : `${percentOfLimit(share)} %`}</td>
                  <td>{figure(chordValue('pull', chord), 0)}</td>
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
