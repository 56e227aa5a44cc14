// What a form refuses, and how it says so: numbers out of their range in the units of the page and in sight, points of a cut on another
// leaflet; a form does not begin with what would be refused.
import assert from 'node:assert/strict';
import { beforeEach, describe, it } from 'node:test';
import { closed, figures, sharePlanner, withPlanner } from '../fixtures/browser.mjs';
import { answered, begin, fillIn, startAfresh } from '../fixtures/person.mjs';

const flat = (text) => text.replace(/\s+/g, ' ').trim();

/** Whether an element is wholly within the window. */
async function isInSight(page, element) {
  const { x, y, width, height } = await element.boundingBox();
  const size = page.viewportSize();
  return x >= 0 && y >= 0 && x + width <= size.width && y + height <= size.height;
}

describe('planner forms that refuse', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));
  beforeEach(() => startAfresh(page));

  const message = () => page.getByTestId('form').getByRole('alert');
  const status = () => page.getByTestId('status').innerText();

  it('name_the_range_of_a_number_in_its_unit_beside_apply', async () => {
    const { id } = (await figures(page)).chords.find(({ name }) => /^A2/.test(name));
    await begin(page, 'chord_length');
    await page.locator('#f-chord').selectOption(id);
    await answered(page, 200);
    await fillIn(page, 'length', -3);
    const words = 'Rest length, without pull: −3 mm is out of range; it has to be 0.1 to 200 mm.';
    assert.equal(flat(await message().innerText()), words);
    assert.equal(await status(), words);
    assert.ok(await isInSight(page, message()));
    assert.doesNotMatch(await page.getByTestId('form').innerText(), /shorter by|beyond the slider/);
    assert.ok(await page.getByRole('button', { name: 'Apply', exact: true }).isDisabled());
    // a number in its range is tried again
    await fillIn(page, 'length', 15);
    assert.equal(await message().count(), 0);
    // 0 is no empty field
    await fillIn(page, 'length', 0);
    assert.match(await message().innerText(), /: 0 mm is out of range/);
    await page.getByRole('button', { name: 'Discard' }).click();
    await answered(page);
    assert.equal(await status(), '');
    await begin(page, 'annulus_scale');
    await fillIn(page, 'factor', 5);
    assert.match(
      await message().innerText(),
      /^Overall size: 5 % is out of range; it has to be 10 to 300 %\./,
    );
    await page.keyboard.press('Escape');
  });

  it('begin_with_a_patch_that_fits_on_every_scallop', async () => {
    await begin(page, 'patch');
    const names = await page.evaluate(() =>
      window.planner.state.topologyOf(window.planner.state.main.value.picture).scallops.map((p) => p.name),
    );
    for (const name of names.filter((one) => /^[AP]\d$/.test(one))) {
      await page.locator('#f-site').selectOption({ label: name });
      await answered(page, 150);
      assert.equal(await message().count(), 0, name);
      assert.ok(await page.evaluate(() => !!window.planner.state.preview.value), name);
    }
    await fillIn(page, 'width', 60);
    assert.equal(flat(await message().innerText()), 'Width: 60 mm is out of range; it has to be 2 to 50 mm.');
    await page.keyboard.press('Escape');
  });

  it('name_the_leaflet_of_a_drawn_cut_and_refuse_points_on_the_other_one', async () => {
    await begin(page, 'resect');
    await page.getByRole('button', { name: 'Draw the cut' }).click();
    const outline = page.getByTestId('outline');
    const clickAt = async (x, y) => {
      await page.mouse.click(x, y);
      await page.waitForTimeout(80);
    };
    const length = () => page.evaluate(() => window.planner.state.outline.value.length);
    // on P2, on A2, and on P2 again, in the surgeon's view of a window of 1280 x 720
    await clickAt(425, 505);
    await outline.getByText('The cut is in the posterior leaflet, P2.').waitFor();
    await clickAt(467, 300);
    const refusal = outline.getByRole('alert');
    assert.match(
      flat(await refusal.innerText()),
      /^That click was on A2: no point was set\. The cut is in the posterior/,
    );
    assert.equal(await length(), 1);
    for (const [x, y] of [
      [440, 550],
      [495, 550],
      [510, 505],
    ])
      await clickAt(x, y);
    assert.equal(await refusal.count(), 0);
    assert.equal(await length(), 4);
    await page.getByRole('button', { name: 'Use this cut' }).click();
    await closed(page);
    const cut = page.getByTestId('outlined');
    assert.equal(await cut.innerText(), 'The cut as drawn is in the posterior leaflet, P2.');
    await page.keyboard.press('Escape');
  });
});

it('planner shows a refusal in a small window too', async () => {
  await withPlanner({ width: 1000, height: 500 }, async ({ page }) => {
    await begin(page, 'annulus_scale');
    await fillIn(page, 'factor', 5);
    assert.ok(await isInSight(page, page.getByTestId('form').getByRole('alert')));
  });
});

it('scrolls_the_form_by_the_wheel_over_a_number_and_changes_no_length', async () => {
  await withPlanner({ width: 1000, height: 520 }, async ({ page }) => {
    const { id, rest } = (await figures(page)).chords[0];
    await page.evaluate(
      ([chord, length]) => window.planner.edit('chord_length', { chord, length }),
      [id, rest],
    );
    await answered(page, 200);
    const box = page.locator('#f-length');
    await box.focus();
    const before = await box.inputValue();
    const { x, y, width, height } = await box.boundingBox();
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.wheel(0, 60);
    await answered(page, 900);
    assert.equal(await box.inputValue(), before);
    assert.equal(await page.evaluate(() => window.planner.state.draft.value.fields.length), rest);
    assert.ok((await box.boundingBox()).y < y, 'the form does not scroll');
  });
});
