// Forms come from the table of operations that the library gives: an operation with a name that the page has never heard of shows,
// previews and applies.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { closed, figures, sharePlanner } from './fixtures/browser.mjs';
import { answered, apply, openPanel } from './fixtures/person.mjs';

/**
 * Stands between page and worker as a later version of the library would: one operation, and its fields, have new names, labels
 * and helps. `known`: its present name.
 */
function renameOperation({ known, name, help, fields }) {
  const { postMessage } = Worker.prototype;
  const back = Object.fromEntries(Object.entries(fields).map(([old, field]) => [field.name, old]));
  Worker.prototype.postMessage = function (message, ...rest) {
    const { argument } = message;
    if (argument?.kind !== name) return postMessage.call(this, message, ...rest);
    const old = Object.entries(argument.fields).map(([field, value]) => [back[field] ?? field, value]);
    return postMessage.call(
      this,
      { ...message, argument: { ...argument, kind: known, fields: Object.fromEntries(old) } },
      ...rest,
    );
  };
  const { set } = Object.getOwnPropertyDescriptor(Worker.prototype, 'onmessage');
  Object.defineProperty(Worker.prototype, 'onmessage', {
    set(listener) {
      set.call(this, (event) => {
        const operation = event.data.result?.operations?.find((one) => one.name === known);
        if (operation) {
          Object.assign(operation, { name, help });
          for (const field of operation.fields) Object.assign(field, fields[field.name]);
        }
        listener.call(this, event);
      });
    },
  });
}

