// What is doubtful about a valve file is said where it is opened: its size, its own load, leaflets that are not those of a mitral valve, and
// what the library warns of. Until it is closed no figures of the valve before stand beside it.
import assert from 'node:assert/strict';
import { beforeEach, describe, it } from 'node:test';
import { closed, figures, sharePlanner, temporaryFile } from '../fixtures/browser.mjs';
import {
  changedValve,
  crossingValve,
  inOtherUnit,
  otherLeaflets,
  withoutCommand,
  withoutScallops,
} from '../fixtures/doubtful.mjs';
import { answered, begin, open, openPanel, startAfresh } from '../fixtures/person.mjs';

const flat = (text) => text.replace(/\s+/g, ' ').trim();

describe('planner valve files', { skip: withoutCommand }, () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));
  beforeEach(() => startAfresh(page));

  const card = async () => flat(await page.getByTestId('verdict').innerText());
  const said = async (path) => {
    await open(page, path);
    await closed(page);
    return flat((await page.getByTestId('notice').allInnerTexts()).join(' '));
  };

  it('in_another_unit_are_named_with_what_the_library_warns_of', async () => {
    const notice = await said(inOtherUnit('tenth.obj', 0.1));
    assert.match(notice, /^The annulus of this valve is 3\.5 mm wide; those of patients are 8 to 80 mm\./);
    assert.match(notice, /Leaflet A is 0\.8 mm thick, which is too much/);
    assert.match(notice, /Chord A2\/1 is [\d.]+ mm long at rest/);
    assert.doesNotMatch(notice, /in m\b|mvs remesh/);
    assert.match(await card(), /annulus 3\.5 mm wide: is its file in mm\?/);
    // it stays until it is closed
    await page.waitForTimeout(9000);
    assert.equal(await page.getByTestId('notice').count(), 1);
  });

  it('with_leaflets_that_cross_bring_the_warning_of_the_library', async () => {
    assert.match(await said(crossingValve()), /pairs of triangles cross/);
  });

  it('with_another_load_are_said_to_be_closed_under_120_mmHg', async () => {
    const path = changedValve('own.obj', (text) =>
      text.replace(/pressure=0 boundary_fraction=0/, 'pressure=3060 boundary_fraction=1'),
    );
    assert.match(await said(path), /under 23\.0 mmHg\. It is closed under 120 mmHg here/);
    assert.equal(await said(changedValve('usual.obj')), '');
  });

  it('of_other_valves_get_no_names_and_no_plain_grade_of_the_mitral_valve', async () => {
    assert.match(await said(otherLeaflets()), /leaflets A and Septal, not an anterior and a posterior one/);
    assert.match(await card(), /grades of a mitral valve do not apply/);
  });

  it('without_scallops_have_no_A2_and_P2_in_words_and_begin_a_clip', async () => {
    assert.equal(await said(withoutScallops()), '');
    await openPanel(page, 'Valve');
    assert.match(flat(await page.locator('.panel').innerText()), /Coaptation height in the middle/);
    assert.doesNotMatch(await page.locator('.panel .figures').first().innerText(), /A2/);
    await begin(page, 'clip');
    await answered(page, 300);
    assert.equal(await page.getByTestId('form').getByRole('alert').count(), 0);
    assert.doesNotMatch(await page.getByTestId('form').locator('.hint').first().innerText(), /A2/);
    await page.keyboard.press('Escape');
  });

  it('show_no_figures_of_the_last_valve_while_they_close', async () => {
    await page.setInputFiles('#file', changedValve('large.obj', undefined, '--vertices', '4000'));
    const seen = [];
    for (let k = 0; k < 400 && seen.at(-1) !== 'large'; ++k) {
      const [motion, text, title] = await page.evaluate(() => [
        !!window.planner.state.motion.value,
        document.querySelector('[data-testid=verdict]').innerText,
        document.querySelector('[data-testid=present]').innerText,
      ]);
      if (motion) seen.push(text.trim());
      if (title === 'large') break;
      await page.waitForTimeout(20);
    }
    await closed(page);
    assert.ok(seen.length > 0, 'the opened valve is not shown while it closes');
    assert.deepEqual([...new Set(seen)], ['…']);
    assert.ok((await figures(page)).measures.atRest);
  });

  it('of_landmarks_are_refused_with_what_to_do_instead', async () => {
    const notice = await said(temporaryFile('tips.mrk.json', '{}'));
    assert.match(notice, /^tips\.mrk\.json has landmarks, which this page does not read .* click the points/);
  });
});
