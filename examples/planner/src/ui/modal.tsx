// A dialog over the page: it has the focus, Escape closes it, and the focus goes back to where it was.
import type { ComponentChildren } from 'preact';
import { useLayoutEffect, useRef } from 'preact/hooks';
import * as state from '../store/state';
import { appTexts } from '../text/texts';
import { Button } from './parts';

export function Modal(props: {
  title: string;
  wide?: boolean;
  children: ComponentChildren;
  onClose?: () => void;
  /** Words of the button that closes it, and its tooltip. */
  close?: string;
  closeTip?: string;
  /** It is read from the top: the focus begins at its title, which has no tooltip over the text. */
  reading?: boolean;
}) {
  const dialog = useRef<HTMLDialogElement>(null);
  const gone = useRef(false);
  // before the next key: Escape would miss a dialog that opens after a paint
  useLayoutEffect(() => {
    const element = dialog.current;
    element?.showModal();
    return () => {
      gone.current = true;
      // gives the focus back, which the removal of an open dialog does not
      element?.close();
    };
  }, []);
  const close = () => {
    // the event of closing comes after the dialog has left, when another one may be open
    if (gone.current) return;
    if (props.onClose) props.onClose();
    else state.dialog.value = null;
  };
  return (
    <dialog
      ref={dialog}
      class={props.wide ? 'wide' : ''}
      aria-label={props.title}
      onClose={close}
      onCancel={close}
    >
      <div class="form-head">
        <h2 tabIndex={props.reading ? -1 : undefined} autofocus={props.reading}>
          {props.title}
        </h2>
        <Button kind="quiet" title={props.closeTip} onClick={close}>
          {props.close ?? appTexts.close}
        </Button>
      </div>
      {props.children}
    </dialog>
  );
}
