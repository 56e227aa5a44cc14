// Checkpoints of the plan: kept under a name, renamed, deleted and put back, returned to, compared with the present plan.
import { useSignal, type Signal } from '@preact/signals';
import { useLayoutEffect, useRef } from 'preact/hooks';
import { Bookmark, Pencil, Trash2 } from 'lucide-preact';
import {
  compareCheckpoint,
  nextName,
  putBackCheckpoint,
  removeCheckpoint,
  renameCheckpoint,
  restoreCheckpoint,
  saveCheckpoint,
} from '../store/measure';
import * as state from '../store/state';
import { planTexts, tips, tipTexts } from '../text/texts';
import { Button, Section } from './parts';

/** Characters of a name: what one line of the panel holds. */
const longest = 40;

export function Checkpoints() {
  const name = useSignal('');
  const renamed = useSignal<string | null>(null);
  return (
    <Section title={planTexts.checkpoints} open>
      <form
        class="row"
        onSubmit={(event) => {
          event.preventDefault();
          void saveCheckpoint(name.value.trim() || nextName());
          name.value = '';
        }}
      >
        <input
          type="text"
          id="checkpoint-name"
          class="checkpoint-name"
          maxLength={longest}
          aria-label={planTexts.checkpointName}
          title={tips[planTexts.checkpointName]}
          placeholder={nextName()}
          value={name.value}
          onInput={(event) => (name.value = event.currentTarget.value)}
        />
        <button type="submit" class="button plain" title={tips[planTexts.keep]}>
          <Bookmark size={16} />
          <span>{planTexts.keep}</span>
        </button>
      </form>
      {state.checkpoints.value.map((checkpoint) => (
        <div class="row checkpoint" key={checkpoint}>
          {renamed.value === checkpoint ? (
            <NewName name={checkpoint} renamed={renamed} />
          ) : (
            <span>{checkpoint}</span>
          )}
          <Button onClick={() => void restoreCheckpoint(checkpoint)}>{planTexts.returnTo}</Button>
          <Button
            pressed={state.compareWith.value === checkpoint}
            onClick={() => void compareCheckpoint(state.compareWith.value === checkpoint ? null : checkpoint)}
          >
            {planTexts.compare}
          </Button>
          <Button
            icon={<Pencil size={16} />}
            label={planTexts.rename(checkpoint)}
            title={tipTexts.rename}
            onClick={() => (renamed.value = checkpoint)}
          />
          <Button
            icon={<Trash2 size={16} />}
            label={planTexts.remove(checkpoint)}
            title={tipTexts.remove}
            onClick={() => void removeCheckpoint(checkpoint)}
          />
        </div>
      ))}
      <Removed />
    </Section>
  );
}

/** The way back for the checkpoint that was deleted or replaced last. The keyboard is at it once its button “Delete” is gone. */
function Removed() {
  const name = state.removedCheckpoint.value;
  const row = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    if (document.activeElement === document.body) row.current?.querySelector('button')?.focus();
  }, [name, state.checkpoints.value]);
  if (name === null) return null;
  const replaced = state.checkpoints.value.includes(name);
  return (
    <div class="row" ref={row} data-testid="removed-checkpoint">
      <span>{replaced ? planTexts.replaced(name) : planTexts.removed(name)}</span>
      <Button
        onClick={() => {
          document.getElementById('checkpoint-name')?.focus();
          void putBackCheckpoint();
        }}
      >
        {planTexts.putBack}
      </Button>
    </div>
  );
}

/** The field in which a checkpoint gets another name: Enter or leaving the field takes it, Escape does not. */
function NewName({ name, renamed }: { name: string; renamed: Signal<string | null> }) {
  const field = useRef<HTMLInputElement>(null);
  // before the next key, which would be a shortcut of the page
  useLayoutEffect(() => field.current?.select(), []);
  const take = () => {
    if (renamed.value !== name) return;
    renamed.value = null;
    void renameCheckpoint(name, field.current!.value.trim());
  };
  return (
    <input
      ref={field}
      type="text"
      class="checkpoint-name renamed"
      maxLength={longest}
      aria-label={planTexts.newName(name)}
      title={tipTexts.newName}
      value={name}
      onBlur={take}
      onKeyDown={(event) => {
        if (event.key === 'Enter') take();
        else if (event.key === 'Escape') renamed.value = null;
        else return;
        event.stopPropagation();
      }}
    />
  );
}