describe('planner forms', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened), {
    prepare: (context) =>
      context.addInitScript(renameOperation, {
        known: 'annulus_scale',
        name: 'annulus_cinch',
        help: 'Cinch the annulus by a thread',
        fields: {
          factor: { name: 'pull', label: 'pull of the thread', help: 'As a share of the present size' },
        },
      }),
  });

  it('show_an_operation_that_the_page_does_not_know_and_apply_it', async () => {
    const before = await figures(page);
    await openPanel(page, 'Repair');
    const card = page.locator('[data-operation=annulus_cinch]');
    if (!(await card.isVisible())) await page.getByText('More operations').click();
    assert.match(await card.innerText(), /annulus cinch/i);
    assert.equal(await page.locator('[data-operation=annulus_scale]').count(), 0);
    await card.click();
    await closed(page);
    const form = page.getByTestId('form');
    assert.match(await form.innerText(), /Cinch the annulus by a thread[^]*pull of the thread/i);
    await page.locator('#f-pull').fill('0.9');
    await page.keyboard.press('Tab');
    await answered(page, 150);
    const preview = await figures(page);
    assert.ok(preview.measures.annulusAp < 0.95 * before.measures.annulusAp, 'no preview');
    await apply(page);
    const { measures, history } = await figures(page);
    assert.ok(Math.abs(measures.annulusAp - preview.measures.annulusAp) < 1e-6);
    assert.equal(history.length, 1);
  });

  it('say_where_a_number_is_beyond_its_slider_and_a_ring_too_wide', async () => {
    await openPanel(page, 'Repair');
    await page.locator('[data-operation=ring]').click();
    await closed(page);
    const form = page.getByTestId('form');
    const slider = form.locator('input[type=range]').first();
    const annulus = (await page.evaluate(() => window.planner.state.main.value)).figures.measures.annulusCc;
    for (const [size, beyond, wide] of [
      ['50', true, true],
      ['10', true, false],
      ['40', false, true],
      ['28', false, false],
    ]) {
      await page.locator('#f-size').fill(size);
      await page.keyboard.press('Tab');
      await answered(page, 150);
      const text = (await form.innerText()).replace(/\u00a0/g, ' ');
      assert.equal(/Rings are made in sizes of 24 to 40 mm/.test(text), beyond, size);
      assert.equal(
        text.includes(`${size} mm is beyond the slider, which goes from 24 to 40 mm`),
        beyond,
        size,
      );
      assert.equal((await slider.getAttribute('class')) === 'beyond', beyond, size);
      const more = (size - annulus).toFixed(1);
      assert.equal(text.includes(`Oversized: ${more} mm wider than the annulus`), wide, size);
      if (!wide) continue;
      await page
        .getByTestId('opening')
        .getByText(/Opens to \d/)
        .waitFor();
      await page
        .getByTestId('opening')
        .getByText(/without it \d/)
        .waitFor();
      assert.doesNotMatch(await form.innerText(), /smaller ring/, `a ring of ${size} mm`);
    }
    await page.getByRole('button', { name: 'Discard' }).click();
    await closed(page);
  });

  it('compare_openings_to_no_more_than_is_known_of_them', async () => {
    await openPanel(page, 'Repair');
    await page.locator('[data-operation=ring]').click();
    await closed(page);
    const opening = page.getByTestId('opening');
    await opening.getByText(/without it \d/).waitFor();
    for (const [share, same] of [
      [1.013, true],
      [0.985, true],
      [1.04, false],
      [0.9, false],
    ]) {
      await page.evaluate((part) => {
        const { state } = window.planner;
        const [before, now] = [state.main, state.preview].map((one) => one.value.figures.hash);
        const open = state.openings.value.get(before);
        state.openings.value = new Map([
          ...state.openings.value,
          [now, { ...open, hash: now, openArea: part * open.openArea }],
        ]);
      }, share);
      await page.waitForTimeout(100);
      assert.equal(/about the same as without it/.test(await opening.innerText()), same, `${share}`);
    }
    await page.getByRole('button', { name: 'Discard' }).click();
    await closed(page);
  });

  it('of_a_clip_begin_at_the_chosen_scallop_and_say_its_place', async () => {
    await page.evaluate(() => {
      const { state } = window.planner;
      const { scallops } = state.topologyOf(state.main.value.picture);
      state.choice.value = { kind: 'scallop', id: scallops.find(({ name }) => name === 'P2').id };
    });
    await page.getByTestId('chosen').getByRole('button', { name: 'Clip' }).click();
    await closed(page);
    for (const [field, name] of [
      ['#f-anterior', 'A2'],
      ['#f-posterior', 'P2'],
    ])
      assert.equal(await page.locator(`${field} option:checked`).innerText(), name);
    await page.locator('#f-position').fill('40');
    await page.keyboard.press('Tab');
    await answered(page, 150);
    assert.equal(await page.evaluate(() => window.planner.state.draft.value.fields.position), 0.4);
    const { history } = await figures(page);
    const [place] = history.at(-1).title.match(/\d\.\d mm towards A1/);
    const said = await page.locator('.field', { has: page.locator('#f-position') }).innerText();
    const field = said.replace(/\u00a0/g, ' ');
    assert.match(field, new RegExp(`40 % of the way to the anterolateral end[^]*In the preview: ${place}`));
    await page.getByRole('button', { name: 'Discard' }).click();
    await closed(page);
    await page.keyboard.press('Escape');
  });

  it('have_controls_for_every_operation_of_the_library', async () => {
    const kinds = await page.evaluate(() => window.planner.state.operations.value.map(({ name }) => name));
    assert.ok(kinds.length >= 12, kinds.join());
    for (const kind of kinds) {
      await openPanel(page, 'Repair');
      const card = page.locator(`[data-operation=${kind}]`);
      if (!(await card.isVisible())) await page.getByText('More operations').click();
      await card.click();
      const form = page.getByTestId('form');
      await form.waitFor();
      // at least one of its fields beside Apply and Discard, without opening anything
      const fields = await form.locator('[id^=f-]:visible').count();
      assert.ok(fields >= 1, `${kind} has no field`);
      await page.getByRole('button', { name: 'Discard' }).click();
      await closed(page);
    }
  });
});
