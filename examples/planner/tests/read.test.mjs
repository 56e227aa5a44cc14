// What is read and moved: the spread over foldings beside its figures, the map of what a repair moved, the pull under the pointer,
// a section plane that is dragged, tissue that is grasped and pushed, forms of operations that the page does not know.
import assert from 'node:assert/strict';
import { beforeEach, describe, it } from 'node:test';
import { closed, figures, sharePlanner } from './browser.mjs';
import {
  answered,
  apply,
  begin,
  cameraRests,
  chordNames,
  chordPlace,
  openPanel,
  startAfresh,
  undo,
} from './person.mjs';

describe('planner read and touched', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));
  beforeEach(() => startAfresh(page));

  it('shows_the_spread_over_foldings_beside_every_figure_that_it_touches', async () => {
    await openPanel(page, 'Valve');
    assert.equal(await page.locator('.spread').count(), 0);
    await page.locator('summary', { hasText: 'Physics' }).click();
    await page.getByRole('button', { name: /How certain/ }).click();
    await page.getByText(/closures came to rest/).waitFor();
    await closed(page);
    const { spread, measures, regions, chords, heads } = await page.evaluate(() => {
      const { state } = window.planner;
      return { spread: state.spread.value.value, ...state.main.value.figures };
    });
    assert.ok(spread.converged > 4);
    // the first closure is the one of the page; the numbers of the library are converted alike
    const holds = (range, value, name) =>
      assert.ok(range[0] <= value && value <= range[1], `${name}: ${value} in ${range}`);
    for (const [name, range] of Object.entries(spread.measures)) holds(range, measures[name], name);
    for (const region of regions)
      holds(spread.regions[region.name].coaptationMean, region.coaptationMean, region.name);
    for (const { id, name, tension } of chords) holds(spread.chords[id], tension, name);
    heads.forEach((pull, h) => holds(spread.heads[h], pull, `head ${h}`));
    // the annulus is prescribed: folds do not move it
    assert.equal(spread.measures.annulusAp[0], spread.measures.annulusAp[1]);
    // on the card, in the figures, in the table of the scallops and in that of the chordae
    await page.locator('summary', { hasText: /^Chordae \(/ }).click();
    for (const part of ['verdict', 'scallops', 'chords']) {
      const shown = await page.getByTestId(part).locator('.spread').allInnerTexts();
      assert.ok(shown.length && shown.every((text) => /^[\d.]+ to [\d.]+$/.test(text)), `${part}: ${shown}`);
    }
    assert.ok((await page.locator('.figure .spread').count()) > 5);
    // the figures of another valve have none
    await begin(page, 'ring');
    assert.equal(await page.locator('.spread').count(), 0);
    await page.keyboard.press('Escape');
  });

  it('colours_what_a_repair_has_moved', async () => {
    const colours = () =>
      page.evaluate(() => new Set(Array.from(window.planner.viewport.scene().meshes[0].front, String)).size);
    await page.getByLabel('Colours').selectOption({ label: 'Change' });
    await page.waitForTimeout(200);
    // nothing has moved: one colour, of three numbers
    assert.ok((await colours()) <= 3);
    await begin(page, 'band');
    await apply(page);
    await page.waitForTimeout(200);
    assert.ok((await colours()) > 100);
    assert.match(await page.getByTestId('scale').innerText(), /Moved by the repair[^]*mm/);
    await page.getByLabel('Colours').selectOption({ label: 'Tissue' });
    await undo(page);
  });

  it('says_the_pull_of_the_chord_under_the_pointer', async () => {
    await page.keyboard.press('2');
    await cameraRests(page);
    const said = new Set();
    for (const name of (await chordNames(page)).slice(0, 12)) {
      const { middle } = await chordPlace(page, name);
      await page.mouse.move(middle.x, middle.y);
      said.add(await page.locator('.canvas canvas').getAttribute('title'));
    }
    said.delete('');
    said.delete(null);
    assert.ok(said.size > 2, [...said].join());
    for (const text of said) assert.match(text, /mm without pull, (pull \d+\smN, stretch [\d.]+\s%|slack)/);
  });

  it('drags_the_section_plane', async () => {
    await page.keyboard.press('4');
    await cameraRests(page);
    // seen at a slant, so that the plane moves in the picture
    await page.keyboard.press('3');
    await cameraRests(page);
    const name = page.locator('.label-handle', { hasText: 'Section plane' });
    const { x, y, height } = await name.boundingBox();
    const at = () => page.evaluate(() => window.planner.state.sectionAt.value);
    const before = await at();
    await page.mouse.move(x - 24, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + 36, y + height / 2, { steps: 6 });
    await page.mouse.up();
    assert.ok(Math.abs((await at()) - before) > 3, `from ${before} to ${await at()} mm`);
    await openPanel(page, 'Valve');
    await page.locator('summary', { hasText: 'Section through the valve' }).click();
    await page.getByRole('button', { name: 'To the middle' }).click();
    assert.equal(await at(), 0);
    await page.keyboard.press('x');
  });

  for (const [key, word, label] of [
    ['g', 'grasps', 'Grasp'],
    ['b', 'pushes', 'Push'],
  ])
    it(`${word}_the_tissue_of_the_living_valve_and_lets_it_go`, async () => {
      const { hash } = await figures(page);
      await page.keyboard.press(key);
      assert.equal(await page.getByRole('button', { name: label }).getAttribute('aria-pressed'), 'true');
      const box = await page.locator('.canvas canvas').boundingBox();
      const [x, y] = [box.x + 0.5 * box.width, box.y + 0.4 * box.height];
      await page.mouse.move(x, y);
      await page.mouse.down();
      // mm by which a node moved most
      const moved = () =>
        page.evaluate(() => {
          const { state } = window.planner;
          const now = state.motion.value?.picture.positions;
          const then = state.main.value.picture.positions;
          return now ? Math.max(...now.map((v, i) => Math.abs(v - then[i]))) : 0;
        });
      let most = 0;
      for (let k = 0; k < 600 && most < 1; ++k) {
        await page.mouse.move(x + Math.min(60, 2 * k), y + Math.min(30, k));
        await page.waitForTimeout(50);
        most = Math.max(most, await moved());
      }
      assert.ok(most >= 1, `${most} mm`);
      await page.mouse.up();
      await answered(page, 300);
      assert.equal(await page.evaluate(() => window.planner.state.motion.value), null);
      assert.equal((await figures(page)).hash, hash);
      await page.getByRole('button', { name: 'Turn', exact: false }).first().click();
    });

  it('has_a_form_for_every_operation_and_for_one_that_it_does_not_know', async () => {
    const known = await page.evaluate(() => {
      const { operations } = window.planner.state;
      const stiffen = {
        name: 'leaflet_stiffen',
        help: 'Make a leaflet stiffer',
        fields: [
          ['factor', 'number', 'Factor'],
          ['scallop', 'scallop', 'Scallop'],
        ].map(([name, type, label]) => ({
          ...operations.value.flatMap(({ fields }) => fields).find((field) => field.type === type),
          name,
          label,
          required: true,
        })),
      };
      operations.value = [...operations.value, stiffen];
      return operations.value.map(({ name }) => name);
    });
    assert.ok(known.length >= 13, known.join());
    for (const name of known) {
      await openPanel(page, 'Repair');
      const card = page.locator(`[data-operation=${name}]`);
      if (!(await card.isVisible())) await page.getByText('More operations').click();
      await card.click();
      const form = page.getByTestId('form');
      await form.waitFor();
      // the operation that the library does not have is refused in words
      const controls = await form.locator('input, select, button').count();
      assert.ok(controls >= 3, `${name} has ${controls} controls`);
      if (name === 'leaflet_stiffen')
        assert.match(await form.innerText(), /leaflet stiffen[^]*Factor[^]*Scallop/);
      await page.keyboard.press('Escape');
      await closed(page);
    }
    await page.evaluate(() => {
      const { operations } = window.planner.state;
      operations.value = operations.value.filter(({ name }) => name !== 'leaflet_stiffen');
    });
  });
});
