// Fingers are less exact than a mouse.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { withPlanner } from './fixtures/browser.mjs';
import { cameraRests, chordNames, chordPlace } from './fixtures/person.mjs';

describe('planner under a finger', () => {
  it('picks_a_chord_with_a_finger_beside_it', async () => {
    await withPlanner({ width: 820, height: 1180, touch: true }, async ({ page }) => {
      await page.keyboard.press('3');
      await cameraRests(page);
      const isChosen = async (press) => {
        await page.evaluate(() => (window.planner.state.choice.value = null));
        await press();
        return page.evaluate(() => window.planner.state.choice.value?.kind === 'chord');
      };
      let found = 0;
      for (const name of (await chordNames(page)).slice(0, 30)) {
        const { head, leaf, middle } = await chordPlace(page, name);
        const length = Math.hypot(leaf.x - head.x, leaf.y - head.y);
        for (const side of [-16, 16]) {
          const x = middle.x + (side * (leaf.y - head.y)) / length;
          const y = middle.y - (side * (leaf.x - head.x)) / length;
          // a mouse is more exact
          if (await isChosen(() => page.mouse.click(x, y))) continue;
          if (await isChosen(() => page.touchscreen.tap(x, y))) found += 1;
        }
        if (found > 1) break;
      }
      assert.ok(found > 1, `${found} chordae`);
    });
  });

  it('turns_the_valve_where_nothing_is_hit_and_zooms_with_two_fingers', async () => {
    await withPlanner({ width: 820, height: 1180, touch: true }, async ({ page }) => {
      await page.keyboard.press('3');
      await cameraRests(page);
      const client = await page.context().newCDPSession(page);
      const touch = (type, ...places) =>
        client.send('Input.dispatchTouchEvent', {
          type,
          touchPoints: places.map(([x, y], id) => ({ x, y, id })),
        });
      const view = () =>
        page.evaluate(() => {
          const { camera } = window.planner.viewport;
          return { orientation: camera.orientation.toArray(), distance: camera.distance };
        });
      const box = await page.locator('.canvas canvas').boundingBox();
      // the lower left corner, where there is neither tissue nor a muscle
      const [x, y] = [box.x + 40, box.y + box.height - 40];
      const first = await view();
      await touch('touchStart', [x, y]);
      for (let k = 1; k <= 6; ++k) await touch('touchMove', [x + 15 * k, y]);
      await touch('touchEnd');
      await cameraRests(page);
      const turned = await view();
      const cosine = first.orientation.reduce((sum, v, k) => sum + v * turned.orientation[k], 0);
      // 90 pixels turn by 4 rad in the height of the picture
      const angle = 2 * Math.acos(Math.min(1, Math.abs(cosine)));
      assert.ok(angle > 0.7 * ((4 * 90) / box.height), `turned by ${angle} rad`);
      assert.equal(await page.evaluate(() => window.planner.state.choice.value), null);
      // two fingers that move apart bring the valve nearer
      const [mx, my] = [box.x + box.width / 2, box.y + box.height / 2];
      await touch('touchStart', [mx - 40, my], [mx + 40, my]);
      for (let k = 1; k <= 6; ++k) await touch('touchMove', [mx - 40 - 10 * k, my], [mx + 40 + 10 * k, my]);
      await touch('touchEnd');
      await cameraRests(page);
      const ratio = (await view()).distance / turned.distance;
      // the fingers end 2.5 times as far apart
      assert.ok(Math.abs(ratio - 0.4) < 0.05, `distance by a factor of ${ratio}`);
    });
  });
});
