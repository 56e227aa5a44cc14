// The three valves of the tour, sealed with pointer and keys only, each in at most 60 actions.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { closed, figures, openBrowser, openPlanner } from './browser.mjs';
import { apply, begin, cameraRests, chordPlace, openPanel } from './person.mjs';

/** Chooses a chord by a click and drags it away from its papillary head by millimetres of the picture. */
async function lengthen(page, name, millimetres) {
  await page.keyboard.press('2');
  await cameraRests(page);
  const { head, leaf, places } = await chordPlace(page, name);
  const chosen = () =>
    page.evaluate(() => {
      const { state } = window.planner;
      return state.main.value.figures.chords.find((chord) => chord.id === state.choice.value?.id)?.name;
    });
  let place;
  for (const candidate of places.reverse()) {
    await page.mouse.click(candidate.x, candidate.y);
    if ((await chosen()) === name) {
      place = candidate;
      break;
    }
  }
  assert.ok(place, `${name} is seen from the ventricle`);
  const scale = await page.evaluate(() =>
    window.planner.viewport.camera.scale(window.planner.viewport.height),
  );
  const length = Math.hypot(leaf.x - head.x, leaf.y - head.y);
  const [dx, dy] = [
    ((leaf.x - head.x) / length) * (millimetres / scale),
    ((leaf.y - head.y) / length) * (millimetres / scale),
  ];
  await page.mouse.move(place.x, place.y);
  await page.mouse.down();
  for (let k = 1; k <= 8; ++k) await page.mouse.move(place.x + (k / 8) * dx, place.y + (k / 8) * dy);
  await page.mouse.up();
  await page.waitForTimeout(200);
  await apply(page);
}

async function set(page, field, value) {
  await page.locator(`#f-${field}`).fill(String(value));
  await page.keyboard.press('Tab');
  await page.waitForTimeout(200);
  await closed(page);
}

const repairs = {
  1: async (page) => {
    await begin(page, 'band');
    await apply(page);
  },
  2: async (page) => {
    await begin(page, 'chord_length');
    await page.locator('#f-chord').selectOption({ label: 'A2/4' });
    // sealed, but the chord still carries more than a third beyond its limit
    await set(page, 'length', 17);
    await apply(page);
    assert.equal((await figures(page)).measures.orifice, 0);
    const goals = page.getByTestId('goals');
    await goals.locator('.missed', { hasText: 'Chordae' }).waitFor();
    await lengthen(page, 'A2/4', 0.8);
  },
  3: async (page) => {
    await lengthen(page, 'A2/4', 6.5);
    await begin(page, 'band');
    await set(page, 'factor', 90);
    await apply(page);
  },
};

describe('tour', () => {
  for (const number of [1, 2, 3]) {
    it(`valve_${number}_is_sealed_by_hand_and_reaches_all_goals`, async () => {
      const { context } = await openBrowser();
      try {
        const { page, errors } = await openPlanner(context);
        await openPanel(page, 'Learn');
        await page.getByRole('button', { name: `Valve ${number}` }).click();
        await page.waitForTimeout(200);
        await closed(page);
        assert.ok((await figures(page)).measures.orifice > 3, 'the valve of the study leaks');
        await repairs[number](page);
        assert.equal((await figures(page)).measures.orifice, 0);
        await openPanel(page, 'Learn');
        await page.getByTestId('score').getByText('Study surgeon').waitFor({ timeout: 30_000 });
        await page.getByText('All goals reached. 1 of 3 valves sealed.').waitFor({ timeout: 30_000 });
        const button = page.getByRole('button', { name: `Valve ${number}` });
        assert.equal(await button.locator('svg').count(), 1, 'a tick');
        if (number === 1) {
          // the repaired plan is not lost by going on
          await page.getByRole('button', { name: 'On to valve 2' }).click();
          await page.getByRole('button', { name: 'Return to it' }).waitFor({ timeout: 30_000 });
          assert.match(await page.getByTestId('notice').innerText(), /“Valve 1: .*” is finished/);
          assert.equal(await page.getByTestId('present').innerText(), 'Valve 2 of the tour');
          assert.equal(await button.locator('svg').count(), 1, 'the tick stays');
          const next = page.getByRole('button', { name: 'Valve 2' });
          assert.equal(await next.locator('svg').count(), 0, 'the goals are not judged on the valve before');
          await button.click();
          await page.getByText('Your repair of this valve').waitFor({ timeout: 30_000 });
          await page.getByRole('button', { name: 'Return to it' }).click();
          await page.getByText('gives exactly the saved valve').waitFor({ timeout: 30_000 });
          assert.equal((await figures(page)).measures.orifice, 0);
        }
        if (number === 3) {
          // valves that were passed over are still offered
          await page.getByRole('button', { name: 'On to valve 1' }).waitFor();
          await page.evaluate(() => (window.planner.state.finished.value = [1, 2, 3]));
          await page.getByText('Three of three valves are sealed').waitFor();
        }
        assert.deepEqual(errors, []);
      } finally {
        await context.close();
      }
    });
  }
});
