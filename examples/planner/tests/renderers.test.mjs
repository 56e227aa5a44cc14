// Both renderers show the same: the leak, also where leaflets hide it.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { closed, withPlanner } from './browser.mjs';
import { cameraRests, openPanel } from './person.mjs';

/** How much redder than blue the picture is around the leak, of 255, in the mean. */
function rednessAtLeak(page) {
  return page.evaluate(async () => {
    const { state, viewport } = window.planner;
    const points = state.picture.value.orificeVertices;
    let [left, top, right, bottom] = [1e9, 1e9, 0, 0];
    for (let i = 0; i < points.length; i += 3) {
      const [x, y] = viewport.camera.project(...points.slice(i, i + 3), viewport.width, viewport.height);
      [left, right] = [Math.min(left, x), Math.max(right, x)];
      [top, bottom] = [Math.min(top, y), Math.max(bottom, y)];
    }
    const data = await window.pixels([left, top, right - left, bottom - top]);
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) sum += data[i] - data[i + 2];
    return sum / (data.length / 4);
  });
}

/** Mean colours of the cells of a grid over the picture: red, green and blue of each, 0 to 255. */
function cells(page, size) {
  return page.evaluate(async (cell) => {
    const { viewport } = window.planner;
    const { data, width, height } = await window.pixels();
    const [across, down] = [Math.floor(viewport.width / cell), Math.floor(viewport.height / cell)];
    const sums = new Float64Array(4 * across * down);
    for (let y = 0; y < height; ++y)
      for (let x = 0; x < width; ++x) {
        const [i, j] = [Math.floor((x / width) * across), Math.floor((y / height) * down)];
        const at = 4 * (j * across + i);
        for (let c = 0; c < 3; ++c) sums[at + c] += data[4 * (y * width + x) + c];
        sums[at + 3] += 1;
      }
    const means = [];
    for (let k = 0; k < sums.length; k += 4) means.push([0, 1, 2].map((c) => sums[k + c] / sums[k + 3]));
    return means;
  }, size);
}

/** The share of pixels between the first and the last red one of each row that are not red, of the leak without its jet. */
function tissueInLeak(page) {
  return page.evaluate(async () => {
    const { state, viewport } = window.planner;
    const shown = state.main.value;
    state.main.value = { ...shown, figures: { ...shown.figures, orificeParts: [] } };
    viewport.touchScene();
    const { data, width, height } = await window.pixels();
    state.main.value = shown;
    const isRed = (x, y) => {
      const [r, g, b] = data.subarray(4 * (y * width + x));
      return r > 2 * g && r > 2 * b;
    };
    let [red, between] = [0, 0];
    for (let y = 0; y < height; ++y) {
      const row = [];
      for (let x = 0; x < width; ++x) if (isRed(x, y)) row.push(x);
      if (!row.length) continue;
      red += row.length;
      between += row.at(-1) - row[0] + 1 - row.length;
    }
    return between / (red + between);
  });
}

describe('planner renderers', () => {
  for (const hash of ['#software', '#webgl'])
    it(`cut_no_wedges_of_tissue_out_of_the_leak_by_${hash.slice(1)}`, async () => {
      await withPlanner({ hash }, async ({ page }) => {
        await openPanel(page, 'Learn');
        await page.getByRole('button', { name: 'Valve 3' }).click();
        await page.getByText('Valve 3 of the tour').waitFor();
        await closed(page);
        await page.keyboard.press('1');
        await cameraRests(page);
        const share = await tissueInLeak(page);
        assert.ok(share < 0.1, `${share} of the rows of the leak is tissue`);
      });
    });

  for (const hash of ['#software', '#webgl'])
    it(`show_no_chord_between_the_leaflets_of_a_sealed_valve_by_${hash.slice(1)}`, async () => {
      await withPlanner({ hash }, async ({ page }) => {
        await page.keyboard.press('1');
        await cameraRests(page);
        assert.equal(await page.evaluate(() => window.planner.state.main.value.figures.measures.orifice), 0);
        // pixels inside the annulus that chordae change
        const changed = () =>
          page.evaluate(async () => {
            const { state } = window.planner;
            const pixels = async () => new Uint32Array((await window.pixels()).data.buffer);
            const on = await pixels();
            state.chordsOn.value = false;
            const off = await pixels();
            state.chordsOn.value = true;
            return on.reduce((sum, pixel, k) => sum + (pixel !== off[k] ? 1 : 0), 0);
          });
        assert.equal(await changed(), 0);
        // the picture does show them where the leaflets do not hide them
        await page.keyboard.press('2');
        await cameraRests(page);
        assert.ok((await changed()) > 1000);
        await page.keyboard.press('1');
        await cameraRests(page);
      });
    });

  it('draw_the_pictures_of_the_rasteriser_by_webgl', async () => {
    const seen = {};
    for (const hash of ['#software', '#webgl'])
      await withPlanner({ hash }, async ({ page }) => {
        for (const view of ['1', '2', '3', '4']) {
          await page.keyboard.press(view);
          await cameraRests(page);
          (seen[view] ??= []).push(await cells(page, 8));
        }
      });
    for (const [view, [software, webgl]] of Object.entries(seen)) {
      const apart = software.map((cell, k) => Math.max(...cell.map((v, c) => Math.abs(v - webgl[k][c]))));
      const most = Math.max(...apart);
      assert.ok(most < 40, `view ${view}: a cell of 8 x 8 pixels is ${most.toFixed(0)} of 255 apart`);
    }
  });

  it('show_the_leak_behind_the_leaflets_alike', async () => {
    const seen = {};
    for (const hash of ['#software', '#webgl'])
      await withPlanner({ hash }, async ({ page }) => {
        assert.equal(await page.evaluate(() => window.planner.viewport.renderer.name), hash.slice(1));
        await openPanel(page, 'Learn');
        await page.getByRole('button', { name: 'Valve 3' }).click();
        await page.getByText('Valve 3 of the tour').waitFor();
        await closed(page);
        for (const view of ['1', '2']) {
          await page.keyboard.press(view);
          await cameraRests(page);
          await page.waitForTimeout(500);
          (seen[view] ??= []).push(await rednessAtLeak(page));
        }
      });
    // the edges of the shapes are drawn with more samples by one of them; the faint leak is some 20 of 255
    for (const [view, [software, webgl]] of Object.entries(seen))
      assert.ok(Math.abs(software - webgl) < 4, `view ${view}: ${software} and ${webgl} of 255`);
  });
});
