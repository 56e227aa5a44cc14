// Sessions: saved, repeated by the native command, opened again, with their checkpoints.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { describe, it } from 'node:test';
import { strFromU8, strToU8, unzipSync, zipSync } from 'fflate';
import { closed, figures, sharePlanner, temporaryFile } from './fixtures/browser.mjs';
import { checkpointsIn, repeated } from './fixtures/native.mjs';
import {
  answered,
  apply,
  becomes,
  begin,
  fillIn,
  open,
  openPanel,
  save,
  startAfresh,
  undo,
} from './fixtures/person.mjs';
import { listed, openTour, startHealthy } from './fixtures/valves.mjs';

describe('valves that were left', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));

  it('keeps_every_valve_with_its_kept_plans_through_many_switches', async () => {
    const hashes = [];
    for (const [k, kind] of ['annulus_scale', 'band', 'ring'].entries()) {
      await startHealthy(page);
      await begin(page, kind);
      await apply(page);
      await openPanel(page, 'Plan');
      for (let n = 0; n <= k; ++n) {
        await page.getByLabel('Name of the plan').fill(`${kind} ${n}`);
        await page.keyboard.press('Enter');
        await answered(page);
      }
      hashes.unshift((await figures(page)).hash);
    }
    await openTour(page, 2);
    const notice = page.getByTestId('notice');
    await notice.getByText(/with its 3 kept plans/).waitFor();
    await page.evaluate(() => (window.planner.state.notice.value = null));
    await openPanel(page, 'Plan');
    await becomes(() => listed(page).count(), 3);
    const texts = await listed(page).allInnerTexts();
    assert.match(texts[0], /Healthy valve\s+Sealed · 1 step · 3 kept plans/);
    // the oldest, then the one that was last before
    for (const [row, hash, plans] of [
      [2, hashes[2], ['annulus_scale 0']],
      [1, hashes[0], ['ring 0', 'ring 1', 'ring 2']],
    ]) {
      await listed(page).nth(row).getByRole('button', { name: 'Open it again' }).click();
      await page.getByText('exactly the valve that was saved').waitFor();
      await closed(page);
      assert.equal((await figures(page)).hash, hash);
      await becomes(() => page.locator('.checkpoint > span').allInnerTexts(), plans);
      await startHealthy(page);
      await openPanel(page, 'Plan');
      await becomes(() => listed(page).count(), 3, 'opened again and left, each is there once');
    }
    // what the memory has no room for is named
    await page.evaluate(() => {
      const { leftValves } = window.planner;
      leftValves.value = [
        ...leftValves.value,
        { ...leftValves.value[0], content: 'x', title: 'Old', bytes: { length: 48e6 } },
      ];
    });
    await begin(page, 'band');
    await apply(page);
    await startHealthy(page);
    await notice.getByText(/no room for so many earlier valves: “Old” left the list/).waitFor();
  });

  it('offers_the_repair_of_a_tour_valve_there_and_nowhere_else', async () => {
    await openTour(page, 4);
    await begin(page, 'band');
    await apply(page);
    const repaired = (await figures(page)).hash;
    await startHealthy(page);
    await begin(page, 'annulus_scale');
    await apply(page);
    // whatever is left, valve 4 offers its own repair first
    await openTour(page, 4);
    const notice = page.getByTestId('notice');
    await notice.getByText(/“Healthy valve” was put aside.*Your repair of this valve/s).waitFor();
    await becomes(() => page.getByTestId('own-repair').count(), 1);
    await startHealthy(page);
    await becomes(() => notice.filter({ hasText: 'repair of this valve' }).count(), 0);
    await openTour(page, 4);
    await notice.getByRole('button', { name: 'Return to it' }).click();
    await page.getByText('exactly the valve that was saved').waitFor();
    await closed(page);
    assert.equal((await figures(page)).hash, repaired);
  });

  it('takes_a_valve_that_was_made_ill_as_the_one_before_the_repair', async () => {
    await startHealthy(page);
    await begin(page, 'annulus_scale');
    await fillIn(page, 'factor', '125');
    await apply(page);
    const ill = await figures(page);
    assert.ok(ill.measures.orifice > 0);
    await page.getByTestId('made-leak').getByRole('button').click();
    await page.getByText('This valve is the one before the repair').waitFor();
    await closed(page);
    const start = await figures(page);
    assert.deepEqual(start.history, []);
    assert.equal(start.hash, ill.hash, 'it is the very valve');
    const undoes = () => page.evaluate(() => window.planner.state.canUndo.value);
    assert.ok(!(await undoes()), 'the illness is not undone');
    await begin(page, 'ring');
    await fillIn(page, 'size', '34');
    await apply(page);
    await openPanel(page, 'Plan');
    await page.getByRole('button', { name: 'Report' }).click();
    const report = page.locator('dialog');
    const cells = report.getByRole('row', { name: /^Leak/ }).first().locator('td');
    await cells.first().waitFor();
    await becomes(async () => (await cells.allInnerTexts())[0], `${start.measures.orifice.toFixed(1)} mm²`);
    assert.match(
      await report.innerText(),
      /Healthy valve, changed[^]*Before the repair, from “Healthy valve”: /,
    );
    await page.keyboard.press('Escape');
    // a session has the repair and the valve before it
    const ringed = (await figures(page)).hash;
    const path = await save(page);
    await startHealthy(page);
    await open(page, temporaryFile('repair.mvsplan', readFileSync(path)));
    await page.getByText('exactly the valve that was saved').waitFor();
    await closed(page);
    const again = await figures(page);
    assert.deepEqual([again.hash, again.history.map(({ kind }) => kind)], [ringed, ['ring']]);
    await undo(page);
    assert.equal((await figures(page)).hash, ill.hash);
    assert.ok(!(await undoes()));
    if (process.env.MVS_COMMAND) assert.equal(repeated(path).hash, ringed);
    // the plan that made it ill
    const illness = listed(page).filter({ hasNotText: ', changed' }).first();
    await illness.getByRole('button', { name: 'Open it again' }).click();
    await page.getByRole('button', { name: 'Go on', exact: true }).click();
    await page.getByText('exactly the valve that was saved').waitFor();
    await closed(page);
    assert.equal((await figures(page)).hash, ill.hash);
  });
});

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
      await begin(page, 'annulus_scale');
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
    await page
      .getByTestId('notice')
      .getByText(/exactly the valve that was saved/)
      .waitFor();
  });

  it('refuses_a_damaged_session_and_stays', async () => {
    const { hash } = await figures(page);
    await open(page, temporaryFile('broken.mvsplan', 'not an archive'));
    await page
      .getByTestId('notice')
      .getByText(/not a session/)
      .waitFor();
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
      await page.getByTestId('notice').getByText(sentence).waitFor();
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
    await becomes(names, ['Second']);
    await becomes(() => page.getByTestId('compare').count(), 0, 'compared with a deleted plan');
    await becomes(() => page.getByTestId('status').innerText(), '“First” was deleted.');
    assert.equal(await hash(), second, 'the plan itself stays');
    assert.deepEqual(checkpointsIn(await save(page)), ['Second']);
    // the keyboard is at the way back
    await page.keyboard.press('Enter');
    await answered(page, 150);
    await becomes(names, ['First', 'Second']);
    await page.getByRole('button', { name: 'Return to it' }).first().click();
    await answered(page, 150);
    assert.equal(await hash(), before);
    // a name used twice replaces the first, which can be put back beside it
    await page.getByLabel('Name of the plan').fill('Second');
    // saved from within a text
    assert.deepEqual(checkpointsIn(await save(page)), ['First', 'Second']);
    await page.keyboard.press('Enter');
    await answered(page, 150);
    await page.getByRole('button', { name: 'Put it back' }).click();
    await answered(page, 150);
    await becomes(names, ['First', 'Second (2)', 'Second']);
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
    await becomes(names, ['Plan 1', 'Plan 2']);
    await rename('Plan 1', 'Clip and ring');
    await becomes(names, ['Clip and ring', 'Plan 2']);
    // the name of another plan is refused, and an empty name as well
    await rename('Plan 2', 'Clip and ring');
    await page
      .getByTestId('notice')
      .getByText(/already a plan “Clip and ring”/)
      .waitFor();
    await rename('Plan 2', ' ');
    // Escape leaves the name as it is
    await page.getByRole('button', { name: 'Rename “Plan 2”' }).click();
    await page.keyboard.type('Nothing');
    await page.keyboard.press('Escape');
    await becomes(names, ['Clip and ring', 'Plan 2']);
    // the next one gets no name that is taken: it would replace that one
    await rename('Plan 2', 'Plan 3');
    assert.equal(await page.locator('input.checkpoint-name').getAttribute('placeholder'), 'Plan 4');
    await open(page, temporaryFile('renamed.mvsplan', readFileSync(await save(page))));
    await becomes(names, ['Clip and ring', 'Plan 3']);
    for (const [k, same] of [false, true].entries()) {
      await page.getByRole('button', { name: 'Return to it' }).nth(k).click();
      await answered(page);
      assert.equal((await figures(page)).hash === hash, same, `checkpoint ${k + 1}`);
    }
  });
});
