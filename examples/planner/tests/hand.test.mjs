// Tissue that is grasped and pushed with the pointer while the valve lives.
import assert from 'node:assert/strict';
import { beforeEach, describe, it } from 'node:test';
import { answered, edgePlace, startAfresh } from './fixtures/person.mjs';
import { figures, sharePlanner } from './fixtures/browser.mjs';

/** mm by which the nodes have moved from the closed valve, the farthest of them; 0 while nothing lives. */
function moved(page) {
  return page.evaluate(() => {
    const { state } = window.planner;
    const now = state.motion.value?.picture.positions;
    const then = state.main.value.picture.positions;
    let most = 0;
    for (let i = 0; i < then.length && now; i += 3)
      most = Math.max(most, Math.hypot(now[i] - then[i], now[i + 1] - then[i + 1], now[i + 2] - then[i + 2]));
    return most;
  });
}

/** Share of pale pixels, which are neither tissue nor the blue of the hand, in the middle of the picture: daylight or chordae. */
function paleness(page) {
  return page.evaluate(async () => {
    const { width, height } = window.planner.viewport;
    const { data } = await window.pixels([0.3 * width, 0.35 * height, 0.4 * width, 0.4 * height]);
    let pale = 0;
    for (let i = 0; i < data.length; i += 4) {
      const [r, g, b] = data.slice(i, i + 3);
      if (Math.min(r, g, b) > 120 && r - b < 15 && b - r < 30) ++pale;
    }
    return pale / (data.length / 4);
  });
}

describe('planner in the hand', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));
  beforeEach(() => startAfresh(page));

  for (const [key, word, label] of [
    ['g', 'grasps', 'Grasp'],
    ['b', 'pushes', 'Push'],
  ])
    it(`${word}_the_tissue_of_the_living_valve_and_lets_it_go`, async () => {
      const { hash } = await figures(page);
      await page.keyboard.press(key);
      const tool = page.getByRole('button', { name: label });
      assert.equal(await tool.getAttribute('aria-pressed'), 'true');
      assert.equal(await moved(page), 0);
      // the body of A2
      const box = await page.locator('.canvas canvas').boundingBox();
      const [x, y] = [box.x + 0.5 * box.width, box.y + 0.4 * box.height];
      await page.mouse.move(x, y);
      await page.mouse.down();
      // a grasp is dragged by some 6 mm, a ball of 3 mm goes to the middle of the tissue by itself; it follows as far as
      // chordae and pressure let it, and nothing flies away
      if (key === 'g') for (let k = 1; k <= 6; ++k) await page.mouse.move(x + 15 * k, y + 7 * k);
      let most = 0;
      for (let k = 0; k < 300 && most < 0.5; ++k) {
        await page.waitForTimeout(50);
        most = Math.max(most, await moved(page));
      }
      assert.ok(most >= 0.5 && most < 20, `${most} mm`);
      // where the leaflets are drawn without their thickness, the line of closure is a pale hole
      const pale = await paleness(page);
      assert.ok(pale < 2e-4, `share of daylight ${pale}`);
      await page.mouse.up();
      await answered(page, 300);
      // the valve of the plan is shown again, and is the same
      assert.equal(await page.evaluate(() => window.planner.state.motion.value), null);
      assert.equal((await figures(page)).hash, hash);
      await page.keyboard.press(key);
      assert.equal(await tool.getAttribute('aria-pressed'), 'false');
    });

  it('pushes_the_line_of_closure_where_the_ball_has_no_room_beside_the_leaflets', async () => {
    await page.keyboard.press('b');
    for (const along of [0.35, 0.5, 0.65]) {
      const { x, y } = await edgePlace(page, 'A2', along);
      for (const down of [-14, -7, 0, 7]) {
        await page.mouse.move(x, y + down);
        await page.mouse.down();
        let most = 0;
        for (let k = 0; k < 200 && most < 0.3; ++k) {
          await page.waitForTimeout(50);
          most = Math.max(most, await moved(page));
          assert.equal(await page.evaluate(() => window.planner.state.notice.value?.text), undefined);
        }
        await page.mouse.up();
        assert.ok(most >= 0.3 && most < 20, `${most} mm`);
        await answered(page, 200);
      }
    }
    await page.keyboard.press('b');
  });
});
