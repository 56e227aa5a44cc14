// The bar above (files, undo, help) and the bar below the picture (views, opening, colours, tools).
import {
  CircleHelp,
  Eye,
  FolderOpen,
  Hand,
  Redo2,
  Save,
  SquareSplitHorizontal,
  Tag,
  Undo2,
  Workflow,
} from 'lucide-preact';
import { openFile, openShipped } from '../store/files';
import { openTo, redo, undo } from '../store/history';
import { saveSession } from '../store/keep';
import * as state from '../store/state';
import { barTexts, mapWords, t, tips, tourTexts } from '../text/texts';
import type { MapName } from '../view/colours';
import type { Preset } from '../view/camera';
import { Button } from './parts';

export const chooseFile = (): void => document.getElementById('file')?.click();

export function TopBar() {
  return (
    <header class="top">
      <div class="brand">
        <strong>{t.product}</strong>
        <small>{t.research}</small>
      </div>
      <PresentValve />
      <div class="row">
        <input
          id="file"
          type="file"
          hidden
          accept=".mvsplan,.zip,.obj,.stl,.ply,.off,.vtp,.vtk"
          onChange={(event) => {
            const file = event.currentTarget.files?.[0];
            if (file) void openFile(file);
            event.currentTarget.value = '';
          }}
        />
        <Button icon={<FolderOpen size={18} />} keys="Control+O" onClick={chooseFile}>
          {barTexts.open}
        </Button>
        <Button
          icon={<Save size={18} />}
          keys="Control+S"
          disabled={!state.main.value}
          onClick={() => void saveSession()}
        >
          {barTexts.save}
        </Button>
        <Button
          kind="quiet"
          icon={<Undo2 size={18} />}
          label={barTexts.undo}
          keys="Control+Z"
          disabled={!state.canUndo.value}
          onClick={() => void undo()}
        />
        <Button
          kind="quiet"
          icon={<Redo2 size={18} />}
          label={barTexts.redo}
          keys="Control+Y"
          disabled={!state.canRedo.value}
          onClick={() => void redo()}
        />
        <Button label={barTexts.startHealthy} onClick={() => void openShipped('healthy', barTexts.healthy)}>
          <span class="wide">{barTexts.startHealthy}</span>
          <span class="narrow">{barTexts.healthy}</span>
        </Button>
        <Button
          kind="quiet"
          icon={<CircleHelp size={18} />}
          label={barTexts.help}
          keys="?"
          onClick={() => (state.dialog.value = 'keys')}
        />
      </div>
    </header>
  );
}

/** What is shown: a file, a valve of the tour, the shipped valve. */
function PresentValve() {
  const { tour, surface, title, coming } = state;
  const name = surface.value
    ? surface.value.name
    : coming.value
      ? '…'
      : tour.value
        ? tourTexts.present(tour.value.number)
        : title.value || state.figures.value?.valve;
  return (
    <div class="present">
      <div class="present-name" data-testid="present" title={`${barTexts.present}: ${name ?? ''}`}>
        {name}
      </div>
      <small class="research" data-testid="research-short" title={t.research}>
        {t.researchShort}
      </small>
    </div>
  );
}

const presets = Object.entries(barTexts.presets) as [Preset, string][];

export function ViewBar(props: { go: (preset: Preset) => void }) {
  // a surface has views, and nothing else of a valve
  const surface = !!state.surface.value;
  return (
    <div class="viewbar">
      <div class="group" role="group" aria-label={barTexts.view}>
        {presets.map(([preset, name], k) => (
          <Button
            keys={String(k + 1)}
            title={tips[name]}
            disabled={surface && preset === 'section'}
            onClick={() => props.go(preset)}
          >
            {name}
          </Button>
        ))}
      </div>
      <label class="opening">
        <span>{barTexts.opened}</span>
        <input
          type="range"
          min="0"
          max="1"
          step="0.02"
          value={state.openness.value}
          aria-label={barTexts.opening}
          title={tips[barTexts.opening]}
          disabled={!state.main.value || !!state.draft.value || surface}
          onInput={(event) => void openTo(+event.currentTarget.value)}
        />
        <span>{barTexts.closed}</span>
      </label>
      <div class="group tools" role="group" aria-label={barTexts.show}>
        <Button
          kind="quiet"
          icon={<SquareSplitHorizontal size={18} />}
          label={barTexts.cut}
          keys="X"
          pressed={state.sectionOn.value}
          disabled={surface}
          onClick={() => (state.sectionOn.value = !state.sectionOn.value)}
        >
          {barTexts.words.cut}
        </Button>
        <Button
          kind="quiet"
          icon={<Workflow size={18} />}
          label={barTexts.chordae}
          keys="C"
          pressed={state.chordsOn.value}
          disabled={surface}
          onClick={() => (state.chordsOn.value = !state.chordsOn.value)}
        >
          {barTexts.words.chordae}
        </Button>
        <Button
          kind="quiet"
          icon={<Tag size={18} />}
          label={barTexts.names}
          keys="N"
          pressed={state.labelsOn.value}
          disabled={surface}
          onClick={() => (state.labelsOn.value = !state.labelsOn.value)}
        >
          {barTexts.words.names}
        </Button>
      </div>
      <div class="group tools" role="group" aria-label={barTexts.pointer}>
        <Button
          kind="quiet"
          icon={<Eye size={18} />}
          label={barTexts.look}
          pressed={state.tool.value === 'look'}
          onClick={() => (state.tool.value = 'look')}
        >
          {barTexts.words.look}
        </Button>
        <Button
          kind="quiet"
          icon={<Hand size={18} />}
          label={barTexts.grasp}
          keys="G"
          pressed={state.tool.value === 'grasp'}
          disabled={!!state.draft.value || surface}
          onClick={() => (state.tool.value = 'grasp')}
        >
          {barTexts.words.grasp}
        </Button>
        <Button
          kind="quiet"
          icon={<span class="ball" />}
          label={barTexts.push}
          keys="B"
          pressed={state.tool.value === 'push'}
          disabled={!!state.draft.value || surface}
          onClick={() => (state.tool.value = 'push')}
        >
          {barTexts.words.push}
        </Button>
      </div>
      <label class="colours">
        <select
          value={state.map.value}
          aria-label={barTexts.colours}
          title={tips[barTexts.colours]}
          disabled={surface}
          onChange={(event) => (state.map.value = event.currentTarget.value as MapName)}
        >
          {Object.entries(mapWords).map(([name, words]) => (
            <option value={name}>{words.title}</option>
          ))}
        </select>
      </label>
    </div>
  );
}
