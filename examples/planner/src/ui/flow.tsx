// The flow through the open valve that the user gives: one that no valve has is refused, with its range.
import { useSignal } from '@preact/signals';
import { measureCost } from '../store/measure';
import * as state from '../store/state';
import { tips, valveTexts } from '../text/texts';
import { flowRange, isFlow } from '../units';
import { DecimalBox } from './decimal';

/** The flow whose gradient is shown. `known`: the opening is. */
export function Flow({ known }: { known: boolean }) {
  const refused = useSignal('');
  const take = (given: number | undefined) => {
    const fits = given !== undefined && isFlow(given);
    refused.value = fits || given === undefined ? '' : valveTexts.flowOutside(given, ...flowRange);
    state.flow.value = fits ? given : null;
    state.changed.value = true;
    if (fits && !known) void measureCost();
  };
  return (
    <div class="field">
      <label for="flow">{valveTexts.flow}</label>
      <div class="number">
        <DecimalBox
          id="flow"
          title={tips[valveTexts.flow]}
          range={flowRange}
          step={10}
          text={String(state.flow.value ?? '')}
          onTake={take}
          onRefuse={(sentence) => (refused.value = sentence)}
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
