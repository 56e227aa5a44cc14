// Stumbles of surgeons new to the page: names, figures and forms that did not say what the picture showed; what each figure and each
// range means, one word for one thing, sections of panels that stay open.
import assert from 'node:assert/strict';
import { beforeEach, describe, it } from 'node:test';
import { closed, figures, sharePlanner } from './fixtures/browser.mjs';
import {
  answered,
  apply,
  begin,
  cameraRests,
  chordNames,
  chordPlace,
  fillIn,
  openPanel,
  shareOfTissue,
  startAfresh,
  tabTo,
  tieP2,
  undo,
} from './fixtures/person.mjs';

describe('planner as a surgeon reads it', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));
  const drawn = () => page.waitForTimeout(250);
  const choice = () =>
    page.evaluate(() => {
      const { state } = window.planner;
      const { value } = state.choice;
      const topology = state.topologyOf(state.main.value.picture);
      const parts = { chord: topology.chords, head: topology.heads, scallop: topology.scallops };
      return value && { kind: value.kind, name: parts[value.kind].find(({ id }) => id === value.id).name };
    });

  it('shows_no_daylight_between_leaflets_that_meet', async () => {
    // in the middle of the picture there is nothing but tissue
    const share = 1 - (await shareOfTissue(page, { box: [0.3, 0.35, 0.4, 0.4], margin: 15 }));
    // where the middles of the leaflets are drawn it is 1e-3
    assert.ok(share < 2e-4, `share of daylight and chordae ${share}`);
  });

  it('names_scallops_on_their_own_tissue', async () => {
    for (const view of ['1', '3', '2']) {
      await page.keyboard.press(view);
      await cameraRests(page);
      await drawn();
      const labels = await page.locator('.label-scallop:visible').all();
      assert.ok(labels.length >= 3, `${labels.length} names in view ${view}`);
      for (const label of labels) {
        const name = await label.innerText();
        const box = await label.boundingBox();
        await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
        const chosen = await choice();
        // a chord or a head may stand before the tissue
        if (chosen?.kind === 'scallop') assert.equal(chosen.name, name, `view ${view}`);
      }
      await page.keyboard.press('Escape');
      assert.equal(await choice(), null);
    }
  });

  it('follows_a_chord_that_is_clicked_while_a_form_has_another', async () => {
    await page.keyboard.press('2');
    await cameraRests(page);
    const names = await chordNames(page);
    const seen = [];
    for (const name of names) seen.push(await chordPlace(page, name));
    await begin(page, 'chord_remove');
    await page.locator('#f-chord').selectOption({ label: names[0] });
    await closed(page);
    for (const [k, name] of names.entries()) {
      for (const place of k ? seen[k].places : []) {
        await page.mouse.click(place.x, place.y);
        const now = await choice();
        const form = await page.locator('#f-chord option:checked').innerText();
        if (now?.kind === 'chord') assert.equal(form, now.name);
        if (form === name) {
          await closed(page);
          assert.match(await page.getByTestId('chosen').innerText(), new RegExp(`Chord ${name}\\b`));
          return page.keyboard.press('Escape');
        }
      }
    }
    assert.fail('no chord was seen');
  });

  it('changes_nothing_where_a_length_is_as_at_present', async () => {
    const { chords } = await figures(page);
    await begin(page, 'chord_length');
    await page.locator('#f-chord').selectOption({ label: chords[0].name });
    await answered(page, 100);
    const now = (await figures(page)).chords[0];
    assert.equal(now.rest, chords[0].rest);
    assert.ok(!(await page.getByTestId('chosen').innerText()).includes('→'));
    await page.keyboard.press('Escape');
  });

  it('says_how_long_a_band_is_and_whose_figures_an_open_valve_shows', async () => {
    await begin(page, 'band');
    await apply(page);
    await openPanel(page, 'Valve');
    assert.match(await page.getByTestId('devices').innerText(), /Posterior band\s+[\d.]+\smm long/);
    await page.keyboard.press('o');
    await page.getByTestId('verdict').getByText('when closed').waitFor();
    await page.keyboard.press('w');
    // as long as a wrong word would need to be drawn
    await page.waitForTimeout(300);
    assert.doesNotMatch(await page.getByTestId('verdict').innerText(), /before/);
    await page.keyboard.press('o');
    await closed(page);
    await undo(page);
  });

  it('names_the_chordae_beyond_their_limit_and_shows_them', async () => {
    await begin(page, 'annulus_scale');
    await page.locator('#f-factor').fill('120');
    await page.keyboard.press('Enter');
    await apply(page);
    const link = page.getByTestId('verdict').getByRole('button').first();
    assert.match(await link.innerText(), /\S+ (?:\d{3}\s%|[\d.]+ times)/);
    await link.click();
    const { name } = await choice();
    assert.ok((await figures(page)).chords.find((chord) => chord.name === name).over);
    assert.match(
      await page.locator('.label-chord').innerText(),
      /\d{3}\s% of its limit|far beyond its limit/,
    );
    assert.match(await page.getByTestId('chosen').innerText(), /may tear/);
    await undo(page);
  });
});

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
    await help().locator('dt span').first().waitFor();
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
    await fillIn(page, 'size', '24');
    await apply(page);
    await openPanel(page, 'Valve');
    await openSections();
    await page.getByRole('button', { name: /Close it 8 times/ }).click();
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
    await tieP2(page);
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
});
