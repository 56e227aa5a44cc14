// A whole repair without a pointer, also in a page that is zoomed to 150 and 200 %: open, close, shorten a chord, fit a ring, undo,
// save, a crash, recover, the same valve.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { describe, it } from 'node:test';
import { strFromU8, unzipSync } from 'fflate';
import { closed, figures, reopenAfterCrash, temporaryFile, withPlanner } from './fixtures/browser.mjs';
import { answered, focused, openForm, save, tabTo, undo } from './fixtures/person.mjs';

const hash = async (page) => (await figures(page)).hash;

/** Goes to a part by Tab, where it has to be in sight. */
async function goTo(page, wanted) {
  await tabTo(page, wanted);
  // the browser scrolls to it in the next frames, and notices make way after that
  let found = await focused(page);
  for (let k = 0; k < 40 && (k < 2 || found.covered); ++k) {
    await page.waitForTimeout(50);
    found = await focused(page);
  }
  const { name, covered } = found;
  assert.equal(covered, '', `${name} is covered`);
}

/** Types a number into the field that has the focus, and applies the operation. */
async function typeAndApply(page, value) {
  await page.keyboard.press('Control+a');
  await page.keyboard.type(String(value));
  await page.keyboard.press('Enter');
  await answered(page, 150);
  await page.keyboard.press('Enter');
  await page.getByTestId('form').waitFor({ state: 'detached' });
  await closed(page);
}

/** Opens a file by keys; the dialog of the system is answered for the person. */
async function openByKeys(page, path) {
  const [chooser] = await Promise.all([page.waitForEvent('filechooser'), page.keyboard.press('Control+o')]);
  await chooser.setFiles(path);
  await answered(page, 150);
}

async function opensAndCloses(page) {
  const moving = () => page.evaluate(() => !!window.planner.state.motion.value);
  await page.keyboard.press('o');
  for (let k = 0; k < 400 && !(await moving()); ++k) await page.waitForTimeout(50);
  assert.ok(await moving(), 'the valve opens');
  await page.keyboard.press('o');
  await closed(page);
  assert.ok(!(await moving()), 'the valve closes');
}

/** Shortens the first chord of the list to a length, mm; its name. */
async function shortenChord(page, length) {
  const [{ name }] = (await figures(page)).chords;
  await openForm(page, /chord_length/);
  await goTo(page, /f-chord/);
  await page.keyboard.type(name);
  await answered(page, 150);
  assert.equal(await page.locator('#f-chord option:checked').innerText(), name);
  await goTo(page, /f-length/);
  await typeAndApply(page, length);
  return name;
}

describe('planner with the keyboard alone', () => {
  for (const zoom of [1, 1.5, 2]) {
    it(`repairs_saves_and_recovers_at_${100 * zoom}_percent`, async () => {
      await withPlanner({ zoom }, async ({ page }) => {
        const start = await hash(page);
        const plain = temporaryFile('plain.mvsplan', readFileSync(await save(page)));
        await openByKeys(page, plain);
        assert.equal(await hash(page), start);
        // the notice about it stays where it covers none of the controls
        await page.getByTestId('notice').waitFor();
        await page.keyboard.press('p');
        await goTo(page, /Keep a copy/);
        await page.keyboard.press('Space');
        await opensAndCloses(page);

        const chord = await shortenChord(page, 10);
        const shortened = await hash(page);
        assert.notEqual(shortened, start);
        await openForm(page, /\bring\b/);
        await goTo(page, /f-size/);
        await typeAndApply(page, 30);
        const ringed = await hash(page);
        await undo(page);
        assert.equal(await hash(page), shortened);
        await page.keyboard.press('Control+y');
        await answered(page);
        assert.equal(await hash(page), ringed);
        const titles = (await figures(page)).history.map(({ title }) => title).join();
        assert.ok(titles.includes(chord) && /ring/i.test(titles), titles);
        const saved = JSON.parse(strFromU8(unzipSync(readFileSync(await save(page)))['session.json']));
        assert.equal(saved.hash, ringed);

        // the copy is written after the figures
        await page.waitForTimeout(600);
        const next = await reopenAfterCrash(page);
        assert.equal(await hash(next), start);
        await next.getByTestId('recovery').waitFor();
        await goTo(next, /Recover it/);
        await next.keyboard.press('Enter');
        await answered(next, 300);
        assert.equal(await hash(next), ringed);
      });
    });
  }
});
