// Wishes of a surgeon who tried every panel: a typed number that is tried by itself, the field that a form is for, the
// open areas of two plans, a clip that is seen from the atrium, a report that prints on one page.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { describe, it } from 'node:test';
import { pathToFileURL } from 'node:url';
import { closed, figures, sharePlanner } from './fixtures/browser.mjs';
import { answered, apply, begin, openPanel, startAfresh, undo } from './fixtures/person.mjs';

describe('planner as a customer judges it', () => {
  let page;
  let context;
  sharePlanner((opened) => ({ page, context } = opened));

  it('tries_a_typed_number_without_enter', async () => {
    await begin(page, 'ring');
    const { hash } = await figures(page);
    const size = page.locator('#f-size');
    await size.fill('');
    await size.pressSequentially('30');
    await page.waitForTimeout(900);
    await closed(page);
    assert.notEqual((await figures(page)).hash, hash);
    assert.equal(await page.getByTestId('form').locator('input[type=range]').first().inputValue(), '30');
    await page.keyboard.press('Escape');
  });

  it('shows_the_length_of_an_overloaded_chord_without_scrolling', async () => {
    await startAfresh(page);
    await page.evaluate(() => {
      const { state } = window.planner;
      const chord = state.main.value.figures.chords.find(({ name }) => name === 'A2/29');
      state.choice.value = { kind: 'chord', id: chord.id };
    });
    await begin(page, 'chord_length');
    await page.locator('#f-length').fill('10');
    await page.keyboard.press('Enter');
    await answered(page, 100);
    assert.ok((await figures(page)).measures.chordLoad > 1);
    const isSeen = async () => {
      // a field that is filled is scrolled to: at the top, as the form begins
      await page.locator('.panel').evaluate((panel) => panel.scrollTo(0, 0));
      const [box, foot] = [
        await page.locator('#f-length').boundingBox(),
        await page.locator('.form-foot').boundingBox(),
      ];
      assert.ok(
        box.y + box.height <= foot.y,
        `length ends at ${box.y + box.height}, the foot begins at ${foot.y}`,
      );
    };
    await isSeen();
    await apply(page);
    await begin(page, 'chord_length');
    await isSeen();
    await page.keyboard.press('Escape');
    await undo(page);
  });

  it('compares_open_areas_and_pictures_of_two_plans', async () => {
    await startAfresh(page);
    const without = (await figures(page)).hash;
    await openPanel(page, 'Plan');
    await page.getByLabel('Name of the plan').fill('Untouched');
    await page.getByRole('button', { name: 'Keep this plan' }).click();
    await answered(page);
    await begin(page, 'clip');
    await apply(page);
    await openPanel(page, 'Plan');
    await page.getByRole('button', { name: 'Compare' }).click();
    const row = page.getByTestId('compare').getByRole('row', { name: /Open area/ });
    // a press of Compare shows its table, also where the panel is longer than the window
    const seen = () =>
      page.getByTestId('compare').evaluate((table) => {
        const [head, last] = [table.rows[0], table.rows[4]].map((one) => one.getBoundingClientRect());
        return head.top >= 0 && last.bottom <= innerHeight;
      });
    for (let k = 0; k < 40 && !(await seen()); ++k) await page.waitForTimeout(50);
    assert.ok(await seen(), 'the first rows of the table are out of the window');
    await row.getByText(/cm²/).nth(1).waitFor();
    const [other, now] = (await row.locator('td').allInnerTexts()).map(parseFloat);
    // a clip in the middle more than halves the opening
    assert.ok(now < 0.5 * other, `${other} and ${now} cm²`);
    await page.getByRole('button', { name: 'Untouched', exact: true }).click();
    assert.equal(await page.evaluate(() => window.planner.state.shown.value.figures.hash), without);
    assert.match(await page.getByTestId('verdict').innerText(), /Untouched/);
    await page.getByRole('button', { name: 'Present plan', exact: true }).click();
    await page.getByRole('button', { name: 'Compare' }).click();
  });

  it('shows_a_clip_through_the_leaflets_that_close_over_it', async () => {
    // the clip of the test before
    await startAfresh(page);
    await page.waitForTimeout(250);
    const blue = () =>
      page.evaluate(async () => {
        const { width, height } = window.planner.viewport;
        const { data } = await window.pixels([0.4 * width, 0.4 * height, 0.2 * width, 0.3 * height]);
        let count = 0;
        for (let i = 0; i < data.length; i += 4) count += data[i + 2] > data[i] + 5 ? 1 : 0;
        return count / (data.length / 4);
      });
    const share = await blue();
    const chordae = () => page.locator('summary', { hasText: /^Chordae \(/ }).innerText();
    await openPanel(page, 'Valve');
    const counted = await chordae();
    await undo(page);
    assert.equal(counted, await chordae(), 'stitches are no chordae');
    await page.waitForTimeout(250);
    const bare = await blue();
    assert.ok(share > bare + 0.005, `blue with the clip ${share}, without it ${bare}`);
  });

  it('prints_the_saved_report_on_one_page_and_kept_plans_on_another', async () => {
    await begin(page, 'band');
    await apply(page);
    await openPanel(page, 'Plan');
    await page.getByRole('button', { name: 'Report' }).click();
    await page.getByTestId('report').locator('svg').waitFor();
    await page.getByTestId('report').evaluate((report) => report.closest('dialog').scrollTo(0, 1e4));
    // its buttons' neighbour stays in sight
    const close = await page.getByRole('button', { name: 'Close' }).last().boundingBox();
    assert.ok(close.y >= 0 && close.y < 200, `Close at ${close.y}`);
    await page.getByTestId('report').evaluate((report) => report.closest('dialog').scrollTo(0, 0));
    const [download] = await Promise.all([
      page.waitForEvent('download'),
      page.getByRole('button', { name: 'Save as HTML' }).click(),
    ]);
    const path = `${await download.path()}.html`;
    writeFileSync(path, readFileSync(await download.path()));
    const paper = await context.newPage();
    await paper.goto(pathToFileURL(path).href);
    const pdf = String(await paper.pdf({ preferCSSPageSize: true, format: 'A4' }));
    await paper.close();
    // the plans that other tests have kept make a table
    const most = (await page.getByTestId('report').locator('.plans').count()) ? 2 : 1;
    assert.ok(pdf.match(/\/Type\s*\/Page\b/g).length <= most);
    await page.keyboard.press('Escape');
  });
});
