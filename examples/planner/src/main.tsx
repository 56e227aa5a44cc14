// Starts the page: the picture of the open shipped valve, which the page brings along; the worker with the library, which
// closes it. Marks of performance measurements say when each was there.
import firstPicture from 'first-picture';
import { render } from 'preact';
import { App } from './ui/app';
import { openShipped } from './store/files';
import { connect, fail, request } from './store/requests';
import { keepFollowing, visited } from './store/keep';
import { leftValves } from './store/left';
import { findCopies } from './store/recovery';
import * as state from './store/state';
import { watchOpening } from './store/opening';
import { watchResult } from './store/result';
import { watchTour } from './store/tour';
import { barTexts, t } from './text/texts';
import { decode } from './shipped';
import './style.css';

/** Shows the open valve while the library is compiled. */
function showFirst(): void {
  const motion = decode(firstPicture);
  state.receive(motion.picture);
  state.motion.value = motion;
}

async function start(): Promise<void> {
  performance.mark('page script');
  const library = document.getElementById('library')?.textContent ?? '';
  connect();
  if (visited()) state.panel.value = 'valve';
  showFirst();
  const starting = { text: t.starting, share: 0 };
  state.busy.value = starting;
  render(<App />, document.getElementById('app')!);
  try {
    const { version, operations } = await request('start', { library });
    state.version.value = version;
    state.operations.value = operations;
    performance.mark('library ready');
    document.getElementById('library')?.remove();
    // unless another valve was asked for in the meantime
    if (state.busy.value === starting) await openShipped('healthy', barTexts.healthy);
    performance.mark('closed valve');
    state.ready.value = true;
  } catch (error) {
    state.busy.value = null;
    fail(error);
  }
  watchTour();
  watchOpening();
  watchResult();
  await findCopies();
  keepFollowing();
}

window.addEventListener('beforeunload', (event) => {
  const earlier = leftValves.value.some(({ changed }) => changed);
  if (state.changed.value || state.marked.value || earlier) event.preventDefault();
});

void start();
