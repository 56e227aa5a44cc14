// The four valves of the tour, sealed with pointer and keys only, each in at most 60 actions.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { figures, withPlanner } from './fixtures/browser.mjs';
import {
  answered,
  apply,
  begin,
  cameraRests,
  chordPlace,
  edgePlace,
  openPanel,
  undo,
} from './fixtures/person.mjs';

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
  await answered(page, 200);
}

/** Ties an artificial chord from a papillary head to a place near the free edge of P2, from its A1 to its A3 end. */
async function tie(page, head, along) {
  await begin(page, 'neochord');
  await page.keyboard.press('1');
  await cameraRests(page);
  const { x, y } = await edgePlace(page, 'P2', along);
  await page.mouse.click(x, y);
  await page.locator('#f-head').selectOption({ label: head });
  await answered(page, 200);
  assert.match(await page.getByTestId('form').innerText(), /picked on P2/);
  await apply(page);
}

const repairs = {
  1: async (page) => {
    // a band of 90 % seals it, and the leaflets meet over less than nine tenths of their length before the illness
    await begin(page, 'band');
    await apply(page);
    assert.equal((await figures(page)).measures.orifice, 0);
    await page.getByTestId('goals').locator('.missed', { hasText: 'Coaptation' }).waitFor();
    await undo(page);
    await begin(page, 'band');
    await set(page, 'factor', 85);
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
  4: async (page) => {
    const edge = page.getByTestId('goals').locator('li', { hasText: /edge of P2/i });
    const sealed = page.getByTestId('goals').locator('.done', { hasText: 'No leak' });
    await openPanel(page, 'Learn');
    assert.match(await edge.innerText(), /now 1\.\d mm above/);
    // a small annulus seals it as well, but P2 stays flail
    await begin(page, 'band');
    await set(page, 'factor', 80);
    await apply(page);
    await sealed.waitFor();
    assert.match(await edge.getAttribute('class'), /missed/);
    await undo(page);
    await tie(page, 'AL3', 0.35);
    await tie(page, 'PM3', 0.65);
    await begin(page, 'band');
    await set(page, 'factor', 92);
    await apply(page);
    await openPanel(page, 'Learn');
    assert.match(await edge.innerText(), /now \d\.\d mm below/);
  },
};

describe('tour', () => {
  for (const number of [1, 2, 3, 4]) {
    it(`valve_${number}_is_sealed_by_hand_and_reaches_all_goals`, async () => {
      await withPlanner({}, async ({ page }) => {
        await openPanel(page, 'Learn');
        await page.getByRole('button', { name: `Valve ${number}` }).click();
        await answered(page, 200);
        assert.ok((await figures(page)).measures.orifice > 3, 'the valve of the study leaks');
        await repairs[number](page);
        assert.equal((await figures(page)).measures.orifice, 0);
        await openPanel(page, 'Learn');
        await page
          .getByTestId('score')
          .getByText(number > 3 ? 'Example' : 'Study surgeon')
          .waitFor();
        await page.getByText('All goals reached. 1 of 4 valves sealed.').waitFor();
        const button = page.getByRole('button', { name: `Valve ${number}` });
        assert.equal(await button.locator('svg').count(), 1, 'a tick');
        if (number === 1) {
          // the repaired plan is not lost by going on
          await page.getByRole('button', { name: 'On to valve 2' }).click();
          await page.getByRole('button', { name: 'Return to it' }).waitFor();
          assert.match(
            await page.getByTestId('notice').innerText(),
            /The plan “Valve 1: .*” was put aside; it reaches all goals/,
          );
          assert.equal(await page.getByTestId('present').innerText(), 'Valve 2 of the tour');
          assert.equal(await button.locator('svg.soft').count(), 1, 'reached before');
          const next = page.getByRole('button', { name: 'Valve 2' });
          assert.equal(await next.locator('svg').count(), 0, 'the goals are not judged on the valve before');
          await button.click();
          await page.getByTestId('notice').getByText('Your repair of this valve').waitFor();
          // the leaking valve has no tick, and the repaired one has it again
          await page.getByTestId('reached-before').waitFor();
          assert.equal(await button.locator('svg:not(.soft)').count(), 0);
          await page.getByRole('button', { name: 'Return to it' }).click();
          await page.getByText('exactly the valve that was saved').waitFor();
          assert.equal((await figures(page)).measures.orifice, 0);
          await button.locator('svg:not(.soft)').waitFor();
          assert.equal(await page.getByTestId('own-repair').count(), 0, 'it is open');
        }
        if (number === 3) await page.getByRole('button', { name: 'On to valve 4' }).waitFor();
        if (number === 4) {
          // valves that were passed over are still offered
          await page.getByRole('button', { name: 'On to valve 1' }).waitFor();
          await page.evaluate(() => (window.planner.state.finished.value = [1, 2, 3, 4]));
          await page.getByText('All four valves are sealed').waitFor();
          // the end of the tour leads to a valve of one's own
          await page.getByRole('button', { name: 'Open your own valve' }).waitFor();
          assert.equal(await page.getByRole('button', { name: 'Repair this valve' }).count(), 0);
        }
      });
    });
  }
});
