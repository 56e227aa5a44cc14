// In the form of an operation that narrows the valve: how far it would open, beside the valve before and the goal.
import { narrowing, openingOf } from '../store/opening';
import { leastOpening } from '../store/tour';
import * as state from '../store/state';
import { openingTexts } from '../text/texts';

/** mm2 below which an open mitral valve is a severe stenosis (guidelines of echocardiography). */
const narrow = 150;

/** Operations that make the annulus smaller. */
const ofAnnulus = new Set(['ring', 'band']);

export function Opening({ kind }: { kind: string }) {
  const preview = state.preview.value?.figures;
  if (!narrowing.has(kind) || !preview) return null;
  const now = openingOf(preview.hash);
  const before = openingOf(state.main.value?.figures.hash);
  const least = leastOpening();
  // as it is printed, to 0.01 cm2: "1.50" is not below 1.5
  const area = now ? Math.round(now.openArea) : Infinity;
  const small = area < (least ?? narrow);
  // the annulus became smaller and the opening did not
  const elsewhere = ofAnnulus.has(kind) && now && before && now.openArea >= before.openArea;
  return (
    <p class={`opens${small ? ' warn' : ''}`} data-testid="opening" title={openingTexts.help}>
      {openingTexts.opens(now?.openArea)}
      <span class="was"> {openingTexts.beside(before?.openArea, least)}</span>
      {area < narrow && <small>{openingTexts.narrow}</small>}
      {elsewhere && <small>{openingTexts.elsewhere}</small>}
    </p>
  );
}
