// The planner as a person uses it: the built page, opened from disk in Chromium.
import assert from 'node:assert/strict';
import { readFileSync, statSync } from 'node:fs';
import { describe, it } from 'node:test';
import { pathToFileURL } from 'node:url';
import { closed, figures, openBrowser, page_path, sharePlanner } from './fixtures/browser.mjs';
import { shippedPositions } from './fixtures/library.mjs';
import { applyAtShape, noteApplied, notePreviews } from './fixtures/notes.mjs';
import {
  answered,
  apply,
  becomes,
  begin,
  cameraRests,
  chooseAnyChord,
  chordDirection,
  chordNames,
  fillIn,
  openPanel,
  shareOfTissue,
  undo,
} from './fixtures/person.mjs';

describe('opening', () => {
  it('shows_the_open_valve_before_the_library_answers', async () => {
    const { context } = await openBrowser();
    try {
      const page = await context.newPage();
      await page.addInitScript(() => {
        window.Worker = class {
          postMessage() {}
        };
      });
      await page.goto(pathToFileURL(page_path).href);
      const share = await shareOfTissue(page);
      assert.ok(share > 0.15 && share < 0.6, `share of tissue ${share}`);
      const shown = await page.evaluate(() => [...window.planner.state.picture.value.positions]);
      const made = await shippedPositions();
      assert.equal(shown.length, made.length);
      // half a unit of the last digit that the page keeps, and single precision at 40 mm
      assert.ok(made.every((v, i) => Math.abs(v - shown[i]) < 5e-6 + 2e-6));
    } finally {
      await context.close();
    }
  });
});

