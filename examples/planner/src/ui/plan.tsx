// The panel "Plan": operations, checkpoints, two plans side by side, notes, and keeping it all.
import { useEffect, useRef } from 'preact/hooks';
import { Download, FileText, Redo2, Save, Undo2, X } from 'lucide-preact';
import { redo, undo } from '../store/history';
import { compareCheckpoint } from '../store/measure';
import { canKeepFile, chooseKeptFile, keptFile, leaveKeptFile, saveObj, saveSession } from '../store/keep';
import { allowAutosave, autosave, storageWorks } from '../store/recovery';
import { planName } from '../store/plans';
import * as state from '../store/state';
import { headline } from '../store/verdict';
import {
  appTexts,
  barTexts,
  figureNames,
  planTexts,
  reportTexts,
  say,
  tips,
  valveTexts,
} from '../text/texts';
import { Checkpoints } from './checkpoints';
import { BeginHere, EarlierValves } from './earlier';
import { areaText, comparedRows, gradientText, markNotes, stepsOf } from './compared';
import { Button, Section } from './parts';

export function PlanPanel() {
  const figures = state.resting.value?.figures;
  if (!figures) return <p class="hint">{appTexts.closing}</p>;
  return (
    <div class="panel-body">
      <div class="row">
        <Button
          icon={<Undo2 size={16} />}
          keys="Control+Z"
          disabled={!state.canUndo.value}
          onClick={() => void undo()}
        >
          {barTexts.undo}
        </Button>
        <Button
          icon={<Redo2 size={16} />}
          keys="Control+Y"
          disabled={!state.canRedo.value}
          onClick={() => void redo()}
        >
          {barTexts.redo}
        </Button>
      </div>
      <h2>{state.title.value || figures.valve}</h2>
      <ol class="history" data-testid="history">
        {figures.history.map((entry) => (
          <li class={entry.undone ? 'undone' : ''}>{say(entry.title)}</li>
        ))}
      </ol>
      {stepsOf(figures).length === 0 && (
        <p class="hint">{figures.history.length ? planTexts.allUndone : planTexts.nothing}</p>
      )}
      <p data-testid="plan-verdict">
        {planTexts.result} <strong>{headline(figures)}</strong>
      </p>
      <BeginHere />
      <Checkpoints />
      <EarlierValves />
      {state.compared.value && <SideBySide />}
      <Section title={planTexts.notes}>
        <textarea
          rows={4}
          aria-label={planTexts.notes}
          title={tips[planTexts.notes]}
          value={state.notes.value}
          onInput={(event) => {
            state.notes.value = event.currentTarget.value;
            state.changed.value = true;
          }}
        />
      </Section>
      <Section title={planTexts.files} open>
        <div class="row">
          <Button kind="main" icon={<Save size={16} />} keys="Control+S" onClick={() => void saveSession()}>
            {planTexts.save}
          </Button>
          <Button icon={<Download size={16} />} onClick={() => void saveObj()}>
            {planTexts.obj}
          </Button>
          <Button icon={<FileText size={16} />} onClick={() => (state.dialog.value = 'report')}>
            {planTexts.report}
          </Button>
        </div>
        <div class="row">
          {keptFile.value ? (
            <>
              <span class="hint" role="status" data-testid="kept-file">
                {planTexts.keptFile(keptFile.value)}
              </span>
              <Button kind="quiet" onClick={leaveKeptFile}>
                {planTexts.stopFile}
              </Button>
            </>
          ) : (
            canKeepFile && <Button onClick={() => void chooseKeptFile()}>{planTexts.keepFile}</Button>
          )}
        </div>
        {!canKeepFile && <p class="hint">{planTexts.noFile}</p>}
        <label class="check" title={tips[planTexts.autosave]}>
          <input
            type="checkbox"
            checked={autosave.value}
            disabled={!storageWorks.value}
            onChange={(event) => void allowAutosave(event.currentTarget.checked)}
          />
          {planTexts.autosave}
        </label>
        <p class="hint">{storageWorks.value ? planTexts.autosaveHint : planTexts.noStorage}</p>
      </Section>
    </div>
  );
}

function SideBySide() {
  const now = state.main.value!.figures;
  const other = state.compared.value!.figures;
  const table = useRef<HTMLTableElement>(null);
  // it may lie below the panel's edge: a press of Compare would show nothing
  useEffect(() => table.current?.scrollIntoView({ block: 'start' }), [state.compareWith.value]);
  return (
    <>
      <Button icon={<X size={16} />} onClick={() => void compareCheckpoint(null)}>
        {planTexts.endCompare}
      </Button>
      <table class="table" data-testid="compare" ref={table}>
        <thead>
          <tr>
            <th></th>
            <th>{state.compareWith.value}</th>
            <th>{planName(now.hash)}</th>
          </tr>
        </thead>
        <tbody>
          <tr class="wrap">
            <th scope="row">{figureNames.verdict}</th>
            {[other, now].map((figures) => (
              <td>
                <strong>{headline(figures)}</strong>
              </td>
            ))}
          </tr>
          {comparedRows(other, now).map(([label, ...values]) => (
            <tr>
              <th scope="row">{label}</th>
              {values.map((value) => (
                <td>{value}</td>
              ))}
            </tr>
          ))}
          <tr>
            <th scope="row">{valveTexts.openArea}</th>
            {[other, now].map((valve) => (
              <td>{areaText(valve) || '…'}</td>
            ))}
          </tr>
          {state.flow.value && (
            <tr>
              <th scope="row">{reportTexts.gradient(state.flow.value)}</th>
              {[other, now].map((valve) => (
                <td>{gradientText(valve) || '…'}</td>
              ))}
            </tr>
          )}
          <tr class="wrap">
            <th scope="row">{planTexts.steps}</th>
            {[other, now].map((figures) => (
              <td>{stepsOf(figures).join('; ') || planTexts.none}</td>
            ))}
          </tr>
        </tbody>
      </table>
      {markNotes([other, now]).map((note) => (
        <p class="hint">{note}</p>
      ))}
    </>
  );
}
