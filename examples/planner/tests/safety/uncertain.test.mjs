// Chordae of a valve from an image are guessed: no operation and no file makes its result certain. The reservation stands by the same
// words in card, status line, panel, report and comparison.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { describe, it } from 'node:test';
import { closed, figures, sharePlanner, temporaryFile } from '../fixtures/browser.mjs';
import {
  answered,
  apply,
  becomes,
  begin,
  fillIn,
  open,
  openLeaflets,
  openPanel,
  save,
} from '../fixtures/person.mjs';
import { startHealthy } from '../fixtures/valves.mjs';

const flat = (text) => text.replace(/\s+/g, ' ').trim();

describe('planner valve with guessed chordae', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));

  const card = async () => flat(await page.getByTestId('verdict').innerText());
  const colour = () => page.getByTestId('verdict').getAttribute('class');
  let words;
  /** The reservation, on the card and in its colour. */
  const isReserved = async () => {
    await becomes(async () => (await card()).includes(words), true, await card());
    assert.doesNotMatch(await colour(), /level-0/);
  };

  it('is_not_called_plainly_sealed_after_an_operation', async () => {
    await open(page, temporaryFile('patient.obj', await openLeaflets(page)));
    await page.getByRole('button', { name: 'Build the valve' }).click();
    await page.getByTestId('findings').waitFor();
    await closed(page);
    const [, low, high] = /a leak of ([\d.]+) to ([\d.]+) mm² is possible/.exec(await card());
    words = `chordae are guessed: the leak before the repair is known as ${low} to ${high} mm² only`;
    await begin(page, 'band');
    await fillIn(page, 'factor', 90);
    await isReserved();
    await apply(page);
    assert.equal((await figures(page)).measures.orifice, 0);
    await isReserved();
    await becomes(async () => flat(await page.getByTestId('status').innerText()).includes(words), true);
    await openPanel(page, 'Plan');
    assert.ok(flat(await page.getByTestId('plan-verdict').innerText()).includes(words));
    await page.getByRole('button', { name: 'Report' }).click();
    const said = page.locator('dialog').getByTestId('report-verdict');
    await becomes(async () => flat(await said.innerText()).startsWith(`Sealed, but ${words}`), true);
    await page.keyboard.press('Escape');
  });

  it('stays_so_beside_another_plan_and_as_the_one_before_the_repair', async () => {
    await page.getByRole('button', { name: 'Keep this plan' }).click();
    await answered(page);
    await page.getByRole('button', { name: 'Compare' }).click();
    const verdicts = page.getByTestId('compare').locator('tr', { hasText: 'Verdict' });
    await verdicts.waitFor();
    for (const verdict of await verdicts.locator('td').allInnerTexts())
      assert.ok(flat(verdict).includes(words), verdict);
    await page.getByRole('button', { name: 'Take this valve as the one before' }).click();
    await answered(page, 300);
    await isReserved();
    const session = temporaryFile('again.mvsplan', readFileSync(await save(page)));
    await startHealthy(page);
    assert.match(await card(), /^Sealed 0/);
    await open(page, session);
    await isReserved();
  });

  it('keeps_the_reservation_in_its_obj_file_under_a_name_of_its_own', async () => {
    await openPanel(page, 'Plan');
    const [download] = await Promise.all([
      page.waitForEvent('download'),
      page.getByRole('button', { name: 'Valve as OBJ' }).click(),
    ]);
    // the surface that it was built from was patient.obj
    assert.match(download.suggestedFilename(), /^patient.* valve\.obj$/);
    const text = readFileSync(await download.path(), 'utf8');
    assert.match(text, /\n# mvs-planner chordae=guessed leak_range_mm2=[\d.]+,[\d.]+ of=before\n$/);
    const copy = temporaryFile('repaired.obj', text);
    await startHealthy(page);
    await open(page, copy);
    await isReserved();
  });
});
