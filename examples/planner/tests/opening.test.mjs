// How far a valve opens is kept for the valve that was measured, also where another operation was quicker.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { closed, sharePlanner } from './fixtures/browser.mjs';
import { apply, begin, undo } from './fixtures/person.mjs';

/** Holds questions for the opening of the applied valve back until `window.letGo` is called, as a slow worker would. */
function holdQuestions() {
  const { postMessage } = Worker.prototype;
  const held = [];
  window.heldQuestions = () => held.length;
  window.letGo = () => {
    Worker.prototype.postMessage = postMessage;
    for (const send of held) send();
  };
  Worker.prototype.postMessage = function (message, ...rest) {
    if (message.call === 'cost' && message.argument.which === 'main')
      held.push(() => postMessage.call(this, message, ...rest));
    else postMessage.call(this, message, ...rest);
  };
}

/** Waits until a condition of the page holds: its policy forbids `waitForFunction`. */
async function until(page, condition, argument) {
  while (!(await page.evaluate(condition, argument))) await page.waitForTimeout(50);
}

describe('planner opening', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened), {
    prepare: (context) => context.addInitScript(holdQuestions),
  });

  it('is_kept_for_the_valve_that_was_measured', async () => {
    const hash = () => page.evaluate(() => window.planner.state.main.value.figures.hash);
    const openingOf = (valve) =>
      page.evaluate((valve) => window.planner.state.openings.value.get(valve)?.openArea ?? null, valve);
    const before = await hash();
    await begin(page, 'clip');
    // the preview is measured first, then the valve before it: that question is on its way when the clip is applied
    await until(page, () => window.heldQuestions() > 0);
    await apply(page);
    await closed(page);
    const after = await hash();
    assert.notEqual(after, before);
    await page.evaluate(() => window.letGo());
    await until(page, (valve) => window.planner.state.openings.value.has(valve), after);
    const clipped = await openingOf(after);
    assert.notEqual(await openingOf(before), clipped, 'the clip does not narrow the valve before it');
    // the valve before opens wider, measured again when it is asked for
    await undo(page);
    await closed(page);
    await begin(page, 'clip');
    await until(page, (valve) => window.planner.state.openings.value.has(valve), before);
    assert.ok((await openingOf(before)) > 1.5 * clipped, 'two orifices of a clip are far smaller than one');
  });
});
