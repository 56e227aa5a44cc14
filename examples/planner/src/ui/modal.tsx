// A dialog over the page: it has the focus, Escape closes it, and the focus goes back to where it was.
import type { ComponentChildren } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
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
}) {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    const from = document.activeElement;
    dialog.current?.showModal();
    return () => {
      if (from instanceof HTMLElement && from.isConnected) from.focus();
    };
  }, []);
  const close = props.onClose ?? (() => void (state.dialog.value = null));
  return (
    <dialog
      ref={dialog}
      class={props.wide ? 'wide' : ''}
      aria-label={props.title}
      onClose={close}
      onCancel={close}
    >
      <div class="form-head">
        <h2>{props.title}</h2>
        <Button kind="quiet" title={props.closeTip} onClick={close}>
          {props.close ?? appTexts.close}
        </Button>
      </div>
      {props.children}
    </dialog>
  );
}
