// Every control has a tooltip in a surgeon's words, which comes by the keyboard as it does under the mouse.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { beforeEach, describe, it } from 'node:test';
import { fileURLToPath } from 'node:url';
import { closed, sharePlanner, temporaryFile } from './fixtures/browser.mjs';
import { answered, apply, begin, open, openLeaflets, openPanel, startAfresh } from './fixtures/person.mjs';

/** The seen controls of the page with their visible words and their tooltips; closed parts of panels are opened. */
function controls(page, within = 'body') {
  return page.evaluate((root) => {
    for (const part of document.querySelectorAll('details')) part.open = true;
    const all = 'button, input, select, textarea, summary, canvas, a[href]';
    return [...document.querySelector(root).querySelectorAll(all)]
      .filter((control) => control.getClientRects().length)
      .map((control) => ({
        name: (control.ariaLabel || control.labels?.[0]?.textContent || control.textContent).trim(),
        tip:
          control.closest('[title]:not([title=""])')?.title ??
          document.getElementById(control.getAttribute('aria-describedby'))?.textContent ??
          '',
      }));
  }, within);
}

/** Names of scallops, chordae, heads, formats, and keys in brackets at the end have no unit. */
const names = /\b[AP][123](?:[-–/][AP]?\d+)?\b|\b(?:AL|PM)\d\b|\([^()]*\)$/g;
const units = /^\s*(?:mm²?|cm²|mN|N|MPa|mmHg|ml\/s|ml|%|°)(?![\w])/;

/** The fault of a tooltip, in words; empty for a good one. */
function fault({ name, tip }) {
  const words = tip.replace(/\s*\([^()]*\)$/, '');
  if (words.length < 8 || words === name) return `“${name}” has the tooltip “${tip}”`;
  if (/\w_\w|[[\]{}]|undefined|NaN|Young|parametric|\bMVS|\d[eE][-+]?\d|\bnode\b|\bmodulus\b/.test(words))
    return `“${name}” says “${tip}” by an internal name`;
  const bare = tip.replace(names, '');
  for (const { index, 0: digits } of bare.matchAll(/\d+(?:[.,]\d+)?/g))
    if (!units.test(bare.slice(index + digits.length)))
      return `“${name}” has a number without unit: “${tip}”`;
  return '';
}

const faults = (list) => [...new Set(list.map(fault).filter(Boolean))];

/** The control that has the focus and its tooltip, and the text of the box if it is seen whole. */
function focusedTip(page) {
  return page.evaluate(() => {
    const control = document.activeElement;
    const box = document.querySelector('[data-testid=tip]');
    const rect = box.getBoundingClientRect();
    const whole =
      rect.width > 0 &&
      rect.left >= 0 &&
      rect.top >= 0 &&
      rect.right <= innerWidth &&
      rect.bottom <= innerHeight;
    const of = control.getBoundingClientRect();
    const covers =
      rect.left < of.right && of.left < rect.right && rect.top < of.bottom && of.top < rect.bottom;
    return {
      tag: control.tagName,
      name: control.ariaLabel || control.labels?.[0]?.textContent || control.textContent,
      title: control.closest('[title]:not([title=""])')?.title ?? '',
      said: whole ? box.textContent : '',
      covers: control.tagName !== 'CANVAS' && covers,
    };
  });
}

