// What an impatient or careless hand must not do: apply an operation that nobody asked for.
import assert from 'node:assert/strict';
import { beforeEach, describe, it } from 'node:test';
import { figures, sharePlanner } from '../fixtures/browser.mjs';
import { answered, begin, startAfresh, undo } from '../fixtures/person.mjs';

describe('planner under a careless hand', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));
  beforeEach(() => startAfresh(page));

  const done = async () => (await figures(page)).history.filter((entry) => !entry.undone).length;
  /** Presses Apply `times` times at one place, each as a single click, as slow clicks are. */
  const pressApply = async (times, gap) => {
    const box = await page.getByRole('button', { name: 'Apply', exact: true }).boundingBox();
    await page.mouse.move(box.x + 90, box.y + 20);
    for (let k = 0; k < times; ++k) {
      if (k) await page.waitForTimeout(gap);
      await page.mouse.down();
      await page.mouse.up();
    }
    await answered(page, 300);
  };

  for (const gap of [150, 300, 500])
    it(`applies_one_operation_by_three_clicks_${gap}_ms_apart`, async () => {
      const before = await done();
      await begin(page, 'annulus_scale');
      await pressApply(3, gap);
      assert.equal(await page.getByTestId('form').count(), 0, 'a card under the pointer took a click');
      assert.equal(await done(), before + 1);
      // one undo takes it back: no form is in its way
      await undo(page);
      assert.equal(await done(), before);
    });

  it('takes_a_press_at_the_same_place_once_the_pointer_has_moved_or_rested', async () => {
    const card = async () => {
      const box = await page.locator('[data-operation=chord_remove]').boundingBox();
      return { x: box.x + 40, y: box.y + box.height / 2 };
    };
    await begin(page, 'annulus_scale');
    await pressApply(1, 0);
    const place = await card();
    await page.mouse.move(place.x - 20, place.y);
    await page.mouse.move(place.x, place.y);
    await page.mouse.down();
    await page.mouse.up();
    assert.equal(await page.evaluate(() => window.planner.state.draft.value?.kind), 'chord_remove');
    await page.keyboard.press('Escape');
    await page.waitForTimeout(1100);
    await page.mouse.down();
    await page.mouse.up();
    assert.equal(await page.evaluate(() => window.planner.state.draft.value?.kind), 'chord_remove');
    await page.keyboard.press('Escape');
    await undo(page);
  });

  it('never_calls_leaflets_that_cross_sealed', async () => {
    const verdict = await page.evaluate(async () => {
      const { main } = window.planner.state;
      const [kept, { picture, figures: found }] = [main.value, main.value];
      main.value = { picture, figures: { ...found, measures: { ...found.measures, crossings: 3 } } };
      await new Promise((drawn) => setTimeout(drawn, 50));
      const card = document.querySelector('[data-testid=verdict]').innerText;
      main.value = kept;
      return card;
    });
    assert.match(verdict, /^Leaflets cross/);
    assert.doesNotMatch(verdict, /Sealed/);
  });

  it('takes_a_typed_decimal_comma_as_the_decimal_sign', async () => {
    await begin(page, 'ring');
    await page.locator('#f-size').focus();
    await page.keyboard.press('Control+a');
    await page.keyboard.type('32,5');
    await page.keyboard.press('Tab');
    assert.equal(await page.evaluate(() => window.planner.state.draft.value.fields.size), 32.5);
    await page.keyboard.press('Escape');
  });
});
