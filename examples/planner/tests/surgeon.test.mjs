// Stumbles of surgeons new to the page: names, figures and forms that did not say what the picture showed.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { closed, figures, sharePlanner } from './fixtures/browser.mjs';
import {
  answered,
  apply,
  begin,
  cameraRests,
  chordNames,
  chordPlace,
  openPanel,
  shareOfTissue,
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
    assert.match(await link.innerText(), /\S+ \d{3}\s%/);
    await link.click();
    const { name } = await choice();
    assert.ok((await figures(page)).chords.find((chord) => chord.name === name).over);
    assert.match(await page.locator('.label-chord').innerText(), /\d{3}\s% of its limit/);
    assert.match(await page.getByTestId('chosen').innerText(), /may tear/);
    await undo(page);
  });
});