describe('planner tooltips', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));
  beforeEach(() => startAfresh(page));

  it('are_on_every_control_of_the_panels', async () => {
    const found = [];
    for (const panel of ['Learn', 'Valve', 'Repair', 'Plan']) {
      await openPanel(page, panel);
      found.push(...(await controls(page)));
    }
    await begin(page, 'ring');
    found.push(...(await controls(page)));
    await openPanel(page, 'Valve');
    found.push(...(await controls(page)));
    await openPanel(page, 'Repair');
    await apply(page);
    await openPanel(page, 'Plan');
    await page.getByRole('button', { name: 'Keep this plan' }).click();
    await page.getByRole('button', { name: 'Compare' }).click();
    await answered(page, 200);
    found.push(...(await controls(page)));
    await page.getByRole('button', { name: /^Rename/ }).click();
    found.push(...(await controls(page)));
    await page.keyboard.press('Escape');
    await page.getByRole('button', { name: /^Delete/ }).click();
    await page.getByRole('button', { name: 'Put it back' }).waitFor();
    found.push(...(await controls(page)));
    assert.ok(new Set(found.map(({ name }) => name)).size > 150);
    assert.deepEqual(faults(found), []);
  });

  it('are_on_every_control_of_the_forms_that_are_made_from_the_table_of_operations', async () => {
    const kinds = await page.evaluate(() => window.planner.state.operations.value.map(({ name }) => name));
    for (const kind of kinds) {
      await begin(page, kind);
      const found = await controls(page, '.form');
      // every field that the form shows, leave, apply and discard
      assert.ok(found.length > 3, kind);
      assert.deepEqual(faults(found), [], kind);
      await page.keyboard.press('Escape');
      await page.keyboard.press('Escape');
    }
    // a place that was picked has two sliders of its own
    await begin(page, 'neochord');
    await page.locator('#f-site').selectOption({ label: 'P2' });
    await closed(page);
    assert.deepEqual(faults(await controls(page, '.form')), []);
    await page.keyboard.press('Escape');
    await page.keyboard.press('Escape');
    // the outline while it is drawn
    await begin(page, 'resect');
    await page.getByRole('button', { name: 'Draw the cut' }).click();
    assert.deepEqual(faults(await controls(page, '.form')), []);
  });

  it('are_on_what_can_be_done_with_a_chosen_part', async () => {
    // the form of the test before, after its outline
    await page.keyboard.press('Escape');
    for (const kind of ['chord', 'head', 'scallop']) {
      await page.evaluate((part) => {
        const { state } = window.planner;
        const topology = state.topologyOf(state.main.value.picture);
        state.choice.value = {
          kind: part,
          id: topology[{ chord: 'chords', head: 'heads', scallop: 'scallops' }[part]][0].id,
        };
        state.panel.value = 'repair';
      }, kind);
      await page.getByTestId('chosen').waitFor();
      assert.deepEqual(faults(await controls(page, '[data-testid=chosen]')), [], kind);
    }
  });

  it('are_in_dialogs_in_the_tour_and_at_an_import', async () => {
    await page.keyboard.press('?');
    await page.locator('dialog').waitFor();
    assert.deepEqual(faults(await controls(page, 'dialog')), []);
    // the tooltip stands over the dialog
    await page.keyboard.press('Tab');
    const { said, title } = await focusedTip(page);
    assert.equal(said, title);
    await page.keyboard.press('Escape');
    await openPanel(page, 'Plan');
    await page.getByRole('button', { name: 'Report' }).click();
    await page.locator('dialog').waitFor();
    assert.deepEqual(faults(await controls(page, 'dialog')), []);
    await page.keyboard.press('Escape');
    await openPanel(page, 'Learn');
    await page.getByRole('button', { name: 'Valve 2' }).click();
    await answered(page, 200);
    assert.deepEqual(faults(await controls(page)), []);
    await open(page, temporaryFile('leaflets.obj', await openLeaflets(page)));
    await page.getByRole('tab', { name: 'Import' }).waitFor();
    assert.deepEqual(faults(await controls(page)), []);
    await page.getByRole('button', { name: 'Leave' }).click();
    await closed(page);
  });

  it('come_with_the_focus_of_the_keyboard_and_leave_with_it', async () => {
    await begin(page, 'neochord');
    await page.locator('header button').first().focus();
    const seen = new Set();
    for (let k = 0; k < 60; ++k) {
      await page.keyboard.press('Tab');
      const { tag, name, title, said, covers } = await focusedTip(page);
      if (tag === 'BODY') break;
      // the picture has a description instead of a title
      if (tag !== 'CANVAS') assert.equal(said, title, `the tooltip of “${name}”`);
      assert.ok(said && !covers, `“${name}”: ${said}`);
      seen.add(`${name} ${said}`);
    }
    assert.ok(seen.size > 20, `${seen.size} controls`);
    const box = page.getByTestId('tip');
    await page.keyboard.press('Tab');
    await page.keyboard.press('Shift+Tab');
    assert.ok(await box.isVisible());
    await page.mouse.click(5, 5);
    assert.ok(!(await box.isVisible()), 'a press hides it');
    await page.locator('#f-site').click();
    assert.ok(!(await box.isVisible()), 'the mouse has the tooltip of the browser');
  });

  it('have_all_their_words_in_the_file_of_texts', () => {
    const folder = join(dirname(fileURLToPath(import.meta.url)), '../src/ui');
    for (const file of readdirSync(folder)) {
      const source = readFileSync(join(folder, file), 'utf8');
      assert.ok(!/\btitle="[^"]/.test(source), file);
      assert.ok(!/title=\{['`][A-Za-z]/.test(source), file);
    }
  });
});
