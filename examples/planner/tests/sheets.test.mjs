// Leaflets are sheets with a thickness: no side shows through the other leaflet, a section shows both leaflets and where they meet,
// and no ring hides it. Clips are devices whose turn is seen.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { closed, figures, openBrowser, openPlanner } from './fixtures/browser.mjs';
import { answered, apply, begin, cameraRests, openPanel } from './fixtures/person.mjs';

for (const renderer of ['software', 'webgl']) {
  describe(`planner sheets by ${renderer}`, () => {
    const withPage = async (work) => {
      const { context } = await openBrowser({ software: renderer === 'software' });
      try {
        const { page, errors } = await openPlanner(context, { hash: `#${renderer}` });
        assert.equal(await page.evaluate(() => window.planner.viewport.renderer.name), renderer);
        await work(page);
        assert.deepEqual(errors, []);
      } finally {
        await context.close();
      }
    };
    const look = async (page, key) => {
      await page.keyboard.press(key);
      await cameraRests(page);
    };
    /** Pixels of the picture by a rule on red, green and blue: their number, and their main direction in degrees against the clock
     *  from the right. */
    const pixelsOf = (page, rule) =>
      page.evaluate(async (wanted) => {
        const { data, width } = await window.pixels();
        const rules = {
          // pink, brighter than the edges of the leaflets and than muscle, and redder than the annulus
          atrial: (r, g, b) => r > 125 && r - b > 35 && g - b < 25,
          ventricular: (r, g, b) => b - r > 15 && r > 40,
          device: (r, g, b) => b - r > 60 && b - g > 25,
        };
        let [n, x, y, xx, xy, yy] = [0, 0, 0, 0, 0, 0];
        for (let k = 0; k < data.length; k += 4) {
          if (!rules[wanted](data[k], data[k + 1], data[k + 2])) continue;
          const [px, py] = [(k / 4) % width, -Math.floor(k / 4 / width)];
          n += 1;
          x += px;
          y += py;
          xx += px * px;
          xy += px * py;
          yy += py * py;
        }
        const [vx, vy, c] = [xx / n - (x / n) ** 2, yy / n - (y / n) ** 2, xy / n - (x * y) / n / n];
        return { count: n, degrees: ((0.5 * Math.atan2(2 * c, vx - vy)) / Math.PI) * 180 };
      }, rule);

    it('hides_the_other_leaflet_behind_the_one_in_front', async () => {
      await withPage(async (page) => {
        await page.keyboard.press('c');
        await look(page, '3');
        const [pink, blue] = [await pixelsOf(page, 'atrial'), await pixelsOf(page, 'ventricular')];
        // below the edge of P2 a strip of A2 is seen; where sides show through, pink is half of it
        assert.ok(blue.count > 2000, `${blue.count} pixels of the ventricular side`);
        assert.ok(pink.count < 0.1 * blue.count, `${pink.count} pixels of ${blue.count}`);
      });
    });

    it('shows_both_leaflets_and_their_contact_in_a_section_with_a_ring', async () => {
      await withPage(async (page) => {
        await begin(page, 'ring');
        await apply(page);
        // in the plot of the section as well the ring is two dots
        await openPanel(page, 'Valve');
        await page.locator('summary', { hasText: 'Section through the valve' }).click();
        await page.locator('circle.plot-ring').nth(1).waitFor();
        assert.equal(await page.locator('circle.plot-ring').count(), 2);
        await page.keyboard.press('c');
        await page.keyboard.press('n');
        await look(page, '4');
        // the colours of the picture where the plane cuts the middle of a leaflet
        const cut = await page.evaluate(async () => {
          const { state, viewport } = window.planner;
          const { picture } = state.main.value;
          const { positions: x } = picture;
          const { triangles } = state.topologyOf(picture);
          const { normal, offset } = viewport.plane();
          const image = await window.pixels();
          const scale = image.width / viewport.width;
          const away = (node) => [0, 1, 2].reduce((sum, c) => sum + normal[c] * x[3 * node + c], -offset);
          const colours = [];
          for (let t = 0; t < triangles.length; t += 3) {
            const ends = [];
            for (let k = 0; k < 3; ++k) {
              const [a, b] = [triangles[t + k], triangles[t + ((k + 1) % 3)]];
              const [da, db] = [away(a), away(b)];
              if (da < 0 === db < 0) continue;
              const s = da / (da - db);
              ends.push([0, 1, 2].map((c) => x[3 * a + c] + s * (x[3 * b + c] - x[3 * a + c])));
            }
            if (ends.length !== 2) continue;
            const middle = ends[0].map((v, c) => 0.5 * (v + ends[1][c]));
            const [px, py] = viewport.camera.project(...middle, viewport.width, viewport.height);
            const at = 4 * (Math.round(scale * py) * image.width + Math.round(scale * px));
            colours.push([...image.data.slice(at, at + 3)]);
          }
          return colours;
        });
        assert.ok(cut.length > 15, `${cut.length} cut triangles`);
        // dark red; the first and the last of each leaflet lie in the annulus
        const seen = cut.filter(([r, g, b]) => r > 1.8 * g && r > 1.8 * b && r < 160).length;
        assert.ok(seen >= cut.length - 4, `${seen} of ${cut.length} cut triangles are seen`);
        // across the zone of contact there are two dark bands with a lighter line between them
        const bands = await page.evaluate(async () => {
          const image = await window.pixels();
          const dark = (k) => image.data[k] > 1.8 * image.data[k + 1] && image.data[k] < 160;
          let most = 0;
          let rows = 0;
          for (let y = 0; y < image.height; ++y) {
            let count = 0;
            for (let x = 1; x < image.width; ++x) {
              const k = 4 * (y * image.width + x);
              if (dark(k) && !dark(k - 4)) count += 1;
            }
            if (count === 2) rows += 1;
            most = Math.max(most, count);
          }
          return { rows, most, height: image.height };
        });
        assert.ok(bands.rows > 0.1 * bands.height, JSON.stringify(bands));
      });
    });

    it('shows_the_turn_of_a_clip_and_says_its_place', async () => {
      await withPage(async (page) => {
        const turned = async (turns, slides) => {
          await look(page, '1');
          await begin(page, 'clip');
          for (let k = 0; k < turns; ++k) await page.keyboard.press('q');
          for (let k = 0; k < slides; ++k) await page.keyboard.press('a');
          await answered(page, 300);
          await apply(page);
          const { degrees } = await pixelsOf(page, 'device');
          const { history } = await figures(page);
          await openPanel(page, 'Plan');
          const said = await page.getByTestId('history').innerText();
          await openPanel(page, 'Valve');
          const listed = await page.getByTestId('devices').innerText();
          await page.keyboard.press('Control+z');
          await closed(page);
          return { degrees: (degrees + 180) % 180, title: history.at(-1).title, said, listed };
        };
        const straight = await turned(0, 0);
        assert.ok(Math.abs(straight.degrees - 90) < 8, `across the edge at ${straight.degrees} degrees`);
        assert.match(straight.said, /in the middle, across the edge/);
        // against the clock by 8 steps of 5 degrees
        const leaning = await turned(8, 4);
        assert.ok(Math.abs(leaning.degrees - 130) < 10, `turned by 40 at ${leaning.degrees} degrees`);
        for (const words of [leaning.said, leaning.listed])
          assert.match(
            words,
            /A2 and P2.*5\smm wide, (?!0\.0)[0-2]\.\d\smm towards A1\/P1 \(anterolateral\), turned 40° against the clock/,
          );
      });
    });
  });
}
