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
