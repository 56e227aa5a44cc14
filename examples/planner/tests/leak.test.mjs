// A leak is graded by its orifice, located, and drawn with a jet that leads from its place into the atrium.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { figures, withPlanner } from './fixtures/browser.mjs';
import { answered, cameraRests, openPanel } from './fixtures/person.mjs';

/**
 * Grades of a regurgitant orifice in mm²: mild below 20, moderate to 40 with a border at 30 within it, severe from 40
 * (Zoghbi et al. 2017, recommendations of the American Society of Echocardiography, table of the EROA).
 */
const gradeOf = (area) =>
  area >= 40
    ? 'Severe leak'
    : area >= 30
      ? 'Moderate–severe leak'
      : area >= 20
        ? 'Moderate leak'
        : 'Mild leak';

/** Pixels of the orifice's red in the picture, and their mean place. */
function redPixels(page) {
  return page.evaluate(async () => {
    const { data, width } = await window.pixels();
    let [count, x, y] = [0, 0, 0];
    for (let k = 0; k < data.length / 4; ++k) {
      if (data[4 * k] < 3 * data[4 * k + 1] || data[4 * k] < 80) continue;
      count += 1;
      x += k % width;
      y += Math.floor(k / width);
    }
    const scale = width / window.planner.viewport.width;
    return { count, x: x / count / scale, y: y / count / scale };
  });
}

describe('planner leak', () => {
  it('is_graded_located_and_drawn_with_its_jet', async () => {
    await withPlanner({}, async ({ page }) => {
      await page.keyboard.press('1');
      await cameraRests(page);
      assert.equal((await redPixels(page)).count, 0, 'a sealed valve has no red');
      const words = new Set();
      for (const number of [1, 2, 3, 4]) {
        await openPanel(page, 'Learn');
        await page.getByRole('button', { name: `Valve ${number}` }).click();
        await answered(page, 300);
        const { measures, regions, orificeParts, frame } = await figures(page);
        const verdict = await page.getByTestId('verdict').innerText();
        assert.ok(verdict.startsWith(gradeOf(measures.orifice)), `${measures.orifice} mm²: ${verdict}`);
        words.add(gradeOf(measures.orifice));
        // the place that leaks most is named
        const most = regions.reduce((a, b) => (b.orifice > a.orifice ? b : a));
        assert.ok(verdict.includes(most.name), `${most.name}: ${verdict}`);
        // parts add up to the whole; jets of those that count lead into the atrium
        const sum = orificeParts.reduce((total, { area }) => total + area, 0);
        assert.ok(
          Math.abs(sum - measures.orifice) < 1e-3 * measures.orifice,
          `${sum} of ${measures.orifice}`,
        );
        const largest = orificeParts.reduce((a, b) => (b.area > a.area ? b : a));
        assert.ok(Math.abs(Math.hypot(...largest.direction) - 1) < 1e-5);
        const rise = largest.direction.reduce((total, v, c) => total + v * frame[9 + c], 0);
        assert.ok(rise > 0, `valve ${number}: the jet rises by ${rise}`);
        // red begins near the place of the largest part
        await page.keyboard.press('1');
        await cameraRests(page);
        const red = await redPixels(page);
        const [x, y] = await page.evaluate(
          (at) =>
            window.planner.viewport.camera.project(
              ...at,
              window.planner.viewport.width,
              window.planner.viewport.height,
            ),
          largest.centroid,
        );
        const height = await page.evaluate(() => window.planner.viewport.height);
        assert.ok(red.count > 50, `valve ${number}: ${red.count} red pixels`);
        // the arrow is as long as a third of the annulus at most
        const off = Math.hypot(red.x - x, red.y - y);
        assert.ok(off < 0.25 * height, `valve ${number}: ${off} pixels from the leak`);
      }
      assert.ok(words.size > 1, [...words].join());
    });
  });
});
