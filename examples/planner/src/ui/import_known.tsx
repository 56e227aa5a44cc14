// What is known beside an imported surface: the closed leaflets, in a file of their own, and the thickness of the tissue.
import { useSignal } from '@preact/signals';
import { FolderOpen, X } from 'lucide-preact';
import { useRef } from 'preact/hooks';
import { takeClosed } from '../store/closed_leaflets';
import * as state from '../store/state';
import { importTexts, tips } from '../text/texts';
import { isThickness, thicknessRange, usualThickness } from '../units';
import { DecimalBox } from './decimal';
import { Button } from './parts';

function ClosedLeaflets({ imported }: { imported: state.Imported }) {
  const input = useRef<HTMLInputElement>(null);
  const { closed } = imported;
  return (
    <div class="field">
      <div class="row points">
        <Button
          icon={<FolderOpen size={16} />}
          title={tips[importTexts.closed]}
          onClick={() => input.current?.click()}
        >
          {importTexts.closed}
        </Button>
        <span class="hint">{closed ? closed.name : importTexts.notGiven}</span>
        <Button
          kind="quiet"
          icon={<X size={16} />}
          label={importTexts.forgetClosed}
          title={importTexts.forgetClosedTip}
          disabled={!closed}
          onClick={() => (state.imported.value = { ...imported, closed: null })}
        />
      </div>
      <input
        id="closed-file"
        ref={input}
        type="file"
        accept=".stl,.ply,.obj,.off,.vtp,.vtk"
        hidden
        onChange={({ currentTarget }) => {
          const file = currentTarget.files?.[0];
          // the same file can be chosen again
          currentTarget.value = '';
          if (file) void takeClosed(file);
        }}
      />
      <small>{importTexts.closedHint}</small>
    </div>
  );
}

function Thickness({ imported }: { imported: state.Imported }) {
  const refused = useSignal('');
  const take = (given: number | undefined) => {
    const fits = given !== undefined && isThickness(given);
    refused.value = fits || given === undefined ? '' : importTexts.thicknessOutside(given, ...thicknessRange);
    state.imported.value = { ...imported, thickness: fits ? given : null };
  };
  return (
    <div class="field">
      <label for="thickness">{importTexts.thickness}</label>
      <div class="number">
        <DecimalBox
          id="thickness"
          title={tips[importTexts.thickness]}
          range={thicknessRange}
          step={0.1}
          placeholder={String(usualThickness)}
          text={String(imported.thickness ?? '')}
          onTake={take}
          onRefuse={(sentence) => (refused.value = sentence)}
        />
        <span class="unit">mm</span>
      </div>
      {refused.value && (
        <small class="warn" role="alert">
          {refused.value}
        </small>
      )}
    </div>
  );
}

/** Both of them. The library measures the thickness of a surface that has two sides. */
export function Known({ imported }: { imported: state.Imported }) {
  return (
    <>
      <ClosedLeaflets imported={imported} />
      {imported.kind !== 'skin' && <Thickness imported={imported} />}
    </>
  );
}
