// Wishes of a surgeon who tried every panel: a typed number that is tried by itself, the field that a form is for, the
// open areas of two plans, a clip that is seen from the atrium, a report that prints on one page, keys and names that cover nothing,
// a side in words instead of a sign.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { describe, it } from 'node:test';
import { pathToFileURL } from 'node:url';
import { closed, figures, sharePlanner } from './fixtures/browser.mjs';
import {
  answered,
  apply,
  begin,
  cameraRests,
  fillIn,
  openPanel,
  startAfresh,
  undo,
} from './fixtures/person.mjs';

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

  it('covers_no_annulus_and_no_muscle_by_the_keys_of_the_colours', async () => {
    await startAfresh(page);
    // a clip and slack chordae: more keys
    await begin(page, 'clip');
    await apply(page);
    for (const [width, height] of [
      [1280, 720],
      [1024, 700],
      [820, 1180],
    ]) {
      await page.setViewportSize({ width, height });
      await page.waitForTimeout(250);
      for (const key of ['1', '2', '3', '4']) {
        await page.keyboard.press(key);
        await cameraRests(page);
        const covered = await page.evaluate(() => {
          const { state, viewport } = window.planner;
          const { positions } = state.picture.value;
          const { annulus, headNodes } = state.topologyOf(state.picture.value);
          const [host, keys] = [viewport.host, document.querySelector('.scale')].map((one) =>
            one.getBoundingClientRect(),
          );
          const up = viewport.frameOf().slice(9, 12);
          const at = (node, below) => [0, 1, 2].map((c) => positions[3 * node + c] - below * up[c]);
          // muscles are drawn to 4.5 mm below their chordae, and rounded
          const places = [...annulus]
            .map((node) => at(node, 0))
            .concat([...headNodes].map((node) => at(node, 6)));
          return places.filter((place) => {
            const [x, y] = viewport.camera.project(...place, viewport.width, viewport.height);
            const [left, top] = [host.left + x, host.top + y];
            return (left > keys.left && left < keys.right && top > keys.top) || y > viewport.height;
          }).length;
        });
        assert.equal(covered, 0, `view ${key} at ${width} x ${height}`);
      }
    }
    await page.setViewportSize({ width: 1280, height: 720 });
    await undo(page);
  });

  it('writes_no_name_over_another_or_over_a_handle', async () => {
    await startAfresh(page);
    const collisions = async () => {
      await page.waitForTimeout(300);
      return page.evaluate(() => {
        const boxes = [...document.querySelectorAll('.label')]
          .filter((label) => !label.hidden)
          .map((label) => [label.textContent, label.getBoundingClientRect()]);
        const meet = (a, b) =>
          a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1;
        return boxes.flatMap(([one, a], k) =>
          boxes.slice(k + 1).flatMap(([other, b]) => (meet(a, b) ? [`${one} and ${other}`] : [])),
        );
      });
    };
    // a head that is chosen beside its muscle
    await page.evaluate(() => {
      const { state } = window.planner;
      const { heads } = state.topologyOf(state.main.value.picture);
      state.choice.value = { kind: 'head', id: heads.find(({ name }) => name === 'AL1').id };
    });
    for (const key of ['2', '3', '4', '1']) {
      await page.keyboard.press(key);
      await cameraRests(page);
      assert.deepEqual(await collisions(), [], `view ${key}`);
      const names = await page.locator('.label:visible').allInnerTexts();
      if (key === '2') assert.ok(names.includes('AL1') && names.includes('PM'), names.join(', '));
    }
    await page.keyboard.press('Escape');
    await begin(page, 'clip');
    for (const position of [0, 40, 100]) {
      await fillIn(page, 'position', position);
      assert.deepEqual(await collisions(), [], `a clip at ${position} %`);
      const balls = await page.evaluate(() => {
        const { x, width } = document.querySelector('.label-handle').getBoundingClientRect();
        return [...document.querySelectorAll('.label-scallop:not([hidden])')]
          .map((label) => label.getBoundingClientRect())
          .filter((box) => box.left < x && box.right > x + width).length;
      });
      assert.equal(balls, 0);
    }
    await page.keyboard.press('Escape');
    await page.keyboard.press('Escape');
    await closed(page);
  });

  it('says_the_side_of_a_clip_in_words_that_go_with_its_number_and_its_slider', async () => {
    await startAfresh(page);
    await begin(page, 'clip');
    const side = page.locator('.form .towards select').first();
    const slider = page.locator('.form input[type=range]').first();
    const words = async () => {
      const field = page.locator('.field', { has: page.locator('#f-position') });
      await field.getByText(/In the preview: \d/).waitFor();
      return (await field.innerText()).replace(/\s+/g, ' ');
    };
    await fillIn(page, 'position', 40);
    assert.match(
      await words(),
      /40 % of the way to the anterolateral end.*mm towards A1\/P1 \(anterolateral\)/,
    );
    // left in the surgeon's view
    assert.equal(await slider.inputValue(), '-40');
    await side.selectOption({ label: 'towards posteromedial' });
    await answered(page, 300);
    assert.match(
      await words(),
      /40 % of the way to the posteromedial end.*mm towards A3\/P3 \(posteromedial\)/,
    );
    assert.equal(await slider.inputValue(), '40');
    assert.equal(await page.locator('#f-position').inputValue(), '40', 'the number has no sign');
    await fillIn(page, 'position', 20);
    assert.match(await words(), /20 % of the way to the posteromedial end/);
    await page.keyboard.press('Escape');
    await page.keyboard.press('Escape');
    await closed(page);
  });

  it('cuts_no_row_of_the_chordae_by_the_head_of_their_table', async () => {
    await startAfresh(page);
    await openPanel(page, 'Valve');
    await page.locator('details', { hasText: /^Chordae \(/ }).evaluate((part) => (part.open = true));
    const table = page.locator('.scroll');
    await table.scrollIntoViewIfNeeded();
    await table.hover();
    // pixels that are no multiple of a row
    for (const by of [95, 50, -70]) {
      await page.mouse.wheel(0, by);
      await page.waitForTimeout(700);
      const cut = await table.evaluate((box) => {
        const foot = box.querySelector('thead th').getBoundingClientRect().bottom;
        return [...box.querySelectorAll('tbody tr')]
          .map((row) => row.getBoundingClientRect())
          .filter(({ top, bottom }) => top < foot - 1.5 && bottom > foot + 1.5).length;
      });
      assert.equal(cut, 0, `after ${by}`);
    }
    assert.ok((await table.evaluate((box) => box.scrollTop)) > 20, 'it does scroll');
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
