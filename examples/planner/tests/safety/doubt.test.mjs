// Figures of a valve whose leaflets cross, and of one that did not come to rest, are no result: such a valve has no grade and no
// improvement, and its figures are marked wherever they stand. The report of a leaking valve is whole on paper.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { beforeEach, describe, it } from 'node:test';
import { closed, figures, sharePlanner } from '../fixtures/browser.mjs';
import { crossingValve, dilatedValve, withoutCommand } from '../fixtures/doubtful.mjs';
import { answered, apply, open, openPanel, startAfresh } from '../fixtures/person.mjs';

const flat = (text) => text.replace(/\s+/g, ' ').trim();

describe('planner figures that do not count', { skip: withoutCommand }, () => {
  let page;
  let context;
  sharePlanner((opened) => ({ page, context } = opened));
  beforeEach(() => startAfresh(page));

  const card = async () => flat(await page.getByTestId('verdict').innerText());
  const colour = () => page.getByTestId('verdict').getAttribute('class');
  const status = async () => flat(await page.getByTestId('status').innerText());
  const attempt = async (kind, fields) => {
    await page.evaluate(([name, given]) => window.planner.edit(name, given), [kind, fields]);
    await answered(page, 200);
  };
  const report = async () => {
    await openPanel(page, 'Plan');
    await page.getByRole('button', { name: 'Report' }).click();
    const dialog = page.locator('dialog [data-testid=report]');
    await dialog.locator('tr', { hasText: /Open area in diastole.*cm².*cm²/s }).waitFor();
    return dialog;
  };
  /** The cells of a row of a table, without the heading. */
  const cells = async (table, name) =>
    (await table.locator('tr', { hasText: name }).first().locator('td').allInnerTexts()).map(flat);

  it('of_leaflets_that_cross_are_called_wrong', async () => {
    await open(page, crossingValve());
    await closed(page);
    const { measures } = await figures(page);
    assert.ok(measures.atRest && measures.orifice === 0 && measures.crossings > 0, JSON.stringify(measures));
    assert.match(await card(), /^Leaflets cross .*\d+ pairs of triangles.* wrong/);
    assert.doesNotMatch(await card(), /Sealed|mm² leak/);
    assert.doesNotMatch(await colour(), /level-\d|level-but/);
    assert.match(await status(), /Leaflets cross: its figures do not count\.$/);
    await openPanel(page, 'Valve');
    assert.match(await page.locator('.panel .figure').first().innerText(), /†/);
    await page.getByTestId('doubt-note').first().getByText('not valid').waitFor();
    // no goal of the tour is reached by it
    const sealed = await page.evaluate(() => {
      const { state } = window.planner;
      state.tour.value = { number: 1, founding: null };
      state.panel.value = 'tour';
      return new Promise((resolve) =>
        setTimeout(() => resolve(document.querySelector('[data-testid=goals] li').className), 100),
      );
    });
    assert.equal(sealed, 'missed');
    await page.evaluate(() => (window.planner.state.tour.value = null));
  });

  it('of_a_valve_not_at_rest_are_marked_as_not_final', async () => {
    await open(page, dilatedValve());
    await closed(page);
    // a leak is said with its pressure
    assert.match(await card(), /^Severe leak .* mm² leak at 120 mmHg/);
    await attempt('ring', { size: 40 });
    await apply(page);
    await attempt('clip', { width: 6 });
    assert.match(await card(), /^Not at rest preview .*† .*did not come to rest \(forces of up to [\d.]+ mN/);
    await apply(page);
    assert.equal((await figures(page)).measures.atRest, false);
    assert.doesNotMatch(await card(), /was 86/);
    assert.match(await status(), /Not at rest: its figures are not final\.$/);
    await openPanel(page, 'Valve');
    for (const figure of await page.locator('.panel .figure-value').allInnerTexts())
      if (figure.trim()) assert.match(figure, /†/);
    assert.equal(await page.locator('.panel .better').count(), 0);
    const said = await report();
    assert.match(
      flat(await said.innerText()),
      /After Not at rest: its figures are not final The valve did not/,
    );
    for (const name of ['Leak', 'Coaptation length', 'Chordae beyond', 'Open area']) {
      const [before, after] = await cells(said, name);
      assert.match(after, /†$/, name);
      assert.doesNotMatch(before, /†/, name);
    }
    assert.match(await said.innerText(), /† not final: this valve did not come to rest/);
    // wider than in life, for want of a wall
    assert.match((await cells(said, 'Open area'))[0], /\*$/);
    assert.match(flat(await said.innerText()), /\* More than the 4 to 6 cm² of healthy adults/);
    await page.keyboard.press('Escape');
  });

  it('prints_the_pictures_whole_and_the_section_in_a_size_to_read', async () => {
    await report();
    const [download] = await Promise.all([
      page.waitForEvent('download'),
      page.getByRole('button', { name: 'Save as HTML' }).click(),
    ]);
    await page.keyboard.press('Escape');
    const paper = await context.newPage();
    await paper.setContent(readFileSync(await download.path(), 'utf8'));
    for (const width of [718, 900, 1280]) {
      await paper.setViewportSize({ width, height: 900 });
      const [wide, plot] = await paper.evaluate(() => [
        document.documentElement.scrollWidth,
        document.querySelector('svg.cut').getBoundingClientRect().width,
      ]);
      assert.ok(wide <= width, `${wide} px in a window of ${width}`);
      assert.ok(plot >= 280, `the plot is ${plot} px wide in ${width}`);
    }
    await paper.emulateMedia({ media: 'print' });
    const fits = await paper.evaluate(() =>
      [...document.images].map((image) => getComputedStyle(image).objectFit),
    );
    assert.deepEqual([...new Set(fits)], ['contain']);
    await paper.close();
  });

  it('are_marked_beside_another_plan_and_among_kept_plans', async () => {
    await openPanel(page, 'Plan');
    await page.getByRole('button', { name: 'Keep this plan' }).click();
    await answered(page);
    await page.keyboard.press('Control+z');
    await answered(page, 200);
    await page.getByRole('button', { name: 'Compare' }).click();
    const table = page.getByTestId('compare');
    await table.waitFor();
    assert.match((await cells(table, 'Leak'))[0], /†$/);
    assert.doesNotMatch((await cells(table, 'Leak'))[1], /†/);
    assert.match((await cells(table, 'Verdict'))[0], /^Not at rest: its figures are not final$/);
    const said = await report();
    const plans = said.getByTestId('report-plans');
    const row = plans.locator('tr', { hasText: 'Plan 1' }).locator('td');
    assert.match((await row.allInnerTexts())[1], /†$/);
    await page.keyboard.press('Escape');
  });
});
