// Quick and careless hands: double clicks, undo pressed again and again, two files at once, a form in a narrow window.
import assert from 'node:assert/strict';
import { beforeEach, describe, it } from 'node:test';
import { closed, figures, sharePlanner, withPlanner } from '../fixtures/browser.mjs';
import { answered, apply, begin, focused, startAfresh, undo } from '../fixtures/person.mjs';

describe('planner in haste', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));
  beforeEach(() => startAfresh(page));

  const titles = async () =>
    (await figures(page)).history.filter((entry) => !entry.undone).map((entry) => entry.title);

  it('begins_no_operation_by_the_second_click_on_apply', async () => {
    const count = (await titles()).length;
    await begin(page, 'annulus_scale');
    await page.getByRole('button', { name: 'Apply', exact: true }).dblclick();
    await answered(page, 600);
    assert.equal(await page.getByTestId('form').count(), 0, 'a card of the list below took the second click');
    assert.equal((await titles()).length, count + 1);
    // the next click, at the same place, counts
    await page.waitForTimeout(600);
    await begin(page, 'annulus_scale');
    await page.keyboard.press('Escape');
    await undo(page);
  });

  it('takes_every_undo_and_redo_that_is_pressed_quickly', async () => {
    const first = await titles();
    const all = [];
    for (const kind of ['annulus_scale', 'band', 'clip']) {
      await begin(page, kind);
      await apply(page);
      all.push(await titles());
    }
    const press = async (...keys) => {
      await page.evaluate((list) => {
        // without time between them, as two hands and a slow valve make it
        for (const key of list)
          window.dispatchEvent(new KeyboardEvent('keydown', { key, ctrlKey: true, bubbles: true }));
      }, keys);
      await answered(page, 600);
    };
    // the keys go to an element of the page
    await page.evaluate(() => document.body.focus());
    await press('z', 'z', 'y');
    assert.deepEqual(await titles(), all[1]);
    await press('z', 'z', 'z', 'z', 'y', 'z', 'y');
    assert.deepEqual(await titles(), all[0]);
    await press('y', 'y', 'y', 'z');
    assert.deepEqual(await titles(), all[1]);
    await press('z', 'z', 'z');
    assert.deepEqual(await titles(), first);
  });

  it('says_which_of_two_dropped_files_was_taken', async () => {
    await page.evaluate(() => {
      const transfer = new DataTransfer();
      for (const name of ['one.mvsplan', 'two.stl']) transfer.items.add(new File(['no session'], name));
      document.body.dispatchEvent(
        new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }),
      );
    });
    await page.getByTestId('notice').getByText('One file at a time: one.mvsplan was taken').waitFor();
    assert.match(await page.getByTestId('notice').innerText(), /one\.mvsplan was not opened/);
  });
});

describe('planner in a narrow window', () => {
  it('shows_what_the_keyboard_goes_to_in_a_form', async () => {
    await withPlanner({ width: 400, height: 700 }, async ({ page }) => {
      await begin(page, 'ring');
      await page.getByTestId('form').getByText('More', { exact: true }).click();
      await closed(page);
      await page.locator('#tab-repair').focus();
      const seen = [];
      for (let k = 0; k < 8; ++k) {
        await page.keyboard.press('Tab');
        await page.waitForTimeout(50);
        const { name, covered } = await focused(page);
        assert.equal(covered, '', `${name} is covered`);
        seen.push(name);
      }
      assert.ok(new Set(seen).size > 5, seen.join(', '));
    });
  });

  it('shows_the_picture_in_which_the_keyboard_moves_the_cross', async () => {
    await withPlanner({ width: 400, height: 700 }, async ({ page }) => {
      await begin(page, 'neochord');
      await page.getByTestId('form').getByText('More', { exact: true }).scrollIntoViewIfNeeded();
      await page.locator('.canvas canvas').evaluate((canvas) => canvas.focus({ preventScroll: true }));
      await page.keyboard.press('ArrowRight');
      await page.waitForTimeout(100);
      const { y, height } = await page.locator('.cross').boundingBox();
      assert.ok(y > 0 && y + height < 700, `the cross is at ${y}`);
    });
  });
});
