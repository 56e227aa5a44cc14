// A clip is slid and turned in the picture: by its ball, its arms and its handle, by the slider of its form, by keys.
import assert from 'node:assert/strict';
import { beforeEach, describe, it } from 'node:test';
import { closed, figures, sharePlanner } from './fixtures/browser.mjs';
import { answered, apply, begin, cameraRests, openPanel, startAfresh, undo } from './fixtures/person.mjs';

describe('planner clips', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));
  beforeEach(() => startAfresh(page));

  /** Degrees of the clip of the form. */
  const turn = () => page.evaluate(() => window.planner.state.draft.value.fields.angle ?? 0);
  /** Middle of the label that begins with a text, in the window. */
  const labelled = async (text) => {
    const { x, y, height } = await page.locator('.label-handle', { hasText: text }).boundingBox();
    // the ball stands before its name
    return { x: x - 24, y: y + height / 2 };
  };

  it('slides_a_clip_by_its_ball', async () => {
    await begin(page, 'clip');
    const { x, y } = await labelled('Clip');
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 45, y, { steps: 6 });
    await page.mouse.up();
    await closed(page);
    const position = await page.evaluate(() => window.planner.state.draft.value.fields.position);
    assert.ok(Math.abs(position) > 0.15, `position ${position}`);
    await apply(page);
    await openPanel(page, 'Valve');
    assert.match(await page.getByTestId('devices').innerText(), /Clip\s+joins A2 and P2, 5\smm wide/);
    await undo(page);
  });

  it('slides_a_clip_to_the_side_to_which_its_slider_goes', async () => {
    await page.keyboard.press('1');
    await cameraRests(page);
    await begin(page, 'clip');
    const slider = page.locator('input[type=range][aria-label^="Position"]');
    const ends = page.locator('.field', { has: slider }).locator('.ends');
    assert.equal((await ends.innerText()).replace(/\s+/g, ' '), 'anterolateral posteromedial');
    const middle = (await labelled('Clip')).x;
    await slider.focus();
    for (let k = 0; k < 6; ++k) await page.keyboard.press('ArrowRight');
    await answered(page, 300);
    const right = (await labelled('Clip')).x;
    assert.ok(right > middle + 5, `from ${middle} to ${right}`);
    assert.equal(
      await slider.getAttribute('aria-valuetext'),
      '30\u00a0% of the way to the posteromedial end',
    );
    // the chordae that tell the sides: posteromedial is where the heads PM are
    const side = await page.evaluate(() => {
      const { state, viewport } = window.planner;
      const { picture } = state.main.value;
      const topology = state.topologyOf(picture);
      const x = (name) => {
        const node = topology.headNodes[topology.heads.findIndex((part) => part.name === name)];
        const at = picture.positions.slice(3 * node, 3 * node + 3);
        return viewport.camera.project(...at, viewport.width, viewport.height)[0];
      };
      return x('PM1') - x('AL1');
    });
    assert.ok(side > 0, 'posteromedial is to the right');
    await page.keyboard.press('Escape');
    await page.keyboard.press('Escape');
  });

  it('turns_a_clip_by_its_handle_and_by_keys', async () => {
    await begin(page, 'clip');
    const straight = (await figures(page)).hash;
    const [middle, handle] = [await labelled('Clip'), await labelled('Turn')];
    // by 30 degrees to the left, which is anticlockwise in the surgeon's view
    const length = middle.y - handle.y;
    assert.ok(length > 30, 'the handle is seen from the atrium');
    await page.mouse.move(handle.x, handle.y);
    await page.mouse.down();
    await page.mouse.move(middle.x - 0.5 * length, middle.y - 0.87 * length, { steps: 6 });
    await page.mouse.up();
    await closed(page);
    const dragged = await turn();
    assert.ok(dragged >= 25 && dragged <= 35, `${dragged} degrees`);
    const turned = (await figures(page)).hash;
    assert.notEqual(turned, straight, 'the preview is that of the turned clip');
    await page.keyboard.press('e');
    await closed(page);
    assert.equal(await turn(), dragged - 5);
    // its arms turn it as well
    const [now, end] = [await labelled('Clip'), await labelled('Turn')];
    await page.mouse.move(0.55 * now.x + 0.45 * end.x, 0.55 * now.y + 0.45 * end.y);
    await page.mouse.down();
    await page.mouse.move(end.x - 80, end.y + 20, { steps: 6 });
    await page.mouse.up();
    await closed(page);
    assert.ok((await turn()) > dragged, `${await turn()} degrees`);
    await page.locator('#f-angle').fill(String(dragged - 5));
    await page.keyboard.press('Tab');
    await closed(page);
    await page.keyboard.press('d');
    await closed(page);
    assert.ok((await page.evaluate(() => window.planner.state.draft.value.fields.position)) < 0);
    await apply(page);
    assert.match((await figures(page)).history.at(-1).title, new RegExp(`turned by ${dragged - 5} degrees`));
    await undo(page);
  });
});
