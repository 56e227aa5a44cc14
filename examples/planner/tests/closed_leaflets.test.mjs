// Closed leaflets and the thickness beside the surface of an import: chordae are fitted to the closed shape, a file that is no
// surface is refused and loses nothing, and what was given stays through another unit and a crash.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { closed, reopenAfterCrash, temporaryFile, withPlanner } from './fixtures/browser.mjs';
import { answered, open, openLeaflets, openPanel } from './fixtures/person.mjs';

/** The closed leaflets that the page shows, as OBJ in mm. */
const closedLeaflets = (page) =>
  page.evaluate(() => {
    const { state } = window.planner;
    const { picture } = state.main.value;
    const { triangles } = state.topologyOf(picture);
    const rows = [];
    for (let i = 0; i < picture.positions.length; i += 3)
      rows.push(`v ${picture.positions.slice(i, i + 3).join(' ')}`);
    for (let i = 0; i < triangles.length; i += 3)
      rows.push(`f ${[...triangles.slice(i, i + 3)].map((node) => node + 1).join(' ')}`);
    return rows.join('\n');
  });

const imported = (page) =>
  page.evaluate(() => {
    const { closed: file, thickness } = window.planner.state.imported.value;
    return { file: file?.name ?? null, thickness };
  });

/** Opens the open leaflets of the valve, and chooses its closed ones beside them. */
async function give(page) {
  const shut = temporaryFile('systole.obj', await closedLeaflets(page));
  await open(page, temporaryFile('diastole.obj', await openLeaflets(page)));
  await page.setInputFiles('#closed-file', shut);
  await page.getByText('systole.obj: closed leaflets of').waitFor();
}

const thickness = (page) => page.getByLabel('Thickness of the leaflets');

async function type(page, text) {
  await thickness(page).fill(text);
  await thickness(page).press('Enter');
}

describe('closed leaflets', () => {
  it('fit_the_chordae_so_that_the_valve_closes_to_them', async () => {
    await withPlanner({}, async ({ page }) => {
      await give(page);
      await type(page, '0,9');
      await page.getByRole('button', { name: 'Build the valve' }).click();
      const findings = page.getByTestId('findings');
      await findings.waitFor({ timeout: 600_000 });
      await closed(page);
      const said = await findings.innerText();
      const [, distance] = /the closed valve is ([\d.]+)\smm \(RMS/.exec(said) ?? [];
      // the closed shape of the same valve: within half of the thickness
      assert.ok(+distance < 0.45, said);
      assert.match(said, /thickness\s+given/i);
      assert.match(said, /0\.90\smm/);
    });
  });

  it('that_are_no_surface_are_refused_and_lose_nothing', async () => {
    await withPlanner({}, async ({ page }) => {
      await give(page);
      await page.setInputFiles('#closed-file', temporaryFile('notes.obj', 'v 0 0 0\n'));
      await page.getByRole('alert').getByText('notes.obj').first().waitFor();
      assert.equal((await imported(page)).file, 'systole.obj');
      await page.getByRole('button', { name: 'Forget the closed leaflets' }).click();
      assert.equal((await imported(page)).file, null);
    });
  });

  it('and_the_thickness_stay_through_another_unit_and_a_crash', async () => {
    await withPlanner({}, async ({ page }) => {
      await openPanel(page, 'Plan');
      await page.getByLabel(/Keep a copy/).check();
      await give(page);
      await type(page, '1.1');
      await page.getByLabel('Unit of the file').selectOption('cm');
      await answered(page, 100);
      const given = { file: 'systole.obj', thickness: 1.1 };
      assert.deepEqual(await imported(page), given);
      await page.waitForTimeout(1500);
      const second = await reopenAfterCrash(page);
      await second.getByRole('button', { name: 'Recover it' }).click();
      await second.getByRole('button', { name: 'Build the valve' }).waitFor();
      assert.deepEqual(await imported(second), given);
    });
  });

  it('have_a_thickness_within_the_range_of_the_library', async () => {
    await withPlanner({}, async ({ page }) => {
      await open(page, temporaryFile('diastole.obj', await openLeaflets(page)));
      for (const [text, sentence] of [
        ['8', /8 mm is out of range; it has to be 0\.1 to 5 mm/],
        ['thin', /thin/],
      ]) {
        await type(page, text);
        await page.getByRole('alert').getByText(sentence).waitFor();
        assert.equal((await imported(page)).thickness, null);
      }
      await type(page, '0.8');
      assert.equal((await imported(page)).thickness, 0.8);
    });
  });
});
