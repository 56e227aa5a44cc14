// Files and valves that are opened: sessions with the valve before their plan, valves that are still closing, surfaces, wrong files.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { afterEach, describe, it } from 'node:test';
import { strFromU8, unzipSync } from 'fflate';
import { closed, figures, sharePlanner, temporaryFile } from './fixtures/browser.mjs';
import {
  answered,
  apply,
  begin,
  open,
  openLeaflets,
  openPanel,
  save,
  startAfresh,
} from './fixtures/person.mjs';

const verdict = (page) => page.getByTestId('verdict').innerText();
const healthy = (page) => page.getByRole('button', { name: 'Start from a healthy valve' }).click();

/** The hash that the worker writes into a session of its valve. */
async function savedHash(page) {
  return JSON.parse(strFromU8(unzipSync(readFileSync(await save(page)))['session.json'])).hash;
}

describe('what is opened', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));
  afterEach(async () => {
    await startAfresh(page);
    await healthy(page);
    await closed(page);
  });

  it('compares_an_opened_session_with_the_valve_before_its_plan', async () => {
    const before = (await figures(page)).hash;
    await begin(page, 'ring');
    await apply(page);
    const after = (await figures(page)).hash;
    const copy = temporaryFile('ring.mvsplan', readFileSync(await save(page)));
    await healthy(page);
    // the plan that is left is kept first, and a busy worker takes its time
    while ((await figures(page)).history.length) await page.waitForTimeout(50);
    await closed(page);
    await open(page, copy);
    assert.equal((await figures(page)).hash, after);
    const shown = () => page.evaluate(() => window.planner.state.shown.value.figures.hash);
    await page.getByRole('button', { name: 'Before', exact: true }).click();
    assert.equal(await shown(), before);
    await page.keyboard.press('w');
    assert.equal(await shown(), after);
    // the report, and the section in it, compare the same two valves
    await openPanel(page, 'Plan');
    await page.getByRole('button', { name: 'Report' }).click();
    const report = page.getByTestId('report');
    await report.locator('svg path[d^=M]').last().waitFor();
    const width = await report
      .getByRole('row', { name: /side to side/ })
      .locator('td')
      .allInnerTexts();
    assert.notEqual(width[0], width[1]);
    const curves = await report
      .locator('svg g path')
      .evaluateAll((paths) => paths.slice(-2).map((path) => path.getAttribute('d')));
    assert.notEqual(curves[0], curves[1]);
    await page.keyboard.press('Escape');
  });

  it('shows_no_figures_of_the_last_valve_while_another_one_closes', async () => {
    await openPanel(page, 'Learn');
    await page.evaluate(() => {
      const { state } = window.planner;
      window.said = [];
      const stop = state.motion.subscribe((motion) => {
        if (!motion) return;
        requestAnimationFrame(() => {
          if (state.motion.value)
            window.said.push([
              document.querySelector('[data-testid=verdict]').textContent,
              document.querySelectorAll('[data-testid=goals] .done').length,
            ]);
          stop();
        });
      });
    });
    await page.getByRole('button', { name: 'Valve 1', exact: true }).click();
    await answered(page, 300);
    assert.deepEqual(await page.evaluate(() => window.said), [['…', 0]]);
    assert.match(await verdict(page), /leak/);
  });

  it(
    'keeps_the_valve_of_the_plan_where_opening_another_one_is_cancelled',
    { skip: process.env.MVS_COMMAND ? false : 'MVS_COMMAND is not set' },
    async () => {
      const { hash } = await figures(page);
      // large, so that there is time to cancel its closure
      const large = temporaryFile('large.obj', '');
      execFileSync(process.env.MVS_COMMAND, ['generate', '--vertices', '6000', '-o', large]);
      await page.setInputFiles('#file', large);
      await page.getByTestId('busy').getByRole('button', { name: 'Cancel' }).click();
      await answered(page, 300);
      assert.equal((await figures(page)).hash, hash);
      assert.equal(await savedHash(page), hash);
    },
  );

  it('takes_the_unit_of_a_surface_from_its_width_and_leaves_it_for_a_valve', async () => {
    const obj = await openLeaflets(page);
    const metres = obj.replace(
      /^v (.*)$/gm,
      (_, row) =>
        `v ${row
          .split(' ')
          .map((v) => v / 1000)
          .join(' ')}`,
    );
    await open(page, temporaryFile('metres.obj', metres));
    assert.equal(await page.getByLabel('Unit of the file').inputValue(), 'm');
    // the annulus of this valve is 35 mm wide, and the leaflets hang from it
    const said = /measures ([\d.]+) × ([\d.]+) × ([\d.]+)/.exec(await page.locator('.panel').innerText());
    const width = Math.max(...said.slice(1).map(Number));
    assert.ok(width > 34 && width < 45, `${width} mm`);
    await healthy(page);
    await closed(page);
    assert.equal(await page.getByRole('tab', { selected: true }).innerText(), 'Valve');
    assert.match(await page.locator('.panel').innerText(), /Coaptation length/);
  });

  it('shows_the_valve_of_a_session_that_is_opened_over_a_surface', async () => {
    const copy = temporaryFile('plain.mvsplan', readFileSync(await save(page)));
    await open(page, temporaryFile('open.obj', await openLeaflets(page)));
    assert.match(await verdict(page), /surface/);
    await open(page, copy);
    assert.match(await verdict(page), /Sealed/);
  });

  it('names_a_wrong_file_and_forgets_it_with_the_next_one', async () => {
    const copy = temporaryFile('good.mvsplan', readFileSync(await save(page)));
    await open(page, temporaryFile('wrong.mvsplan', 'no archive'));
    assert.match(await page.getByTestId('notice').innerText(), /^wrong\.mvsplan was not opened: /);
    await open(page, copy);
    assert.match(await page.getByTestId('notice').innerText(), /^Session opened/);
  });

  it('saves_a_valve_as_obj_and_opens_it_again', async () => {
    await begin(page, 'ring');
    await apply(page);
    const { measures, valve } = await figures(page);
    await openPanel(page, 'Plan');
    const [download] = await Promise.all([
      page.waitForEvent('download'),
      page.getByRole('button', { name: 'Valve as OBJ' }).click(),
    ]);
    assert.match(download.suggestedFilename(), /\.obj$/);
    const copy = temporaryFile('repaired.obj', readFileSync(await download.path()));
    await healthy(page);
    // the plan that is left is kept first, and a busy worker takes its time
    while ((await figures(page)).history.length) await page.waitForTimeout(50);
    await closed(page);
    await open(page, copy);
    await closed(page);
    const again = await figures(page);
    assert.equal(again.valve, valve);
    // coordinates are written to the last bit; the page settles the valve again, to 1e-4 N
    for (const name of ['annulusAp', 'coaptationMean', 'tentingHeight'])
      assert.ok(
        Math.abs(again.measures[name] - measures[name]) < 0.05,
        `${name}: ${again.measures[name]} after ${measures[name]} mm`,
      );
    assert.equal(again.measures.orifice, measures.orifice);
  });
});
