// Both renderers show the same: the leak, also where leaflets hide it.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { closed, withPlanner } from './fixtures/browser.mjs';
import { apply, cameraRests, chordNames, openPanel } from './fixtures/person.mjs';

/** How often dark blue begins or ends along a chord in its image, within 6 pixels of the line between its nodes: its tube ends below the leaflet. */
function bandsOf(page, name) {
  return page.evaluate(async (wanted) => {
    const { state, viewport } = window.planner;
    const picture = state.picture.value;
    const topology = state.topologyOf(picture);
    const k = topology.chords.findIndex((part) => part.name === wanted);
    const [a, b] = [0, 1].map((end) => {
      const node = topology.chordNodes[2 * k + end];
      const at = picture.positions.slice(3 * node, 3 * node + 3);
      return viewport.camera.project(...at, viewport.width, viewport.height);
    });
    const image = await window.pixels();
    const scale = image.width / viewport.width;
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    const across = [(a[1] - b[1]) / length, (b[0] - a[0]) / length];
    const isDark = (x, y) => {
      const at = 4 * (y * image.width + x);
      const [red, green, blue] = image.data.slice(at, at + 3);
      return red < 70 && green < 70 && blue > red + 15 && blue < 140;
    };
    let [changes, dark] = [0, false];
    for (let s = 0.2; s <= 1; s += 1 / 512) {
      let now = false;
      for (let off = -6; off <= 6; off += 0.5) {
        const [x, y] = [0, 1].map((c) => Math.round(scale * (a[c] + s * (b[c] - a[c]) + off * across[c])));
        now ||= isDark(x, y);
      }
      if (now !== dark) ++changes;
      dark = now;
    }
    return changes;
  }, name);
}

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
    const { data } = await window.pixels([left, top, right - left, bottom - top]);
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) sum += data[i] - data[i + 2];
    return sum / (data.length / 4);
  });
}

describe('planner renderers', () => {
  it('draw_artificial_chordae_in_bands_and_native_ones_in_one_colour', async () => {
    for (const hash of ['#software', '#webgl'])
      await withPlanner({ hash }, async ({ page }) => {
        const names = {};
        // from both muscles to the middle of A2, where nothing stands before them
        for (const [kind, muscle, along] of [
          ['neochord', 'PM1', 0.35],
          ['chord_add', 'AL1', 0.65],
        ]) {
          const before = await chordNames(page);
          await page.evaluate(
            ([operation, name, share]) => {
              const { state, edit } = window.planner;
              const topology = state.topologyOf(state.main.value.picture);
              const { id: scallop } = topology.scallops.find((part) => part.name === 'A2');
              const { id: head } = topology.heads.find((part) => part.name === name);
              edit(operation, { head, site: { scallop, along: share, height: 0.35 } });
            },
            [kind, muscle, along],
          );
          await closed(page);
          await apply(page);
          names[kind] = (await chordNames(page)).find((name) => !before.includes(name));
        }
        const keys = page.locator('.scale');
        assert.match(await keys.innerText(), /artificial chord/);
        const bands = {};
        for (const [kind, name] of Object.entries(names)) {
          await page.keyboard.press('2');
          await cameraRests(page);
          await page.waitForTimeout(400);
          bands[kind] = await bandsOf(page, name);
        }
        assert.ok(bands.neochord >= 6, `${hash}: ${bands.neochord} changes along the artificial chord`);
        assert.ok(bands.chord_add === 0, `${hash}: ${bands.chord_add} changes along the native chord`);
        // in a colour map as well
        await page.getByLabel('Colours').selectOption({ label: 'Chord pull' });
        await page.waitForTimeout(400);
        await keys.getByText(/artificial chord/).waitFor();
      });
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
