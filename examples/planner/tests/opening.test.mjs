// How far a valve opens is kept for the valve that was measured, also where another operation was quicker; it is explained beside
// its figure, which covers no field; a report has it of every kept plan.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { closed, sharePlanner } from './fixtures/browser.mjs';
import { answered, apply, begin, openPanel, undo } from './fixtures/person.mjs';

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

  it('says_why_a_clip_leaves_little_of_it_above_the_buttons_and_below_the_fields', async () => {
    await page.keyboard.press('Escape');
    await page.keyboard.press('Escape');
    await closed(page);
    await begin(page, 'clip');
    const opening = page.getByTestId('opening');
    await opening.getByText(/without it \d/).waitFor();
    const boxes = async (selector) => [
      await page.locator(selector).boundingBox(),
      await page.locator('.form-foot').boundingBox(),
    ];
    const seen = async (selector, when) => {
      const [field, foot] = await boxes(selector);
      const { y } = await page.locator('.panel').boundingBox();
      assert.ok(
        field.y >= y && field.y + field.height <= foot.y,
        `${selector} ${when}: ${field.y} to ${field.y + field.height}, foot at ${foot.y}, panel at ${y}`,
      );
    };
    await seen('.form .field >> nth=0', 'as the form opens');
    // the foot grows over the field that has the focus
    await page.locator('#f-angle').click();
    await opening.locator('summary').evaluate((one) => one.click());
    await opening.getByText(/holds both leaflets together/).waitFor();
    assert.match(await opening.innerText(), /both openings together[^]*“Without it” is the present valve/);
    await page.waitForTimeout(200);
    await seen('#f-angle', 'with the answer');
    await opening.locator('summary').click();
    await page.keyboard.press('Escape');
    await page.keyboard.press('Escape');
    await closed(page);
  });

  it('is_in_the_report_for_every_kept_plan', async () => {
    const keep = async () => {
      await openPanel(page, 'Plan');
      await page.getByRole('button', { name: 'Keep this plan' }).click();
      await answered(page, 200);
    };
    for (const size of ['30', '28']) {
      await begin(page, 'ring');
      await page.locator('#f-size').fill(size);
      await page.keyboard.press('Tab');
      await answered(page, 200);
      await apply(page);
      await keep();
      await undo(page);
    }
    // as after a session that was opened: nothing is measured yet
    await page.evaluate(() => {
      const { state } = window.planner;
      state.openings.value = new Map();
      state.cost.value = null;
    });
    await openPanel(page, 'Plan');
    await page.getByRole('button', { name: 'Report' }).click();
    const rows = page.getByTestId('report').getByTestId('report-plans').locator('tr:has(td)');
    await page.getByTestId('measuring').waitFor();
    await page.getByTestId('measuring').waitFor({ state: 'detached' });
    const areas = (await rows.locator('td:last-child').allInnerTexts()).map((text) => text.trim());
    assert.equal(areas.length, 3);
    for (const area of areas) assert.match(area, /^\d\.\d\scm²( \*)?$/);
    // the smaller the ring, the less, by more than the one digit of the report says
    const [, large, small] = areas.map(parseFloat);
    assert.ok(small <= large, areas.join(', '));
    const [of30, of28] = await page.evaluate(() => {
      const { checkpointHashes, openings } = window.planner.state;
      return checkpointHashes.value.map((hash) => openings.value.get(hash).openArea);
    });
    assert.ok(of28 < of30, `${of28}, ${of30} mm2`);
    await page.keyboard.press('Escape');
  });

  it('opens_a_form_without_the_answers_of_the_form_before', async () => {
    const answers = page.locator('.why p');
    await begin(page, 'clip');
    await page
      .getByTestId('opening')
      .getByText(/Opens to \d/)
      .waitFor();
    await page.locator('.why summary').click();
    await answers.first().waitFor();
    await page.keyboard.press('Escape');
    await begin(page, 'ring');
    await page.locator('#f-size').fill('26');
    await page.keyboard.press('Tab');
    await answered(page, 300);
    await page.locator('.why summary').waitFor();
    assert.ok(!(await answers.first().isVisible()));
    await page.keyboard.press('Escape');
  });

  it('says_how_long_a_band_is_before_it_is_sewn_in', async () => {
    await begin(page, 'band');
    await page.locator('#f-factor').fill('84');
    await page.keyboard.press('Tab');
    await answered(page, 300);
    const words = await page.getByText(/In the preview: [\d.]+\smm along its curve/).innerText();
    await apply(page);
    await openPanel(page, 'Plan');
    const step = await page
      .getByText(/Sew in .*mm, 84\s% of the posterior annulus/)
      .first()
      .innerText();
    const [said, sewn] = [words, step].map((text) => +/([\d.]+)\smm/.exec(text)[1]);
    // both are rounded to 0.1 mm
    assert.ok(said > 40 && Math.abs(said - sewn) < 0.11, `${words} ${step}`);
    await undo(page);
  });
});
