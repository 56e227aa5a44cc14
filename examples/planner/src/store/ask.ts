// The question before a plan that is kept nowhere gives way to another one.
import { batch, signal } from '@preact/signals';
import * as state from './state';

interface Question {
  /** The plan that takes the place of the present one. */
  to: string;
  /** How the present plan can be kept: under a name beside the other one, or as a file. */
  keep: 'name' | 'file';
  answer: (replace: boolean) => void;
}

export const question = signal<Question | null>(null);

/** Asks whether the plan `to` may replace the present one; the dialog keeps the present plan first where the user wants it. */
export function mayReplace(to: string, keep: Question['keep']): Promise<boolean> {
  return new Promise((resolve) => {
    batch(() => {
      question.value = { to, keep, answer: resolve };
      state.dialog.value = 'ask';
    });
  });
}

/** Closes the question with an answer. */
export function answer(replace: boolean): void {
  const { value } = question;
  batch(() => {
    question.value = null;
    if (state.dialog.value === 'ask') state.dialog.value = null;
  });
  value?.answer(replace);
}
