// The flow through the open valve that the user gives: one that no valve has is refused, with its range.
import { useSignal } from '@preact/signals';
import { measureCost } from '../store/measure';
import * as state from '../store/state';
import { tips, valveTexts } from '../text/texts';
import { flowRange, isFlow } from '../units';

/** The flow whose gradient is shown. `known`: the opening is. */
export function Flow({ known }: { known: boolean }) {
  const refused = useSignal('');
  const take = (text: string) => {
    const given = parseFloat(text);
    const fits = isFlow(given);
    refused.value = fits || Number.isNaN(given) ? '' : valveTexts.flowOutside(given, ...flowRange);
    state.flow.value = fits ? given : null;
    state.changed.value = true;
    if (fits && !known) void measureCost();
  };
  return (
    <div class="field">
      <label for="flow">{valveTexts.flow}</label>
      <div class="number">
        <input
          id="flow"
          title={tips[valveTexts.flow]}
          type="number"
          inputMode="decimal"
          min={flowRange[0]}
          max={flowRange[1]}
          step="any"
          value={state.flow.value ?? ''}
          onChange={(event) => take(event.currentTarget.value)}
        />
        <span class="unit">{valveTexts.flowUnit}</span>
      </div>
      {refused.value && (
        <small class="warn" role="alert">
          {refused.value}
        </small>
      )}
      <small>{valveTexts.flowHint(...flowRange)}</small>
    </div>
  );
}
