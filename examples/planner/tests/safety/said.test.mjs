// What the page says is what it shows: of tissue in the hand, of a leak in colour maps, of a flow, of files and surfaces, of valves that
// were left and of saved repairs of the tour.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { beforeEach, describe, it } from 'node:test';
import { closed, figures, sharePlanner, temporaryFile } from '../fixtures/browser.mjs';
import { answered, apply, becomes, begin, open, openPanel, save, startAfresh } from '../fixtures/person.mjs';
import { listed, openTour, startHealthy } from '../fixtures/valves.mjs';

const flat = (text) => text.replace(/\s+/g, ' ').trim();

describe('planner says what it shows', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));
  beforeEach(() => startAfresh(page));

  const card = async () => flat(await page.getByTestId('verdict').innerText());
  const status = async () => flat(await page.getByTestId('status').innerText());
  const notice = async () => flat(await page.getByTestId('notice').innerText());

  it('tags_the_figures_as_those_at_rest_while_tissue_is_held', async () => {
    await openTour(page, 4);
    const keys = page.locator('.scale');
    assert.match(await keys.innerText(), /leak; arrow: its jet/);
    await page.keyboard.press('g');
    const box = await page.locator('.canvas canvas').boundingBox();
    const [x, y] = [box.x + 0.5 * box.width, box.y + 0.4 * box.height];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 40, y + 20, { steps: 4 });
    await becomes(() => page.evaluate(() => !!window.planner.state.motion.value), true);
    assert.match(await card(), /^Severe leak at rest, before the pull .*of moved tissue are not measured/);
    assert.match(await page.getByTestId('verdict').getAttribute('class'), /level-none/);
    // no leak is drawn, and no key says that one is
    assert.doesNotMatch(await keys.innerText(), /leak/);
    await page.mouse.up();
    await becomes(() => page.evaluate(() => !!window.planner.state.motion.value), false);
    assert.doesNotMatch(await card(), /at rest/);
    await page.keyboard.press('g');
  });

  it('has_a_key_for_the_leak_in_every_colour_map', async () => {
    await openTour(page, 4);
    for (const name of ['coaptation', 'height', 'load']) {
      await page.evaluate((map) => (window.planner.state.map.value = map), name);
      await becomes(
        async () => /leak; arrow: its jet/.test(await page.getByTestId('scale').innerText()),
        true,
        name,
      );
    }
    await page.evaluate(() => (window.planner.state.map.value = 'tissue'));
  });

  it('keeps_the_goals_of_a_valve_of_the_tour_in_its_session', async () => {
    await openTour(page, 4);
    await begin(page, 'band');
    await apply(page);
    const path = await save(page);
    await startHealthy(page);
    assert.equal(await page.evaluate(() => window.planner.state.tour.value), null);
    await open(page, temporaryFile('repair.mvsplan', readFileSync(path)));
    await openPanel(page, 'Learn');
    await page.getByTestId('score').getByText('Before illness').waitFor();
    assert.equal(await page.evaluate(() => window.planner.state.tour.value.number), 4);
  });

  it('lists_a_valve_that_was_left_with_its_whole_verdict', async () => {
    await startHealthy(page);
    await begin(page, 'annulus_scale');
    await page.evaluate(() => window.planner.edit('annulus_scale', { factor: 0.7, ap: 0.7 }));
    await answered(page, 100);
    await apply(page);
    await startHealthy(page);
    await openPanel(page, 'Plan');
    const [newest] = await listed(page).allInnerTexts();
    assert.match(flat(newest), /Sealed, but annulus 25 × 13 mm/);
    assert.doesNotMatch(newest, /not measured yet/);
  });

  it('says_a_preview_again_once_its_opening_is_measured', async () => {
    await begin(page, 'band');
    await becomes(
      async () => /^Preview: Sealed/.test(await status()) && !/not measured/.test(await status()),
      true,
    );
    await page.keyboard.press('Escape');
  });

  it('refuses_a_flow_that_no_valve_has', async () => {
    await openPanel(page, 'Valve');
    const section = page.locator('details', {
      has: page.locator('summary', { hasText: 'How far it opens' }),
    });
    await section.locator('summary').click();
    for (const given of ['99999', '-50', '0']) {
      await page.locator('#flow').fill(given);
      await page.keyboard.press('Tab');
      const said = flat(await section.getByRole('alert').innerText());
      assert.equal(
        said,
        `${given.replace('-', '−')} ml/s is out of range; it has to be 10 to 1000 ml/s. No gradient is shown.`,
      );
      assert.equal(await page.evaluate(() => window.planner.state.flow.value), null);
      await page.locator('#flow').fill('');
    }
    await page.locator('#flow').fill('200');
    await page.keyboard.press('Tab');
    await section.getByText('Mean pressure gradient').waitFor();
    assert.equal(await section.getByRole('alert').count(), 0);
  });

  it('begins_with_the_name_of_a_file_that_is_damaged', async () => {
    for (const [name, text, why] of [
      ['cut.obj', 'v 0 0 0\nv 1 0 0\nv 0 1\n', 'cut.obj is damaged, cut short or no OBJ file: '],
      ['cut.stl', 'short', 'cut.stl is damaged, cut short or no STL file: '],
      ['valve.obj', '# mvs valve\nv 0 0\n', 'valve.obj is damaged, cut short or no OBJ file: '],
    ]) {
      await page.evaluate(() => (window.planner.state.notice.value = null));
      await open(page, temporaryFile(name, text));
      const said = await notice();
      assert.ok(said.startsWith(why) && said.length > why.length + 10, said);
    }
  });

  it('measures_a_surface_along_the_axes_of_its_file', async () => {
    const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => [k & 1, (k >> 1) & 1, (k >> 2) & 1]);
    const faces = '1 3 4,1 4 2,5 6 8,5 8 7,1 2 6,1 6 5,3 7 8,3 8 4,1 5 7,1 7 3,2 4 8,2 8 6'.split(',');
    const box = corners.map(([x, y, z]) => `v ${30 * x} ${40 * y} ${20 * z}\n`).join('');
    await open(page, temporaryFile('box.obj', `${box}${faces.map((face) => `f ${face}\n`).join('')}`));
    const panel = flat(await page.locator('.panel').innerText());
    assert.match(panel, /The surface measures 30\.0 × 40\.0 × 20\.0 mm along the axes of the file\./);
    assert.match(panel, /mm: 40 mm at most/);
    await page.getByRole('button', { name: 'Leave', exact: true }).click();
    await closed(page);
  });

  it('names_a_report_without_a_colon_and_explains_lengths_that_are_not_there', async () => {
    await openTour(page, 4);
    await openPanel(page, 'Plan');
    await page.getByRole('button', { name: 'Report' }).click();
    const report = page.locator('dialog [data-testid=report]');
    await report.locator('tr', { hasText: 'Length of A2 and P2' }).waitFor();
    assert.ok((await figures(page)).measures.coaptationHeight === 0);
    const text = await report.innerText();
    assert.doesNotMatch(text, /– and – mm/);
    assert.match(text, /A2 and P2 do not touch in the middle/);
    const [download] = await Promise.all([
      page.waitForEvent('download'),
      page.getByRole('button', { name: 'Save as HTML' }).click(),
    ]);
    assert.equal(download.suggestedFilename(), 'Valve 4 a flail P2 report.html');
    await page.keyboard.press('Escape');
  });
});
