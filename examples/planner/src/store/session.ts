// Contents of a session beside the plan that the worker has.
import type { Calls } from '../calls';
import { leakRange } from './leak_range';
import * as state from './state';

export const sessionContents = (): Calls['save_session']['argument'] => ({
  title: state.title.value,
  notes: state.notes.value,
  leakRange: leakRange(),
  flow: state.flow.value,
  tour: state.tour.value?.number ?? null,
});
