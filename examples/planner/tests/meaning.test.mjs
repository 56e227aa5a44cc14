// The words of the page: what each figure means, what a range is, one word for one thing; and that words cover nothing: tooltips,
// notices, the card of the verdict; sections of panels that stay open.
import assert from 'node:assert/strict';
import { beforeEach, describe, it } from 'node:test';
import { closed, figures, sharePlanner } from './fixtures/browser.mjs';
import { answered, apply, begin, openPanel, startAfresh, tabTo, undo } from './fixtures/person.mjs';

const flat = (text) => text.replace(/\s+/g, ' ').trim();

describe('planner words', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));
  beforeEach(() => startAfresh(page));
  const help = () => page.getByTestId('figure-help');
  const focusedButton = () =>
    page.evaluate(() => document.activeElement.closest('button')?.textContent.trim());
  const openSections = async () => {
    const shut = page.locator('.panel details:not([open]) > summary');
    while (await shut.count()) await shut.first().click();
  };

  it('explains_each_figure_that_it_shows', async () => {
    await openPanel(page, 'Valve');
    await openSections();
    await page.locator('#flow').fill('200');
    await page.keyboard.press('Tab');
    await page.getByRole('button', { name: 'Measure the open area' }).click();
    await page.getByText('Mean pressure gradient').waitFor();
    const labels = await page.locator('.figure-label').allInnerTexts();
    assert.ok(labels.length > 15, labels.join());
    const heads = await page
      .locator('[data-testid=scallops] th, [data-testid=chords] thead th')
      .allInnerTexts();
    await page.getByRole('button', { name: 'What the figures mean' }).click();
    const terms = (await help().locator('dt span').allInnerTexts()).map((term) => term.split(',')[0]);
    const missing = [...labels, ...heads.filter((head) => /,|%/.test(head))]
      .map((label) => flat(label).replace(/^Pull on (AL|PM)\d$/, 'Pull on a papillary head'))
      .filter((label) => !terms.includes(label.split(',')[0]));
    assert.deepEqual(missing, []);
    // each with a sentence, a unit and how it is measured
    for (const words of await help().locator('dd').allInnerTexts())
      assert.match(flat(words), /^[A-Z“].{20,}[.!] Unit: \S.*\. Measured: .{15,}\.$/);
    // the scallops as the surgeon sees them: anterior above, 1 on the left
    const places = await help()
      .locator('.sketch-name')
      .evaluateAll((all) => Object.fromEntries(all.map((e) => [e.textContent, e.getBoundingClientRect()])));
    for (const row of ['A', 'P']) {
      assert.ok(places[`${row}1`].x < places[`${row}2`].x && places[`${row}2`].x < places[`${row}3`].x);
    }
    for (const k of [1, 2, 3]) assert.ok(places[`A${k}`].y < places[`P${k}`].y);
    await page.keyboard.press('Escape');
  });

  it('is_read_by_keys_and_gives_the_focus_back', async () => {
    await openPanel(page, 'Valve');
    await tabTo(page, /What the figures mean/);
    await page.keyboard.press('Enter');
    await help().waitFor();
    // seen from its top, and nothing over it
    const { y } = await help().boundingBox();
    assert.ok(y > 50, `begins at ${y}`);
    assert.ok(!(await page.getByTestId('tip').isVisible()));
    await page.keyboard.press('Escape');
    await help().waitFor({ state: 'detached' });
    assert.equal(await focusedButton(), 'What the figures mean');
    // by its key, and by the list of keys
    await page.keyboard.press('f');
    await help().waitFor();
    await page.locator('dialog').getByRole('button', { name: 'Close' }).click();
    await help().waitFor({ state: 'detached' });
    await page.keyboard.press('?');
    await page.locator('dialog').getByRole('button', { name: 'What the figures mean' }).click();
    await help().waitFor();
    await page.keyboard.press('Escape');
  });

  it('says_what_its_ranges_are', async () => {
    await begin(page, 'ring');
    await page.locator('#f-size').fill('24');
    await page.keyboard.press('Tab');
    await answered(page, 200);
    await apply(page);
    await openPanel(page, 'Valve');
    await openSections();
    await page.getByRole('button', { name: /How certain/ }).click();
    await answered(page, 300);
    const ranges = (await page.locator('.figure .spread').allInnerTexts()).map(flat);
    assert.ok(ranges.length > 2);
    for (const range of ranges) assert.match(range, /^[\d.]+ to [\d.]+ over \d closures$/);
    // in a table it is said once, below or above
    const sections = page.locator('.section', { has: page.locator('table .spread') });
    for (const section of await sections.all())
      assert.match(flat(await section.innerText()), /range over \d closures from different folds/);
    // and no card is wider than the panel
    const wide = await page.evaluate(() => {
      const panel = document.querySelector('.panel');
      return panel.scrollWidth - panel.clientWidth;
    });
    assert.equal(wide, 0);
    await undo(page);
  });

  it('has_one_word_for_each_thing', async () => {
    // an artificial chord in the history, a kept plan, one that was deleted
    await page.evaluate(() => {
      const topology = window.planner.state.topologyOf(window.planner.state.main.value.picture);
      const id = (list, name) => list.find((part) => part.name === name).id;
      const site = { scallop: id(topology.scallops, 'P2'), along: 0.5, height: 0.95 };
      window.planner.edit('neochord', { head: id(topology.heads, 'PM1'), site });
    });
    await answered(page, 200);
    const seen = [];
    const read = async () =>
      seen.push(
        ...(await page.evaluate(() => [
          document.body.innerText,
          ...[...document.querySelectorAll('[title]')].map((e) => e.title),
          ...[...document.querySelectorAll('[aria-label]')].map((e) => e.ariaLabel),
          ...[...document.querySelectorAll('[placeholder]')].map((e) => e.placeholder),
        ])),
      );
    await read();
    await apply(page);
    await openPanel(page, 'Plan');
    await page.getByRole('button', { name: 'Keep this plan' }).click();
    await answered(page);
    for (const panel of ['Valve', 'Repair', 'Learn', 'Plan']) {
      await openPanel(page, panel);
      await openSections();
      await read();
    }
    await page.getByRole('button', { name: 'Report' }).click();
    await page.waitForTimeout(500);
    await read();
    await page.keyboard.press('Escape');
    for (const key of ['?', 'f']) {
      await page.keyboard.press(key);
      await read();
      await page.keyboard.press('Escape');
    }
    await page.getByRole('button', { name: 'Delete “Plan 1”' }).click();
    await answered(page, 200);
    await read();
    const found = seen.flatMap((text) => text.match(/[^\n]*(?:\bslice|checkpoint|neochord)[^\n]*/gi) ?? []);
    assert.deepEqual([...new Set(found)], []);
    await undo(page);
  });

  it('keeps_sections_open_that_were_opened', async () => {
    await openPanel(page, 'Valve');
    const summary = (name) => page.locator('.panel summary', { hasText: name });
    const isOpen = (name) => summary(name).evaluate((e) => e.parentElement.open);
    for (const name of ['Physics', 'How far it opens', 'Chordae'])
      if (!(await isOpen(name))) await summary(name).click();
    if (await isOpen('Annulus')) await summary('Annulus').click();
    await begin(page, 'annulus_scale');
    await apply(page);
    await openPanel(page, 'Valve');
    for (const name of ['Physics', 'How far it opens', 'Chordae']) assert.ok(await isOpen(name), name);
    assert.ok(!(await isOpen('Annulus')), 'a section that was closed stays closed');
    await summary('Annulus').click();
    await undo(page);
    assert.ok(await isOpen('Physics'));
  });

  it('covers_no_goal_by_a_tooltip', async () => {
    await openPanel(page, 'Learn');
    await page.getByRole('button', { name: 'Valve 1' }).click();
    await page.getByTestId('score').getByText('Before illness').waitFor();
    await closed(page);
    await page.getByRole('tab', { name: 'Learn' }).focus();
    let seen = 0;
    for (let k = 0; k < 12; ++k) {
      await page.keyboard.press('Tab');
      const covered = await page.evaluate(() => {
        const a = document.querySelector('[data-testid=tip]').getBoundingClientRect();
        if (!a.width || !document.activeElement.closest('.panel')) return null;
        return [...document.querySelectorAll('.goals, .panel h3, .panel p')].filter((part) => {
          const b = part.getBoundingClientRect();
          return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
        }).length;
      });
      if (covered === null) continue;
      ++seen;
      assert.equal(covered, 0, await page.evaluate(() => document.activeElement.textContent));
    }
    assert.ok(seen > 4, `${seen} tooltips`);
  });

  it('leaves_the_keys_of_the_colours_where_they_are_when_a_notice_comes', async () => {
    const top = async () => (await page.locator('.scale').boundingBox()).y;
    const before = await top();
    await page.evaluate(() => {
      const action = { text: 'Return to it', run() {} };
      window.planner.state.notice.value = { kind: 'info', text: 'The changed plan was closed.', action };
    });
    const close = page.getByTestId('notice').getByRole('button', { name: 'Close' });
    await close.hover();
    await page.waitForTimeout(100);
    assert.equal(await top(), before);
    // its words are seen under the mouse
    const [ink, ground] = await close.evaluate((button) => {
      const light = (colour) => {
        const [r, g, b, a = 1] = colour.match(/[\d.]+/g).map(Number);
        return (a * (r + g + b)) / 765;
      };
      const style = getComputedStyle(button);
      return [light(style.color), light(style.backgroundColor)];
    });
    assert.ok(ink - ground > 0.5, `ink ${ink} on ${ground}`);
    await close.click();
  });

  it('writes_the_whole_verdict', async () => {
    await openPanel(page, 'Learn');
    await page.getByRole('button', { name: 'Valve 3' }).click();
    await page.getByTestId('score').getByText('Before illness').waitFor();
    await closed(page);
    const cut = () =>
      page.evaluate(() => {
        const card = document.querySelector('.verdict');
        const lines = [card, ...card.querySelectorAll('*')].filter(
          (e) => e.scrollWidth > e.clientWidth + 1 && getComputedStyle(e).overflowX !== 'visible',
        );
        return [
          ...lines.map((e) => e.className),
          card.scrollHeight > card.clientHeight ? 'too high' : '',
        ].join('');
      });
    assert.equal(await cut(), '');
    // many lines: a narrow ring with overloaded chordae
    await begin(page, 'ring');
    await page.locator('#f-size').fill('24');
    await page.keyboard.press('Tab');
    await answered(page, 200);
    await apply(page);
    await page.getByText('is below the goal').first().waitFor();
    assert.ok((await figures(page)).measures.chordsOver > 0);
    assert.equal(await cut(), '');
    await undo(page);
  });
});
