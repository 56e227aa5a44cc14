// Inputs of the picture, as lists whose items are compared by identity.
import * as state from '../store/state';

/** Whatever the scene is made of: it is built anew where one of these changes. */
export function sceneInputs(): unknown[] {
  const figures = state.figures.value;
  return [
    state.picture.value,
    state.motion.value,
    figures?.hash,
    figures?.orificeParts.length,
    // colours of the leaflets and chordae, and the sides of the leaflets
    state.map.value,
    figures?.fields,
    state.map.value === 'distance' ? state.compared.value : null,
    state.map.value === 'distance' ? state.main.value : null,
    state.choice.value,
    // parts that a preview removes are drawn faintly until it is applied
    !!state.preview.value,
    state.added.value?.id,
    state.chordsOn.value,
  ];
}

/** Whatever is drawn over the scene. */
export function overlayInputs(): unknown[] {
  const draft = state.draft.value;
  return [
    state.sectionOn.value,
    state.sectionAt.value,
    state.labelsOn.value,
    state.picking.value,
    state.outline.value,
    draft?.kind === 'clip' ? draft : null,
    draft?.kind === 'clip' ? state.previewed.value : null,
  ];
}

/** Whether two lists are the same, item by item. */
export function sameInputs(a: unknown[], b: unknown[]): boolean {
  return a.length === b.length && a.every((item, k) => item === b[k]);
}
