// The panel "Plan": operations, checkpoints, two plans side by side, notes, and keeping it all.
import { useSignal } from '@preact/signals';
import { Bookmark, Download, FileText, Redo2, Save, Undo2 } from 'lucide-preact';
import { redo, undo } from '../store/actions';
import { compareCheckpoint, restoreCheckpoint, saveCheckpoint } from '../store/measure';
import { allowAutosave, autosave, saveObj, saveSession, storageWorks } from '../store/keep';
import * as state from '../store/state';
import { figure, say } from '../text/texts';
import type { Measures } from '../protocol';
import { Button, Section } from './parts';

export function PlanPanel() {
  const figures = state.main.value?.figures;
  const name = useSignal('');
  if (!figures) return <p class="hint">The valve is being closed…</p>;
  const done = figures.history.filter((entry) => !entry.undone);
  return (
    <div class="panel-body">
      <div class="row">
        <Button
          icon={<Undo2 size={16} />}
          keys="Control+Z"
          disabled={!state.canUndo.value}
          onClick={() => void undo()}
        >
          Undo
        </Button>
        <Button
          icon={<Redo2 size={16} />}
          keys="Control+Y"
          disabled={!state.canRedo.value}
          onClick={() => void redo()}
        >
          Redo
        </Button>
      </div>
      <h2>{state.title.value || figures.valve}</h2>
      <ol class="history" data-testid="history">
        {figures.history.map((entry) => (
          <li class={entry.undone ? 'undone' : ''}>{say(entry.title)}</li>
        ))}
      </ol>
      {done.length === 0 && <p class="hint">Nothing has been done yet. Operations appear here one by one.</p>}
      <Section title="Checkpoints" open>
        <form
          class="row"
          onSubmit={(event) => {
            event.preventDefault();
            const given = name.value.trim() || `Plan ${state.checkpoints.value.length + 1}`;
            void saveCheckpoint(given);
            name.value = '';
          }}
        >
          <input
            type="text"
            maxLength={40}
            aria-label="Name of the checkpoint"
            placeholder={`Plan ${state.checkpoints.value.length + 1}`}
            value={name.value}
            onInput={(event) => (name.value = event.currentTarget.value)}
          />
          <button type="submit" class="button plain">
            <Bookmark size={16} />
            <span>Keep</span>
          </button>
        </form>
        {state.checkpoints.value.map((checkpoint) => (
          <div class="row checkpoint">
            <span>{checkpoint}</span>
            <Button onClick={() => void restoreCheckpoint(checkpoint)}>Return to it</Button>
            <Button
              pressed={state.compareWith.value === checkpoint}
              onClick={() =>
                void compareCheckpoint(state.compareWith.value === checkpoint ? null : checkpoint)
              }
            >
              Compare
            </Button>
          </div>
        ))}
        {state.compared.value && <SideBySide />}
      </Section>
      <Section title="Notes">
        <textarea
          rows={4}
          aria-label="Notes"
          value={state.notes.value}
          onInput={(event) => (state.notes.value = event.currentTarget.value)}
        />
      </Section>
      <Section title="Keep" open>
        <div class="row">
          <Button kind="main" icon={<Save size={16} />} keys="Control+S" onClick={() => void saveSession()}>
            Save session
          </Button>
          <Button icon={<Download size={16} />} onClick={() => void saveObj()}>
            Valve as OBJ
          </Button>
          <Button icon={<FileText size={16} />} onClick={() => (state.dialog.value = 'report')}>
            Report
          </Button>
        </div>
        <label class="check">
          <input
            type="checkbox"
            checked={autosave.value}
            disabled={!storageWorks.value}
            onChange={(event) => void allowAutosave(event.currentTarget.checked)}
          />
          Keep a copy in this browser, to recover after a crash
        </label>
        <p class="hint">
          {storageWorks.value
            ? 'Any page opened from this computer’s disk in this browser could read that copy, and the browser may remove it. Nothing is sent anywhere.'
            : 'This browser refuses storage to pages from disk: save the session to a file.'}
        </p>
      </Section>
    </div>
  );
}

const rows: [string, (m: Measures) => number, number, string][] = [
  ['Leak', (m) => m.orifice, 1, 'mm²'],
  ['Coaptation, mean', (m) => m.coaptationMean, 1, 'mm'],
  ['Coaptation height', (m) => m.coaptationHeight, 1, 'mm'],
  ['Tenting height', (m) => m.tentingHeight, 1, 'mm'],
  ['Prolapse', (m) => m.billowHeight, 1, 'mm'],
  ['Annulus AP', (m) => m.annulusAp, 1, 'mm'],
  ['Annulus CC', (m) => m.annulusCc, 1, 'mm'],
  ['Chordae beyond limit', (m) => m.chordsOver, 0, ''],
  ['Strongest chord pull', (m) => m.maxChordTension, 2, 'N'],
];

function SideBySide() {
  const now = state.main.value!.figures;
  const other = state.compared.value!.figures;
  return (
    <table class="table" data-testid="compare">
      <thead>
        <tr>
          <th></th>
          <th>{state.compareWith.value}</th>
          <th>Present plan</th>
        </tr>
      </thead>
      <tbody>
        {rows.map(([label, get, digits, unit]) => (
          <tr>
            <th scope="row">{label}</th>
            <td>
              {figure(get(other.measures), digits)} {unit}
            </td>
            <td>
              {figure(get(now.measures), digits)} {unit}
            </td>
          </tr>
        ))}
        <tr class="wrap">
          <th scope="row">Steps</th>
          <td>
            {other.history
              .filter((e) => !e.undone)
              .map((e) => say(e.title))
              .join('; ') || 'none'}
          </td>
          <td>
            {now.history
              .filter((e) => !e.undone)
              .map((e) => say(e.title))
              .join('; ') || 'none'}
          </td>
        </tr>
      </tbody>
    </table>
  );
}
