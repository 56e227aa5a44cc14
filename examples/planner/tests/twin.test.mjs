// The twin of the picture as text: every scallop, chord and device of a repaired valve, with the figures that the native command gives
// as JSON for the saved session, and a way to each by the keyboard alone.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { before, describe, it } from 'node:test';
import { closed, sharePlanner, temporaryFile } from './fixtures/browser.mjs';
import { repeated } from './fixtures/native.mjs';
import { answered, apply, open, openPanel, save, startAfresh, tabTo } from './fixtures/person.mjs';

/** Output of the native command for a saved session, which it repeats. */
function nativeOf(session) {
  const { json } = repeated(session);
  return {
    regions: json('leak').regions,
    chords: json('chords').chords,
    heads: json('info').heads,
    measures: json('measure').measures,
  };
}

describe('planner twin', { skip: process.env.MVS_COMMAND ? false : 'MVS_COMMAND is not set' }, () => {
  let page;
  let native;
  /** The status line after the last operation. */
  let said;
  sharePlanner((opened) => ({ page } = opened));
  const add = async (kind, fields) => {
    await page.evaluate(([operation, given]) => window.planner.edit(operation, given), [kind, fields]);
    await closed(page);
    await apply(page);
  };
  const rowsOf = async (id) => {
    const texts = await page
      .getByTestId(id)
      .locator('tbody tr')
      .evaluateAll((rows) =>
        rows.map((row) => [...row.querySelectorAll('th, td')].map((cell) => cell.innerText)),
      );
    return texts.map((row) => row.map((text) => text.replace(/\s+/g, ' ').trim()));
  };
  before(async () => {
    await openPanel(page, 'Learn');
    await page.getByRole('button', { name: 'Valve 4' }).click();
    await page.getByText('Valve 4 of the tour').waitFor();
    await closed(page);
    const parts = await page.evaluate(() => {
      const topology = window.planner.state.topologyOf(window.planner.state.main.value.picture);
      const ids = (list) => Object.fromEntries(list.map(({ name, id }) => [name, id]));
      return { heads: ids(topology.heads), scallops: ids(topology.scallops) };
    });
    await add('neochord', {
      head: parts.heads.PM3,
      site: { scallop: parts.scallops.P2, along: 0.35, height: 0.95 },
    });
    await add('band', { factor: 0.92 });
    await add('clip', { position: 0.2 });
    // said once the opening of the narrowed valve is measured
    await page
      .getByTestId('status')
      .getByText(/^Join A2 and P2 by clip/)
      .waitFor({ state: 'attached' });
    said = (await page.getByTestId('status').innerText()).replace(/\s+/g, ' ');
    native = nativeOf(await save(page));
    await openPanel(page, 'Valve');
    await page.evaluate(() => {
      for (const part of document.querySelectorAll('.panel details')) part.open = true;
    });
  });

  it('has_every_scallop_and_commissure_with_the_figures_of_the_library', async () => {
    const rows = await rowsOf('scallops');
    const wanted = native.regions.map((region) => {
      const name = region.kind === 'commissure' ? `Commissure ${region.name.replace('-', '–')}` : region.name;
      const positive = (value) => (value > 0 ? value.toFixed(1) : '–');
      return [
        name,
        region.coaptation_length_mean_mm.toFixed(1),
        positive(region.orifice_area_mm2),
        positive(region.billow_height_mm),
      ];
    });
    assert.equal(wanted.length, 8);
    // without what the value was before
    assert.deepEqual(
      rows.map(([name, coaptation, leak, billow]) => [name, coaptation.replace(/ was .*/, ''), leak, billow]),
      wanted,
    );
  });

  it('has_every_chord_with_the_figures_of_the_library', async () => {
    const chords = native.chords.filter(({ kind }) => kind !== 'suture');
    const rows = await rowsOf('chords');
    assert.equal(rows.length, chords.length);
    assert.ok(chords.length > 60);
    const of = new Map(chords.map((chord) => [chord.name, chord]));
    assert.equal(of.size, chords.length, 'names are unique');
    const kinds = { rough_zone: 'rough zone' };
    let slack = 0;
    for (const [title, share, pull, rest] of rows) {
      const [name, ...words] = title.split(' ');
      const chord = of.get(name);
      assert.ok(chord, name);
      of.delete(name);
      const artificial = name === 'P2/17';
      assert.equal(
        words.join(' ').toLowerCase(),
        artificial ? 'artificial' : (kinds[chord.kind] ?? chord.kind).replace(/_/g, ' '),
      );
      assert.equal(rest, chord.rest_length_mm.toFixed(1), name);
      assert.equal(pull, (1000 * Math.max(0, chord.tension_N)).toFixed(0), name);
      if (chord.strain <= 0) ++slack;
      assert.equal(share === 'slack', chord.strain <= 0, `${name}: ${share}`);
      // beyond the limit where the library flags it
      if (share !== 'slack') assert.equal(parseInt(share) > 100, chord.flags.length > 0, `${name}: ${share}`);
    }
    assert.equal(of.size, 0);
    assert.ok(slack > 0);
  });

  it('has_every_device_with_the_figures_of_the_library', async () => {
    const rows = new Map(await rowsOf('devices'));
    const chord = native.chords.find(({ name }) => name === 'P2/17');
    const pull = (newton) => `${(1000 * newton).toFixed(0)} mN`;
    assert.equal(
      rows.get('Artificial chord P2/17'),
      `PM3 to P2, ${chord.rest_length_mm.toFixed(1)} mm without pull, ${chord.tension_N > 0 ? `pull ${pull(chord.tension_N)}` : 'slack'}`,
    );
    const stitches = native.chords.filter(({ kind }) => kind === 'suture');
    assert.ok(stitches.length > 2 && stitches.every(({ name }) => /^clip/.test(name)));
    // the width of the form, although the outermost stitches of the closed valve are further apart
    assert.match(
      rows.get('Clip'),
      /^joins A2 and P2, 5 mm wide, \d\.\d mm towards A1\/P1 \(anterolateral\), across the edge, strongest pull /,
    );
    assert.ok(rows.get('Clip').includes(`pull ${pull(Math.max(...stitches.map(({ tension_N: n }) => n)))};`));
    assert.match(rows.get('Posterior band'), /^\d\d mm long$/);
    assert.equal(rows.size, 3);
  });

  it('says_the_result_in_one_polite_line', async () => {
    const lines = page.locator('[aria-live=polite]');
    assert.equal(await lines.count(), 1);
    const m = native.measures;
    assert.match(said, /^Join A2 and P2 by clip/);
    assert.ok(said.includes(`Coaptation ${m.coaptation_length_mean_mm.toFixed(1)} mm`), said);
    if (m.regurgitant_orifice_area_mm2 > 0)
      assert.ok(said.includes(`Leak ${m.regurgitant_orifice_area_mm2.toFixed(1)} mm²`), said);
    assert.ok(!said.includes('Sealed.'), said);
  });

  it('leads_to_every_chord_head_and_scallop_by_the_keyboard', async () => {
    await startAfresh(page);
    // a chord: the list of the panel
    await page.keyboard.press('v');
    await tabTo(page, /^ *Chordae \(/);
    if (!(await page.getByTestId('chords').isVisible())) await page.keyboard.press('Enter');
    await page.getByTestId('chords').waitFor();
    const buttons = await page.getByTestId('chords').getByRole('button').allInnerTexts();
    assert.equal(buttons.length, native.chords.filter(({ kind }) => kind !== 'suture').length);
    // the focus is on the list now; each row is the next step
    for (const name of buttons.slice(0, 4)) {
      await page.keyboard.press('Tab');
      const focus = await page.evaluate(() => document.activeElement.textContent);
      assert.equal(focus, name);
    }
    await page.keyboard.press('Enter');
    await page
      .getByTestId('chosen')
      .getByText(new RegExp(`Chord ${buttons[3]}\\b`))
      .waitFor();
    await page.keyboard.press('Escape');
    // heads and scallops: in the lists of forms
    const listed = async (operation, field) => {
      await page.keyboard.press('r');
      await tabTo(page, operation);
      await page.keyboard.press('Enter');
      await answered(page, 200);
      const options = await page.locator(`#f-${field} option`).allInnerTexts();
      await tabTo(page, new RegExp(`^f-${field} `));
      await page.keyboard.press('Escape');
      await page.keyboard.press('Escape');
      return options.slice(1);
    };
    assert.deepEqual(
      await listed(/neochord/, 'head'),
      native.heads.map(({ name }) => name),
    );
    assert.deepEqual(
      await listed(/resect/, 'scallop'),
      native.regions.filter(({ kind }) => kind !== 'commissure').map(({ name }) => name),
    );
  });

  it('names_a_clip_by_its_chosen_width_in_the_history_and_by_its_stitches_without_one', async () => {
    await openPanel(page, 'Plan');
    const steps = await page.getByTestId('history').locator('li').allInnerTexts();
    assert.match(
      steps.at(-1).replace(/\s+/g, ' '),
      /^Join A2 and P2 by clip, 5 mm wide, \d\.\d mm towards A1\/P1 \(anterolateral\), across the edge$/,
    );
    const [download] = await Promise.all([
      page.waitForEvent('download'),
      page.getByRole('button', { name: 'Valve as OBJ' }).click(),
    ]);
    const path = temporaryFile('clip.obj', readFileSync(await download.path()));
    await open(page, path);
    await openPanel(page, 'Valve');
    const rows = new Map(await rowsOf('devices'));
    assert.match(rows.get('Clip'), /^joins A2 and P2, outermost stitches \d mm apart, strongest pull /);
  });
});
