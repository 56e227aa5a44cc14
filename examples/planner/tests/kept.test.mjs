// Keeping: the file that follows the plan, and the copies for recovery of several plans and tabs.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { beforeEach, describe, it } from 'node:test';
import { pathToFileURL } from 'node:url';
import { strFromU8, unzipSync } from 'fflate';
import { closed, figures, page_path, sharePlanner, temporaryFile, withPlanner } from './fixtures/browser.mjs';
import { answered, apply, begin, openPanel, save, open, startAfresh, undo } from './fixtures/person.mjs';

/** Waits until a page holds the expected value. */
async function eventually(look, expected, limit = 20_000) {
  const end = Date.now() + limit;
  for (;;) {
    const seen = await look();
    if (JSON.stringify(seen) === JSON.stringify(expected) || Date.now() > end)
      return assert.deepEqual(seen, expected);
    await new Promise((done) => setTimeout(done, 50));
  }
}

describe('planner file that follows the plan', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened), {
    // a stand-in for the dialog, which no test can press; keeps the last content of each file
    prepare: (context) =>
      context.addInitScript(() => {
        window.files = {};
        window.showSaveFilePicker = async () => {
          const name = `file${Object.keys(window.files).length + 1}.mvsplan`;
          window.files[name] = [];
          return {
            name,
            createWritable: async () => ({
              write: async (bytes) => (window.files[name] = [...bytes]),
              close: async () => {},
            }),
          };
        };
      }),
  });
  beforeEach(() => startAfresh(page));

  const choose = async () => {
    await openPanel(page, 'Plan');
    await page.getByRole('button', { name: 'Save every change to a file…' }).click();
    await answered(page, 150);
  };
  /** The session in a file of the stand-in. */
  const inFile = async (name) => {
    const bytes = await page.evaluate((key) => window.files[key], name);
    return bytes.length ? JSON.parse(strFromU8(unzipSync(Uint8Array.from(bytes))['session.json'])) : {};
  };

  it('writes_checkpoints_that_are_kept_renamed_deleted_and_put_back', async () => {
    await choose();
    const names = async () => (await inFile('file1.mvsplan')).checkpoints.map(({ name }) => name);
    for (const name of ['First', 'Second']) {
      await begin(page, 'annulus_scale');
      await apply(page);
      await openPanel(page, 'Plan');
      await page.getByLabel('Name of the plan').fill(name);
      await page.keyboard.press('Enter');
      await answered(page);
    }
    await eventually(names, ['First', 'Second']);
    await page.getByRole('button', { name: 'Delete “First”' }).click();
    await eventually(names, ['Second']);
    await page.getByRole('button', { name: 'Put it back' }).click();
    await eventually(names, ['First', 'Second']);
    await page.getByRole('button', { name: 'Rename “First”' }).click();
    await page.locator('.checkpoint input').fill('Before the ring');
    await page.keyboard.press('Enter');
    await eventually(names, ['Before the ring', 'Second']);
    await page.getByRole('button', { name: 'Stop' }).click();
  });

  it('does_not_write_another_plan_over_the_file', async () => {
    const another = {
      async 'a shipped valve'() {
        await page.getByRole('button', { name: 'Start from a healthy valve' }).click();
      },
      async 'a session'(session) {
        await open(page, session);
      },
    };
    const session = temporaryFile('another.mvsplan', readFileSync(await save(page)));
    for (const [what, go] of Object.entries(another)) {
      await begin(page, 'annulus_scale');
      await apply(page);
      await choose();
      const file = await page.evaluate(() => Object.keys(window.files).at(-1));
      const { hash } = await figures(page);
      await eventually(async () => (await inFile(file)).hash, hash);
      const plan = () => page.evaluate(() => window.planner.state.plan?.value ?? 0);
      const before = await plan();
      await go(session);
      await eventually(async () => (await plan()) > before, true);
      await closed(page);
      // a change of the other plan neither
      await begin(page, 'band');
      await apply(page);
      await page.waitForTimeout(500);
      assert.equal((await inFile(file)).hash, hash, `${what} replaced the plan in the file`);
      await openPanel(page, 'Plan');
      await page.getByRole('button', { name: 'Save every change to a file…' }).waitFor();
      await undo(page);
    }
  });

  it('says_that_the_file_is_left', async () => {
    await choose();
    await page.getByRole('button', { name: 'Start from a healthy valve' }).click();
    await answered(page, 300);
    assert.match(await page.getByTestId('notice').innerText(), /file\d\.mvsplan keeps the plan before/);
  });
});

describe('planner copies for recovery', () => {
  const url = pathToFileURL(page_path).href;
  const hash = async (page) => (await figures(page)).hash;
  const operate = async (page, kind) => {
    await begin(page, kind);
    await apply(page);
    await page.waitForTimeout(400);
    return hash(page);
  };
  const fresh = async (context) => {
    const page = await context.newPage();
    await page.goto(url);
    await closed(page);
    return page;
  };
  const allow = async (page) => {
    await openPanel(page, 'Plan');
    await page.getByLabel(/Keep a copy/).check();
  };
  const offered = (page) => page.getByTestId('recovery');
  // the copy is read from the browser's storage before the page is busy with it
  const recovered = async (page) => {
    await page.getByRole('button', { name: 'Recover it' }).click();
    await page
      .getByTestId('notice')
      .getByText(/^Session opened/)
      .waitFor();
    await closed(page);
  };

  it('keeps_a_left_copy_while_another_plan_is_made', async () => {
    await withPlanner({}, async ({ page, context }) => {
      await allow(page);
      const left = await operate(page, 'annulus_scale');
      await page.close({ runBeforeUnload: false });
      const next = await fresh(context);
      await offered(next).waitFor();
      // who works on before an answer loses nothing
      assert.notEqual(await operate(next, 'band'), left);
      await recovered(next);
      assert.equal(await hash(next), left);
    });
  });

  it('keeps_the_plans_of_two_tabs_and_offers_none_of_a_living_one', async () => {
    await withPlanner({}, async ({ page, context }) => {
      await allow(page);
      const first = await operate(page, 'annulus_scale');
      const tab = await fresh(context);
      await tab.waitForTimeout(500);
      assert.equal(await offered(tab).count(), 0, 'the plan of the first tab was not left');
      const second = await operate(tab, 'band');
      await tab.close({ runBeforeUnload: false });
      await page.close({ runBeforeUnload: false });
      const found = [];
      for (let k = 0; k < 2; ++k) {
        const next = await fresh(context);
        await recovered(next);
        found.push(await hash(next));
      }
      assert.deepEqual(found.sort(), [first, second].sort());
    });
  });

  it('deletes_every_copy_when_it_is_no_longer_allowed', async () => {
    await withPlanner({}, async ({ page, context }) => {
      await allow(page);
      await operate(page, 'annulus_scale');
      await page.close({ runBeforeUnload: false });
      const next = await fresh(context);
      await offered(next).waitFor();
      await openPanel(next, 'Plan');
      await next.getByLabel(/Keep a copy/).uncheck();
      await offered(next).waitFor({ state: 'detached' });
      const last = await fresh(context);
      await last.waitForTimeout(500);
      assert.equal(await offered(last).count(), 0);
    });
  });
});
