// The page keeps a bounded number of previews, and its picture stays whole.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { closed, figures, withPlanner } from './fixtures/browser.mjs';
import { answered, begin, openPanel } from './fixtures/person.mjs';

describe('planner memory', () => {
  it('keeps_the_connectivity_of_few_previews_and_of_every_valve_that_is_shown', async () => {
    await withPlanner({}, async ({ page }) => {
      await openPanel(page, 'Plan');
      await page.getByRole('button', { name: 'Keep this plan' }).click();
      await page.getByRole('button', { name: 'Compare' }).click();
      await answered(page, 200);
      const { hash } = await figures(page);
      await begin(page, 'neochord');
      // every place on the leaflet makes another mesh; the shape of each preview is enough
      const places = 80;
      const shown = await page.evaluate(async (count) => {
        const { state, edit } = window.planner;
        const { scallops, heads, triangleScallop } = state.topologyOf(state.main.value.picture);
        const wanted = scallops.findIndex(({ name }) => name === 'P2');
        const triangles = [...triangleScallop.keys()].filter((t) => triangleScallop[t] === wanted);
        const keys = new Set();
        for (let k = 0; k < count; ++k) {
          const u = [0.3 + 0.002 * k, 0.3, 0.4 - 0.002 * k];
          edit('neochord', { head: heads[0].id, site: { triangle: triangles[k % triangles.length], u } });
          const { draft } = state;
          const wantedDraft = draft.value;
          while (state.previewed.value !== wantedDraft) await new Promise((done) => setTimeout(done, 10));
          const picture = state.preview.value?.picture;
          if (!picture) continue;
          if (!state.topologyOf(picture)) throw new Error(`preview ${k} has no connectivity`);
          keys.add(picture.topology);
        }
        return keys.size;
      }, places);
      assert.ok(shown > 70, `${shown} meshes`);
      assert.ok((await page.evaluate(() => window.planner.state.keptTopologies())) <= 64);
      await page.keyboard.press('Escape');
      await page.keyboard.press('Escape');
      await closed(page);
      assert.equal((await figures(page)).hash, hash);
      const whole = await page.evaluate(() => {
        const { state } = window.planner;
        return [state.main, state.first, state.compared].map(
          (valve) => !!state.topologyOf(valve.value.picture)?.triangles.length,
        );
      });
      assert.deepEqual(whole, [true, true, true]);
      // the worker sends dropped arrays once more
      await openPanel(page, 'Plan');
      await page.getByRole('button', { name: 'Return to it' }).click();
      await answered(page, 200);
      await page.keyboard.press('o');
      for (let k = 0; k < 200 && !(await page.evaluate(() => !!window.planner.state.motion.value)); ++k)
        await page.waitForTimeout(50);
      assert.ok(
        await page.evaluate(() => !!window.planner.state.topologyOf(window.planner.state.picture.value)),
      );
    });
  });
});
