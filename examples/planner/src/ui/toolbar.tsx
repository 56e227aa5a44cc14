// The bar above (files, undo, help) and the bar below the picture (views, opening, colours, tools).
import { CircleHelp, Eye, FolderOpen, Hand, Redo2, Save, Slice, Tag, Undo2, Workflow } from 'lucide-preact';
import { openFile, openShipped, openTo, redo, undo } from '../store/actions';
import { saveSession } from '../store/keep';
import * as state from '../store/state';
import { mapWords, t } from '../text/texts';
import { gradient, maps, type MapName } from '../view/colours';
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
          Open
        </Button>
        <Button
          icon={<Save size={18} />}
          keys="Control+S"
          disabled={!state.main.value}
          onClick={() => void saveSession()}
        >
          Save
        </Button>
        <Button
          kind="quiet"
          icon={<Undo2 size={18} />}
          label="Undo"
          keys="Control+Z"
          disabled={!state.canUndo.value}
          onClick={() => void undo()}
        />
        <Button
          kind="quiet"
          icon={<Redo2 size={18} />}
          label="Redo"
          keys="Control+Y"
          disabled={!state.canRedo.value}
          onClick={() => void redo()}
        />
        <Button
          kind="quiet"
          onClick={() => ((state.tour.value = null), void openShipped('healthy', 'Healthy valve'))}
        >
          Healthy valve
        </Button>
        <Button
          kind="quiet"
          icon={<CircleHelp size={18} />}
          label="Keys and help"
          keys="?"
          onClick={() => (state.dialog.value = 'keys')}
        />
      </div>
    </header>
  );
}

const presets: [Preset, string][] = [
  ['surgeon', 'Surgeon'],
  ['ventricle', 'Ventricle'],
  ['commissure', 'Side'],
  ['section', 'Section'],
];

export function ViewBar(props: { go: (preset: Preset) => void }) {
  return (
    <div class="viewbar">
      <div class="group" role="group" aria-label="View">
        {presets.map(([preset, name], k) => (
          <Button
            keys={String(k + 1)}
            title={`View: ${name}`}
            onClick={() => {
              if (preset === 'section') state.sectionOn.value = true;
              props.go(preset);
            }}
          >
            {name}
          </Button>
        ))}
      </div>
      <label class="opening">
        <span>Open</span>
        <input
          type="range"
          min="0"
          max="1"
          step="0.02"
          value={state.openness.value}
          aria-label="Open or closed"
          disabled={!state.main.value || !!state.draft.value}
          onInput={(event) => void openTo(+event.currentTarget.value)}
        />
        <span>Closed</span>
      </label>
      <div class="group" role="group" aria-label="Show">
        <Button
          kind="quiet"
          icon={<Slice size={18} />}
          label="Cut at the section plane"
          keys="X"
          pressed={state.sectionOn.value}
          onClick={() => (state.sectionOn.value = !state.sectionOn.value)}
        />
        <Button
          kind="quiet"
          icon={<Workflow size={18} />}
          label="Chordae"
          keys="C"
          pressed={state.chordsOn.value}
          onClick={() => (state.chordsOn.value = !state.chordsOn.value)}
        />
        <Button
          kind="quiet"
          icon={<Tag size={18} />}
          label="Names"
          keys="N"
          pressed={state.labelsOn.value}
          onClick={() => (state.labelsOn.value = !state.labelsOn.value)}
        />
      </div>
      <div class="group" role="group" aria-label="Pointer">
        <Button
          kind="quiet"
          icon={<Eye size={18} />}
          label="Turn and choose"
          pressed={state.tool.value === 'look'}
          onClick={() => (state.tool.value = 'look')}
        />
        <Button
          kind="quiet"
          icon={<Hand size={18} />}
          label="Grasp and pull tissue"
          keys="G"
          pressed={state.tool.value === 'grasp'}
          disabled={!!state.draft.value}
          onClick={() => (state.tool.value = 'grasp')}
        />
        <Button
          kind="quiet"
          icon={<span class="ball" />}
          label="Push tissue with a ball"
          keys="B"
          pressed={state.tool.value === 'push'}
          disabled={!!state.draft.value}
          onClick={() => (state.tool.value = 'push')}
        />
      </div>
      <label class="colours">
        <select
          value={state.map.value}
          aria-label="Colours"
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

/** The scale of the colour map, in its unit. */
export function Scale() {
  const name = state.map.value;
  if (name === 'tissue') {
    return (
      <div class="scale" aria-hidden="true">
        <span>
          <i class="key key-atrial" /> atrial side
        </span>
        <span>
          <i class="key key-ventricular" /> ventricular side
        </span>
        {(state.figures.value?.measures.orifice ?? 0) > 0 && (
          <span>
            <i class="key key-orifice" /> leak
          </span>
        )}
        {(state.figures.value?.measures.chordsOver ?? 0) > 0 && (
          <span>
            <i class="key key-over" /> chord beyond its limit
          </span>
        )}
      </div>
    );
  }
  const map = maps[name];
  return (
    <div class="scale">
      <span>{mapWords[name].scale}</span>
      <span class="bar">
        <em>{map.low}</em>
        <i style={{ background: gradient(map) }} />
        <em>
          {map.high} {map.unit}
        </em>
      </span>
    </div>
  );
}