describe('planner', () => {
  let page, requests;
  // a test asks for it, and the browser logs the refusal
  const expects = (error) => /example\.org/.test(error);
  sharePlanner((opened) => ({ page, requests } = opened), { expects });

  it('is_one_file_of_at_most_4_MB', () => {
    assert.ok(statSync(page_path).size <= 4e6);
  });

  it('shows_a_sealed_valve', async () => {
    const found = await figures(page);
    assert.equal(found.measures.orifice, 0);
    assert.ok(found.measures.atRest && found.measures.underLoad);
    await page.getByTestId('verdict').getByText('Sealed').waitFor();
  });

  it('draws_the_valve', async () => {
    // the annulus spans about two thirds of the height: tissue is a fifth to a half of the picture
    const share = await shareOfTissue(page);
    assert.ok(share > 0.15 && share < 0.6, `share of tissue ${share}`);
  });

  it('opens_and_closes', async () => {
    await page.keyboard.press('o');
    await page.waitForTimeout(100);
    for (let k = 0; k < 200 && !(await page.evaluate(() => window.planner.state.motion.value)); ++k)
      await page.waitForTimeout(50);
    const span = await page.evaluate(() => {
      const { state } = window.planner;
      const [a, b] = [state.motion.value.picture.positions, state.main.value.picture.positions];
      return Math.max(...a.map((v, i) => Math.abs(v - b[i])));
    });
    assert.ok(span > 8, `the leaflets move by ${span} mm`);
    await page.keyboard.press('o');
    await closed(page);
    assert.equal(await page.evaluate(() => window.planner.state.motion.value), null);
  });

  it('previews_before_it_applies_and_undo_returns', async () => {
    const { hash } = await figures(page);
    await begin(page, 'ring');
    assert.notEqual((await figures(page)).hash, hash);
    await page.keyboard.press('Escape');
    assert.equal((await figures(page)).hash, hash);
    await begin(page, 'ring');
    await apply(page);
    assert.equal((await figures(page)).history.length, 1);
    await undo(page);
    assert.equal((await figures(page)).hash, hash);
  });

  it('shows_the_shape_first_and_marks_what_is_to_come', async () => {
    await notePreviews(page);
    await begin(page, 'ring');
    const seen = await page.evaluate(() => window.seen);
    assert.deepEqual(
      seen.map(({ known }) => known),
      ['shape', 'orifice', 'all'],
    );
    const [shape, , all] = seen;
    assert.ok(!shape.now || /Measuring…[^]*…/.test(shape.verdict), shape.verdict);
    // a list of more chordae beyond their limit than it names ends with a line of its own
    assert.doesNotMatch(all.verdict.replace(/\n…$/, ''), /…/);
    // while a newer value is tried, the older figures are marked as such
    const tags = await page.evaluate(async () => {
      const { state } = window.planner;
      const slider = document.querySelector('.form input[type=range]');
      slider.value = Number(slider.value) - 2;
      slider.dispatchEvent(new Event('input', { bubbles: true }));
      await new Promise((done) => setTimeout(done));
      return { outdated: state.outdated.value, text: document.querySelector('.verdict .tag').innerText };
    });
    assert.deepEqual(tags, { outdated: true, text: 'trying…' });
    await page.keyboard.press('Escape');
  });

  it('applies_as_soon_as_the_shape_is_there_and_adds_the_figures', async () => {
    await noteApplied(page);
    await begin(page, 'annulus_scale');
    await applyAtShape(page, 0.94);
    await page.locator('#f-factor').fill('94');
    await page.keyboard.press('Enter');
    await page.getByTestId('form').waitFor({ state: 'detached' });
    await closed(page);
    const applied = await page.evaluate(() => (window.unsubscribe(), window.applied));
    const last = applied.at(-1);
    assert.equal(applied[0].known, 'shape');
    assert.equal(last.known, 'all');
    // coaptation comes with the orifice, before the rest, and with its last value
    const early = applied.find(({ known }) => known === 'orifice');
    assert.equal(early.coaptation, last.coaptation);
    // the same figures as those of a valve that is measured at once
    const { hash, measures } = await figures(page);
    for (const key of ['Control+z', 'Control+y']) {
      await page.keyboard.press(key);
      await answered(page);
    }
    assert.deepEqual(await figures(page).then((found) => [found.hash, found.measures]), [hash, measures]);
    await undo(page);
  });

  it('keeps_the_view_while_a_number_is_changed', async () => {
    // a view that the page was asked for before, as by “Show the chord”
    await page.evaluate(() => (window.planner.state.wantedView.value = { preset: 'ventricle' }));
    await page.keyboard.press('1');
    await cameraRests(page);
    const view = () => page.evaluate(() => window.planner.viewport.camera.orientation.toArray());
    const chosen = await view();
    await begin(page, 'ring');
    await page.keyboard.press('Escape');
    await cameraRests(page);
    assert.deepEqual(await view(), chosen);
  });

  it('takes_a_typed_value_at_Enter_and_applies_it_at_the_next', async () => {
    await begin(page, 'annulus_scale');
    await page.locator('#f-factor').fill('93');
    await page.keyboard.press('Enter');
    assert.equal(await page.evaluate(() => window.planner.state.draft.value?.fields.factor), 0.93);
    await answered(page);
    await page.keyboard.press('Enter');
    await page.getByTestId('form').waitFor({ state: 'detached' });
    await closed(page);
    assert.match((await figures(page)).history.at(-1).title, /93/);
    await undo(page);
  });

  it('applies_nothing_whose_result_is_still_to_come', async () => {
    const applied = async () => (await figures(page)).history.filter((entry) => !entry.undone).length;
    const before = await applied();
    await begin(page, 'annulus_scale');
    await answered(page);
    // Enter takes the number, and further ones come before its result: also after it the form is open
    const early = await page.evaluate(() => {
      const form = document.querySelector('[data-testid=form]');
      window.planner.edit('annulus_scale', { factor: 0.91 });
      for (let k = 0; k < 3; ++k) form.requestSubmit();
      return new Promise((resolve) =>
        setTimeout(
          () =>
            resolve({
              hint: document.querySelector('[data-testid=trying]')?.innerText,
              status: document.querySelector('[data-testid=status]').innerText,
              outdated: window.planner.state.outdated.value,
            }),
          0,
        ),
      );
    });
    assert.ok(early.outdated, 'the result came before it was looked at');
    assert.match(early.status, /^Not applied: its result is still to come/);
    assert.match(early.hint, /^Not applied: its result is still to come/);
    await answered(page, 500);
    assert.equal(await page.evaluate(() => window.planner.state.draft.value?.fields.factor), 0.91);
    await page
      .getByTestId('status')
      .getByText(/^Preview: Sealed/)
      .waitFor();
    // the next press applies the preview in the picture
    await page.locator('#f-factor').focus();
    await page.keyboard.press('Enter');
    await page.getByTestId('form').waitFor({ state: 'detached' });
    await closed(page);
    assert.equal(await applied(), before + 1);
    await undo(page);
  });

  it('takes_a_value_at_Enter_whose_preview_came_by_itself', async () => {
    await begin(page, 'annulus_scale');
    await page.locator('#f-factor').fill('93');
    const drafted = () => page.evaluate(() => window.planner.state.draft.value?.fields.factor);
    // a typed number is tried after a pause
    for (let k = 0; k < 100 && (await drafted()) !== 0.93; ++k) await page.waitForTimeout(50);
    assert.equal(await drafted(), 0.93);
    await answered(page, 200);
    await page.keyboard.press('Enter');
    await page.waitForTimeout(300);
    assert.equal(await drafted(), 0.93, 'the first Enter does not apply');
    await page.keyboard.press('Enter');
    await page.getByTestId('form').waitFor({ state: 'detached' });
    await closed(page);
    assert.match((await figures(page)).history.at(-1).title, /93/);
    await undo(page);
  });

  it('says_why_an_operation_is_impossible', async () => {
    await begin(page, 'annulus_scale');
    await fillIn(page, 'factor', '9000');
    await page
      .getByRole('alert')
      .getByText(/Overall size: 9000 % is out of range/)
      .waitFor();
    await becomes(() => page.getByRole('button', { name: 'Apply', exact: true }).isDisabled(), true);
    await page.getByRole('button', { name: 'Discard' }).click();
  });

  it('shortens_a_chord_by_dragging', async () => {
    await page.keyboard.press('2');
    await cameraRests(page);
    const { place, name } = await chooseAnyChord(page, await chordNames(page));
    await page.mouse.move(place.x, place.y);
    await page.mouse.down();
    // towards the papillary head on the screen, whichever side it is on
    const direction = await chordDirection(page, name);
    for (let k = 1; k <= 10; ++k)
      await page.mouse.move(place.x + 3 * k * direction[0], place.y + 3 * k * direction[1]);
    await page.mouse.up();
    await answered(page, 200);
    const rest = async () => (await figures(page)).chords.find((chord) => chord.name === name).rest;
    const old = await page.evaluate(
      (wanted) => window.planner.state.main.value.figures.chords.find((c) => c.name === wanted).rest,
      name,
    );
    assert.ok((await rest()) < old - 0.5, `${name}: ${await rest()} of ${old} mm`);
    await apply(page);
    assert.match((await figures(page)).history[0].title, new RegExp(`Shorten chord ${name}`));
  });

  it('makes_a_report_without_a_script', async () => {
    await openPanel(page, 'Plan');
    await page.getByRole('button', { name: 'Report' }).click();
    await page.getByTestId('report').getByText('Before').first().waitFor();
    const [download] = await Promise.all([
      page.waitForEvent('download'),
      page.getByRole('button', { name: 'Save as HTML' }).click(),
    ]);
    const html = readFileSync(await download.path(), 'utf8');
    assert.equal(html.match(/<img src="data:image\/png/g).length, 4);
    assert.ok(!/<script/i.test(html));
    await page.keyboard.press('Escape');
  });

  it('connects_to_nothing', async () => {
    const refused = await page.evaluate(async () => {
      try {
        await fetch('https://example.org/');
        return false;
      } catch {
        return true;
      }
    });
    assert.ok(refused, 'the policy of the page forbids requests');
    assert.deepEqual(requests, []);
  });
});
