// Starts the page: the worker with the library, then the shipped valve.
import { render } from 'preact';
import { App } from './ui/app';
import { openShipped } from './store/files';
import { connect, fail, request } from './store/requests';
import { findCopy, keepCopy, visited, writeKeptFile } from './store/keep';
import * as state from './store/state';
import { watchOpening } from './store/opening';
import { watchTour } from './store/tour';
import { barTexts } from './text/texts';
import './style.css';

async function start(): Promise<void> {
  const library = document.getElementById('library')?.textContent ?? '';
  connect();
  if (visited()) state.panel.value = 'valve';
  render(<App />, document.getElementById('app')!);
  try {
    const { version, operations } = await request('start', { library });
    state.version.value = version;
    state.operations.value = operations;
    document.getElementById('library')?.remove();
    await openShipped('healthy', barTexts.healthy);
    state.ready.value = true;
  } catch (error) {
    fail(error);
  }
  watchTour();
  watchOpening();
  await findCopy();
  // the copy and the chosen file follow every change of the plan
  let kept = state.main.value;
  state.main.subscribe((now) => {
    if (now && now !== kept) void keepCopy().then(writeKeptFile);
    kept = now;
  });
}

window.addEventListener('beforeunload', (event) => {
  if (state.changed.value) event.preventDefault();
});

void start();
