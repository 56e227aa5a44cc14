// Read-outs and drags: the spread over foldings beside its figures, the map of the motion by a repair, the pull under the pointer,
// a section plane that is dragged.
import assert from 'node:assert/strict';
import { beforeEach, describe, it } from 'node:test';
import { closed, sharePlanner } from './fixtures/browser.mjs';
import {
  apply,
  begin,
  cameraRests,
  chordNames,
  chordPlace,
  openPanel,
  startAfresh,
  undo,
} from './fixtures/person.mjs';

describe('planner read and touched', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));
  beforeEach(() => startAfresh(page));

  it('shows_the_spread_over_foldings_beside_every_figure_that_it_touches', async () => {
    await openPanel(page, 'Valve');
    assert.equal(await page.locator('.spread').count(), 0);
    await page.locator('summary', { hasText: 'How certain' }).click();
    await page.getByRole('button', { name: /Close it 8 times/ }).click();
    await page.getByText(/closures came to rest/).waitFor();
    await closed(page);
    const { spread, measures, regions, chords, heads } = await page.evaluate(() => {
      const { state } = window.planner;
      return { spread: state.spread.value, ...state.main.value.figures };
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
    // the ranges make no table wider than its panel
    const over = (table) =>
      table.getBoundingClientRect().right - table.parentElement.getBoundingClientRect().right;
    assert.ok((await page.getByTestId('scallops').evaluate(over)) <= 1);
    // on the card, in the figures, in the table of the scallops and in that of the chordae
    await page.locator('summary', { hasText: /^Chordae \(/ }).click();
    for (const part of ['verdict', 'scallops', 'chords']) {
      const shown = await page.getByTestId(part).locator('.spread').allInnerTexts();
      const range = part === 'verdict' ? /^[\d.]+ to [\d.]+ over \d closures$/ : /^[\d.]+ to [\d.]+$/;
      assert.ok(shown.length && shown.every((text) => range.test(text)), `${part}: ${shown}`);
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
    await page
      .getByTestId('scale')
      .getByText(/Moved by the repair/)
      .waitFor();
    assert.match(await page.getByTestId('scale').innerText(), /Moved by the repair[^]*mm/);
    await page.getByLabel('Colours').selectOption({ label: 'Tissue' });
    await undo(page);
  });

  it('says_what_the_colours_of_contact_mean', async () => {
    await page.locator('.colours select').selectOption('coaptation');
    await page.locator('.scale').getByText('touching').waitFor();
    const legend = await page.locator('.scale').innerText();
    for (const word of ['touching', 'apart', 'no leaflet faces it']) assert.ok(legend.includes(word), legend);
    await page.locator('.colours select').selectOption('tissue');
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
    // the middle of a chord may lie behind a papillary head
    const ofChordae = [...said].filter((text) => !/^Papillary head \w+$/.test(text));
    assert.ok(ofChordae.length > 2, [...said].join());
    for (const text of ofChordae)
      assert.match(text, /mm without pull, (pull \d+\smN, stretch [\d.]+\s%|slack)/);
  });

  it('turns_pans_and_zooms_with_the_mouse_at_a_lower_resolution', async () => {
    const box = await page.locator('.canvas canvas').boundingBox();
    // a corner of the picture without tissue
    const [x, y] = [box.x + 40, box.y + box.height - 60];
    const camera = () =>
      page.evaluate(() => {
        const { orientation, target, distance } = window.planner.viewport.camera;
        return { turn: orientation.toArray(), target: target.toArray(), distance };
      });
    const drag = async (button) => {
      await page.mouse.move(x, y);
      await page.mouse.down({ button });
      for (let k = 1; k <= 5; ++k) await page.mouse.move(x + 12 * k, y - 8 * k);
      await page.mouse.up({ button });
    };
    const start = await camera();
    await drag('left');
    const turned = await camera();
    assert.notDeepEqual(turned.turn, start.turn);
    assert.deepEqual([turned.target, turned.distance], [start.target, start.distance]);
    await drag('right');
    const panned = await camera();
    assert.notDeepEqual(panned.target, turned.target);
    assert.deepEqual([panned.turn, panned.distance], [turned.turn, turned.distance]);
    await page.mouse.wheel(0, -300);
    assert.ok((await camera()).distance < 0.95 * panned.distance, 'the wheel brings the valve nearer');
    // fewer pixels while it moves, three for two of the screen at rest
    const sizes = await page.evaluate(() => {
      const { viewport } = window.planner;
      return [true, false].map((fast) => {
        viewport.draw(fast);
        return viewport.renderer.canvas.width / viewport.width;
      });
    });
    assert.ok(sizes[0] <= 1 && Math.abs(sizes[1] - 1.5) < 0.01, `${sizes}`);
  });

  it('drags_the_section_plane', async () => {
    // seen at a slant, so that the plane moves in the picture; views other than the section show the whole valve
    await page.keyboard.press('3');
    await cameraRests(page);
    await page.keyboard.press('x');
    const name = page.locator('.label-handle', { hasText: 'Cut plane' });
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
});
