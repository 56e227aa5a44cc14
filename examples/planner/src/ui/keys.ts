// The tabs of the panels, and the keys of the page.
import { apply, discard, pickField } from '../store/edit';
import { openTo, redo, undo } from '../store/history';
import { saveSession } from '../store/keep';
import * as state from '../store/state';
import { appTexts, importTexts } from '../text/texts';
import { clipKey } from '../view/clip';
import { maps, type MapName } from '../view/colours';
import type { Preset } from '../view/camera';
import { chooseFile } from './toolbar';

type Tab = [state.Panel, string, string];
const panels: Tab[] = [
  ['valve', appTexts.valve, 'V'],
  ['repair', appTexts.repair, 'R'],
  ['plan', appTexts.plan, 'P'],
  ['tour', appTexts.tour, 'L'],
];
/** The panel of an import, as long as there is one. */
const importTab: Tab = ['import', importTexts.tab, 'I'];
export const tabs = (): Tab[] => (state.imported.value ? [...panels, importTab] : panels);

/** Opens a panel and goes to its tab, so that Tab goes on into the panel. */
export function showPanel(name: state.Panel): void {
  state.panel.value = name;
  requestAnimationFrame(() => document.getElementById(`tab-${name}`)?.focus());
}

const mapNames: MapName[] = ['tissue', ...(Object.keys(maps) as MapName[])];

/** Keys of the page, not while text is typed; `go` turns the picture to a view. */
export function onKey(event: KeyboardEvent, go: (preset: Preset) => void): void {
  const target = event.target as HTMLElement;
  const typing =
    /^(INPUT|TEXTAREA|SELECT)$/.test(target.tagName) &&
    (target as HTMLInputElement).type !== 'range' &&
    (target as HTMLInputElement).type !== 'checkbox';
  if (state.dialog.value) return;
  const control = event.ctrlKey || event.metaKey;
  const key = event.key.toLowerCase();
  if (control) {
    // in a text, undo and redo belong to the text; the browser would save and open pages by the others
    if (key === 's') void saveSession();
    else if (key === 'o') chooseFile();
    else if (key === 'z' && !event.shiftKey && !typing) void undo();
    else if ((key === 'y' || (key === 'z' && event.shiftKey)) && !typing) void redo();
    else return;
    event.preventDefault();
    return;
  }
  if (event.key === 'Escape' && state.picking.value === 'outline') return pickField(null);
  if (event.key === 'Escape' && state.draft.value) return discard();
  if (event.key === 'Escape') state.choice.value = null;
  if (typing || event.altKey) return;
  if (
    event.key === 'Enter' &&
    state.draft.value &&
    state.picking.value !== 'outline' &&
    target.tagName !== 'BUTTON' &&
    target.tagName !== 'SUMMARY'
  )
    return void apply();
  const views: Record<string, Preset> = { 1: 'surgeon', 2: 'ventricle', 3: 'commissure', 4: 'section' };
  if (views[key]) return go(views[key]);
  if (clipKey(key)) return;
  const panel = tabs().find(([, , letter]) => letter.toLowerCase() === key);
  if (panel) showPanel(panel[0]);
  else if (key === 'o' && state.main.value && !state.draft.value)
    void openTo(state.openness.value >= 1 ? 0 : 1);
  else if (key === 'w' && !state.motion.value) state.past.value = !state.inPast.value;
  else if (key === 'x') state.sectionOn.value = !state.sectionOn.value;
  else if (key === 'c') state.chordsOn.value = !state.chordsOn.value;
  else if (key === 'n') state.labelsOn.value = !state.labelsOn.value;
  else if (key === 'f') state.dialog.value = 'figures';
  else if (key === 'm') state.map.value = mapNames[(mapNames.indexOf(state.map.value) + 1) % mapNames.length];
  else if ((key === 'g' || key === 'b') && !state.draft.value) {
    const tool = key === 'g' ? 'grasp' : 'push';
    state.tool.value = state.tool.value === tool ? 'look' : tool;
  } else if (key === '?') state.dialog.value = 'keys';
}
