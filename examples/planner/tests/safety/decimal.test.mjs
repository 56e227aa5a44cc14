// Numbers mean what was typed: a decimal comma is a decimal sign, and what can be read in two ways is refused in a sentence. That the page is
// for research only stands in every window; a press of Enter on a card leads the keyboard into its form.
import assert from 'node:assert/strict';
import { beforeEach, describe, it } from 'node:test';
import { figures, sharePlanner } from '../fixtures/browser.mjs';
import { answered, becomes, begin, openPanel, startAfresh } from '../fixtures/person.mjs';

describe('planner numbers', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));
  beforeEach(() => startAfresh(page));

  const field = (name) => page.evaluate((key) => window.planner.state.draft.value?.fields[key], name);
  const type = async (box, text) => {
    await box.focus();
    await page.keyboard.press('Control+a');
    await page.keyboard.type(text);
    await page.keyboard.press('Tab');
    await answered(page, 100);
  };

  it('take_a_decimal_comma_as_the_decimal_sign', async () => {
    await begin(page, 'ring');
    const size = page.locator('#f-size');
    await type(size, '32,5');
    assert.equal(await field('size'), 32.5);
    assert.equal(await size.inputValue(), '32.5');
    await page.getByText('More', { exact: true }).click();
    await type(page.locator('#f-saddle'), '2,5');
    assert.equal(await field('saddle'), 2.5);
    await page.keyboard.press('Escape');
    await begin(page, 'neochord');
    await page.getByText('More', { exact: true }).click();
    await type(page.locator('#f-diameter'), '0,3');
    assert.equal(await field('diameter'), 0.3);
    await page.keyboard.press('Escape');
    await begin(page, 'resect');
    await type(page.locator('#f-width'), '7,5');
    assert.equal(await field('width'), 7.5);
    await page.keyboard.press('Escape');
  });

  it('refuse_what_is_no_number_and_keep_what_was_there', async () => {
    await begin(page, 'ring');
    const before = await field('size');
    const size = page.locator('#f-size');
    for (const text of ['3,4,5', '1.000,5', '1,000', 'abc']) {
      await type(size, text);
      const said = await page.getByTestId('form').getByRole('alert').innerText();
      assert.ok(said.startsWith(`“${text}” is no number here`), said);
      assert.equal(await field('size'), before);
      assert.equal(await size.inputValue(), String(before));
    }
    await type(size, '33');
    assert.equal(await page.getByTestId('form').getByRole('alert').count(), 0);
    assert.equal(await field('size'), 33);
    await page.keyboard.press('Escape');
  });

  it('step_by_the_arrow_keys_and_by_name', async () => {
    await begin(page, 'ring');
    const size = page.getByRole('spinbutton', { name: 'Size' });
    await type(size, '32');
    await size.focus();
    await page.keyboard.press('ArrowUp');
    await becomes(() => field('size'), 33);
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('ArrowDown');
    await becomes(() => field('size'), 31);
    await page.keyboard.press('Escape');
    await openPanel(page, 'Valve');
    await page.getByText('How far it opens').click();
    await type(page.locator('#flow'), '200,5');
    await becomes(() => page.evaluate(() => window.planner.state.flow.value), 200.5);
  });

  it('go_with_a_form_that_gets_the_keyboard_from_its_card', async () => {
    await openPanel(page, 'Repair');
    await page.locator('[data-operation=ring]').focus();
    await page.keyboard.press('Enter');
    await becomes(() => page.evaluate(() => document.activeElement.textContent.trim()), 'Ring');
    await page.keyboard.press('Escape');
    assert.equal((await figures(page)).history.length, 0);
  });

  it('stand_beside_the_words_that_they_are_for_research_only', async () => {
    for (const width of [1280, 1024, 1000, 960, 853, 640, 400, 320]) {
      await page.setViewportSize({ width, height: 720 });
      const seen = await page.evaluate(() => {
        const words = /Research simulator\. Not for decisions|Research only, not for treatment/;
        return [...document.querySelectorAll('.top small')].some((line) => {
          const box = line.getBoundingClientRect();
          const inside =
            box.width > 0 && box.left >= 0 && box.right <= innerWidth && box.bottom <= innerHeight;
          return (
            words.test(line.textContent) &&
            line.checkVisibility() &&
            inside &&
            line.scrollWidth <= line.clientWidth + 1
          );
        });
      });
      assert.ok(seen, `at ${width} px nothing says it`);
    }
    await page.setViewportSize({ width: 1280, height: 720 });
  });
});
