// The section through the valve: what the picture cuts away, its plane, and the plot of the cut.
import assert from 'node:assert/strict';
import { beforeEach, describe, it } from 'node:test';
import { sharePlanner } from './fixtures/browser.mjs';
import { answered, cameraRests, openPanel, startAfresh } from './fixtures/person.mjs';

describe('planner section', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));
  beforeEach(() => startAfresh(page));

  it('names_no_tissue_that_is_cut_away', async () => {
    const names = () => page.locator('.label-scallop:visible').allInnerTexts();
    await page.keyboard.press('4');
    await cameraRests(page);
    await page.waitForTimeout(250);
    const half = await names();
    assert.ok(half.includes('A3') && !half.includes('A1') && !half.includes('P1'), half.join());
    await page.keyboard.press('x');
  });

  it('names_the_section_plane_and_marks_the_cut', async () => {
    await page.keyboard.press('4');
    await cameraRests(page);
    const name = page.locator('.label-handle', { hasText: 'Cut plane' });
    await name.waitFor();
    // a mesh in the plane, of the line of the cut and of the frame of the plane
    const away = await page.evaluate(() => {
      const { viewport } = window.planner;
      const { normal, offset } = viewport.plane();
      const spread = ({ positions: x }) => {
        let most = 0;
        for (let i = 0; i < x.length; i += 3)
          most = Math.max(
            most,
            Math.abs(x[i] * normal[0] + x[i + 1] * normal[1] + x[i + 2] * normal[2] - offset),
          );
        return most;
      };
      return Math.min(
        ...viewport
          .scene()
          .meshes.filter((mesh) => !mesh.overlay && mesh.index.length > 300)
          .map(spread),
      );
    });
    assert.ok(away < 0.5, `${away} mm`);
    await page.keyboard.press('x');
    await name.waitFor({ state: 'detached' });
  });

  it('cuts_the_valve_in_the_view_of_the_section_only', async () => {
    const section = () =>
      page.evaluate(() => {
        const { state } = window.planner;
        return [state.sectionOn.value, state.sectionAt.value];
      });
    const press = (name) => page.locator('.viewbar').getByRole('button', { name, exact: true }).click();
    const cut = page.getByRole('button', { name: 'Cut plane in the picture' });
    for (const view of ['Surgeon', 'Ventricle', 'Behind']) {
      await press('Section');
      assert.deepEqual(await section(), [true, 0]);
      await press(view);
      assert.deepEqual(await section(), [false, 0], view);
    }
    await page.keyboard.press('4');
    await page.keyboard.press('1');
    assert.deepEqual(await section(), [false, 0]);
    // two controls of one bar have two names
    const words = await page.locator('.viewbar button').allInnerTexts();
    assert.equal(new Set(words).size, words.length, words.join());
    // switched off under the pointer it does not look as if it were on
    const look = () =>
      cut.evaluate((button) => {
        const { backgroundColor, borderTopColor, color } = getComputedStyle(button);
        return [backgroundColor, borderTopColor, color];
      });
    await cut.click();
    const on = await look();
    await cut.click();
    const off = await look();
    off.forEach((value, k) => assert.notEqual(value, on[k]));
    // the next valve is whole, and its section in the middle
    await press('Section');
    await page.evaluate(() => (window.planner.state.sectionAt.value = -8.5));
    await page.locator('.label-handle', { hasText: /8\.5\smm towards posteromedial/ }).waitFor();
    await page.getByRole('button', { name: 'Start from a healthy valve' }).click();
    await answered(page, 300);
    assert.deepEqual(await section(), [false, 0], 'the section of the valve before');
  });

  it('draws_the_leaflets_of_the_opened_valve_in_its_section', async () => {
    await openPanel(page, 'Valve');
    await page.locator('summary', { hasText: 'Section through the valve' }).click();
    const plot = page.locator('details', { has: page.locator('svg.plot') });
    const now = plot.locator('.plot-now');
    const shape = () => now.getAttribute('d');
    await now.waitFor();
    const closedShape = await shape();
    assert.doesNotMatch(await plot.innerText(), /closed/);
    await page.keyboard.press('o');
    await plot.locator('.legend', { hasText: 'closed' }).waitFor();
    assert.notEqual(await shape(), closedShape);
    // the places of the picture, in mm of the frame: its lowest point is that of the cut
    const lowest = await page.evaluate(() => {
      const { state } = window.planner;
      const { picture } = state.motion.value;
      const { frame } = state.main.value.figures;
      const { triangles } = state.topologyOf(picture);
      const along = (node, row) =>
        [0, 1, 2].reduce(
          (sum, c) => sum + (picture.positions[3 * node + c] - frame[c]) * frame[3 * row + c],
          0,
        );
      const cut = [];
      for (let k = 0; k < triangles.length; ++k) {
        const [a, b] = [triangles[k], triangles[k % 3 === 2 ? k - 2 : k + 1]];
        const [u, v] = [along(a, 2), along(b, 2)];
        if (u < 0 !== v < 0) cut.push(along(a, 3) + (u / (u - v)) * (along(b, 3) - along(a, 3)));
      }
      return Math.min(...cut);
    });
    const heights = (await shape()).match(/[ML]\S+ \S+?(?=[ML]|$)/g).map((one) => -one.split(' ')[1]);
    assert.ok(Math.abs(Math.min(...heights) - lowest) < 0.01, `${Math.min(...heights)} and ${lowest} mm`);
    await page.keyboard.press('o');
    await plot.locator('.legend', { hasText: 'closed' }).waitFor({ state: 'detached' });
    assert.equal(await shape(), closedShape);
    await page.locator('summary', { hasText: 'Section through the valve' }).click();
  });
});
