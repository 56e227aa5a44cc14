// Scallops and chordae as tables: the twin of the picture for keyboard and screen reader.
import * as state from '../store/state';
import { figure, kinds } from '../text/texts';
import type { Figures } from '../protocol';
import { Section } from './parts';

export function Scallops({ figures }: { figures: Figures }) {
  const before = state.before.value;
  return (
    <Section title="Scallop by scallop" open>
      <table class="table" data-testid="scallops">
        <thead>
          <tr>
            <th>Scallop</th>
            <th>Coaptation</th>
            <th>Leak</th>
            <th>Prolapse</th>
          </tr>
        </thead>
        <tbody>
          {figures.regions.map((region) => {
            const was = before?.regions.find((candidate) => candidate.name === region.name);
            return (
              <tr class={region.orifice > 0 ? 'leaking' : ''}>
                <th scope="row">{region.commissure ? `Commissure ${region.name}` : region.name}</th>
                <td>
                  {figure(region.coaptationMean)} mm
                  {was && Math.abs(was.coaptationMean - region.coaptationMean) >= 0.05 && (
                    <small> was {figure(was.coaptationMean)}</small>
                  )}
                </td>
                <td>{region.orifice > 0 ? `${figure(region.orifice)} mm²` : '–'}</td>
                <td>{region.billow > 0 ? `${figure(region.billow)} mm` : '–'}</td>
              </tr>
            );
          })}
        </tbody>
      </table>
    </Section>
  );
}

export function Chordae({ figures }: { figures: Figures }) {
  const chosen = state.choice.value;
  const rows = [...figures.chords].sort((a, b) => b.strain / b.strainLimit - a.strain / a.strainLimit);
  return (
    <Section title={`Chordae (${figures.chords.length})`}>
      <p class="hint">The most loaded first. Choose one to shorten, lengthen or cut it.</p>
      <div class="scroll">
        <table class="table" data-testid="chords">
          <thead>
            <tr>
              <th>Chord</th>
              <th>Kind</th>
              <th>Length</th>
              <th>Pull</th>
              <th>Of limit</th>
            </tr>
          </thead>
          <tbody>
            {rows.map((chord) => {
              const share = Math.max(chord.strain / chord.strainLimit, chord.tension / chord.tensionLimit);
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
                    </button>
                  </th>
                  <td>{kinds[chord.kind]}</td>
                  <td>{figure(chord.length)} mm</td>
                  <td>{figure(chord.tension, 2)} N</td>
                  <td>{chord.strain <= 0 ? 'slack' : `${Math.round(100 * share)} %`}</td>
                </tr>
              );
            })}
          </tbody>
        </table>
      </div>
    </Section>
  );
}
