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
});
