// Sessions: saved, repeated by the native command, opened again, with their checkpoints.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { describe, it } from 'node:test';
import { strFromU8, strToU8, unzipSync, zipSync } from 'fflate';
import { figures, sharePlanner, temporaryFile } from './fixtures/browser.mjs';
import { repeated } from './fixtures/native.mjs';
import { answered, apply, begin, open, openPanel, save, startAfresh, undo } from './fixtures/person.mjs';

describe('sessions', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));

  it(
    'saves_a_session_that_the_native_command_repeats',
    { skip: process.env.MVS_COMMAND ? false : 'MVS_COMMAND is not set' },
    async () => {
      await begin(page, 'clip');
      await page.keyboard.press('q');
      await apply(page);
      assert.match((await figures(page)).history.at(-1).title, /turned by 5 degrees/);
      await begin(page, 'ring');
      await apply(page);
      const path = await save(page);
      assert.equal(repeated(path).hash, (await figures(page)).hash);
    },
  );

  it('opens_a_saved_session_with_its_hash', async () => {
    await begin(page, 'annulus_scale');
    await apply(page);
    const { hash } = await figures(page);
    const path = await save(page);
    const copy = temporaryFile('kept.mvsplan', readFileSync(path));
    await undo(page);
    assert.notEqual((await figures(page)).hash, hash);
    await open(page, copy);
    assert.equal((await figures(page)).hash, hash);
    assert.match(await page.getByTestId('notice').innerText(), /exactly the saved valve/);
  });

  it('refuses_a_damaged_session_and_stays', async () => {
    const { hash } = await figures(page);
    await open(page, temporaryFile('broken.mvsplan', 'not an archive'));
    assert.match(await page.getByTestId('notice').innerText(), /not a session/);
    assert.equal((await figures(page)).hash, hash);
  });

  it('says_what_is_wrong_with_the_version_of_a_session', async () => {
    const files = unzipSync(readFileSync(await save(page)));
    const described = JSON.parse(strFromU8(files['session.json']));
    for (const [version, sentence] of [
      [2, /saved by a newer planner, as a session of version 2/],
      ['1', /its version is "1", and this page reads 1/],
    ]) {
      files['session.json'] = strToU8(JSON.stringify({ ...described, version }));
      await open(page, temporaryFile('other.mvsplan', zipSync(files)));
      await page.getByTestId('notice').getByText('other.mvsplan was not opened').waitFor();
      assert.match(await page.getByTestId('notice').innerText(), sentence);
      await startAfresh(page);
    }
  });

  it('deletes_a_checkpoint_by_keyboard_and_puts_it_back_into_its_place', async () => {
    await openPanel(page, 'Plan');
    const names = () => page.locator('.checkpoint > span').allInnerTexts();
    const hash = async () => (await figures(page)).hash;
    await begin(page, 'annulus_scale');
    await apply(page);
    await openPanel(page, 'Plan');
    const before = await hash();
    for (const name of ['First', 'Second']) {
      await page.getByLabel('Name of the plan').fill(name);
      await page.keyboard.press('Enter');
      await answered(page);
      await undo(page);
    }
    const second = await hash();
    await page.getByRole('button', { name: 'Compare' }).first().click();
    await answered(page, 150);
    await page.getByRole('button', { name: 'Delete “First”' }).focus();
    await page.keyboard.press('Enter');
    await answered(page, 150);
    assert.deepEqual(await names(), ['Second']);
    assert.equal(await page.getByTestId('compare').count(), 0, 'compared with a deleted plan');
    assert.equal(await page.getByTestId('status').innerText(), '“First” was deleted.');
    assert.equal(await hash(), second, 'the plan itself stays');
    const inSession = (path) =>
      JSON.parse(strFromU8(unzipSync(readFileSync(path))['session.json'])).checkpoints.map(
        ({ name }) => name,
      );
    assert.deepEqual(inSession(await save(page)), ['Second']);
    // the keyboard is at the way back
    await page.keyboard.press('Enter');
    await answered(page, 150);
    assert.deepEqual(await names(), ['First', 'Second']);
    await page.getByRole('button', { name: 'Return to it' }).first().click();
    await answered(page, 150);
    assert.equal(await hash(), before);
    // a name used twice replaces the first, which can be put back beside it
    await page.getByLabel('Name of the plan').fill('Second');
    // saved from within a text
    assert.deepEqual(inSession(await save(page)), ['First', 'Second']);
    await page.keyboard.press('Enter');
    await answered(page, 150);
    await page.getByRole('button', { name: 'Put it back' }).click();
    await answered(page, 150);
    assert.deepEqual(await names(), ['First', 'Second (2)', 'Second']);
    for (const name of await names()) {
      await page.getByRole('button', { name: `Delete “${name}”` }).click();
      await answered(page, 150);
    }
  });

  it('renames_checkpoints_and_keeps_their_names_and_order_in_the_session', async () => {
    await openPanel(page, 'Plan');
    const names = () => page.locator('.checkpoint > span').allInnerTexts();
    const keep = async () => {
      await page.getByRole('button', { name: 'Keep this plan' }).click();
      await answered(page);
    };
    const rename = async (name, to) => {
      await page.getByRole('button', { name: `Rename “${name}”` }).click();
      await page.keyboard.type(to);
      await page.keyboard.press('Enter');
      await answered(page);
    };
    await keep();
    await undo(page);
    await keep();
    const { hash } = await figures(page);
    assert.deepEqual(await names(), ['Plan 1', 'Plan 2']);
    await rename('Plan 1', 'Clip and ring');
    assert.deepEqual(await names(), ['Clip and ring', 'Plan 2']);
    // a name that another one has is refused, and so is none
    await rename('Plan 2', 'Clip and ring');
    assert.match(await page.getByTestId('notice').innerText(), /already a plan “Clip and ring”/);
    await rename('Plan 2', ' ');
    // Escape leaves the name as it is
    await page.getByRole('button', { name: 'Rename “Plan 2”' }).click();
    await page.keyboard.type('Nothing');
    await page.keyboard.press('Escape');
    assert.deepEqual(await names(), ['Clip and ring', 'Plan 2']);
    // the next one gets no name that is taken: it would replace that one
    await rename('Plan 2', 'Plan 3');
    assert.equal(await page.locator('input.checkpoint-name').getAttribute('placeholder'), 'Plan 4');
    await open(page, temporaryFile('renamed.mvsplan', readFileSync(await save(page))));
    assert.deepEqual(await names(), ['Clip and ring', 'Plan 3']);
    for (const [k, same] of [false, true].entries()) {
      await page.getByRole('button', { name: 'Return to it' }).nth(k).click();
      await answered(page);
      assert.equal((await figures(page)).hash === hash, same, `checkpoint ${k + 1}`);
    }
  });
});
